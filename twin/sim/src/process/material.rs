//! The printing material in SI, every number with its range.

use crate::interval::Interval;

use super::viscosity::CrossWlf;

/// A printing material; intervals hold what each number may be.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Its name.
    pub name: String,
    /// Density as printed and set, kg/m³.
    pub density_kg_m3: Interval,
    /// Young's modulus when set (for a photopolymer: green), Pa.
    pub youngs_modulus_pa: Interval,
    /// Poisson's ratio.
    pub poisson: Interval,
    /// Strength along the strand, Pa.
    pub strength_pa: Interval,
    /// Strength across a bond over strength along the strand.
    pub bond_fraction: Interval,
    /// Linear thermal expansion below the set temperature, 1/K.
    pub cte_per_k: Interval,
    /// Specific heat, J/(kg K).
    pub cp_j_kgk: Interval,
    /// Thermal conductivity, W/(m K).
    pub k_w_mk: Interval,
    /// Emissivity.
    pub emissivity: Interval,
    /// The law by which it sets.
    pub setting: Setting,
}

/// How a material sets.
#[derive(Debug, Clone, PartialEq)]
pub enum Setting {
    /// By cooling.
    Thermoplastic(Thermoplastic),
    /// By light.
    Photopolymer(Photopolymer),
    /// By the clock, from the mixer on.
    TwoPart(TwoPart),
}

/// What sets by cooling.
#[derive(Debug, Clone, PartialEq)]
pub struct Thermoplastic {
    /// Nozzle temperature, K. A set point: the laws use its nominal value, its range is a window.
    pub extrusion_k: Interval,
    /// Density of the melt, kg/m³.
    pub melt_density_kg_m3: Interval,
    /// Glass transition, K.
    pub glass_k: Interval,
    /// Below this the strand no longer flows, K; a label for the set time, sag uses the viscosity.
    pub flow_arrest_k: Interval,
    /// Zero-shear viscosity.
    pub viscosity: CrossWlf,
    /// Modulus of the rubbery plateau above the glass transition, Pa.
    pub plateau_modulus_pa: Interval,
}

/// What sets by light.
#[derive(Debug, Clone, PartialEq)]
pub struct Photopolymer {
    /// Density of the gel, kg/m³.
    pub gel_density_kg_m3: Interval,
    /// Viscosity of the resin without filler, Pa s; what is left once the yield stress is passed.
    pub base_viscosity_pa_s: Interval,
    /// Yield stress of the gel, Pa.
    pub yield_stress_pa: Interval,
    /// Penetration depth of the light, m.
    pub penetration_m: Interval,
    /// Critical exposure, J/m².
    pub critical_exposure_j_m2: Interval,
    /// Modulus just past the gel point, Pa.
    pub gel_modulus_pa: Interval,
    /// Modulus after post-cure, Pa.
    pub cured_modulus_pa: Interval,
    /// Linear shrinkage after the gel point.
    pub linear_shrinkage: Interval,
}

/// What sets by the clock.
#[derive(Debug, Clone, PartialEq)]
pub struct TwoPart {
    /// Time from nozzle to set, s.
    pub set_time_s: Interval,
    /// Viscosity as it leaves the nozzle, Pa s.
    pub viscosity_pa_s: Interval,
    /// Linear shrinkage after the gel point.
    pub linear_shrinkage: Interval,
}

impl Material {
    /// Density as it leaves the nozzle, kg/m³: the melt or the gel; two-part material is taken as set.
    pub fn fresh_density_kg_m3(&self) -> Interval {
        match &self.setting {
            Setting::Thermoplastic(plastic) => plastic.melt_density_kg_m3,
            Setting::Photopolymer(resin) => resin.gel_density_kg_m3,
            Setting::TwoPart(_) => self.density_kg_m3,
        }
    }
}
