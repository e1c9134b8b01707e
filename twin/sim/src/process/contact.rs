//! Where two strands touch: how warm the contact is, and how large.

use std::f64::consts::{FRAC_PI_2, PI};

use super::age_samples::integral_above;

/// Thermal effusivity, W s^½/(m² K): `e = √(k ρ cp)`.
pub fn effusivity(conductivity_w_mk: f64, density_kg_m3: f64, cp_j_kgk: f64) -> f64 {
    (conductivity_w_mk * density_kg_m3 * cp_j_kgk).sqrt()
}

/// Temperature where two bodies touch, K: `(e1 T1 + e2 T2) / (e1 + e2)`, effusivities of any one unit.
///
/// Exact for two half-spaces without resistance between them, constant in time; the mean for one
/// material. Heat of the nozzle itself is left out. Source: process-physics.md section 5.
pub fn interface_k(e1: f64, t1_k: f64, e2: f64, t2_k: f64) -> f64 {
    (e1 * t1_k + e2 * t2_k) / (e1 + e2)
}

/// Time for which the contact does not yet feel that the strands are thin, s: `R² / (16 α)`.
///
/// A front of cold reaches the depth `4 √(α t)` (one part in a hundred of the step) in a time `t`; the depth is the
/// radius. Diameter m, diffusivity m²/s. That depth is ours: the rim of the contact feels the air
/// sooner, its middle as late as `D² / (16 α)`.
pub fn front_s(diameter_m: f64, diffusivity_m2_s: f64) -> f64 {
    diameter_m * diameter_m / (64.0 * diffusivity_m2_s)
}

/// Temperature of a contact against the time since it was made: held, then cooling as the strand does.
///
/// `T = T_i` up to `hold_s`, then `T = T∞ + (T_i − T∞) exp(−r (t − hold))`. Assumed: half-spaces up to
/// [`front_s`] (and as long as the nozzle stands there and feeds hot melt, so add the dwell); after it the pair
/// of strands cools at the rate `r` of one of them (`heat::cooling_rate_per_s`); no heat flows off along the
/// strut, no heat comes from the nozzle. The first errs to the warm side, the second to the cold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Temperature at first, K ([`interface_k`]).
    pub interface_k: f64,
    /// Temperature of the air, K.
    pub air_k: f64,
    /// Time for which it holds, s.
    pub hold_s: f64,
    /// Rate of cooling after it, 1/s.
    pub rate_per_s: f64,
}

impl Contact {
    /// Temperature at a time, K.
    pub fn temperature_k(&self, time_s: f64) -> f64 {
        let cooling_s = (time_s - self.hold_s).max(0.0);
        self.air_k + (self.interface_k - self.air_k) * (-self.rate_per_s * cooling_s).exp()
    }

    /// The same as samples `(s, K)` until it has cooled to `until_k` or `longest_s` has passed, whichever is first; what
    /// `healing::healing_degree` takes. At equal steps of temperature, `count` of them (2 to 10 000).
    pub fn samples(&self, until_k: f64, longest_s: f64, count: usize) -> Vec<(f64, f64)> {
        let count = count.clamp(2, 10_000);
        let hold_s = self.hold_s.max(0.0).min(longest_s);
        let (excess_k, left_k) = (self.interface_k - self.air_k, until_k - self.air_k);
        let least_k = excess_k * (-self.rate_per_s * (longest_s - hold_s)).exp();
        let last_k = left_k.max(least_k);
        let mut samples = vec![(0.0, self.interface_k), (hold_s, self.interface_k)];
        if !(last_k < excess_k) {
            // It does not cool, by rate or by air: it holds.
            if excess_k > left_k {
                samples.push((longest_s, self.interface_k));
            }
            return samples;
        }
        samples.extend((1..=count).map(|i| {
            let now_k = excess_k + (last_k - excess_k) * i as f64 / count as f64;
            (hold_s + (excess_k / now_k).ln() / self.rate_per_s, self.air_k + now_k)
        }));
        samples
    }
}

/// Angle θ of the neck between two beads that flow together, rad, 0 to π/2: Frenkel–Pokluda.
///
/// ```text
/// dθ/dt = Γ/(a0 η) 2^(−5/3) cos θ sin θ (2 − cos θ)^⅓ / [(1 − cos θ)(1 + cos θ)^⅓]
/// ```
///
/// Temperature of the contact as samples `(s, K)`, radius of the beads m, surface tension N/m,
/// `viscosity_pa_s` at a temperature in K (infinite: nothing flows). Temperature enters by `Γ/(a0 η)` alone, so
/// the law is solved for `∫ Γ/(a0 η) dt`: RK4 in `θ²`, whose slope starts at one
/// (`θ² = Γ t/(a0 η)` at first), 24 steps, within 1e-6 rad, about 15 µs. Derived for spheres, used for beads as Bellehumeur does; elasticity
/// and gravity are left out. Source: process-physics.md section 5 (from memory there).
pub fn neck_angle_rad(
    samples: &[(f64, f64)],
    radius_m: f64,
    surface_tension_n_m: f64,
    viscosity_pa_s: impl Fn(f64) -> f64,
) -> f64 {
    let pull_pa = surface_tension_n_m / radius_m;
    let flow = integral_above(samples, 0.0, |kelvin| pull_pa / viscosity_pa_s(kelvin));
    neck_angle_after_rad(flow, 24)
}

/// Past this much flow the angle is π/2 within 1e-9.
const FLOWN: f64 = 60.0;

/// Angle of the neck after a flow `∫ Γ/(a0 η) dt` (a number), rad; RK4, at most 100 000 steps.
pub fn neck_angle_after_rad(flow: f64, steps: usize) -> f64 {
    if !(flow > 0.0) {
        return 0.0;
    }
    let steps = steps.clamp(1, 100_000);
    let step = flow.min(FLOWN) / steps as f64;
    let mut square: f64 = 0.0;
    for _ in 0..steps {
        let k1 = neck_slope(square);
        let k2 = neck_slope(square + 0.5 * step * k1);
        let k3 = neck_slope(square + 0.5 * step * k2);
        let k4 = neck_slope(square + step * k3);
        square += step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    square.sqrt().min(FRAC_PI_2)
}

/// `d(θ²)/ds` of the law, `s` the flow; one where the neck begins.
fn neck_slope(square: f64) -> f64 {
    let angle = square.max(0.0).sqrt();
    if angle >= FRAC_PI_2 {
        return 0.0;
    }
    let cos = angle.cos();
    // θ sin θ / (1 − cos θ) = θ / tan(θ/2), which is two where the neck begins.
    let ratio = if angle > 0.0 { angle / (0.5 * angle).tan() } else { 2.0 };
    ratio * cos * (0.25 * (2.0 - cos) / (1.0 + cos)).cbrt()
}

/// Half-width of the neck, m: `a sin θ`, the radius grown as the beads become one,
/// `a = a0 {4 / [(1 + cos θ)² (2 − cos θ)]}^⅓`.
///
/// The growth is that of two spheres of unchanged volume, as the law of the angle is.
pub fn neck_half_width_m(radius_m: f64, angle_rad: f64) -> f64 {
    let (sin, cos) = angle_rad.clamp(0.0, FRAC_PI_2).sin_cos();
    let grown = (4.0 / ((1.0 + cos).powi(2) * (2.0 - cos))).cbrt();
    radius_m * grown * sin
}

/// Half-width of the flat between two round beads pressed together, m: `√(R² − (c/2)²)`.
///
/// `c` distance between their axes; zero where they do not reach each other. What is pushed aside is not
/// added at the rim, so it is low.
pub fn pressed_half_width_m(diameter_m: f64, axes_m: f64) -> f64 {
    let (radius, half) = (0.5 * diameter_m, 0.5 * axes_m.max(0.0));
    ((radius - half) * (radius + half)).max(0.0).sqrt()
}

/// How two strands lie on each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Touch {
    /// Their axes cross at an angle, rad.
    Crossing(f64),
    /// Side by side over a length, m.
    Alongside(f64),
}

/// Area of contact of two round beads of one diameter, m², from the half-width `b` of the neck or flat that they
/// would have side by side.
///
/// Side by side over `l`: `2 b l`. Crossing at φ: `2π b² / sin φ`, the ellipse on which the same gap closes
/// (crossed cylinders: gap `x²/R sin²(φ/2) + y²/R cos²(φ/2)`), at most the rhombus `D² / sin φ` in which the
/// beads lie over each other. For `b` well below the radius; infinite for parallel axes said to cross: that is
/// [`Touch::Alongside`].
pub fn contact_area_m2(diameter_m: f64, half_width_m: f64, touch: Touch) -> f64 {
    let half_m = half_width_m.max(0.0);
    match touch {
        Touch::Alongside(length_m) => 2.0 * half_m * length_m.max(0.0),
        Touch::Crossing(angle_rad) => {
            (2.0 * PI * half_m * half_m).min(diameter_m * diameter_m) / angle_rad.sin().abs()
        }
    }
}

#[cfg(test)]
mod tests;
