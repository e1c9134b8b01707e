//! Frame of straight rods between knots: the brute force beside the law of knotted threads.

use std::f64::consts::PI;

use nalgebra::{DMatrix, Matrix3, SMatrix, Vector3};

use super::threads::Knotted;

pub(super) const YOUNGS_PA: f64 = 2e9;
pub(super) const POISSON: f64 = 0.35;

pub(super) type Twelve = SMatrix<f64, 12, 12>;

/// Stiffness of a straight round rod between two places, six freedoms each end, Euler and Bernoulli.
pub(super) fn rod(from: Vector3<f64>, to: Vector3<f64>, diameter: f64) -> Twelve {
    let l = (to - from).norm();
    let i = PI * diameter.powi(4) / 64.0;
    let (area, ei) = (PI * diameter.powi(2) / 4.0, YOUNGS_PA * i);
    let mut k = Twelve::zeros();
    let mut pair = |a: usize, b: usize, value: f64| {
        k[(a, b)] = value;
        k[(b, a)] = value;
    };
    for (axis, value) in [(0, YOUNGS_PA * area / l), (3, ei / (1.0 + POISSON) / l)] {
        pair(axis, axis, value);
        pair(axis + 6, axis + 6, value);
        pair(axis, axis + 6, -value);
    }
    for (w, turn, sign) in [(1, 5, 1.0), (2, 4, -1.0)] {
        pair(w, w, 12.0 * ei / l.powi(3));
        pair(w + 6, w + 6, 12.0 * ei / l.powi(3));
        pair(w, w + 6, -12.0 * ei / l.powi(3));
        for (at, sign) in [(turn, sign), (turn + 6, sign)] {
            pair(w, at, sign * 6.0 * ei / l.powi(2));
            pair(w + 6, at, -sign * 6.0 * ei / l.powi(2));
        }
        pair(turn, turn, 4.0 * ei / l);
        pair(turn + 6, turn + 6, 4.0 * ei / l);
        pair(turn, turn + 6, 2.0 * ei / l);
    }
    let x = (to - from) / l;
    let helper = if x.x.abs() < 0.8 { Vector3::x() } else { Vector3::y() };
    let y = x.cross(&helper).normalize();
    let local = Matrix3::from_rows(&[x.transpose(), y.transpose(), x.cross(&y).transpose()]);
    let mut turn = Twelve::zeros();
    for block in 0..4 {
        turn.fixed_view_mut::<3, 3>(3 * block, 3 * block).copy_from(&local);
    }
    turn.transpose() * k * turn
}

/// Motion of a place fixed to a knot from the knot's six: shift plus turn times arm.
fn carried(arm: Vector3<f64>) -> SMatrix<f64, 6, 6> {
    let mut carry = SMatrix::<f64, 6, 6>::identity();
    carry.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-arm.cross_matrix()));
    carry
}

/// Stiffness between the two knots of one pitch, all else solved for: core and threads of `count` straight
/// rods each, the first thread at an angle about the core.
pub(super) fn pitch(strand: &Knotted, count: usize, angle: f64) -> Twelve {
    let mut total = rod(Vector3::zeros(), Vector3::x() * strand.pitch_m, strand.core_m);
    for thread in 0..strand.count {
        let at = angle + 2.0 * PI * f64::from(thread) / f64::from(strand.count);
        let out = Vector3::new(0.0, at.cos(), at.sin());
        let place = |j: usize| {
            let share = j as f64 / count as f64;
            let r = strand.knot_offset_m + 0.5 * strand.sweep_m * (1.0 - (2.0 * PI * share).cos());
            Vector3::x() * (share * strand.pitch_m) + out * r
        };
        // Inner places first, the two ends last
        let row = |j: usize| {
            if j == 0 {
                count - 1
            } else if j == count {
                count
            } else {
                j - 1
            }
        };
        let mut k = DMatrix::<f64>::zeros(6 * (count + 1), 6 * (count + 1));
        for j in 0..count {
            let element = rod(place(j), place(j + 1), strand.thread_m);
            for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let mut block = k.view_mut((6 * row(j + a), 6 * row(j + b)), (6, 6));
                block += element.fixed_view::<6, 6>(6 * a, 6 * b);
            }
        }
        let inner = 6 * (count - 1);
        let solved = k.view((0, 0), (inner, inner)).into_owned().cholesky().unwrap();
        let across = k.view((0, inner), (inner, 12)).into_owned();
        let ends = k.view((inner, inner), (12, 12)) - across.transpose() * solved.solve(&across);
        let mut carry = Twelve::zeros();
        let arm = carried(out * strand.knot_offset_m);
        carry.fixed_view_mut::<6, 6>(0, 0).copy_from(&arm);
        carry.fixed_view_mut::<6, 6>(6, 6).copy_from(&arm);
        total += carry.transpose() * ends.fixed_view::<12, 12>(0, 0) * carry;
    }
    total
}
