//! How much a strand still wants to shorten.

use super::heat::Cooling;
use super::material::{Material, Setting};
use crate::interval::Interval;

/// Shortening still to come when the nozzle leaves a free end, by cooling, m.
///
/// `δ = α ∫₀ᴸ [min(T(a), T_set) − T∞] ds`, age `a = (L − s)/v + dwell`: above `T_set` the strand is fed, not
/// strained. Closed form in the pieces of [`Cooling`]. Expansion `α` 1/K, length m, speed m/s, dwell s.
/// Zero where the air is warmer than the set temperature. Case ENDPOINT-ABS.
pub fn cooling_end_miss_m(
    expansion_per_k: f64,
    set_k: f64,
    cooling: &Cooling,
    length_m: f64,
    speed_m_s: f64,
    dwell_s: f64,
) -> f64 {
    let above_air_k = set_k.min(cooling.start_k) - cooling.air_k;
    if above_air_k <= 0.0 {
        return 0.0;
    }
    let (from_s, to_s) = (dwell_s, dwell_s + length_m / speed_m_s);
    let set_s = cooling.time_to_s(set_k).max(from_s).min(to_s);
    let excess_k_s = above_air_k * (set_s - from_s) + cooling.excess_k_s(set_s, to_s);
    expansion_per_k * speed_m_s * excess_k_s
}

/// How the shrinkage of a curing strand runs off behind the nozzle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CureRun {
    /// Linear shrinkage after the gel point.
    pub strain: f64,
    /// Length behind the nozzle where nothing happens, m.
    pub shadow_m: f64,
    /// Time past the shadow at which it gels, s.
    pub gel_s: f64,
    /// Time past the shadow at which it has shrunk, s.
    pub done_s: f64,
}

impl CureRun {
    /// Share of the shrinkage still to come at a time past the shadow: one up to the gel point, then a
    /// straight line to zero at the end. The line is an assumption, unmeasured.
    pub fn remaining(&self, lit_s: f64) -> f64 {
        if lit_s <= self.gel_s {
            return 1.0;
        }
        ((self.done_s - lit_s) / (self.done_s - self.gel_s)).max(0.0)
    }

    /// Shortening still to come when the nozzle leaves a free end, m.
    ///
    /// `δ = ε ∫₀ᴸ r dξ`: what has not gelled is fed by the nozzle while it is there and shrinks in full after
    /// it; what has gelled has the rest of its line to go; a dwell moves everything past the shadow on,
    /// and leaves what stands in the shadow. Dark cure and the heat of reaction are left out.
    pub fn end_miss_m(&self, length_m: f64, speed_m_s: f64, dwell_s: f64) -> f64 {
        let shadowed_m = self.shadow_m.min(length_m);
        let to_s = dwell_s + (length_m - shadowed_m) / speed_m_s;
        let gel_s = self.gel_s.max(dwell_s).min(to_s);
        let done_s = self.done_s.max(self.gel_s).max(dwell_s).min(to_s);
        let line_s = if done_s > gel_s {
            0.5 * (self.remaining(gel_s) + self.remaining(done_s)) * (done_s - gel_s)
        } else {
            0.0
        };
        self.strain * (shadowed_m + speed_m_s * (gel_s - dwell_s + line_s))
    }
}

/// Linear strain a free strand loses from its set point to the temperature of the air; positive is shorter.
///
/// Thermoplastic: `α (T_g − T∞)`, zero in warmer air; `α` is the material's one number, which understates
/// the step just below the glass transition (ABS: 118e-6 against 88e-6 1/K). Photopolymer and two-part:
/// the linear shrinkage after the gel point. Source: process-physics.md section 2.6.
pub fn free_strain(material: &Material, air_k: f64) -> Interval {
    let strain = |expansion: f64, glass_k: f64| expansion * (glass_k - air_k).max(0.0);
    match &material.setting {
        Setting::Thermoplastic(plastic) => {
            let (cte, glass) = (material.cte_per_k, plastic.glass_k);
            Interval::new(
                strain(cte.nominal, glass.nominal),
                strain(cte.low, glass.low),
                strain(cte.high, glass.high),
            )
        }
        Setting::Photopolymer(resin) => resin.linear_shrinkage,
        Setting::TwoPart(mix) => mix.linear_shrinkage,
    }
}
