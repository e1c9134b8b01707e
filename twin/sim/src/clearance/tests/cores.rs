//! Two convex cores.

use proptest::prelude::*;

use super::brute::{self, Triangle};
use super::{any_pose, least_along, place, to_cone};
use crate::clearance::core::Core;
use crate::clearance::depth::SHARE;
use crate::clearance::gjk::{Gap, TOLERANCE_M};
use crate::clearance::solid::{apart, deep, from_line};
use crate::pose::{Point, Pose, Vector};

const ROUNDING_M: f64 = 1e-12;

fn gap(a: &Core, b: &Core, pose: &Pose) -> Gap {
    apart(a, b, pose, Vector::new(0.3, 0.2, 0.1), f64::INFINITY)
}

/// Lines, triangles, boxes and tetrahedra with their faces; sizes from a nanometre to 0.3 m.
fn polytope() -> impl Strategy<Value = (Core, Vec<Triangle>)> {
    (prop::array::uniform4(place(0.1)), any_pose(0.1), -7.5..0.5f64, 0usize..5).prop_map(
        |([a, b, c, d], pose, size, kind)| {
            let scaled = |point: Point| pose * Point::from(point.coords * 10f64.powf(size));
            let [a, b, c, d] = [a, b, c, d].map(scaled);
            match kind {
                0 => (Core::Line([a, b]), vec![[a, b, b]]),
                1 => (Core::Line([a, a]), vec![[a, a, a]]),
                2 => (Core::Triangle([a, b, c]), vec![[a, b, c]]),
                3 => {
                    let faces = vec![[a, b, c], [a, b, d], [a, c, d], [b, c, d]];
                    (Core::Hull(vec![a, b, c, d]), faces)
                }
                _ => boxed(a, b - a, &pose),
            }
        },
    )
}

fn boxed(middle: Point, half: Vector, pose: &Pose) -> (Core, Vec<Triangle>) {
    let edges = [0, 1, 2].map(|k| pose * Vector::ith(k, half[k]));
    let corner = |signs: usize| {
        let sign = |bit: usize| if signs & (1 << bit) == 0 { 1.0 } else { -1.0 };
        middle + edges[0] * sign(0) + edges[1] * sign(1) + edges[2] * sign(2)
    };
    let sides =
        [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let faces = sides.iter().flat_map(|&[a, b, c, d]| {
        [[corner(a), corner(b), corner(c)], [corner(a), corner(c), corner(d)]]
    });
    (Core::Box { middle, half: edges }, faces.collect())
}

fn cone() -> impl Strategy<Value = Core> {
    (any_pose(0.1), 1e-4..0.1f64, 0.0..0.03f64, 0.0..0.03f64).prop_map(
        |(pose, length_m, wide_m, narrow_m)| Core::Cone {
            ends: [pose * Point::origin(), pose * Point::new(0.0, 0.0, length_m)],
            radii_m: [wide_m, narrow_m],
            axis: pose * Vector::z(),
        },
    )
}

/// A polygon in or about the circles of a cone.
fn prism(cone: &Core, n: usize, around: bool) -> Core {
    let Core::Cone { ends, radii_m, axis } = cone else { unreachable!() };
    let factor = if around { 1.0 / (std::f64::consts::PI / n as f64).cos() } else { 1.0 };
    let axes = crate::pose::from_z_axis(ends[0], *axis, Vector::x());
    let length_m = (ends[1] - ends[0]).norm();
    let corner = |k: usize, end: usize| {
        let (sin, cos) = (std::f64::consts::TAU * k as f64 / n as f64).sin_cos();
        let r_m = radii_m[end] * factor;
        axes * Point::new(r_m * cos, r_m * sin, length_m * end as f64)
    };
    Core::Hull((0..n).flat_map(|k| [corner(k, 0), corner(k, 1)]).collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    /// Never further than the closed forms of every corner, edge and face, and not nearer than the
    /// tolerance; overlapping only what overlaps.
    #[test]
    fn polytopes_are_as_far_apart_as_their_faces((a, a_faces) in polytope(), (b, b_faces) in polytope()) {
        let gap = gap(&a, &b, &Pose::identity());
        let brute_m = brute::distance(&a_faces, &b_faces);
        prop_assert!(gap.least_m <= brute_m + ROUNDING_M, "{gap:?} for {brute_m}");
        if gap.overlaps() {
            // One within the other, or surfaces that cross.
            let inside = |core: &Core, faces: &[Triangle]| {
                super::brute::holds(core, &faces[0][0])
            };
            prop_assert!(brute_m < 1e-11 || inside(&a, &b_faces) || inside(&b, &a_faces), "{gap:?} for {brute_m}");
        } else {
            prop_assert!(gap.least_m >= brute_m - TOLERANCE_M - ROUNDING_M, "{gap:?} for {brute_m}");
            prop_assert!(gap.most_m >= gap.least_m - ROUNDING_M);
        }
    }

    /// A bead beside a cone, against thirds of the bead with the closed form of the cone.
    #[test]
    fn a_line_is_as_far_from_a_cone_as_a_search_along_it_finds(cone in cone(), ends in prop::array::uniform2(place(0.15))) {
        let Core::Cone { ends: of_cone, radii_m, .. } = &cone else { unreachable!() };
        let at = |share: f64| to_cone(&(ends[0] + (ends[1] - ends[0]) * share), of_cone, *radii_m);
        let searched_m = least_along(at);
        let gap = from_line(&cone, &ends, of_cone[0] - ends[0], f64::INFINITY);
        prop_assert!(gap.least_m <= searched_m + ROUNDING_M, "{gap:?} for {searched_m}");
        prop_assert!(gap.least_m.max(0.0) >= searched_m - 2.0 * TOLERANCE_M, "{gap:?} for {searched_m}");
    }

    /// Two cones lie between the polygons in them and those about them, and the bounds close.
    #[test]
    fn two_cones_lie_between_their_polygons(a in cone(), b in cone(), pose in any_pose(0.1)) {
        let found = gap(&a, &b, &pose);
        prop_assert!(found.overlaps() || found.most_m - found.least_m <= TOLERANCE_M, "{found:?}");
        let inner_m = gap(&prism(&a, 32, false), &prism(&b, 32, false), &pose).least_m;
        let outer_m = gap(&prism(&a, 32, true), &prism(&b, 32, true), &pose).least_m;
        prop_assert!(found.least_m.max(0.0) <= inner_m.max(0.0) + 2.0 * TOLERANCE_M, "{found:?} {inner_m}");
        prop_assert!(found.least_m.max(0.0) >= outer_m.max(0.0) - 2.0 * TOLERANCE_M, "{found:?} {outer_m}");
    }

    /// Either way round and wherever both stand, the answer is the same.
    #[test]
    fn swapped_and_moved_alike_they_are_as_far_apart(
        (a, _) in polytope(), b in cone(), pose in any_pose(0.2), all in any_pose(2.0),
    ) {
        let found = gap(&a, &b, &pose);
        let swapped = gap(&b, &a, &pose.inverse());
        let moved = gap(&a.placed(&all), &b, &(all * pose));
        for other in [swapped, moved] {
            let off_m = (other.least_m.max(0.0) - found.least_m.max(0.0)).abs();
            prop_assert!(off_m <= 2.0 * TOLERANCE_M, "{found:?} {other:?}");
        }
    }

    /// An early end is past the asked distance and still no lie.
    #[test]
    fn an_early_end_is_a_lower_bound((a, _) in polytope(), b in cone(), beyond_m in 0.0..0.3f64) {
        let whole = gap(&a, &b, &Pose::identity());
        let early = apart(&a, &b, &Pose::identity(), Vector::x(), beyond_m);
        prop_assert!(early.least_m <= whole.most_m + ROUNDING_M);
        prop_assert!(early.least_m > beyond_m || early.least_m.max(0.0) >= whole.least_m - TOLERANCE_M - ROUNDING_M);
    }

    /// Flat hulls, corners twice, nothing but one point, huge and tiny: an answer, and a number.
    #[test]
    fn no_input_hangs_it_or_makes_it_no_number(
        points in prop::collection::vec(place(1.0), 1..6), others in prop::collection::vec(place(1.0), 1..6),
        flat in 0usize..4, sizes in prop::array::uniform2(-12.0..3.0f64), same in any::<bool>(),
    ) {
        let made = |points: &[Point], size: f64| {
            let squashed = points.iter().map(|p| {
                let mut p = p * 10f64.powf(size);
                (0..flat).for_each(|axis| p[axis] = 0.0);
                p
            });
            Core::Hull(squashed.clone().chain(squashed).collect())
        };
        let a = made(&points, sizes[0]);
        let b = if same { a.clone() } else { made(&others, sizes[1]) };
        for start in [Vector::zeros(), Vector::x(), Vector::new(f64::NAN, 0.0, 0.0)] {
            let gap = apart(&a, &b, &Pose::identity(), start, f64::INFINITY);
            prop_assert!(!gap.least_m.is_nan() && gap.least_m < f64::INFINITY);
            prop_assert!(!same || gap.least_m <= 0.0);
        }
    }
}

/// Half edges that are not too thin.
fn halves() -> impl Strategy<Value = Vector> {
    prop::array::uniform3(1e-3..0.1f64).prop_map(Vector::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    /// Boxes part along a face of one or across an edge of each: fifteen ways, the least counts.
    #[test]
    fn boxes_are_as_deep_as_their_fifteen_axes_say(a in halves(), b in halves(), pose in any_pose(0.1)) {
        let (one, _) = boxed(Point::origin(), a, &Pose::identity());
        let (two, _) = boxed(Point::origin(), b, &Pose::identity());
        let found = gap(&one, &two, &pose);
        if !found.overlaps() {
            return Ok(());
        }
        let unit = [0, 1, 2].map(|k| Vector::ith(k, 1.0));
        let turned = unit.map(|axis| pose * axis);
        let across = unit.iter().flat_map(|u| turned.iter().filter_map(|t| u.cross(t).try_normalize(1e-6)));
        let ways: Vec<Vector> = unit.into_iter().chain(turned).chain(across).collect();
        let reach = |n: &Vector| {
            let half = |axes: &[Vector; 3], h: &Vector| -> f64 { (0..3).map(|k| axes[k].dot(n).abs() * h[k]).sum() };
            half(&unit, &a) + half(&turned, &b) - pose.translation.vector.dot(n).abs()
        };
        let exact_m = ways.iter().map(reach).fold(f64::INFINITY, f64::min);
        let found_m = deep(&one, &two, &pose, &found);
        prop_assert!(found_m >= exact_m - ROUNDING_M, "{found_m} for {exact_m}");
        prop_assert!(found_m <= exact_m * (1.0 + 2.0 * SHARE) + 2.0 * TOLERANCE_M, "{found_m} for {exact_m}");
    }

    /// Of cones and polytopes no direction of thousands parts them by less.
    #[test]
    fn no_direction_parts_them_by_less(
        half in halves(), radii_m in prop::array::uniform2(0.0..0.05f64), pose in any_pose(0.03),
    ) {
        let (a, _) = boxed(Point::origin(), half, &Pose::identity());
        let ends = [Point::origin(), Point::new(0.0, 0.0, 0.04)];
        let b = Core::Cone { ends, radii_m, axis: Vector::z() };
        let found = gap(&a, &b, &pose);
        if !found.overlaps() {
            return Ok(());
        }
        let found_m = deep(&a, &b, &pose, &found);
        prop_assert!(found_m >= 0.0);
        let b = b.placed(&pose);
        for k in 0..2000 {
            let z = 1.0 - (2.0 * f64::from(k) + 1.0) / 2000.0;
            let (sin, cos) = (f64::from(k) * 2.399_963_229_728_653).sin_cos();
            let n = Vector::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z);
            let reach_m = n.dot(&(a.support(&n) - b.support(&-n)));
            prop_assert!(found_m <= reach_m * (1.0 + 2.0 * SHARE) + 2.0 * TOLERANCE_M, "{found_m} for {reach_m}");
        }
    }
}

/// Numbers that are none end the search at once; a distance of nothing is never "far".
#[test]
fn coordinates_that_are_no_numbers_end_it() {
    let bad = Core::Line([Point::new(f64::NAN, 0.0, 0.0), Point::new(f64::INFINITY, 0.0, 0.0)]);
    let good = Core::Line([Point::origin(), Point::new(1.0, 0.0, 0.0)]);
    assert!(gap(&good, &bad, &Pose::identity()).least_m <= 0.0);
    assert!(gap(&bad, &bad, &Pose::identity()).least_m <= 0.0);
}
