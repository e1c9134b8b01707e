//! Which posture an arm takes along a strand: a search over branch, spin and elbow angle.
//!
//! Rungs stand every [`RUNG_M`] along the strand. Each holds every solution for a fan of spins
//! (and elbow angles of a seven-joint arm). The cheapest way up the ladder, by joint travel,
//! nearness to limits and to singularities, is found by dynamic programming; spin and elbow turn
//! by at most one step of the fan between rungs and the branch is kept, or the step is dear.
//!
//! Cost: O(r · c²) for `r` rungs of `c` candidates; rungs are solved in parallel.

use rayon::prelude::*;

use crate::cell::{Job, Spin};
use crate::kinematics::{Branch, Posture, Solver, limit_margins, nearness};
use crate::toolpath::Path;

/// Largest distance between rungs, m.
pub(super) const RUNG_M: f64 = 24e-3;

/// Spins tried, evenly over a turn; with a free elbow fewer of each.
const N_SPINS: usize = 24;
const N_SPINS_WITH_ELBOW: usize = 12;
const N_ELBOWS: usize = 8;

/// Dearer than any posture that keeps its branch.
const FLIP_COST: f64 = 1e6;

/// One posture at a rung.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    pub(super) q: Posture,
    pub(super) branch: Branch,
    pub(super) spin: usize,
    pub(super) elbow: usize,
    cost: f64,
}

/// All rungs of a strand.
#[derive(Debug, Clone, Default)]
pub(super) struct Ladder {
    /// Sample index and candidates, by arc length; a rung without candidates is out of reach.
    pub(super) rungs: Vec<(usize, Vec<Candidate>)>,
    pub(super) fan: Fan,
}

/// The spins and elbow angles tried.
#[derive(Debug, Clone, Default)]
pub(super) struct Fan {
    pub(super) spins_rad: Vec<f64>,
    pub(super) elbows_rad: Vec<f64>,
}

impl Fan {
    fn of(job: &Job, strand: usize) -> Self {
        let turn = |k: usize, n: usize| std::f64::consts::TAU * k as f64 / n as f64;
        let has_elbow = matches!(&job.cell.robot.arm.solver, Solver::Srs(_));
        let is_cartesian = matches!(&job.cell.robot.arm.solver, Solver::Cartesian(_));
        let n_spins = if has_elbow { N_SPINS_WITH_ELBOW } else { N_SPINS };
        let spins_rad = match job.strands[strand].settings.orientation.spin {
            Spin::Held(angle) => vec![angle],
            Spin::Free if is_cartesian => vec![cartesian_spin(job)],
            Spin::Free => (0..n_spins).map(|k| turn(k, n_spins)).collect(),
        };
        let n_elbows = if has_elbow { N_ELBOWS } else { 1 };
        let elbows_rad = (0..n_elbows).map(|k| turn(k, n_elbows)).collect();
        Self { spins_rad, elbows_rad }
    }
}

/// The one spin a machine without rotation can have: that of its tool about the bed's x.
fn cartesian_spin(job: &Job) -> f64 {
    let world_from_tip = job.cell.robot.arm.chain.forward(&job.cell.home);
    let bed_from_tool = job.cell.world_from_bed(&world_from_tip).inverse()
        * job.cell.world_from_tool(&world_from_tip);
    let nozzle = bed_from_tool * nalgebra::Vector3::z();
    let unspun = crate::pose::from_z_axis(
        bed_from_tool.translation.vector.into(),
        nozzle,
        nalgebra::Vector3::x(),
    );
    let turned = unspun.rotation.inverse() * bed_from_tool.rotation;
    2.0 * turned.k.atan2(turned.w)
}

/// The ladders of these strands; empty for one that brings a joint path of its own.
pub(super) fn rungs_of(job: &Job, paths: &[Path], strands: &[usize]) -> Vec<Ladder> {
    strands
        .par_iter()
        .map(|&strand| {
            let path = &paths[strand];
            if job.strands[path.strand].joints.is_some() {
                return Ladder::default();
            }
            let fan = Fan::of(job, path.strand);
            let rungs = rung_samples(path)
                .into_iter()
                .map(|sample| (sample, candidates(job, path, sample, &fan)))
                .collect();
            Ladder { rungs, fan }
        })
        .collect()
}

fn rung_samples(path: &Path) -> Vec<usize> {
    let mut samples = vec![0];
    let mut last_m = 0.0;
    for (k, sample) in path.samples.iter().enumerate().skip(1) {
        let next_m = path.samples.get(k + 1).map_or(f64::INFINITY, |next| next.at_m);
        if next_m - last_m > RUNG_M {
            samples.push(k);
            last_m = sample.at_m;
        }
    }
    samples
}

fn candidates(job: &Job, path: &Path, sample: usize, fan: &Fan) -> Vec<Candidate> {
    let arm = &job.cell.robot.arm;
    let place = &path.samples[sample];
    let mut solutions = Vec::new();
    let mut found = Vec::new();
    for (spin, &spin_rad) in fan.spins_rad.iter().enumerate() {
        for (elbow, &elbow_rad) in fan.elbows_rad.iter().enumerate() {
            solutions.clear();
            super::solve(
                job,
                place.point,
                place.nozzle,
                spin_rad,
                elbow_rad,
                Some(&job.cell.home),
                &mut solutions,
            );
            found.extend(solutions.iter().map(|solution| Candidate {
                q: solution.q,
                branch: solution.branch,
                spin,
                elbow,
                cost: posture_cost(arm, &solution.q),
            }));
        }
    }
    found
}

/// Dislike of a posture: grows as `1/x` towards joint limits and singularities, in radians.
fn posture_cost(arm: &crate::kinematics::Arm, q: &Posture) -> f64 {
    const SOFT_RAD: f64 = 0.05;
    let margin = limit_margins(&arm.chain, q).iter().fold(f64::INFINITY, |a, &b| a.min(b)).max(0.0);
    let near = nearness(arm, q);
    let wrist = near.wrist_rad.unwrap_or(f64::INFINITY);
    let elbow = near.elbow_rad.unwrap_or(f64::INFINITY);
    0.05 / (margin + SOFT_RAD) + 0.1 / (wrist + SOFT_RAD) + 0.05 / (elbow + SOFT_RAD)
}

/// The cheapest way up from where the arm is now: candidate index at each rung that has any.
pub(super) fn climb(ladder: &Ladder, from: &Posture) -> Vec<(usize, usize)> {
    let rungs: Vec<usize> =
        (0..ladder.rungs.len()).filter(|&rung| !ladder.rungs[rung].1.is_empty()).collect();
    let Some(&first) = rungs.first() else { return Vec::new() };
    // A short way to the strand counts like travel along it: a transit that turns the whole arm
    // over is the one that hits something.
    let start = |candidate: &Candidate| candidate.cost + travel(from, &candidate.q);
    let mut costs: Vec<f64> = ladder.rungs[first].1.iter().map(start).collect();
    let mut came_from: Vec<Vec<usize>> = Vec::new();
    for pair in rungs.windows(2) {
        let (below, above) = (&ladder.rungs[pair[0]].1, &ladder.rungs[pair[1]].1);
        let best = |candidate: &Candidate| cheapest(ladder, below, &costs, candidate);
        let steps: Vec<(usize, f64)> = above.iter().map(best).collect();
        costs = steps.iter().map(|(_, cost)| *cost).collect();
        came_from.push(steps.into_iter().map(|(index, _)| index).collect());
    }
    let mut at = (0..costs.len()).min_by(|&a, &b| costs[a].total_cmp(&costs[b])).unwrap_or(0);
    let mut way = vec![(rungs[rungs.len() - 1], at)];
    for (step, rung) in came_from.iter().rev().zip(rungs.iter().rev().skip(1)) {
        at = step[at];
        way.push((*rung, at));
    }
    way.reverse();
    way
}

fn cheapest(ladder: &Ladder, below: &[Candidate], costs: &[f64], to: &Candidate) -> (usize, f64) {
    let mut best = (0, f64::INFINITY);
    for (index, (from, cost)) in below.iter().zip(costs).enumerate() {
        if *cost >= best.1 {
            continue;
        }
        let total = cost + to.cost + step_cost(ladder, from, to);
        if total < best.1 {
            best = (index, total);
        }
    }
    best
}

fn step_cost(ladder: &Ladder, from: &Candidate, to: &Candidate) -> f64 {
    let apart = |a: usize, b: usize, n: usize| a.abs_diff(b).min(n - a.abs_diff(b));
    let keeps = from.branch == to.branch
        && apart(from.spin, to.spin, ladder.fan.spins_rad.len()) <= 1
        && apart(from.elbow, to.elbow, ladder.fan.elbows_rad.len()) <= 1;
    let travel = travel(&from.q, &to.q);
    // A copy a full turn away, or a posture that only a flip leads to.
    let jumps = from.q.distance(&to.q) > std::f64::consts::FRAC_PI_2;
    if keeps && !jumps { travel } else { travel + FLIP_COST }
}

/// Sum of joint travel, rad or m.
pub(super) fn travel(from: &[f64], to: &[f64]) -> f64 {
    from.iter().zip(to).map(|(a, b)| (a - b).abs()).sum()
}
