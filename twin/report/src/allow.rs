//! Findings that are let pass, and what makes a check fail.

use slam::document::Allowance;

use crate::Baseline;
use crate::parts::{Allowed, Finding, Report, Severity};

/// Marks the findings that the job's `allow` lets pass on the day `today` (`YYYY-MM-DD`), and gives a
/// sentence on each entry that has run out or that no finding answers to.
///
/// Verdict and score stay what physics says. The first entry that holds speaks where several do.
pub fn apply_allowances(report: &mut Report, allowances: &[Allowance], today: &str) -> Vec<String> {
    if !slam::is_date(today) {
        return vec![format!("`{today}` is no day, so no finding is let pass")];
    }
    let mut sentences = Vec::new();
    for allowance in allowances {
        let until = &allowance.until.value;
        // days written so sort as they come
        let holds = slam::is_date(until) && today <= until.as_str();
        let mut matching =
            report.findings.iter_mut().filter(|it| concerns(allowance, it)).peekable();
        let what = what(allowance);
        if matching.peek().is_none() {
            sentences.push(format!(
                "{what} is allowed until {until}, but not found: take the entry out"
            ));
        } else if !holds {
            sentences.push(format!("{what} was allowed until {until}; it counts again"));
        } else {
            let allowed = Allowed { reason: allowance.reason.value.clone(), until: until.clone() };
            for finding in matching.filter(|finding| finding.allowed.is_none()) {
                finding.allowed = Some(allowed.clone());
            }
        }
    }
    sentences
}

fn concerns(allowance: &Allowance, finding: &Finding) -> bool {
    let strand = allowance.strand.as_ref().map(|strand| &strand.value);
    finding.code == allowance.code.value
        && (strand.is_none() || finding.site.strand.as_ref() == strand)
}

fn what(allowance: &Allowance) -> String {
    match &allowance.strand {
        Some(strand) => format!("{} on strand `{}`", allowance.code.value, strand.value),
        None => allowance.code.value.clone(),
    }
}

/// Whether a finding of this severity or worse stands that is neither let pass nor in the baseline.
pub fn fails(report: &Report, least: Severity, baseline: Option<&Baseline>) -> bool {
    report.findings.iter().any(|finding| {
        let is_bad = least == Severity::Warning || finding.severity == Severity::Error;
        let is_known = baseline.is_some_and(|baseline| baseline.knows(finding));
        is_bad && finding.allowed.is_none() && !is_known
    })
}
