//! Strands as the cases have them.

use crate::interval::Interval;
use crate::process::bead::flow_m3_s;
use crate::process::soft::nozzle_sag;
use crate::process::{
    Air, Ends, Fidelity, Heats, Jet, Material, Photopolymer, Setting, StrandInput, Thermoplastic,
};

/// Standard gravity, m/s².
pub(super) const GRAVITY_M_S2: f64 = 9.806_65;
/// A room, K.
pub(super) const ROOM_K: f64 = 295.15;
/// A jet that reaches all of the strand that is still soft, m; the cases give no reach.
const EVERYWHERE_M: f64 = 10.0;

/// A level strand of this diameter at this speed, held at both ends, fed to its length.
///
/// The bore is the diameter, the swell one: what is fed is what is drawn. `jet_m_s` zero: still air.
pub(super) fn strand(diameter_m: f64, speed_m_s: f64, span_m: f64, jet_m_s: f64) -> StrandInput {
    let jet = Jet { speed_m_s: Interval::exact(jet_m_s), reach_m: EVERYWHERE_M };
    StrandInput {
        fidelity: Fidelity::ClosedForms,
        length_m: span_m,
        span_m,
        speed_m_s,
        flow_m3_s: flow_m3_s(diameter_m, speed_m_s),
        nozzle_diameter_m: diameter_m,
        swell: Interval::exact(1.0),
        gravity_across_m_s2: GRAVITY_M_S2,
        ends: Ends::BothHeld,
        mixer_m3: 0.0,
        dwell_s: 0.0,
        air: Air {
            temperature_k: ROOM_K,
            room_m_s: 0.0,
            jet: (jet_m_s > 0.0).then_some(jet),
            blown: None,
        },
        light: None,
    }
}

/// Sag behind the nozzle, m.
pub(super) fn sag_m(input: &StrandInput, material: &Material) -> Interval {
    nozzle_sag(input, material, &Heats::new(input, material)).offset_m
}

/// Fastest print at which a strand sags no more than half its diameter behind the nozzle, m/s.
///
/// Half the diameter is where the reference calls sag an error (section 8). Span 60 mm, the middle of
/// the struts of 48 public jobs (2.5). Bisection of the law of sag in the logarithm of the speed.
pub(super) fn usable_speed_m_s(material: &Material, diameter_m: f64, jet_m_s: f64) -> Interval {
    let fastest = |end: fn(Interval) -> f64| {
        let (mut low, mut high) = (1e-5_f64, 1.0_f64);
        for _ in 0..40 {
            let middle = (low * high).sqrt();
            let sag = end(sag_m(&strand(diameter_m, middle, 0.06, jet_m_s), material));
            if sag < 0.5 * diameter_m { low = middle } else { high = middle }
        }
        low
    };
    Interval::new(fastest(|sag| sag.nominal), fastest(|sag| sag.high), fastest(|sag| sag.low))
}

/// The material with the high end of its specific heat: the library has that of the room, and a melt holds more.
pub(super) fn with_cp_high(material: &Material) -> Material {
    Material { cp_j_kgk: Interval::exact(material.cp_j_kgk.high), ..material.clone() }
}

/// What a photopolymer has of its own.
pub(super) fn resin(material: &Material) -> Option<&Photopolymer> {
    match &material.setting {
        Setting::Photopolymer(resin) => Some(resin),
        Setting::Thermoplastic(_) | Setting::TwoPart(_) => None,
    }
}

/// A number of a photopolymer; not a number for another material, which no band holds.
pub(super) fn of_resin(material: &Material, number: fn(&Photopolymer) -> Interval) -> Interval {
    resin(material).map_or(Interval::exact(f64::NAN), number)
}

/// What a thermoplastic has of its own.
pub(super) fn melt(material: &Material) -> Option<&Thermoplastic> {
    match &material.setting {
        Setting::Thermoplastic(plastic) => Some(plastic),
        Setting::Photopolymer(_) | Setting::TwoPart(_) => None,
    }
}
