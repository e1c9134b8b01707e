//! Rigid poses.
//!
//! `world_from_tool * tool_from_tip = world_from_tip`: names cancel, products that do not cancel
//! are wrong.

use nalgebra::{
    Isometry3, Matrix3, Point3, Quaternion, Rotation3, Translation3, UnitQuaternion, Vector3,
};

/// A rigid pose: unit quaternion and vector, never an affine matrix.
pub type Pose = Isometry3<f64>;
/// A point, m.
pub type Point = Point3<f64>;
/// A vector.
pub type Vector = Vector3<f64>;

/// Whether every coordinate of a point is a number.
pub fn is_finite_point(point: &Point) -> bool {
    point.coords.iter().all(|x| x.is_finite())
}

/// Whether every number of a pose is one.
pub fn is_finite(pose: &Pose) -> bool {
    pose.translation.vector.iter().chain(pose.rotation.coords.iter()).all(|x| x.is_finite())
}

/// Pose from an offset and fixed-axes x, y, z angles as in URDF, `R = Rz(yaw) Ry(pitch) Rx(roll)`.
pub fn from_xyz_rpy(xyz_m: [f64; 3], rpy_rad: [f64; 3]) -> Pose {
    Pose::from_parts(
        Translation3::from(Vector::from(xyz_m)),
        UnitQuaternion::from_euler_angles(rpy_rad[0], rpy_rad[1], rpy_rad[2]),
    )
}

/// Pose whose z axis is `z` and whose x axis is as near to `x_hint` as that allows.
///
/// A hint along `z` is replaced by another that is not.
pub fn from_z_axis(origin: Point, z: Vector, x_hint: Vector) -> Pose {
    let z = z.normalize();
    let across = |hint: Vector| hint - z * z.dot(&hint);
    let mut x = across(x_hint);
    if x.norm() < 1e-6 * x_hint.norm().max(1.0) {
        x = across(if z.x.abs() < 0.9 { Vector::x() } else { Vector::y() });
    }
    let x = x.normalize();
    let rotation = Matrix3::from_columns(&[x, z.cross(&x), z]);
    Pose::from_parts(
        Translation3::from(origin.coords),
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation)),
    )
}

/// Pose from a quaternion given as w, x, y, z; it is normalised.
pub fn from_quaternion_wxyz(xyz_m: [f64; 3], wxyz: [f64; 4]) -> Pose {
    let [w, x, y, z] = wxyz;
    Pose::from_parts(
        Translation3::from(Vector::from(xyz_m)),
        UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)),
    )
}
