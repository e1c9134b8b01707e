//! GitLab's code quality report.

use serde_json::json;

use super::shared::{fingerprints, job_path, worst_first};
use crate::line::one_line;
use crate::parts::{Report, Severity};

/// Findings listed at most, worst first.
const FINDINGS_MAX: usize = 10_000;

/// A list of degradations; fingerprints do not depend on lines or numbers. What is let pass is left out.
pub fn gitlab(report: &Report, root: &str) -> String {
    let path = one_line(&job_path(report, root), 1000);
    let prints = fingerprints(report, root);
    let listed = worst_first(report)
        .into_iter()
        .filter(|&place| report.findings[place].allowed.is_none())
        .take(FINDINGS_MAX);
    let entries: Vec<serde_json::Value> = listed
        .map(|place| {
            let finding = &report.findings[place];
            let title = one_line(&finding.title, 200);
            let message = one_line(&finding.message, 1000);
            json!({
                "description": format!("{title}: {message}"),
                "check_name": one_line(&finding.code, 16),
                "fingerprint": prints[place],
                "severity": match finding.severity {
                    Severity::Error => "critical",
                    Severity::Warning => "minor",
                },
                "location": {
                    "path": path,
                    "lines": { "begin": finding.line.unwrap_or(1).max(1) },
                },
            })
        })
        .collect();
    let mut text = serde_json::Value::from(entries).to_string();
    text.push('\n');
    text
}
