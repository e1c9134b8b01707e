//! A canonical arm set up where the chain stands, and how well the two agree.

use super::canonical::{JointMap, turn_y, turn_z};
use super::lines::Line;
use crate::pose::{Pose, Vector};

/// Which of its own axes a canonical joint turns about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum About {
    Y,
    Z,
}

/// One joint of a canonical arm: it turns, then the arm goes on by a shift, m.
pub(super) type Step = (About, Vector);

/// Tip of a canonical arm: product of `turn · shift`.
pub(super) fn forward(steps: &[Step], theta: &[f64]) -> Pose {
    let mut pose = Pose::identity();
    for ((about, shift), angle) in steps.iter().zip(theta) {
        pose *= match about {
            About::Y => turn_y(*angle),
            About::Z => turn_z(*angle),
        };
        pose.translation.vector += pose.rotation * shift;
    }
    pose
}

/// Closed form and chain differ by no more than this where the URDF is exact, m and rad.
const EXACT: f64 = 1e-12;

/// The fixed ends of a canonical arm.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mount {
    canonical_from_base: Pose,
    tip_from_flange: Pose,
    /// Last canonical axes to tip, m.
    pub(super) tool_m: f64,
    /// In any posture the chain's tip is within this of the canonical arm's, m.
    pub(super) misfit_m: f64,
    /// The same for the angle between them, rad.
    pub(super) misfit_rad: f64,
}

impl Mount {
    /// Mount with the canonical axes at `base` and the tip at `tool` on the canonical flange; `lines`
    /// and `tip` are the chain's, joints at zero.
    pub(super) fn new(
        (base, tool): (&Pose, &Pose),
        steps: &[Step],
        maps: &[JointMap],
        lines: &[Line],
        tip: &Pose,
    ) -> Self {
        let tool_m = tool.translation.vector.norm();
        let mut mount = Self {
            canonical_from_base: base.inverse(),
            tip_from_flange: tool.inverse(),
            tool_m,
            misfit_m: 0.0,
            misfit_rad: 0.0,
        };
        let mut pose = *base;
        let mut rest_m = tool_m + steps.iter().map(|(_, shift)| shift.norm()).sum::<f64>();
        for ((step, map), line) in steps.iter().zip(maps).zip(lines) {
            mount.add_misfit(&pose, step.0, map.sign, line, rest_m);
            pose *= forward(&[*step], &[map.zero_rad]);
            rest_m -= step.1.norm();
        }
        let end = pose * tool;
        mount.misfit_m += (end.translation.vector - tip.translation.vector).norm();
        mount.misfit_rad += end.rotation.angle_to(&tip.rotation);
        mount
    }

    /// Law: turning a point at most `rest_m` from the canonical axis' origin about an axis that is
    /// tilted by `tilt` and shifted by `gap` puts it at most `2 gap + 2 tilt rest_m` elsewhere and `2 tilt`
    /// turned, whatever the angle; motions before and after change no distance, so the sum over the joints
    /// bounds the whole.
    fn add_misfit(&mut self, pose: &Pose, about: About, sign: f64, line: &Line, rest_m: f64) {
        let own = match about {
            About::Y => Vector::y(),
            About::Z => Vector::z(),
        };
        let direction = pose.rotation * own * sign;
        let tilt = (direction - line.direction).norm();
        let apart = line.point - pose.translation.vector;
        let gap = (apart - line.direction * line.direction.dot(&apart)).norm();
        self.misfit_m += 2.0 * (gap + tilt * rest_m);
        self.misfit_rad += 2.0 * tilt;
    }

    /// Canonical flange for a tip on `target`.
    pub(super) fn flange(&self, target: &Pose) -> Pose {
        self.canonical_from_base * target * self.tip_from_flange
    }

    /// Whether the canonical arm is the chain, to rounding.
    pub(super) fn exact(&self) -> bool {
        self.misfit_m < EXACT && self.misfit_rad < EXACT
    }
}
