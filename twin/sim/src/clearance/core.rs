//! Convex cores: what is left of a shape without the radius around it.

use crate::pose::{Point, Pose, Vector};
use crate::shape::Shape;

/// A convex set in the axes of its body, given by the point that is furthest along a direction.
#[derive(Debug, Clone)]
pub(super) enum Core {
    /// A straight line; both ends alike for a point.
    Line([Point; 2]),
    Triangle([Point; 3]),
    /// Middle and half edges.
    Box {
        middle: Point,
        half: [Vector; 3],
    },
    /// Truncated cone, exactly: the hull of two discs across one axis of unit length.
    Cone {
        ends: [Point; 2],
        radii_m: [f64; 2],
        axis: Vector,
    },
    /// Hull of points; never empty.
    Hull(Vec<Point>),
}

impl Core {
    /// Cores of a shape and the radius around them; `None` for a mesh, which is not convex.
    pub(super) fn of(shape: &Shape) -> Option<(Self, f64)> {
        Some(match shape {
            Shape::Capsule { a, b, radius_m } => (Self::Line([*a, *b]), *radius_m),
            Shape::Cone { from, to, radius_from_m, radius_to_m } => {
                // A cone without length is two discs across any axis; the larger counts.
                let axis = (to - from).try_normalize(f64::MIN_POSITIVE).unwrap_or_else(Vector::z);
                (
                    Self::Cone {
                        ends: [*from, *to],
                        radii_m: [*radius_from_m, *radius_to_m],
                        axis,
                    },
                    0.0,
                )
            }
            Shape::Box { pose, half_m } => {
                let half = [0, 1, 2].map(|k| pose * (Vector::ith(k, half_m[k])));
                (Self::Box { middle: pose * Point::origin(), half }, 0.0)
            }
            // As `to_parry` has it: hulls and meshes of nothing are a speck at the origin.
            Shape::Hull { points } | Shape::Mesh { vertices: points, .. } if points.is_empty() => {
                (Self::Line([Point::origin(); 2]), 0.0)
            }
            Shape::Mesh { vertices, triangles } if triangles.is_empty() => {
                (Self::Hull(vertices.clone()), 0.0)
            }
            Shape::Hull { points } => (Self::Hull(points.clone()), 0.0),
            Shape::Mesh { .. } => return None,
        })
    }

    /// The same in the axes that `pose` leads to.
    pub(super) fn placed(&self, pose: &Pose) -> Self {
        match self {
            Self::Line(ends) => Self::Line(ends.map(|end| pose * end)),
            Self::Triangle(corners) => Self::Triangle(corners.map(|corner| pose * corner)),
            Self::Box { middle, half } => {
                Self::Box { middle: pose * middle, half: half.map(|edge| pose * edge) }
            }
            Self::Cone { ends, radii_m, axis } => Self::Cone {
                ends: ends.map(|end| pose * end),
                radii_m: *radii_m,
                axis: pose * axis,
            },
            Self::Hull(points) => Self::Hull(points.iter().map(|point| pose * point).collect()),
        }
    }

    /// Distance of a place from the furthest point of the core, m, or a little more.
    pub(super) fn furthest_from(&self, place: &Point) -> f64 {
        let to = |points: &[Point]| points.iter().map(|p| (p - place).norm()).fold(0.0, f64::max);
        match self {
            Self::Line(ends) => to(ends),
            Self::Triangle(corners) => to(corners),
            Self::Hull(points) => to(points),
            Self::Box { middle, half } => {
                (place - middle).norm() + half.iter().sum::<Vector>().norm()
            }
            Self::Cone { ends, radii_m, axis } => {
                let disc = |k: usize| {
                    let from = place - ends[k];
                    let up_m = from.dot(axis);
                    up_m.hypot((from - axis * up_m).norm() + radii_m[k])
                };
                disc(0).max(disc(1))
            }
        }
    }

    /// The point that is furthest along a direction of any length but zero.
    pub(super) fn support(&self, direction: &Vector) -> Vector {
        match self {
            Self::Line(ends) => furthest(ends, direction),
            Self::Triangle(corners) => furthest(corners, direction),
            Self::Box { middle, half } => {
                let reach = |edge: &Vector| *edge * 1f64.copysign(edge.dot(direction));
                middle.coords + reach(&half[0]) + reach(&half[1]) + reach(&half[2])
            }
            Self::Cone { ends: [from, to], radii_m, axis } => {
                let up = axis.dot(direction);
                let out = direction - axis * up;
                // Along the axis that leaves rounding only, in any direction: once more across it.
                let out = out - axis * axis.dot(&out);
                let out_length = out.norm();
                let unit = if out_length > 0.0 { out / out_length } else { Vector::zeros() };
                let [at_from, at_to] = [0, 1].map(|k| radii_m[k] * out_length);
                if (to - from).dot(direction) + at_to > at_from {
                    to.coords + unit * radii_m[1]
                } else {
                    from.coords + unit * radii_m[0]
                }
            }
            Self::Hull(points) => furthest(points, direction),
        }
    }

    /// A line in it and the radius about that line that holds all of it.
    pub(super) fn rod(&self) -> ([Point; 2], f64) {
        match self {
            Self::Line(ends) => (*ends, 0.0),
            Self::Cone { ends: [from, to], radii_m: [at_from, at_to], .. } => {
                // A rod as long as the cone, or for a short one a ball.
                let (length_m, wide_m) = ((to - from).norm(), at_from.max(*at_to));
                let middle = nalgebra::center(from, to);
                if length_m <= wide_m {
                    return ([middle; 2], (length_m / 2.0).hypot(wide_m));
                }
                ([*from, *to], wide_m)
            }
            Self::Box { middle, half } => {
                let lengths = half.map(|edge| edge.norm());
                let long = (0..3).max_by(|&a, &b| lengths[a].total_cmp(&lengths[b])).unwrap_or(0);
                let wide_m = lengths[(long + 1) % 3].hypot(lengths[(long + 2) % 3]);
                ([middle - half[long], middle + half[long]], wide_m)
            }
            Self::Triangle(corners) => rod_of(corners),
            Self::Hull(points) => rod_of(points),
        }
    }

    /// Lowest and highest corner along the axes of `pose`'s target.
    pub(super) fn bounds(&self, pose: &Pose) -> (Point, Point) {
        let reach = |axis: usize, sign: f64| {
            let direction = pose.inverse_transform_vector(&(Vector::ith(axis, sign)));
            (pose * Point::from(self.support(&direction)))[axis]
        };
        let corner = |sign: f64| Point::new(reach(0, sign), reach(1, sign), reach(2, sign));
        (corner(-1.0), corner(1.0))
    }
}

fn furthest(points: &[Point], direction: &Vector) -> Vector {
    let mut best = points[0];
    let mut best_m = best.coords.dot(direction);
    for point in &points[1..] {
        let reach_m = point.coords.dot(direction);
        if reach_m > best_m {
            (best, best_m) = (*point, reach_m);
        }
    }
    best.coords
}

/// Along the longest edge of the box about the points.
fn rod_of(points: &[Point]) -> ([Point; 2], f64) {
    let first = points[0];
    let (low, high) =
        points.iter().fold((first, first), |(low, high), p| (low.inf(p), high.sup(p)));
    let (middle, size) = (nalgebra::center(&low, &high), high - low);
    let long = size.imax();
    let half = Vector::ith(long, size[long] / 2.0);
    let ends = [middle - half, middle + half];
    let radius_m = points.iter().map(|p| to_line(p, &ends)).fold(0.0, f64::max);
    (ends, radius_m)
}

/// Distance of a point from a straight line between two ends, m.
pub(super) fn to_line(point: &Point, ends: &[Point; 2]) -> f64 {
    let along = ends[1] - ends[0];
    let share = ((point - ends[0]).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE))
        .clamp(0.0, 1.0);
    (point - (ends[0] + along * share)).norm()
}
