//! Stress against strength where both are known by hand.

use super::*;
use crate::structure::{Governs, Strength, first_yield_factor, solve, utilisation};

const EQUAL: Strength = Strength { tension_pa: 40e6, compression_pa: 40e6, bond_fraction: 1.0 };
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
    let weld = Strength { bond_fraction: 0.5, ..EQUAL };
    let got = used([0.1, 0.0, 0.0, 0.0, 0.0, 0.0], weld);
    near(got.value, 0.1 * 0.05 * 1e-3 / section.iy_m4 / 20e6, 1e-10);
    assert_eq!((got.governs, got.station_m), (Governs::Bond, 0.0));
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

#[test]
fn first_yield() {
    let frame = chain(Vector::x(), 0.05, 4);
    let held = clamped([0]);
    let gravity = [0.0, 0.0, -9.80665];
    let weight = solve(&frame, &held, &falling(gravity)).unwrap();
    let push = solve(&frame, &held, &pushed(4, [0.0, 0.0, -0.01, 0.0, 0.0, 0.0])).unwrap();
    let strengths = [EQUAL; 4];
    let section = Section::circle(2e-3);
    let moment = 40e6 * section.iy_m4 / 1e-3;
    let own = 1240.0 * section.area_m2 * 9.80665 * 0.05f64.powi(2) / 2.0;
    let both = ((&weight, gravity), (&push, NO_GRAVITY));
    let factor = first_yield_factor(&frame, &strengths, both.0, both.1).unwrap();
    near(factor, (moment - own) / (0.01 * 0.05), 1e-9);
    // without anything lasting it is the inverse of the utilisation
    let none = solve(&frame, &held, &falling(NO_GRAVITY)).unwrap();
    let factor = first_yield_factor(&frame, &strengths, (&none, NO_GRAVITY), both.1).unwrap();
    let used = utilisation(&frame, &strengths, &push, NO_GRAVITY).unwrap().unwrap();
    near(factor, 1.0 / used.value, 1e-9);
    let still = (&none, NO_GRAVITY);
    assert_eq!(first_yield_factor(&frame, &strengths, still, still), Ok(f64::INFINITY));
    let weak = [Strength { tension_pa: 1.0, ..EQUAL }; 4];
    assert_eq!(first_yield_factor(&frame, &weak, both.0, both.1), Ok(0.0));
    assert!(first_yield_factor(&frame, &strengths[..3], both.0, both.1).is_err());
}
