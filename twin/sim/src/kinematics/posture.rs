//! A joint vector without heap, and its copies a full turn away.

use std::f64::consts::TAU;
use std::ops::{Deref, DerefMut};

use super::chain::Chain;

/// Most free joints that inverse kinematics takes.
pub const MAX_DOF: usize = 8;

/// How far past a limit rounding may put a solution; it is then set on the limit.
const LIMIT_SLACK: f64 = 1e-10;

/// Joint vector `q` of at most [`MAX_DOF`] entries, rad or m; reads as a slice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Posture {
    values: [f64; MAX_DOF],
    dof: usize,
}

impl Posture {
    /// From a slice; entries past [`MAX_DOF`] are cut off, and [`super::recognise`] sees to it that
    /// there are none.
    pub fn new(q: &[f64]) -> Self {
        let dof = q.len().min(MAX_DOF);
        let mut values = [0.0; MAX_DOF];
        values[..dof].copy_from_slice(&q[..dof]);
        Self { values, dof }
    }

    /// All joints at zero.
    pub fn zeros(dof: usize) -> Self {
        Self { values: [0.0; MAX_DOF], dof: dof.min(MAX_DOF) }
    }

    /// Greatest difference of an entry, rad or m.
    pub fn distance(&self, other: &[f64]) -> f64 {
        self.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }
}

impl Deref for Posture {
    type Target = [f64];
    fn deref(&self) -> &[f64] {
        &self.values[..self.dof]
    }
}

impl DerefMut for Posture {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.values[..self.dof]
    }
}

/// Calls `each` with every copy of `q` within limits that differs by full turns of its periodic
/// joints only, `q` itself included where it is within; none where some joint cannot be brought
/// within its limits.
///
/// A joint with an open end has endless copies: only the one nearest to `near` (else to zero)
/// is given for it.
pub fn wraps(chain: &Chain, q: &[f64], near: Option<&[f64]>, mut each: impl FnMut(Posture)) {
    let mut base = Posture::new(q);
    let mut turns = [0_u32; MAX_DOF];
    for (index, axis) in chain.axes().iter().enumerate().take(base.len()) {
        let (lower, upper) = (axis.lower - LIMIT_SLACK, axis.upper + LIMIT_SLACK);
        if axis.periodic && lower.is_finite() && upper.is_finite() {
            let first = ((lower - base[index]) / TAU).ceil();
            let last = ((upper - base[index]) / TAU).floor();
            if !(last >= first) {
                return;
            }
            base[index] += first * TAU;
            // More than a thousand turns each way is a limit that means nothing.
            turns[index] = (last - first).min(2000.0) as u32;
        } else if axis.periodic {
            let wanted = near.and_then(|seed| seed.get(index).copied()).unwrap_or(0.0);
            base[index] += ((wanted - base[index]) / TAU).round() * TAU;
            if lower.is_finite() && base[index] < lower {
                base[index] += ((lower - base[index]) / TAU).ceil() * TAU;
            }
            if upper.is_finite() && base[index] > upper {
                base[index] -= ((base[index] - upper) / TAU).ceil() * TAU;
            }
        } else if !(base[index] >= lower && base[index] <= upper) {
            return;
        }
    }
    let mut counts = [0_u32; MAX_DOF];
    loop {
        let mut copy = base;
        for (index, axis) in chain.axes().iter().enumerate().take(base.len()) {
            let value = base[index] + f64::from(counts[index]) * TAU;
            copy[index] = value.max(axis.lower).min(axis.upper);
        }
        each(copy);
        // Counts up like an odometer.
        let Some(index) = (0..base.len()).find(|&index| counts[index] < turns[index]) else {
            return;
        };
        counts[..index].fill(0);
        counts[index] += 1;
    }
}
