//! A strand's temperature and stiffness against its age.

use crate::interval::Interval;

use super::clock::{Clock, age_at_nozzle_s};
use super::cure::{gel_time_s, modulus_at_dose_pa};
use super::heat::modulus_through_glass_pa;
use super::material::{Material, Photopolymer, Setting, TwoPart};
use super::strand::StrandInput;
use super::thermal::{Heat, heat};

/// Which end of the uncertain inputs: the middle, what makes a strand set fast and sag little, or the
/// opposite.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Corner {
    /// Nominal values.
    Nominal,
    /// What sets fast.
    Fast,
    /// What sets slowly.
    Slow,
}

impl Corner {
    /// The end of an interval that holds for a quantity that makes a strand stiffer the greater it is.
    pub fn helpful(self, quantity: Interval) -> f64 {
        match self {
            Self::Nominal => quantity.nominal,
            Self::Fast => quantity.high,
            Self::Slow => quantity.low,
        }
    }

    /// The same for a quantity that makes it softer or heavier the greater it is.
    pub fn harmful(self, quantity: Interval) -> f64 {
        match self {
            Self::Nominal => quantity.nominal,
            Self::Fast => quantity.low,
            Self::Slow => quantity.high,
        }
    }

    /// A law on all three corners, as an interval.
    pub fn interval(law: impl Fn(Self) -> f64) -> Interval {
        Interval::new(law(Self::Nominal), law(Self::Fast), law(Self::Slow))
    }
}

/// Age at which light sets a strand at a corner, s: shadow, then `Ec / I`; infinite without light enough.
///
/// Corners: lamp intensity and critical exposure. A strand whose whole passage gives less than `Ec` never sets.
pub fn light_set_s(input: &StrandInput, resin: &Photopolymer, corner: Corner) -> f64 {
    let Some(ring) = input.light else { return f64::INFINITY };
    let irradiance = ring.irradiance_w_m2(corner.helpful(ring.intensity_w_sr));
    let gel_s = gel_time_s(corner.harmful(resin.critical_exposure_j_m2), irradiance);
    if gel_s * input.speed_m_s <= ring.lit_length_m() {
        ring.shadow_m / input.speed_m_s + gel_s
    } else {
        f64::INFINITY
    }
}

/// Age at which a two-part strand sets at a corner, s.
///
/// Where the material gives activation energy and reference temperature, its set time counts from the mixer: what it
/// spent there, `V/Q` in plug flow, is taken off, and both mixer and strand are as warm as the air
/// ([`Clock::set_after_nozzle_s`]; the air for the mixer is ours, heat of cure is left out). Zero where it sets in
/// the mixer. Else the set time is that after the nozzle, as it was seen, whatever mixer and air. Corners: set time, and
/// the end of the activation energy that is the slower in this air.
pub fn clock_set_s(input: &StrandInput, mix: &TwoPart, corner: Corner) -> f64 {
    let set_time_s = corner.harmful(mix.set_time_s);
    let (Some(activation), Some(reference_k)) = (mix.activation_j_mol, mix.reference_k) else {
        return set_time_s;
    };
    let residence_s =
        if input.mixer_m3 > 0.0 { age_at_nozzle_s(input.mixer_m3, input.flow_m3_s) } else { 0.0 };
    let air_k = input.air.temperature_k;
    let set_s = |activation_j_mol: f64| {
        // The pot life plays no part in this.
        let clock = Clock { set_time_s, pot_life_s: f64::NAN, activation_j_mol, reference_k };
        clock.set_after_nozzle_s(residence_s, air_k, air_k)
    };
    corner.harmful(activation.map(set_s))
}

/// A strand's nominal temperature and modulus against its age.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    air_k: f64,
    law: Law,
}

#[derive(Debug, Clone, PartialEq)]
enum Law {
    Heat { heat: Heat, glassy_pa: f64, plateau_pa: f64, glass_k: f64 },
    Light { shadow_s: f64, lit_s: f64, irradiance: f64, critical: f64, gel_pa: f64, set_pa: f64 },
    Clock { set_s: f64, set_pa: f64 },
}

impl History {
    /// The history of a strand, at nominal values.
    pub fn new(input: &StrandInput, material: &Material) -> Self {
        let set_pa = material.youngs_modulus_pa.nominal;
        let law = match &material.setting {
            Setting::Thermoplastic(plastic) => Law::Heat {
                heat: heat(input, material, plastic, Corner::Nominal),
                glassy_pa: set_pa,
                plateau_pa: plastic.plateau_modulus_pa.nominal,
                glass_k: plastic.glass_k.nominal,
            },
            Setting::Photopolymer(resin) => {
                let ring = input.light.as_ref();
                Law::Light {
                    shadow_s: ring.map_or(0.0, |r| r.shadow_m) / input.speed_m_s,
                    lit_s: ring.map_or(0.0, |r| r.lit_length_m()) / input.speed_m_s,
                    irradiance: ring.map_or(0.0, |r| r.irradiance_w_m2(r.intensity_w_sr.nominal)),
                    critical: resin.critical_exposure_j_m2.nominal,
                    gel_pa: resin.gel_modulus_pa.nominal,
                    set_pa,
                }
            }
            Setting::TwoPart(mix) => {
                Law::Clock { set_s: clock_set_s(input, mix, Corner::Nominal), set_pa }
            }
        };
        Self { air_k: input.air.temperature_k, law }
    }

    /// Mean temperature of a section at an age, K; resins are taken at air temperature (their heat of
    /// reaction is left out).
    pub fn temperature_k(&self, age_s: f64) -> f64 {
        match &self.law {
            Law::Heat { heat, .. } => heat.temperature_k(age_s),
            Law::Light { .. } | Law::Clock { .. } => self.air_k,
        }
    }

    /// Temperature on the axis at an age, K; `None` but of a thermoplastic.
    pub fn core_k(&self, age_s: f64) -> Option<f64> {
        match &self.law {
            Law::Heat { heat, .. } => Some(heat.core_k(age_s)),
            Law::Light { .. } | Law::Clock { .. } => None,
        }
    }

    /// Young's modulus at an age, Pa, of what is solid; zero where nothing is.
    ///
    /// Thermoplastic: through the glass transition to the rubbery plateau, never zero. Photopolymer: by
    /// dose from the gel point on, of the surface. Two-part: all at the set time.
    pub fn modulus_pa(&self, age_s: f64) -> f64 {
        match self.law {
            Law::Heat { ref heat, glassy_pa, plateau_pa, glass_k } => {
                modulus_through_glass_pa(glassy_pa, plateau_pa, heat.temperature_k(age_s), glass_k)
            }
            Law::Light { shadow_s, lit_s, irradiance, critical, gel_pa, set_pa } => {
                let dose = irradiance * (age_s - shadow_s).max(0.0).min(lit_s);
                modulus_at_dose_pa(gel_pa, set_pa, dose, critical, irradiance * lit_s)
            }
            Law::Clock { set_s, set_pa } => {
                if age_s < set_s {
                    0.0
                } else {
                    set_pa
                }
            }
        }
    }
}
