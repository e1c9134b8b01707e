//! Sag of a strand behind the nozzle: the sag laws fed by the setting of its material.

use super::bead::drawn_diameter_m;
use super::gel::{cantilever_length_m, clamped_span_m, flowing_share};
use super::history::{Corner, clock_set_s, light_set_s};
use super::material::{Material, Setting, Thermoplastic};
use super::sag::{Fluidity, LINEAR_LIMIT, SoftBeam, stretched_sag_m};
use super::strand::{Ends, Heats, StrandInput};
use super::thermal::Heat;
use crate::interval::Interval;

/// A strand that never sets is given this long to sag, s.
const PATIENCE_S: f64 = 3600.0;
/// Fluidity over that at the nozzle below which a strand is rigid; the tail left out is below 1e-7.
const RIGID: f64 = 1e-14;
/// Quadrature panels to a piece: 1e-6 of the sag or better (tested).
const PANELS: u32 = 10;

/// Sag behind the nozzle, and whether linear theory holds at its nominal value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NozzleSag {
    /// Greatest offset from the nozzle's path, m.
    pub offset_m: Interval,
    /// False past 1.3 D, where the number is an order of magnitude.
    pub linear: bool,
}

/// Sag A of one strand, m.
///
/// Nominal: the nozzle clamps the slope (what a moving-nozzle simulation of the reference used), all
/// inputs nominal. Low: clamped, fast corner. High: the nozzle is a hinge, slow corner. A free far end
/// takes the greater of this and its own drop once the nozzle has left; the drop has no tension to
/// stretch against and is bounded by the span. Corners: [`Corner`] on cooling, viscosity, density; lamp,
/// critical exposure, yield stress; set time. Resting strands do not sag.
pub fn nozzle_sag(input: &StrandInput, material: &Material, heats: &Heats) -> NozzleSag {
    if input.ends == Ends::Resting {
        return NozzleSag { offset_m: Interval::exact(0.0), linear: true };
    }
    let at = |corner| offset(input, material, heats, corner);
    let (nominal, low, high) = (at(Corner::Nominal), at(Corner::Fast), at(Corner::Slow));
    NozzleSag { offset_m: Interval::new(nominal.0, low.0, high.0), linear: nominal.1 }
}

/// Offset at a corner, m, and whether linear.
fn offset(input: &StrandInput, material: &Material, heats: &Heats, corner: Corner) -> (f64, bool) {
    let beam = SoftBeam {
        diameter_m: drawn_diameter_m(input.flow_m3_s, input.speed_m_s),
        density_kg_m3: corner.harmful(material.fresh_density_kg_m3()),
        across_m_s2: input.gravity_across_m_s2,
        speed_m_s: input.speed_m_s,
        span_m: input.span_m,
    };
    let (held_m, tip_m) = match &material.setting {
        Setting::Thermoplastic(plastic) => {
            let Some(heat) = heats.at(corner) else { return (0.0, true) };
            let fluidity =
                melt_fluidity(plastic, heat).thicker(corner.helpful(plastic.viscosity.factor));
            (held(&beam, fluidity, corner), beam.tip_drop_m(fluidity))
        }
        Setting::Photopolymer(resin) => {
            let until_s = light_set_s(input, resin, corner).min(PATIENCE_S);
            let weight = beam.density_kg_m3 * input.gravity_across_m_s2.abs();
            let yield_pa = corner.helpful(resin.yield_stress_pa);
            let length_m = (until_s * input.speed_m_s).min(input.span_m);
            let viscosity_pa_s = corner.helpful(resin.base_viscosity_pa_s);
            let (held_m, tip_m) = liquid(&beam, viscosity_pa_s, until_s, corner);
            let bridge_m = clamped_span_m(yield_pa, weight, beam.diameter_m);
            let cantilever_m = cantilever_length_m(yield_pa, weight, beam.diameter_m);
            (
                held_m * flowing_share(bridge_m, length_m),
                tip_m * flowing_share(cantilever_m, length_m),
            )
        }
        Setting::TwoPart(mix) => {
            let until_s = clock_set_s(input, mix, corner).min(PATIENCE_S);
            liquid(&beam, corner.helpful(mix.viscosity_pa_s), until_s, corner)
        }
    };
    let (stretched_m, linear) = stretched_sag_m(held_m, beam.diameter_m);
    match input.ends {
        Ends::StartHeld => {
            let straight = tip_m <= LINEAR_LIMIT * beam.diameter_m;
            (stretched_m.max(tip_m.min(input.span_m)), linear && straight)
        }
        Ends::BothHeld | Ends::Resting => (stretched_m, linear),
    }
}

/// Clamped at the nozzle but for the slow corner, where it is a hinge.
fn held(beam: &SoftBeam, fluidity: Fluidity, corner: Corner) -> f64 {
    match corner {
        Corner::Nominal | Corner::Fast => beam.clamped_sag_m(fluidity),
        Corner::Slow => beam.hinged_sag_m(fluidity),
    }
}

/// Held sag and tip drop of a strand of constant viscosity, with shear, m.
fn liquid(beam: &SoftBeam, viscosity_pa_s: f64, until_s: f64, corner: Corner) -> (f64, f64) {
    let fluidity = Fluidity::constant(viscosity_pa_s, until_s);
    let shear_m = beam.shear_sag_m(viscosity_pa_s, until_s);
    (held(beam, fluidity, corner) + shear_m, beam.tip_drop_m(fluidity) + shear_m)
}

/// Fluidity of a cooling melt, viscosity factor one.
pub fn melt_fluidity(plastic: &Thermoplastic, heat: &Heat) -> Fluidity {
    melt_fluidity_with(plastic, heat, PANELS)
}

/// The same with a number of quadrature panels to each of its pieces, in the jet and after.
pub fn melt_fluidity_with(plastic: &Thermoplastic, heat: &Heat, panels: u32) -> Fluidity {
    let viscosity = plastic.viscosity;
    let end_s = rigid_age_s(plastic, heat);
    let fluidity = |age_s: f64| 1.0 / (3.0 * viscosity.zero_shear_pa_s(heat.temperature_k(age_s)));
    if heat.jet_until_s() > 0.0 && heat.jet_until_s() < end_s {
        Fluidity::integrate(fluidity, &[0.0, heat.jet_until_s(), end_s], panels)
    } else {
        Fluidity::integrate(fluidity, &[0.0, end_s], panels)
    }
}

/// Age from which a melt is rigid, s: its fluidity is then 1e-14 of that at the nozzle; at most an hour.
pub fn rigid_age_s(plastic: &Thermoplastic, heat: &Heat) -> f64 {
    let viscosity = plastic.viscosity;
    let rigid_pa_s = viscosity.zero_shear_pa_s(heat.start_k()) / RIGID;
    heat.time_to_s(viscosity.temperature_k(rigid_pa_s)).min(PATIENCE_S)
}
