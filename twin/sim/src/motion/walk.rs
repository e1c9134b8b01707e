//! From postures at a few places to postures at every sample, and whether the way between is sound.

use super::place::{self, Course, Turn};
use super::set_tool;
use crate::cell::Job;
use crate::kinematics::{Branch, Posture, Solution};
use crate::pose::{Pose, Vector};
use crate::toolpath::{Sample, stations};

/// A posture that the way must pass through.
#[derive(Debug, Clone, Copy)]
pub(super) struct Post {
    /// Index of its sample.
    pub(super) sample: usize,
    pub(super) turn: Turn,
    pub(super) q: Posture,
    pub(super) branch: Branch,
}

/// Turn and posture at a place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stand {
    pub(super) turn: Turn,
    pub(super) q: Posture,
}

/// With all joints half way between two samples the nozzle may be off by this much; further, and
/// there is a sample more between them.
const EVEN_M: f64 = 0.2e-3;
const EVEN_RAD: f64 = 0.02;
/// Times a step between samples is halved: to a quarter of a millimetre. An even motion is even there.
const HALVINGS: usize = 4;

/// Between posts all that is free turns evenly, before the first and after the last it stays; of the
/// solutions the one nearest to the posture before is taken.
pub(super) fn fill(course: &Course<'_>, posts: &[Post]) -> Vec<Option<Stand>> {
    let samples = &course.path.samples;
    let mut stands: Vec<Option<Stand>> = vec![None; samples.len()];
    let (Some(first), Some(last)) = (posts.first(), posts.last()) else { return stands };
    let mut solutions = Vec::new();
    let mut reach = |k: usize, turn: Turn, before: &Posture| {
        let pose = course.pose_within(&samples[k], &turn);
        let solution = course.near(&pose, &turn, before, &mut solutions)?;
        Some(Stand { turn, q: course.costs.unwound(before, &solution.q) })
    };
    let mut before = first.q;
    for k in (0..first.sample).rev() {
        stands[k] = reach(k, first.turn, &before);
        before = stands[k].map_or(before, |stand| stand.q);
    }
    before = first.q;
    for pair in posts.windows(2) {
        let [from, to] = pair else { continue };
        stands[from.sample] =
            Some(Stand { turn: from.turn, q: course.costs.unwound(&before, &from.q) });
        before = stands[from.sample].map_or(before, |stand| stand.q);
        let at_m = |k: usize| samples[k].at_m;
        let between = from.sample + 1..to.sample;
        for (k, stand) in between.clone().zip(&mut stands[between]) {
            let share = (at_m(k) - at_m(from.sample)) / (at_m(to.sample) - at_m(from.sample));
            *stand = reach(k, from.turn.mix(&to.turn, share), &before);
            before = stand.map_or(before, |stand| stand.q);
        }
    }
    before = course.costs.unwound(&before, &last.q);
    stands[last.sample] = Some(Stand { turn: last.turn, q: before });
    for (k, stand) in stands.iter_mut().enumerate().skip(last.sample + 1) {
        *stand = reach(k, last.turn, &before);
        before = stand.map_or(before, |stand| stand.q);
    }
    stands
}

/// Where a controller that is given a tool per vertex takes the nozzle: poses in bed axes.
pub(super) struct Bowed {
    stations: Vec<f64>,
    poses: Vec<Pose>,
}

impl Bowed {
    /// From the nozzle's poses at the vertices.
    pub(super) fn new(stations: Vec<f64>, poses: Vec<Pose>) -> Self {
        Self { stations, poses }
    }

    /// Pose at an arc length; past the last vertex it keeps its orientation and runs on.
    pub(super) fn at(&self, job: &Job, sample: &Sample) -> Pose {
        let (stations, last) = (&self.stations, self.stations.len() - 1);
        if sample.at_m >= stations[last] {
            let on_m = sample.at_m - stations[last];
            let on = job.bed_from_part * (sample.tangent * on_m);
            return Pose::from_parts(
                (self.poses[last].translation.vector + on).into(),
                self.poses[last].rotation,
            );
        }
        let k = stations.partition_point(|station| *station <= sample.at_m).clamp(1, last);
        let share = (sample.at_m - stations[k - 1]) / (stations[k] - stations[k - 1]);
        set_tool::nozzle_at(&self.poses[k - 1], &self.poses[k], share.clamp(0.0, 1.0))
    }
}

/// Moves the postures between vertices to where the controller takes them.
pub(super) fn bow(course: &Course<'_>, stands: &mut [Option<Stand>]) -> Option<Bowed> {
    let samples = &course.path.samples;
    let stations = stations(&course.job.strands[course.path.strand].points);
    let poses: Option<Vec<Pose>> = stations
        .iter()
        .map(|&at_m| {
            let (k, sample) = place::sample_at(samples, at_m);
            let to = stands[k]?;
            let turn = match k.checked_sub(1).map(|before| (&samples[before], stands[before])) {
                Some((from, Some(stand))) => {
                    let share = (at_m - from.at_m) / (samples[k].at_m - from.at_m);
                    stand.turn.mix(&to.turn, share)
                }
                _ => to.turn,
            };
            Some(course.pose_within(&sample, &turn))
        })
        .collect();
    // With a hole in the strand there is nothing to run between; R101 tells.
    let bowed = Bowed::new(stations, poses?);
    let mut solutions = Vec::new();
    for (sample, stand) in samples.iter().zip(stands.iter_mut()) {
        let Some(Stand { turn, q }) = *stand else { continue };
        let pose = bowed.at(course.job, sample);
        *stand = course
            .near(&pose, &turn, &q, &mut solutions)
            .map(|solution| Stand { turn, q: course.costs.unwound(&q, &solution.q) });
    }
    Some(bowed)
}

/// Looks at the way between two samples: the nozzle with all joints half way against the middle of the
/// way, and where that is off, at both halves.
pub(super) struct Steps<'a> {
    pub(super) course: &'a Course<'a>,
    pub(super) bowed: Option<&'a Bowed>,
    /// Places to add, in order.
    pub(super) added: Vec<(Sample, Posture)>,
    solutions: Vec<Solution>,
}

impl<'a> Steps<'a> {
    pub(super) fn new(course: &'a Course<'a>, bowed: Option<&'a Bowed>) -> Self {
        Self { course, bowed, added: Vec::new(), solutions: Vec::new() }
    }

    /// Whether one posture leads to the other evenly, by way of the places it adds; where not, none
    /// is added.
    ///
    /// # Source
    /// Definition of a jump: MoveIt2 pull request 2916.
    pub(super) fn even(&mut self, from: (&Sample, &Stand), to: (&Sample, &Stand)) -> bool {
        let n_added = self.added.len();
        let even = self.half(from, to, HALVINGS);
        if !even {
            self.added.truncate(n_added);
        }
        even
    }

    fn half(&mut self, from: (&Sample, &Stand), to: (&Sample, &Stand), halvings: usize) -> bool {
        let sample = place::sample_between(from.0, to.0, 0.5);
        let turn = from.1.turn.mix(&to.1.turn, 0.5);
        let q = from.1.q.toward(&to.1.q, 0.5);
        let pose = match self.bowed {
            Some(bowed) => bowed.at(self.course.job, &sample),
            None => self.course.pose_within(&sample, &turn),
        };
        let (off_m, off_rad) = off(&self.course.job.cell.bed_from_tool(&q), &pose);
        if off_m <= EVEN_M && off_rad <= EVEN_RAD {
            return true;
        }
        if halvings == 0 {
            return false;
        }
        let Some(solution) = self.course.near(&pose, &turn, &q, &mut self.solutions) else {
            return false;
        };
        let stand = Stand { turn, q: solution.q };
        if !self.half(from, (&sample, &stand), halvings - 1) {
            return false;
        }
        self.added.push((sample, stand.q));
        self.half((&sample, &stand), to, halvings - 1)
    }
}

/// Distance of two poses of the nozzle, and the angle between its axes.
fn off(one: &Pose, other: &Pose) -> (f64, f64) {
    let place_m = (one.translation.vector - other.translation.vector).norm();
    (place_m, (one * Vector::z()).angle(&(other * Vector::z())))
}
