//! Bodies of several solids, meshes, and the deposit.

use proptest::prelude::*;

use super::{any_pose, brute, place};
use crate::clearance::gjk::TOLERANCE_M;
use crate::clearance::mesh::Mesh;
use crate::clearance::{Beads, Body};
use crate::deposit::{Deposit, Printed};
use crate::parry;
use crate::pose::{Point, Pose, Vector};
use crate::shape::Shape;

fn tool() -> Body {
    let at = |z_mm: f64| Point::new(0.0, 0.0, z_mm / 1e3);
    let cone = |from: f64, to: f64, wide_mm: f64, narrow_mm: f64| Shape::Cone {
        from: at(from),
        to: at(to),
        radius_from_m: wide_mm / 1e3,
        radius_to_m: narrow_mm / 1e3,
    };
    let heater = Shape::Box {
        pose: Pose::translation(0.0, 0.0, -0.026),
        half_m: Vector::new(0.01, 0.008, 0.006),
    };
    let hose = Shape::Capsule { a: at(-60.0), b: Point::new(0.05, 0.01, -0.1), radius_m: 0.003 };
    Body::new("tool", &[cone(-20.0, 0.0, 6.0, 1.4), heater, cone(-60.0, -32.0, 12.5, 8.0), hose])
}

/// Strands of three segments each, every one with its own radius.
fn deposit(strands: &[[Point; 4]]) -> Deposit {
    let printed = |(k, points): (usize, &[Point; 4])| Printed {
        strand: k,
        as_planned: points.to_vec(),
        as_printed: points.to_vec(),
        at_m: crate::toolpath::stations(points),
        radius_m: 1e-3 * (1.0 + 0.01 * k as f64),
        born_s: 0.0,
        done_s: 1.0,
    };
    Deposit::new(strands.iter().enumerate().map(printed).collect())
}

fn ball(n: u32, radius_m: f64) -> (Vec<Point>, Vec<[u32; 3]>) {
    let m = 2 * n;
    let at = |i: u32, k: u32| {
        let (polar, turn) = (
            std::f64::consts::PI * f64::from(i) / f64::from(n),
            std::f64::consts::TAU * f64::from(k) / f64::from(m),
        );
        // One corner at the lower pole, as at the upper one.
        let out = if i == n { 0.0 } else { polar.sin() };
        Point::new(out * turn.cos(), out * turn.sin(), polar.cos()) * radius_m
    };
    let vertices = (0..=n).flat_map(|i| (0..m).map(move |k| at(i, k))).collect();
    let quads = (0..n).flat_map(|i| {
        (0..m).flat_map(move |k| {
            let next = (k + 1) % m;
            let [a, b, c, d] = [i * m + k, i * m + next, (i + 1) * m + next, (i + 1) * m + k];
            [[a, c, b], [a, d, c]]
        })
    });
    (vertices, quads.collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// The tree finds what a look at every bead finds, among those printed so far.
    #[test]
    fn the_nearest_bead_is_the_nearest_of_all(
        strands in prop::collection::vec(prop::array::uniform4(place(0.2)), 1..60),
        pose in any_pose(0.25), share in 0.0..1.2f64, beyond_m in 0.0..0.2f64,
    ) {
        let (deposit, body) = (deposit(&strands), tool());
        let beads = Beads::new(&deposit);
        let n_segments = (share * deposit.segments.len() as f64) as usize;
        let mut clearances = Vec::new();
        for segment in deposit.segments.iter().take(n_segments) {
            clearances.push(body.to_bead(&pose, &segment.ends, segment.radius_m, f64::INFINITY));
        }
        let least_m = clearances.iter().copied().fold(f64::INFINITY, f64::min);
        match beads.nearest(&body, &pose, n_segments, beyond_m) {
            None => prop_assert!(least_m >= beyond_m - TOLERANCE_M, "{least_m} missed"),
            Some(found) => {
                prop_assert!((found.clearance_m - least_m).abs() <= 2.0 * TOLERANCE_M);
                prop_assert!((clearances[found.segment] - least_m).abs() <= 2.0 * TOLERANCE_M);
            }
        }
        let mut near = Vec::new();
        beads.within(&body, &pose, n_segments, beyond_m, &mut near);
        for (k, clearance_m) in clearances.iter().enumerate() {
            prop_assert!(*clearance_m > beyond_m || near.contains(&(k as u32)), "{k} missed");
        }
        prop_assert!(near.iter().all(|&k| (k as usize) < n_segments));
    }

    /// A mesh is as far off as its nearest triangle.
    #[test]
    fn a_mesh_is_as_far_off_as_its_nearest_triangle(pose in any_pose(0.15), line in prop::array::uniform2(place(0.02))) {
        let (vertices, triangles) = ball(8, 0.05);
        let faces: Vec<_> = triangles.iter().map(|t| t.map(|k| pose * vertices[k as usize])).collect();
        let mesh = Body::new("ball", &[Shape::Mesh { vertices, triangles }]);
        let bead = brute::distance(&faces, &[[line[0], line[1], line[1]]]);
        let from_m = line.map(|end| (pose.translation.vector - end.coords).norm());
        let found_m = mesh.to_bead(&pose, &line, 0.0, 1.0);
        if from_m.iter().any(|&m| m < 0.045) {
            // Wholly inside too, however far from the surface and the horizon.
            prop_assert!(found_m <= 0.0 && mesh.to_bead(&pose, &line, 0.0, 1e-6) <= 0.0);
        } else if from_m.iter().all(|&m| m > 0.051) {
            prop_assert!(found_m <= bead && found_m >= bead - 2.0 * TOLERANCE_M, "{found_m} for {bead}");
            let rod = Body::new("rod", &[Shape::Capsule { a: line[0], b: line[1], radius_m: 0.001 }]);
            for found_m in [
                mesh.to_body(&pose, &rod, &Pose::identity(), 1.0),
                rod.to_body(&Pose::identity(), &mesh, &pose, 1.0),
            ] {
                prop_assert!(bead < 0.001 || (found_m - bead + 0.001).abs() <= 3.0 * TOLERANCE_M, "{found_m} for {bead}");
            }
        }
    }

    /// A mesh in a mesh, beside it and through it.
    #[test]
    fn two_meshes_are_as_far_apart_as_their_triangles(pose in any_pose(0.1)) {
        let [(large, large_m), (small, small_m)] = [(ball(5, 0.05), 0.05), (ball(3, 0.01), 0.01)];
        let faces = |(vertices, triangles): &(Vec<Point>, Vec<[u32; 3]>), pose: &Pose| -> Vec<_> {
            triangles.iter().map(|t| t.map(|k| pose * vertices[k as usize])).collect()
        };
        let body = |(vertices, triangles): &(Vec<Point>, Vec<[u32; 3]>)| {
            let mesh = Shape::Mesh { vertices: vertices.clone(), triangles: triangles.clone() };
            Body::new("", &[mesh])
        };
        let brute_m = brute::distance(&faces(&large, &Pose::identity()), &faces(&small, &pose));
        let found_m = body(&large).to_body(&Pose::identity(), &body(&small), &pose, 1.0);
        let swapped_m = body(&small).to_body(&pose, &body(&large), &Pose::identity(), 1.0);
        let from_m = pose.translation.vector.norm();
        for found_m in [found_m, swapped_m] {
            if from_m < 0.03 || brute_m < 1e-9 {
                prop_assert!(found_m <= 0.0);
            } else if from_m > large_m + small_m {
                prop_assert!(found_m <= brute_m && found_m >= brute_m - 2.0 * TOLERANCE_M);
            }
        }
    }

    /// parry3d agrees within what it states, but for its rare slips, which are all too long.
    #[test]
    fn parry_is_no_nearer_than_we_are(a in any_pose(0.1), b in any_pose(0.2), half in prop::array::uniform3(1e-3..0.05f64)) {
        let block = |pose| Shape::Box { pose, half_m: Vector::from(half) };
        let points = (0..8).map(|k| Point::new(f64::from(k * k % 5), f64::from(k * 3 % 7), f64::from(k % 3)) * 0.01);
        let shapes = [block(a), Shape::Hull { points: points.collect() }];
        let bodies = shapes.clone().map(|shape| Body::new("", &[shape]));
        let ours_m = bodies[0].to_body(&Pose::identity(), &bodies[1], &b, 1.0);
        let [one, two] = shapes.map(|shape| shape.to_parry());
        let theirs = parry3d::query::distance(&parry::pose(&Pose::identity()), &*one, &parry::pose(&b), &*two);
        let theirs = theirs.expect("both convex").distance;
        let theirs_m = parry::from_length(theirs);
        prop_assert!(ours_m <= theirs_m + 4.0 * parry::ROUNDING_M, "{ours_m} {theirs_m}");
        prop_assert!(ours_m <= 0.0 || ours_m >= parry::at_least(theirs) - 4.0 * parry::ROUNDING_M || theirs_m > ours_m);
    }
}

/// The inside of a closed mesh on a grid of places, many straight under corners and edges.
#[test]
fn inside_a_mesh_is_what_is_inside() {
    let half = 0.04;
    let vertices: Vec<Point> = (0..8)
        .map(|k| Point::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * half)
        .collect();
    let quads =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles: Vec<[u32; 3]> =
        quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let mesh = Mesh::new(&vertices, &triangles);
    let open = Mesh::new(&vertices, &triangles[1..]);
    for k in 0..11_usize.pow(3) {
        let at = |k: usize| 0.01 * (k % 11) as f64 - 0.025;
        let place = Point::new(at(k), at(k / 11), at(k / 121));
        let inside = place.iter().all(|&x| x > 0.0 && x < half);
        assert_eq!(mesh.holds(&place), inside, "{place}");
        assert!(!open.holds(&place));
    }
}
