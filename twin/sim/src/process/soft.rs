//! Sag of a strand behind the nozzle: the sag laws fed by the setting of its material.

use super::bead::drawn_diameter_m;
use super::gel_sag::{FreshGel, GelStrand};
use super::history::{Corner, clock_set_s, light_set_s};
use super::material::{Material, Photopolymer, Setting, Thermoplastic};
use super::sag::{Fluidity, LINEAR_LIMIT, SoftBeam, stretched_sag_m};
use super::strand::{Ends, Heats, StrandInput};
use super::thermal::Heat;
use super::tube::wall_rate_per_s;
use super::yield_stress::{HerschelBulkley, Structure};
use crate::interval::Interval;

/// A strand that never sets is given this long to sag, s.
const PATIENCE_S: f64 = 3600.0;
/// Fluidity over that at the nozzle below which a strand is rigid; the tail left out is below 1e-7.
const RIGID: f64 = 1e-14;
/// Quadrature panels to a piece: 1e-6 of the sag or better (tested).
const PANELS: u32 = 10;

/// Breakdown of a gel to a unit of shear. Ours, since nobody has one: a gel shears apart within a unit of strain. With the
/// reference's slowest recovery a nozzle then leaves a few thousandths, so that more breakdown hardly changes the sag.
const BREAKDOWN: f64 = 1.0;

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
/// critical exposure, yield stress, flow of the gel, its recovery (slow alone); set time. Resting strands do not sag.
///
/// A gel costs under a microsecond where it stands; where it flows about twenty, where its span is also shorter than
/// twice its soft zone, or it never sets, a tenth of a millisecond.
pub fn nozzle_sag(input: &StrandInput, material: &Material, heats: &Heats) -> NozzleSag {
    if input.ends == Ends::Resting {
        return NozzleSag { offset_m: Interval::exact(0.0), linear: true };
    }
    let at = |corner| offset(input, material, heats, corner);
    let (nominal, low, high) = (at(Corner::Nominal), at(Corner::Fast), at(Corner::Slow));
    NozzleSag { offset_m: Interval::new(nominal.0, low.0, high.0), linear: nominal.1 }
}

/// Offset at a corner, m, and whether linear.
pub(super) fn offset(
    input: &StrandInput,
    material: &Material,
    heats: &Heats,
    corner: Corner,
) -> (f64, bool) {
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
            let strand = |gel: FreshGel| GelStrand {
                gel,
                diameter_m: beam.diameter_m,
                weight_n_m3: beam.density_kg_m3 * beam.across_m_s2.abs(),
                speed_m_s: beam.speed_m_s,
                span_m: beam.span_m,
                until_s: light_set_s(input, resin, corner).min(PATIENCE_S),
            };
            gel_sag(&gels(input, resin, corner).map(strand), input.ends, corner)
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

/// The gel at a corner, with the index at both of its ends where that is not nominal: which of them flows faster
/// depends on the stress.
///
/// Nominal and fast: as rested. The slow corner has it sheared by the nozzle and coming back, since nobody has
/// measured the recovery: with the reference's numbers, 60 Pa and 5 s, a gel sheared to nothing would have 4.6 Pa
/// when light sets it at 0.4 s, and the prints that stood say it had more. A material whose flow is not known is a Bingham
/// fluid of the resin's viscosity, rested at all corners.
fn gels(input: &StrandInput, resin: &Photopolymer, corner: Corner) -> [FreshGel; 2] {
    let yield_pa = corner.helpful(resin.yield_stress_pa);
    let Some(flow) = resin.flow else {
        let consistency_pa_sn = corner.helpful(resin.base_viscosity_pa_s);
        let fluid = HerschelBulkley { yield_pa, consistency_pa_sn, index: 1.0 };
        return [FreshGel::rested(fluid); 2];
    };
    let consistency_pa_sn = corner.helpful(flow.consistency_pa_sn);
    let index = |index| HerschelBulkley { yield_pa, consistency_pa_sn, index };
    match corner {
        Corner::Nominal => [FreshGel::rested(index(flow.index.nominal)); 2],
        Corner::Fast => [flow.index.low, flow.index.high].map(|n| FreshGel::rested(index(n))),
        Corner::Slow => [flow.index.low, flow.index.high].map(|n| {
            let recovery_s = corner.harmful(flow.recovery_s);
            let structure = Structure { recovery_s, breakdown: BREAKDOWN };
            let bore_m = input.nozzle_diameter_m;
            let area_m2 = 0.25 * std::f64::consts::PI * bore_m * bore_m;
            let rate_per_s = wall_rate_per_s(input.flow_m3_s / area_m2, bore_m, n);
            FreshGel::sheared(index(n), structure, rate_per_s)
        }),
    }
}

/// Held sag and tip drop of a gel with shear, m: the worse of both at the slow corner, the better else.
fn gel_sag(strands: &[GelStrand; 2], ends: Ends, corner: Corner) -> (f64, f64) {
    let one = |strand: &GelStrand| {
        let shear_m = strand.shear_sag_m();
        let held_m = match corner {
            Corner::Nominal | Corner::Fast => strand.clamped_sag_m(),
            Corner::Slow => strand.hinged_sag_m(),
        };
        let tip_m = if ends == Ends::StartHeld { strand.tip_drop_m() } else { 0.0 };
        (held_m + shear_m, tip_m + shear_m)
    };
    let first = one(&strands[0]);
    if strands[0] == strands[1] {
        return first;
    }
    let second = one(&strands[1]);
    match corner {
        Corner::Slow => (first.0.max(second.0), first.1.max(second.1)),
        Corner::Nominal | Corner::Fast => (first.0.min(second.0), first.1.min(second.1)),
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
