//! How warm a strand becomes again where later ones cross it with the hot nozzle.

use super::making::StrandResult;
use crate::cell::{Job, Tool};
use crate::deposit::{Contact, Deposit};
use crate::interval::Interval;
use crate::pose::Point;
use crate::process::heat::{radiation_h_w_m2k, total_h_w_m2k};
use crate::process::history::Corner;
use crate::process::reheat::{HotTip, Neighbour, Passing, WarmJet, Way, reheat};
use crate::process::thermal::cooling;
use crate::process::{Setting, Thermoplastic};
use crate::shape::Shape;

/// The warmest that a later strand's nozzle makes a strand of thermoplastic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reheated {
    /// Mean temperature of its section, K.
    pub peak_k: Interval,
    /// Time that section is above the glass transition, s.
    pub above_glass_s: Interval,
    /// Length brought above it, m.
    pub softened_m: Interval,
    /// Where on the strand, m.
    pub at_m: f64,
    /// The later strand, as index in the job.
    pub by: usize,
}

/// Emissivity of a hot end: sooted or oxidised brass, polished at the low end; ours.
const TIP_EMISSIVITY: Interval = Interval { nominal: 0.5, low: 0.1, high: 0.9 };

/// The warmest place of each strand, in printing order. Law: [`reheat`], across, at every place where a later strand
/// touches; a nozzle that passes without touching is farther off. Its gap to the earlier bead is what the axes leave,
/// from half to one and a half times it; jets blow at room temperature and are left out at the warm corner. O(contacts).
pub(super) fn reheats(
    job: &Job,
    deposit: &Deposit,
    contacts: &[Contact],
    results: &[StrandResult],
) -> Vec<Option<Reheated>> {
    let mut warmest: Vec<Option<Reheated>> = vec![None; results.len()];
    let Setting::Thermoplastic(plastic) = &job.material.setting else { return warmest };
    for contact in contacts {
        let [later, earlier] = contact.orders;
        let age_s = age_s(deposit, contact, results);
        let found = at_contact(job, plastic, contact, [&results[later], &results[earlier]], age_s);
        let known = &mut warmest[earlier];
        if known.is_none_or(|known| found.peak_k.nominal > known.peak_k.nominal) {
            *known = Some(found);
        }
    }
    warmest
}

/// Age of the earlier strand where the later one touches it, as that happens, s.
pub(super) fn age_s(deposit: &Deposit, contact: &Contact, results: &[StrandResult]) -> f64 {
    let time_s = |which: usize| {
        let order = contact.orders[which];
        deposit.strands[order].born_s + results[order].course.time_at_s(contact.at_m[which])
    };
    (time_s(0) - time_s(1)).max(0.0)
}

fn at_contact(
    job: &Job,
    plastic: &Thermoplastic,
    contact: &Contact,
    [later, earlier]: [&StrandResult; 2],
    age_s: f64,
) -> Reheated {
    let material = &job.material;
    let at_end = contact.at_m[0] > later.input.length_m - later.outcome.hot_diameter_m;
    let diameter_m = earlier.outcome.bead_diameter_m.nominal;
    let gap_m = (contact.axes_m() - diameter_m / 2.0).max(0.0);
    let air = &later.input.air;
    let at = |corner: Corner| {
        // The slow corner of cooling is the warm one.
        let laid = cooling(&earlier.input, material, plastic, corner);
        let (gap_share, warmth) = match corner {
            Corner::Nominal => (1.0, TIP_EMISSIVITY.nominal),
            Corner::Fast => (1.5, TIP_EMISSIVITY.low),
            Corner::Slow => (0.5, TIP_EMISSIVITY.high),
        };
        let tip = HotTip {
            temperature_k: plastic.extrusion_k.nominal,
            radius_m: face_radius_m(&job.cell.tool),
            emissivity: warmth,
        };
        let start_k = laid.temperature_k(age_s);
        let emissivity = material.emissivity.nominal;
        let h =
            |air_m_s| total_h_w_m2k(diameter_m, start_k, air.temperature_k, air_m_s, emissivity);
        let jet = (air.jet_reach_m() > 0.0 && corner != Corner::Slow).then(|| WarmJet {
            temperature_k: air.temperature_k,
            reach_m: air.jet_reach_m(),
            h_w_m2k: h(air.mean_jet_m_s(corner)),
        });
        let neighbour = Neighbour {
            start_k,
            glass_k: plastic.glass_k.nominal,
            diameter_m,
            length_m: earlier.input.length_m,
            heat_capacity_j_m3k: material.density_kg_m3.nominal * material.cp_j_kgk.nominal,
            emissivity,
            air_k: air.temperature_k,
            room_h_w_m2k: h(air.room_m_s).max(radiation_h_w_m2k(
                emissivity,
                start_k,
                air.temperature_k,
            )),
        };
        let passing = Passing {
            gap_m: gap_share * gap_m,
            speed_m_s: later.input.speed_m_s,
            dwell_s: if at_end { later.input.dwell_s } else { 0.0 },
            way: Way::Across,
        };
        reheat(&tip, jet.as_ref(), &neighbour, &passing)
    };
    let (nominal, low, high) = (at(Corner::Nominal), at(Corner::Fast), at(Corner::Slow));
    let range = |of: fn(&crate::process::reheat::Reheat) -> f64| {
        Interval::new(of(&nominal), of(&low), of(&high))
    };
    Reheated {
        peak_k: range(|r| r.peak_k),
        above_glass_s: range(|r| r.above_glass_s),
        softened_m: range(|r| r.length_m),
        at_m: contact.at_m[1],
        by: later.strand,
    }
}

/// Radius of the nozzle's face, m: of that end of its cones and capsules that is nearest to the orifice; of other
/// shapes nothing is known, and the orifice stands for it.
fn face_radius_m(tool: &Tool) -> f64 {
    let shapes = tool.parts.iter().filter(|part| part.nozzle).flat_map(|part| &part.shapes);
    let ends = shapes.flat_map(|shape| match shape {
        Shape::Cone { from, to, radius_from_m, radius_to_m } => {
            vec![(*from, *radius_from_m), (*to, *radius_to_m)]
        }
        Shape::Capsule { a, b, radius_m } => vec![(*a, *radius_m), (*b, *radius_m)],
        Shape::Box { .. } | Shape::Hull { .. } | Shape::Mesh { .. } => Vec::new(),
    });
    let off_m = |point: &Point| point.coords.norm();
    let nearest = ends.min_by(|a, b| off_m(&a.0).total_cmp(&off_m(&b.0)));
    nearest.map_or(0.5 * tool.orifice_m, |(_, radius_m)| radius_m).max(0.5 * tool.orifice_m)
}
