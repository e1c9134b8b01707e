//! Input that means little or nothing.

use super::{cartesian, law, line, station};
use crate::kinematics::Posture;
use crate::timing::{Fault, Limits, Station, Torque, TorqueRow, follow_times, time_law};

fn sound() -> Limits<'static> {
    Limits { path_acceleration: Some(1.0), ..cartesian() }
}

#[test]
fn little_path_takes_no_time() {
    let one = [station(3.0, &[1.0, 2.0], 0.1)];
    let still = law(&one, &sound());
    assert_eq!((still.duration_s, still.passings.len()), (0.0, 1));
    assert_eq!(&still.at(0.0).q[..], &[1.0, 2.0]);
    assert_eq!(&still.at(f64::NAN).q[..], &[1.0, 2.0]);
    let repeated = law(&[one[0], one[0], one[0]], &sound());
    assert_eq!((repeated.duration_s, repeated.passings.len()), (0.0, 3));
}

#[test]
fn repeated_samples_change_nothing() {
    let once = line(1.0, 10, 0.5);
    let twice: Vec<Station> = once.iter().flat_map(|station| [*station; 2]).collect();
    let (one, two) = (law(&once, &sound()), law(&twice, &sound()));
    assert_eq!(one.duration_s, two.duration_s);
    assert_eq!(one.passings[7].time_s, two.passings[15].time_s);
}

#[test]
fn faults_are_told_with_their_place() {
    let fault = |stations: &[Station], limits: &Limits| {
        time_law(stations, limits).expect_err("unsound input")
    };
    let with = |change: &dyn Fn(&mut Vec<Station>)| {
        let mut stations = line(1.0, 4, 0.5);
        change(&mut stations);
        fault(&stations, &sound())
    };
    assert_eq!(fault(&[], &sound()), Fault::Empty);
    assert_eq!(with(&|all| all[2].s = f64::NAN), Fault::NotFinite { station: 2 });
    assert_eq!(with(&|all| all[2].q[1] = f64::INFINITY), Fault::NotFinite { station: 2 });
    assert_eq!(with(&|all| all[2].q = Posture::zeros(3)), Fault::Joints { station: 2 });
    assert_eq!(with(&|all| all[2].s = 0.1), Fault::Backwards { station: 2 });
    assert_eq!(with(&|all| all[2].s = all[1].s), Fault::Jump { station: 2 });
    assert_eq!(with(&|all| all[3].ceiling = 0.0), Fault::Ceiling { station: 3 });
    let lines = line(1.0, 4, 0.5);
    assert_eq!(fault(&lines, &cartesian()), Fault::NoAcceleration { joint: 0 });
    let some = [Some(1.0), None];
    let limits = Limits { acceleration: &some, ..cartesian() };
    assert_eq!(fault(&lines, &limits), Fault::NoAcceleration { joint: 1 });
    let velocity = Posture::new(&[1.0, 0.0]);
    assert_eq!(fault(&lines, &Limits { velocity, ..sound() }), Fault::Limit { joint: 1 });
    let jerk = [Some(f64::NAN)];
    assert_eq!(fault(&lines, &Limits { jerk: &jerk, ..sound() }), Fault::Limit { joint: 0 });
    assert_eq!(fault(&lines, &Limits { path_jerk: Some(-1.0), ..sound() }), Fault::PathLimit);
    assert_eq!(fault(&lines, &Limits { blend_m: f64::NAN, ..sound() }), Fault::PathLimit);
    assert_eq!(
        follow_times(&lines, &[0.0; 3], &sound()).expect_err("few"),
        Fault::Times { station: 3 }
    );
    let times = [0.0, 1.0, 1.0, 2.0, 3.0];
    assert_eq!(
        follow_times(&lines, &times, &sound()).expect_err("no time"),
        Fault::Times { station: 2 }
    );
}

#[test]
fn an_arm_too_weak_to_stand_is_told() {
    let law = |_: &[f64], d1: &[f64], d2: &[f64]| TorqueRow {
        acceleration: Posture::new(d1),
        speed_squared: Posture::new(d2),
        rest: Posture::new(&[0.0, 9.0]),
    };
    let (lower, upper) = (Posture::new(&[-8.0; 2]), Posture::new(&[8.0; 2]));
    let limits = Limits { torque: Some(Torque { lower, upper, law: &law }), ..sound() };
    let fault = time_law(&line(1.0, 4, 0.5), &limits).expect_err("too weak");
    assert_eq!(fault, Fault::Weak { joint: 1, s: 0.0 });
}
