//! Circles against closed forms.

use super::{arc, cartesian, law, near, station};
use crate::kinematics::Posture;
use crate::timing::{Limits, Station};

/// Time of a trapezoid of speed long enough to reach `v`.
fn trapezoid(length: f64, v: f64, a: f64) -> f64 {
    length / v + v / a
}

#[test]
fn a_circle_is_as_fast_as_its_acceleration() {
    let turns = 4.0 * std::f64::consts::TAU;
    for (radius, a) in [(0.05, 1.0), (0.01, 0.3), (0.4, 6.0)] {
        let n = (radius * turns / 0.004_f64).ceil().max(120.0) as usize;
        let acceleration = [Some(a), Some(a)];
        let limits =
            Limits { acceleration: &acceleration, path_acceleration: Some(0.1 * a), ..cartesian() };
        let top = (a * radius).sqrt();
        // An axis alone bounds the speed where it takes all of it, in between both share it: the
        // asked speed makes it even, and must be reached.
        let even = law(&arc(radius, turns, n, top), &limits);
        let wanted = trapezoid(radius * turns, top, 0.1 * a);
        near(even.peaks.path_speed, top, 1e-4);
        near(even.duration_s, wanted, 0.005);
        println!("circle of {radius}: {:.6} of its time", even.duration_s / wanted);
        let free = law(&arc(radius, turns, n, f64::INFINITY), &limits);
        for quarter in 4..12 {
            let s = radius * f64::from(quarter) * std::f64::consts::FRAC_PI_2;
            near(free.at(free.time_at(s)).path[1], top, 0.005);
        }
    }
}

#[test]
fn a_circle_is_as_fast_as_its_joints() {
    let turns = 2.0 * std::f64::consts::TAU;
    let velocity = Posture::new(&[0.1, 0.1]);
    // Both axes pass their fastest place in every turn; in between the path may be faster by up to
    // the square root of two, and the ceiling keeps it from that.
    let limits = Limits { velocity, path_acceleration: Some(0.2), ..cartesian() };
    let moved = law(&arc(0.05, turns, 200, 0.1), &limits);
    near(moved.duration_s, trapezoid(0.05 * turns, 0.1, 0.2), 1e-3);
    let open = law(
        &arc(0.05, turns, 200, f64::INFINITY),
        &Limits { path_acceleration: Some(100.0), ..limits },
    );
    // ∫ max(|sin|, |cos|) r dφ / v = 8 sin 45° r / v per turn.
    near(open.duration_s, 2.0 * 8.0 * 0.5_f64.sqrt() * 0.05 / 0.1, 0.005);
}

#[test]
fn a_circle_with_jerk_keeps_its_cruise() {
    let turns = 6.0 * std::f64::consts::TAU;
    let (radius, a): (f64, f64) = (0.05, 1.0);
    let acceleration = [Some(a), Some(a)];
    let top = (a * radius).sqrt();
    // At constant speed the jerk is v³/r²: ten times that leaves the cruise alone.
    let j = 10.0 * top.powi(3) / (radius * radius);
    let jerk = [Some(j), Some(j)];
    let ramp = 0.1 * a;
    let limits = Limits {
        acceleration: &acceleration,
        jerk: &jerk,
        path_acceleration: Some(ramp),
        ..cartesian()
    };
    let moved = law(&arc(radius, turns, 500, top), &limits);
    near(moved.peaks.path_speed, top, 0.005);
    let wanted = trapezoid(radius * turns, top, ramp) + ramp / j;
    println!("circle with jerk: {:.6}", moved.duration_s / wanted);
    near(moved.duration_s, wanted, 0.005);
    // With less jerk than the circle takes, jerk sets the speed.
    let jerk = [Some(0.2 * j / 10.0), Some(0.2 * j / 10.0)];
    let moved = law(&arc(radius, turns, 500, f64::INFINITY), &Limits { jerk: &jerk, ..limits });
    let slow = (jerk[0].expect("a jerk") * radius * radius).cbrt();
    println!("jerk alone: {:.6} of its speed", moved.peaks.path_speed / slow);
    assert!(moved.peaks.path_speed <= slow * (1.0 + 1e-6));
    assert!(moved.peaks.path_speed > 0.97 * slow);
}

#[test]
fn jerk_costs_little_on_a_winding_path() {
    let at = |k: u32| {
        let s = 0.004 * f64::from(k);
        let q = [0.3 * (15.0 * s).sin(), 0.2 * (23.0 * s).cos() + 0.1 * (9.0 * s).sin()];
        station(s, &q, 1.0)
    };
    let stations: Vec<Station> = (0..400).map(at).collect();
    let (acceleration, jerk) = ([Some(6.0), Some(8.0)], [Some(300.0), Some(300.0)]);
    let velocity = Posture::new(&[2.0, 2.0]);
    let path_acceleration = Some(2.0);
    let hard = Limits { velocity, acceleration: &acceleration, path_acceleration, ..cartesian() };
    let gentle = Limits { jerk: &jerk, path_jerk: Some(100.0), ..hard };
    let (fast, smooth) = (law(&stations, &hard), law(&stations, &gentle));
    println!("winding: {:.4} s, with jerk {:.4} s", fast.duration_s, smooth.duration_s);
    assert!(smooth.duration_s > fast.duration_s);
    assert!(smooth.duration_s < 1.2 * fast.duration_s);
    // Neither leaves the arm idle: somewhere near every place something is at its limit.
    let used = fast.passings.iter().filter(|passing| passing.share > 0.99).count();
    assert!(used > 380, "{used} of 400");
}
