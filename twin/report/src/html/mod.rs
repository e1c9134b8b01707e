//! The report as one HTML page that people send to each other: nothing fetched, whole without script.
//!
//! One file per part of the page, top to bottom: `verdict`, `figures`, `film`, `timeline`, `view` (the 3-D view),
//! `findings` with `source` and `why`, `traces`, `tables`, `basis`. `course` is the program as stretches of time,
//! `album` the pictures that fit, `data` what the script gets to know. `text.rs` of the plots escapes all text of a job.
//! The same report gives the same bytes.

mod album;
mod base64;
mod basis;
mod course;
mod data;
mod decimate;
mod figures;
mod film;
mod findings;
mod look;
mod source;
mod tables;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_any;
mod timeline;
mod traces;
mod verdict;
mod view;
mod why;

pub use album::{EmbeddedPicture, PictureKind};
pub use view::view3d;

use sim::film::{Film, Trace};

use crate::parts::Report;
use crate::plots;
use crate::plots::text::{LONGEST_ID, LONGEST_SENTENCE, escaped};
use album::Album;
use course::Course;

/// The page stays below this, bytes; pictures give way.
const BUDGET_BYTES: usize = 4_900_000;

/// The 3-D view brings its section and heading with it, under this id.
const VIEW_ID: &str = "view3d";

/// Nothing is fetched, whatever stands in the job's text; pictures are part of the page.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; \
                      base-uri 'none'; form-action 'none'";

/// What a page shows beyond the report. All of it may be absent but the job's text.
#[derive(Debug, Clone)]
pub struct Extras<'a> {
    /// The job as it goes on, of the same check as the report.
    pub film: Option<&'a Film>,
    /// Numbers against the time of the program.
    pub traces: &'a [Trace],
    /// Text of the job.
    pub source: &'a slam::Source,
    /// The 3-D view as a section of HTML, trusted.
    pub view: Option<&'a str>,
    /// Pictures to embed.
    pub pictures: Vec<EmbeddedPicture>,
}

/// A part of the page with its heading.
struct Section {
    id: &'static str,
    title: &'static str,
    body: String,
}

/// The report as one self-contained HTML page, below 5 MB: pictures that do not fit are left out, and that is said.
///
/// Findings are shown up to 500, joints and traces with up to about 800 points; the rest is counted.
pub fn page(report: &Report, extras: &Extras<'_>) -> String {
    let course = Course::new(report, extras.film);
    let plots = traces::plots(&course, extras);
    let script = script(&data::json(&course, &plots), report, extras.view.is_some());
    let with = |album: &Album<'_>| {
        let sections = sections(report, extras, album, &course, &plots);
        whole(report, &sections, &film::bar(&course), &script)
    };
    let bare = with(&Album::default());
    if extras.pictures.is_empty() {
        return bare;
    }
    with(&Album::within(&extras.pictures, BUDGET_BYTES.saturating_sub(bare.len())))
}

/// The parts of the page, top to bottom; an empty body is left out.
fn sections(
    report: &Report,
    extras: &Extras<'_>,
    album: &Album<'_>,
    course: &Course,
    plots: &traces::Plots,
) -> Vec<Section> {
    let view = extras.view.unwrap_or_default().to_owned();
    let all = [
        Section::new("figures", "Key figures", figures::body(report, extras, course)),
        Section::new("part", "The part", film::body(album, course)),
        Section::new("time", "Timeline", timeline::body(report, extras, course)),
        Section { id: VIEW_ID, title: "3-D view", body: view },
        Section::new("findings", "Findings", findings::body(report, extras, album)),
        Section::new("plots", "Over time", plots.html.clone()),
        Section::new("strands", "Strands", strands(report)),
        Section::new("structure", "Structure", tables::body(report, album)),
        Section::new("spin", "Spin maps", film::spin_maps(album)),
        Section::new("basis", "What this rests on", basis::body(report, album)),
    ];
    all.into_iter().filter(|section| !section.body.is_empty()).collect()
}

fn whole(report: &Report, sections: &[Section], time_bar: &str, script: &str) -> String {
    let links: String = sections
        .iter()
        .map(|section| format!("<li><a href=\"#{}\">{}</a></li>", section.id, section.title))
        .collect();
    let main: String = sections.iter().map(Section::html).collect();
    [
        head(report),
        format!(
            "<a class=\"skip\" href=\"#findings\">Skip to the findings</a>\n{}",
            top(report, &links)
        ),
        format!("<main>\n{}{main}</main>\n", verdict::banner(report)),
        time_bar.to_owned(),
        script.to_owned(),
        "</body></html>\n".to_owned(),
    ]
    .concat()
}

impl Section {
    fn new(id: &'static str, title: &'static str, body: String) -> Self {
        Self { id, title, body }
    }

    fn html(&self) -> String {
        let Self { id, title, body } = self;
        if *id == VIEW_ID {
            return body.clone();
        }
        format!(
            "<section id=\"{id}\" aria-labelledby=\"{id}-h\"><h2 id=\"{id}-h\">{title}</h2>\n{body}</section>\n"
        )
    }
}

fn head(report: &Report) -> String {
    let style = [
        include_str!("page.css"),
        include_str!("../plots/drawing.css"),
        include_str!("parts.css"),
        view::STYLE,
        include_str!("print.css"),
    ]
    .concat();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <meta name=\"color-scheme\" content=\"light dark\"/>\n<title>{} – {}</title>\n<style>\n{style}</style>\n\
         <script>document.documentElement.classList.add(\"js\");</script></head>\n<body>\n",
        escaped(&report.name, LONGEST_ID),
        report.verdict.word().to_uppercase()
    )
}

fn top(report: &Report, links: &str) -> String {
    format!(
        "<header class=\"top\"><p class=\"brand\"><b>twin</b> <bdi>{}</bdi></p>\
         <nav aria-label=\"Parts of the page\"><ul>{links}</ul></nav>\
         <button type=\"button\" id=\"theme\" class=\"js-only\">Dark</button></header>\n",
        escaped(&report.name, LONGEST_ID)
    )
}

/// Plots of all strands, folded.
fn strands(report: &Report) -> String {
    let plots = plots::all_strands(report);
    if plots.is_empty() {
        return String::new();
    }
    format!(
        "<details><summary>Sag, bead, set distance and bond of {} in printing order</summary>{plots}</details>",
        crate::quantity::counted(report.strands.len(), "strand")
    )
}

fn script(data: &str, report: &Report, has_view: bool) -> String {
    let view =
        if has_view { format!("<script>\n{}</script>\n", view::SCRIPT) } else { String::new() };
    let page = [
        include_str!("js/time.js"),
        include_str!("js/plots.js"),
        include_str!("js/findings.js"),
        include_str!("js/page.js"),
    ]
    .concat();
    format!(
        "<script type=\"application/json\" id=\"twin-data\">{data}</script>\n{}\
         {view}<script>\n(() => {{\n\"use strict\";\n{page}}})();\n</script>\n",
        basis::embedded(report)
    )
}

/// A sentence of the report, escaped and clipped.
fn sentence(text: &str) -> String {
    escaped(text, LONGEST_SENTENCE)
}

/// A name from the job, kept apart from the direction of the text around it.
fn name(text: &str) -> String {
    format!("<bdi>{}</bdi>", escaped(text, LONGEST_ID))
}
