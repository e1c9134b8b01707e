//! Moves between strands that hit nothing, planned in joint space.
//!
//! | attempt | way |
//! |---|---|
//! | direct | one straight joint move |
//! | along | out along the nozzle's axis at either end, a joint move between |
//! | over | up over the deposit at either end, a joint move between |
//! | home | through the cell's home |
//! | search | RRT-Connect from both ends, made shorter, corners rounded |
//!
//! Of the straight attempts that are clear the quickest is taken. All are first asked to keep twice
//! the clearance limit, since the deposit is planned against as it should be and judged as it was
//! printed, and then the limit itself. Planning is bounded in questions asked and seeded by the
//! place in the program: never by the clock, so the same job gives the same motion on any machine
//! and any number of threads.

mod arena;
mod ask;
mod leave;
mod metric;
mod random;
mod reason;
mod rrt;
mod shortcut;
#[cfg(test)]
mod tests;
mod ways;

use rayon::prelude::*;

use arena::Arena;
use metric::{Metric, Room};

pub(super) use leave::{Place, away_from, leave};
#[cfg(test)]
pub(crate) use reason::End;
pub(crate) use reason::Reason;
pub(super) use reason::tell;
pub(super) use ways::Exit;

use super::between;
use crate::cell::Job;
use crate::clearance::Blocked;
use crate::kinematics::Posture;

/// Questions that all searches of a program may ask together, and one may ask at least and most.
const CHECKS_TOTAL: usize = 20_000;
const CHECKS_LEAST: usize = 150;
const CHECKS_MOST: usize = 4_000;

/// A move to be planned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Task {
    /// The strand it leads to, as index in the job; `None`: home, at the end of the program.
    pub(crate) strand: Option<usize>,
    /// Number of strands printed before it.
    pub(crate) printed: usize,
    /// Number of forms released before it.
    pub(crate) released: usize,
    /// Highest point printed before it, along the bed's z, m; `None` before anything is printed.
    pub(crate) top_m: Option<f64>,
    /// Where the arm is.
    pub(crate) from: Posture,
    /// Where it shall be.
    pub(crate) to: Posture,
}

/// How a way was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum How {
    /// One straight joint move.
    Direct,
    /// Out along the nozzle's axis first.
    Along,
    /// Up over the deposit first.
    Over,
    /// Through the cell's home.
    Home,
    /// By search.
    Search,
}

/// A move between strands.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Transit {
    /// Postures from the first to the last; straight joint moves between them.
    pub(crate) way: Vec<Posture>,
    /// How it was found; `None`: it was not, and the way is the one over the deposit, unplanned.
    pub(crate) how: Option<How>,
    /// Clearance that every move of it keeps, m; zero where none was found.
    pub(crate) keeps_m: f64,
    /// Questions asked.
    pub(crate) n_checks: usize,
    /// Why none was found.
    pub(crate) reason: Option<Reason>,
}

/// Whether a straight move in joint space of this task keeps a clearance, m.
pub(crate) type FreeOf<'a> =
    dyn Fn(&Task, &Posture, &Posture, f64) -> Result<(), Blocked> + Sync + 'a;

/// Plans all moves between strands, in parallel.
///
/// First the straight attempts of all; what stays open shares the questions that searches may ask.
pub(crate) fn plan(job: &Job, tasks: &[Task], free: &FreeOf<'_>) -> Vec<Transit> {
    let metric = Metric::of(job);
    let limit_m = job.limits.clearance_m;
    let home = Posture::new(&job.cell.home);
    let chain = &job.cell.robot.arm.chain;
    let with_arena = |task: &Task, act: &dyn Fn(&Arena<'_>) -> Option<Transit>| {
        let free = |a: &Posture, b: &Posture, need_m: f64| free(task, a, b, need_m);
        let exits = |q: &Posture| between::exits(job, q, task.top_m);
        let room = Room::new(chain, job.limits.joint_margin_rad, &[task.from, task.to, home]);
        let (from, to) = (task.from, task.to);
        act(&Arena { metric: &metric, room, from, to, home, limit_m, free: &free, exits: &exits })
    };
    let straight: Vec<Option<Transit>> =
        tasks.par_iter().map(|task| with_arena(task, &|arena| arena.straight())).collect();
    let n_open = straight.iter().filter(|found| found.is_none()).count();
    let checks_max = (CHECKS_TOTAL / n_open.max(1)).clamp(CHECKS_LEAST, CHECKS_MOST);
    let found = straight.into_par_iter().zip(tasks).enumerate().map(|(seed, (found, task))| {
        let search = |arena: &Arena<'_>| Some(arena.search(seed as u64, checks_max));
        found.or_else(|| with_arena(task, &search)).unwrap_or_else(|| {
            unreachable!("a search ends with a way or a reason");
        })
    });
    found.collect()
}
