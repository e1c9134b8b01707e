use super::{TubeLook, tube};
use crate::mesh::Mesh;
use proptest::prelude::*;
use sim::pose::Point;
use std::collections::BTreeMap;
use std::f64::consts::PI;

const FLAT: TubeLook = TubeLook { sides: 8, end_rings: 0 };
const ROUND: TubeLook = TubeLook { sides: 8, end_rings: 2 };

fn points(mm: &[[f64; 3]]) -> Vec<Point> {
    mm.iter().map(|p| Point::from(p.map(|x| x * 1e-3))).collect()
}

fn length_m(points: &[Point]) -> f64 {
    points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// Sum of the signed tetrahedra over the first vertex.
fn volume_m3(mesh: &Mesh) -> f64 {
    let Some(origin) = mesh.points.first() else { return 0.0 };
    let each = mesh.triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|vertex| mesh.points[vertex as usize] - origin);
        a.dot(&b.cross(&c)) / 6.0
    });
    each.sum()
}

/// Closed and oriented: every edge is passed once each way.
fn is_closed(mesh: &Mesh) -> bool {
    let mut passes: BTreeMap<(u32, u32), [usize; 2]> = BTreeMap::new();
    for &[a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let way = usize::from(from > to);
            passes.entry((from.min(to), from.max(to))).or_default()[way] += 1;
        }
    }
    passes.values().all(|ways| *ways == [1, 1])
}

fn is_sound(mesh: &Mesh) -> bool {
    let finite = mesh.points.iter().all(|p| p.coords.iter().all(|x| x.is_finite()));
    let unit = mesh.normals.iter().all(|n| (n.norm() - 1.0).abs() < 1e-9);
    let known = mesh.triangles.iter().flatten().all(|&v| (v as usize) < mesh.points.len());
    finite && unit && known && mesh.normals.len() == mesh.points.len()
}

#[test]
fn a_mitred_tube_holds_what_the_round_bead_holds() {
    let bent = points(&[[0.0; 3], [40.0, 0.0, 0.0], [40.0, 30.0, 0.0], [60.0, 30.0, 50.0]]);
    let mesh = tube(&bent, 0.0015, FLAT, |_| false);
    let wanted = PI * 0.0015_f64.powi(2) * length_m(&bent);
    assert!((volume_m3(&mesh) / wanted - 1.0).abs() < 1e-9, "{}", volume_m3(&mesh) / wanted);
    // the polygon reaches past the circle by as much as it cuts off
    let octagon = (PI / 4.0) / (PI / 4.0).sin();
    let off = |p: &Point| (p.y.powi(2) + p.z.powi(2)).sqrt();
    let first_ring = mesh.points[..8].iter().map(off).fold(0.0, f64::max);
    assert!((first_ring / 0.0015 - octagon.sqrt()).abs() < 1e-9);
}

#[test]
fn round_ends_add_most_of_a_ball() {
    let line = points(&[[0.0; 3], [0.0, 0.0, 30.0]]);
    let more = volume_m3(&tube(&line, 0.002, ROUND, |_| false))
        - volume_m3(&tube(&line, 0.002, FLAT, |_| false));
    let share = more / (4.0 / 3.0 * PI * 0.002_f64.powi(3));
    assert!((0.85..1.0).contains(&share), "{share}");
}

#[test]
fn normals_point_out() {
    let bent = points(&[[0.0; 3], [10.0, 0.0, 0.0], [10.0, 10.0, 0.0]]);
    let mesh = tube(&bent, 0.001, ROUND, |_| false);
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|v| mesh.points[v as usize]);
        let facing = (b - a).cross(&(c - a));
        assert!(triangle.iter().all(|&v| mesh.normals[v as usize].dot(&facing) > 0.0));
    }
}

#[test]
fn a_straight_stretch_is_one_piece_but_where_a_point_is_wanted() {
    let line: Vec<Point> = (0..17).map(|k| Point::new(0.01 * f64::from(k), 0.0, 0.0)).collect();
    assert_eq!(tube(&line, 0.001, FLAT, |_| false).points.len(), 2 * 8 + 2);
    let with_one = tube(&line, 0.001, FLAT, |k| k == 5);
    assert_eq!(with_one.points.len(), 3 * 8 + 2);
    assert!(with_one.of.contains(&5) && with_one.of.contains(&16));
}

#[test]
fn what_turns_back_is_two_tubes() {
    let back = points(&[[0.0; 3], [20.0, 0.0, 0.0], [1.0, 0.5, 0.0]]);
    let mesh = tube(&back, 0.001, FLAT, |_| false);
    assert_eq!(mesh.points.len(), 2 * (2 * 8 + 2));
    assert!(is_closed(&mesh) && is_sound(&mesh));
}

#[test]
fn nothing_comes_of_nothing() {
    for odd in [vec![], points(&[[1.0; 3]]), points(&[[1.0; 3], [1.0; 3], [1.0; 3]])] {
        assert_eq!(tube(&odd, 0.001, ROUND, |_| true), Mesh::default());
    }
    let line = points(&[[0.0; 3], [1.0; 3]]);
    for radius_m in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(tube(&line, radius_m, ROUND, |_| true), Mesh::default());
    }
}

/// Places of a coarse grid, so that double points, straight stretches and reversals come often; and what is no place.
fn any_points() -> impl Strategy<Value = Vec<Point>> {
    let x = prop_oneof![
        20 => (-3..4_i32).prop_map(|k| f64::from(k) * 0.01),
        4 => -0.05..0.05_f64,
        1 => Just(f64::NAN),
        1 => Just(f64::INFINITY),
        1 => Just(1e300),
    ];
    prop::collection::vec([x.clone(), x.clone(), x], 0..24)
        .prop_map(|all| all.into_iter().map(Point::from).collect())
}

proptest! {
    #[test]
    fn any_polyline_gives_closed_tubes(points in any_points(), round in 0..4_u32, sides in 3..9_u32) {
        let look = TubeLook { sides, end_rings: round };
        let mesh = tube(&points, 0.001, look, |k| k % 3 == 0);
        prop_assert!(is_closed(&mesh));
        prop_assert!(is_sound(&mesh));
    }

    #[test]
    fn any_flat_tube_holds_area_times_length(points in any_points()) {
        let mesh = tube(&points, 0.001, FLAT, |_| false);
        let finite: Vec<Point> =
            points.into_iter().filter(|p| p.coords.iter().all(|x| x.abs() < 1e6)).collect();
        let wanted = PI * 1e-6 * length_m(&finite);
        prop_assert!((volume_m3(&mesh) - wanted).abs() <= 1e-6 * wanted, "{} {wanted}", volume_m3(&mesh));
    }
}
