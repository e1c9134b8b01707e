//! The chain's axes as lines in space, all joints at zero: what recognition looks at.

use super::chain::{Chain, JointKind, advance};
use crate::pose::{Pose, Vector};

/// Lengths and sines smaller than this count as zero, m and rad; URDFs print π to seven digits.
pub(super) const TOLERANCE: f64 = 1e-6;

/// A joint's axis in base at `q = 0`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    pub(super) point: Vector,
    pub(super) direction: Vector,
}

impl Line {
    /// Where the line passes `from` nearest.
    pub(super) fn foot(&self, from: &Vector) -> Vector {
        self.point + self.direction * self.direction.dot(&(from - self.point))
    }

    pub(super) fn parallel(&self, other: &Self) -> bool {
        self.direction.cross(&other.direction).norm() < TOLERANCE
    }

    pub(super) fn perpendicular(&self, other: &Self) -> bool {
        self.direction.dot(&other.direction).abs() < TOLERANCE
    }

    /// Where two lines that are perpendicular meet, if they do.
    pub(super) fn meets(&self, other: &Self) -> Option<Vector> {
        let on_self = self.foot(&other.point);
        // For perpendicular lines the foot of any point of one lies at the nearest point.
        let on_other = other.foot(&on_self);
        ((on_self - on_other).norm() < TOLERANCE).then_some(0.5 * (on_self + on_other))
    }
}

/// Axes of a chain of revolute joints that each move by themselves, and the tip, at `q = 0`.
pub(super) fn lines(chain: &Chain) -> Option<(Vec<Line>, Pose)> {
    let mut lines = Vec::with_capacity(chain.joints().len());
    let mut pose = Pose::identity();
    for joint in chain.joints() {
        if joint.kind != JointKind::Revolute || joint.mimic.is_some() {
            return None;
        }
        pose *= joint.parent_from_joint;
        lines.push(Line { point: pose.translation.vector, direction: pose.rotation * joint.axis });
        advance(&mut pose, joint, 0.0);
    }
    Some((lines, pose * chain.last_from_tip()))
}
