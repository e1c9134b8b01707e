//! Seven joints: three axes that meet at the shoulder, one at the elbow, three that meet at the wrist.
//!
//! Canonical arm, shoulder at the origin:
//! `Rz(θ1) Ry(θ2) Rz(θ3) T(0, 0, upper) Ry(θ4) T(0, 0, lower) Rz(θ5) Ry(θ6) Rz(θ7)`. Shoulder, elbow and wrist
//! form a triangle with given sides; its turn about the line shoulder → wrist is the elbow angle.

use nalgebra::Matrix3;

use super::branch::Branch;
use super::canonical::{JointMap, axes_pose, seed_theta, shift, sign, to_q, turn_y, turn_z};
use super::lines::{Line, TOLERANCE};
use super::planar::bend;
use super::posture::Posture;
use super::singularity::from_line;
use super::wrist::zyz;
use crate::pose::{Pose, Vector};

/// Lengths of the canonical arm, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SrsParameters {
    /// Shoulder to elbow.
    pub upper: f64,
    /// Elbow to wrist.
    pub lower: f64,
}

/// A recognised arm.
#[derive(Debug, Clone, PartialEq)]
pub struct Srs {
    /// Lengths.
    pub parameters: SrsParameters,
    /// Joint values to canonical angles.
    pub maps: [JointMap; 7],
    base_from_canonical: Pose,
    wrist_from_tip: Pose,
}

/// Triangle sides may miss by this much before a pose is called out of reach, m.
const SLACK_M: f64 = 1e-9;

impl SrsParameters {
    fn forward(&self, theta: &[f64; 7]) -> Pose {
        turn_z(theta[0])
            * turn_y(theta[1])
            * turn_z(theta[2])
            * shift(0.0, 0.0, self.upper)
            * turn_y(theta[3])
            * shift(0.0, 0.0, self.lower)
            * turn_z(theta[4])
            * turn_y(theta[5])
            * turn_z(theta[6])
    }
}

impl Srs {
    /// Fits the canonical arm to seven axes; `None` where they are of another kind.
    pub(super) fn fit(lines: &[Line], tip: &Pose) -> Option<Self> {
        let [l1, l2, l3, l4, l5, l6, l7] = lines else { return None };
        if !lines.windows(2).all(|pair| pair[0].perpendicular(&pair[1])) {
            return None;
        }
        let shoulder = same(l1.meets(l2)?, l2.meets(l3)?)?;
        let elbow = same(l3.meets(l4)?, l4.meets(l5)?)?;
        let wrist = same(l5.meets(l6)?, l6.meets(l7)?)?;
        let parameters =
            SrsParameters { upper: (elbow - shoulder).norm(), lower: (wrist - elbow).norm() };
        if parameters.upper < TOLERANCE || parameters.lower < TOLERANCE {
            return None;
        }
        let base = axes_pose(&shoulder, &l2.direction, &l1.direction);
        let sign3 = sign(&l3.direction, &(elbow - shoulder));
        let sign5 = sign(&l5.direction, &(wrist - elbow));
        // Each axis seen in the axes that the joints before it have turned to.
        let mut turned = base.rotation;
        let mut theta = [0.0; 7];
        let mut signs = [1.0; 7];
        (signs[2], signs[4]) = (sign3, sign5);
        for (index, line) in lines.iter().enumerate().skip(2) {
            let axis = turned.inverse() * line.direction * signs[index];
            if index % 2 == 0 {
                theta[index - 1] = axis.x.atan2(axis.z);
                turned *= turn_y(theta[index - 1]).rotation;
            } else {
                theta[index - 1] = (-axis.x).atan2(axis.y);
                turned *= turn_z(theta[index - 1]).rotation;
            }
        }
        let tool = (base * parameters.forward(&theta)).inverse() * tip;
        let mut maps = [JointMap { sign: 1.0, zero_rad: 0.0 }; 7];
        for (map, (sign, zero_rad)) in maps.iter_mut().zip(signs.into_iter().zip(theta)) {
            *map = JointMap { sign, zero_rad };
        }
        Some(Self { parameters, maps, base_from_canonical: base, wrist_from_tip: tool })
    }

    /// Every posture, limits aside, that puts the tip on `target` with the elbow at `elbow_rad`.
    pub(super) fn candidates(
        &self,
        target: &Pose,
        elbow_rad: f64,
        seed: Option<&[f64]>,
        each: &mut dyn FnMut(Posture, Branch),
    ) {
        let SrsParameters { upper, lower } = self.parameters;
        let wrist = self.base_from_canonical.inv_mul(target) * self.wrist_from_tip.inverse();
        let rotation = wrist.rotation.to_rotation_matrix().into_inner();
        let reach = wrist.translation.vector.norm();
        if !(reach <= upper + lower + SLACK_M && reach >= (upper - lower).abs() - SLACK_M) {
            return;
        }
        let (line, zero, side) = elbow_axes(&wrist.translation.vector);
        let out = zero * elbow_rad.cos() + side * elbow_rad.sin();
        let bend = bend(reach, upper, lower);
        // Angle between upper arm and the line to the wrist, always within [0, π].
        let lean = (lower * bend.sin()).atan2(upper + lower * bend.cos());
        let along = line * lean.cos() + out * lean.sin();
        let free = |index| seed_theta(&self.maps, seed, index);
        for (bent, theta4) in [bend, -bend].into_iter().enumerate() {
            let normal = if bent == 0 { out.cross(&line) } else { line.cross(&out) };
            let arm = Matrix3::from_columns(&[normal.cross(&along), normal, along]);
            let fore = arm * turn_y(theta4).rotation.to_rotation_matrix().matrix();
            let hand = fore.tr_mul(&rotation);
            for (back, [theta1, theta2, theta3]) in zyz(&arm, free(0)).into_iter().enumerate() {
                for (flip, [theta5, theta6, theta7]) in zyz(&hand, free(4)).into_iter().enumerate()
                {
                    let theta = [theta1, theta2, theta3, theta4, theta5, theta6, theta7];
                    let branch = Branch { shoulder: back == 1, elbow: bent == 1, wrist: flip == 1 };
                    each(to_q(&self.maps, &theta), branch);
                }
            }
        }
    }

    fn thetas(&self, q: &[f64]) -> [f64; 7] {
        std::array::from_fn(|index| self.maps[index].theta(q[index]))
    }

    /// Elbow angle of a posture, rad in [−π, π]: right-handed about the line shoulder → wrist, 0 where
    /// the elbow lies in the half-plane of that line and the first joint's positive axis.
    ///
    /// Where that axis runs along the line, the half-plane of the line and the canonical x axis
    /// (second axis × first axis, all joints at zero) stands in. The plane of the stretched arm is that of
    /// its elbow joint.
    pub fn elbow_angle(&self, q: &[f64]) -> f64 {
        let theta = self.thetas(q);
        let arm = (turn_z(theta[0]) * turn_y(theta[1]) * turn_z(theta[2])).rotation;
        let hand = arm * turn_y(theta[3]).rotation;
        let wrist =
            arm * Vector::z() * self.parameters.upper + hand * Vector::z() * self.parameters.lower;
        let (line, zero, side) = elbow_axes(&wrist);
        let normal = arm * Vector::y();
        let out = if theta[3].sin() >= 0.0 { line.cross(&normal) } else { normal.cross(&line) };
        out.dot(&side).atan2(out.dot(&zero))
    }

    /// Branch of a posture.
    pub fn branch(&self, q: &[f64]) -> Branch {
        let theta = self.thetas(q);
        Branch {
            shoulder: theta[1].sin() < 0.0,
            elbow: theta[3].sin() < 0.0,
            wrist: theta[5].sin() < 0.0,
        }
    }

    /// Angles of wrist, elbow and shoulder joint (6, 4, 2) from where their neighbours line up,
    /// rad, and the distance of the wrist from axis 1, m.
    pub(super) fn distances(&self, q: &[f64]) -> (f64, f64, f64, f64) {
        let theta = self.thetas(q);
        let wrist = self.parameters.forward(&theta).translation.vector;
        (from_line(theta[5]), from_line(theta[3]), from_line(theta[1]), wrist.x.hypot(wrist.y))
    }
}

/// Line to the wrist, direction of elbow angle zero, and direction of a quarter turn.
fn elbow_axes(wrist: &Vector) -> (Vector, Vector, Vector) {
    let reach = wrist.norm();
    let line = if reach > SLACK_M { wrist / reach } else { Vector::z() };
    let across = |hint: Vector| hint - line * line.dot(&hint);
    let mut zero = across(Vector::z());
    if zero.norm() < SLACK_M {
        zero = across(Vector::x());
    }
    let zero = zero.normalize();
    (line, zero, line.cross(&zero))
}

fn same(one: Vector, other: Vector) -> Option<Vector> {
    ((one - other).norm() < TOLERANCE).then_some(0.5 * (one + other))
}
