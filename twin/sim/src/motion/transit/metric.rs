//! Lengths in joint space, and the box that postures are drawn from.

use crate::cell::{Job, Mode};
use crate::kinematics::{Chain, ChainAxis, JointKind, MAX_DOF, Posture};

/// What a joint's turn is worth.
#[derive(Debug, Clone)]
pub(super) struct Metric {
    /// How far a radian of each joint (a metre of a sliding one) may carry what hangs on it, m.
    reach_m: [f64; MAX_DOF],
    /// Speed of each joint, rad/s or m/s.
    speed: [f64; MAX_DOF],
}

impl Metric {
    /// The metric of a job's arm with what rides on its flange.
    pub(super) fn of(job: &Job) -> Self {
        let cell = &job.cell;
        let corners = cell.tool.parts.iter().flat_map(|part| &part.shapes);
        let ridden_m = match cell.mode {
            Mode::ToolOnFlange => corners
                .flat_map(|shape| shape.corners().into_iter().map(|c| (cell.tool_pose * c).coords))
                .map(|corner| corner.norm())
                .fold(0.0, f64::max),
            Mode::BedOnFlange => {
                let [width, depth, height] = cell.bed.size_m;
                cell.bed.pose.translation.vector.norm() + width.hypot(depth).hypot(height)
            }
        };
        Self::new(&cell.robot.arm.chain, ridden_m)
    }

    /// `ridden_m`: what rides on the tip reaches this far from it.
    ///
    /// ```text
    /// w_j = Σ_{k>j} |offset of joint k| + |tip| + ridden      (turning)      1 (sliding)
    /// |a − b| = √ Σ_j (w_j (a_j − b_j))²
    /// ```
    ///
    /// `w_j` bounds the motion of any point behind the joint, so lengths are those of real motion
    /// and the wrist does not count like the base.
    pub(super) fn new(chain: &Chain, ridden_m: f64) -> Self {
        let mut reach_m = [1.0; MAX_DOF];
        let mut speed = [1.0; MAX_DOF];
        for (index, axis) in chain.axes().iter().enumerate().take(MAX_DOF) {
            let turns = chain.joints()[axis.joint].kind == JointKind::Revolute;
            let behind = chain.joints()[axis.joint + 1..].iter().map(|joint| {
                let slides = joint.kind == JointKind::Prismatic && joint.upper.is_finite();
                let slide_m = if slides { joint.lower.abs().max(joint.upper.abs()) } else { 0.0 };
                joint.parent_from_joint.translation.vector.norm() + slide_m
            });
            let tip_m = chain.last_from_tip().translation.vector.norm();
            let arm_m: f64 = behind.sum::<f64>() + tip_m + ridden_m;
            // A joint that moves nothing must still cost something.
            reach_m[index] = if turns { arm_m.max(0.05) } else { 1.0 };
            speed[index] = axis.velocity;
        }
        Self { reach_m, speed }
    }

    /// Length of a straight move, m.
    pub(super) fn length(&self, from: &Posture, to: &Posture) -> f64 {
        let joints = from.iter().zip(to.iter()).zip(&self.reach_m);
        joints.map(|((a, b), reach)| ((a - b) * reach).powi(2)).sum::<f64>().sqrt()
    }

    /// Least time that the joints need for a way, s.
    pub(super) fn time(&self, way: &[Posture]) -> f64 {
        let step = |pair: &[Posture]| {
            let joints = pair[0].iter().zip(pair[1].iter()).zip(&self.speed);
            joints.map(|((a, b), speed)| (a - b).abs() / speed).fold(0.0, f64::max)
        };
        way.windows(2).map(step).sum()
    }
}

/// A box in joint space.
#[derive(Debug, Clone, Copy)]
pub(super) struct Room {
    pub(super) low: Posture,
    pub(super) high: Posture,
}

impl Room {
    /// Within limits less `margin_rad` of turning joints, and all of `inside`. A joint without
    /// limits gets half a turn beyond what is inside.
    pub(super) fn new(chain: &Chain, margin_rad: f64, inside: &[Posture]) -> Self {
        let mut room = Self { low: Posture::zeros(chain.dof()), high: Posture::zeros(chain.dof()) };
        for (index, axis) in chain.axes().iter().enumerate().take(room.low.len()) {
            let values = inside.iter().map(|q| q[index]);
            let (least, most) = values
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), q| (f64::min(l, q), h.max(q)));
            let (low, high) = limits(chain, axis, margin_rad, least, most);
            room.low[index] = low.min(least);
            room.high[index] = high.max(most);
        }
        room
    }
}

fn limits(chain: &Chain, axis: &ChainAxis, margin_rad: f64, least: f64, most: f64) -> (f64, f64) {
    let turns = chain.joints()[axis.joint].kind == JointKind::Revolute;
    let margin = if turns { margin_rad } else { 0.0 };
    let half_turn = std::f64::consts::PI;
    let low = if axis.lower.is_finite() { axis.lower + margin } else { least - half_turn };
    let high = if axis.upper.is_finite() { axis.upper - margin } else { most + half_turn };
    // Limits nearer to each other than their margins leave their middle.
    if low <= high { (low, high) } else { ((low + high) / 2.0, (low + high) / 2.0) }
}
