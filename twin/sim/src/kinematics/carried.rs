//! How axes that ride on the tip move when the joints do.

use super::chain::{Chain, JointKind, advance};
use crate::pose::{Pose, Vector};

/// Motion of axes against the base, told in those axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carried {
    /// Acceleration of their origin, m/s².
    pub acceleration_m_s2: Vector,
    /// Angular acceleration, rad/s².
    pub alpha_rad_s2: Vector,
    /// Turning speed, rad/s.
    pub omega_rad_s: Vector,
}

impl Chain {
    /// Motion of the axes `tip_from_axes` at joint values, speeds and accelerations (each with
    /// [`Chain::dof`] entries).
    ///
    /// Law: outwards along the chain, in base axes (Luh, Walker, Paul 1980). Over a lever d the
    /// origin gains `α × d + ω × (ω × d)`; a turning joint about a adds `ω × a q̇ + a q̈` to α and
    /// `a q̇` to ω; a sliding one adds `2 ω × a q̇ + a q̈` to the acceleration. A joint that follows
    /// another goes at its multiple. Rounding only.
    pub fn carried(&self, [q, speed, acceleration]: [&[f64]; 3], tip_from_axes: &Pose) -> Carried {
        let mut pose = Pose::identity();
        let [mut a, mut alpha, mut omega] = [Vector::zeros(); 3];
        for (joint, drive) in self.joints().iter().zip(&self.drives) {
            let from = pose.translation.vector;
            pose *= joint.parent_from_joint;
            let axis = pose.rotation * joint.axis;
            let [rate, gain] = [speed, acceleration].map(|of| drive.multiplier * of[drive.axis]);
            advance(&mut pose, joint, drive.value(q));
            let lever = pose.translation.vector - from;
            a += alpha.cross(&lever) + omega.cross(&omega.cross(&lever));
            match joint.kind {
                JointKind::Revolute => {
                    alpha += omega.cross(&axis) * rate + axis * gain;
                    omega += axis * rate;
                }
                JointKind::Prismatic => a += omega.cross(&axis) * (2.0 * rate) + axis * gain,
            }
        }
        let from = pose.translation.vector;
        pose *= self.last_from_tip() * tip_from_axes;
        let lever = pose.translation.vector - from;
        a += alpha.cross(&lever) + omega.cross(&omega.cross(&lever));
        let back = pose.rotation.inverse();
        Carried {
            acceleration_m_s2: back * a,
            alpha_rad_s2: back * alpha,
            omega_rad_s: back * omega,
        }
    }
}
