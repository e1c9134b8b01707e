mod arcs;
mod broken;
mod given;
mod lines;
mod random;

use super::{Law, Limits, Station, time_law};
use crate::kinematics::Posture;

pub(super) fn station(s: f64, q: &[f64], ceiling: f64) -> Station {
    Station { s, q: Posture::new(q), ceiling, stop: false, corner: false }
}

/// A machine with two straight axes; nothing bounds it but what a test adds.
pub(super) fn cartesian() -> Limits<'static> {
    Limits {
        velocity: Posture::new(&[f64::INFINITY; 2]),
        acceleration: &[],
        jerk: &[],
        path_acceleration: None,
        path_jerk: None,
        blend_m: 0.0,
        torque: None,
    }
}

/// Straight along x and half as far along y, `s` in x, in `n` pieces.
pub(super) fn line(length: f64, n: usize, ceiling: f64) -> Vec<Station> {
    let at = |k: usize| {
        let s = length * k as f64 / n as f64;
        station(s, &[s, s / 2.0], ceiling)
    };
    (0..=n).map(at).collect()
}

/// About the origin from the x axis, `s` the arc length.
pub(super) fn arc(radius: f64, angle: f64, n: usize, ceiling: f64) -> Vec<Station> {
    let at = |k: usize| {
        let turned = angle * k as f64 / n as f64;
        station(radius * turned, &[radius * turned.cos(), radius * turned.sin()], ceiling)
    };
    (0..=n).map(at).collect()
}

pub(super) fn law(stations: &[Station], limits: &Limits) -> Law {
    time_law(stations, limits).expect("sound input")
}

#[track_caller]
pub(super) fn near(value: f64, wanted: f64, share: f64) {
    assert!((value - wanted).abs() <= share * wanted.abs(), "{value} is not {wanted}");
}
