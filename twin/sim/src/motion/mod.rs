//! The joint path of the whole program with its times.
//!
//! | phase | how the arm moves | speed |
//! |---|---|---|
//! | print | along the strand, posture from the ladder search | the asked TCP speed |
//! | approach, retract | straight along the nozzle's axis, or another way where that is not clear | travel speed |
//! | transit | in joint space, clear of all that is there ([`transit`]) | travel speed, joint limits |
//!
//! A job that brings its own joint path is followed as given; nothing is replanned. Speeds are
//! constant within a phase: ramps and blending are not modelled, and the report says so.

mod between;
mod check;
mod climb;
mod clock;
mod cost;
mod drives;
mod given;
mod ladder;
mod map;
mod measure;
mod place;
mod planned;
mod refine;
mod rides;
mod set_tool;
mod strand;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_given;
#[cfg(test)]
mod tests_search;
#[cfg(test)]
mod tests_set_tool;
#[cfg(test)]
mod tests_speed;
mod tilt;
mod transit;
mod true_speed;
mod walk;

pub use check::check;
pub use drives::{Load, Need};
pub use map::{Across, MapOf, MapState, SpinMap, spin_map};
pub use measure::{Spot, StrandMotion};
pub use rides::Ride;
pub use true_speed::{as_moved, orifice_speed};

use crate::cell::{Job, Step};
use crate::clearance::Bodies;
use crate::deposit::Deposit;
use crate::finding::Phase;
use crate::kinematics::{Arm, Posture, Solution};
use crate::pose::{self, Point, Pose, Vector};
use crate::toolpath::{Path, Sample};

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
    /// What prints ask of the drives at the asked speed: the worst of each kind per strand.
    pub needs: Vec<Need>,
    /// How the bed moves, where it rides on the arm, in order of time.
    pub rides: Vec<Ride>,
    /// True speed of the orifice after every sample of every strand, m/s; empty where nothing is
    /// reached.
    pub speeds_m_s: Vec<Vec<f64>>,
    /// Length of the program, s.
    pub total_s: f64,
    /// Moves that no clear way was found for.
    pub(crate) lost: Vec<Lost>,
}

/// A move that no clear way was found for, and why.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Lost {
    /// Index of its leg.
    pub(crate) leg: usize,
    pub(crate) reason: transit::Reason,
}

/// A stretch of motion that has no times yet.
#[derive(Debug, Clone)]
struct Way {
    phase: Phase,
    strand: Option<usize>,
    printed: usize,
    stations: Vec<Station>,
    unreached: Vec<(f64, Point)>,
}

/// One posture of a way.
#[derive(Debug, Clone, Copy)]
struct Station {
    at_m: f64,
    q: Posture,
}

/// What the program does, in order.
#[derive(Debug, Clone)]
enum Act {
    Go(Way),
    Wait(f64),
    Release(usize),
}

/// Plans the motion of a job along `paths` (one per strand of the job, in its order).
pub fn plan(job: &Job, paths: &[Path]) -> Motion {
    let mut acts = along_strands(job, paths);
    let lost = between::plan_moves(job, &planned::deposit(job), &mut acts);
    Motion { lost, ..clock::timed(job, paths, acts) }
}

/// Strands whose ladders are made at once, in parallel.
const BATCH: usize = 64;

/// The program with its transits still empty: postures along each strand, from where the one before
/// left the arm.
fn along_strands(job: &Job, paths: &[Path]) -> Vec<Act> {
    let order: Vec<usize> = job.print_order().collect();
    let mut acts = Vec::new();
    let mut ladders = Vec::new();
    let mut at = Posture::new(&job.cell.home);
    let mut done = 0_usize;
    let mut gone = Vec::new();
    let searches = job.strands.iter().any(|strand| strand.joints.is_none());
    let deposit = if searches { planned::deposit(job) } else { Deposit::new(Vec::new()) };
    let bodies = Bodies::new(job);
    let room = planned::Room::new(job, &bodies, &deposit);
    for step in &job.steps {
        match step {
            Step::Print(strand) => {
                // Ladders are large: they are made for a batch of strands and dropped after it.
                if done.is_multiple_of(BATCH) {
                    let batch = &order[done..order.len().min(done + BATCH)];
                    ladders = ladder::rungs_of(job, paths, batch);
                }
                let (path, ladder) = (&paths[*strand], &ladders[done % BATCH]);
                let postures = if job.strands[*strand].joints.is_some() {
                    strand::postures(job, path, ladder, &at)
                } else {
                    let clear = room.along(done, &gone);
                    strand::postures_clear(job, path, ladder, &at, Some(&|_, q| clear(q)))
                };
                let ways = around_print(job, &paths[*strand], postures, done);
                at = ways.iter().filter_map(Way::last).next_back().unwrap_or(at);
                acts.extend(ways.into_iter().map(Act::Go));
                done += 1;
            }
            Step::Move(rows) => {
                let way = between::follow(&at, rows, done);
                at = way.last().unwrap_or(at);
                acts.push(Act::Go(way));
            }
            Step::Wait(wait_s) => acts.push(Act::Wait(*wait_s)),
            Step::Release(form) => {
                gone.push(*form);
                acts.push(Act::Release(*form));
            }
            Step::Checkpoint(_) => {}
        }
    }
    acts
}

/// Transit (still empty), approach, print and retract of one strand.
fn around_print(job: &Job, path: &Path, postures: strand::Postures, printed: usize) -> Vec<Way> {
    let way = |phase, printed, stations| Way {
        phase,
        strand: Some(path.strand),
        printed,
        stations,
        unreached: Vec::new(),
    };
    let ends = postures.ends();
    let path = &postures.path;
    let stations = path.samples.iter().zip(&postures.q);
    let print = Way {
        unreached: postures.unreached.clone(),
        ..way(
            Phase::Print,
            printed,
            stations
                .filter_map(|(sample, q)| q.map(|q| Station { at_m: sample.at_m, q }))
                .collect(),
        )
    };
    let Some((first, last)) = ends else { return vec![print] };
    let settings = &job.strands[path.strand].settings;
    let straight = |sample: usize, length_m| {
        let q = postures.q[sample].expect("both ends are reached");
        let mut way = vec![q];
        // Where the arm really is: it may lean, or bring rows that are off the strand.
        let (point, nozzle) = between::nozzle_at(job, &q);
        let end = Sample { point, nozzle, ..path.samples[sample] };
        way.extend(between::straight(job, &end, &q, length_m));
        way.into_iter().map(|q| Station { at_m: 0.0, q }).collect::<Vec<_>>()
    };
    let mut approach = straight(first, settings.approach_m);
    approach.reverse();
    vec![
        way(Phase::Transit, printed, Vec::new()),
        way(Phase::Approach, printed, approach),
        print,
        way(Phase::Retract, printed + 1, straight(last, settings.retract_m)),
    ]
}

impl Way {
    fn first(&self) -> Option<Posture> {
        self.stations.first().map(|station| station.q)
    }

    fn last(&self) -> Option<Posture> {
        self.stations.last().map(|station| station.q)
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
) {
    solve_with(&job.cell.robot.arm, job, point, nozzle, [spin_rad, elbow_rad], seed, out);
}

/// The same for another arm in its place.
fn solve_with(
    arm: &Arm,
    job: &Job,
    point: Point,
    nozzle: Vector,
    [spin_rad, elbow_rad]: [f64; 2],
    seed: Option<&[f64]>,
    out: &mut Vec<Solution>,
) {
    let target = bed_from_tool(job, point, nozzle, spin_rad);
    place::solve(arm, job, &target, elbow_rad, seed, out);
}
