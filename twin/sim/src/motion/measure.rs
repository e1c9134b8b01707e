//! What is measured of the motion along a strand.

use crate::kinematics::Nearness;

/// What the arm does along one strand, at its worst, as a practitioner reads it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrandMotion {
    /// Largest share of a joint's speed limit at the asked print speed.
    pub joint_speed_share: f64,
    /// Where, and which joint.
    pub joint_speed_at: Spot,
    /// Least distance of a revolute joint to its stop, rad.
    pub joint_margin_rad: f64,
    /// Where, and which joint.
    pub joint_margin_at: Spot,
    /// Largest condition number, length scale 1 m.
    pub condition_number: f64,
    /// Where.
    pub condition_at: Spot,
    /// Least angle of the wrist from where its outer axes line up, rad.
    pub wrist_rad: Option<f64>,
    /// Where.
    pub wrist_at: Spot,
    /// Least angle of the elbow from straight or folded, rad.
    pub elbow_rad: Option<f64>,
    /// Where.
    pub elbow_at: Spot,
    /// Least distance of the wrist's centre from axis 1, m.
    pub shoulder_m: Option<f64>,
    /// Where.
    pub shoulder_at: Spot,
    /// Largest distance of the TCP from the strand as the job moves it, m.
    pub deviation_m: f64,
    /// The same if the controller moves in lines.
    pub deviation_linear_m: f64,
    /// The same if the joints turn evenly between points: the rows of a strand that brings them, else
    /// the samples.
    pub deviation_joint_m: f64,
}

/// Where along a strand, and which joint if it is one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Spot {
    /// Arc length, m.
    pub at_m: f64,
    /// Index in the joint vector; the chain knows its name.
    pub axis: Option<usize>,
}

impl StrandMotion {
    /// Of one posture at a place; `margin` with its joint.
    pub(super) fn of(at_m: f64, near: &Nearness, margin: Option<(usize, f64)>) -> Self {
        let here = Spot { at_m, axis: None };
        Self {
            joint_speed_share: 0.0,
            joint_speed_at: here,
            joint_margin_rad: margin.map_or(f64::INFINITY, |(_, margin_rad)| margin_rad),
            joint_margin_at: Spot { at_m, axis: margin.map(|(axis, _)| axis) },
            condition_number: near.condition,
            condition_at: here,
            wrist_rad: near.wrist_rad,
            wrist_at: here,
            elbow_rad: near.elbow_rad,
            elbow_at: here,
            shoulder_m: near.shoulder_m,
            shoulder_at: here,
            deviation_m: 0.0,
            deviation_linear_m: 0.0,
            deviation_joint_m: 0.0,
        }
    }

    /// The worse of two places, measure by measure; the first where they are alike.
    pub(super) fn worse(self, other: Self) -> Self {
        let least = |a: Option<f64>, b: Option<f64>| match (a, b) {
            (Some(a), Some(b)) => b < a,
            (a, b) => a.is_none() && b.is_some(),
        };
        let mut worst = self;
        if other.joint_speed_share > self.joint_speed_share {
            worst.joint_speed_share = other.joint_speed_share;
            worst.joint_speed_at = other.joint_speed_at;
        }
        if other.joint_margin_rad < self.joint_margin_rad {
            worst.joint_margin_rad = other.joint_margin_rad;
            worst.joint_margin_at = other.joint_margin_at;
        }
        if other.condition_number > self.condition_number {
            worst.condition_number = other.condition_number;
            worst.condition_at = other.condition_at;
        }
        if least(self.wrist_rad, other.wrist_rad) {
            (worst.wrist_rad, worst.wrist_at) = (other.wrist_rad, other.wrist_at);
        }
        if least(self.elbow_rad, other.elbow_rad) {
            (worst.elbow_rad, worst.elbow_at) = (other.elbow_rad, other.elbow_at);
        }
        if least(self.shoulder_m, other.shoulder_m) {
            (worst.shoulder_m, worst.shoulder_at) = (other.shoulder_m, other.shoulder_at);
        }
        worst.deviation_m = self.deviation_m.max(other.deviation_m);
        worst.deviation_linear_m = self.deviation_linear_m.max(other.deviation_linear_m);
        worst.deviation_joint_m = self.deviation_joint_m.max(other.deviation_joint_m);
        worst
    }
}
