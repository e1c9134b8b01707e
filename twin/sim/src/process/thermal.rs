//! Temperature of a strand against its age: by one rate, or through its radius.

use super::air_side::AirSide;
use super::cooled::Cooled;
use super::heat::{Cooling, cooling_rate_per_s, effective_h_w_m2k, total_h_w_m2k};
use super::history::Corner;
use super::material::{Material, Thermoplastic};
use super::radial::{self, Linear, RoundStrand, Span, Surroundings, uniform_profile_k};
use super::strand::{Fidelity, StrandInput};
use crate::interval::Interval;

/// Error of the heat transfer correlations on thin strands: case NUSSELT-THIN.
const CORRELATION_SPREAD: f64 = 0.2;
/// Rings of the radial run; the time to a temperature is then right to 0.1 % (tested in `radial`).
const RINGS: usize = 12;
/// The radial run goes on until the strand is this near to the air, K, or this old, s.
const NEAR_AIR_K: f64 = 2.0;
const LONGEST_S: f64 = 3600.0;

/// Temperature of a section against its age.
#[derive(Debug, Clone, PartialEq)]
pub enum Heat {
    /// One rate in the jet, one in the room.
    Lumped(Cooling),
    /// Through the radius.
    Radial(Box<Cooled>, [f64; 2]),
}

impl Heat {
    /// Mean temperature of the section at an age, K.
    pub fn temperature_k(&self, age_s: f64) -> f64 {
        match self {
            Self::Lumped(cooling) => cooling.temperature_k(age_s),
            Self::Radial(cooled, _) => cooled.mean_at_k(age_s.max(0.0)),
        }
    }

    /// Temperature on the axis at an age, K; that of the section where it is lumped.
    pub fn core_k(&self, age_s: f64) -> f64 {
        match self {
            Self::Lumped(cooling) => cooling.temperature_k(age_s),
            Self::Radial(cooled, _) => cooled.core_at_k(age_s.max(0.0)),
        }
    }

    /// Age at which the mean temperature reaches a target, s; infinite if it never does.
    pub fn time_to_s(&self, target_k: f64) -> f64 {
        match self {
            Self::Lumped(cooling) => cooling.time_to_s(target_k),
            Self::Radial(..) if target_k >= self.start_k() => 0.0,
            Self::Radial(cooled, _) => cooled.time_to_s(target_k),
        }
    }

    /// Temperature at the nozzle, K.
    pub fn start_k(&self) -> f64 {
        match self {
            Self::Lumped(cooling) => cooling.start_k,
            Self::Radial(_, [start_k, _]) => *start_k,
        }
    }

    /// Age at which a section leaves the jet, s; zero where there is none.
    pub fn jet_until_s(&self) -> f64 {
        match self {
            Self::Lumped(cooling) => cooling.jet_until_s,
            Self::Radial(_, [_, until_s]) => *until_s,
        }
    }
}

/// Temperature of the strand against age at a corner.
///
/// Corners: speed of the jets, specific heat, and the correlations' own ±20 %; nozzle temperature,
/// emissivity and conductivity at their nominal values. By closed form the heat transfer is taken at the
/// surface temperature midway between nozzle and glass transition; through the radius at the surface as
/// it is, with the material's `k(T)` and `cp(T)` where they are known.
pub fn heat(
    input: &StrandInput,
    material: &Material,
    plastic: &Thermoplastic,
    corner: Corner,
) -> Heat {
    match input.fidelity {
        Fidelity::ClosedForms => Heat::Lumped(cooling(input, material, plastic, corner)),
        Fidelity::Full => {
            let until_s = input.air.jet_reach_m() / input.speed_m_s;
            let cooled = cooled(input, material, plastic, corner);
            Heat::Radial(Box::new(cooled), [plastic.extrusion_k.nominal, until_s.max(0.0)])
        }
    }
}

/// How well the correlations are known at a corner.
pub(super) fn spread(corner: Corner) -> f64 {
    corner.helpful(Interval::new(1.0, 1.0 - CORRELATION_SPREAD, 1.0 + CORRELATION_SPREAD))
}

/// The lumped law at a corner; jets told one by one count as the mean over their reach.
pub fn cooling(
    input: &StrandInput,
    material: &Material,
    plastic: &Thermoplastic,
    corner: Corner,
) -> Cooling {
    let diameter_m = input.hot_diameter_m();
    let air_k = input.air.temperature_k;
    let surface_k = 0.5 * (plastic.extrusion_k.nominal + plastic.glass_k.nominal);
    let rate_per_s = |air_m_s: f64| {
        let emissivity = material.emissivity.nominal;
        let h = spread(corner) * total_h_w_m2k(diameter_m, surface_k, air_k, air_m_s, emissivity);
        let effective = effective_h_w_m2k(h, diameter_m, material.k_w_mk.nominal);
        let cp = corner.harmful(material.cp_j_kgk);
        cooling_rate_per_s(effective, plastic.melt_density_kg_m3.nominal, cp, diameter_m)
    };
    let room_rate_per_s = rate_per_s(input.air.room_m_s);
    let reach_m = input.air.jet_reach_m();
    let (jet_rate_per_s, jet_until_s) = if reach_m > 0.0 {
        let jet_m_s = input.air.mean_jet_m_s(corner).max(input.air.room_m_s);
        (rate_per_s(jet_m_s), (reach_m / input.speed_m_s).max(0.0))
    } else {
        (room_rate_per_s, 0.0)
    };
    Cooling {
        start_k: plastic.extrusion_k.nominal,
        air_k,
        jet_rate_per_s,
        jet_until_s,
        room_rate_per_s,
    }
}

/// The radial run at a corner.
fn cooled(
    input: &StrandInput,
    material: &Material,
    plastic: &Thermoplastic,
    corner: Corner,
) -> Cooled {
    let diameter_m = input.hot_diameter_m();
    let (air_k, speed_m_s) = (input.air.temperature_k, input.speed_m_s);
    let cp_share = corner.harmful(material.cp_j_kgk) / material.cp_j_kgk.nominal;
    let linear = |law: Option<[f64; 2]>, one: f64, share: f64| match law {
        Some([at_0c, per_k]) => Linear { at_0c: at_0c * share, per_k: per_k * share },
        None => Linear::constant(one * share),
    };
    let strand = RoundStrand {
        diameter_m,
        density_kg_m3: plastic.melt_density_kg_m3.nominal,
        conductivity_w_mk: linear(plastic.heat.map(|law| law.k), material.k_w_mk.nominal, 1.0),
        cp_j_kgk: linear(plastic.heat.map(|law| law.cp), material.cp_j_kgk.nominal, cp_share),
    };
    let hottest_k = plastic.extrusion_k.nominal;
    let side = AirSide::new(diameter_m, air_k, hottest_k, material.emissivity.nominal);
    let h_w_m2k = |surface_k: f64, age_s: f64| {
        let air_m_s = input.air.speed_m_s(speed_m_s * age_s, corner);
        spread(corner) * side.h_w_m2k(surface_k, air_m_s)
    };
    let around = Surroundings { air_k, h_w_m2k: &h_w_m2k, source_w_m3: &|_| 0.0 };
    let reach_s = input.air.jet_reach_m() / speed_m_s;
    let span = Span {
        from_s: 0.0,
        until_s: LONGEST_S,
        stop_k: air_k + NEAR_AIR_K,
        tolerance_k: 0.1,
        longest_step_s: if reach_s > 0.0 { (reach_s / 12.0).max(0.02) } else { f64::INFINITY },
    };
    let start_k = uniform_profile_k(plastic.extrusion_k.nominal, RINGS);
    radial::cool(&strand, &start_k, &around, &span)
}
