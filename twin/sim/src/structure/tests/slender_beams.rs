//! MacNeal and Harder's beams (A proposed standard set of problems, 1985): straight, twisted, curved.
//! Buckling of chains.

use std::f64::consts::{FRAC_PI_2, PI};

use super::buckles::parts;
use super::*;
use crate::structure::{EULER_FLAG, buckling, slender, solve};

/// Solid rectangle of full width along y and full height along z; J by Roark's formula for it
/// (0.3 %), shear 5/6.
fn rectangle(width: f64, height: f64) -> Section {
    let (a, b) = (width.max(height), width.min(height));
    Section {
        area_m2: width * height,
        iy_m4: width * height.powi(3) / 12.0,
        iz_m4: height * width.powi(3) / 12.0,
        j_m4: a * b.powi(3) * (1.0 / 3.0 - 0.21 * b / a * (1.0 - (b / a).powi(4) / 12.0)),
        shear_kappa: 5.0 / 6.0,
        fibre_m: width.hypot(height) / 2.0,
    }
}

/// Where a unit force on the last node takes it, along the force.
fn give(frame: &Frame, direction: Vector) -> f64 {
    let last = frame.nodes().len() - 1;
    let load = pushed(last, [direction.x, direction.y, direction.z, 0.0, 0.0, 0.0]);
    let tip = solve(frame, &clamped([0]), &load).unwrap().displacement[last];
    Vector::new(tip[0], tip[1], tip[2]).dot(&direction)
}

#[test]
fn a7_straight_cantilever() {
    let bar = Member {
        side: Vector::y(),
        ..member([0, 1], rectangle(0.2, 0.1), Elastic::isotropic(1e7, 0.3))
    };
    let nodes = vec![Point::origin(), Point::new(6.0, 0.0, 0.0)];
    let frame = Frame::new(nodes, vec![bar]).unwrap();
    for (direction, printed) in
        [(Vector::x(), 3.0e-5), (Vector::y(), 0.1081), (Vector::z(), 0.4321)]
    {
        let got = give(&frame, direction);
        eprintln!("A7 straight: {got:.6e} ({printed:e})");
        near(got, printed, 5e-4);
    }
}

/// Straight elements that follow the twist: a quarter turn over 12, each with the axes of its
/// middle.
fn twisted(count: usize) -> Frame {
    let at = |k: f64| k / count as f64;
    let nodes = (0..=count).map(|k| Point::new(12.0 * at(k as f64), 0.0, 0.0)).collect();
    let members = (0..count).map(|k| {
        let angle = FRAC_PI_2 * at(k as f64 + 0.5);
        let side = Vector::new(0.0, angle.cos(), angle.sin());
        let elastic = Elastic::isotropic(29e6, 0.22);
        Member { side, ..member([k, k + 1], rectangle(1.1, 0.32), elastic) }
    });
    Frame::new(nodes, members.collect()).unwrap()
}

#[test]
fn a7_twisted_beam() {
    // 1.1 along y at the root, along z at the tip
    for (direction, printed) in [(Vector::z(), 5.424e-3), (Vector::y(), 1.754e-3)] {
        let [coarse, middle, fine] = [12, 24, 96].map(|count| give(&twisted(count), direction));
        eprintln!("A7 twisted: {coarse:.6e} {middle:.6e} {fine:.6e} with 12, 24, 96 ({printed:e})");
        near(coarse, printed, 1e-2);
        near(fine, printed, 1e-2);
        // second order: four times nearer with half the step
        let order = (coarse - fine) / (middle - fine);
        assert!((3.5..5.0).contains(&order), "{order}");
    }
}

/// A quarter ring. Printed 0.08734 in its plane and 0.5022 across; thin-ring theory (Castigliano)
/// gives 0.08858 and 0.5005, and it is that which straight elements must approach.
#[test]
fn a7_curved_beam() {
    let (radius, count) = (4.22f64, 60);
    let nodes = (0..=count)
        .map(|k| {
            let angle = FRAC_PI_2 * k as f64 / count as f64;
            Point::new(radius * angle.cos(), radius * angle.sin(), 0.0)
        })
        .collect();
    let (section, elastic) = (rectangle(0.2, 0.1), Elastic::isotropic(1e7, 0.25));
    let (e_pa, g_pa) = (elastic.e_pa, elastic.g_pa);
    // the width lies in the plane of the ring
    let members = (0..count).map(|k| {
        let angle = FRAC_PI_2 * (k as f64 + 0.5) / count as f64;
        let side = Vector::new(angle.cos(), angle.sin(), 0.0);
        Member { side, ..member([k, k + 1], section, elastic) }
    });
    let frame = Frame::new(nodes, members.collect()).unwrap();
    let cube = radius.powi(3);
    let sheared = radius / (section.shear_kappa * g_pa * section.area_m2);
    let stretched = radius / (e_pa * section.area_m2);
    // the tip's radius is y
    let in_plane = PI / 4.0 * (cube / (e_pa * section.iz_m4) + sheared + stretched);
    let across = PI / 4.0 * cube / (e_pa * section.iy_m4)
        + (0.75 * PI - 2.0) * cube / (g_pa * section.j_m4)
        + FRAC_PI_2 * sheared;
    for (direction, wanted, printed) in
        [(Vector::y(), in_plane, 0.08734), (Vector::z(), across, 0.5022)]
    {
        let got = give(&frame, direction);
        eprintln!("A7 curved: {got:.6} (theory {wanted:.6}, printed {printed})");
        near(got, wanted, 1e-3);
        near(got, printed, 1.5e-2);
    }
}

/// Two hundred members end to end: what rounding leaves of an ill-conditioned frame.
#[test]
fn a_long_chain_buckles_as_one() {
    let frame = chain(Vector::new(0.2, 0.1, 1.0), 2.0, 200);
    let x = Vector::new(0.2, 0.1, 1.0).normalize();
    let load = pushed(200, [-x.x, -x.y, -x.z, 0.0, 0.0, 0.0]);
    let ei = 3.5e9 * Section::circle(2e-3).iy_m4;
    for count in [1, 4] {
        let mode = buckling(&frame, &clamped([0]), &load, parts(count)).unwrap().remove(0);
        near(mode.factor, PI * PI * ei / 16.0, 1e-6);
        assert_eq!((mode.member, mode.station), (199, 1.0));
        assert!(mode.region.len() > 50);
    }
}

/// Four members in a line, free at the top: far gone where the screen still sees nothing.
#[test]
fn the_screen_sees_members_not_frames() {
    let frame = chain(Vector::z(), 1.0, 4);
    let rod = frame.members()[0];
    let push = PI * PI * rod.elastic.e_pa * rod.section.iy_m4 / 4.0;
    let load = pushed(4, [0.0, 0.0, -push, 0.0, 0.0, 0.0]);
    let held = clamped([0]);
    near(buckling(&frame, &held, &load, parts(2)).unwrap()[0].factor, 1.0, 1e-4);
    let solution = solve(&frame, &held, &load).unwrap();
    assert!(slender(&frame, &solution, [0.0; 3], EULER_FLAG).unwrap().is_empty());
    let all = slender(&frame, &solution, [0.0; 3], 0.0).unwrap();
    assert_eq!(all.len(), 4);
    near(all[0].ratio, 1.0 / 64.0, 1e-9);
}
