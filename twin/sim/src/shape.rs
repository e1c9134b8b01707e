//! Convex shapes of arms, tools and obstacles, and their counterparts in parry3d.

#[cfg(test)]
mod tests;

use parry3d::math::Vector as Vector32;
use parry3d::shape::SharedShape;

use crate::parry;
use crate::pose::{self, Point, Pose, Vector};

/// A shape in the axes of the body it belongs to, m.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// All points within a radius of a line.
    Capsule {
        /// One end.
        a: Point,
        /// The other.
        b: Point,
        /// Radius, m.
        radius_m: f64,
    },
    /// Truncated cone; equal radii make a cylinder.
    Cone {
        /// Centre of one face.
        from: Point,
        /// Centre of the other.
        to: Point,
        /// Radius at `from`, m.
        radius_from_m: f64,
        /// Radius at `to`, m.
        radius_to_m: f64,
    },
    /// A box about its own axes.
    Box {
        /// Axes of the box.
        pose: Pose,
        /// Half edge lengths, m.
        half_m: Vector,
    },
    /// Convex hull of points.
    Hull {
        /// The points.
        points: Vec<Point>,
    },
    /// Triangles; not convex.
    Mesh {
        /// Vertices.
        vertices: Vec<Point>,
        /// Vertex indices.
        triangles: Vec<[u32; 3]>,
    },
}

/// Corners of the polygon that stands for a circle; it is drawn around the circle, not in it.
const CORNERS: usize = 16;

impl Shape {
    /// A ball, as a capsule without length.
    pub fn sphere(centre: Point, radius_m: f64) -> Self {
        Self::Capsule { a: centre, b: centre, radius_m }
    }

    /// A round bar with flat ends, as a cone of equal radii.
    pub fn cylinder(from: Point, to: Point, radius_m: f64) -> Self {
        Self::Cone { from, to, radius_from_m: radius_m, radius_to_m: radius_m }
    }

    /// The shape for parry3d, never smaller than ours.
    ///
    /// A hull or mesh without volume falls back to the capsule of its diagonal, which is larger.
    pub fn to_parry(&self) -> SharedShape {
        match self {
            Self::Capsule { a, b, radius_m } => {
                SharedShape::capsule(parry::point(a), parry::point(b), parry::length(*radius_m))
            }
            Self::Cone { .. } | Self::Box { .. } | Self::Hull { .. } => {
                let points: Vec<_> = self.corners().iter().map(parry::point).collect();
                hull_of(&points).unwrap_or_else(|| self.diagonal_capsule())
            }
            Self::Mesh { vertices, triangles } => {
                let points = vertices.iter().map(parry::point).collect();
                SharedShape::trimesh(points, triangles.clone())
                    .unwrap_or_else(|_| self.diagonal_capsule())
            }
        }
    }

    /// Points whose convex hull encloses the shape (for a capsule: without its radius).
    pub fn corners(&self) -> Vec<Point> {
        match self {
            Self::Capsule { a, b, .. } => vec![*a, *b],
            Self::Cone { from, to, radius_from_m, radius_to_m } => {
                let axes = pose::from_z_axis(*from, to - from, Vector::x());
                let length_m = (to - from).norm();
                let around = 1.0 / (std::f64::consts::PI / CORNERS as f64).cos();
                let ring = |radius_m: f64, z_m: f64| {
                    (0..CORNERS).map(move |k| {
                        let angle = std::f64::consts::TAU * k as f64 / CORNERS as f64;
                        let r = radius_m * around;
                        axes * Point::new(r * angle.cos(), r * angle.sin(), z_m)
                    })
                };
                ring(*radius_from_m, 0.0).chain(ring(*radius_to_m, length_m)).collect()
            }
            Self::Box { pose, half_m } => (0..8)
                .map(|k| {
                    let sign = |bit: usize, half: f64| if k & bit == 0 { half } else { -half };
                    pose * Point::new(sign(1, half_m.x), sign(2, half_m.y), sign(4, half_m.z))
                })
                .collect(),
            Self::Hull { points } | Self::Mesh { vertices: points, .. } => points.clone(),
        }
    }

    /// Radius added around the corners.
    pub fn skin_m(&self) -> f64 {
        if let Self::Capsule { radius_m, .. } = self { *radius_m } else { 0.0 }
    }

    fn diagonal_capsule(&self) -> SharedShape {
        let corners = self.corners();
        let first = corners.first().copied().unwrap_or_else(Point::origin);
        let (low, high) =
            corners.iter().fold((first, first), |(low, high), p| (low.inf(p), high.sup(p)));
        let centre = nalgebra::center(&low, &high);
        let radius = parry::length(((high - low).norm() / 2.0).max(1e-6));
        SharedShape::capsule(parry::point(&centre), parry::point(&centre), radius)
    }
}

/// The hull of points, with a skin where parry drops a corner that is nearly on a face (by up to some tenths of a
/// millimetre): as thick as the corner lies outside what is left.
fn hull_of(points: &[Vector32]) -> Option<SharedShape> {
    let hull = SharedShape::convex_hull(points)?;
    let kept = hull.as_convex_polyhedron()?.points();
    let lost = points.iter().filter(|point| !kept.contains(point));
    let lost = lost.map(|point| hull.distance_to_local_point(*point, true)).fold(0.0, f32::max);
    if lost < parry::length(parry::ROUNDING_M / 4.0) {
        return Some(hull);
    }
    // the search may stop short of the distance by its slack
    SharedShape::round_convex_hull(points, lost * (1.0 + parry::SLACK as f32))
}
