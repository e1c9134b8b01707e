//! Limits along random paths.

use std::fmt::Write;

use proptest::prelude::*;

use super::{law, station};
use crate::kinematics::Posture;
use crate::timing::{Law, Limits, Station};

const DOF: usize = 4;

#[derive(Debug, Clone)]
struct Case {
    steps: Vec<(f64, [f64; DOF], f64, u8)>,
    velocity: [f64; DOF],
    acceleration: Vec<Option<f64>>,
    jerk: Vec<Option<f64>>,
    path: (f64, Option<f64>),
    blend_m: f64,
}

fn case(with_jerk: bool) -> impl Strategy<Value = Case> {
    let step =
        (1e-4..0.05_f64, [-0.2..0.2_f64, -0.2..0.2, -0.2..0.2, -0.2..0.2], 0.01..1.0_f64, 0..8_u8);
    let limit = |low: f64, high: f64| prop_oneof![3 => (low..high).prop_map(Some), 1 => Just(None)];
    (
        prop::collection::vec(step, 1..20),
        [0.1..3.0_f64, 0.1..3.0, 0.1..3.0, 0.1..3.0],
        prop::collection::vec(limit(0.5, 30.0), DOF),
        prop::collection::vec(limit(5.0, 1000.0), DOF),
        (0.1..10.0_f64, limit(1.0, 1000.0)),
        prop_oneof![Just(0.0), 1e-4..0.02_f64],
    )
        .prop_map(move |(steps, velocity, acceleration, jerk, path, blend_m)| Case {
            steps,
            velocity,
            acceleration,
            jerk: if with_jerk { jerk } else { Vec::new() },
            path: if with_jerk { path } else { (path.0, None) },
            blend_m,
        })
}

fn stations(case: &Case) -> Vec<Station> {
    let (mut s, mut q) = (0.0, [0.0; DOF]);
    let mut out = vec![station(s, &q, 0.3)];
    for (way, by, ceiling, kind) in &case.steps {
        s += way;
        q.iter_mut().zip(by).for_each(|(value, by)| *value += by);
        let own = station(s, &q, *ceiling);
        out.push(Station { stop: *kind == 0, corner: *kind == 1 || *kind == 2, ..own });
    }
    out
}

fn of(case: &Case) -> (Vec<Station>, Law) {
    let stations = stations(case);
    let limits = Limits {
        velocity: Posture::new(&case.velocity),
        acceleration: &case.acceleration,
        jerk: &case.jerk,
        path_acceleration: Some(case.path.0),
        path_jerk: case.path.1,
        blend_m: case.blend_m,
        torque: None,
    };
    let law = law(&stations, &limits);
    (stations, law)
}

/// Whether the law's own derivatives keep every limit at `per_step` places of each of its steps.
fn exceeded(case: &Case, stations: &[Station], law: &Law, per_step: usize) -> String {
    const MOST: f64 = 1.0 + 1e-6;
    let instants: Vec<f64> = law.instants().collect();
    let mut out = String::new();
    let last = stations.len() - 1;
    let ceiling = |s: f64| {
        // At a station, and where a corner is rounded, that of either side.
        let near = |k: &usize| {
            let slack =
                if stations[*k].corner || stations[*k + 1].corner { case.blend_m } else { 1e-9 };
            s >= stations[*k].s - slack && s <= stations[*k + 1].s + slack
        };
        (0..last).filter(near).map(|k| stations[k].ceiling).fold(0.0, f64::max)
    };
    let mut check = |what: &str, value: f64, limit: Option<f64>, t: f64| {
        if limit.is_some_and(|limit| !(value.abs() <= limit * MOST)) {
            writeln!(out, "{what} {value} past {limit:?} at {t}").expect("a string takes text");
        }
    };
    for pair in instants.windows(2) {
        assert!(pair[1] > pair[0], "time stands");
        for k in 0..per_step {
            let t = pair[0] + (pair[1] - pair[0]) * (k as f64 + 0.5) / per_step as f64;
            let state = law.at(t);
            check("ds/dt", state.path[1], Some(ceiling(state.path[0])), t);
            check("d2s/dt2", state.path[2], Some(case.path.0), t);
            check("d3s/dt3", state.path[3], case.path.1, t);
            for joint in 0..DOF {
                check("speed", state.speed[joint], Some(case.velocity[joint]), t);
                check("acceleration", state.acceleration[joint], case.acceleration[joint], t);
                check("jerk", state.jerk[joint], case.jerk.get(joint).copied().flatten(), t);
            }
        }
    }
    out
}

/// Differences of `q(t)` over equal times against the limits: whatever the law says of itself, the
/// mean over `h` of what is bounded is bounded. Where pieces of the law meet, and at a corner that is not rounded, the speed
/// along the path may jump by what the search for it leaves, 1e-9 m/s, and that of a joint by as much times its steepness.
fn differences(case: &Case, law: &Law) -> String {
    const JUMP_M_S: f64 = 1e-9;
    let n = 4000_u32;
    let h = law.duration_s / f64::from(n);
    let q: Vec<Posture> = (0..=n).map(|k| law.at(f64::from(k) * h).q).collect();
    let mut out = String::new();
    let mut check = |what: &str, value: f64, limit: Option<f64>, noise: f64| {
        if limit.is_some_and(|limit| !(value.abs() <= limit * (1.0 + 1e-6) + noise)) {
            writeln!(out, "differences: {what} {value} past {limit:?}")
                .expect("a string takes text");
        }
    };
    for joint in 0..DOF {
        let at = |k: usize| q[k][joint];
        let steepness = case.steps.iter().map(|(way, by, ..)| by[joint].abs() / way);
        let jump = JUMP_M_S * steepness.fold(0.0, f64::max);
        for k in 3..q.len() {
            // Rounding of q is 1e-15 or so.
            check("speed", (at(k) - at(k - 1)) / h, Some(case.velocity[joint]), 4e-15 / h);
            let second = (at(k) - 2.0 * at(k - 1) + at(k - 2)) / (h * h);
            check("acceleration", second, case.acceleration[joint], 8e-15 / (h * h) + jump / h);
            let third = (at(k) - 3.0 * at(k - 1) + 3.0 * at(k - 2) - at(k - 3)) / (h * h * h);
            let jerk = case.jerk.get(joint).copied().flatten();
            check("jerk", third, jerk, 2e-14 / (h * h * h) + 2.0 * jump / (h * h));
        }
    }
    out
}

fn rests(stations: &[Station], law: &Law) {
    let (first, last) = (law.at(0.0), law.at(law.duration_s));
    for (state, station) in [(first, &stations[0]), (last, &stations[stations.len() - 1])] {
        assert!(state.path[1].abs() < 1e-7, "moves at the end: {state:?}");
        assert!(state.q.distance(&station.q) < 1e-9, "not there at the end");
    }
    let times = law.passings.iter().map(|passing| passing.time_s);
    assert!(times.clone().zip(times.skip(1)).all(|(a, b)| b > a), "time falls");
    for (passing, _) in law.passings.iter().zip(stations).filter(|(_, s)| s.stop) {
        assert!(passing.speed.abs() < 1e-5, "moves at a stop: {passing:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn limits_hold_without_jerk(case in case(false)) {
        let (stations, law) = of(&case);
        rests(&stations, &law);
        let found = exceeded(&case, &stations, &law, 25) + &differences(&case, &law);
        prop_assert!(found.is_empty(), "{}", found);
    }

    #[test]
    fn limits_hold_with_jerk(case in case(true)) {
        let (stations, law) = of(&case);
        rests(&stations, &law);
        let found = exceeded(&case, &stations, &law, 25) + &differences(&case, &law);
        prop_assert!(found.is_empty(), "{}", found);
    }

    #[test]
    fn the_same_path_has_the_same_law(case in case(true)) {
        let ((_, one), (_, two)) = (of(&case), of(&case));
        prop_assert_eq!(&one.passings, &two.passings);
        prop_assert_eq!(one.profile, two.profile);
    }
}
