//! Moves without extrusion: straight approach and retract, transit over the deposit.

use rayon::prelude::*;

use super::transit::{self, Exit, How, Place, Reason, Task};
use super::{Act, Lost, Station, Way, bed_from_tool, strand};
use crate::cell::Job;
use crate::clearance::{Bodies, Space, Touch};
use crate::deposit::{self, Contact, Deposit};
use crate::finding::Phase;
use crate::kinematics::Posture;
use crate::pose::{Point, Vector};
use crate::toolpath::Sample;

/// Room kept above the deposit in transit, m.
const LIFT_M: f64 = 20e-3;

/// How far back along the nozzle's axis a transit may begin or end, m.
const BACK_M: f64 = 100e-3;

/// Postures nearer than this in every joint are one, rad or m.
const SAME_RAD: f64 = 1e-9;

/// Largest step of a straight move, m, and of a joint move, rad.
const STRAIGHT_STEP_M: f64 = 5e-3;
const JOINT_STEP_RAD: f64 = 0.05;

/// Postures backwards along the nozzle's axis from `at`, nearest first, without `at` itself.
/// Ends where reach ends.
pub(super) fn straight(job: &Job, at: &Sample, q: &Posture, length_m: f64) -> Vec<Posture> {
    line(job, at.point, at.nozzle, -at.nozzle, q, length_m)
}

/// Postures along a straight line of the nozzle from `q`, without it; the tool does not turn. Ends
/// where reach ends.
pub(super) fn line(
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
pub(super) fn spin_of(job: &Job, point: Point, nozzle: Vector, q: &Posture) -> f64 {
    let actual = job.cell.bed_from_tool(q);
    let turned = bed_from_tool(job, point, nozzle, 0.0).rotation.inverse() * actual.rotation;
    2.0 * turned.k.atan2(turned.w)
}

/// Nozzle place and axis in part axes in posture `q`.
pub(super) fn nozzle_at(job: &Job, q: &Posture) -> (Point, Vector) {
    let part_from_tool = job.part_from_tool(q);
    (part_from_tool * Point::origin(), part_from_tool * Vector::z())
}

/// Plans all that the arm does between strands: approaches and retracts, then transits, and the way
/// home at the end. Returns what no clear way was found for.
pub(super) fn plan_moves(job: &Job, planned: &Deposit, acts: &mut Vec<Act>) -> Vec<Lost> {
    let bodies = Bodies::new(job);
    let space = Space::new(job, &bodies, planned);
    let contacts = deposit::contacts(planned);
    go_home(job, acts);
    let left = leave_strands(&space, &contacts, acts);
    let mut lost = take(acts, left);
    let tasks = tasks(job, acts);
    let releases: Vec<usize> = releases(acts).collect();
    let free = |task: &Task, from: &Posture, to: &Posture, need_m: f64| {
        let touch = Touch::nothing().without(releases[..task.released].to_vec());
        space.move_is_clear(from, to, task.printed, &touch, need_m)
    };
    let only_tasks: Vec<Task> = tasks.iter().map(|(_, task)| *task).collect();
    let transits = transit::plan(job, &only_tasks, &free);
    let found = tasks.into_iter().zip(transits).map(|((act, _), transit)| {
        let mut way = vec![transit.way[0]];
        way.extend(transit.way.windows(2).flat_map(|pair| joint_steps(pair[0], pair[1])));
        (act, way, transit.reason)
    });
    lost.extend(take(acts, found.collect()));
    lost.sort_by_key(|lost| lost.leg);
    lost
}

/// Puts ways found into the program; what is lost is told by the index of its leg.
fn take(acts: &mut [Act], found: Vec<(usize, Vec<Posture>, Option<Reason>)>) -> Vec<Lost> {
    let mut lost = Vec::new();
    for (act, postures, reason) in found {
        let leg = acts[..act].iter().filter(|act| matches!(act, Act::Go(_))).count();
        lost.extend(reason.map(|reason| Lost { leg, reason }));
        if let Act::Go(way) = &mut acts[act] {
            way.stations = postures.into_iter().map(|q| Station { at_m: 0.0, q }).collect();
        }
    }
    lost
}

/// The program ends at home, unless its last step is a move of the job's own.
fn go_home(job: &Job, acts: &mut Vec<Act>) {
    let last = acts.iter().rev().find_map(|act| match act {
        Act::Go(way) if !way.stations.is_empty() => Some(way),
        _ => None,
    });
    let Some(last) = last.filter(|way| way.phase != Phase::Transit) else { return };
    if last.last().is_some_and(|q| q == Posture::new(&job.cell.home)) {
        return;
    }
    let printed = last.printed.max(job.print_order().count());
    acts.push(Act::Go(Way {
        phase: Phase::Transit,
        strand: None,
        printed,
        stations: Vec::new(),
        unreached: Vec::new(),
    }));
}

fn releases(acts: &[Act]) -> impl Iterator<Item = usize> {
    acts.iter().filter_map(|act| match act {
        Act::Release(form) => Some(*form),
        _ => None,
    })
}

/// Approach and retract of every strand, in parallel.
fn leave_strands(
    space: &Space<'_>,
    contacts: &[Contact],
    acts: &[Act],
) -> Vec<(usize, Vec<Posture>, Option<Reason>)> {
    let job = space.job;
    let order: Vec<usize> = job.print_order().collect();
    let mut by_order: Vec<Vec<&Contact>> = vec![Vec::new(); order.len()];
    for contact in contacts {
        contact.orders.iter().for_each(|&order| by_order[order].push(contact));
    }
    let legs = acts.par_iter().enumerate().filter_map(|(index, act)| match act {
        Act::Go(way) => {
            let strand = way.strand?;
            let settings = &job.strands[strand].settings;
            // The one posture that stays: where the nozzle meets the strand.
            let (q, length_m, place_in_order) = match way.phase {
                Phase::Approach => (way.last()?, settings.approach_m, way.printed),
                Phase::Retract => (way.first()?, settings.retract_m, way.printed - 1),
                _ => return None,
            };
            Some((index, way, q, length_m, place_in_order))
        }
        _ => None,
    });
    let left = legs.map(|(index, way, q, length_m, place_in_order)| {
        let (point, nozzle) = nozzle_at(job, &q);
        let contacts = by_order[place_in_order].iter().copied();
        let touch = Touch::strand(job, space.deposit, place_in_order, contacts, false)
            .without(releases(&acts[..index]).collect());
        let retracts = way.phase == Phase::Retract;
        let touch = if retracts { touch.leaving(place_in_order, point) } else { touch };
        let free = |from: &Posture, to: &Posture, need_m: f64| {
            space.move_is_clear(from, to, way.printed, &touch, need_m)
        };
        let away = || transit::away_from(job, &order[..=place_in_order], point);
        let leaving = transit::leave(job, &Place { point, nozzle, q }, length_m, away, &free);
        let mut postures = leaving.way;
        if !retracts {
            postures.reverse();
        }
        (index, postures, leaving.reason)
    });
    left.collect()
}

/// Every transit that is still empty, by its place in the program.
fn tasks(job: &Job, acts: &[Act]) -> Vec<(usize, Task)> {
    let home = Posture::new(&job.cell.home);
    let mut at = home;
    let mut released = 0;
    // Highest point printed so far, along the bed's z, m; `None` before anything is printed.
    let mut top_m = None;
    let mut tasks = Vec::new();
    for (index, act) in acts.iter().enumerate() {
        let way = match act {
            Act::Go(way) => way,
            Act::Release(_) => {
                released += 1;
                continue;
            }
            Act::Wait(_) => continue,
        };
        if way.phase == Phase::Transit && way.stations.is_empty() {
            let next = acts[index + 1..].iter().find_map(|act| match act {
                Act::Go(way) => way.first(),
                _ => None,
            });
            let to = next.unwrap_or(home);
            let Way { strand, printed, .. } = *way;
            // A move of the job's own may have led there already.
            if at.distance(&to) > SAME_RAD {
                tasks.push((index, Task { strand, printed, released, top_m, from: at, to }));
            }
            at = to;
        }
        if let (Phase::Print, Some(strand)) = (way.phase, way.strand) {
            let up = |point: &Point| (job.bed_from_part * point).z;
            let heights = job.strands[strand].points.iter().map(up);
            top_m = heights.chain(top_m).reduce(f64::max);
        }
        at = way.last().unwrap_or(at);
    }
    tasks
}

fn lift(job: &Job, top_m: Option<f64>, q: &Posture) -> Vec<Posture> {
    let Some(top_m) = top_m else { return Vec::new() };
    let (point, nozzle) = nozzle_at(job, q);
    let lift_m = top_m + LIFT_M - (job.bed_from_part * point).z;
    if lift_m <= 0.0 {
        return Vec::new();
    }
    line(job, point, nozzle, up(job), q, lift_m)
}

/// Away from the bed, in part axes.
pub(super) fn up(job: &Job) -> Vector {
    job.bed_from_part.inverse_transform_vector(&Vector::z())
}

/// Straight ways out of a posture: back along the nozzle's axis, and up over all that is printed.
pub(super) fn exits(job: &Job, q: &Posture, top_m: Option<f64>) -> Vec<Exit> {
    let (point, nozzle) = nozzle_at(job, q);
    let back = Exit { how: How::Along, way: line(job, point, nozzle, -nozzle, q, BACK_M) };
    let over = Exit { how: How::Over, way: lift(job, top_m, q) };
    [back, over].into_iter().filter(|exit| !exit.way.is_empty()).collect()
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
    (1..=n_steps).map(move |k| from.toward(&to, k as f64 / n_steps as f64))
}
