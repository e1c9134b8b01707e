//! One line per finding, for grep and editors.

use super::shared::{job_path, worst_first};
use crate::Report;
use crate::line::{allowed_words, one_line};
use crate::quantity::found;

/// `file:line: severity CODE message`, one finding a line, worst first; a finding that is let pass
/// has the severity `note`. vim: `:set errorformat=%f:%l:\ %t%*[a-z]\ %m`.
pub fn concise(report: &Report, root: &str) -> String {
    let path = one_line(&job_path(report, root), 1000);
    let mut text = String::new();
    for place in worst_first(report) {
        let finding = &report.findings[place];
        let line = finding.line.unwrap_or(1);
        let word = if finding.allowed.is_some() { "note" } else { finding.severity.word() };
        let found = found(finding).map_or_else(String::new, |found| format!(" ({found})"));
        let allowed = finding.allowed.as_ref().map_or_else(String::new, |allowed| {
            format!(" ({})", one_line(&allowed_words(allowed), 400))
        });
        let (code, message) = (one_line(&finding.code, 16), one_line(&finding.message, 1000));
        text.push_str(&format!("{path}:{line}: {word} {code} {message}{found}{allowed}\n"));
    }
    text
}
