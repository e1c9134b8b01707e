//! Postures and times along one strand.

use crate::cell::{Job, Strand};
use crate::kinematics::{Posture, Solution};
use crate::pose::Point;
use crate::toolpath::{Path, Sample};

use super::ladder::{self, Ladder};

/// Postures at the samples of a path.
#[derive(Debug, Clone)]
pub(super) struct Postures {
    /// One per sample; `None`: out of reach.
    pub(super) q: Vec<Option<Posture>>,
    /// Arc length and place of the samples out of reach.
    pub(super) unreached: Vec<(f64, Point)>,
}

impl Postures {
    /// First and last sample that are reached.
    pub(super) fn ends(&self) -> Option<(usize, usize)> {
        let first = self.q.iter().position(Option::is_some)?;
        Some((first, self.q.iter().rposition(Option::is_some)?))
    }
}

/// Postures along a strand, from its own joint path or from the ladder.
pub(super) fn postures(job: &Job, path: &Path, ladder: &Ladder, from: &Posture) -> Postures {
    let q = match &job.strands[path.strand].joints {
        Some(rows) => {
            let stations = crate::toolpath::stations(&job.strands[path.strand].points);
            given(rows, &stations, path)
        }
        None => searched(job, path, ladder, from),
    };
    let missing = path.samples.iter().zip(&q).filter(|(_, q)| q.is_none());
    let unreached = missing.map(|(sample, _)| (sample.at_m, sample.point)).collect();
    Postures { q, unreached }
}

/// The strand's own rows, one per vertex, joints turning evenly in between; samples in the overrun
/// stay at the last row.
fn given(rows: &[Vec<f64>], stations: &[f64], path: &Path) -> Vec<Option<Posture>> {
    let at = |sample: &Sample| {
        let k = stations.partition_point(|&x| x < sample.at_m).clamp(1, stations.len() - 1);
        let share =
            ((sample.at_m - stations[k - 1]) / (stations[k] - stations[k - 1])).clamp(0.0, 1.0);
        let (from, to) = (rows.get(k - 1)?, rows.get(k)?);
        let mut q = Posture::new(from);
        for (value, target) in q.iter_mut().zip(to) {
            *value += (target - *value) * share;
        }
        Some(q)
    };
    path.samples.iter().map(at).collect()
}

/// Between rungs, spin and elbow turn evenly; of the solutions there the one nearest to the
/// posture before is taken.
fn searched(job: &Job, path: &Path, ladder: &Ladder, from: &Posture) -> Vec<Option<Posture>> {
    let way = ladder::climb(ladder, from);
    let mut postures = vec![None; path.samples.len()];
    let mut solutions = Vec::new();
    let Some(&(first_rung, first_candidate)) = way.first() else { return postures };
    let mut before = ladder.rungs[first_rung].1[first_candidate].q;
    let mut leg = 0;
    for (k, sample) in path.samples.iter().enumerate() {
        while leg + 1 < way.len() && ladder.rungs[way[leg + 1].0].0 <= k {
            leg += 1;
        }
        let (rung, candidate) = way[leg];
        let at = &ladder.rungs[rung].1[candidate];
        if ladder.rungs[rung].0 == k {
            postures[k] = Some(at.q);
            before = at.q;
            continue;
        }
        let (spin_rad, elbow_rad) = match way.get(leg + 1) {
            Some(&(next_rung, next)) if ladder.rungs[rung].0 < k => {
                let to = &ladder.rungs[next_rung].1[next];
                let (a, b) = (ladder.rungs[rung].0, ladder.rungs[next_rung].0);
                let (a_m, b_m) = (path.samples[a].at_m, path.samples[b].at_m);
                let share = (sample.at_m - a_m) / (b_m - a_m);
                (
                    between(&ladder.fan.spins_rad, at.spin, to.spin, share),
                    between(&ladder.fan.elbows_rad, at.elbow, to.elbow, share),
                )
            }
            _ => (ladder.fan.spins_rad[at.spin], ladder.fan.elbows_rad[at.elbow]),
        };
        solutions.clear();
        super::solve(
            job,
            sample.point,
            sample.nozzle,
            spin_rad,
            elbow_rad,
            Some(&before),
            &mut solutions,
        );
        postures[k] = nearest(&solutions, &before);
        before = postures[k].unwrap_or(before);
    }
    postures
}

/// The solution with the least joint travel from `before`.
pub(super) fn nearest(solutions: &[Solution], before: &[f64]) -> Option<Posture> {
    let travel = |solution: &Solution| ladder::travel(before, &solution.q);
    solutions.iter().min_by(|a, b| travel(a).total_cmp(&travel(b))).map(|solution| solution.q)
}

/// Angle on the shorter way from one entry of the fan to another.
fn between(fan: &[f64], from: usize, to: usize, share: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    let turn = (fan[to] - fan[from] + PI).rem_euclid(TAU) - PI;
    fan[from] + turn * share
}

/// Time at each sample from the start of the extrusion, s.
///
/// ```text
/// t(s) = ∫ ds / v(s)
/// ```
///
/// `v` is the speed of the sample before, asked or from the strand's own times; those may begin
/// later than the extrusion.
pub(super) fn times(strand: &Strand, path: &Path) -> Vec<f64> {
    let mut time_s =
        strand.times_s.as_ref().and_then(|times| times.first()).copied().unwrap_or(0.0);
    let mut times = vec![time_s];
    for pair in path.samples.windows(2) {
        time_s += (pair[1].at_m - pair[0].at_m) / pair[0].speed_m_s;
        times.push(time_s);
    }
    times
}
