//! A joint vector without heap.

use std::ops::{Deref, DerefMut};

/// Most free joints that inverse kinematics takes.
pub const MAX_DOF: usize = 8;

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

    /// The posture at `share` of the way to another, all joints moving evenly; at 1 exactly that one.
    #[must_use]
    pub fn toward(&self, to: &[f64], share: f64) -> Self {
        let mut q = *self;
        for (value, target) in q.iter_mut().zip(to) {
            *value = if share == 1.0 { *target } else { *value + (target - *value) * share };
        }
        q
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
