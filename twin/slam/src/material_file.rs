//! `materials/<name>.toml`: a printing material, every number with range, status and source.

use serde::Deserialize;

use crate::cell_file::checks::{Checks, Place, Rule, parse_checked};
use crate::{Diagnostic, Source};

mod rewrite;
#[cfg(test)]
mod tests;

pub use rewrite::{Change, rewritten};

/// 0 K, °C.
const ABSOLUTE_ZERO_C: f64 = -273.15;

/// A material as written.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialFile {
    /// Its name.
    pub name: String,
    /// What a reader must know before trusting it.
    #[serde(default)]
    pub note: String,
    /// Density as printed and set, kg/m³.
    pub density_kg_m3: Number,
    /// Young's modulus when set, Pa.
    pub youngs_modulus_pa: Number,
    /// Poisson's ratio.
    pub poisson: Number,
    /// Strength along the strand, Pa.
    pub strength_pa: Number,
    /// Strength across a bond over strength along the strand.
    pub bond_fraction: Number,
    /// Linear thermal expansion below the set temperature, 1/K.
    pub cte_per_k: Number,
    /// Specific heat, J/(kg K).
    pub cp_j_kgk: Number,
    /// Thermal conductivity, W/(m K).
    pub k_w_mk: Number,
    /// Emissivity.
    pub emissivity: Number,
    /// The law by which it sets.
    pub setting: SettingFile,
}

/// How a material sets.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[allow(
    clippy::large_enum_variant,
    reason = "a material has one; boxing it would only blur the file's shape"
)]
pub enum SettingFile {
    /// By cooling.
    Thermoplastic {
        /// Nozzle temperature, °C.
        extrusion_c: Number,
        /// Density of the melt, kg/m³.
        melt_density_kg_m3: Number,
        /// Glass transition, °C.
        glass_c: Number,
        /// Below this the strand no longer flows, °C; a label, the laws use the viscosity.
        flow_arrest_c: Number,
        /// Zero-shear viscosity, Cross-WLF: `D1 exp(−A1 (T − T*) / (A2 + T − T*))`.
        viscosity: CrossWlf,
        /// Modulus of the rubbery plateau above the glass transition, Pa.
        plateau_modulus_pa: Number,
        /// Specific heat and conductivity against temperature; not given: one number each.
        heat: Option<HeatFile>,
        /// Density against temperature, Tait.
        tait: Option<TaitFile>,
        /// Time in which a weld heals, `A exp(Q/(R T))`.
        weld: Option<WeldFile>,
        /// Surface tension of the melt, N/m.
        surface_tension_n_m: Option<Number>,
        /// How long the melt may wait in the nozzle, s.
        melt_life_s: Option<Number>,
    },
    /// By light.
    Photopolymer {
        /// Density of the gel, kg/m³.
        gel_density_kg_m3: Number,
        /// Viscosity of the resin without filler, Pa s.
        base_viscosity_pa_s: Number,
        /// Yield stress of the gel, Pa.
        yield_stress_pa: Number,
        /// Penetration depth of the light, m.
        penetration_m: Number,
        /// Critical exposure, J/m².
        critical_exposure_j_m2: Number,
        /// Modulus just past the gel point, Pa.
        gel_modulus_pa: Number,
        /// Modulus after post-cure, Pa; `youngs_modulus_pa` is the green one.
        cured_modulus_pa: Number,
        /// Linear shrinkage after the gel point.
        linear_shrinkage: Number,
        /// How the degree of cure grows in the light.
        kinetics: Option<KineticsFile>,
        /// Heat of the whole reaction, J/kg.
        reaction_heat_j_kg: Option<Number>,
        /// Activation energy of the critical exposure, J/mol.
        exposure_activation_j_mol: Option<Number>,
        /// Skin that air keeps tacky, m.
        tacky_skin_m: Option<Number>,
        /// Oxygen in it, for second passes of light.
        oxygen: Option<OxygenFile>,
        /// Consistency `K` of the flowing gel, Pa sⁿ.
        consistency_pa_sn: Option<Number>,
        /// Exponent `n` of the flowing gel.
        flow_index: Option<Number>,
        /// Time in which the sheared gel finds its yield stress again, s.
        recovery_s: Option<Number>,
        /// Surface tension, N/m.
        surface_tension_n_m: Option<Number>,
    },
    /// By the clock, from the mixer on.
    TwoPart {
        /// Time to set, s: from the nozzle on, or, with `activation_j_mol` and `reference_k`, from the mixer on at
        /// that temperature.
        set_time_s: Number,
        /// Activation energy of its clock, J/mol; with `reference_k` or not at all.
        activation_j_mol: Option<Number>,
        /// Temperature to which the set time refers, K.
        reference_k: Option<f64>,
        /// Viscosity as it leaves the nozzle, Pa s.
        viscosity_pa_s: Number,
        /// Linear shrinkage after the gel point.
        linear_shrinkage: Number,
        /// Time from the mixer after which it blocks what it stands in, s.
        pot_life_s: Option<Number>,
    },
}

/// Specific heat `cp = cp0 + cp1 T` and conductivity `k = k0 + k1 T`, T in °C.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeatFile {
    /// Specific heat at 0 °C, J/(kg K).
    pub cp0_j_kgk: f64,
    /// Its slope, J/(kg K²).
    pub cp1_j_kgk2: f64,
    /// Conductivity at 0 °C, W/(m K).
    pub k0_w_mk: f64,
    /// Its slope, W/(m K²).
    pub k1_w_mk2: f64,
    /// How they are known.
    pub status: Status,
    /// Where they come from.
    pub source: String,
}

/// Tait's equation in two ranges; letters as in the literature, SI.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TaitFile {
    /// Transition at no pressure, K.
    pub b5_k: f64,
    /// Its rise with pressure, K/Pa.
    pub b6_k_pa: f64,
    /// Melt: specific volume at the transition m³/kg, its slope m³/(kg K), stiffness Pa, its decay 1/K.
    pub melt: [f64; 4],
    /// Solid: the same.
    pub solid: [f64; 4],
    /// How they are known.
    pub status: Status,
    /// Where they come from.
    pub source: String,
}

/// Time in which chains cross a weld.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WeldFile {
    /// A, s.
    pub a_s: f64,
    /// Q, J/mol.
    pub q_j_mol: f64,
    /// Low end of the time over its nominal value.
    pub factor_low: f64,
    /// High end of the time over its nominal value.
    pub factor_high: f64,
    /// How they are known.
    pub status: Status,
    /// Where they come from.
    pub source: String,
}

/// Kamal and Sourour's law with intensity: `dα/dt = (k1 + k2 αᵐ)(α_max − α)ⁿ`, `k ∝ Iᵇ`. Its rates are fitted to
/// the critical exposure.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KineticsFile {
    /// m.
    pub m: f64,
    /// n.
    pub n: f64,
    /// b.
    pub b: f64,
    /// k2 over k1; not given: 0, a law of order n.
    #[serde(default)]
    pub k2_over_k1: f64,
    /// Irradiance at which the critical exposure was measured, W/m²; not given: the strand's own.
    pub measured_at_w_m2: Option<f64>,
    /// Degree of cure at the gel point.
    pub gel: f64,
    /// Greatest degree of cure at room temperature.
    pub max: f64,
    /// How they are known.
    pub status: Status,
    /// Where they come from.
    pub source: String,
}

/// Oxygen in a resin that stands in air: what it costs to light a surface again that was dark for a while. Needs
/// `tacky_skin_m` as well.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OxygenFile {
    /// Dissolved oxygen, mol/m³.
    pub dissolved_mol_m3: f64,
    /// Its diffusivity, m²/s.
    pub diffusivity_m2_s: f64,
    /// Radicals to a photon absorbed.
    pub quantum_yield: f64,
    /// Wavelength of the light, m.
    pub wavelength_m: f64,
    /// How they are known.
    pub status: Status,
    /// Where they come from.
    pub source: String,
}

/// A number with its range.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Number {
    /// Nominal value.
    pub value: f64,
    /// Low end of what it may be.
    pub low: f64,
    /// High end of what it may be.
    pub high: f64,
    /// How it is known.
    pub status: Status,
    /// Where it comes from.
    pub source: String,
}

/// How a number is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// Read in a public source.
    Found,
    /// Stated in one of the three papers the project starts from.
    Seed,
    /// Computed from others.
    Derived,
    /// General knowledge or our own range.
    Memory,
    /// Fitted by `twin calibrate`.
    Measured,
}

/// Coefficients of one fit; they share one factor of uncertainty.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CrossWlf {
    /// D1, Pa s.
    pub d1_pa_s: f64,
    /// T*, K.
    pub t_star_k: f64,
    /// A1.
    pub a1: f64,
    /// A2, K.
    pub a2_k: f64,
    /// Low end of the viscosity over its nominal value.
    pub factor_low: f64,
    /// High end of the viscosity over its nominal value.
    pub factor_high: f64,
    /// How it is known.
    pub status: Status,
    /// Where it comes from.
    pub source: String,
}

/// Reads a material; refuses missing and impossible numbers, each with its place.
///
/// # Errors
/// Every problem found, in order of place.
pub fn parse(source: &Source) -> Result<MaterialFile, Vec<Diagnostic>> {
    parse_checked(source, |material, checks| {
        checks.text(material.get("name"), "name the material");
        for number in material.entries() {
            checks.ranged(Some(number), rule_of(number.name()));
        }
        for law in material.get("setting").map(Place::entries).unwrap_or_default() {
            for number in law.entries() {
                checks.ranged(Some(number), rule_of(number.name()));
            }
            temperatures(law, checks);
            coefficients(law, checks);
            if let Some(viscosity) = law.get("viscosity") {
                cross_wlf(viscosity, law, checks);
            }
        }
    })
}

/// What the number under a key may be; the range of a key holds in every law that has it.
fn rule_of(key: &str) -> Rule {
    match key {
        "poisson" => Rule::Between(-1.0, 0.5),
        "bond_fraction" | "emissivity" => Rule::AboveUpTo(0.0, 1.0),
        // Filled strands may grow a little along the fibre when they cool.
        "cte_per_k" => Rule::Between(-1e-3, 1e-2),
        "linear_shrinkage" => Rule::FromTo(0.0, 0.5),
        "flow_index" => Rule::AboveUpTo(0.0, 2.0),
        "extrusion_c" | "glass_c" | "flow_arrest_c" => Rule::Between(ABSOLUTE_ZERO_C, 2000.0),
        _ => Rule::Positive,
    }
}

fn temperatures(law: Place<'_>, checks: &mut Checks) {
    let value = |key: &str| law.get(key)?.get("value")?.number();
    let Some(extrusion) = value("extrusion_c") else { return };
    for key in ["glass_c", "flow_arrest_c"] {
        if let (Some(place), Some(set)) = (law.get(key), value(key))
            && set >= extrusion
        {
            let says = format!("`{key}` {set} °C is not below the nozzle's {extrusion} °C");
            let hint = "a thermoplastic must be a melt in the nozzle and set in air";
            checks.refuse(Diagnostic::error(place.span(), says).hint(hint));
        }
    }
}

/// Numbers of fits, which have no range of their own.
fn coefficients(law: Place<'_>, checks: &mut Checks) {
    if let Some(heat) = law.get("heat") {
        for (key, rule) in [
            ("cp0_j_kgk", Rule::Positive),
            ("cp1_j_kgk2", Rule::Finite),
            ("k0_w_mk", Rule::Positive),
            ("k1_w_mk2", Rule::Finite),
        ] {
            checks.number(heat.get(key), rule);
        }
    }
    if let Some(tait) = law.get("tait") {
        checks.number(tait.get("b5_k"), Rule::Positive);
        checks.number(tait.get("b6_k_pa"), Rule::NotNegative);
        checks.numbers(tait.get("melt"), Rule::Positive);
        checks.numbers(tait.get("solid"), Rule::Positive);
    }
    if let Some(weld) = law.get("weld") {
        checks.number(weld.get("a_s"), Rule::Positive);
        checks.number(weld.get("q_j_mol"), Rule::Between(0.0, 1e6));
        checks.number(weld.get("factor_low"), Rule::AboveUpTo(0.0, 1.0));
        checks.number(weld.get("factor_high"), Rule::FromTo(1.0, 1e6));
    }
    clock(law, checks);
    if let Some(oxygen) = law.get("oxygen") {
        for key in ["dissolved_mol_m3", "diffusivity_m2_s", "wavelength_m"] {
            checks.number(oxygen.get(key), Rule::Positive);
        }
        checks.number(oxygen.get("quantum_yield"), Rule::AboveUpTo(0.0, 2.0));
    }
    if let Some(kinetics) = law.get("kinetics") {
        for key in ["m", "n", "k2_over_k1"] {
            checks.number(kinetics.get(key), Rule::FromTo(0.0, 100.0));
        }
        checks.number(kinetics.get("b"), Rule::AboveUpTo(0.0, 2.0));
        checks.number(kinetics.get("measured_at_w_m2"), Rule::Positive);
        checks.number(kinetics.get("gel"), Rule::Between(0.0, 1.0));
        checks.number(kinetics.get("max"), Rule::AboveUpTo(0.0, 1.0));
        let value = |key: &str| kinetics.get(key)?.number();
        if let (Some(gel), Some(max), Some(place)) =
            (value("gel"), value("max"), kinetics.get("max"))
            && gel >= max
        {
            let says = format!("it gels at {gel}, but never gets past {max}");
            checks.refuse(Diagnostic::error(place.span(), says).hint("`gel` is below `max`"));
        }
    }
}

/// The clock of a two-part resin: both of its numbers or none.
fn clock(law: Place<'_>, checks: &mut Checks) {
    checks.number(law.get("reference_k"), Rule::Positive);
    let one = match (law.get("activation_j_mol"), law.get("reference_k")) {
        (Some(activation), None) => activation,
        (None, Some(reference)) => reference,
        _ => return,
    };
    let says = "`activation_j_mol` and `reference_k` go together";
    let hint = "without both, the set time is taken as seen behind the nozzle";
    checks.refuse(Diagnostic::error(one.span(), says).hint(hint));
}

fn cross_wlf(fit: Place<'_>, law: Place<'_>, checks: &mut Checks) {
    for key in ["d1_pa_s", "t_star_k", "a1", "a2_k"] {
        checks.number(fit.get(key), Rule::Positive);
    }
    checks.number(fit.get("factor_low"), Rule::AboveUpTo(0.0, 1.0));
    checks.number(fit.get("factor_high"), Rule::FromTo(1.0, 1e6));
    // The law has a pole where A2 + T − T* is zero; the melt must be on its warm side.
    let value = |key: &str| fit.get(key)?.number();
    let extrusion = law.get("extrusion_c").and_then(|place| place.get("low")?.number());
    if let (Some(extrusion_c), Some(t_star_k), Some(a2_k), Some(place)) =
        (extrusion, value("t_star_k"), value("a2_k"), fit.get("t_star_k"))
        && a2_k + extrusion_c - ABSOLUTE_ZERO_C - t_star_k <= 0.0
    {
        let says = format!("the viscosity has no value at {extrusion_c} °C: A2 + T − T* ≤ 0");
        checks.refuse(Diagnostic::error(place.span(), says).hint("T* and A2 are in kelvin"));
    }
}
