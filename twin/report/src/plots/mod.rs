//! The strands of a report as a page of plots: one HTML file with drawings in SVG, no script, nothing fetched.
//!
//! `axis` puts numbers on axes with round ticks, `chart` draws a frame and what is in it, `overview` is all
//! strands in printing order, `card` one strand: `ageing` against age, `course` where it lies. Everything that
//! comes from a job goes through `text::escaped`. The same report gives the same bytes.

mod ageing;
pub(crate) mod axis;
mod card;
pub(crate) mod chart;
mod course;
mod overview;
mod quantities;
pub(crate) mod text;

#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_any;

use std::collections::BTreeMap;

use crate::parts::{Finding, Report, Severity};
use text::{LONGEST_ID, counted, escaped};

/// Strands with a card of their own.
const CARDS: usize = 24;

/// Nothing is fetched and nothing runs, whatever stands in the job's text.
const POLICY: &str =
    "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

/// The strands of a report as one self-contained HTML page.
///
/// Cost and size grow with the strands up to 1000 places a plot; 24 strands have plots of their own.
pub fn strands_page(report: &Report) -> String {
    let by_strand = by_strand(report);
    let of = |id: &str| by_strand.get(id).map_or(&[][..], |all| all.as_slice());
    let marks: Vec<Option<Severity>> =
        report.strands.iter().map(|strand| worst(of(&strand.id))).collect();
    let chosen = chosen(report, &marks);
    let cards: String = chosen
        .iter()
        .map(|&k| card::card(k + 1, &report.strands[k], of(&report.strands[k].id)))
        .collect();
    let name = escaped(&report.name, LONGEST_ID);
    let verdict = report.verdict.word();
    let style = concat!(include_str!("style.css"), include_str!("drawing.css"));
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <title>Strands of {name}</title>\n<style>\n{style}</style></head>\n<body><main>\n\
         <h1>Strands of <bdi>{name}</bdi></h1>\n<p>{}, {verdict}. {}</p>\n{}\n{}\n{}</main></body></html>\n",
        counted(report.strands.len(), "strand"),
        marked(&marks),
        overview_part(report, &marks),
        which(report.strands.len(), &marks, &chosen),
        cards
    )
}

fn overview_part(report: &Report, marks: &[Option<Severity>]) -> String {
    if report.strands.is_empty() {
        return "<p>Nothing was printed: there is nothing to plot.</p>".to_owned();
    }
    format!("<h2>All strands in printing order</h2>\n{}", drawn(report, marks))
}

/// A plot of every quantity over all strands, and a table of their ends, for another page; empty without strands.
pub(crate) fn all_strands(report: &Report) -> String {
    if report.strands.is_empty() {
        return String::new();
    }
    let by_strand = by_strand(report);
    let of = |id: &str| by_strand.get(id).and_then(|all| worst(all));
    let marks: Vec<Option<Severity>> = report.strands.iter().map(|strand| of(&strand.id)).collect();
    drawn(report, &marks)
}

fn drawn(report: &Report, marks: &[Option<Severity>]) -> String {
    format!(
        "<p>A mark is what is expected, the bar behind it reaches from the low to the high end of what it may be. \
         Marks: <b class=\"plain\">●</b> no finding, <b class=\"warning\">▲</b> a warning on the strand, \
         <b class=\"error\">■</b> an error on the strand, of whatever kind. \
         A dashed line is a limit that a finding was held against; where there is no finding, the report knows no limit.</p>\n\
         {}\n{}",
        overview::plots(report, marks),
        overview::table(report)
    )
}

/// Findings of each strand, in the report's order: errors first.
fn by_strand(report: &Report) -> BTreeMap<&str, Vec<&Finding>> {
    let mut by_strand: BTreeMap<&str, Vec<&Finding>> = BTreeMap::new();
    for finding in &report.findings {
        if let Some(strand) = &finding.site.strand {
            by_strand.entry(strand).or_default().push(finding);
        }
    }
    by_strand
}

fn worst(findings: &[&Finding]) -> Option<Severity> {
    findings.iter().fold(None, |worst, finding| overview::worse(worst, Some(finding.severity)))
}

/// Strands that matter, in printing order: errors, then warnings, then the greatest sag.
fn chosen(report: &Report, marks: &[Option<Severity>]) -> Vec<usize> {
    let rank = |k: usize| match marks[k] {
        Some(Severity::Error) => 0,
        Some(Severity::Warning) => 1,
        None => 2,
    };
    let sag = |k: usize| quantities::worst_sag_m(&report.strands[k]);
    let mut order: Vec<usize> = (0..report.strands.len()).collect();
    order.sort_by(|&a, &b| rank(a).cmp(&rank(b)).then(sag(b).total_cmp(&sag(a))).then(a.cmp(&b)));
    order.truncate(CARDS);
    order
}

fn marked(marks: &[Option<Severity>]) -> String {
    let n = |severity| marks.iter().filter(|&&mark| mark == Some(severity)).count();
    match (n(Severity::Error), n(Severity::Warning)) {
        (0, 0) => "No finding is on a strand.".to_owned(),
        (errors, 0) => format!("{} with an error.", counted(errors, "strand")),
        (0, warnings) => {
            format!("{} with warnings, none with an error.", counted(warnings, "strand"))
        }
        (errors, warnings) => format!(
            "{} with an error, {} with warnings alone.",
            counted(errors, "strand"),
            counted(warnings, "strand")
        ),
    }
}

/// Heading of the cards, and what was left out.
fn which(n: usize, marks: &[Option<Severity>], chosen: &[usize]) -> String {
    if chosen.is_empty() {
        return String::new();
    }
    let with = |k: &usize| marks[*k].is_some();
    let left = n - chosen.len();
    let silent = (0..n).filter(with).count() - chosen.iter().copied().filter(with).count();
    let left_out = match (left, silent) {
        (0, _) => "All are here.".to_owned(),
        (_, 0) => format!("{} without findings left out.", counted(left, "strand")),
        _ => format!("{} left out, {silent} of them with findings.", counted(left, "strand")),
    };
    format!(
        "<h2>Strands one by one</h2>\n<p>Errors first, then warnings, then the greatest sag. {left_out} \
         The numbers of every strand are in report.json.</p>"
    )
}
