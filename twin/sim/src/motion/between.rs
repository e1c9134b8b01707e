//! Moves without extrusion: straight approach and retract, transit over the deposit.

use super::{Act, Station, Way, bed_from_tool, strand};
use crate::cell::Job;
use crate::finding::Phase;
use crate::kinematics::Posture;
use crate::pose::{Point, Vector};
use crate::toolpath::Sample;

/// Room kept above the deposit in transit, m.
const LIFT_M: f64 = 20e-3;

/// Largest step of a straight move, m, and of a joint move, rad.
const STRAIGHT_STEP_M: f64 = 5e-3;
const JOINT_STEP_RAD: f64 = 0.05;

/// Postures backwards along the nozzle's axis from `at`, nearest first, without `at` itself.
/// Ends where reach ends.
pub(super) fn straight(job: &Job, at: &Sample, q: &Posture, length_m: f64) -> Vec<Posture> {
    line(job, at.point, at.nozzle, -at.nozzle, q, length_m)
}

/// Postures along a straight line of the nozzle, orientation kept.
fn line(
    job: &Job,
    from: Point,
    nozzle: Vector,
    along: Vector,
    q: &Posture,
    length_m: f64,
) -> Vec<Posture> {
    let n_steps = (length_m / STRAIGHT_STEP_M).ceil() as usize;
    let spin_rad = spin_of(job, from, nozzle, q);
    let elbow_rad = job.cell.robot.arm.elbow_angle(q).unwrap_or(0.0);
    let mut before = *q;
    let mut postures = Vec::with_capacity(n_steps);
    let mut solutions = Vec::new();
    for k in 1..=n_steps {
        let point = from + along * (length_m * k as f64 / n_steps as f64);
        solutions.clear();
        super::solve(job, point, nozzle, spin_rad, elbow_rad, Some(&before), &mut solutions);
        match strand::nearest(&solutions, &before) {
            Some(next) if next.distance(&before) < 0.5 => before = next,
            _ => break,
        }
        postures.push(before);
    }
    postures
}

/// Spin of the tool about its axis in posture `q`.
fn spin_of(job: &Job, point: Point, nozzle: Vector, q: &Posture) -> f64 {
    let cell = &job.cell;
    let world_from_tip = cell.robot.arm.chain.forward(q);
    let actual =
        cell.world_from_bed(&world_from_tip).inverse() * cell.world_from_tool(&world_from_tip);
    let turned = bed_from_tool(job, point, nozzle, 0.0).rotation.inverse() * actual.rotation;
    2.0 * turned.k.atan2(turned.w)
}

/// Nozzle place and axis in part axes in posture `q`.
pub(super) fn nozzle_at(job: &Job, q: &Posture) -> (Point, Vector) {
    let cell = &job.cell;
    let world_from_tip = cell.robot.arm.chain.forward(q);
    let bed_from_tool =
        cell.world_from_bed(&world_from_tip).inverse() * cell.world_from_tool(&world_from_tip);
    let part_from_tool = job.bed_from_part.inverse() * bed_from_tool;
    (part_from_tool * Point::origin(), part_from_tool * Vector::z())
}

/// Gives every transit its way from where the arm is to where the next way begins.
pub(super) fn fill_transits(job: &Job, acts: &mut [Act]) {
    let mut at = Posture::new(&job.cell.home);
    // Highest point printed so far, along the bed's z, m; `None` before anything is printed.
    let mut top_m = None;
    for k in 0..acts.len() {
        let (before, after) = acts.split_at_mut(k + 1);
        let Some(Act::Go(way)) = before.last_mut() else { continue };
        if way.phase == Phase::Transit && way.stations.is_empty() {
            let next = after.iter().find_map(|act| match act {
                Act::Go(way) => way.first(),
                _ => None,
            });
            if let Some(target) = next {
                way.stations = transit(job, top_m, &at, &target);
            }
        }
        if let (Phase::Print, Some(strand)) = (way.phase, way.strand) {
            let up = |point: &Point| (job.bed_from_part * point).z;
            let heights = job.strands[strand].points.iter().map(up);
            top_m = heights.chain(top_m).reduce(f64::max);
        }
        at = way.last().unwrap_or(at);
    }
}

/// From one posture to another: up over all that is printed, across, down.
///
/// Where the lift is out of reach the arm goes as far up as it can; `collision` judges what
/// comes of it.
fn transit(job: &Job, top_m: Option<f64>, from: &Posture, target: &Posture) -> Vec<Station> {
    let up_here = lift(job, top_m, from);
    let up_there = lift(job, top_m, target);
    let mut way = vec![*from];
    way.extend(&up_here);
    let across_to = up_there.last().copied().unwrap_or(*target);
    way.extend(joint_steps(way.last().copied().unwrap_or(*from), across_to));
    way.extend(up_there.iter().rev().skip(1));
    if !up_there.is_empty() {
        way.push(*target);
    }
    way.into_iter().map(|q| Station { at_m: 0.0, q }).collect()
}

fn lift(job: &Job, top_m: Option<f64>, q: &Posture) -> Vec<Posture> {
    let Some(top_m) = top_m else { return Vec::new() };
    let (point, nozzle) = nozzle_at(job, q);
    let up = job.bed_from_part.inverse_transform_vector(&Vector::z());
    let lift_m = top_m + LIFT_M - (job.bed_from_part * point).z;
    if lift_m <= 0.0 {
        return Vec::new();
    }
    line(job, point, nozzle, up, q, lift_m)
}

/// A joint path of the job's own.
pub(super) fn follow(from: &Posture, rows: &[Vec<f64>], printed: usize) -> Way {
    let mut way = vec![*from];
    for row in rows {
        let from = way[way.len() - 1];
        way.extend(joint_steps(from, Posture::new(row)));
    }
    Way {
        phase: Phase::Transit,
        strand: None,
        printed,
        stations: way.into_iter().map(|q| Station { at_m: 0.0, q }).collect(),
        unreached: Vec::new(),
    }
}

/// Steps of a straight move in joint space, without its start.
fn joint_steps(from: Posture, to: Posture) -> impl Iterator<Item = Posture> {
    let n_steps = (from.distance(&to) / JOINT_STEP_RAD).ceil().max(1.0) as usize;
    (1..=n_steps).map(move |k| {
        let share = k as f64 / n_steps as f64;
        let mut q = from;
        for (value, target) in q.iter_mut().zip(to.iter()) {
            *value += (target - *value) * share;
        }
        q
    })
}
