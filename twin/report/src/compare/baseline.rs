//! Findings that were there before.

use std::collections::BTreeMap;

use crate::formats::shared::identity;
use crate::parts::{Finding, Report, Severity};

/// What an older report found, by what it is about: code, strand, phase and bodies.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Baseline {
    worst: BTreeMap<String, Severity>,
}

impl Baseline {
    /// The findings of an older report, let pass or not.
    pub fn of(older: &Report) -> Self {
        let mut worst = BTreeMap::new();
        for finding in &older.findings {
            let known = worst.entry(identity(finding)).or_insert(finding.severity);
            if finding.severity == Severity::Error {
                *known = Severity::Error;
            }
        }
        Self { worst }
    }

    /// Whether the finding was there before and at least as bad in kind: a warning that became an
    /// error is new, an error with a worse value is not.
    pub fn knows(&self, finding: &Finding) -> bool {
        let known = self.worst.get(&identity(finding));
        known == Some(&Severity::Error) || known == Some(&finding.severity)
    }

    /// The findings of a report that are not in the baseline, worst first.
    pub fn new_in<'a>(&self, report: &'a Report) -> Vec<&'a Finding> {
        let order = crate::formats::shared::worst_first(report).into_iter();
        order.map(|at| &report.findings[at]).filter(|finding| !self.knows(finding)).collect()
    }
}
