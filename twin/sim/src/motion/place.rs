//! A place on a strand with what is free about it: where the nozzle stands, and which postures put it there.

use std::f64::consts::{PI, TAU};

use nalgebra::UnitQuaternion;

use super::cost::Costs;
use super::tilt;
use crate::cell::{Job, LinearMove, Orientation};
use crate::kinematics::{Arm, IkOptions, Posture, Solution};
use crate::pose::{Pose, Vector, from_z_axis};
use crate::toolpath::{Path, Sample};

/// What is free about a place: spin, lean (two), elbow angle, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turn(pub(super) [f64; 4]);

impl Turn {
    /// Entry of the spin.
    pub(super) const SPIN: usize = 0;
    /// First entry of the lean; the second follows.
    pub(super) const LEAN: usize = 1;
    /// Entry of the elbow angle.
    pub(super) const ELBOW: usize = 3;

    pub(super) fn new(spin_rad: f64, [a, b]: [f64; 2], elbow_rad: f64) -> Self {
        Self([spin_rad, a, b, elbow_rad])
    }

    fn lean(&self) -> [f64; 2] {
        [self.0[Self::LEAN], self.0[Self::LEAN + 1]]
    }

    /// Entry by entry to `to`; spin and elbow on the shorter way.
    fn to(&self, to: &Self) -> [f64; 4] {
        std::array::from_fn(|k| {
            let change = to.0[k] - self.0[k];
            if k == Self::SPIN || k == Self::ELBOW {
                (change + PI).rem_euclid(TAU) - PI
            } else {
                change
            }
        })
    }

    /// Part of the way to `to`.
    pub(super) fn mix(&self, to: &Self, share: f64) -> Self {
        let change = self.to(to);
        Self(std::array::from_fn(|k| self.0[k] + change[k] * share))
    }

    /// Length of the way to `to`, and the part of it that turns the nozzle, rad.
    pub(super) fn apart(&self, to: &Self) -> [f64; 2] {
        let change = self.to(to);
        let nozzle = change[0].hypot(change[1]).hypot(change[2]);
        [nozzle.hypot(change[3]), nozzle]
    }
}

/// One strand and all that decides its postures.
pub(super) struct Course<'a> {
    pub(super) job: &'a Job,
    pub(super) path: &'a Path,
    pub(super) costs: Costs<'a>,
}

impl<'a> Course<'a> {
    pub(super) fn new(job: &'a Job, path: &'a Path) -> Self {
        Self { job, path, costs: Costs::new(job) }
    }

    pub(super) fn orientation(&self) -> &Orientation {
        &self.job.strands[self.path.strand].settings.orientation
    }

    /// Whether linear moves follow the part's next point rather than the line.
    pub(super) fn sets_tools(&self) -> bool {
        self.job.cell.controller.linear == LinearMove::SetTool
    }

    /// Pose of the nozzle in bed axes; `None` where the lean is past its bounds.
    pub(super) fn pose(&self, sample: &Sample, turn: &Turn) -> Option<Pose> {
        let followed = self.job.bed_from_part * sample.nozzle;
        let axis = tilt::leaned(&followed, turn.lean(), self.orientation())?;
        let unspun = from_z_axis(self.job.bed_from_part * sample.point, axis, Vector::x());
        Some(unspun * UnitQuaternion::from_axis_angle(&Vector::z_axis(), turn.0[Turn::SPIN]))
    }

    /// The same, leaned no further than the bounds allow: between two leans within them there may be
    /// one that is not.
    pub(super) fn pose_within(&self, sample: &Sample, turn: &Turn) -> Pose {
        let mut turn = *turn;
        loop {
            if let Some(pose) = self.pose(sample, &turn) {
                return pose;
            }
            let [a, b] = turn.lean().map(|lean| if lean.abs() < 1e-6 { 0.0 } else { lean * 0.9 });
            (turn.0[Turn::LEAN], turn.0[Turn::LEAN + 1]) = (a, b);
        }
    }

    /// The posture nearest to `seed` that puts the nozzle at `bed_from_tool`.
    pub(super) fn near(
        &self,
        bed_from_tool: &Pose,
        turn: &Turn,
        seed: &Posture,
        solutions: &mut Vec<Solution>,
    ) -> Option<Solution> {
        solve(
            &self.job.cell.robot.arm,
            self.job,
            bed_from_tool,
            turn.0[Turn::ELBOW],
            Some(seed),
            solutions,
        );
        let travel = |solution: &Solution| self.costs.travel(seed, &solution.q);
        solutions.iter().min_by(|a, b| travel(a).total_cmp(&travel(b))).copied()
    }
}

/// Orientation of the nozzle is kept to this, rad: far below what a print would show.
const ORIENTATION_RAD: f64 = 1e-3;

/// All postures of an arm in the cell that put the nozzle at `bed_from_tool`.
pub(super) fn solve(
    arm: &Arm,
    job: &Job,
    bed_from_tool: &Pose,
    elbow_rad: f64,
    seed: Option<&[f64]>,
    out: &mut Vec<Solution>,
) {
    let target = job.cell.world_from_tip(bed_from_tool);
    arm.inverse(&target, &IkOptions { seed, elbow_rad }, out);
    // A machine that cannot turn answers for the place alone.
    out.retain(|solution| solution.rotation_error_rad <= ORIENTATION_RAD);
}

/// The place at share `t` of the way from one sample to the next.
pub(super) fn sample_between(from: &Sample, to: &Sample, t: f64) -> Sample {
    let mixed = from.nozzle.lerp(&to.nozzle, t);
    Sample {
        at_m: from.at_m + (to.at_m - from.at_m) * t,
        point: from.point + (to.point - from.point) * t,
        tangent: to.tangent,
        nozzle: if mixed.norm() > 1e-6 { mixed.normalize() } else { from.nozzle },
        vertex: false,
        ..*from
    }
}

/// The place at arc length `at_m` of a sampled strand, and the number of samples before it.
pub(super) fn sample_at(samples: &[Sample], at_m: f64) -> (usize, Sample) {
    const SAME_M: f64 = 1e-12;
    let k = samples.partition_point(|sample| sample.at_m < at_m - SAME_M).min(samples.len() - 1);
    let to = &samples[k];
    if k == 0 || to.at_m <= at_m + SAME_M {
        return (k, *to);
    }
    let from = &samples[k - 1];
    (k, sample_between(from, to, (at_m - from.at_m) / (to.at_m - from.at_m)))
}
