//! The cheapest way up a ladder, by dynamic programming.
//!
//! Between rungs a way keeps its branch and turns by one cell of the fan at most, or it flips, which is
//! dearer than anything else. Clearance is looked at lazily: only of postures on the way that is
//! cheapest so far, and of a few all around the fan where one of them is too near; then the way is searched
//! again, [`MOST_CLIMBS`] times at most. Where nothing looked at is clear of everything, what was not looked at is
//! taken to be as near as the best that was.
//!
//! Cost: O(r · c · k) for `r` rungs of `c` candidates with `k` in the cells beside each.

use rayon::prelude::*;

use super::cost::FLIP_COST;
use super::ladder::{Candidate, Ladder, Rung};
use super::place::Course;
use crate::kinematics::Posture;
use crate::toolpath::Sample;

/// Clearance of a posture at a place of the strand, m.
pub(super) type Clearance<'a> = &'a (dyn Fn(&Sample, &Posture) -> f64 + Sync);

/// Times a ladder is climbed, at most, before the clearances looked at so far must do.
const MOST_CLIMBS: usize = 24;
/// Parts of the fan that are looked at where one posture is too near.
const SECTORS: usize = 12;

/// The cheapest way up with clearance in its cost: rung and candidate.
pub(super) fn climb_clear(
    course: &Course<'_>,
    ladder: &mut Ladder,
    from: &Posture,
    clearance: Clearance<'_>,
) -> Vec<(usize, usize)> {
    let mut way = climb(course, ladder, from);
    for _ in 1..MOST_CLIMBS {
        let mut dearer = false;
        for &(rung, candidate) in &way {
            let rung = &mut ladder.rungs[rung];
            if rung.candidates[candidate].too_near.is_some() {
                continue;
            }
            if look(course, rung, candidate, clearance) > rung.guess {
                dearer = true;
                if rung.guess == 0.0 {
                    look_around(course, rung, clearance);
                }
            }
        }
        if !dearer {
            break;
        }
        way = climb(course, ladder, from);
    }
    way
}

/// Looks at the clearance of a candidate; what it adds to the cost.
fn look(course: &Course<'_>, rung: &mut Rung, candidate: usize, clearance: Clearance<'_>) -> f64 {
    let place = &course.path.samples[rung.sample];
    let candidate = &mut rung.candidates[candidate];
    let cost = course.costs.clearance(clearance(place, &candidate.q));
    candidate.too_near = Some(cost);
    cost
}

/// Looks at the cheapest candidate of each of [`SECTORS`] parts of the fan. Where all of them are too near,
/// the others are taken to be no better than the best of these.
fn look_around(course: &Course<'_>, rung: &mut Rung, clearance: Clearance<'_>) {
    let n_cells = rung.starts.len() - 1;
    let cost = |&index: &usize| rung.candidates[index].cost;
    let cheapest = (0..SECTORS).filter_map(|sector| {
        let [first, last] = [sector, sector + 1].map(|k| rung.starts[k * n_cells / SECTORS]);
        (first..last).min_by(|a, b| cost(a).total_cmp(&cost(b)))
    });
    let mut seen: Vec<(usize, f64)> = cheapest.map(|index| (index, 0.0)).collect();
    let place = &course.path.samples[rung.sample];
    seen.par_iter_mut().for_each(|(index, cost)| {
        let candidate = &rung.candidates[*index];
        let near = || course.costs.clearance(clearance(place, &candidate.q));
        *cost = candidate.too_near.unwrap_or_else(near);
    });
    let mut best = f64::INFINITY;
    for (index, cost) in seen {
        rung.candidates[index].too_near = Some(cost);
        best = best.min(cost);
    }
    rung.guess = if best.is_finite() { best } else { 0.0 };
}

/// The cheapest way up from where the arm is now: rung and candidate, for each rung that has any.
pub(super) fn climb(course: &Course<'_>, ladder: &Ladder, from: &Posture) -> Vec<(usize, usize)> {
    let rungs: Vec<usize> =
        (0..ladder.rungs.len()).filter(|&k| !ladder.rungs[k].candidates.is_empty()).collect();
    let Some(&first) = rungs.first() else { return Vec::new() };
    // A short way to the strand counts like travel along it: a transit that turns the whole arm
    // over is the one that hits something.
    let start = |candidate: &Candidate| {
        ladder.rungs[first].cost(candidate) + course.costs.travel(from, &candidate.q)
    };
    let mut costs: Vec<f64> = ladder.rungs[first].candidates.iter().map(start).collect();
    let mut came_from: Vec<Vec<usize>> = Vec::new();
    for pair in rungs.windows(2) {
        let (below, above) = (&ladder.rungs[pair[0]], &ladder.rungs[pair[1]]);
        let cheapest = least(&costs);
        let best = |to: &Candidate| {
            let up = beside(course, ladder, (below, &costs), above, to)
                .filter(|(_, total)| *total < costs[cheapest] + above.cost(to) + FLIP_COST);
            up.unwrap_or_else(|| {
                let travel = course.costs.travel(&below.candidates[cheapest].q, &to.q);
                (cheapest, costs[cheapest] + above.cost(to) + travel + FLIP_COST)
            })
        };
        let steps: Vec<(usize, f64)> = above.candidates.iter().map(best).collect();
        costs = steps.iter().map(|(_, cost)| *cost).collect();
        came_from.push(steps.into_iter().map(|(index, _)| index).collect());
    }
    let mut at = least(&costs);
    let mut way = vec![(rungs[rungs.len() - 1], at)];
    for (step, rung) in came_from.iter().rev().zip(rungs.iter().rev().skip(1)) {
        at = step[at];
        way.push((*rung, at));
    }
    way.reverse();
    way
}

/// The cheapest way to a candidate from the cells beside it; `None` where only a flip leads there.
fn beside(
    course: &Course<'_>,
    ladder: &Ladder,
    (below, costs): (&Rung, &[f64]),
    above: &Rung,
    to: &Candidate,
) -> Option<(usize, f64)> {
    let turn = &ladder.fan.turns[to.cell];
    let own = above.cost(to);
    let mut best: Option<(usize, f64)> = None;
    for &cell in &ladder.fan.beside[to.cell] {
        let [_, turn_rad] = turn.apart(&ladder.fan.turns[cell]);
        let indices = below.starts[cell]..below.starts[cell + 1];
        let candidates = below.candidates[indices.clone()].iter().zip(&costs[indices.clone()]);
        for (index, (from, cost)) in indices.zip(candidates) {
            let so_far = cost + own;
            if best.is_some_and(|(_, least)| so_far >= least)
                || !course.costs.keeps((&from.q, from.branch), (&to.q, to.branch))
            {
                continue;
            }
            let total = so_far + course.costs.step(&from.q, &to.q, turn_rad, &above.step);
            if best.is_none_or(|(_, least)| total < least) {
                best = Some((index, total));
            }
        }
    }
    best
}

fn least(costs: &[f64]) -> usize {
    (0..costs.len()).min_by(|&a, &b| costs[a].total_cmp(&costs[b])).unwrap_or(0)
}
