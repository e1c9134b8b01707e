//! Statements about the job: what was measured, what it was held against, where and when.

mod collect;
mod pages;
mod register;
mod score;
#[cfg(test)]
mod tests;

pub use collect::{Check, Findings, Words};
pub use register::{Bound, Code, Family};
pub use score::{Scores, Verdict};

use crate::interval::Interval;
use crate::pose::Point;

/// How bad a finding is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The low or high end is past the limit, or a warning limit is passed.
    Warning,
    /// The nominal value is past the limit.
    Error,
}

/// What the arm is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Phase {
    /// Straight way to the start of a strand.
    Approach,
    /// Extruding.
    Print,
    /// Resting at a node.
    Dwell,
    /// Straight way off the end of a strand.
    Retract,
    /// Between strands.
    Transit,
}

impl Phase {
    /// The word for it in reports.
    pub fn word(self) -> &'static str {
        match self {
            Self::Approach => "approach",
            Self::Print => "print",
            Self::Dwell => "dwell",
            Self::Retract => "retract",
            Self::Transit => "transit",
        }
    }
}

/// Where a finding is. Everything is optional: a load case has no strand, a reach has no node.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Site {
    /// Index of the strand in the job.
    pub strand: Option<usize>,
    /// Arc length from the start of the strand, m.
    pub at_m: Option<f64>,
    /// Number of strands printed so far.
    pub stage: Option<usize>,
    /// Node of the frame.
    pub node: Option<usize>,
    /// Member of the frame.
    pub member: Option<usize>,
    /// What the arm is doing.
    pub phase: Option<Phase>,
    /// The bodies concerned, by name.
    pub bodies: Vec<String>,
    /// The place in part axes, for pictures.
    pub point: Option<Point>,
    /// Where that which should be at the place is instead.
    pub found: Option<Point>,
}

impl Site {
    /// A place on a strand.
    pub fn strand(strand: usize, at_m: f64) -> Self {
        Self { strand: Some(strand), at_m: Some(at_m), ..Self::default() }
    }

    /// The same place during `phase`.
    #[must_use]
    pub fn during(mut self, phase: Phase) -> Self {
        self.phase = Some(phase);
        self
    }

    /// The same place with its coordinates in part axes.
    #[must_use]
    pub fn at(mut self, point: Point) -> Self {
        self.point = Some(point);
        self
    }

    /// The same place with the bodies concerned.
    #[must_use]
    pub fn between(mut self, bodies: [&str; 2]) -> Self {
        self.bodies = bodies.iter().map(|&body| body.to_owned()).collect();
        self
    }
}

/// `1 strand`, `3 strands`.
pub fn counted(n: usize, thing: &str) -> String {
    if n == 1 { format!("1 {thing}") } else { format!("{n} {thing}s") }
}

/// One statement about the job.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// What kind of statement it is.
    pub code: Code,
    /// How bad it is.
    pub severity: Severity,
    /// Where.
    pub site: Site,
    /// When, s from the start of the program.
    pub time_s: Option<f64>,
    /// What was measured, with the range it may have.
    pub measured: Interval,
    /// What it was held against: the error limit, or the warning limit of a warning.
    pub limit: f64,
    /// Unit of both, SI.
    pub unit: &'static str,
    /// One sentence with the numbers.
    pub message: String,
    /// What to change.
    pub hint: String,
    /// How many places this finding stands for; the worst is told.
    pub count: usize,
}
