//! What makes one posture better than another.
//!
//! All costs are on the scale of joint travel, rad. Past an error limit a posture is dear, in
//! proportion to how far; past a warning limit a tenth of that; a flip is dearer than anything else
//! a strand can have.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::cell::{Job, Limits};
use crate::kinematics::{
    Arm, Branch, JointKind, MAX_DOF, Posture, Solver, limit_margins, nearness,
};

/// Dearer than any posture that keeps its branch.
pub(super) const FLIP_COST: f64 = 1e6;
/// Past an error limit, and past a warning limit.
const DEAR: f64 = 30.0;
const WARNS: f64 = 3.0;
/// Growth of the dislike towards a limit: `weight/(distance + SOFT_RAD)`.
const SOFT_RAD: f64 = 0.05;
const SOFT_M: f64 = 0.02;

/// Dislikes of one arm in one job.
pub(super) struct Costs<'a> {
    arm: &'a Arm,
    limits: &'a Limits,
    /// Joints without stops: a full turn is no travel.
    endless: [bool; MAX_DOF],
    /// Sliding joints have neither singularities nor a margin in degrees.
    turns: [bool; MAX_DOF],
}

/// What a step along the strand costs beside its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Step {
    /// Time it takes at the asked speed, s.
    pub(super) dt_s: f64,
    /// How far the nozzle leaves the strand for a turn of the nozzle, m/rad.
    pub(super) bow_m_per_rad: f64,
}

impl<'a> Costs<'a> {
    pub(super) fn new(job: &'a Job) -> Self {
        let arm = &job.cell.robot.arm;
        let (mut endless, mut turns) = ([false; MAX_DOF], [false; MAX_DOF]);
        for (k, axis) in arm.chain.axes().iter().enumerate().take(MAX_DOF) {
            endless[k] = axis.periodic && !(axis.lower.is_finite() && axis.upper.is_finite());
            turns[k] = arm.chain.joints()[axis.joint].kind == JointKind::Revolute;
        }
        Self { arm, limits: &job.limits, endless, turns }
    }

    /// Whether postures come from a search rather than a closed form.
    pub(super) fn searched(&self) -> bool {
        matches!(self.arm.solver, Solver::Numeric(_))
    }

    fn change(&self, axis: usize, from: f64, to: f64) -> f64 {
        let change = to - from;
        if self.endless[axis] { (change + PI).rem_euclid(TAU) - PI } else { change }
    }

    /// Sum of joint travel, rad or m.
    pub(super) fn travel(&self, from: &[f64], to: &[f64]) -> f64 {
        let pairs = from.iter().zip(to).enumerate();
        pairs.map(|(axis, (a, b))| self.change(axis, *a, *b).abs()).sum()
    }

    /// `to` with its endless joints turned to be nearest to `from`.
    pub(super) fn unwound(&self, from: &[f64], to: &Posture) -> Posture {
        let mut unwound = *to;
        for (axis, (value, from)) in unwound.iter_mut().zip(from).enumerate() {
            if self.endless[axis] {
                *value = from + self.change(axis, *from, *value);
            }
        }
        unwound
    }

    /// Dislike of a posture: nearness to stops and singularities.
    pub(super) fn posture(&self, q: &Posture) -> f64 {
        if matches!(self.arm.solver, Solver::Cartesian(_)) {
            return 0.0;
        }
        let limits = self.limits;
        let mut cost = 0.0;
        for (axis, margin) in limit_margins(&self.arm.chain, q).iter().enumerate() {
            if self.turns[axis] && margin.is_finite() {
                cost += 0.03 / (margin.max(0.0) + SOFT_RAD)
                    + DEAR * missing(*margin, limits.joint_margin_rad);
            }
        }
        let near = nearness(self.arm, q);
        let soft = |distance: Option<f64>, weight: f64, soft: f64| {
            distance.map_or(0.0, |distance| weight / (distance + soft))
        };
        cost += soft(near.wrist_rad, 0.1, SOFT_RAD)
            + soft(near.elbow_rad, 0.05, SOFT_RAD)
            + soft(near.shoulder_rad, 0.02, SOFT_RAD)
            + soft(near.shoulder_m, 0.01, SOFT_M);
        cost += WARNS * near.wrist_rad.map_or(0.0, |wrist| missing(wrist, limits.wrist_rad));
        let [warn, stop] = limits.condition_number;
        let condition = near.condition.min(100.0 * stop);
        cost + WARNS * (condition / warn - 1.0).max(0.0) + DEAR * (condition / stop - 1.0).max(0.0)
    }

    /// Dislike of a clearance; zero from twice the limit on.
    pub(super) fn clearance(&self, clearance_m: f64) -> f64 {
        let limit_m = self.limits.clearance_m;
        // A body deep in another is no worse than one ten limits deep.
        let clearance_m = clearance_m.max(-10.0 * limit_m);
        let warns = (2.0 - clearance_m / limit_m).clamp(0.0, 1.0);
        0.1 * WARNS * warns + DEAR * missing(clearance_m, limit_m)
    }

    /// Whether one posture leads to the other without a flip.
    pub(super) fn keeps(&self, from: (&Posture, Branch), to: (&Posture, Branch)) -> bool {
        from.1 == to.1
            && (0..from.0.len())
                .all(|axis| self.change(axis, from.0[axis], to.0[axis]).abs() <= FRAC_PI_2)
    }

    /// Cost of the way between two postures that keep their branch; `turn_rad` of the nozzle.
    pub(super) fn step(&self, from: &Posture, to: &Posture, turn_rad: f64, step: &Step) -> f64 {
        let (mut travel, mut busiest) = (0.0, 0.0f64);
        for (axis, limit) in self.arm.chain.axes().iter().enumerate() {
            let change = self.change(axis, from[axis], to[axis]).abs();
            travel += change;
            busiest = busiest.max(change / limit.velocity);
        }
        let speed_share = busiest / step.dt_s.max(1e-9) / self.limits.joint_speed_share;
        let bow = turn_rad * step.bow_m_per_rad / self.limits.node_miss_m;
        travel + DEAR * (speed_share.min(100.0) - 1.0).max(0.0) + DEAR * bow.min(100.0)
    }
}

/// How much of a limit is missing, 0 at it; one more at once below it, so that a little past it is
/// worse than anything on the good side.
fn missing(value: f64, limit: f64) -> f64 {
    if value < limit { 2.0 - value / limit } else { 0.0 }
}
