//! Two angles triples of a rotation about z, y, z.

use std::f64::consts::PI;

use nalgebra::Matrix3;

/// Below this sine the outer axes count as one line, rad; smaller than the tolerance on solutions.
const ALIGNED_RAD: f64 = 5e-10;

/// Both `[a, b, c]` with `Rz(a) Ry(b) Rz(c) = m`; `b ≥ 0` in the first, `b ≤ 0` in the second.
///
/// Where `b` is 0 or π only `a ± c` is fixed: then `a = free` (and `free + π` in the second).
/// `b` and `c` are taken from what `a` leaves over, so the product holds to rounding however
/// near that is.
pub(super) fn zyz(m: &Matrix3<f64>, free: f64) -> [[f64; 3]; 2] {
    let aligned = m[(0, 2)].hypot(m[(1, 2)]) < ALIGNED_RAD;
    let first = if aligned { free } else { m[(1, 2)].atan2(m[(0, 2)]) };
    [first, first + PI].map(|a| {
        let (sin, cos) = a.sin_cos();
        let b = (cos * m[(0, 2)] + sin * m[(1, 2)]).atan2(m[(2, 2)]);
        let c = (cos * m[(1, 0)] - sin * m[(0, 0)]).atan2(cos * m[(1, 1)] - sin * m[(0, 1)]);
        [a, b, c]
    })
}
