//! The summary page of a GitHub job.

use super::shared::{Tally, worst_first};
use super::{mermaid, tables};
use crate::parts::{Finding, Report, Verdict};

/// Findings told one by one. A cell is clipped, so the page stays far below GitHub's 1 MiB.
const TOLD_MAX: usize = 50;

/// Markdown for `$GITHUB_STEP_SUMMARY`: verdict, scores, figures, the worst findings, and all of them
/// counted by code. `rest` names where all are listed, such as an artefact.
pub fn step_summary(report: &Report, rest: &str) -> String {
    let all = Tally::of(report.findings.iter());
    let sign = match report.verdict {
        Verdict::Feasible => "✅",
        Verdict::Infeasible => "❌",
    };
    let mut page = format!(
        "## {sign} {}: {}\n\n{}.\n\n",
        tables::plain(&report.name, 200),
        tables::verdict(report),
        all.words(),
    );
    page.push_str(&tables::families(report));
    page.push_str(&format!("\n### Key figures\n\n{}\n", tables::figures(report)));
    let counted: Vec<&Finding> = worst_first(report)
        .into_iter()
        .map(|place| &report.findings[place])
        .filter(|finding| finding.allowed.is_none())
        .collect();
    if !counted.is_empty() {
        page.push_str("### Worst findings\n\n");
        page.push_str(&tables::findings(report, counted.iter().copied().take(TOLD_MAX)));
        if let Some(more @ 1..) = counted.len().checked_sub(TOLD_MAX) {
            page.push_str(&format!("\nand {more} more, in {}.\n", tables::plain(rest, 200)));
        }
        page.push('\n');
    }
    if let Some(chart) = mermaid::over_time(report) {
        page.push_str(&format!("{chart}\n"));
    }
    if !report.findings.is_empty() {
        page.push_str(&format!("### All findings by code\n\n{}\n", tables::by_code(report)));
    }
    page
}
