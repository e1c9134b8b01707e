//! What the answer rests on: assumptions, inputs, who drew, how long it took; and the report itself.

use std::collections::BTreeMap;

use super::album::Album;
use super::data::in_script;
use super::tables::table;
use super::{name, sentence};
use crate::parts::{Report, StepTime};
use crate::plots::text::escaped;
use crate::quantity::{counted, digits};

/// Assumptions told.
const ASSUMPTIONS: usize = 400;
/// Inputs told, and steps.
const ROWS: usize = 100;
/// A report.json larger than this is not part of the page, bytes.
const EMBEDDED_MAX: usize = 1_000_000;
/// The step in which pictures are drawn.
const DRAWING: &str = "drawing";

/// Assumptions, inputs, timing.
pub(super) fn body(report: &Report, album: &Album<'_>) -> String {
    [assumptions(report), inputs(report), timing(report, album), download(report)].concat()
}

fn assumptions(report: &Report) -> String {
    let mut about: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for assumption in report.assumptions.iter().take(ASSUMPTIONS) {
        about.entry(&assumption.about).or_default().push(&assumption.text);
    }
    if about.is_empty() {
        return String::new();
    }
    let groups: String = about
        .iter()
        .map(|(about, texts)| {
            let items: String =
                texts.iter().map(|text| format!("<li>{}</li>", sentence(text))).collect();
            format!("<div><dt>{}</dt><dd><ul>{items}</ul></dd></div>", sentence(about))
        })
        .collect();
    let more = match report.assumptions.len().saturating_sub(ASSUMPTIONS) {
        0 => String::new(),
        n => format!("<p>{} in report.json.</p>", counted(n, "more assumption")),
    };
    format!(
        "<h3>Assumptions</h3><details><summary>{}</summary><dl class=\"assumptions\">{groups}</dl>{more}</details>",
        counted(report.assumptions.len(), "assumption")
    )
}

fn inputs(report: &Report) -> String {
    let provenance = &report.provenance;
    let rows: Vec<Vec<String>> = provenance
        .inputs
        .iter()
        .take(ROWS)
        .map(|input| {
            let hash = escaped(&input.sha256, 64);
            vec![
                sentence(&input.what),
                name(&input.name),
                format!("<code class=\"hash\">{hash}</code>"),
            ]
        })
        .collect();
    let drawn = match &provenance.drawn_by {
        Some(who) => format!("Pictures by {}.", sentence(who)),
        None => "No pictures were drawn.".to_owned(),
    };
    let table = match rows.is_empty() {
        true => String::new(),
        false => table(
            "Inputs with their SHA-256",
            &[("What", false), ("Name", false), ("SHA-256", false)],
            &rows,
        ),
    };
    format!(
        "<h3>Provenance</h3><p>twin {}, {}. {drawn}</p>{table}",
        sentence(&provenance.twin),
        sentence(&report.schema)
    )
}

fn timing(report: &Report, album: &Album<'_>) -> String {
    let timing = &report.timing;
    let pictures = pictures(report, album);
    if timing.steps.is_empty() {
        return format!("<p>{pictures}</p>");
    }
    let row = |step: &StepTime| vec![sentence(&step.step), format!("{} s", digits(step.time_s))];
    let mut rows: Vec<Vec<String>> = timing.steps.iter().take(ROWS).map(row).collect();
    rows.push(vec!["all".to_owned(), format!("{} s", digits(timing.total_s))]);
    format!(
        "<h3>What it took</h3><p>{pictures}</p><details><summary>{} s in {}</summary>{}</details>",
        digits(timing.total_s),
        counted(timing.steps.len(), "step"),
        table("Time by step", &[("Step", false), ("Time", true)], &rows)
    )
}

/// What pictures cost, and which are missing.
fn pictures(report: &Report, album: &Album<'_>) -> String {
    let drawing_s: f64 = report
        .timing
        .steps
        .iter()
        .filter(|step| step.step == DRAWING)
        .map(|step| step.time_s)
        .sum();
    let cost = match drawing_s > 0.0 {
        true => format!("Drawing took {} s; it changes nothing in the verdict.", digits(drawing_s)),
        false => String::new(),
    };
    let shown = match album.len() {
        0 => "This page has no pictures.".to_owned(),
        n => {
            format!("This page has {} of {} kB.", counted(n, "picture"), album.bytes.div_ceil(1000))
        }
    };
    let left_out = match album.left_out {
        0 => String::new(),
        n => format!("{} left out to keep it below 5 MB.", counted(n, "picture")),
    };
    [cost, shown, left_out]
        .into_iter()
        .filter(|told| !told.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}

/// The report for programs, if it is small enough.
fn fits(report: &Report) -> Option<String> {
    let json = in_script(report);
    (json.len() <= EMBEDDED_MAX).then_some(json)
}

fn download(report: &Report) -> String {
    match fits(report) {
        Some(json) => format!(
            "<p class=\"js-only\"><button type=\"button\" id=\"download\">Save report.json</button> \
             <span class=\"soft\">{} kB, for programs</span></p>",
            json.len().div_ceil(1000)
        ),
        None => "<p>report.json is larger than 1 MB and not part of this page.</p>".to_owned(),
    }
}

/// The element with the report in it; empty where it is too large.
pub(super) fn embedded(report: &Report) -> String {
    fits(report).map_or(String::new(), |json| {
        format!("<script type=\"application/json\" id=\"report-json\">{json}</script>\n")
    })
}
