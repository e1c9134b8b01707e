//! The score: the worst margin, never an average.

use super::register::Family;

/// Whether anything stops the job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// No finding is an error.
    Feasible,
    /// At least one is.
    Infeasible,
}

/// Score of the job and of each family: `50 + 100 · clamp(min m, −0.5, 0.5)`.
///
/// `m` is the margin of nominal values against error limits; 50 and above means feasible. A
/// family in which nothing was checked has none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Scores {
    margins: [Option<f64>; Family::ALL.len()],
}

impl Scores {
    /// Takes note of one margin.
    pub(super) fn note(&mut self, family: Family, margin: f64) {
        let worst = &mut self.margins[family as usize];
        *worst = Some(worst.map_or(margin, |known| known.min(margin)));
    }

    /// Worst margin of one family.
    pub fn margin(&self, family: Family) -> Option<f64> {
        self.margins[family as usize]
    }

    /// Score of one family.
    pub fn family(&self, family: Family) -> Option<f64> {
        self.margins[family as usize].map(score)
    }

    /// Score of the job.
    pub fn total(&self) -> Option<f64> {
        self.margins.iter().flatten().copied().reduce(f64::min).map(score)
    }
}

fn score(margin: f64) -> f64 {
    50.0 + 100.0 * margin.clamp(-0.5, 0.5)
}
