//! Straight lines against closed forms.

use super::{cartesian, law, line, near, station};
use crate::kinematics::Posture;
use crate::timing::{Bound, Limits, Station, Torque, TorqueRow};

/// Time of the trapezoid, or of the triangle where the way is too short for it.
fn trapezoid(length: f64, v: f64, a: f64) -> f64 {
    if length >= v * v / a { length / v + v / a } else { 2.0 * (length / a).sqrt() }
}

/// Time of the seven-segment profile, Biagiotti and Melchiorri 3.4.
fn s_curve(length: f64, v: f64, a: f64, j: f64) -> f64 {
    // Time of a rise to `v`, and the way of a rise and a fall.
    let rise = |v: f64| if v * j >= a * a { v / a + a / j } else { 2.0 * (v / j).sqrt() };
    if length >= v * rise(v) {
        return length / v + rise(v);
    }
    let (mut low, mut high) = (0.0, v);
    for _ in 0..200 {
        let middle = (low + high) / 2.0;
        if middle * rise(middle) < length { low = middle } else { high = middle }
    }
    2.0 * rise(low)
}

#[test]
fn a_line_takes_the_time_of_the_trapezoid() {
    for length in [1e-4, 0.01, 0.2, 3.0] {
        for n in [1, 2, 7, 250] {
            for (v, a) in [(0.02, 0.5), (0.5, 1.0), (2.0, 0.1)] {
                let along = Limits { path_acceleration: Some(a), ..cartesian() };
                let law_along = law(&line(length, n, v), &along);
                near(law_along.duration_s, trapezoid(length, v, a), 1e-9);
                // The same from the limits of joints: y moves half as fast as x.
                let velocity = Posture::new(&[10.0 * v, v / 2.0]);
                let acceleration = [Some(a), Some(a)];
                let joints = Limits { velocity, acceleration: &acceleration, ..cartesian() };
                let by_joints = law(&line(length, n, f64::INFINITY), &joints);
                near(by_joints.duration_s, trapezoid(length, v, a), 1e-6);
            }
        }
    }
}

#[test]
fn torque_bounds_of_a_mass_are_acceleration_bounds() {
    let (mass, weight) = (3.0, 5.0);
    let law_of = |_: &[f64], d1: &[f64], d2: &[f64]| TorqueRow {
        acceleration: Posture::new(&[mass * d1[0], mass * d1[1]]),
        speed_squared: Posture::new(&[mass * d2[0], mass * d2[1]]),
        rest: Posture::new(&[0.0, weight]),
    };
    // The other joint has 2 N to either side of its weight, and moves half as fast.
    let (lower, upper) = (Posture::new(&[-3.0, 3.0]), Posture::new(&[3.0, 7.0]));
    let torque = Some(Torque { lower, upper, law: &law_of });
    let limits = Limits { torque, path_acceleration: Some(1e6), ..cartesian() };
    let moved = law(&line(1.0, 40, 0.5), &limits);
    near(moved.duration_s, trapezoid(1.0, 0.5, 1.0), 1e-6);
    assert_eq!(moved.passings[2].bound, Bound::Torque(0));
    near(moved.peaks.torque_share.expect("bounds")[0], 1.0, 1e-6);
    near(moved.peaks.torque_share.expect("bounds")[1], 0.75, 1e-6);
}

#[test]
fn a_line_with_jerk_takes_the_time_of_the_seven_segments() {
    let mut worst = 0.0_f64;
    for length in [1e-4, 0.003, 0.05, 0.4, 3.0] {
        for n in [1, 3, 60] {
            for (v, a, j) in [(0.02, 0.5, 10.0), (0.5, 1.0, 4.0), (0.5, 1.0, 1.0), (2.0, 0.3, 50.0)]
            {
                let wanted = s_curve(length, v, a, j);
                let along =
                    Limits { path_acceleration: Some(a), path_jerk: Some(j), ..cartesian() };
                let one = law(&line(length, n, v), &along).duration_s;
                let (acceleration, jerk) = ([Some(a), Some(a)], [Some(j), None]);
                let joints = Limits {
                    acceleration: &acceleration,
                    jerk: &jerk,
                    velocity: Posture::new(&[v, v]),
                    ..cartesian()
                };
                let other = law(&line(length, n, f64::INFINITY), &joints).duration_s;
                for time in [one, other] {
                    worst = worst.max((time / wanted - 1.0).abs());
                    assert!(time > wanted * (1.0 - 1e-6), "faster than is possible");
                    if (time / wanted - 1.0).abs() > 0.005 {
                        println!("BAD {length} {n} {v} {a} {j}: {time} {wanted}");
                    }
                }
            }
        }
    }
    println!("seven segments: worst {worst:.1e}");
}

#[test]
fn the_law_itself_is_the_trapezoid() {
    let limits = Limits { path_acceleration: Some(2.0), ..cartesian() };
    let moved = law(&line(1.0, 9, 0.5), &limits);
    for (time_s, s, v, a) in
        [(0.1, 0.01, 0.2, 2.0), (1.0, 0.4375, 0.5, 0.0), (2.15, 0.99, 0.2, -2.0)]
    {
        let state = moved.at(time_s);
        near(state.path[0], s, 1e-9);
        near(state.path[1], v, 1e-9);
        assert!((state.path[2] - a).abs() < 1e-6, "{state:?}");
        near(state.q[1], s / 2.0, 1e-9);
        near(state.speed[1], v / 2.0, 1e-9);
    }
    assert_eq!(moved.passings[4].bound, Bound::Ceiling);
    assert_eq!(moved.acceleration_unknown, [0, 1]);
    near(moved.time_at(0.4375), 1.0, 1e-9);
}

#[test]
fn a_ceiling_holds_from_its_station_to_the_next() {
    let mut stations = line(1.0, 10, 0.5);
    stations[4].ceiling = 0.1;
    for path_jerk in [None, Some(20.0)] {
        let limits = Limits { path_acceleration: Some(2.0), path_jerk, ..cartesian() };
        let moved = law(&stations, &limits);
        for (k, passing) in moved.passings.iter().enumerate() {
            if k == 4 || k == 5 {
                near(passing.speed, 0.1, 0.03);
            }
        }
        let spent = moved.passings[5].time_s - moved.passings[4].time_s;
        near(spent, 1.0, 0.01);
        // Closed form: out at once, down before station 4, up after station 5.
        let jerk_s = path_jerk.map_or(0.0, |j| 2.0 / j);
        let (rise, step) = (0.5 / 2.0 + jerk_s, 0.4 / 2.0 + jerk_s);
        let way = |v: f64, v_next: f64, time: f64| (v + v_next) / 2.0 * time;
        let cruise = 0.9 - 2.0 * (way(0.0, 0.5, rise) + way(0.5, 0.1, step));
        near(moved.duration_s, 1.0 + 2.0 * (rise + step) + cruise / 0.5, 0.005);
    }
}

#[test]
fn stops_and_corners_without_rounding_are_rests() {
    let mut stations = line(1.0, 10, 0.5);
    stations[5].stop = true;
    let limits = Limits { path_acceleration: Some(2.0), ..cartesian() };
    let stopped = law(&stations, &limits);
    near(stopped.duration_s, 2.0 * trapezoid(0.5, 0.5, 2.0), 1e-9);
    assert!(stopped.passings[5].speed.abs() < 1e-9);
    stations[5].stop = false;
    stations[5].corner = true;
    assert_eq!(law(&stations, &limits).duration_s, stopped.duration_s);
}

/// An L: along x, then along y.
fn corner(side: f64, ceiling: f64) -> Vec<Station> {
    let mut stations = vec![
        station(0.0, &[0.0, 0.0], ceiling),
        station(side, &[side, 0.0], ceiling),
        station(2.0 * side, &[side, side], ceiling),
    ];
    stations[1].corner = true;
    stations
}

#[test]
fn a_corner_is_rounded_as_told() {
    let acceleration = [Some(1.0), Some(1.0)];
    let limits = Limits { acceleration: &acceleration, blend_m: 0.01, ..cartesian() };
    let rounded = law(&corner(0.5, 0.4), &limits);
    let rounding = &rounded.roundings[0];
    assert_eq!((rounding.station, rounding.half_m), (1, 0.01));
    near(rounding.deviation[0], -3.0 / 16.0 * 0.01, 1e-9);
    near(rounding.deviation[1], 3.0 / 16.0 * 0.01, 1e-9);
    let middle = rounded.at(rounded.passings[1].time_s);
    near(middle.q[0], 0.5 - 3.0 / 16.0 * 0.01, 1e-6);
    // q'' is 3/2 / (2 b) in the middle and less elsewhere: passed at constant speed or faster.
    let slow = (2.0 * 0.01 / 1.5_f64).sqrt();
    assert!(rounded.passings[1].speed > 0.99 * slow, "{}", rounded.passings[1].speed);
    let limits = Limits { blend_m: 0.0, ..limits };
    let stopped = law(&corner(0.5, 0.4), &limits);
    assert!(stopped.duration_s > rounded.duration_s + 0.1);
}

#[test]
fn roundings_leave_room_for_each_other() {
    let mut stations: Vec<Station> = (0..9)
        .map(|k| {
            station(
                f64::from(k) * 0.01,
                &[f64::from(k / 2) * 0.01, f64::from((k + 1) / 2) * 0.01],
                0.1,
            )
        })
        .collect();
    for station in &mut stations[1..8] {
        station.corner = true;
    }
    let acceleration = [Some(1.0), Some(1.0)];
    let limits = Limits { acceleration: &acceleration, blend_m: 1.0, ..cartesian() };
    let moved = law(&stations, &limits);
    assert_eq!(moved.roundings.len(), 7);
    assert!(moved.roundings.iter().all(|rounding| rounding.half_m < 0.005));
    assert!(moved.peaks.acceleration.iter().all(|a| *a <= 1.0 + 1e-6));
}
