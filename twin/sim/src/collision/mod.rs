//! Clearance of tool, arm, bed and fixtures, against the deposit and against each other.
//!
//! | pair | code |
//! |---|---|
//! | nozzle, other tool parts – earlier strands | C201, C202 |
//! | arm links – strands | C203 |
//! | nozzle and tool – strand in progress | C204 |
//! | tool, arm, moving bed and what rides on it – bed, forms, fixtures | C205 |
//! | arm, tool, moving bed with its forms – arm itself, torso, other arm | C206 |
//! | orifice – earlier beads, while printing | C208 |
//!
//! Every pair is covered over every leg, not sampled ([`crate::clearance`]): what is told was found
//! at a real instant, and no clearance anywhere on the leg is less than that by more than the
//! resolution told with it. Beads are tested at full width into nodes and crossings. What may
//! touch is stated by the *touch zone* of the cell and nothing else.

mod leg;
mod plough;
#[cfg(test)]
mod tests;
mod words;

use rayon::prelude::*;

use crate::cell::Job;
use crate::clearance::{Bodies, Space};
use crate::deposit::{Contact, Deposit};
use crate::finding::{Check, Code, Findings, Phase, Site};
use crate::interval::Interval;
use crate::motion::Motion;
use crate::pose::Point;

pub use crate::clearance::RESOLUTION_M;

/// Smallest clearance found, with its pair.
#[derive(Debug, Clone, PartialEq)]
pub struct Nearest {
    /// Clearance, m; negative: overlap. It is taken at `time_s`.
    pub clearance_m: f64,
    /// No clearance of this pair on its leg is less than that by more than this, m: what the cover
    /// leaves open, and how far the lines of the controller may lie off our path.
    pub resolution_m: f64,
    /// Stated accuracy of the arm, m; comes on top.
    pub accuracy_m: f64,
    /// The two bodies.
    pub bodies: [String; 2],
    /// What the arm is doing.
    pub phase: Phase,
    /// The strand it belongs to, as index in the job.
    pub strand: Option<usize>,
    /// Arc length on that strand, m; zero off it.
    pub at_m: f64,
    /// When, s.
    pub time_s: f64,
    /// The orifice then, in part axes.
    pub point: Point,
}

/// Judges every leg of the motion; legs are looked at in parallel, findings kept in order.
///
/// The smallest clearance of all, and that of each leg, m: `None` where nothing came nearer than twice the limit.
pub fn check(
    job: &Job,
    motion: &Motion,
    deposit: &Deposit,
    contacts: &[Contact],
    findings: &mut Findings,
) -> (Option<Nearest>, Vec<Option<f64>>) {
    let bodies = Bodies::new(job);
    let space = Space::new(job, &bodies, deposit);
    let mut by_order: Vec<Vec<&Contact>> = vec![Vec::new(); deposit.strands.len()];
    for contact in contacts {
        contact.orders.iter().for_each(|&order| by_order[order].push(contact));
    }
    let order_of = deposit.order_of(job.strands.len());
    let parts: Vec<leg::Found> = motion
        .legs
        .par_iter()
        .map(|leg| {
            let order = leg.strand.and_then(|strand| order_of[strand]);
            leg::Look::new(&space, motion, leg, order, &by_order).judged()
        })
        .collect();
    if motion.legs.iter().any(|leg| !leg.moments.is_empty()) {
        far(job, findings);
    }
    let mut nearest: Option<Nearest> = None;
    let by_leg_m =
        parts.iter().map(|(_, near)| near.as_ref().map(|near| near.clearance_m)).collect();
    for (found, near) in parts {
        findings.absorb(found);
        nearest = nearer(nearest, near);
    }
    plough::check(job, deposit, findings);
    (nearest, by_leg_m)
}

/// What is further apart than the horizon was looked at too, and scores as that far.
fn far(job: &Job, findings: &mut Findings) {
    let limit = job.limits.clearance_m;
    let check = Check {
        code: Code::C201,
        measured: Interval::exact(2.0 * limit),
        limit,
        warn_limit: None,
        site: Site::default(),
        time_s: None,
    };
    findings.check(check, || unreachable!("twice the limit passes"));
}

fn nearer(a: Option<Nearest>, b: Option<Nearest>) -> Option<Nearest> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.clearance_m < a.clearance_m { b } else { a }),
        (a, b) => a.or(b),
    }
}
