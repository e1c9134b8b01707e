//! The step from a maker's axes to those in which a closed form is written.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion};

use crate::pose::{Pose, Vector};

/// How a joint value becomes a canonical angle: `theta = sign * q + zero_rad`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointMap {
    /// +1 or −1.
    pub sign: f64,
    /// Canonical angle where the joint stands at zero, rad.
    pub zero_rad: f64,
}

impl JointMap {
    /// Canonical angle of a joint value, rad.
    pub fn theta(&self, q: f64) -> f64 {
        self.sign * q + self.zero_rad
    }

    /// Joint value of a canonical angle, rad.
    pub fn q(&self, theta: f64) -> f64 {
        self.sign * (theta - self.zero_rad)
    }

    /// Offset as ros-industrial and rs-opw-kinematics write it, `theta = sign * q − offset`, in (−π, π].
    pub fn offset_rad(&self) -> f64 {
        let offset = -self.zero_rad;
        let wrapped = offset - TAU * ((offset - PI) / TAU).ceil();
        if wrapped <= -PI + 1e-9 { PI } else { wrapped }
    }
}

/// Canonical angle of one joint of the seed; at joint zero where there is no seed.
pub(super) fn seed_theta(maps: &[JointMap], seed: Option<&[f64]>, index: usize) -> f64 {
    maps[index].theta(seed.and_then(|q| q.get(index).copied()).unwrap_or(0.0))
}

/// Pose at `origin` with axes `y × z`, `y`, `z`; `y` is made perpendicular to `z`.
pub(super) fn axes_pose(origin: &Vector, y: &Vector, z: &Vector) -> Pose {
    let z = z.normalize();
    let y = (y - z * z.dot(y)).normalize();
    let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[y.cross(&z), y, z]));
    Pose::from_parts(Translation3::from(*origin), UnitQuaternion::from_rotation_matrix(&rotation))
}

/// +1 where the two point the same way, else −1.
pub(super) fn sign(a: &Vector, b: &Vector) -> f64 {
    if a.dot(b) < 0.0 { -1.0 } else { 1.0 }
}

/// `Rz(angle)` at the origin.
pub(super) fn turn_z(angle: f64) -> Pose {
    Pose::from_parts(
        Translation3::identity(),
        UnitQuaternion::from_axis_angle(&Vector::z_axis(), angle),
    )
}

/// `Ry(angle)` at the origin.
pub(super) fn turn_y(angle: f64) -> Pose {
    Pose::from_parts(
        Translation3::identity(),
        UnitQuaternion::from_axis_angle(&Vector::y_axis(), angle),
    )
}
