//! What a part that moves feels: a force per mass that is linear in place and in twelve numbers.

use crate::pose::Vector;
use crate::structure::beam::{Beam, Vector12};

/// Unit cases: the specific force at the origin, angular acceleration, products of turning speeds.
pub(crate) const UNITS: usize = 12;

/// The pairs of axes of the last six.
const PRODUCTS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];

/// How a part moves at an instant, in its own axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ridden {
    /// Gravity less the acceleration of the origin of the part's axes, `g - a₀`, m/s².
    pub specific_m_s2: Vector,
    /// Angular acceleration α, rad/s².
    pub alpha_rad_s2: Vector,
    /// Turning speed ω, rad/s.
    pub omega_rad_s: Vector,
}

impl Ridden {
    /// At rest.
    pub fn at_rest(gravity_m_s2: Vector) -> Self {
        let zero = Vector::zeros();
        Self { specific_m_s2: gravity_m_s2, alpha_rad_s2: zero, omega_rad_s: zero }
    }

    /// Force per mass at a place of the part (from the origin), m/s²:
    /// `g - a₀ - α × x - ω × (ω × x)`.
    pub fn at_m_s2(&self, x: &Vector) -> Vector {
        let omega = &self.omega_rad_s;
        self.specific_m_s2 - self.alpha_rad_s2.cross(x) - omega.cross(&omega.cross(x))
    }

    /// The factors on the unit cases: `g - a₀`, α, and `ωx², ωy², ωz², ωxωy, ωxωz, ωyωz`.
    pub fn numbers(&self) -> [f64; UNITS] {
        std::array::from_fn(|unit| match unit {
            0..3 => self.specific_m_s2[unit],
            3..6 => self.alpha_rad_s2[unit - 3],
            _ => {
                let [i, j] = PRODUCTS[unit - 6];
                self.omega_rad_s[i] * self.omega_rad_s[j]
            }
        })
    }
}

/// Force per mass of a unit case at a place.
///
/// `-ω × (ω × x) = ω² x - ω (ω·x)`: a square of ωᵢ throws away from axis i, `x - eᵢ xᵢ`; a
/// product ωᵢ ωⱼ of two gives `-(eᵢ xⱼ + eⱼ xᵢ)`.
pub(crate) fn unit_at(unit: usize, x: &Vector) -> Vector {
    let axis = |k: usize| Vector::ith(k, 1.0);
    match unit {
        0..3 => axis(unit),
        3..6 => x.cross(&axis(unit - 3)),
        _ => match PRODUCTS[unit - 6] {
            [i, j] if i == j => x - axis(i) * x[i],
            [i, j] => -(axis(i) * x[j] + axis(j) * x[i]),
        },
    }
}

/// Loads at the ends of a member that do what a line load does, which goes straight from `lines[0]`
/// N/m at the first end to `lines[1]` at the second: exact displacements of the nodes.
///
/// The mean w acts as weight does. The half difference d (`d (2s/L - 1)`) gives, from the beam held
/// at both ends, with `φ = 12 E I/(κ G A L²)` of the plane it bends in,
///
/// ```text
/// along    F₂ = d L/6                      F₁ = -F₂
/// across   F₂ = d L (6+5φ)/(30 (1+φ))      F₁ = -F₂     M₁ = M₂ = -x × d L²/(60 (1+φ))
/// ```
///
/// that is `d L/5` and `d L²/60` without shear. Ours, by unit forces on half of the beam (the middle
/// neither moves nor bends); with φ = 0 the handbook's `L (3 w₁ + 7 w₂)/20`, `L² (2 w₁ + 3 w₂)/60`.
pub(crate) fn line_ends(beam: &Beam, lines: &[Vector; 2]) -> Vector12 {
    let length_m = beam.length_m;
    let mut load = beam.line_ends((lines[0] + lines[1]) * 0.5);
    let half = (lines[1] - lines[0]) * 0.5;
    let x = beam.axes.column(0).into_owned();
    let mut force = x * (x.dot(&half) * length_m / 6.0);
    let mut moment = Vector::zeros();
    for (axis, phi) in [(1, beam.shear_share[0]), (2, beam.shear_share[1])] {
        let across = beam.axes.column(axis).into_owned();
        let across = across * across.dot(&half);
        force += across * (length_m * (6.0 + 5.0 * phi) / (30.0 * (1.0 + phi)));
        moment -= x.cross(&across) * (length_m * length_m / (60.0 * (1.0 + phi)));
    }
    for axis in 0..3 {
        load[axis] -= force[axis];
        load[3 + axis] += moment[axis];
        load[6 + axis] += force[axis];
        load[9 + axis] += moment[axis];
    }
    load
}
