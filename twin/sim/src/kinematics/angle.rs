//! An angle with its sine and cosine, so that no closed form asks for them twice.

use std::f64::consts::PI;

use nalgebra::Matrix3;

use super::arctangent::arctangent;

/// An angle, rad, in (−π, π] where it was made from sine and cosine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Angle {
    pub(super) rad: f64,
    pub(super) sin: f64,
    pub(super) cos: f64,
}

impl Angle {
    /// From the angle itself.
    pub(super) fn of(rad: f64) -> Self {
        let (sin, cos) = rad.sin_cos();
        Self { rad, sin, cos }
    }

    /// Direction of `(cos, sin)`, of any length; zero where both are.
    pub(super) fn towards(sin: f64, cos: f64) -> Self {
        Self::along(sin, cos, (sin * sin + cos * cos).sqrt())
    }

    /// Direction of `(cos, sin)`, whose length is known; zero where both are.
    #[inline]
    pub(super) fn along(sin: f64, cos: f64, length: f64) -> Self {
        let (sin, cos) = scaled(sin, cos, length);
        Self { rad: arctangent(sin, cos), sin, cos }
    }

    /// The other way round.
    pub(super) fn opposite(self) -> Self {
        Self { rad: -self.rad, sin: -self.sin, cos: self.cos }
    }

    /// Sum of both.
    pub(super) fn plus(&self, other: &Self) -> Self {
        Self {
            rad: self.rad + other.rad,
            sin: self.sin * other.cos + self.cos * other.sin,
            cos: self.cos * other.cos - self.sin * other.sin,
        }
    }

    /// `Rz(angle)ᵀ · m`.
    pub(super) fn unturn_z(&self, m: &Matrix3<f64>) -> Matrix3<f64> {
        let mut turned = *m;
        for column in 0..3 {
            let (x, y) = (m[(0, column)], m[(1, column)]);
            turned[(0, column)] = self.cos * x + self.sin * y;
            turned[(1, column)] = self.cos * y - self.sin * x;
        }
        turned
    }

    /// `Ry(angle)ᵀ · m`.
    pub(super) fn unturn_y(&self, m: &Matrix3<f64>) -> Matrix3<f64> {
        let mut turned = *m;
        for column in 0..3 {
            let (x, z) = (m[(0, column)], m[(2, column)]);
            turned[(0, column)] = self.cos * x - self.sin * z;
            turned[(2, column)] = self.cos * z + self.sin * x;
        }
        turned
    }
}

/// Sine and cosine brought to length one; `(0, 1)` where there is no direction.
pub(super) fn unit(sin: f64, cos: f64) -> (f64, f64) {
    scaled(sin, cos, (sin * sin + cos * cos).sqrt())
}

#[inline]
fn scaled(sin: f64, cos: f64, length: f64) -> (f64, f64) {
    let inverse = 1.0 / length;
    if length > 1e-100 { (sin * inverse, cos * inverse) } else { (0.0, 1.0) }
}

/// Half a turn further, kept within ±π where `angle` is.
pub(super) fn half_turn(angle: f64) -> f64 {
    if angle > 0.0 { angle - PI } else { angle + PI }
}
