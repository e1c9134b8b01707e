//! Against brute force, closed forms, parry3d, and turned and moved copies.

mod bodies;
mod brute;
mod cores;
mod covered;

use proptest::prelude::*;

use crate::pose::{Point, Pose, Vector, from_xyz_rpy};

/// Any place within a cube of this half edge, m.
fn place(half_m: f64) -> impl Strategy<Value = Point> {
    prop::array::uniform3(-half_m..half_m).prop_map(Point::from)
}

/// Any pose within a cube.
fn any_pose(half_m: f64) -> impl Strategy<Value = Pose> {
    (prop::array::uniform3(-half_m..half_m), prop::array::uniform3(-3.2..3.2f64))
        .prop_map(|(xyz, rpy)| from_xyz_rpy(xyz, rpy))
}

/// The least of a convex function of a share, by thirds.
fn least_along(f: impl Fn(f64) -> f64) -> f64 {
    let (mut from, mut to) = (0.0, 1.0);
    for _ in 0..120 {
        let (a, b) = ((2.0 * from + to) / 3.0, (from + 2.0 * to) / 3.0);
        if f(a) < f(b) {
            to = b;
        } else {
            from = a;
        }
    }
    f(from).min(f(to)).min(f(0.0)).min(f(1.0))
}

/// Distance of a place from a truncated cone, m; zero inside.
fn to_cone(place: &Point, ends: &[Point; 2], radii_m: [f64; 2]) -> f64 {
    let axis = (ends[1] - ends[0]).normalize();
    let length_m = (ends[1] - ends[0]).norm();
    let up_m = (place - ends[0]).dot(&axis);
    let out_m = (place - ends[0] - axis * up_m).norm();
    let (slope, sides) = ((radii_m[1] - radii_m[0]) / length_m, [0.0, length_m]);
    if up_m >= 0.0 && up_m <= length_m && out_m <= radii_m[0] + slope * up_m {
        return 0.0;
    }
    let corner = |k: usize| Vector::new(radii_m[k], sides[k], 0.0);
    let at = Vector::new(out_m, up_m, 0.0);
    let outline =
        [[Vector::zeros(), corner(0)], [corner(0), corner(1)], [corner(1), Vector::y() * length_m]];
    let to_edge = |[a, b]: [Vector; 2]| {
        super::core::to_line(&Point::from(at), &[Point::from(a), Point::from(b)])
    };
    outline.map(to_edge).into_iter().fold(f64::INFINITY, f64::min)
}
