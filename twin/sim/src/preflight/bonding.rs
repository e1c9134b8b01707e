//! How well a strand bonds to the earlier ones it touches.

use super::making::StrandResult;
use super::reheating;
use crate::cell::Job;
use crate::deposit::{self, Contact, Deposit};
use crate::finding::{Check, Code, Findings, Site, Words};
use crate::growth;
use crate::interval::Interval;
use crate::process::Setting;
use crate::process::contact::{self, Touch, contact_area_m2, front_s, pressed_half_width_m};
use crate::process::healing::{self, WeldTime};
use crate::process::history::Corner;
use crate::process::thermal::cooling;

/// The weakest bond of a strand to an earlier one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bond {
    /// Strength over that along the strand: the share of its section that touches, times how far it has healed.
    pub share: Interval,
    /// Area of the contact, m².
    pub area_m2: f64,
    /// What that bears, N.
    pub strength_n: Interval,
    /// How far it has healed, or how many sites are left to react; 0 to 1.
    pub degree: Interval,
    /// Where on the strand, m.
    pub at_m: f64,
    /// The earlier strand, as index in the job.
    pub other: usize,
    /// Whether a law was used; else the material's bond fraction, measured on other prints.
    pub by_law: bool,
}

/// A weld is followed until it has cooled, or this long, s.
const LONGEST_S: f64 = 600.0;
/// Samples of the contact's temperature.
const SAMPLES: usize = 60;

/// The bond of each contact of the deposit as printed.
pub(super) fn bonds(
    job: &Job,
    deposit: &Deposit,
    contacts: &[Contact],
    results: &[StrandResult],
) -> Vec<Bond> {
    contacts.iter().map(|contact| bond(job, deposit, contact, results)).collect()
}

/// The weakest bond of each strand to earlier ones, in printing order.
pub(super) fn weakest(contacts: &[Contact], bonds: &[Bond], strands: usize) -> Vec<Option<Bond>> {
    let mut weakest: Vec<Option<Bond>> = vec![None; strands];
    for (contact, bond) in contacts.iter().zip(bonds) {
        let known = &mut weakest[contact.orders[0]];
        if known.is_none_or(|known| bond.share.nominal < known.share.nominal) {
            *known = Some(*bond);
        }
    }
    weakest
}

/// The bonds as the frame wants them.
pub(super) fn for_frame(job: &Job, bonds: &[Bond]) -> Vec<growth::Bond> {
    let strength = job.material.strength_pa;
    let of = |bond: &Bond| growth::Bond {
        area_m2: bond.area_m2,
        tension_pa: Interval::new(
            bond.degree.nominal * strength.nominal,
            bond.degree.low * strength.low,
            bond.degree.high * strength.high,
        ),
    };
    bonds.iter().map(of).collect()
}

fn bond(job: &Job, deposit: &Deposit, contact: &Contact, results: &[StrandResult]) -> Bond {
    let [result, earlier] = contact.orders.map(|order| &results[order]);
    let age_s = reheating::age_s(deposit, contact, results);
    let degree = degree(job, result, earlier, age_s, contact.at_m[0]);
    let diameter_m = result.outcome.bead_diameter_m.nominal;
    let section_m2 = std::f64::consts::PI * diameter_m * diameter_m / 4.0;
    let area_m2 = touching_m2(job, deposit, contact, result, section_m2);
    let healed = degree.unwrap_or(job.material.bond_fraction);
    let share = healed.scaled((area_m2 / section_m2).min(1.0));
    let strength = job.material.strength_pa;
    let strength_n = Interval::new(
        share.nominal * strength.nominal * section_m2,
        share.low * strength.low * section_m2,
        share.high * strength.high * section_m2,
    );
    Bond {
        share,
        area_m2,
        strength_n,
        degree: healed,
        at_m: contact.at_m[0],
        other: earlier.strand,
        by_law: degree.is_some(),
    }
}

/// Area of contact, m². Ends that meet within half a bead are merged: their whole section touches. Else the patch
/// of two beads that cross at the angle of their axes, at most that of two that lie side by side as far as one contact
/// reaches.
fn touching_m2(
    job: &Job,
    deposit: &Deposit,
    contact: &Contact,
    result: &StrandResult,
    section_m2: f64,
) -> f64 {
    let diameter_m = result.outcome.bead_diameter_m.nominal;
    let axes_m = contact.axes_m();
    if axes_m <= 0.5 * diameter_m {
        return section_m2;
    }
    let half_m = pressed_half_width_m(diameter_m, axes_m).max(neck_m(job, result));
    let [a, b] =
        [0, 1].map(|side| deposit.strands[contact.orders[side]].direction_at(contact.at_m[side]));
    let angle_rad = a.cross(&b).norm().atan2(a.dot(&b).abs());
    let crossing_m2 = contact_area_m2(diameter_m, half_m, Touch::Crossing(angle_rad));
    let reach_m = deposit::ALONGSIDE_DIAMETERS * diameter_m;
    crossing_m2.min(contact_area_m2(diameter_m, half_m, Touch::Alongside(reach_m)))
}

/// Half-width of the neck that the fresh strand's surface tension draws while it is hot, m; zero where that is unknown.
/// The fresh strand flows as hot as it is, the earlier one not at all: half the neck of two fresh ones; ours.
fn neck_m(job: &Job, result: &StrandResult) -> f64 {
    let Setting::Thermoplastic(plastic) = &job.material.setting else { return 0.0 };
    let Some(tension) = plastic.surface_tension_n_m else { return 0.0 };
    let cooling = cooling(&result.input, &job.material, plastic, Corner::Nominal);
    let until_s = cooling.time_to_s(plastic.flow_arrest_k.nominal).min(LONGEST_S);
    let sample = |k: usize| {
        let age_s = until_s * (k as f64 / SAMPLES as f64).powi(2);
        (age_s, cooling.temperature_k(age_s))
    };
    let samples: Vec<(f64, f64)> = (0..=SAMPLES).map(sample).collect();
    let radius_m = result.outcome.hot_diameter_m / 2.0;
    let viscosity = |kelvin: f64| plastic.viscosity.zero_shear_pa_s(kelvin);
    let angle_rad = contact::neck_angle_rad(&samples, radius_m, tension.nominal, viscosity);
    0.5 * contact::neck_half_width_m(radius_m, angle_rad)
}

/// How far a weld heals, where the material's weld time is known. What resins bond to has cured through where the lights
/// have passed, so they hold by the material's bond fraction.
fn degree(
    job: &Job,
    result: &StrandResult,
    earlier: &StrandResult,
    age_s: f64,
    at_m: f64,
) -> Option<Interval> {
    let material = &job.material;
    let Setting::Thermoplastic(plastic) = &material.setting else { return None };
    let weld = plastic.weld?;
    let at_end = at_m > result.input.length_m - result.outcome.hot_diameter_m;
    let waits_s = if at_end { result.input.dwell_s } else { 0.0 };
    Some(Corner::interval(|corner| {
        let laid = cooling(&earlier.input, material, plastic, corner);
        let fresh = cooling(&result.input, material, plastic, corner);
        // One material: the mean of the two.
        let interface_k = 0.5 * (fresh.start_k + laid.temperature_k(age_s));
        let heat_j_m3k = plastic.melt_density_kg_m3.nominal * material.cp_j_kgk.nominal;
        let contact = contact::Contact {
            interface_k,
            air_k: fresh.air_k,
            hold_s: front_s(result.outcome.hot_diameter_m, material.k_w_mk.nominal / heat_j_m3k)
                + waits_s,
            rate_per_s: fresh.jet_rate_per_s,
        };
        let glass_k = corner.harmful(plastic.glass_k);
        let time = WeldTime { prefactor_s: weld.a_s, activation_j_mol: weld.q_j_mol };
        let factor = corner.harmful(weld.factor);
        let samples = contact.samples(glass_k, LONGEST_S, SAMPLES);
        healing::healing_degree(&samples, glass_k, |kelvin| factor * time.at_s(kelvin))
    }))
}

/// P310: the weakest bond of each strand.
pub(super) fn judge(
    job: &Job,
    deposit: &Deposit,
    results: &[StrandResult],
    bonds: &[Option<Bond>],
    findings: &mut Findings,
) {
    for (order, (result, bond)) in results.iter().zip(bonds).enumerate() {
        let Some(bond) = bond else { continue };
        let printed = &deposit.strands[order];
        let site = Site::strand(result.strand, bond.at_m).at(printed.planned_at(bond.at_m));
        let time_s = Some(printed.born_s + result.course.time_at_s(bond.at_m));
        let limit = job.cell.extruder.nozzle_force_n.nominal;
        let measured = bond.strength_n;
        let check = Check { code: Code::P310, measured, limit, warn_limit: None, site, time_s };
        findings.check(check, || {
            let (id, other) = (&job.strands[result.strand].id, &job.strands[bond.other].id);
            Words {
                message: format!(
                    "strand `{id}` holds to `{other}` with {:.1} N ({:.1} to {:.1} N); the nozzle pushes with {limit:.1} N",
                    measured.nominal, measured.low, measured.high
                ),
                hint: "wait at the node with the hot nozzle, print hotter, or press the beads nearer together"
                    .to_owned(),
            }
        });
    }
}
