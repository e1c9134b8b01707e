//! Program-level judgement: is the true speed the asked one, do the drives carry it, do hoses and
//! payload go with it, how long does it take, what do errors of calibration do.
//!
//! Each file is one question: measure from plain values, then hold against the limit. Nothing here
//! plans or changes the motion.

mod budget;
mod cycle;
mod drive;
mod hose;
mod payload;
mod speed;
#[cfg(test)]
mod tests;

pub use budget::{Contribution, ErrorSource, Meeting, StrandBudget, budget, judge_budget};
pub use cycle::{CycleTimes, cycle, judge_cycle};
pub use drive::{DriveLoad, DrivePeak, judge_drives};
pub use hose::{HoseUse, Pull, hoses, judge_hoses};
pub use payload::{Payload, judge_payload};
pub use speed::{SpeedExtreme, StrandSpeed, judge_speeds, speeds};

use crate::cell::Job;
use crate::finding::Phase;
use crate::pose::Point;

/// Place of the orifice in part axes in posture `q`.
fn orifice(job: &Job, q: &[f64]) -> Point {
    job.part_from_tool(q) * Point::origin()
}

/// Where in the program something happens, in words.
fn place(job: &Job, phase: Phase, strand: Option<usize>, at_m: f64) -> String {
    let Some(strand) = strand.map(|strand| &job.strands[strand].id) else {
        return "in a given move".to_owned();
    };
    match phase {
        Phase::Approach => format!("approaching strand `{strand}`"),
        Phase::Print => format!("printing strand `{strand}` at {:.1} mm", at_m * 1e3),
        Phase::Dwell => format!("at rest on strand `{strand}`"),
        Phase::Retract => format!("leaving strand `{strand}`"),
        Phase::Transit => format!("in the transit to strand `{strand}`"),
    }
}
