//! The joint path of the whole program with its times.
//!
//! | phase | how the arm moves | speed |
//! |---|---|---|
//! | print | along the strand, posture from the ladder search | the asked TCP speed |
//! | approach, retract | straight along the nozzle's axis | travel speed |
//! | transit | lift over the deposit, straight in joint space in between | travel speed, joint limits |
//!
//! A job that brings its own joint path is followed as given; nothing is replanned. Speeds are
//! constant within a phase: ramps and blending are not modelled, and the report says so.

mod between;
mod check;
mod ladder;
mod strand;
#[cfg(test)]
mod tests;

pub use check::{StrandMotion, check};

use crate::cell::{Job, Step};
use crate::finding::Phase;
use crate::kinematics::{Arm, Coverage, IkOptions, Posture, Solution};
use crate::pose::{self, Point, Pose, Vector};
use crate::toolpath::Path;

/// One instant of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Time from the start of the program, s.
    pub time_s: f64,
    /// Arc length on the strand, m; zero off it.
    pub at_m: f64,
    /// Joint values, rad or m.
    pub q: Posture,
}

/// A stretch of motion of one phase.
#[derive(Debug, Clone, PartialEq)]
pub struct Leg {
    /// What the arm is doing.
    pub phase: Phase,
    /// The strand it belongs to, as index in the job; a transit belongs to the strand it leads to.
    pub strand: Option<usize>,
    /// Number of strands printed before it.
    pub printed: usize,
    /// Its instants in order; may be empty where nothing could be reached.
    pub moments: Vec<Moment>,
    /// Places of the strand that no posture reaches: arc length and point in part axes.
    pub unreached: Vec<(f64, Point)>,
}

/// When a strand is printed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Printing {
    /// Index of the strand in the job.
    pub strand: usize,
    /// Start of its extrusion, s.
    pub start_s: f64,
    /// End of its extrusion, s.
    pub end_s: f64,
}

/// The motion of the whole program.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Stretches in order of time.
    pub legs: Vec<Leg>,
    /// The strands in printing order.
    pub printings: Vec<Printing>,
    /// Releases of forms: form, number of strands printed before, time.
    pub releases: Vec<(usize, usize, f64)>,
    /// Length of the program, s.
    pub total_s: f64,
}

/// Plans the motion of a job along `paths` (one per strand of the job, in its order).
pub fn plan(job: &Job, paths: &[Path]) -> Motion {
    let mut planner = Planner {
        job,
        arm: &job.cell.robot.arm,
        motion: Motion {
            legs: Vec::new(),
            printings: Vec::new(),
            releases: Vec::new(),
            total_s: 0.0,
        },
        at: Posture::new(&job.cell.home),
        top_m: 0.0,
    };
    let order: Vec<usize> = job.print_order().collect();
    let mut ladders = Vec::new();
    for step in &job.steps {
        match step {
            Step::Print(strand) => {
                // Ladders are large: they are made for a batch of strands and dropped after it.
                let done = planner.motion.printings.len();
                if done.is_multiple_of(BATCH) {
                    let batch = &order[done..order.len().min(done + BATCH)];
                    ladders = ladder::rungs_of(job, paths, batch);
                }
                planner.print(&paths[*strand], &ladders[done % BATCH]);
            }
            Step::Move(rows) => planner.follow(rows),
            Step::Wait(wait_s) => planner.motion.total_s += wait_s,
            Step::Release(form) => {
                let printed = planner.motion.printings.len();
                planner.motion.releases.push((*form, printed, planner.motion.total_s));
            }
            Step::Checkpoint(_) => {}
        }
    }
    planner.motion
}

/// Strands whose ladders are made at once, in parallel.
const BATCH: usize = 64;

/// The state of planning: where the arm is, how high the deposit stands.
struct Planner<'a> {
    job: &'a Job,
    arm: &'a Arm,
    motion: Motion,
    at: Posture,
    /// Highest point printed so far, along the bed's z, m.
    top_m: f64,
}

impl Planner<'_> {
    fn print(&mut self, path: &Path, ladder: &ladder::Ladder) {
        let postures = strand::postures(self.job, path, ladder, &self.at);
        let Some((first, last)) = postures.ends() else {
            self.leg(Phase::Print, Some(path.strand), Vec::new(), postures.unreached);
            let now = self.motion.total_s;
            self.motion.printings.push(Printing { strand: path.strand, start_s: now, end_s: now });
            return;
        };
        let settings = &self.job.strands[path.strand].settings;
        let (start, end) = (&path.samples[first], &path.samples[last]);
        let q_start = postures.q[first].expect("the first reached sample has a posture");
        let approach = self.straight(start, &q_start, settings.approach_m);
        let q_above = approach.last().copied().unwrap_or(q_start);
        self.transit(path.strand, &q_above);
        self.cartesian(
            Phase::Approach,
            path.strand,
            approach.iter().rev().copied().chain([q_start]),
        );
        self.extrude(path, &postures);
        let q_end = postures.q[last].expect("the last reached sample has a posture");
        let retract = self.straight(end, &q_end, settings.retract_m);
        self.cartesian(Phase::Retract, path.strand, [q_end].into_iter().chain(retract));
        let up = |point: &Point| (self.job.bed_from_part * point).z;
        let points = self.job.strands[path.strand].points.iter();
        self.top_m = points.map(up).fold(self.top_m, f64::max);
    }

    fn extrude(&mut self, path: &Path, postures: &strand::Postures) {
        let strand = &self.job.strands[path.strand];
        self.motion.total_s += strand.settings.prime_s + strand.start.dwell_s;
        let start_s = self.motion.total_s;
        let times = strand::times(strand, path);
        let moments =
            path.samples.iter().zip(&times).zip(&postures.q).filter_map(|((sample, time_s), q)| {
                q.map(|q| Moment { time_s: start_s + time_s, at_m: sample.at_m, q })
            });
        self.leg(Phase::Print, Some(path.strand), moments.collect(), postures.unreached.clone());
        self.motion.total_s = start_s + times.last().copied().unwrap_or(0.0);
        let end_s = self.motion.total_s;
        self.motion.total_s += strand.end.dwell_s;
        self.motion.printings.push(Printing { strand: path.strand, start_s, end_s });
    }

    fn leg(
        &mut self,
        phase: Phase,
        strand: Option<usize>,
        moments: Vec<Moment>,
        unreached: Vec<(f64, Point)>,
    ) {
        if let Some(last) = moments.last() {
            self.at = last.q;
        }
        let printed = self.motion.printings.len();
        self.motion.legs.push(Leg { phase, strand, printed, moments, unreached });
    }
}

/// Pose of the tool in bed axes for a place in part axes; `spin_rad` turns about the nozzle's axis
/// from the bed's x.
fn bed_from_tool(job: &Job, point: Point, nozzle: Vector, spin_rad: f64) -> Pose {
    let bed_from_part = &job.bed_from_part;
    let axis = bed_from_part * nozzle;
    let unspun = pose::from_z_axis(bed_from_part * point, axis, Vector::x());
    unspun * nalgebra::UnitQuaternion::from_axis_angle(&Vector::z_axis(), spin_rad)
}

/// All postures that put the nozzle there.
fn solve(
    job: &Job,
    point: Point,
    nozzle: Vector,
    spin_rad: f64,
    elbow_rad: f64,
    seed: Option<&[f64]>,
    out: &mut Vec<Solution>,
) -> Coverage {
    let target = job.cell.world_from_tip(&bed_from_tool(job, point, nozzle, spin_rad));
    let coverage = job.cell.robot.arm.inverse(&target, &IkOptions { seed, elbow_rad }, out);
    // A machine that cannot turn answers for the place alone.
    out.retain(|solution| solution.rotation_error_rad <= ORIENTATION_RAD);
    coverage
}

/// Orientation of the nozzle is kept to this, rad: far below what a print would show.
const ORIENTATION_RAD: f64 = 1e-3;
