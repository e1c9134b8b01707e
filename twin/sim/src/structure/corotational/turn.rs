//! Finite rotations: the rotation vector, its rate, and how a moment conjugate to it changes.

use nalgebra::Matrix3;

use crate::pose::Vector;

/// Below this angle, rad, the coefficients are taken as series: their closed forms cancel.
const SMALL_RAD: f64 = 0.5;

/// `S v = a × v`.
pub(super) fn spin(a: &Vector) -> Matrix3<f64> {
    a.cross_matrix()
}

/// Rotation vector of a rotation matrix, accurate to rounding for small ones; good below π.
pub(super) fn rotation_vector(rotation: &Matrix3<f64>) -> Vector {
    let axial = Vector::new(
        rotation[(2, 1)] - rotation[(1, 2)],
        rotation[(0, 2)] - rotation[(2, 0)],
        rotation[(1, 0)] - rotation[(0, 1)],
    ) * 0.5;
    let (sine, cosine) = (axial.norm(), 0.5 * (rotation.trace() - 1.0));
    if sine == 0.0 {
        return axial;
    }
    axial * (sine.atan2(cosine) / sine)
}

/// `η = (1 - θ/2 cot θ/2)/θ²` and `μ = η'/θ`, by the series of the cotangent
/// `1/12 + θ²/720 + θ⁴/30240 + …` where θ is small.
fn coefficients(angle: f64) -> (f64, f64) {
    let square = angle * angle;
    if angle < SMALL_RAD {
        // |B₂ₖ|/(2k)! for k = 1 to 7
        const TERMS: [f64; 7] = [
            1.0 / 12.0,
            1.0 / 720.0,
            1.0 / 30_240.0,
            1.0 / 1_209_600.0,
            1.0 / 47_900_160.0,
            691.0 / 1_307_674_368_000.0,
            1.0 / 74_724_249_600.0,
        ];
        let (mut eta, mut mu) = (0.0, 0.0);
        for (power, term) in TERMS.iter().enumerate().rev() {
            eta = eta * square + term;
            if power > 0 {
                mu = mu * square + 2.0 * power as f64 * term;
            }
        }
        return (eta, mu);
    }
    let half = 0.5 * angle;
    let eta = (1.0 - half / half.tan()) / square;
    let mu = (angle * (angle + angle.sin()) - 8.0 * half.sin().powi(2))
        / (4.0 * square * square * half.sin().powi(2));
    (eta, mu)
}

/// `T⁻¹ = I - θ̃/2 + η θ̃²`: how the rotation vector moves with a spin, `δθ = T⁻¹ δw`.
pub(super) fn rate_of_vector(theta: &Vector) -> Matrix3<f64> {
    let (eta, _) = coefficients(theta.norm());
    let spin = spin(theta);
    Matrix3::identity() - spin * 0.5 + spin * spin * eta
}

/// Derivative of `T⁻ᵀ m` by θ for a constant m:
/// `-m̃/2 + η ((θ·m) I + θ mᵀ - 2 m θᵀ) + μ θ̃² m θᵀ`.
pub(super) fn change_of_moment(theta: &Vector, moment: &Vector) -> Matrix3<f64> {
    let (eta, mu) = coefficients(theta.norm());
    let both = Matrix3::identity() * theta.dot(moment) + theta * moment.transpose()
        - moment * theta.transpose() * 2.0;
    let twice = theta.cross(&theta.cross(moment));
    both * eta + twice * theta.transpose() * mu - spin(moment) * 0.5
}
