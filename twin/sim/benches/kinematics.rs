//! µs per pose: forward, Jacobian, inverse by closed form, and the search that it replaces.
//!
//! Arms from published lengths: KR 6 R900 sixx (ros-industrial/kuka_experimental), SDA10F left arm
//! (ros-industrial/motoman).

// criterion_group! makes a public function without documentation.
#![allow(missing_docs)]

use std::f64::consts::{FRAC_PI_2, PI};
use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::Vector6;
use sim::kinematics::{
    Arm, Chain, ChainJoint, IkOptions, JointKind, Numeric, Solver, condition_number, recognise,
};
use sim::pose::{Pose, from_xyz_rpy};

type Row = ([f64; 3], [f64; 3], [f64; 3], f64, f64);

fn chain(rows: &[Row], tip: Pose) -> Chain {
    let joint = |(index, (xyz, rpy, axis, lower, upper)): (usize, &Row)| ChainJoint {
        name: format!("joint_{}", index + 1),
        kind: JointKind::Revolute,
        parent_from_joint: from_xyz_rpy(*xyz, *rpy),
        axis: (*axis).into(),
        lower: lower.to_radians(),
        upper: upper.to_radians(),
        velocity: 1.0,
        effort: None,
        mimic: None,
    };
    Chain::new(rows.iter().enumerate().map(joint).collect(), tip).expect("a sound chain")
}

fn kr6() -> Chain {
    let flat = [0.0; 3];
    let (down, y, back) = ([0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]);
    let rows = [
        ([0.0, 0.0, 0.4], flat, down, -170.0, 170.0),
        ([0.025, 0.0, 0.0], flat, y, -190.0, 45.0),
        ([0.455, 0.0, 0.0], flat, y, -120.0, 156.0),
        ([0.0, 0.0, 0.035], flat, back, -185.0, 185.0),
        ([0.42, 0.0, 0.0], flat, y, -120.0, 120.0),
        ([0.08, 0.0, 0.0], flat, back, -350.0, 350.0),
    ];
    chain(&rows, from_xyz_rpy([0.0; 3], [0.0, FRAC_PI_2, 0.0]))
}

fn sda10_left() -> Chain {
    let (out, back) = ([FRAC_PI_2, 0.0, 0.0], [-FRAC_PI_2, 0.0, 0.0]);
    let (plus, minus) = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
    let (here, along) = ([0.0; 3], [0.0, 0.36, 0.0]);
    let rows = [
        ([0.1, 0.265, 1.2], out, minus, -180.0, 180.0),
        (here, back, minus, -110.0, 110.0),
        (along, out, minus, -170.0, 170.0),
        (here, back, plus, -135.0, 135.0),
        (along, out, plus, -180.0, 180.0),
        (here, back, plus, -110.0, 110.0),
        ([0.0, 0.155, 0.0], back, minus, -180.0, 180.0),
    ];
    chain(&rows, from_xyz_rpy([0.0; 3], [0.0, 0.0, PI]))
}

/// Postures spread over the middle nine tenths of the limits by an additive recurrence.
fn postures(chain: &Chain, count: usize) -> Vec<Vec<f64>> {
    let share = |index: usize, axis: usize| (index as f64 * (2.0 + axis as f64).sqrt()).fract();
    let entry = |index: usize, axis: usize| {
        let limits = chain.axes()[axis];
        limits.lower + (limits.upper - limits.lower) * (0.05 + 0.9 * share(index, axis))
    };
    (0..count).map(|i| (0..chain.dof()).map(|axis| entry(i, axis)).collect()).collect()
}

fn inverse_all(arm: &Arm, poses: &[(Pose, f64)]) -> usize {
    let mut out = Vec::with_capacity(64);
    let mut total = 0;
    for (target, elbow_rad) in poses {
        let options = IkOptions { seed: None, elbow_rad: *elbow_rad };
        arm.inverse(black_box(target), &options, &mut out);
        total += out.len();
    }
    total
}

fn kinematics(criterion: &mut Criterion) {
    for (name, chain) in [("kr6", kr6()), ("sda10-left", sda10_left())] {
        let arm = recognise(&chain).expect("few joints");
        assert!(!matches!(arm.solver, Solver::Numeric(_)), "{name} is not recognised");
        let postures = postures(&chain, 1000);
        let pose = |q: &Vec<f64>| (chain.forward(q), arm.elbow_angle(q).unwrap_or(0.0));
        let poses: Vec<(Pose, f64)> = postures.iter().map(pose).collect();
        let mut group = criterion.benchmark_group(name);
        group.sample_size(20);
        // One iteration is 1000 poses: read ms as µs per pose.
        group.bench_function("forward x1000", |bencher| {
            bencher.iter(|| postures.iter().map(|q| chain.forward(q).translation.x).sum::<f64>());
        });
        let mut columns = [Vector6::zeros(); 8];
        group.bench_function("jacobian x1000", |bencher| {
            bencher.iter(|| {
                let tip = |q: &Vec<f64>| chain.jacobian_into(q, &mut columns).translation.x;
                postures.iter().map(tip).sum::<f64>()
            });
        });
        group.bench_function("condition number x1000", |bencher| {
            bencher.iter(|| postures.iter().map(|q| condition_number(&chain, q)).sum::<f64>());
        });
        group.bench_function("inverse, all branches x1000", |bencher| {
            bencher.iter(|| inverse_all(&arm, &poses));
        });
        let search = Arm { chain, solver: Solver::Numeric(Numeric::default()) };
        group.sample_size(10);
        group.bench_function("inverse by search x10", |bencher| {
            bencher.iter(|| inverse_all(&search, &poses[..10]));
        });
        group.finish();
    }
}

criterion_group!(benches, kinematics);
criterion_main!(benches);
