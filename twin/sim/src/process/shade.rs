//! What stands between a lamp and a place: closed-form tests of a straight line against simple solids.

use crate::pose::{Point, Pose, Vector};

/// Something opaque, in the axes of what carries it.
///
/// All lengths m, axes need not be of unit length. Non-finite or empty shapes block nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shade {
    /// A flat disc.
    Disc {
        /// Middle.
        centre: Point,
        /// Across it.
        normal: Vector,
        /// Radius, m.
        radius_m: f64,
    },
    /// A flat ring.
    Ring {
        /// Middle.
        centre: Point,
        /// Across it.
        axis: Vector,
        /// Radius of the hole, m.
        inner_m: f64,
        /// Outer radius, m.
        outer_m: f64,
    },
    /// A solid cut cone with flat ends: a nozzle, a cylinder.
    Cone {
        /// Middle of one end.
        from: Point,
        /// Middle of the other.
        to: Point,
        /// Radius at `from`, m.
        radius_from_m: f64,
        /// Radius at `to`, m.
        radius_to_m: f64,
    },
    /// A solid ball.
    Sphere {
        /// Middle.
        centre: Point,
        /// Radius, m.
        radius_m: f64,
    },
    /// A solid rod with round ends: a strand.
    Capsule {
        /// Middle of one end.
        from: Point,
        /// Middle of the other.
        to: Point,
        /// Radius, m.
        radius_m: f64,
    },
}

impl Shade {
    /// Whether the straight line from `a` to `b` passes through it.
    ///
    /// Closed form, no roots taken. A line that only touches a solid passes; one that starts or ends inside
    /// a solid is blocked. A line that lies in the plane of a disc or ring passes. Never blocked where an
    /// input is not a number.
    pub fn blocks(&self, a: Point, b: Point) -> bool {
        match *self {
            Self::Disc { centre, normal, radius_m } => crossing_m2(centre, normal, a, b)
                .is_some_and(|square| radius_m > 0.0 && square < radius_m * radius_m),
            Self::Ring { centre, axis, inner_m, outer_m } => crossing_m2(centre, axis, a, b)
                .is_some_and(|square| {
                    outer_m > 0.0
                        && square < outer_m * outer_m
                        && !(inner_m > 0.0 && square < inner_m * inner_m)
                }),
            Self::Cone { from, to, radius_from_m, radius_to_m } => {
                cone_blocks([from, to], [radius_from_m, radius_to_m], a, b)
            }
            Self::Sphere { centre, radius_m } => {
                radius_m > 0.0 && to_line_m2(centre, a, b) < radius_m * radius_m
            }
            Self::Capsule { from, to, radius_m } => {
                radius_m > 0.0 && between_lines_m2(from, to, a, b) < radius_m * radius_m
            }
        }
    }

    /// A ball around it: middle and radius, m.
    pub fn ball(&self) -> (Point, f64) {
        match *self {
            Self::Disc { centre, radius_m, .. } | Self::Sphere { centre, radius_m } => {
                (centre, radius_m)
            }
            Self::Ring { centre, outer_m, .. } => (centre, outer_m),
            Self::Cone { from, to, radius_from_m, radius_to_m } => {
                let half_m = 0.5 * (to - from).norm();
                (nalgebra::center(&from, &to), half_m.hypot(radius_from_m.max(radius_to_m)))
            }
            Self::Capsule { from, to, radius_m } => {
                (nalgebra::center(&from, &to), 0.5 * (to - from).norm() + radius_m)
            }
        }
    }

    /// The same thing seen from other axes.
    pub fn moved(&self, pose: &Pose) -> Self {
        match *self {
            Self::Disc { centre, normal, radius_m } => {
                Self::Disc { centre: pose * centre, normal: pose * normal, radius_m }
            }
            Self::Ring { centre, axis, inner_m, outer_m } => {
                Self::Ring { centre: pose * centre, axis: pose * axis, inner_m, outer_m }
            }
            Self::Cone { from, to, radius_from_m, radius_to_m } => {
                Self::Cone { from: pose * from, to: pose * to, radius_from_m, radius_to_m }
            }
            Self::Sphere { centre, radius_m } => Self::Sphere { centre: pose * centre, radius_m },
            Self::Capsule { from, to, radius_m } => {
                Self::Capsule { from: pose * from, to: pose * to, radius_m }
            }
        }
    }
}

/// Whether any of them is in the way.
pub fn is_blocked(shades: &[Shade], a: Point, b: Point) -> bool {
    shades.iter().any(|shade| shade.blocks(a, b))
}

/// Square of the distance from a centre at which a line passes through a plane, m²; none if it does not.
fn crossing_m2(centre: Point, normal: Vector, a: Point, b: Point) -> Option<f64> {
    let (height_a, height_b) = ((a - centre).dot(&normal), (b - centre).dot(&normal));
    if !(height_a * height_b < 0.0) {
        return None;
    }
    let at = a + (b - a) * (height_a / (height_a - height_b));
    Some((at - centre).norm_squared())
}

/// Square of the distance of a point from the line between two others, m².
pub(super) fn to_line_m2(point: Point, a: Point, b: Point) -> f64 {
    let along = b - a;
    let length2 = along.norm_squared();
    let share = if length2 > 0.0 { (point - a).dot(&along) / length2 } else { 0.0 };
    (a + along * share.clamp(0.0, 1.0) - point).norm_squared()
}

/// Square of the least distance between the lines `p`–`q` and `a`–`b`, m².
///
/// The inner minimum where both shares are inside, else one of the four ends against the other line: the
/// distance is convex, so the least of these is it.
fn between_lines_m2(p: Point, q: Point, a: Point, b: Point) -> f64 {
    let ends = [to_line_m2(p, a, b), to_line_m2(q, a, b), to_line_m2(a, p, q), to_line_m2(b, p, q)];
    let mut least = ends.into_iter().fold(f64::INFINITY, f64::min);
    let (u, v, w) = (q - p, b - a, p - a);
    let (uu, uv, vv, uw, vw) = (u.dot(&u), u.dot(&v), v.dot(&v), u.dot(&w), v.dot(&w));
    let determinant = uu * vv - uv * uv;
    if determinant > 1e-12 * uu * vv {
        let (s, t) = ((uv * vw - vv * uw) / determinant, (uu * vw - uv * uw) / determinant);
        if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
            least = least.min((w + u * s - v * t).norm_squared());
        }
    }
    least
}

/// A line against a solid cut cone.
///
/// Between the end planes the square of the distance from the axis less the square of the radius is a
/// quadratic in the share along the line; blocked where its least value there is negative.
fn cone_blocks(ends: [Point; 2], radii_m: [f64; 2], a: Point, b: Point) -> bool {
    let axis = ends[1] - ends[0];
    let length_m = axis.norm();
    let line = b - a;
    if !(length_m > 0.0) {
        let radius_m = radii_m[0].max(radii_m[1]);
        return radius_m > 0.0 && to_line_m2(ends[0], a, b) < radius_m * radius_m;
    }
    let axis = axis / length_m;
    let offset = a - ends[0];
    let (z, dz) = (offset.dot(&axis), line.dot(&axis));
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    if dz.abs() > 1e-12 * line.norm() {
        let (first, second) = (-z / dz, (length_m - z) / dz);
        low = low.max(first.min(second));
        high = high.min(first.max(second));
    } else if !(0.0 < z && z < length_m) {
        return false;
    }
    if !(low < high) {
        return false;
    }
    let slope = (radii_m[1] - radii_m[0]) / length_m;
    let (radius, growth) = (radii_m[0] + slope * z, slope * dz);
    let square = line.norm_squared() - dz * dz - growth * growth;
    let half = offset.dot(&line) - z * dz - radius * growth;
    let constant = offset.norm_squared() - z * z - radius * radius;
    let inside = |t: f64| (square * t + 2.0 * half) * t + constant;
    let middle = if square > 0.0 { (-half / square).clamp(low, high) } else { low };
    // A hair below zero: what only touches passes.
    let hair = -1e-12 * (radii_m[0] * radii_m[0] + radii_m[1] * radii_m[1]);
    inside(low) < hair || inside(high) < hair || inside(middle) < hair
}
