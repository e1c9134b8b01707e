//! What differs between two reports.

mod baseline;
#[cfg(test)]
mod tests;
mod text;

use std::collections::{BTreeMap, VecDeque};

use schemars::JsonSchema;
use serde::Serialize;

pub use baseline::Baseline;

use crate::formats::shared::{by_badness, excess, identity};
use crate::metrics::{self, Metric};
use crate::parts::{Finding, Report, Verdict};
use crate::quantity::Unit;

/// What differs between report A and report B. SI.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Diff {
    /// Version of this format: `twin-diff/1`.
    pub schema: String,
    /// Report A.
    pub a: Side,
    /// Report B.
    pub b: Side,
    /// Figures, changed or not.
    pub metrics: Vec<Change>,
    /// Findings of B that A has not, worst first.
    pub added: Vec<Finding>,
    /// Findings of A that B has not, worst first.
    pub gone: Vec<Finding>,
    /// Findings of both whose severity, values or limit differ, the most worsened first.
    pub changed: Vec<Both>,
    /// How many findings of both are the same.
    pub n_same: usize,
}

/// One of the two reports.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Side {
    /// What the job's author calls it.
    pub name: String,
    /// Its verdict.
    pub verdict: Verdict,
    /// How many findings it has.
    pub n_findings: usize,
}

/// One figure in both reports.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Change {
    /// What it is.
    pub name: String,
    /// SI unit of both; `1`: a ratio or a number.
    pub unit: &'static str,
    /// In A; null: not known.
    pub a: Option<f64>,
    /// In B.
    pub b: Option<f64>,
    /// B less A.
    pub absolute: Option<f64>,
    /// That over the size of A; null: A is zero, but for rounding.
    pub relative: Option<f64>,
    /// What it is shown in.
    #[serde(skip)]
    #[schemars(skip)]
    shown: Shown,
}

/// A finding in both reports.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Both {
    /// In A.
    pub a: Finding,
    /// In B.
    pub b: Finding,
}

/// Keeps the unit of screens out of the JSON.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Shown(Unit);

impl Default for Shown {
    fn default() -> Self {
        Self(Unit::Plain)
    }
}

/// A value is zero beside one so many times larger.
const ROUNDING: f64 = 1e-9;

/// Compares two reports. Findings are the same one where code, strand, phase and bodies are.
pub fn diff(a: &Report, b: &Report) -> Diff {
    let mut left: BTreeMap<String, VecDeque<&Finding>> = BTreeMap::new();
    for finding in &a.findings {
        left.entry(identity(finding)).or_default().push_back(finding);
    }
    let (mut added, mut changed, mut n_same) = (Vec::new(), Vec::new(), 0);
    for finding in &b.findings {
        match left.get_mut(&identity(finding)).and_then(VecDeque::pop_front) {
            None => added.push(finding.clone()),
            Some(before) if says_the_same(before, finding) => n_same += 1,
            Some(before) => changed.push(Both { a: before.clone(), b: finding.clone() }),
        }
    }
    let mut gone: Vec<Finding> = left.into_values().flatten().cloned().collect();
    added.sort_by(by_badness);
    gone.sort_by(by_badness);
    changed.sort_by(|x, y| worsened(y).total_cmp(&worsened(x)));
    Diff {
        schema: "twin-diff/1".to_owned(),
        a: side(a),
        b: side(b),
        metrics: changes(a, b),
        added,
        gone,
        changed,
        n_same,
    }
}

fn side(report: &Report) -> Side {
    Side { name: report.name.clone(), verdict: report.verdict, n_findings: report.findings.len() }
}

fn says_the_same(a: &Finding, b: &Finding) -> bool {
    let numbers = |it: &Finding| [it.measured, it.low, it.high, it.limit];
    a.severity == b.severity && numbers(a) == numbers(b)
}

/// By how much more of its limit the finding is past it.
fn worsened(both: &Both) -> f64 {
    let by = excess(&both.b) - excess(&both.a);
    if by.is_nan() { 0.0 } else { by }
}

fn changes(a: &Report, b: &Report) -> Vec<Change> {
    let all = |report: &Report| [metrics::scores(report), metrics::figures(report)].concat();
    let (of_a, of_b) = (all(a), all(b));
    let value_in = |list: &[Metric], name: &str| {
        list.iter().find(|metric| metric.name == name).and_then(|metric| metric.value)
    };
    let only_in_b = of_b.iter().filter(|metric| of_a.iter().all(|known| known.name != metric.name));
    (of_a.iter().chain(only_in_b))
        .map(|metric| {
            let (a, b) = (value_in(&of_a, &metric.name), value_in(&of_b, &metric.name));
            let finite = |value: f64| value.is_finite().then_some(value);
            let absolute = a.zip(b).and_then(|(a, b)| finite(b - a));
            Change {
                name: metric.name.clone(),
                unit: metric.si,
                a,
                b,
                absolute,
                relative: absolute
                    .zip(a)
                    .filter(|(by, a)| a.abs() > ROUNDING * by.abs())
                    .and_then(|(by, a)| finite(by / a.abs())),
                shown: Shown(metric.unit),
            }
        })
        .collect()
}
