//! Three sliding joints: a printer. The tip's place is a linear function of `q`, its rotation fixed.

use nalgebra::Matrix3;

use super::chain::{Chain, JointKind};
use super::posture::Posture;
use crate::pose::{Pose, Vector};

/// A recognised printer: `tip = origin + directions · q`.
#[derive(Debug, Clone, PartialEq)]
pub struct Cartesian {
    origin: Vector,
    inverse: Matrix3<f64>,
}

impl Cartesian {
    /// Fits a chain of three sliding joints that span space.
    pub(super) fn fit(chain: &Chain) -> Option<Self> {
        let slides = chain.joints().iter().all(|joint| joint.kind == JointKind::Prismatic);
        if !slides || chain.dof() != 3 {
            return None;
        }
        let zero = [0.0; 3];
        let directions = chain.jacobian(&zero).fixed_view::<3, 3>(0, 0).into_owned();
        if directions.determinant().abs() < 1e-3 {
            return None;
        }
        let inverse = directions.try_inverse()?;
        Some(Self { origin: chain.forward(&zero).translation.vector, inverse })
    }

    /// The one posture, limits aside, whose tip stands at the target's origin.
    pub(super) fn solve(&self, target: &Pose) -> Posture {
        Posture::new((self.inverse * (target.translation.vector - self.origin)).as_slice())
    }
}
