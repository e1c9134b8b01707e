//! The postures to choose from along a strand.
//!
//! Rungs stand every [`RUNG_M`] along the strand and wherever the search found the way between two
//! of them unsound. Each holds every solution, full-turn copies included, for a fan of spins, leans (where
//! the process allows) and elbow angles (of a seven-joint arm).
//!
//! Cost: O(r · c) inverse solutions for `r` rungs of `c` fan cells; strands are solved in parallel.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::cost::Step;
use super::place::{self, Course, Turn};
use super::tilt;
use crate::cell::{Job, Spin};
use crate::kinematics::{Branch, Posture, Solver};
use crate::toolpath::{Path, stations};

/// Largest distance between rungs, m.
pub(super) const RUNG_M: f64 = 24e-3;

/// Spins tried, evenly over a turn; with a further freedom fewer of each.
const N_SPINS: usize = 24;
const N_SPINS_WITH_MORE: usize = 12;
const N_ELBOWS: usize = 8;

/// One posture at a rung.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    pub(super) q: Posture,
    pub(super) branch: Branch,
    /// Cell of the fan.
    pub(super) cell: usize,
    /// Dislike of the posture by itself.
    pub(super) cost: f64,
    /// Dislike of its clearance, once that was looked at.
    pub(super) too_near: Option<f64>,
}

/// All postures of one place.
#[derive(Debug, Clone)]
pub(super) struct Rung {
    /// Index of its sample.
    pub(super) sample: usize,
    /// By cell of the fan; none: out of reach.
    pub(super) candidates: Vec<Candidate>,
    /// First candidate of each cell, and their number at the end.
    pub(super) starts: Vec<usize>,
    /// The way from the rung before.
    pub(super) step: Step,
    /// Dislike of a clearance that was not looked at.
    pub(super) guess: f64,
}

impl Rung {
    /// Cost of a candidate by what is known.
    pub(super) fn cost(&self, candidate: &Candidate) -> f64 {
        candidate.cost + candidate.too_near.unwrap_or(self.guess)
    }
}

/// All rungs of a strand, by arc length.
#[derive(Debug, Clone, Default)]
pub(super) struct Ladder {
    pub(super) rungs: Vec<Rung>,
    pub(super) fan: Fan,
}

/// The turns tried.
#[derive(Debug, Clone, Default)]
pub(super) struct Fan {
    pub(super) turns: Vec<Turn>,
    /// Cells that one step leads to, the cell itself included.
    pub(super) beside: Vec<Vec<usize>>,
}

impl Fan {
    /// `finer` is the number of spins and elbow angles where there was one.
    fn of(job: &Job, strand: usize, finer: usize) -> Self {
        let turn = |k: usize, n: usize| TAU * k as f64 / n as f64;
        let orientation = &job.strands[strand].settings.orientation;
        let has_elbow = matches!(&job.cell.robot.arm.solver, Solver::Srs(_));
        let is_cartesian = matches!(&job.cell.robot.arm.solver, Solver::Cartesian(_));
        let leans = if is_cartesian { vec![[0.0; 2]] } else { tilt::fan(orientation) };
        let n_spins = match has_elbow || leans.len() > 1 {
            true => N_SPINS_WITH_MORE * finer,
            false => N_SPINS * finer,
        };
        let spins: Vec<f64> = match orientation.spin {
            Spin::Held(angle) => vec![angle],
            Spin::Free if is_cartesian => vec![cartesian_spin(job)],
            Spin::Free => (0..n_spins).map(|k| turn(k, n_spins)).collect(),
        };
        let n_elbows = if has_elbow { N_ELBOWS * finer } else { 1 };
        let mut fan = Self::default();
        let cell =
            |spin: usize, elbow: usize, lean: usize| (spin * n_elbows + elbow) * leans.len() + lean;
        for (spin, &spin_rad) in spins.iter().enumerate() {
            for elbow in 0..n_elbows {
                for (lean, &lean_rad) in leans.iter().enumerate() {
                    fan.turns.push(Turn::new(spin_rad, lean_rad, turn(elbow, n_elbows)));
                    let mut beside = Vec::new();
                    for spin in around(spin, spins.len()) {
                        for elbow in around(elbow, n_elbows) {
                            let near =
                                (0..leans.len()).filter(|&other| next_to(&leans, lean, other));
                            beside.extend(near.map(|lean| cell(spin, elbow, lean)));
                        }
                    }
                    fan.beside.push(beside);
                }
            }
        }
        fan
    }
}

/// An index of a circle of `n` and those beside it, each once.
fn around(k: usize, n: usize) -> Vec<usize> {
    let mut near = vec![k, (k + 1) % n, (k + n - 1) % n];
    near.sort_unstable();
    near.dedup();
    near
}

/// Leans that are no further apart than the free angle.
fn next_to(leans: &[[f64; 2]], a: usize, b: usize) -> bool {
    let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    apart(leans[a], leans[b]) <= 1.01 * leans.get(1).map_or(0.0, |lean| lean[0].hypot(lean[1]))
}

/// The one spin a machine without rotation can have: that of its tool about the bed's x.
fn cartesian_spin(job: &Job) -> f64 {
    let bed_from_tool = job.cell.bed_from_tool(&job.cell.home);
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
            ladder(&Course::new(job, path), &evenly(path), 1)
        })
        .collect()
}

/// The ladder with rungs at these samples.
pub(super) fn ladder(course: &Course<'_>, samples: &[usize], finer: usize) -> Ladder {
    let fan = Fan::of(course.job, course.path.strand, finer);
    let mut rungs: Vec<Rung> = Vec::with_capacity(samples.len());
    for &sample in samples {
        let before = rungs.last().map_or(sample, |rung| rung.sample);
        rungs.push(rung(course, sample, before, &fan));
    }
    Ladder { rungs, fan }
}

/// The samples that stand about [`RUNG_M`] apart.
fn evenly(path: &Path) -> Vec<usize> {
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

fn rung(course: &Course<'_>, sample: usize, before: usize, fan: &Fan) -> Rung {
    let place = &course.path.samples[sample];
    let home = &course.job.cell.home;
    let mut solutions = Vec::new();
    let mut candidates = Vec::new();
    let mut starts = Vec::with_capacity(fan.turns.len() + 1);
    for (cell, turn) in fan.turns.iter().enumerate() {
        starts.push(candidates.len());
        let Some(pose) = course.pose(place, turn) else { continue };
        let (arm, elbow_rad) = (&course.job.cell.robot.arm, turn.0[Turn::ELBOW]);
        place::solve(arm, course.job, &pose, elbow_rad, Some(home), &mut solutions);
        candidates.extend(solutions.iter().map(|solution| Candidate {
            q: solution.q,
            branch: solution.branch,
            cell,
            cost: course.costs.posture(&solution.q),
            too_near: None,
        }));
    }
    starts.push(candidates.len());
    Rung { sample, candidates, starts, step: step(course, before, sample), guess: 0.0 }
}

/// Time between two samples, and how far a nozzle that turns between them leaves the strand.
pub(super) fn step(course: &Course<'_>, from: usize, to: usize) -> Step {
    let samples = &course.path.samples;
    let steps = samples[from..=to].windows(2);
    let dt_s = steps.map(|pair| (pair[1].at_m - pair[0].at_m) / pair[0].speed_m_s).sum();
    if !course.sets_tools() {
        return Step { dt_s, bow_m_per_rad: 0.0 };
    }
    let stations = stations(&course.job.strands[course.path.strand].points);
    let overlaps = |pair: &&[f64]| pair[1] > samples[from].at_m && pair[0] < samples[to].at_m;
    let lengths = stations.windows(2).filter(overlaps).map(|pair| pair[1] - pair[0]);
    Step { dt_s, bow_m_per_rad: lengths.fold(0.0, f64::max) / 4.0 }
}
