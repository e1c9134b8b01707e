//! Holding measurements against limits.

use std::collections::BTreeMap;

use super::register::{Bound, Code};
use super::score::{Scores, Verdict};
use super::{Finding, Severity, Site};
use crate::interval::Interval;

/// One measurement and what it is held against.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// What is checked.
    pub code: Code,
    /// What was measured, SI.
    pub measured: Interval,
    /// The error limit, SI.
    pub limit: f64,
    /// A limit passed before the error limit, if the code has one.
    pub warn_limit: Option<f64>,
    /// Where.
    pub site: Site,
    /// When.
    pub time_s: Option<f64>,
}

/// The sentences of a finding, made only when there is one.
pub struct Words {
    /// One sentence with the numbers.
    pub message: String,
    /// What to change.
    pub hint: String,
}

/// All that was found, folded: one finding per code, strand and bodies, with the worst value.
#[derive(Debug, Clone, Default)]
pub struct Findings {
    folded: BTreeMap<Key, Finding>,
    scores: Scores,
}

/// What makes two findings the same one. Warnings and errors fold together; the worst speaks.
type Key = (Code, Option<usize>, Option<&'static str>, Vec<String>);

impl Findings {
    /// Holds one measurement against its limit; `words` is called only if it fails.
    pub fn check(&mut self, check: Check, words: impl FnOnce() -> Words) {
        let bound = check.code.bound();
        self.scores.note(check.code.family(), margin(bound, check.measured.nominal, check.limit));
        let Some((severity, limit)) = judge(bound, &check) else { return };
        let key = (
            check.code,
            check.site.strand,
            check.site.phase.map(super::Phase::word),
            check.site.bodies.clone(),
        );
        let known = self.folded.get(&key);
        let count = known.map_or(0, |finding| finding.count) + 1;
        let worst = known.is_none_or(|finding| is_worse(bound, severity, &check.measured, finding));
        if worst {
            let Words { message, hint } = words();
            let Check { code, measured, site, time_s, .. } = check;
            let unit = code.unit();
            let finding = Finding {
                code,
                severity,
                site,
                time_s,
                measured,
                limit,
                unit,
                message,
                hint,
                count,
            };
            self.folded.insert(key, finding);
        } else if let Some(finding) = self.folded.get_mut(&key) {
            finding.count = count;
        }
    }

    /// Holds a yes-or-no question; `true` is bad. Its margin is ±0.5.
    pub fn forbid(
        &mut self,
        code: Code,
        found: bool,
        site: Site,
        time_s: Option<f64>,
        words: impl FnOnce() -> Words,
    ) {
        let measured = Interval::exact(f64::from(u8::from(found)));
        self.check(Check { code, measured, limit: 0.5, warn_limit: None, site, time_s }, words);
    }

    /// Takes over what another collector found.
    pub fn absorb(&mut self, other: Self) {
        for family in super::Family::ALL {
            if let Some(margin) = other.scores.margin(family) {
                self.scores.note(family, margin);
            }
        }
        for (key, finding) in other.folded {
            let bound = finding.code.bound();
            match self.folded.get_mut(&key) {
                Some(known) if !is_worse(bound, finding.severity, &finding.measured, known) => {
                    known.count += finding.count;
                }
                Some(known) => *known = Finding { count: known.count + finding.count, ..finding },
                None => {
                    self.folded.insert(key, finding);
                }
            }
        }
    }

    /// The findings by severity, then time, then code, then strand.
    pub fn sorted(&self) -> Vec<Finding> {
        let mut list: Vec<Finding> = self.folded.values().cloned().collect();
        list.sort_by(|a, b| {
            let time = |finding: &Finding| finding.time_s.unwrap_or(f64::INFINITY);
            (b.severity.cmp(&a.severity))
                .then(time(a).total_cmp(&time(b)))
                .then(a.code.cmp(&b.code))
                .then(a.site.strand.cmp(&b.site.strand))
        });
        list
    }

    /// The scores so far.
    pub fn scores(&self) -> Scores {
        self.scores
    }

    /// Infeasible if any finding is an error.
    pub fn verdict(&self) -> Verdict {
        let stops = self.folded.values().any(|finding| finding.severity == Severity::Error);
        if stops { Verdict::Infeasible } else { Verdict::Feasible }
    }
}

/// Distance from the limit as a share of it; negative: past it.
fn margin(bound: Bound, measured: f64, limit: f64) -> f64 {
    match bound {
        Bound::Upper => (limit - measured) / limit,
        Bound::Lower => (measured - limit) / limit,
        Bound::Forbidden => 0.5 - measured,
    }
}

/// Severity and the limit that was passed, if one was.
fn judge(bound: Bound, check: &Check) -> Option<(Severity, f64)> {
    let past = |value: f64, limit: f64| match bound {
        Bound::Upper | Bound::Forbidden => value > limit,
        Bound::Lower => value < limit,
    };
    let Interval { nominal, low, high } = check.measured;
    if past(nominal, check.limit) || !nominal.is_finite() {
        return Some((Severity::Error, check.limit));
    }
    if past(low, check.limit) || past(high, check.limit) {
        return Some((Severity::Warning, check.limit));
    }
    let warn = check.warn_limit.filter(|&warn| past(nominal, warn))?;
    Some((Severity::Warning, warn))
}

fn is_worse(bound: Bound, severity: Severity, measured: &Interval, known: &Finding) -> bool {
    let by_value = match bound {
        Bound::Upper | Bound::Forbidden => measured.nominal > known.measured.nominal,
        Bound::Lower => measured.nominal < known.measured.nominal,
    };
    severity > known.severity || (severity == known.severity && by_value)
}
