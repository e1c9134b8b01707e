//! A report to read, in Markdown.

use super::shared::{Tally, worst_first};
use super::tables::{self, heading, plain, row};
use crate::human::place;
use crate::parts::{Finding, Report};
use crate::quantity::{counted, found};

/// Findings told one by one.
const TOLD_MAX: usize = 200;
/// Assumptions and inputs told.
const LISTED_MAX: usize = 200;

/// Verdict, scores, figures, the worst findings with what to do, all findings counted by code, what
/// the answer rests on and what went in.
pub fn markdown(report: &Report) -> String {
    let mut page = format!("# {}: {}\n\n", plain(&report.name, 200), tables::verdict(report));
    let all = Tally::of(report.findings.iter());
    page.push_str(&format!("{}.\n\n{}", all.words(), tables::families(report)));
    page.push_str(&format!("\n## Key figures\n\n{}", tables::figures(report)));
    page.push_str("\n## Findings\n\n");
    let order = worst_first(report);
    if order.is_empty() {
        page.push_str("None.\n");
    }
    for &at in order.iter().take(TOLD_MAX) {
        page.push_str(&finding(report, &report.findings[at]));
    }
    if let Some(more @ 1..) = order.len().checked_sub(TOLD_MAX) {
        page.push_str(&format!("and {more} more in report.json.\n"));
    }
    if !report.findings.is_empty() {
        page.push_str(&format!("\n## Findings by code\n\n{}", tables::by_code(report)));
    }
    page.push_str(&assumptions(report));
    page.push_str(&inputs(report));
    page
}

fn finding(report: &Report, finding: &Finding) -> String {
    let code = plain(&finding.code, 16);
    let word = finding.severity.word();
    let mut item = format!("- **{word} {code} {}**: ", plain(&finding.title, 200));
    item.push_str(&plain(&finding.message, 600));
    let place = place(report, finding);
    let lines = [
        (!place.is_empty()).then(|| format!("where: {}", plain(&place, 300))),
        found(finding).map(|found| format!("found: {}", plain(&found, 200))),
        (!finding.hint.is_empty()).then(|| format!("hint: {}", plain(&finding.hint, 600))),
        tables::allowed(finding),
    ];
    for line in lines.into_iter().flatten() {
        item.push_str(&format!("\n  - {line}"));
    }
    item + "\n"
}

fn assumptions(report: &Report) -> String {
    let mut text = format!("\n## What this rests on\n\n{}", heading(&["about", "assumption"]));
    for assumption in report.assumptions.iter().take(LISTED_MAX) {
        text.push_str(&row(&[plain(&assumption.about, 60), plain(&assumption.text, 600)]));
    }
    text + &left_out(report.assumptions.len(), "assumption")
}

fn inputs(report: &Report) -> String {
    let provenance = &report.provenance;
    let mut text = format!(
        "\n## What went in\n\ntwin {}\n\n{}",
        plain(&provenance.twin, 40),
        heading(&["", "file", "SHA-256"])
    );
    for input in provenance.inputs.iter().take(LISTED_MAX) {
        text.push_str(&row(&[
            plain(&input.what, 40),
            plain(&input.name, 300),
            plain(&input.sha256, 64),
        ]));
    }
    text + &left_out(provenance.inputs.len(), "input")
}

fn left_out(count: usize, thing: &str) -> String {
    match count.checked_sub(LISTED_MAX) {
        Some(more @ 1..) => format!("\nand {}.\n", counted(more, &format!("more {thing}"))),
        _ => String::new(),
    }
}
