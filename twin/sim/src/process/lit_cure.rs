//! Degree of cure and heat of cure at one place of a lit strand.

use super::air_side::AirSide;
use super::cured::{self, Cured, Exposed};
use super::history::Corner;
use super::kamal::{CureCurve, Kamal};
use super::kinetics::Kinetics;
use super::material::{KineticsLaw, Material, Photopolymer};
use super::oxygen::{Oxygen, Reoxygenation};
use super::solid::adiabatic_rise_k;
use super::strand::Air;
use super::thermal::spread;
use super::warming::{Around, Body, Stretch, Warmed, warm};

#[cfg(test)]
mod tests;

/// Temperature to which exposures and rates refer, K.
const REFERENCE_K: f64 = 298.15;

/// What else is needed to know how warm a strand gets.
#[derive(Debug, Clone, Copy)]
pub struct Warmth<'a> {
    /// What it is made of.
    pub material: &'a Material,
    /// The air around it, still or blown.
    pub air: &'a Air,
    /// Speed of the nozzle, m/s: how fast a section leaves the jet.
    pub speed_m_s: f64,
}

/// Light of one pass on a place, as if it were even.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pass {
    /// Age at which it begins, s.
    pub from_s: f64,
    /// How long it lasts, s.
    pub lit_s: f64,
    /// Irradiance, W/m².
    pub irradiance_w_m2: f64,
}

/// A place of a strand, its light and what else it meets.
#[derive(Clone, Copy)]
pub struct Place<'a> {
    /// Radius of the strand, m.
    pub radius_m: f64,
    /// Temperature of strand and air before any light, K.
    pub temperature_k: f64,
    /// All light as one pass; it gels `Ec/I` after it begins.
    pub whole: Pass,
    /// The same as it came, where there was a second pass.
    pub twice: Option<[Pass; 2]>,
    /// Where its warmth is asked for.
    pub warmth: Option<Warmth<'a>>,
}

/// Cure of a place.
#[derive(Debug, Clone, PartialEq)]
pub struct Curing {
    /// Degree of cure of the surface against age.
    pub cure: Cured,
    /// Greatest temperature in the section, K; where the heat of cure is known.
    pub warmest_k: Option<f64>,
    /// Time under light to the gel point, over that of a strand that stays as warm as the air; one where the heat of cure is not known.
    pub sooner: f64,
}

/// Degree of cure at the surface of a place that was lit evenly until it had its dose, as warm as its own heat of cure
/// makes it.
///
/// The heat needs `reaction_heat_j_kg` and [`Place::warmth`]; without, the strand stays at `temperature_k` and
/// nothing is guessed. Oxygen that comes back between passes needs `oxygen` and `tacky_skin_m` of the resin. Corners: critical exposure,
/// activation energy, penetration, heat of reaction, specific heat; fast is warm, so its air takes away little: jets and
/// correlations are those of the slow corner. Conductivity, emissivity and density nominal. Cost: a cure curve
/// and, with heat, [`warm`].
pub fn curing(law: KineticsLaw, resin: &Photopolymer, place: &Place, corner: Corner) -> Curing {
    let kinetics = kinetics(law, resin, place.whole.irradiance_w_m2, corner);
    let curve = kinetics.kamal.curve();
    let oxygen = reoxygenation(resin);
    let warms = place.warmth.filter(|_| resin.reaction_heat_j_kg.is_some());
    let split = place.twice.filter(|_| warms.is_some() || oxygen.is_some());
    let stretches = match split {
        Some([first, second]) => {
            let (first, second) = (stretch(first), stretch(second));
            let gap = Stretch { from_s: first.to_s, to_s: second.from_s, irradiance_w_m2: 0.0 };
            vec![first, gap, second]
        }
        None => vec![stretch(place.whole)],
    };
    let warmed = warms
        .and_then(|warmth| warmed(&kinetics, &curve, resin, place, &stretches, warmth, corner));
    let surface = match &warmed {
        Some(warmed) => warmed.surface.clone(),
        None => isothermal(&stretches, place.temperature_k),
    };
    let history = between_dark(surface, place.temperature_k);
    let cure = cured::cure(&kinetics, &curve, &history, oxygen);
    let cold_s = kinetics.gel_time_s(place.whole.irradiance_w_m2, place.temperature_k);
    let lit_s = cure.gel_age_s - stretches[0].from_s;
    let sooner = if warmed.is_some() { lit_s / cold_s } else { 1.0 };
    let sooner = if sooner.is_finite() { sooner.clamp(0.0, 1.0) } else { 1.0 };
    Curing { cure, warmest_k: warmed.map(|warmed| warmed.warmest_k), sooner }
}

fn stretch(pass: Pass) -> Stretch {
    let Pass { from_s, lit_s, irradiance_w_m2 } = pass;
    Stretch { from_s, to_s: from_s + lit_s, irradiance_w_m2 }
}

/// Kinetics at a corner, fitted to its critical exposure.
fn kinetics(
    law: KineticsLaw,
    resin: &Photopolymer,
    irradiance_w_m2: f64,
    corner: Corner,
) -> Kinetics {
    Kinetics {
        kamal: Kamal {
            m: law.m,
            n: law.n,
            k1_per_s: 1.0,
            k2_per_s: law.k2_over_k1,
            gel: law.gel,
            max: law.max,
        },
        b: law.b,
        activation_j_mol: resin.exposure_activation_j_mol.map_or(0.0, |ea| corner.helpful(ea)),
        reference_w_m2: law.measured_at_w_m2.unwrap_or(irradiance_w_m2),
        reference_k: REFERENCE_K,
    }
    .calibrated(corner.harmful(resin.critical_exposure_j_m2))
}

/// What oxygen costs the second light; `None`: the resin's oxygen is not known.
fn reoxygenation(resin: &Photopolymer) -> Option<Reoxygenation> {
    let (law, skin_m) = (resin.oxygen?, resin.tacky_skin_m?);
    let oxygen = Oxygen {
        dissolved_mol_m3: law.dissolved_mol_m3,
        diffusivity_m2_s: law.diffusivity_m2_s,
        quantum_yield: law.quantum_yield,
        penetration_m: resin.penetration_m.nominal,
        wavelength_m: law.wavelength_m,
    };
    Some(oxygen.reoxygenation(skin_m.nominal))
}

fn warmed(
    kinetics: &Kinetics,
    curve: &CureCurve,
    resin: &Photopolymer,
    place: &Place,
    stretches: &[Stretch],
    warmth: Warmth,
    corner: Corner,
) -> Option<Warmed> {
    let Warmth { material, air, speed_m_s } = warmth;
    let enthalpy_j_kg = corner.helpful(resin.reaction_heat_j_kg?);
    let body = Body {
        radius_m: place.radius_m,
        density_kg_m3: resin.gel_density_kg_m3.nominal,
        cp_j_kgk: corner.harmful(material.cp_j_kgk),
        conductivity_w_mk: material.k_w_mk.nominal,
        enthalpy_j_kg,
        penetration_m: corner.helpful(resin.penetration_m),
    };
    let air_k = place.temperature_k;
    let hottest_k = air_k + adiabatic_rise_k(enthalpy_j_kg, kinetics.kamal.max, body.cp_j_kgk);
    let side = AirSide::new(2.0 * place.radius_m, air_k, hottest_k, material.emissivity.nominal);
    // What cools well sets this strand slowly.
    let airy = match corner {
        Corner::Nominal => Corner::Nominal,
        Corner::Fast => Corner::Slow,
        Corner::Slow => Corner::Fast,
    };
    let h_w_m2k = |surface_k: f64, age_s: f64| {
        spread(airy) * side.h_w_m2k(surface_k, air.speed_m_s(speed_m_s * age_s, airy))
    };
    warm(kinetics, curve, &body, stretches, &Around { air_k, h_w_m2k: &h_w_m2k })
}

fn isothermal(stretches: &[Stretch], temperature_k: f64) -> Vec<Exposed> {
    let ends = |stretch: &Stretch| {
        let irradiance_w_m2 = stretch.irradiance_w_m2;
        [stretch.from_s, stretch.to_s].map(|age_s| Exposed {
            age_s,
            irradiance_w_m2,
            temperature_k,
        })
    };
    stretches.iter().flat_map(ends).collect()
}

/// The dark before and after a history.
fn between_dark(lit: Vec<Exposed>, temperature_k: f64) -> Vec<Exposed> {
    let dark = |exposed: &Exposed| Exposed { irradiance_w_m2: 0.0, ..*exposed };
    let Some((first, last)) = lit.first().map(dark).zip(lit.last().map(dark)) else {
        return lit;
    };
    let born = Exposed { age_s: 0.0, irradiance_w_m2: 0.0, temperature_k };
    [vec![born, first], lit, vec![last]].concat()
}
