//! The only place where the f32 types of parry3d meet ours.
//!
//! parry3d is handed millimetres: its tolerances are absolute numbers made for shapes of about one
//! unit, and in metres its distances of nozzles and beads are wrong by millimetres (a short bead
//! 3.7 mm off a cone was measured 7.8 mm off). Shapes are expressed about the axes of their body,
//! so that a coordinate of 1 m is rounded by at most 6e-8 m; [`ROUNDING_M`] bounds what a distance
//! loses by it.

use parry3d::math::{Pose as ParryPose, Rotation, Vector as ParryVector};

use crate::pose::{Point, Pose, Vector};

/// Bound on what a distance of parry3d loses by its f32 numbers in a cell of a few metres, m.
pub const ROUNDING_M: f64 = 2e-6;

/// Units of parry3d per metre.
const PER_M: f64 = 1e3;

/// A length for parry3d.
pub fn length(length_m: f64) -> f32 {
    (length_m * PER_M) as f32
}

/// A length from parry3d, m.
pub fn from_length(length: f32) -> f64 {
    f64::from(length) / PER_M
}

/// The search of parry3d stops when it is within this share of a distance, √(10 ε) of f32.
pub const SLACK: f64 = 1.1e-3;

/// The least that a distance from parry3d may stand for, m, but for [`ROUNDING_M`].
pub fn at_least(distance: f32) -> f64 {
    from_length(distance) * (1.0 - SLACK)
}

/// A point for parry3d.
pub fn point(point: &Point) -> ParryVector {
    vector(&point.coords)
}

/// A vector of lengths for parry3d.
pub fn vector(vector: &Vector) -> ParryVector {
    ParryVector::new(length(vector.x), length(vector.y), length(vector.z))
}

/// A pose for parry3d.
pub fn pose(pose: &Pose) -> ParryPose {
    let q = pose.rotation.coords;
    let rotation = Rotation::from_xyzw(q.x as f32, q.y as f32, q.z as f32, q.w as f32).normalize();
    ParryPose::from_parts(vector(&pose.translation.vector), rotation)
}

/// A point from parry3d.
pub fn from_point(point: ParryVector) -> Point {
    Point::new(from_length(point.x), from_length(point.y), from_length(point.z))
}

/// A pose from parry3d.
pub fn from_pose(pose: &ParryPose) -> Pose {
    let turn = nalgebra::Quaternion::new(
        f64::from(pose.rotation.w),
        f64::from(pose.rotation.x),
        f64::from(pose.rotation.y),
        f64::from(pose.rotation.z),
    );
    let at = from_point(pose.translation);
    Pose::from_parts(at.coords.into(), nalgebra::UnitQuaternion::new_normalize(turn))
}
