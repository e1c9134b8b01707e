//! The parts of a report: verdict, findings, totals, and what came from the caller.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sim::finding::Family;

use crate::frame::{Landing, LoadCase, Stage};
use crate::results::{Motion, Strand};

/// Everything the twin says about a job. SI; a number that is not there or not finite is null.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// Version of this format: `twin-report/1`.
    pub schema: String,
    /// What the job's author calls it.
    pub name: String,
    /// Whether anything stops the job.
    pub verdict: Verdict,
    /// 50 + 100 × the worst margin held to ±0.5; 50 and above is feasible.
    pub score: Option<f64>,
    /// The same for each family of findings.
    pub scores: Scores,
    /// Errors first, then by time.
    pub findings: Vec<Finding>,
    /// What became of each strand, in printing order.
    pub strands: Vec<Strand>,
    /// The frame after each strand and each release.
    pub stages: Vec<Stage>,
    /// Strand ends that meet the frame.
    pub landings: Vec<Landing>,
    /// The motion as a whole.
    pub motion: Motion,
    /// The finished part under its loads.
    pub loads: Vec<LoadCase>,
    /// Times, lengths and mass.
    pub totals: Totals,
    /// What the answer rests on.
    pub assumptions: Vec<Assumption>,
    /// What went in, and who drew.
    pub provenance: Provenance,
    /// How long the twin took.
    pub timing: Timing,
}

/// Whether anything stops the job.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// No finding is an error.
    Feasible,
    /// At least one is.
    Infeasible,
}

impl Verdict {
    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Feasible => "feasible",
            Self::Infeasible => "infeasible",
        }
    }
}

/// Score of each family; null where nothing was checked.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scores {
    /// Reach and motion.
    #[serde(rename = "R")]
    pub reach: Option<f64>,
    /// Clearance.
    #[serde(rename = "C")]
    pub clearance: Option<f64>,
    /// Process.
    #[serde(rename = "P")]
    pub process: Option<f64>,
    /// Structure.
    #[serde(rename = "S")]
    pub structure: Option<f64>,
    /// Program and controller.
    #[serde(rename = "E")]
    pub program: Option<f64>,
}

impl Scores {
    /// Score of a family.
    pub fn of(&self, family: Family) -> Option<f64> {
        match family {
            Family::Reach => self.reach,
            Family::Clearance => self.clearance,
            Family::Process => self.process,
            Family::Structure => self.structure,
            Family::Program => self.program,
        }
    }
}

/// One statement about the job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Finding {
    /// Stable code; `twin explain` prints its page.
    #[schemars(regex(pattern = "^[RCPSE][0-9]{3}$"))]
    pub code: String,
    /// How bad it is.
    pub severity: Severity,
    /// What the code means, in a few words.
    pub title: String,
    /// One sentence with the numbers.
    pub message: String,
    /// What to change.
    pub hint: String,
    /// Where.
    pub site: Site,
    /// Line of the strand in the job's text, from 1.
    pub line: Option<usize>,
    /// When, s from the start of the program.
    pub time_s: Option<f64>,
    /// What was measured.
    pub measured: Option<f64>,
    /// Low end of what it may be.
    pub low: Option<f64>,
    /// High end of what it may be.
    pub high: Option<f64>,
    /// What it was held against: the error limit, or the warning limit of a warning.
    pub limit: Option<f64>,
    /// Unit of these four: `m`, `rad`, or `1` for a ratio, a share, or yes and no.
    pub unit: String,
    /// How many places it stands for; the worst is told.
    pub count: usize,
    /// Why it is let pass for a while; null: it is not.
    pub allowed: Option<Allowed>,
}

/// Why a finding is let pass, by the job's `allow`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Allowed {
    /// The author's words.
    pub reason: String,
    /// Last day on which it is, `YYYY-MM-DD`.
    pub until: String,
}

/// How bad a finding is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The nominal value is past the limit.
    Error,
    /// The low or high end is, or a warning limit is passed.
    Warning,
}

impl Severity {
    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
        }
    }
}

/// Where a finding is; null where it is about no such thing.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Site {
    /// The strand's id.
    pub strand: Option<String>,
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
    /// The bodies concerned; may be empty.
    pub bodies: Vec<String>,
}

/// What the arm is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
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
    /// The word for it.
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

/// Sums over the whole program.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Totals {
    /// Length of the program, s.
    pub time_s: Option<f64>,
    /// Of it extruding along strands.
    pub print_s: Option<f64>,
    /// Of it resting, priming and waiting.
    pub dwell_s: Option<f64>,
    /// Of it moving without extrusion.
    pub transit_s: Option<f64>,
    /// Length of all strands, m.
    pub length_m: Option<f64>,
    /// Mass of all strands, kg.
    pub mass_kg: Option<f64>,
}

/// Something the answer rests on.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Assumption {
    /// What it concerns: a word for grouping.
    pub about: String,
    /// The assumption, one sentence.
    pub text: String,
}

/// What went in, and who drew.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// Version of the twin.
    pub twin: String,
    /// The files the answer comes from.
    pub inputs: Vec<Input>,
    /// What drew the pictures; null: none were drawn.
    pub drawn_by: Option<String>,
}

impl Provenance {
    /// Provenance of this version of the twin. An input with `what` = `job` names the file in
    /// which [`crate::human`] says a line is.
    pub fn new(inputs: Vec<Input>, drawn_by: Option<String>) -> Self {
        Self { twin: env!("CARGO_PKG_VERSION").to_owned(), inputs, drawn_by }
    }
}

/// One input.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// What it is: `job`, `cell`, `robot`, `tool`, `material`.
    pub what: String,
    /// Its name or path.
    pub name: String,
    /// SHA-256 of its bytes, in hexadecimal.
    pub sha256: String,
}

/// How long the twin took, of the clock.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Timing {
    /// Each step in order.
    pub steps: Vec<StepTime>,
    /// All of it, s.
    pub total_s: f64,
}

/// How long one step took.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StepTime {
    /// The step.
    pub step: String,
    /// Its time, s.
    pub time_s: f64,
}
