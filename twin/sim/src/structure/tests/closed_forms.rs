//! Bars and small frames whose answer is known in closed form or in print.

use super::*;
use crate::structure::{Section, solve};

const DOWN: [f64; 3] = [0.0, 0.0, -9.80665];

fn across(direction: Vector) -> Vector {
    let hint = if direction.z.abs() > 0.9 { Vector::x() } else { Vector::z() };
    direction.cross(&hint).normalize()
}

/// A member standing upright is like any other; so is any other.
#[test]
fn a1_cantilever_in_every_direction() {
    let length_m = 0.06;
    let rod = rod([0, 1]);
    let ei = rod.elastic.e_pa * rod.section.iy_m4;
    for direction in [
        Vector::x(),
        Vector::y(),
        Vector::z(),
        -Vector::z(),
        Vector::new(1e-9, 0.0, 1.0),
        Vector::new(1.0, -2.0, 0.5),
        Vector::new(0.0, -1e-12, -1.0),
    ] {
        let side = across(direction.normalize());
        for count in [1, 5] {
            let frame = chain(direction, length_m, count);
            let push = side * 0.02;
            let load = pushed(count, [push.x, push.y, push.z, 0.0, 0.0, 0.0]);
            let solution = solve(&frame, &clamped([0]), &load).unwrap();
            let tip = Vector::from_column_slice(&solution.displacement[count][..3]);
            near(tip.dot(&side), 0.02 * length_m.powi(3) / (3.0 * ei), 1e-10);
            near(tip.norm(), tip.dot(&side), 1e-10);

            // weight across the member: q L^4 / 8 E I
            let gravity = side * 9.80665;
            let load = falling([gravity.x, gravity.y, gravity.z]);
            let solution = solve(&frame, &clamped([0]), &load).unwrap();
            let tip = Vector::from_column_slice(&solution.displacement[count][..3]);
            let q = rod.density_kg_m3 * rod.section.area_m2 * 9.80665;
            near(tip.dot(&side), q * length_m.powi(4) / (8.0 * ei), 1e-10);
            let at_root = Vector::from_column_slice(&solution.reactions[0][3..]);
            near(at_root.norm(), q * length_m.powi(2) / 2.0, 1e-10);
        }
    }
}

#[test]
fn shear_adds_its_share() {
    let (length_m, push_n) = (0.004, 0.5);
    let mut rod = rod([0, 1]);
    let kappa = Section::cowper_circle(0.36);
    rod.section = rod.section.sheared(kappa);
    let nodes = vec![Point::origin(), Point::new(0.0, 0.0, length_m)];
    let frame = Frame::new(nodes, vec![rod]).unwrap();
    let load = pushed(1, [push_n, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let tip = solve(&frame, &clamped([0]), &load).unwrap().displacement[1][0];
    let bent = push_n * length_m.powi(3) / (3.0 * rod.elastic.e_pa * rod.section.iy_m4);
    let sheared = push_n * length_m / (kappa * rod.elastic.g_pa * rod.section.area_m2);
    near(tip, bent + sheared, 1e-10);
    // its own weight: q L^4/8EI + q L^2/(2 k G A)
    let q = rod.density_kg_m3 * rod.section.area_m2 * 9.80665;
    let load = falling([9.80665, 0.0, 0.0]);
    let tip = solve(&frame, &clamped([0]), &load).unwrap().displacement[1][0];
    let bent = q * length_m.powi(4) / (8.0 * rod.elastic.e_pa * rod.section.iy_m4);
    let sheared = q * length_m.powi(2) / (2.0 * kappa * rod.elastic.g_pa * rod.section.area_m2);
    near(tip, bent + sheared, 1e-10);
}

#[test]
fn torsion_and_stretch() {
    let frame = chain(Vector::new(0.0, 1.0, 0.0), 0.05, 3);
    let rod = frame.members()[0];
    let load = pushed(3, [0.0, 7.0, 0.0, 0.0, 0.01, 0.0]);
    let tip = solve(&frame, &clamped([0]), &load).unwrap().displacement[3];
    near(tip[1], 7.0 * 0.05 / (rod.elastic.e_pa * rod.section.area_m2), 1e-11);
    near(tip[4], 0.01 * 0.05 / (rod.elastic.g_pa * rod.section.j_m4), 1e-11);
}

#[test]
fn a2_fixed_at_both_ends_and_propped() {
    let length_m = 0.08;
    let frame = chain(Vector::new(1.0, 1.0, 0.0), length_m, 2);
    let rod = frame.members()[0];
    let ei = rod.elastic.e_pa * rod.section.iy_m4;
    let q = rod.density_kg_m3 * rod.section.area_m2 * 9.80665;
    let both = solve(&frame, &clamped([0, 2]), &falling(DOWN)).unwrap();
    near(both.displacement[1][2], -q * length_m.powi(4) / (384.0 * ei), 1e-10);
    let moment = |six: &[f64; 6]| six[3].hypot(six[4]);
    near(moment(&both.reactions[0]), q * length_m.powi(2) / 12.0, 1e-10);
    let push = pushed(1, [0.0, 0.0, -0.3, 0.0, 0.0, 0.0]);
    let both = solve(&frame, &clamped([0, 2]), &push).unwrap();
    near(both.displacement[1][2], -0.3 * length_m.powi(3) / (192.0 * ei), 1e-10);
    near(moment(&both.reactions[1]), 0.3 * length_m / 8.0, 1e-10);

    let prop = Support { node: 2, fixed: [false, false, true, false, false, false] };
    let held = solve(&frame, &[Support::clamped(0), prop], &falling(DOWN)).unwrap();
    near(held.reactions[1][2], 3.0 * q * length_m / 8.0, 1e-10);
    near(held.reactions[0][2], 5.0 * q * length_m / 8.0, 1e-10);
    near(moment(&held.reactions[0]), q * length_m.powi(2) / 8.0, 1e-10);
}

/// A load part of the way along a member, by splitting it: fixed ends, `P a b²/L²`.
#[test]
fn load_along_a_member() {
    let (whole, length_m) = (chain(Vector::z(), 0.1, 1), 0.1f64);
    let (frame, node) = whole.split(0, 0.3).unwrap();
    assert_eq!(frame.members().len(), 2);
    let load = pushed(node, [0.4, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let solution = solve(&frame, &clamped([0, 1]), &load).unwrap();
    let (a, b) = (0.3 * length_m, 0.7 * length_m);
    near(solution.reactions[0][4].abs(), 0.4 * a * b * b / length_m.powi(2), 1e-10);
    near(solution.reactions[1][4].abs(), 0.4 * a * a * b / length_m.powi(2), 1e-10);
    assert!(whole.split(0, 1.0).is_err() && whole.split(1, 0.5).is_err());
}

#[test]
fn a8_initial_strain() {
    let shrunk = |mut frame: Frame| {
        let members =
            frame.members().iter().map(|m| Member { initial_strain: -4e-3, ..*m }).collect();
        frame = Frame::new(frame.nodes().to_vec(), members).unwrap();
        frame
    };
    let load = Load { with_initial_strain: true, ..Load::default() };
    // clamped at both ends: N = -E A eps, here tension
    let frame = shrunk(chain(Vector::new(0.3, 0.0, 1.0), 0.05, 2));
    let rod = frame.members()[0];
    let stuck = solve(&frame, &clamped([0, 2]), &load).unwrap();
    let pull = Vector::from_column_slice(&stuck.end_forces[1][6..9]);
    near(pull.norm(), rod.elastic.e_pa * rod.section.area_m2 * 4e-3, 1e-11);
    assert!(pull.z > 0.0);
    // free at one end: it shortens and nothing pulls
    let free = solve(&frame, &clamped([0]), &load).unwrap();
    let tip = Vector::from_column_slice(&free.displacement[2][..3]);
    near(tip.norm(), 4e-3 * 0.05, 1e-11);
    assert!(free.end_forces.iter().flatten().all(|force| force.abs() < 1e-9));
}

/// A gradient across the section bends a free member by `κ = α ΔT/h`. Members carry no curvature of
/// their own: it comes as the end moments `E I κ` that would bend them so, taken off their forces.
#[test]
fn a8_gradient_as_end_moments() {
    let (length_m, curvature) = (0.06, 5e-5 * 40.0 / 2e-3);
    let frame = chain(Vector::x(), length_m, 1);
    let rod = frame.members()[0];
    let moment = rod.elastic.e_pa * rod.section.iy_m4 * curvature;
    let turn = |node, about_y| NodeLoad { node, load: [0.0, 0.0, 0.0, 0.0, about_y, 0.0] };
    let load = Load { at_nodes: vec![turn(0, moment), turn(1, -moment)], ..Load::default() };
    let solution = solve(&frame, &clamped([0]), &load).unwrap();
    near(solution.displacement[1][2], curvature * length_m.powi(2) / 2.0, 1e-10);
    // nothing left in a member free to bend, and nothing asked of its support
    assert!((solution.end_forces[0][10] + moment).abs() < 1e-10 * moment);
    assert!(solution.reactions[0].iter().all(|value| value.abs() < 1e-10 * moment / length_m));
}

/// Kassimali, Matrix Analysis of Structures, example 8.4 (kip, inch); all printed digits.
#[test]
fn a3_kassimali_8_4() {
    let section = Section {
        area_m2: 32.9,
        iy_m4: 236.0,
        iz_m4: 716.0,
        j_m4: 15.1,
        shear_kappa: f64::INFINITY,
        fibre_m: 1.0,
    };
    let elastic = Elastic { e_pa: 29000.0, g_pa: 11500.0 };
    let (sin, cos) = (0.5, 3f64.sqrt() / 2.0);
    let with = |from: usize, side: Vector, density: f64| Member {
        side,
        density_kg_m3: density,
        ..member([from, 0], section, elastic)
    };
    let nodes = vec![
        Point::origin(),
        Point::new(-240.0, 0.0, 0.0),
        Point::new(0.0, -240.0, 0.0),
        Point::new(0.0, 0.0, -240.0),
    ];
    let members = vec![
        with(1, Vector::y(), 0.25 / 32.9),
        with(2, Vector::z(), 0.0),
        with(3, Vector::new(-sin, cos, 0.0), 0.0),
    ];
    let frame = Frame::new(nodes, members).unwrap();
    let load =
        Load { gravity_m_s2: [0.0, -1.0, 0.0], ..pushed(0, [0.0, 0.0, 0.0, -1800.0, 0.0, 1800.0]) };
    let got = solve(&frame, &clamped([1, 2, 3]), &load).unwrap().displacement[0];
    let wanted = [-1.352245, -2.796532, -1.811980, -3.002109, 1.056911, 6.498580];
    for (got, wanted) in got.iter().zip(wanted) {
        assert!((got * 1e3 - wanted).abs() < 1e-6, "{got} {wanted}");
    }
}

/// McGuire, Gallagher, Ziemian, Matrix Structural Analysis, example 5.8 (kN, m).
#[test]
fn a4_mcguire_5_8() {
    let section = |area_m2, j_m4, i_m4| Section {
        area_m2,
        iy_m4: i_m4,
        iz_m4: i_m4,
        j_m4,
        shear_kappa: f64::INFINITY,
        fibre_m: 1.0,
    };
    let elastic = Elastic { e_pa: 200e6, g_pa: 200e6 / 2.6 };
    let nodes = vec![Point::origin(), Point::new(5.0, 0.0, 0.0), Point::new(5.0, 8.0, 0.0)];
    let ab = Member {
        density_kg_m3: 3.0 / 0.004,
        ..member([0, 1], section(0.004, 1e-7, 5e-5), elastic)
    };
    let bc = member([1, 2], section(0.006, 3e-7, 2e-4), elastic);
    let frame = Frame::new(nodes, vec![ab, bc]).unwrap();
    let load =
        Load { gravity_m_s2: [0.0, 0.0, -1.0], ..pushed(1, [0.0, 0.0, -5.0, 0.0, 0.0, 0.0]) };
    let solution = solve(&frame, &clamped([0, 2]), &load).unwrap();
    let b = solution.displacement[1];
    assert!((b[2] + 0.02238452).abs() < 0.5e-8);
    assert!((b[3] - 4.19677e-3).abs() < 0.5e-8);
    assert!((b[4] - 5.93197e-3).abs() < 0.5e-8);
    // as printed
    near(solution.reactions[0][2], 14.74, 1e-3);
    near(solution.reactions[1][2], 5.25, 1e-3);
}

#[test]
fn impossible_constants_are_named() {
    let pair = Elastic { e_pa: 3.5e9, g_pa: 2.4e9 };
    near(pair.impossible_pair().unwrap(), -0.270_833_333_333, 1e-9);
    assert_eq!(Elastic::isotropic(2.4e9, 0.35).impossible_pair(), None);
    assert!(Elastic { e_pa: 2.4e9, g_pa: 0.7e9 }.impossible_pair().is_some());
}
