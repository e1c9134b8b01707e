use super::cast::Caster;
use super::solid::HitId;
use super::*;
use crate::pose::from_xyz_rpy;

fn one(shape: Shape) -> Scene {
    let body = Body {
        name: "it".into(),
        kind: BodyKind::Tool,
        pose: Pose::identity(),
        shape,
        highlighted: false,
    };
    Scene { bodies: vec![body], ..Scene::default() }
}

fn strand(points: Vec<Point>, radius_m: f64) -> StrandShape {
    StrandShape { points, radius_m, value: None, highlighted: false }
}

/// A sphere of 0.3 m made in every way there is: side, and both ends where they are round.
#[test]
fn distances_are_closed_form() {
    let o = Point::origin();
    let (below, above) = (Point::new(0.0, 0.0, -0.5), Point::new(0.0, 0.0, 0.5));
    let half_m = Vector::new(0.3, 0.2, 0.5);
    let cases = [
        (Shape::sphere(o, 0.3), [0.7, 0.7, 0.7], 1e-12),
        (Shape::Capsule { a: below, b: above, radius_m: 0.3 }, [0.7, 0.7, 0.2], 1e-12),
        (Shape::Box { half_m, pose: Pose::identity() }, [0.7, 0.8, 0.5], 1e-7),
        // a corner of the polygon lies on each axis
        (Shape::cylinder(below, above, 0.3), [0.7, 0.7, 0.5], 1e-12),
        (
            Shape::Cone { from: below, to: above, radius_from_m: 0.4, radius_to_m: 0.2 },
            [0.7, 0.7, 0.5],
            1e-12,
        ),
    ];
    for (shape, expected, error_m) in cases {
        let caster = Caster::new(&one(shape.clone()));
        for (axis, want) in [Vector::x(), Vector::y(), Vector::z()].into_iter().zip(expected) {
            let hit = caster.cast(o + axis, -axis).expect("meets");
            assert!((hit.distance_m - want).abs() < error_m, "{shape:?} {axis:?}: {hit:?}");
            assert!(hit.normal.dot(&axis) > 0.9);
            assert!(caster.cast(o + axis, axis).is_none());
        }
    }
}

#[test]
fn turning_everything_changes_nothing() {
    let mut scene = one(Shape::Hull {
        points: Bounds { min: Point::new(-0.1, -0.2, -0.3), max: Point::new(0.4, 0.5, 0.6) }
            .corners()
            .to_vec(),
    });
    scene.strands.push(strand(vec![Point::new(1.0, 0.0, 0.0), Point::new(1.0, 0.3, 0.2)], 0.002));
    let turn = from_xyz_rpy([2.0, -1.0, 0.5], [0.3, -0.7, 1.9]);
    let mut turned = scene.clone();
    turned.bodies[0].pose = turn;
    for p in &mut turned.strands[0].points {
        *p = turn * *p;
    }
    let (plain, other) = (Caster::new(&scene), Caster::new(&turned));
    let mut met = 0;
    for i in 0..2000 {
        let s = f64::from(i) * 0.618;
        let from = Point::new(3.0 * s.cos(), 3.0 * s.sin(), (0.7 * s).sin());
        let at = Point::new(0.5 + 0.5 * (3.1 * s).sin(), 0.15 + 0.2 * (1.7 * s).cos(), 0.1);
        let (a, b) = (plain.cast(from, at - from), other.cast(turn * from, turn * (at - from)));
        assert_eq!(a.map(|h| h.what), b.map(|h| h.what), "ray {i}");
        if let (Some(a), Some(b)) = (a, b) {
            met += 1;
            assert!((a.distance_m - b.distance_m).abs() < 1e-6, "ray {i}: {a:?} {b:?}");
        }
    }
    assert!(met > 500, "{met}");
}

/// The tree finds what trying every strand alone finds.
#[test]
fn tree_agrees_with_trying_all() {
    let strands: Vec<StrandShape> = (0..200)
        .map(|i| {
            let s = f64::from(i);
            let p = Point::new((1.3 * s).sin(), (2.1 * s).cos(), (0.7 * s).sin());
            strand(
                vec![p, p + Vector::new((5.0 * s).cos(), (3.0 * s).sin(), (2.0 * s).cos()) * 0.3],
                0.01,
            )
        })
        .collect();
    let scene = Scene { strands: strands.clone(), ..Scene::default() };
    let tree = Caster::new(&scene);
    let alone: Vec<Caster> = strands
        .into_iter()
        .map(|s| Caster::new(&Scene { strands: vec![s], ..Scene::default() }))
        .collect();
    for i in 0..500 {
        let s = f64::from(i);
        let from = Point::new(3.0 * (0.9 * s).cos(), 3.0 * (0.9 * s).sin(), 0.0);
        let to = Vector::new((1.1 * s).sin(), (0.3 * s).cos(), (0.5 * s).sin()) - from.coords;
        let nearest =
            alone.iter().filter_map(|c| c.cast(from, to)).map(|h| h.distance_m).reduce(f64::min);
        let found = tree.cast(from, to).map(|h| h.distance_m);
        assert_eq!(found.is_some(), nearest.is_some());
        if let (Some(a), Some(b)) = (found, nearest) {
            assert!((a - b).abs() < 2e-5, "{a} {b}");
        }
    }
}

#[test]
fn the_nearer_thing_is_met_and_named() {
    let mut scene = one(Shape::sphere(Point::origin(), 0.1));
    scene.bed = Some(BedShape { pose: Pose::translation(0.0, 0.0, -0.2), size_m: [1.0, 0.5] });
    scene.strands.push(strand(vec![Point::new(-1.0, 0.0, 0.3), Point::new(1.0, 0.0, 0.3)], 0.001));
    let caster = Caster::new(&scene);
    let down = |x: f64, y: f64| caster.cast(Point::new(x, y, 5.0), -Vector::z());
    assert_eq!(down(0.0, 0.0).map(|h| h.what), Some(HitId::Strand(0)));
    assert_eq!(down(0.0, 0.05).map(|h| h.what), Some(HitId::Body(0)));
    let bed = down(0.4, 0.2).expect("meets");
    assert_eq!(bed.what, HitId::Bed);
    assert!((bed.distance_m - 5.2).abs() < 1e-7);
    assert_eq!(down(0.4, 0.26), None);
}

#[test]
fn useless_shapes_are_left_out() {
    let nan = Point::new(f64::NAN, 0.0, 0.0);
    let o = Point::origin();
    for shape in [
        Shape::Hull { points: vec![o; 9] },
        Shape::Hull { points: vec![] },
        Shape::Hull { points: vec![nan, o, o, o, o] },
        Shape::Hull { points: (0..6).map(|i| Point::new(f64::from(i), 0.0, 0.0)).collect() },
        Shape::Mesh { vertices: vec![o], triangles: vec![[0, 1, 2], [0, 0, 0]] },
        Shape::Capsule { a: nan, b: o, radius_m: 1.0 },
        Shape::cylinder(o, o, 1.0),
        Shape::sphere(o, f64::INFINITY),
    ] {
        assert_eq!(Caster::new(&one(shape)).cast(Point::new(0.0, 0.0, 9.0), -Vector::z()), None);
    }
    assert_eq!(Caster::new(&Scene::default()).cast(o, Vector::zeros()), None);
}
