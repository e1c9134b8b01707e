//! The time law of 10 000 stations on six joints, beside the largest constant speed that is safe.

// criterion_group! makes a public function without documentation.
#![allow(missing_docs)]

use std::f64::consts::PI;
use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use sim::kinematics::Posture;
use sim::timing::{Limits, Station, time_law};

const N: usize = 10_000;
const DOF: usize = 6;
/// 360, 300, 360, 450, 450, 540 °/s: KR 6 R900-2, kroshu/kuka_robot_descriptions, as the accelerations.
const VELOCITY: [f64; DOF] = [2.0 * PI, PI / 0.6, 2.0 * PI, 2.5 * PI, 2.5 * PI, 3.0 * PI];
const ACCELERATION: [Option<f64>; DOF] =
    [Some(22.8), Some(6.6), Some(24.4), Some(122.6), Some(119.0), Some(237.0)];
const JERK: [Option<f64>; DOF] = [Some(500.0); DOF];

/// 40 m of path in samples of 4 mm; joints swing at wavelengths of 0.1 m to 1 m.
fn stations() -> Vec<Station> {
    let q = |s: f64| -> Vec<f64> {
        let swing = |j: usize| {
            let wave = 6.0 + 9.0 * j as f64;
            (0.3 * (wave * s).sin() + 0.1 * (0.37 * wave * s + 1.0).cos()) / (1.0 + j as f64)
        };
        (0..DOF).map(swing).collect()
    };
    let at = |k: usize| {
        let s = 0.004 * k as f64;
        Station { s, q: Posture::new(&q(s)), ceiling: 1.0, stop: false, corner: false }
    };
    (0..N).map(at).collect()
}

/// Time of the path at the largest constant speed, found by halving, at which differences of three
/// samples keep to speed and acceleration everywhere; a stop at its ends is left out.
fn constant_speed(stations: &[Station]) -> f64 {
    let keeps = |v: f64| {
        stations.windows(3).all(|w| {
            let (h, h_next) = (w[1].s - w[0].s, w[2].s - w[1].s);
            (0..DOF).all(|j| {
                let (d, d_next) = ((w[1].q[j] - w[0].q[j]) / h, (w[2].q[j] - w[1].q[j]) / h_next);
                let bend = 2.0 * (d_next - d) / (h + h_next);
                d.abs() * v <= VELOCITY[j]
                    && ACCELERATION[j].is_none_or(|a| bend.abs() * v * v <= a)
            })
        })
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = (low + high) / 2.0;
        if keeps(middle) { low = middle } else { high = middle }
    }
    (stations[N - 1].s - stations[0].s) / low
}

fn timing(criterion: &mut Criterion) {
    let stations = stations();
    let gentle = Limits {
        velocity: Posture::new(&VELOCITY),
        acceleration: &ACCELERATION,
        jerk: &JERK,
        path_acceleration: Some(2.0),
        path_jerk: Some(50.0),
        blend_m: 0.0,
        torque: None,
    };
    let hard = Limits { jerk: &[], path_jerk: None, ..gentle };
    let time = |limits: &Limits| time_law(&stations, limits).map_or(f64::NAN, |law| law.duration_s);
    let (fast, smooth, slow) = (time(&hard), time(&gentle), constant_speed(&stations));
    // The names carry what the laws are worth: seconds of motion.
    let mut group = criterion.benchmark_group("10000 stations of 6 joints");
    group.sample_size(10);
    group.bench_function(format!("time law, {fast:.1} s"), |bencher| {
        bencher.iter(|| time_law(black_box(&stations), &hard));
    });
    group.bench_function(format!("time law with jerk, {smooth:.1} s"), |bencher| {
        bencher.iter(|| time_law(black_box(&stations), &gentle));
    });
    group.bench_function(format!("constant safe speed, {slow:.1} s"), |bencher| {
        bencher.iter(|| constant_speed(black_box(&stations)));
    });
    group.finish();
}

criterion_group!(benches, timing);
criterion_main!(benches);
