//! Torque along a path, as a law of the path's own speed and acceleration.

use super::model::{JointVector, Model};
use crate::pose::Vector;

/// `τ = a s̈ + b ṡ² + c` at one place of a path `q(s)`, one entry per joint; `s` may be any
/// parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Along {
    /// `a = M q′`.
    pub a: JointVector,
    /// `b = M q″ + C(q, q′) q′`.
    pub b: JointVector,
    /// `c = τ_g(q)`, gravity.
    pub c: JointVector,
}

impl Along {
    /// Torque of one joint at path speed `speed` and path acceleration `acceleration`.
    pub fn torque(&self, joint: usize, speed: f64, acceleration: f64) -> f64 {
        self.a[joint] * acceleration + self.b[joint] * speed * speed + self.c[joint]
    }
}

impl Model {
    /// Coefficients at a place of a path with `q`, `q′ = dq/ds`, `q″ = d²q/ds²`: three recursions.
    ///
    /// Law: `q̇ = q′ ṡ`, `q̈ = q′ s̈ + q″ ṡ²` put into the equation of motion, whose velocity term
    /// is quadratic (Bobrow, Dubowsky, Gibson 1985, "Time-optimal control of robotic manipulators
    /// along specified paths", eq. 5 to 8).
    pub fn along(&self, q: &[f64], dq: &[f64], ddq: &[f64]) -> Along {
        let (still, weightless) = (JointVector::zeros(self.dof), Vector::zeros());
        Along {
            a: self.recursion(q, &still, dq, weightless, None),
            b: self.recursion(q, dq, ddq, weightless, None),
            c: self.recursion(q, &still, &still, self.gravity, None),
        }
    }
}
