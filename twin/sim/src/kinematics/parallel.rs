//! Six joints with three parallel axes and an offset wrist, as Universal Robots builds them.
//!
//! Canonical arm:
//! `Rz(θ1) T(a1, b, c1) Ry(θ2) T(0, 0, c2) Ry(θ3) T(0, 0, c3) Ry(θ4) Rz(θ5) T(0, 0, c4) Ry(θ6)`.
//! The plane of the arm fixes θ1, the rotation then θ2 + θ3 + θ4, θ5 and θ6, and what is left are
//! two links in a plane (compare Hawkins, *Analytic Inverse Kinematics for the Universal Robots
//! UR-5/UR-10 Arms*, 2013).

use std::f64::consts::FRAC_PI_2;

use nalgebra::Matrix3;

use super::branch::Branch;
use super::canonical::{JointMap, axes_pose, seed_theta, shift, sign, to_q, turn_y, turn_z};
use super::lines::{Line, TOLERANCE};
use super::planar::{swing, two_links};
use super::posture::Posture;
use super::singularity::from_line;
use super::wrist::zyz;
use crate::pose::{Pose, Vector};

/// Lengths of the canonical arm, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParallelParameters {
    /// Axis 1 to axis 2, forwards.
    pub a1: f64,
    /// Meeting point of axes 4 and 5 beside axis 1.
    pub b: f64,
    /// Height of axis 2 over the foot of the base's origin on axis 1.
    pub c1: f64,
    /// Axis 2 to axis 3.
    pub c2: f64,
    /// Axis 3 to axis 4.
    pub c3: f64,
    /// Axis 4 to axis 6, along axis 5.
    pub c4: f64,
}

/// A recognised arm.
#[derive(Debug, Clone, PartialEq)]
pub struct Parallel {
    /// Lengths.
    pub parameters: ParallelParameters,
    /// Joint values to canonical angles.
    pub maps: [JointMap; 6],
    base_from_canonical: Pose,
    flange_from_tip: Pose,
}

impl ParallelParameters {
    fn forward(&self, theta: &[f64; 6]) -> Pose {
        turn_z(theta[0])
            * shift(self.a1, self.b, self.c1)
            * turn_y(theta[1])
            * shift(0.0, 0.0, self.c2)
            * turn_y(theta[2])
            * shift(0.0, 0.0, self.c3)
            * turn_y(theta[3])
            * turn_z(theta[4])
            * shift(0.0, 0.0, self.c4)
            * turn_y(theta[5])
    }
}

impl Parallel {
    /// Fits the canonical arm to six axes; `None` where they are of another kind.
    pub(super) fn fit(lines: &[Line], tip: &Pose) -> Option<Self> {
        let [l1, l2, l3, l4, l5, l6] = lines else { return None };
        let shaped = l1.perpendicular(l2)
            && l2.parallel(l3)
            && l3.parallel(l4)
            && l4.perpendicular(l5)
            && l5.perpendicular(l6);
        if !shaped {
            return None;
        }
        let (wrist, hand) = (l4.meets(l5)?, l5.meets(l6)?);
        let (across, up) = (l2.direction, l1.direction);
        let foot = l1.foot(&Vector::zeros());
        let base = axes_pose(&foot, &across, &up);
        let local = |v: Vector| base.rotation.inverse() * v;

        let shoulder = local(l2.point - foot);
        let upper = local(l3.point - l2.point);
        let lower = local(wrist - l3.point);
        let sign5 = sign(&l5.direction, &(hand - wrist));
        let along5 = local(l5.direction) * sign5;
        let p = ParallelParameters {
            a1: shoulder.x,
            b: local(wrist - foot).y,
            c1: shoulder.z,
            c2: upper.x.hypot(upper.z),
            c3: lower.x.hypot(lower.z),
            c4: (hand - wrist).norm(),
        };
        if p.c2 < TOLERANCE || p.c3 < TOLERANCE {
            return None;
        }
        let theta2 = upper.x.atan2(upper.z);
        let theta23 = lower.x.atan2(lower.z);
        let theta234 = along5.x.atan2(along5.z);
        let along6 = (turn_y(theta234)).rotation.inverse() * local(l6.direction);
        let theta5 = (-along6.x).atan2(along6.y);
        let signs =
            [1.0, 1.0, sign(&across, &l3.direction), sign(&across, &l4.direction), sign5, 1.0];
        let theta = [0.0, theta2, theta23 - theta2, theta234 - theta23, theta5, 0.0];
        let tool = (base * p.forward(&theta)).inverse() * tip;
        let mut maps = [JointMap { sign: 1.0, zero_rad: 0.0 }; 6];
        for (map, (sign, zero_rad)) in maps.iter_mut().zip(signs.into_iter().zip(theta)) {
            *map = JointMap { sign, zero_rad };
        }
        Some(Self { parameters: p, maps, base_from_canonical: base, flange_from_tip: tool })
    }

    /// Every posture, limits aside, that puts the tip on `target`.
    pub(super) fn candidates(
        &self,
        target: &Pose,
        seed: Option<&[f64]>,
        each: &mut dyn FnMut(Posture, Branch),
    ) {
        let p = &self.parameters;
        let hand = self.base_from_canonical.inv_mul(target) * self.flange_from_tip.inverse();
        let at = hand.translation.vector;
        let free = |index| seed_theta(&self.maps, seed, index);
        let free_sum = free(1) + free(2) + free(3);
        let Some(swings) = swing(at.x, at.y, p.b, free(0)) else { return };
        for (behind, (theta1, forward)) in swings.into_iter().enumerate() {
            let turned = (turn_z(-theta1) * hand).rotation.to_rotation_matrix().into_inner();
            for (flip, [sum, theta5, theta6]) in yzy(&turned, free_sum).into_iter().enumerate() {
                let (sin, cos) = sum.sin_cos();
                let x = forward - p.a1 - p.c4 * sin;
                let z = at.z - p.c1 - p.c4 * cos;
                let links = two_links(x, z, p.c2, p.c3);
                for (below, (theta2, theta3)) in links.into_iter().flatten().enumerate() {
                    let theta4 = sum - theta2 - theta3;
                    let theta = [theta1, theta2, theta3, theta4, theta5, theta6];
                    let branch =
                        Branch { shoulder: behind == 1, elbow: below == 1, wrist: flip == 1 };
                    each(to_q(&self.maps, &theta), branch);
                }
            }
        }
    }

    fn thetas(&self, q: &[f64]) -> [f64; 6] {
        std::array::from_fn(|index| self.maps[index].theta(q[index]))
    }

    /// Meeting point of axes 5 and 6 in front of axis 1, in the plane of the arm, m.
    fn forward_m(&self, theta: &[f64; 6]) -> f64 {
        let p = &self.parameters;
        let (two, three) = (theta[1], theta[1] + theta[2]);
        p.a1 + p.c2 * two.sin() + p.c3 * three.sin() + p.c4 * (three + theta[3]).sin()
    }

    /// Branch of a posture.
    pub fn branch(&self, q: &[f64]) -> Branch {
        let theta = self.thetas(q);
        Branch {
            shoulder: self.forward_m(&theta) < 0.0,
            elbow: theta[2].sin() < 0.0,
            wrist: theta[4].sin() < 0.0,
        }
    }

    /// Angles of axis 5 and of the elbow from where the arm is singular, rad, and how far the meeting
    /// point of axes 5 and 6 is from the cylinder about axis 1 that it cannot enter, m.
    pub(super) fn distances(&self, q: &[f64]) -> (f64, f64, f64) {
        let theta = self.thetas(q);
        (from_line(theta[4]), from_line(theta[2]), self.forward_m(&theta).abs())
    }
}

/// Both `[a, b, c]` with `Ry(a) Rz(b) Ry(c) = m`, by renaming the axes y, z, x to z, x, y and
/// `Rx(b) = Rz(−π/2) Ry(b) Rz(π/2)`.
fn yzy(m: &Matrix3<f64>, free: f64) -> [[f64; 3]; 2] {
    const OLD: [usize; 3] = [2, 0, 1];
    let renamed = Matrix3::from_fn(|row, column| m[(OLD[row], OLD[column])]);
    // The second of two turned solutions is the first with `a + π`: sign of `b` as in `zyz`.
    zyz(&renamed, free - FRAC_PI_2).map(|[a, b, c]| [a + FRAC_PI_2, b, c - FRAC_PI_2])
}
