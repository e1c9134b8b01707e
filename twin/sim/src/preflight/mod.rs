//! The one entry: a resolved job in, everything the twin can say about it out.
//!
//! [`preflight`] reads top to bottom as the path of the data.

mod bonding;
mod clear;
mod course;
mod deformed;
mod fallen;
mod judging;
mod lighting;
mod making;
mod program;
mod reheating;
mod rules;
mod slower;
#[cfg(test)]
mod tests_moments;
#[cfg(test)]
mod tests_slower;
mod totals;
mod tracking;

pub use bonding::Bond;
pub use clear::Cleared;
pub use deformed::deformed;
pub use fallen::fallen;
pub use making::StrandResult;
pub use program::Program;
pub use reheating::Reheated;
pub use totals::{Assumption, Totals};
pub use tracking::{SETTLED_M, Tracking};

use crate::cell::Job;
use crate::collision::{self, Nearest};
use crate::deposit::{self, Contact, Deposit};
use crate::finding::{Finding, Findings, Scores, Verdict};
use crate::growth::{self, Growth, Printed};
use crate::motion::{self, MapOf, Motion, StrandMotion};
use crate::structure::SolveError;
use crate::toolpath::{self, Path};

/// What the twin is doing, for a progress bar.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// Sampling strands.
    Toolpath,
    /// Searching postures, timing the program.
    Motion,
    /// Heat or light, cure, sag, shrinkage of each strand.
    Process,
    /// Solving every stage of the frame.
    Structure,
    /// Measuring clearance.
    Collision,
}

impl Step {
    /// All steps in order.
    pub const ALL: [Self; 5] =
        [Self::Toolpath, Self::Motion, Self::Process, Self::Structure, Self::Collision];

    /// The word for it on a screen.
    pub fn word(self) -> &'static str {
        match self {
            Self::Toolpath => "sampling strands",
            Self::Motion => "searching postures",
            Self::Process => "printing strands",
            Self::Structure => "solving stages",
            Self::Collision => "measuring clearance",
        }
    }
}

/// A job with everything that was found in it. Only [`preflight`] makes one.
#[derive(Debug, Clone)]
pub struct Preflight {
    job: Job,
    /// Strands by arc length, in the job's order.
    pub paths: Vec<Path>,
    /// The joint path of the program.
    pub motion: Motion,
    /// What the arm does along each strand, in the job's order.
    pub strand_motion: Vec<Option<StrandMotion>>,
    /// What was printed.
    pub deposit: Deposit,
    /// Where beads touch.
    pub contacts: Vec<Contact>,
    /// What became of each strand, in printing order.
    pub strands: Vec<StrandResult>,
    /// The weakest bond of each to earlier ones, in printing order.
    pub bonds: Vec<Option<Bond>>,
    /// Where later strands warm each strand again, in printing order.
    pub reheats: Vec<Option<Reheated>>,
    /// The frame by stages, landings and loads.
    pub growth: Growth,
    /// Smallest clearance measured.
    pub nearest: Option<Nearest>,
    /// Smallest clearance on each leg of the motion, m; `None`: nothing came nearer than twice the limit.
    pub clearance_by_leg_m: Vec<Option<f64>>,
    /// What the program asks of the arm beyond its path.
    pub program: Program,
    /// Times, lengths and mass.
    pub totals: Totals,
    /// What the answer rests on.
    pub assumptions: Vec<Assumption>,
    findings: Vec<Finding>,
    scores: Scores,
    verdict: Verdict,
}

impl Preflight {
    /// The job.
    pub fn job(&self) -> &Job {
        &self.job
    }

    /// The findings by severity, then time, then code.
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// Score of the job and of each family.
    pub fn scores(&self) -> Scores {
        self.scores
    }

    /// What a spin map asks of.
    pub fn map_of(&self) -> MapOf<'_> {
        MapOf {
            job: &self.job,
            paths: &self.paths,
            motion: &self.motion,
            deposit: &self.deposit,
            contacts: &self.contacts,
        }
    }

    /// Whether anything stops the job.
    pub fn verdict(&self) -> Verdict {
        self.verdict
    }
}

/// Runs the twin on a job; `progress` is told each step as it begins.
///
/// The same job gives the same answer on any number of threads.
///
/// # Errors
/// A frame too large to solve. Everything else that is wrong with a job is a finding.
pub fn preflight(job: Job, mut progress: impl FnMut(Step)) -> Result<Preflight, SolveError> {
    let mut findings = Findings::default();

    progress(Step::Toolpath);
    let paths = toolpath::paths(&job);

    progress(Step::Motion);
    let motion = motion::plan(&job, &paths);
    let strand_motion = motion::check(&job, &paths, &motion, &mut findings);

    progress(Step::Process);
    // The bead is made by the speed the orifice really has.
    let moved = motion::as_moved(&paths, &motion);
    let strands = making::make(&job, &moved, &motion, &mut findings);
    let deposit = making::as_printed(&job, &motion, &strands);
    let contacts = deposit::contacts(&deposit);
    let each_bond = bonding::bonds(&job, &deposit, &contacts, &strands);
    let bonds = bonding::weakest(&contacts, &each_bond, strands.len());
    let reheats = reheating::reheats(&job, &deposit, &contacts, &strands);
    bonding::judge(&job, &deposit, &strands, &bonds, &mut findings);
    rules::idle(&job, &motion.printings, &mut findings);

    progress(Step::Structure);
    let laws: Vec<growth::StrandLaw> =
        strands.iter().map(|strand| making::law(&job, strand)).collect();
    let printed = Printed {
        deposit: &deposit,
        contacts: &contacts,
        bonds: &bonding::for_frame(&job, &each_bond),
        laws: &laws,
        motion: &motion,
    };
    let growth = growth::grow(&job, &printed, &mut findings)?;

    progress(Step::Collision);
    let (nearest, clearance_by_leg_m) =
        collision::check(&job, &motion, &deposit, &contacts, &mut findings);

    let totals = totals::totals(&job, &motion, &paths, &strands);
    let program =
        program::check(&job, &paths, &motion, &deposit, &contacts, &totals, &mut findings);
    let assumptions = totals::assumptions(&job, &growth);
    let (scores, verdict) = (findings.scores(), findings.verdict());
    let findings = findings.sorted();
    Ok(Preflight {
        job,
        paths,
        motion,
        strand_motion,
        deposit,
        contacts,
        strands,
        bonds,
        reheats,
        growth,
        nearest,
        clearance_by_leg_m,
        program,
        totals,
        assumptions,
        findings,
        scores,
        verdict,
    })
}
