//! The free jet against momentum, its far field and its limits.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::*;
use crate::process::tests::{close, within};

#[test]
fn momentum_is_the_same_at_every_distance() {
    let (bore, exit) = (1.5e-3, 40.0);
    let want = exit * exit * PI * bore * bore / 4.0;
    for bores in [0.0, 0.5, 2.0, 5.0, 6.2, 6.3, 10.0, 50.0, 400.0] {
        let ahead = bores * bore;
        let reach = bore + ahead;
        let rings = 20_000;
        let width = reach / f64::from(rings);
        let got: f64 = (0..rings)
            .map(|i| {
                let beside = (f64::from(i) + 0.5) * width;
                free_jet_m_s(bore, exit, ahead, beside).powi(2) * 2.0 * PI * beside * width
            })
            .sum();
        close(got, want, 1e-4);
    }
}

#[test]
fn decay_and_spread() {
    let (bore, exit) = (2e-3, 30.0);
    for bores in [7.0, 20.0, 100.0] {
        let ahead = bores * bore;
        let middle = free_jet_m_s(bore, exit, ahead, 0.0);
        close(middle, exit * 6.2 / bores, 1e-12);
        // Half the speed at 0.0950 x: between the measured 0.094 and 0.096.
        let half = (std::f64::consts::LN_2 / 2.0).sqrt() / 6.2;
        within(half, 0.0950, 5e-5);
        close(free_jet_m_s(bore, exit, ahead, half * ahead), 0.5 * middle, 1e-9);
    }
    // Full speed in the core, none before the mouth or outside it at the mouth.
    close(free_jet_m_s(bore, exit, 6.0 * bore, 0.0), exit, 1e-12);
    close(free_jet_m_s(bore, exit, 3.1 * bore, 0.24 * bore), exit, 1e-12);
    assert_eq!(free_jet_m_s(bore, exit, -1e-9, 0.0), 0.0);
    assert_eq!(free_jet_m_s(bore, exit, 0.0, 0.51 * bore), 0.0);
    // No jump where the core ends.
    for beside in [0.0, 0.3e-3, 1e-3, 2e-3] {
        let (end, by) = (6.2 * bore, 1e-9);
        let before = free_jet_m_s(bore, exit, end - by, beside);
        within(before, free_jet_m_s(bore, exit, end + by, beside), 1e-3);
    }
}

fn nozzle(at: [f64; 3], along: [f64; 3]) -> AirNozzle {
    AirNozzle {
        at: Point::from(at),
        along: Vector::from(along),
        bore_m: 1e-3,
        exit_speed_m_s: 50.0,
    }
}

#[test]
fn only_what_is_square_to_the_strand() {
    let jet = nozzle([0.02, 0.0, 0.0], [-3.0, 0.0, 0.0]);
    let point = Point::new(0.0, 0.0, 0.0);
    let square = air_speed_m_s(&[jet], &point, &Vector::z());
    close(square, 50.0 * 6.2 / 20.0, 1e-12);
    let tilted = Vector::new(1.0, 0.0, 1.0);
    close(air_speed_m_s(&[jet], &point, &tilted), square * 0.5_f64.sqrt(), 1e-12);
    within(air_speed_m_s(&[jet], &point, &Vector::x()), 0.0, 1e-12);
    // Two at a right angle, and four alike: root of the sum of squares.
    let other = nozzle([0.0, 0.02, 0.0], [0.0, -1.0, 0.0]);
    let both = air_speed_m_s(&[jet, other], &point, &Vector::z());
    close(both, square * 2.0_f64.sqrt(), 1e-12);
    close(air_speed_m_s(&[jet; 4], &point, &Vector::z()), 2.0 * square, 1e-12);
    assert_eq!(air_speed_m_s(&[], &point, &Vector::z()), 0.0);
    // Twice as large in every length is the same.
    let large = AirNozzle { at: jet.at * 2.0, bore_m: 2.0 * jet.bore_m, ..jet };
    let (near, far) = (Point::new(0.001, 0.002, 0.0005), Point::new(0.002, 0.004, 0.001));
    let got = air_speed_m_s(&[large], &far, &Vector::z());
    close(got, air_speed_m_s(&[jet], &near, &Vector::z()), 1e-12);
}

#[test]
fn the_same_in_turned_axes() {
    let turn = nalgebra::Rotation3::from_euler_angles(0.3, -1.1, 2.0);
    let jet = nozzle([0.01, 0.002, 0.004], [-1.0, -0.2, 0.1]);
    let turned = AirNozzle { at: turn * jet.at, along: turn * jet.along, ..jet };
    let (point, tangent) = (Point::new(0.001, 0.0005, 0.003), Vector::new(0.1, 0.4, 1.0));
    let want = air_speed_m_s(&[jet], &point, &tangent);
    assert!(want > 1.0);
    close(air_speed_m_s(&[turned], &(turn * point), &(turn * tangent)), want, 1e-12);
}

#[test]
fn a_jet_cools_only_where_it_hits() {
    // Strand leaves along +z; the jet crosses it 5 mm behind the orifice from 12 mm away.
    let jet = nozzle([0.012, 0.0, 0.005], [-1.0, 0.0, 0.0]);
    let profile = JetProfile::new(&[jet], &Point::origin(), &Vector::z(), 0.02, 201);
    close(profile.at_distance_m_s(0.005), 50.0 * 6.2 / 12.0, 1e-9);
    let half_m = 0.0950 * 0.012;
    close(profile.at_distance_m_s(0.005 + half_m), 25.0 * 6.2 / 12.0, 2e-3);
    assert!(profile.at_distance_m_s(0.0) < 1e-4 && profile.at_distance_m_s(0.012) < 1e-9);
    assert_eq!(profile.at_distance_m_s(0.021), 0.0);
    assert_eq!(profile.at_distance_m_s(-0.001), 0.0);
    // At 5 mm/s the section meets it at an age of one second; else there is the draught.
    close(profile.at_age_m_s(1.0, 0.005, 0.2), 50.0 * 6.2 / 12.0, 1e-9);
    assert_eq!(profile.at_age_m_s(3.0, 0.005, 0.2), 0.2);
    assert_eq!(profile.at_age_m_s(30.0, 0.005, 0.2), 0.2);
}

proptest! {
    #[test]
    fn never_panics(
        numbers in prop::array::uniform12(prop::num::f64::ANY),
        points in 0_usize..50,
    ) {
        let [a, b, c, d, e, f, bore_m, exit_speed_m_s, x, y, z, reach] = numbers;
        let at = Point::new(a, b, c);
        let jet = AirNozzle { at, along: Vector::new(d, e, f), bore_m, exit_speed_m_s };
        let profile = JetProfile::new(&[jet], &Point::new(x, y, z), &Vector::z(), reach, points);
        let _ = profile.at_distance_m_s(x);
        let _ = profile.at_age_m_s(y, z, a);
    }

    #[test]
    fn never_faster_than_at_the_mouth(ahead in 0.0..1.0_f64, beside in 0.0..0.1_f64, bore in 1e-4..1e-2_f64) {
        let speed = free_jet_m_s(bore, 30.0, ahead, beside);
        prop_assert!((0.0..=30.0).contains(&speed));
        prop_assert!(free_jet_m_s(bore, 30.0, ahead, 1.1 * beside) <= speed);
    }
}
