//! Proof that a job was checked and nothing stops it.

use super::Preflight;
use crate::cell::Job;
use crate::finding::Verdict;
use crate::motion::Motion;

/// A checked job. Exporters take this instead of a job, so robot code for an unchecked job does
/// not compile. Only [`Preflight::clear`] makes one.
#[derive(Debug, Clone)]
pub struct Cleared {
    job: Job,
    motion: Motion,
}

impl Preflight {
    /// The way to robot code. Hands everything back if any finding stops the job.
    ///
    /// # Errors
    /// The preflight itself, with its findings.
    pub fn clear(self) -> Result<Cleared, Box<Self>> {
        match self.verdict {
            Verdict::Feasible => Ok(Cleared { job: self.job, motion: self.motion }),
            Verdict::Infeasible => Err(Box::new(self)),
        }
    }
}

impl Cleared {
    /// The job.
    pub fn job(&self) -> &Job {
        &self.job
    }

    /// Its motion.
    pub fn motion(&self) -> &Motion {
        &self.motion
    }
}
