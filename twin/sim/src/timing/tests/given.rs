//! Times as given.

use super::{cartesian, line, near};
use crate::kinematics::Posture;
use crate::timing::{Bound, Limits, follow_times};

#[test]
fn even_times_give_constant_speed() {
    let stations = line(1.0, 10, 0.05);
    let times: Vec<f64> = (0..=10).map(|k| 3.0 + f64::from(k)).collect();
    let velocity = Posture::new(&[0.2, 0.04]);
    let law = follow_times(&stations, &times, &Limits { velocity, ..cartesian() }).expect("sound");
    near(law.duration_s, 10.0, 1e-12);
    for passing in &law.passings[..10] {
        near(passing.speed, 0.1, 1e-9);
        // Twice the asked speed is more of an excess than 5/4 of the joint's.
        assert_eq!(passing.bound, Bound::Ceiling);
        near(passing.share, 2.0, 1e-9);
    }
    near(law.peaks.speed[1], 0.05, 1e-9);
    assert!(law.peaks.path_acceleration < 1e-9);
}

#[test]
fn waits_and_stops_are_rests() {
    let mut stations = line(1.0, 4, 1.0);
    let wait = stations[2];
    stations.insert(2, wait);
    stations[0].stop = true;
    let times = [0.0, 1.0, 2.0, 5.0, 6.0, 7.0];
    let law = follow_times(&stations, &times, &cartesian()).expect("sound");
    for (time_s, s, v) in [(0.0, 0.0, 0.0), (2.0, 0.5, 0.0), (3.3, 0.5, 0.0), (7.0, 1.0, 0.25)] {
        let state = law.at(time_s);
        assert!(
            (state.path[0] - s).abs() < 1e-12 && (state.path[1] - v).abs() < 1e-12,
            "{state:?}"
        );
    }
    let mut before = 0.0;
    for k in 0..=7000 {
        let s = law.at(f64::from(k) * 1e-3).path[0];
        assert!(s >= before - 1e-12, "turns back");
        before = s;
    }
}
