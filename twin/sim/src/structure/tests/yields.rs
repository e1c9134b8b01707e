//! Stress against strength where both are known by hand.

use std::f64::consts::PI;

use super::*;
use crate::structure::{At, Criterion, Governs, Strength, Weld, first_yield, solve, utilisation};

const EQUAL: Strength = Strength { tension_pa: 40e6, compression_pa: 40e6 };
const NO_GRAVITY: [f64; 3] = [0.0; 3];

#[test]
fn pulled_bent_and_twisted() {
    let frame = chain(Vector::new(0.0, 0.6, 0.8), 0.05, 1);
    let x = Vector::new(0.0, 0.6, 0.8);
    let section = Section::circle(2e-3);
    let used = |load: [f64; 6], strength: Strength| {
        let solution = solve(&frame, &clamped([0]), &pushed(1, load)).unwrap();
        utilisation(&frame, &[strength], &solution, NO_GRAVITY).unwrap().unwrap()
    };
    let pull = x * 5.0;
    let got = used([0.0, pull.y, pull.z, 0.0, 0.0, 0.0], EQUAL);
    near(got.value, 5.0 / section.area_m2 / 40e6, 1e-10);
    let soft = Strength { compression_pa: 20e6, ..EQUAL };
    let got = used([0.0, -pull.y, -pull.z, 0.0, 0.0, 0.0], soft);
    near(got.value, 5.0 / section.area_m2 / 20e6, 1e-10);
    assert_eq!(got.governs, Governs::Compression);
    // bending P L c/I at the root
    let got = used([0.1, 0.0, 0.0, 0.0, 0.0, 0.0], EQUAL);
    near(got.value, 0.1 * 0.05 * 1e-3 / section.iy_m4 / 40e6, 1e-10);
    assert_eq!((got.governs, got.station_m), (Governs::Tension, 0.0));
    // pure torque: sqrt(3) T r / J
    let twist = x * 0.002;
    let got = used([0.0, 0.0, 0.0, 0.0, twist.y, twist.z], EQUAL);
    near(got.value, 3f64.sqrt() * 0.002 * 1e-3 / section.j_m4 / 40e6, 1e-10);
}

/// The peak of a moment inside a member is found: a beam on two hinges, q L^2/8 at the middle.
#[test]
fn peak_inside_a_member() {
    let frame = chain(Vector::x(), 0.1, 1);
    let mut far = Support::pinned(1);
    far.fixed[3] = true;
    let gravity = [0.0, 0.0, -9.80665];
    let solution = solve(&frame, &[Support::pinned(0), far], &falling(gravity)).unwrap();
    let got = utilisation(&frame, &[EQUAL], &solution, gravity).unwrap().unwrap();
    let section = Section::circle(2e-3);
    let q = 1240.0 * section.area_m2 * 9.80665;
    near(got.value, q * 0.01 / 8.0 * 1e-3 / section.iy_m4 / 40e6, 1e-9);
    near(got.station_m, 0.05, 1e-9);
}

/// A cantilever under its weight and a push at its tip: by fibre and by node where theory says, by axial stress never.
#[test]
fn first_yield_by_each_criterion() {
    let frame = chain(Vector::x(), 0.05, 4);
    let held = clamped([0]);
    let gravity = [0.0, 0.0, -9.80665];
    let weight = solve(&frame, &held, &falling(gravity)).unwrap();
    let push = solve(&frame, &held, &pushed(4, [0.0, 0.0, -0.01, 0.0, 0.0, 0.0])).unwrap();
    let strengths = [EQUAL; 4];
    let section = Section::circle(2e-3);
    let own = 1240.0 * section.area_m2 * 9.80665 * 0.05f64.powi(2) / 2.0;
    let both = ((&weight, gravity), (&push, NO_GRAVITY));
    let root = [root_weld(section.area_m2, 20e6)];
    let yields = |strengths: &[Strength], lasting, growing| {
        first_yield(&frame, (strengths, &root), lasting, growing)
    };
    let [axial, fibre, node] = yields(&strengths, both.0, both.1).unwrap();
    assert_eq!((axial.factor, axial.at), (f64::INFINITY, None));
    let moment = 40e6 * section.iy_m4 / 1e-3;
    near(fibre.factor, (moment - own) / (0.01 * 0.05), 1e-9);
    assert_eq!((fibre.criterion, fibre.at), (Criterion::Fibre, Some(0)));
    // bending of the patch 4 M/(π r³), shear V/A
    let line = 1240.0 * section.area_m2 * 9.80665;
    let patch = |factor: f64| {
        let bend = 4.0 * (own + factor * 0.01 * 0.05) / (PI * 1e-9);
        let shear = (line * 0.05 + factor * 0.01) / section.area_m2;
        (bend / 20e6).hypot(shear / (20e6 / 3f64.sqrt()))
    };
    near(patch(node.factor), 1.0, 1e-9);
    assert_eq!((node.criterion, node.at), (Criterion::Node, Some(0)));
    // without anything lasting it is the inverse of the utilisation
    let none = solve(&frame, &held, &falling(NO_GRAVITY)).unwrap();
    let [_, fibre, _] = yields(&strengths, (&none, NO_GRAVITY), both.1).unwrap();
    let used = utilisation(&frame, &strengths, &push, NO_GRAVITY).unwrap().unwrap();
    near(fibre.factor, 1.0 / used.value, 1e-9);
    let still = (&none, NO_GRAVITY);
    assert!(yields(&strengths, still, still).unwrap().iter().all(|it| it.factor == f64::INFINITY));
    let weak = [Strength { tension_pa: 1.0, ..EQUAL }; 4];
    assert_eq!(yields(&weak, both.0, both.1).unwrap()[1].factor, 0.0);
    assert!(yields(&strengths[..3], both.0, both.1).is_err());
}

/// The clamped end of a cantilever along x as a patch.
fn root_weld(area_m2: f64, tension_pa: f64) -> Weld {
    Weld {
        node: 0,
        through: vec![(0, At::First)],
        area_m2,
        normal: Vector::x(),
        tension_pa,
        shear_pa: tension_pa / 3f64.sqrt(),
    }
}

/// A patch pulled, pressed, sheared and twisted, cut at the first end, in the middle and at the last end of the same rod: the same
/// traction, turned about.
#[test]
fn tractions_of_a_patch() {
    let x = Vector::new(0.0, 0.6, 0.8);
    let frame = chain(x, 0.05, 1);
    let area = Section::circle(2e-3).area_m2;
    let used = |load: [f64; 6], at: At, normal: Vector| {
        let solution = solve(&frame, &clamped([0]), &pushed(1, load)).unwrap();
        let weld = Weld { through: vec![(0, at)], normal, ..root_weld(area, 20e6) };
        let still = solve(&frame, &clamped([0]), &falling(NO_GRAVITY)).unwrap();
        let growing = (&solution, NO_GRAVITY);
        let found = first_yield(&frame, (&[EQUAL], &[weld]), (&still, NO_GRAVITY), growing);
        1.0 / found.unwrap()[2].factor
    };
    let along = |force: f64| [0.0, 0.6 * force, 0.8 * force, 0.0, 0.0, 0.0];
    // the older side is before the first end, behind the middle and behind the last end
    for (at, normal) in [(At::First, x), (At::Middle, -x), (At::Last, -x)] {
        near(used(along(5.0), at, normal), 5.0 / area / 20e6, 1e-9);
        assert_eq!(used(along(-5.0), at, normal), 0.0);
        let twist = [0.0, 0.0, 0.0, 0.0, 0.6 * 2e-3, 0.8 * 2e-3];
        let shear = 2.0 * 2e-3 / (PI * 1e-9);
        near(used(twist, at, normal), shear / (20e6 / 3f64.sqrt()), 1e-9);
    }
    // across, at the tip: no moment, shear alone
    let shear = 0.3 / area / (20e6 / 3f64.sqrt());
    near(used([0.3, 0.0, 0.0, 0.0, 0.0, 0.0], At::Last, -x), shear, 1e-9);
}
