//! How strongly a strand bonds to what it touches.

use std::f64::consts::PI;

use super::age_samples::{integral_above, time_above_s};

/// Gas constant, J/(mol K).
const GAS_J_MOL_K: f64 = 8.314_462_618;

/// Time in which a contact held at one temperature heals in full, by an Arrhenius law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WeldTime {
    /// `A`, s.
    pub prefactor_s: f64,
    /// `Q`, J/mol.
    pub activation_j_mol: f64,
}

impl WeldTime {
    /// `t_w = A exp(Q / (R T))`, s; infinite at and below zero kelvin.
    ///
    /// Source: process-physics.md section 5 (P400 ABS, from memory there).
    pub fn at_s(&self, temperature_k: f64) -> f64 {
        if temperature_k <= 0.0 {
            return f64::INFINITY;
        }
        self.prefactor_s * (self.activation_j_mol / (GAS_J_MOL_K * temperature_k)).exp()
    }
}

/// Weld time of a melt of which only the viscosity is known, s: the reptation time of Doi and Edwards,
/// `t = 12 η0 / (π² G)`.
///
/// Viscosity at no shear Pa s, shear modulus of the rubbery plateau Pa (a third of Young's). For chains of one
/// length; taking it for the weld time of a commercial grade is ours and unmeasured, good to a factor
/// of ten at best, which is 1.8 in the degree of healing.
pub fn reptation_time_s(viscosity_pa_s: f64, shear_plateau_pa: f64) -> f64 {
    12.0 * viscosity_pa_s / (PI * PI * shear_plateau_pa)
}

/// Degree of healing of a contact, 0 to 1: `D_h = [∫ dt / t_w(T)]^¼`, at most one.
///
/// Temperature of the contact as samples `(age s, K)`, straight between them; `weld_time_s` gives `t_w` in s
/// at a temperature in K. Only time above the glass transition counts. Error second order in the
/// spacing of the samples. Full contact from the start is assumed: the neck has grown or was
/// pressed (`contact`). Wool–O'Connor, Yang–Pitchumani; process-physics.md section 5. Cost `O(n)`, about
/// 12 µs for a hundred samples.
pub fn healing_degree(
    samples: &[(f64, f64)],
    glass_k: f64,
    weld_time_s: impl Fn(f64) -> f64,
) -> f64 {
    let share = integral_above(samples, glass_k, |kelvin| 1.0 / weld_time_s(kelvin));
    share.max(0.0).sqrt().sqrt().min(1.0)
}

/// What keeps a bond from being whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BondLimit {
    /// Nothing: it is as strong as the bulk.
    Nothing,
    /// The contact was never above the glass transition.
    Cold,
    /// It was, and cooled before it had healed.
    Time,
    /// What it was laid on had reacted too far.
    Reacted,
}

/// A bond between a strand and what it touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bond {
    /// Strength over that of the bulk, 0 to 1.
    pub degree: f64,
    /// What keeps it from one.
    pub limited_by: BondLimit,
}

/// Bond of a thermoplastic from the temperature of the contact; see [`healing_degree`].
///
/// A node touched in free air (ABS 240 °C on a strut at 22 °C, interface 131 °C) comes out at 0.12 with the weld time of
/// P400 and 0.29 by reptation, PLA at 0.34; the reference expects 0.4–0.6 and 0.6–0.8 without measurement. A wait or a
/// strut still warm raises it (strut at 60 °C: 0.44). Nothing is tuned to close the gap.
pub fn thermoplastic_bond(
    samples: &[(f64, f64)],
    glass_k: f64,
    weld_time_s: impl Fn(f64) -> f64,
) -> Bond {
    let degree = healing_degree(samples, glass_k, weld_time_s);
    let limited_by = if degree >= 1.0 {
        BondLimit::Nothing
    } else if time_above_s(samples, glass_k) > 0.0 {
        BondLimit::Time
    } else {
        BondLimit::Cold
    };
    Bond { degree, limited_by }
}

/// Bond of a photopolymer to what was cured to a degree before: `sites + (1 − sites) tacky`,
/// `sites = 1 − α/α_max`.
///
/// What has not reacted cross-links with the new strand; the rest holds by the layer that oxygen keeps tacky,
/// `tacky`, a number of the material (0.9, 0.7 to 1.0: expected by Kirkman, not measured). That the two
/// add so is ours. Source: process-physics.md section 5. All dimensionless, clamped to 0 to 1.
pub fn photopolymer_bond(substrate_cure: f64, full_cure: f64, tacky: f64) -> Bond {
    reacted_bond(substrate_cure / full_cure, tacky)
}

/// Bond of a two-part mix to a strand of an age, s: as [`photopolymer_bond`], the reaction taken as a
/// straight line from nothing at the mixer to all at `done_s`.
pub fn two_part_bond(substrate_age_s: f64, done_s: f64, tacky: f64) -> Bond {
    reacted_bond(substrate_age_s / done_s, tacky)
}

/// A share that is not a number counts as all reacted.
fn reacted_bond(reacted: f64, tacky: f64) -> Bond {
    let share = |x: f64| if x > 0.0 { x.min(1.0) } else { 0.0 };
    let sites = share(1.0 - reacted);
    let degree = share(sites + (1.0 - sites) * tacky);
    let limited_by = if degree >= 1.0 { BondLimit::Nothing } else { BondLimit::Reacted };
    Bond { degree, limited_by }
}

/// Force a printed joint bears, N: `min(axial, σ_bulk A_contact D_h)`.
///
/// Axial strength of the strand N, bulk strength Pa, contact area m² (`contact::contact_area_m2`), degree of
/// bond. Notches, peel and residual stress are left out, so it is an upper bound.
/// Source: process-physics.md section 5.
pub fn joint_strength_n(axial_n: f64, bulk_pa: f64, contact_m2: f64, degree: f64) -> f64 {
    axial_n.min(bulk_pa * contact_m2 * degree)
}

#[cfg(test)]
mod tests;
