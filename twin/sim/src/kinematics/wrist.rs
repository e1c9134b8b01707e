//! Two angle triples of a rotation about z, y, z.

use nalgebra::Matrix3;

use super::angle::{Angle, half_turn};
use super::arctangent::arctangent;

/// Below this sine the outer axes count as one line, rad; smaller than the tolerance on solutions.
const ALIGNED_RAD: f64 = 5e-10;

/// A rotation as turns about z, y, z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Zyz {
    /// Both `[a, b, c]`; `b ≥ 0` in the first, `b ≤ 0` in the second.
    pub(super) angles: [[f64; 3]; 2],
    /// `Rz(a) Ry(b) Rz(c)` is turned by no more than this against the rotation asked for, rad.
    pub(super) error_rad: f64,
}

/// Solves `Rz(a) Ry(b) Rz(c) = m`.
///
/// Where `b` is 0 or π only `a ± c` is fixed: then `a = free` (and half a turn further in the second).
/// `b` and `c` are taken from what `a` leaves over, so the product holds to rounding however
/// near that is. The error is the Frobenius norm of the difference of the two matrices, which is
/// √2 times the angle between two near rotations; it also tells where `m` is no rotation.
pub(super) fn zyz(m: &Matrix3<f64>, free: f64) -> Zyz {
    let (x, y) = (m[(0, 2)], m[(1, 2)]);
    let a = if x * x + y * y < ALIGNED_RAD * ALIGNED_RAD {
        Angle::of(free)
    } else {
        Angle::towards(y, x)
    };
    // What is left is Ry(b) Rz(c) = [cb cc, −cb sc, sb; sc, cc, 0; −sb cc, sb sc, cb].
    let rest = a.unturn_z(m);
    let (b, c) = (rotated(rest[(0, 2)], rest[(2, 2)]), rotated(rest[(1, 0)], rest[(1, 1)]));
    let (b_off, b) = b;
    let (c_off, c) = c;
    let squares = square(rest[(0, 0)] - b.cos * c.cos)
        + square(rest[(0, 1)] + b.cos * c.sin)
        + square(rest[(1, 2)])
        + square(rest[(2, 0)] + b.sin * c.cos)
        + square(rest[(2, 1)] - b.sin * c.sin);
    let second = [half_turn(a.rad), -b.rad, half_turn(c.rad)];
    let error_rad = squares.sqrt() + 2.0 * (b_off + c_off);
    Zyz { angles: [[a.rad, b.rad, c.rad], second], error_rad }
}

/// The angle, its sine and cosine as they come, and by how much these miss length one.
fn rotated(sin: f64, cos: f64) -> (f64, Angle) {
    let miss = (sin * sin + cos * cos - 1.0).abs();
    (miss, Angle { rad: arctangent(sin, cos), sin, cos })
}

fn square(x: f64) -> f64 {
    x * x
}
