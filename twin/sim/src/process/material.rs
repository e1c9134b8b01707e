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
    /// Specific heat and conductivity against temperature; `None`: one number each.
    pub heat: Option<HeatLaw>,
    /// Density against temperature.
    pub tait: Option<TaitLaw>,
    /// Time in which a weld heals; `None`: nobody knows.
    pub weld: Option<WeldLaw>,
    /// Surface tension of the melt, N/m.
    pub surface_tension_n_m: Option<Interval>,
    /// How long the melt may wait in the nozzle, s.
    pub melt_life_s: Option<Interval>,
}

/// Specific heat `cp0 + cp1 T` and conductivity `k0 + k1 T`, T in °C.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatLaw {
    /// Specific heat at 0 °C, J/(kg K), and its slope, J/(kg K²).
    pub cp: [f64; 2],
    /// Conductivity at 0 °C, W/(m K), and its slope, W/(m K²).
    pub k: [f64; 2],
}

/// Coefficients of Tait's equation, SI, letters of the literature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaitLaw {
    /// Transition at no pressure, K.
    pub b5_k: f64,
    /// Its rise with pressure, K/Pa.
    pub b6_k_pa: f64,
    /// b1 to b4 of the melt.
    pub melt: [f64; 4],
    /// b1 to b4 of the solid.
    pub solid: [f64; 4],
}

/// Weld time `A exp(Q/(R T))`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WeldLaw {
    /// A, s.
    pub a_s: f64,
    /// Q, J/mol.
    pub q_j_mol: f64,
    /// True time over the law's.
    pub factor: Interval,
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
    /// How the degree of cure grows; `None`: nobody knows.
    pub kinetics: Option<KineticsLaw>,
    /// Heat of the whole reaction, J/kg.
    pub reaction_heat_j_kg: Option<Interval>,
    /// Activation energy of the critical exposure, J/mol.
    pub exposure_activation_j_mol: Option<Interval>,
    /// Skin that air keeps tacky, m.
    pub tacky_skin_m: Option<Interval>,
    /// Its oxygen, which eats light after a time in the dark; `None`: nobody knows.
    pub oxygen: Option<OxygenLaw>,
    /// How the gel flows past its yield stress; `None`: nobody knows.
    pub flow: Option<GelFlow>,
    /// Surface tension, N/m.
    pub surface_tension_n_m: Option<Interval>,
}

/// Kamal and Sourour's law with intensity; its rates follow from the critical exposure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KineticsLaw {
    /// m.
    pub m: f64,
    /// n.
    pub n: f64,
    /// Exponent of the intensity.
    pub b: f64,
    /// k2 over k1.
    pub k2_over_k1: f64,
    /// Irradiance at which the critical exposure was measured, W/m²; `None`: the strand's own.
    pub measured_at_w_m2: Option<f64>,
    /// Degree of cure at the gel point.
    pub gel: f64,
    /// Greatest degree of cure at room temperature.
    pub max: f64,
}

/// Oxygen in a resin that stands in air.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OxygenLaw {
    /// Dissolved oxygen, mol/m³.
    pub dissolved_mol_m3: f64,
    /// Its diffusivity, m²/s.
    pub diffusivity_m2_s: f64,
    /// Radicals to a photon absorbed.
    pub quantum_yield: f64,
    /// Wavelength of the light, m.
    pub wavelength_m: f64,
}

/// A gel that flows past its yield stress: `τ = τ_y + K γ̇ⁿ`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GelFlow {
    /// K, Pa sⁿ.
    pub consistency_pa_sn: Interval,
    /// n.
    pub index: Interval,
    /// Time in which it finds its yield stress again, s.
    pub recovery_s: Interval,
}

/// What sets by the clock.
#[derive(Debug, Clone, PartialEq)]
pub struct TwoPart {
    /// Time to set, s: from the nozzle on, or, where activation and reference are given, from the mixer on at the
    /// reference temperature.
    pub set_time_s: Interval,
    /// Activation energy of its clock, J/mol; `None`: nobody knows.
    pub activation_j_mol: Option<Interval>,
    /// Temperature to which the set time refers, K.
    pub reference_k: Option<f64>,
    /// Viscosity as it leaves the nozzle, Pa s.
    pub viscosity_pa_s: Interval,
    /// Linear shrinkage after the gel point.
    pub linear_shrinkage: Interval,
    /// Time from the mixer after which it blocks what it stands in, s.
    pub pot_life_s: Option<Interval>,
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
