//! The only place where the f32 types of parry3d meet ours.
//!
//! Shapes are expressed about the axes of their body, so that a coordinate of 1 m is rounded by
//! at most 6e-8 m; [`ROUNDING_M`] bounds what a distance loses by it.

use parry3d::math::{Pose as ParryPose, Rotation, Vector as ParryVector};

use crate::pose::{Point, Pose, Vector};

/// Bound on what a distance of parry3d loses by its f32 numbers in a cell of a few metres, m.
pub const ROUNDING_M: f64 = 2e-6;

/// A point for parry3d.
pub fn point(point: &Point) -> ParryVector {
    ParryVector::new(point.x as f32, point.y as f32, point.z as f32)
}

/// A vector for parry3d.
pub fn vector(vector: &Vector) -> ParryVector {
    ParryVector::new(vector.x as f32, vector.y as f32, vector.z as f32)
}

/// A pose for parry3d.
pub fn pose(pose: &Pose) -> ParryPose {
    let q = pose.rotation.coords;
    let rotation = Rotation::from_xyzw(q.x as f32, q.y as f32, q.z as f32, q.w as f32).normalize();
    ParryPose::from_parts(vector(&pose.translation.vector), rotation)
}

/// A point from parry3d.
pub fn from_point(point: ParryVector) -> Point {
    Point::new(f64::from(point.x), f64::from(point.y), f64::from(point.z))
}
