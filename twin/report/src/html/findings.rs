//! The findings: rows that open without a script, a filter where there is one.

use std::collections::BTreeMap;

use sim::finding::{Code, Family};

use super::album::{Album, PictureKind};
use super::course::moment;
use super::source::Lines;
use super::{Extras, name, sentence, why};
use crate::line::allowed_words;
use crate::parts::{Finding, Report, Severity};
use crate::plots::text::{LONGEST_ID, escaped};
use crate::quantity::{Unit, against, counted};
use crate::results::Range;

/// Findings with a row of their own.
pub(super) const ROWS: usize = 500;
/// Bodies told of one finding.
const BODIES: usize = 6;

/// Filter, rows, what is not shown, and what the codes mean.
pub(super) fn body(report: &Report, extras: &Extras<'_>, album: &Album<'_>) -> String {
    if report.findings.is_empty() {
        return "<p>Nothing was found.</p>".to_owned();
    }
    let lines = Lines::of(extras.source);
    let rows: String = report
        .findings
        .iter()
        .take(ROWS)
        .enumerate()
        .map(|(index, finding)| row(index, finding, &lines, extras, album))
        .collect();
    format!(
        "{}<div class=\"rows\" id=\"rows\"><p class=\"row-head\" aria-hidden=\"true\"><span></span><span>Code</span><span>What</span>\
         <span>Where</span><span>When</span><span class=\"n\">Measured</span></p>\n{rows}</div>\n{}{}",
        filter(report),
        rest(report),
        why::pages(report)
    )
}

/// Choice by family, severity and text; for the script.
fn filter(report: &Report) -> String {
    let families: String = Family::ALL
        .into_iter()
        .filter(|family| {
            report.findings.iter().any(|finding| finding.code.starts_with(family.letter()))
        })
        .map(|family| {
            format!("<option value=\"{0}\">{0} {1}</option>", family.letter(), family.title())
        })
        .collect();
    let n = report.findings.len().min(ROWS);
    format!(
        "<div class=\"filter js-only\" role=\"search\" aria-label=\"Findings\">\
         <label>Family <select id=\"by-family\"><option value=\"\">all</option>{families}</select></label>\
         <label>Severity <select id=\"by-severity\"><option value=\"\">all</option><option value=\"error\">errors</option>\
         <option value=\"warning\">warnings</option></select></label>\
         <label>Order <select id=\"by-order\"><option value=\"index\">errors first</option><option value=\"time\">time</option>\
         <option value=\"code\">code</option></select></label>\
         <label>Text <input type=\"search\" id=\"by-text\"/></label>\
         <p id=\"n-shown\" role=\"status\">{n} shown</p>\
         <p class=\"soft keys\"><kbd>j</kbd> <kbd>k</kbd> next, last</p></div>\n"
    )
}

/// What has no row, by code.
fn rest(report: &Report) -> String {
    let mut by_code: BTreeMap<&str, usize> = BTreeMap::new();
    for finding in report.findings.iter().skip(ROWS) {
        *by_code.entry(&finding.code).or_default() += 1;
    }
    if by_code.is_empty() {
        return String::new();
    }
    let told: Vec<String> = by_code
        .iter()
        .take(60)
        .map(|(code, n)| format!("{} {n}", escaped(code, LONGEST_ID)))
        .collect();
    let n = report.findings.len() - ROWS;
    format!(
        "<p>{} not shown here, in report.json: {}.</p>",
        counted(n, "more finding"),
        told.join(", ")
    )
}

fn row(
    index: usize,
    finding: &Finding,
    lines: &Lines<'_>,
    extras: &Extras<'_>,
    album: &Album<'_>,
) -> String {
    let (class, mark) = sign(finding.severity);
    let known = Code::from_name(&finding.code);
    let family = known.map_or(String::new(), |code| code.family().letter().to_string());
    let code = known.map_or("", Code::as_str);
    let of_film = extras.film.and_then(|film| film.findings.get(index)).and_then(|it| it.time_s);
    let time_s = finding.time_s.or(of_film).filter(|time_s| time_s.is_finite());
    let data_time = time_s.map_or(String::new(), |time_s| format!(" data-time=\"{time_s}\""));
    let when = time_s.map_or("–".to_owned(), |time_s| moment(Some(time_s)));
    format!(
        "<details class=\"finding\" data-index=\"{index}\" data-family=\"{family}\" data-severity=\"{class}\" \
         data-code=\"{code}\"{data_time}><summary><span class=\"{class} sev\"><span aria-hidden=\"true\">{mark}</span> {class}</span>\
         <b class=\"code\">{}</b><span class=\"what\">{}</span><span class=\"where\">{}</span>\
         <span class=\"when\">{when}</span><span class=\"n measured\">{}</span></summary>\n{}</details>\n",
        escaped(&finding.code, LONGEST_ID),
        sentence(&finding.title),
        place(finding),
        short_value(finding),
        more(index, finding, lines, extras, album)
    )
}

/// Class and sign of a severity: told by shape as well as by colour.
pub(super) fn sign(severity: Severity) -> (&'static str, &'static str) {
    let mark = match severity {
        Severity::Error => "■",
        Severity::Warning => "▲",
    };
    (severity.word(), mark)
}

/// Measured against its limit, without the interval.
fn short_value(finding: &Finding) -> String {
    if against(finding).is_none() {
        return "–".to_owned();
    }
    let unit = Unit::of(&finding.code, &finding.unit);
    let bound = Code::from_name(&finding.code).map(Code::bound);
    let word = if bound == Some(sim::finding::Bound::Lower) { "min" } else { "max" };
    format!(
        "{} <span class=\"soft\">{word} {}</span>",
        unit.show(finding.measured),
        unit.show(finding.limit)
    )
}

fn place(finding: &Finding) -> String {
    let site = &finding.site;
    let mut parts = Vec::new();
    parts.extend(site.strand.as_ref().map(|strand| name(strand)));
    parts.extend(site.at_m.map(|at_m| format!("at {}", Unit::Millimetre.show(Some(at_m)))));
    parts.extend(site.stage.map(|stage| format!("after {}", counted(stage, "strand"))));
    parts.extend(site.phase.map(|phase| phase.word().to_owned()));
    if parts.is_empty() { "whole job".to_owned() } else { parts.join(", ") }
}

/// What is below the row.
fn more(
    index: usize,
    finding: &Finding,
    lines: &Lines<'_>,
    extras: &Extras<'_>,
    album: &Album<'_>,
) -> String {
    let picture =
        album.first(&PictureKind::Finding { index }).map_or(String::new(), |picture| picture.img());
    let source = finding.line.map_or(String::new(), |line| {
        let excerpt = lines.excerpt(line);
        match excerpt.is_empty() {
            true => String::new(),
            false => {
                format!("<h3>Line {line} of {}</h3>{excerpt}", name(file(&extras.source.name)))
            }
        }
    });
    let why = Code::from_name(&finding.code).map_or(String::new(), |code| {
        let code = code.as_str();
        format!("<h3>Why</h3><p class=\"why\"><a href=\"#why-{code}\">What {code} measures, its limit, what mends it</a></p>")
    });
    let class = if picture.is_empty() { "more" } else { "more seen" };
    let allowed = finding.allowed.as_ref().map_or(String::new(), |allowed| {
        format!("<p class=\"allowed\"><b>Let pass:</b> {}</p>", sentence(&allowed_words(allowed)))
    });
    // as people count, and as the files and `twin render` do
    let number = index + 1;
    format!(
        "<div class=\"{class}\" id=\"finding-{number}\">{picture}<div><p class=\"message\">{}</p>{allowed}\
         <h3>What to do</h3><p>{}</p>{}{source}{why}</div></div>",
        sentence(&finding.message),
        sentence(&finding.hint),
        facts(finding)
    )
}

/// The last part of a path.
fn file(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

fn facts(finding: &Finding) -> String {
    let site = &finding.site;
    let unit = Unit::of(&finding.code, &finding.unit);
    let mut facts: Vec<(&str, String)> = Vec::new();
    if against(finding).is_some() {
        let range = Range { value: finding.measured, low: finding.low, high: finding.high };
        facts.push(("Measured", unit.show_range(&range)));
        let bound = Code::from_name(&finding.code).map(Code::bound);
        let word = if bound == Some(sim::finding::Bound::Lower) { "at least" } else { "at most" };
        facts.push(("Limit", format!("{word} {}", unit.show(finding.limit))));
    }
    if !site.bodies.is_empty() {
        let bodies: Vec<String> = site.bodies.iter().take(BODIES).map(|body| name(body)).collect();
        facts.push(("Bodies", bodies.join(", ")));
    }
    facts.extend(site.node.map(|node| ("Node", node.to_string())));
    facts.extend(site.member.map(|member| ("Member", member.to_string())));
    if finding.count > 1 {
        facts.push((
            "Stands for",
            format!("{}, of which this is the worst", counted(finding.count, "place")),
        ));
    }
    if facts.is_empty() {
        return String::new();
    }
    let rows: String = facts
        .iter()
        .map(|(name, value)| format!("<div><dt>{name}</dt><dd>{value}</dd></div>"))
        .collect();
    format!("<dl class=\"facts\">{rows}</dl>")
}
