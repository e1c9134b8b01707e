//! Annotations of GitHub's workflow runs.

use super::shared::{Tally, job_path, worst_first};
use crate::line::one_line;
use crate::parts::{Finding, Report, Severity};
use crate::quantity::{counted, found};

/// GitHub shows so many annotations of each kind per step and drops the rest in silence.
const SHOWN_MAX: usize = 10;

/// Workflow commands for the worst ten errors and ten warnings, and a last one that says how many
/// more there are and where; `rest` names that place, such as the step summary. What is let pass is
/// counted there alone.
pub fn github(report: &Report, root: &str, rest: &str) -> String {
    let path = property(&one_line(&job_path(report, root), 1000));
    let mut text = String::new();
    let mut shown = Tally::default();
    for place in worst_first(report) {
        let finding = &report.findings[place];
        let n_shown = match finding.severity {
            Severity::Error => &mut shown.errors,
            Severity::Warning => &mut shown.warnings,
        };
        if finding.allowed.is_some() || *n_shown == SHOWN_MAX {
            continue;
        }
        *n_shown += 1;
        text.push_str(&annotation(finding, &path));
    }
    if let Some(more) = more(report, shown) {
        let rest = data(&one_line(rest, 200));
        text.push_str(&format!("::notice title=twin::{}; see {rest}\n", data(&more)));
    }
    text
}

fn annotation(finding: &Finding, path: &str) -> String {
    let word = finding.severity.word();
    let title = property(&one_line(&format!("{} {}", finding.code, finding.title), 200));
    let line = finding.line.unwrap_or(1);
    let mut message = vec![one_line(&finding.message, 1000)];
    message.extend(found(finding).map(|found| format!("found: {found}")));
    if !finding.hint.is_empty() {
        message.push(format!("hint: {}", one_line(&finding.hint, 1000)));
    }
    let message = data(&message.join("\n"));
    format!("::{word} title={title},file={path},line={line}::{message}\n")
}

/// What is not shown, if anything is.
fn more(report: &Report, shown: Tally) -> Option<String> {
    let all = Tally::of(report.findings.iter());
    let mut parts = Vec::new();
    for (count, what) in [
        (all.errors - shown.errors, "more error"),
        (all.warnings - shown.warnings, "more warning"),
        (all.allowed, "allowed finding"),
    ] {
        if count > 0 {
            parts.push(counted(count, what));
        }
    }
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// The text of a command.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// The value of a property of a command.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
