//! One step in time.

use super::ends::{
    Place, Redundants, Sums, both_held, by_equilibrium, by_place, determinate, settle,
};
use super::sections::{Load, Piece, Section, loads, weight};
use super::share::{Share, flow, spring};
use super::{Elastic, Hold, Strand};

/// From when to when, and where the nozzle is then.
pub(super) struct Interval {
    pub(super) from_s: f64,
    pub(super) to_s: f64,
    pub(super) from_m: f64,
    pub(super) to_m: f64,
}

/// Room for a step, kept between steps, and the redundants before.
#[derive(Default)]
pub(super) struct Room {
    middle: Vec<Load>,
    end: Vec<Load>,
    shares: Vec<Share>,
    /// Redundants of the step before and its length, where the same ends held.
    pub(super) before: Option<(Redundants, f64)>,
}

/// Iterations on what yields, and the share that flows at least (so that the redundants stay finite).
const YIELD_ROUNDS: usize = 40;
const LEAST_FLOW: f64 = 1e-6;

/// Steps the born sections of `pieces`, in time linear in their number; returns the redundants.
///
/// Flow: the redundants are constant over the step and such that the ends are in place at its end; each section
/// takes its moment at the middle of its flow, by age. Spring: the redundants at the end are carried on from the
/// steps' middles (BDF2's damping; the first step of a phase takes its own). Second order both.
pub(super) fn step(
    strand: &Strand,
    pieces: &[Piece],
    sections: &mut [Section],
    time: &Interval,
    hold: Hold,
    place: &mut Place,
    room: &mut Room,
) -> Redundants {
    let (middle_s, middle_m) = (0.5 * (time.from_s + time.to_s), 0.5 * (time.from_m + time.to_m));
    let gravity = (strand.gravity_m_s2)(middle_s);
    let far = loads(strand, pieces, sections, middle_m, gravity, &mut room.middle);
    let mut ending = None;
    if strand.ageing.modulus_pa.is_some() {
        let gravity = (strand.gravity_m_s2)(time.to_s);
        let far = loads(strand, pieces, sections, time.to_m, gravity, &mut room.end);
        ending = determinate(hold).then(|| by_equilibrium(hold, &far, time.to_m));
    }
    let newest = pieces.last().map_or([0.0; 3], |p| weight(strand, p.element, gravity));
    room.shares.resize(sections.len(), Share::default());
    for (i, (section, share)) in sections.iter_mut().zip(&mut room.shares).enumerate() {
        flow(strand, section, time, hold, share);
        if share.flow == 0.0 && strand.ageing.modulus_pa.is_none() {
            continue; // rigid: its load does nothing
        }
        // the nozzle is farther on, or less far, when this section flows than in the middle of the step
        let (arm_m, on_m) = (middle_m - section.at_m, share.arm_m);
        share.load = room.middle[i];
        for (k, moment) in share.load.moment.iter_mut().enumerate() {
            *moment += newest[k] * on_m * (arm_m + 0.5 * on_m);
        }
        share.load.pull += newest[2] * on_m;
        share.arm_m = arm_m + on_m;
        if strand.ageing.modulus_pa.is_some() {
            share.end = room.end[i];
            spring(strand, section, time, share);
        }
    }
    let carry = match room.before {
        Some((_, before_s)) => (time.to_s - time.from_s) / (time.to_s - time.from_s + before_s),
        None => 0.0,
    };
    let before = room.before.map_or_else(Redundants::default, |(redundants, _)| redundants);
    let end_of = |now: &Redundants| {
        let carried = carried(now, &before, carry);
        match ending {
            // between two hinges the pull still follows from place
            Some(known) if both_held(hold) => Redundants { pull: carried.pull, ..known },
            Some(known) => known,
            None => carried,
        }
    };
    let from = end_of(&Redundants::default());
    let mut now = Redundants::default();
    let rounds =
        if strand.elements.iter().any(|e| e.yield_moment_n_m > 0.0 || e.yield_force_n > 0.0) {
            YIELD_ROUNDS
        } else {
            1
        };
    for round in 0..rounds {
        let sums = sum(sections, &room.shares, time.to_m, &from, 1.0 + carry);
        now = by_place(hold, &sums, place, &far, middle_m, time.to_m);
        if round + 1 < rounds && !yields(strand, sections, &mut room.shares, &now) {
            break;
        }
    }
    let end = end_of(&now);
    let sums = finish(strand, sections, &room.shares, &now, &end, time.to_m);
    settle(hold, sums.turn.constant, sums.drop.constant, time.to_m, place);
    if hold.far == super::End::Free {
        place.far_along = place.near_along - sums.stretch;
    } else if hold.near == super::End::Free {
        place.near_along = place.far_along + sums.stretch;
    }
    room.before = Some((now, time.to_s - time.from_s));
    now
}

/// Redundants at the end of the step from those of two steps.
fn carried(now: &Redundants, before: &Redundants, carry: f64) -> Redundants {
    let on = |now: f64, before: f64| now + carry * (now - before);
    Redundants {
        moment: [0, 1].map(|i| on(now.moment[i], before.moment[i])),
        shear: [0, 1].map(|i| on(now.shear[i], before.shear[i])),
        pull: on(now.pull, before.pull),
    }
}

/// Sums over the sections; `from` are the redundants at the end for none now, `reach` how they grow with those.
fn sum(sections: &[Section], shares: &[Share], end_m: f64, from: &Redundants, reach: f64) -> Sums {
    let mut sums = Sums::default();
    for (section, share) in sections.iter().zip(shares) {
        let (flow, spring) = (share.flow * share.yields, share.spring);
        if flow == 0.0 && spring == 0.0 {
            for i in 0..2 {
                let constant = section.weight_m * section.set[i];
                sums.turn.constant[i] += constant;
                sums.drop.constant[i] += constant * (end_m - section.at_m);
            }
            sums.stretch += section.weight_m * section.set_strain;
            continue;
        }
        let by_moment = section.weight_m * (flow + spring * (reach - share.newborn));
        let by_shear = section.weight_m * (flow * share.arm_m + spring * share.reach_m * reach);
        let arm_m = end_m - section.at_m;
        for i in 0..2 {
            let sprung =
                share.end.moment[i] + from.moment[i] + share.reach_m * from.shear[i] - share.was[i];
            let constant =
                section.weight_m * (section.set[i] + flow * share.load.moment[i] + spring * sprung);
            sums.turn.constant[i] += constant;
            sums.drop.constant[i] += constant * arm_m;
        }
        sums.turn.by_moment += by_moment;
        sums.turn.by_shear += by_shear;
        sums.drop.by_moment += by_moment * arm_m;
        sums.drop.by_shear += by_shear * arm_m;
        let stretch = share.stretch * share.yields;
        let sprung = share.end.pull + from.pull - share.was_pull;
        sums.stretch += section.weight_m
            * (section.set_strain + stretch * share.load.pull + share.spring_stretch * sprung);
        sums.stretch_by_pull +=
            section.weight_m * (stretch + share.spring_stretch * (reach - share.newborn));
    }
    sums
}

/// How much of each section's flow its yield stress leaves: `1 − 1/u`, `u = |M|/M_y + |N|/N_y`, half way from
/// what was taken. Returns whether it still changes.
fn yields(strand: &Strand, sections: &[Section], shares: &mut [Share], now: &Redundants) -> bool {
    let mut changes = false;
    for (section, share) in sections.iter().zip(shares) {
        let element = &strand.elements[section.element];
        let moment =
            [0, 1].map(|i| share.load.moment[i] + now.moment[i] + now.shear[i] * share.arm_m);
        let mut used = 0.0;
        if element.yield_moment_n_m > 0.0 {
            used += moment[0].hypot(moment[1]) / element.yield_moment_n_m;
        }
        if element.yield_force_n > 0.0 {
            used += (share.load.pull + now.pull).abs() / element.yield_force_n;
        }
        if element.yield_moment_n_m > 0.0 || element.yield_force_n > 0.0 {
            let leaves = (1.0 - 1.0 / used).max(LEAST_FLOW);
            changes |= (leaves - share.yields).abs() > 1e-7;
            share.yields = 0.5 * (leaves + share.yields);
        }
    }
    changes
}

/// Curvature and strain at the end of the step, and their sums.
fn finish(
    strand: &Strand,
    sections: &mut [Section],
    shares: &[Share],
    now: &Redundants,
    end: &Redundants,
    end_m: f64,
) -> Sums {
    let mut sums = Sums::default();
    let rate = strand.ageing.elastic == Elastic::Rate;
    let springs = strand.ageing.modulus_pa.is_some();
    for (section, share) in sections.iter_mut().zip(shares) {
        let arm_m = end_m - section.at_m;
        let flow = share.flow * share.yields;
        if flow == 0.0 && share.spring == 0.0 && !springs {
            section.curvature = section.set;
            section.strain = section.set_strain;
        } else {
            let mut last = ([0.0; 2], share.end.pull + end.pull);
            for i in 0..2 {
                let moment = share.load.moment[i] + now.moment[i] + now.shear[i] * share.arm_m;
                section.set[i] += flow * moment;
                last.0[i] = share.end.moment[i] + share.reach_m * end.shear[i] + end.moment[i];
                let sprung =
                    share.spring * (last.0[i] - share.was[i] - share.newborn * now.moment[i]);
                section.curvature[i] = section.set[i] + sprung;
            }
            section.set_strain += share.stretch * share.yields * (share.load.pull + now.pull);
            let sprung = last.1 - share.was_pull - share.newborn * now.pull;
            section.strain = section.set_strain + share.spring_stretch * sprung;
            section.last = Some(last);
            if rate {
                section.set = section.curvature;
                section.set_strain = section.strain;
            }
        }
        for i in 0..2 {
            let turn = section.weight_m * section.curvature[i];
            sums.turn.constant[i] += turn;
            sums.drop.constant[i] += turn * arm_m;
        }
        sums.stretch += section.weight_m * section.strain;
    }
    sums
}
