use proptest::prelude::*;

use super::*;

fn cone() -> Shape {
    Shape::Cone {
        from: Point::new(0.01, 0.02, 0.1),
        to: Point::new(0.03, -0.01, 0.0),
        radius_from_m: 0.013,
        radius_to_m: 0.0024,
    }
}

/// How far a point is outside a shape at least, m; negative inside. Of a polyhedron: outside the
/// plane of the face that it is furthest from.
fn outside_m(shape: &Shape, point: &Point) -> f64 {
    let (solid, point) = (shape.to_parry(), parry::point(point));
    let Some(hull) = solid.as_convex_polyhedron() else {
        return parry::from_length(solid.distance_to_local_point(point, true));
    };
    let gaps = hull.faces().iter().map(|face| {
        let vertex = hull.vertices_adj_to_face()[face.first_vertex_or_edge as usize];
        face.normal.dot(point - hull.points()[vertex as usize])
    });
    parry::from_length(gaps.fold(f32::NEG_INFINITY, f32::max))
}

/// The polygon is drawn around the circle: nothing of the cone lies outside, and it is at most
/// `1/cos(π/16) − 1`, two per cent, too wide.
#[test]
fn a_cone_lies_inside_its_corners() {
    let shape = cone();
    let Shape::Cone { from, to, radius_from_m, radius_to_m } = &shape else { unreachable!() };
    let axes = pose::from_z_axis(*from, to - from, Vector::x());
    let length_m = (to - from).norm();
    for k in 0..360 {
        let angle = f64::from(k).to_radians();
        let (sin, cos) = angle.sin_cos();
        for share in [0.0, 0.3, 1.0] {
            let at = |r: f64| axes * Point::new(r * cos, r * sin, share * length_m);
            let r = radius_from_m + (radius_to_m - radius_from_m) * share;
            assert!(outside_m(&shape, &at(r)) < 1e-7, "{k}° {share}");
            assert!(outside_m(&shape, &at(1.03 * r)) > 0.0, "{k}° {share}");
        }
    }
    assert_eq!(shape.corners().len(), 32);
    assert_eq!(shape.skin_m(), 0.0);
}

#[test]
fn boxes_and_capsules_keep_their_size() {
    let turned = pose::from_xyz_rpy([0.1, -0.2, 0.3], [0.4, 0.5, 0.6]);
    let block = Shape::Box { pose: turned, half_m: Vector::new(0.1, 0.02, 0.03) };
    let outside = turned * Point::new(0.1 + 0.01, 0.0, 0.0);
    assert!((outside_m(&block, &outside) - 0.01).abs() < 1e-6);
    assert!(outside_m(&block, &(turned * Point::new(0.099, 0.019, -0.029))) < 0.0);
    let rod = Shape::Capsule { a: Point::origin(), b: Point::new(0.1, 0.0, 0.0), radius_m: 0.02 };
    assert!((outside_m(&rod, &Point::new(0.15, 0.0, 0.0)) - 0.03).abs() < 1e-7);
    assert_eq!((rod.skin_m(), rod.corners().len()), (0.02, 2));
    let ball = Shape::sphere(Point::new(0.0, 0.0, 1.0), 0.5);
    assert!((outside_m(&ball, &Point::origin()) - 0.5).abs() < 1e-6);
}

/// A flat hull or a mesh of nothing becomes a ball around it, never nothing and never a panic.
#[test]
fn shapes_without_volume_become_larger_not_smaller() {
    let flat = vec![Point::origin(), Point::new(0.1, 0.0, 0.0), Point::new(0.05, 0.0, 0.0)];
    let shapes = [
        Shape::Hull { points: flat.clone() },
        Shape::Hull { points: vec![Point::new(1.0, 2.0, 3.0)] },
        Shape::Hull { points: Vec::new() },
        Shape::Mesh { vertices: Vec::new(), triangles: Vec::new() },
    ];
    for shape in &shapes {
        for corner in shape.corners() {
            assert!(outside_m(shape, &corner) < 1e-6, "{shape:?}");
        }
    }
    assert_eq!(outside_m(&shapes[0], &Point::new(0.03, 0.0, 0.0)), 0.0);
}

/// A corner half a millimetre off the plane of three others: parry drops it, and what stands for the hull must not be smaller.
#[test]
fn a_corner_just_off_a_face_is_kept() {
    let points = [
        [-0.27263820004464934, -0.1751449453385593, -0.11833423813132682],
        [0.007592692897950153, -0.11150769777328433, -0.14122029186656715],
        [0.027129825824163206, 0.103352009069441, 0.22123839910846],
        [0.05393800474299735, -0.18029570725041597, -0.2837783016915287],
    ];
    let hull = Shape::Hull { points: points.map(Point::from).to_vec() };
    let solid = hull.to_parry();
    // from beyond the corner, straight out of the merged face
    let [a, b, c, d] = points.map(Vector::from);
    let out = (c - a).cross(&(d - a)).normalize();
    let out = if (b - a).dot(&out) > 0.0 { out } else { -out };
    let beyond = Point::from(b + out * 0.01);
    let distance_m = parry::from_length(solid.distance_to_local_point(parry::point(&beyond), true));
    assert!(distance_m < 0.01 + 1e-6 && distance_m > 0.01 - 1e-3, "{distance_m}");
}

/// How far a point sticks out of a solid as parry measures distances: by its support points. Asked along the normal of
/// every three corners, among which are those of all faces, m.
fn sticks_out_m(solid: &SharedShape, corners: &[Point], point: &Point) -> f64 {
    let support = solid.as_support_map().expect("convex");
    let triples =
        (0..corners.len()).flat_map(|k| (0..k).flat_map(move |j| (0..j).map(move |i| [i, j, k])));
    let normals = triples.filter_map(|at| {
        let [a, b, c] = at.map(|i| corners[i]);
        (b - a).cross(&(c - a)).try_normalize(1e-9)
    });
    let off = normals.flat_map(|normal| [normal, -normal]).map(|out| {
        let along = parry::vector(&out).normalize();
        let reach = parry::from_point(support.local_support_point(along));
        (point - reach).dot(&out)
    });
    off.fold(f64::NEG_INFINITY, f64::max)
}

proptest! {
    /// Every corner of a hull is in the solid that parry gets.
    #[test]
    fn hulls_hold_their_corners(points in prop::collection::vec([-0.3..0.3f64, -0.3..0.3, -0.3..0.3], 4..20)) {
        let corners: Vec<Point> = points.into_iter().map(Point::from).collect();
        let solid = Shape::Hull { points: corners.clone() }.to_parry();
        for corner in &corners {
            let off_m = sticks_out_m(&solid, &corners, corner);
            // What f32 takes is what every stated clearance gives up for it.
            prop_assert!(off_m < parry::ROUNDING_M, "{off_m} m outside");
        }
    }
}
