//! What one section does in one step.

use super::ends::determinate;
use super::sections::{Load, Section};
use super::step::Interval;
use super::{Elastic, Hold, Strand};

/// What one section can do in a step: its curvature at the end is
/// `set + flow (M_mid + M0 + V0 arm) + spring (M_end + M0' + V0' reach − was)`, primes at the end of the step.
#[derive(Clone, Copy, Default)]
pub(super) struct Share {
    pub(super) flow: f64,
    pub(super) stretch: f64,
    pub(super) arm_m: f64,
    pub(super) load: Load,
    pub(super) spring: f64,
    pub(super) spring_stretch: f64,
    pub(super) reach_m: f64,
    pub(super) end: Load,
    /// Moment already sprung to, where the modulus acts by rate.
    pub(super) was: [f64; 2],
    pub(super) was_pull: f64,
    /// One for a section born in this step where the modulus acts by rate: it comes out under M0 and N.
    pub(super) newborn: f64,
    /// Share of the flow that the yield stress leaves.
    pub(super) yields: f64,
}

/// Flow of a section over the step; `arm_m` is how much farther on the nozzle is at the middle of its flow.
pub(super) fn flow(
    strand: &Strand,
    section: &mut Section,
    time: &Interval,
    hold: Hold,
    share: &mut Share,
) {
    let ageing = &strand.ageing;
    let from_s = (time.from_s - section.birth_s).max(0.0);
    let to_s = time.to_s - section.birth_s;
    (share.flow, share.stretch, share.arm_m, share.yields) = (0.0, 0.0, 0.0, 1.0);
    if let Some(curvature) = ageing.free_curvature_per_m {
        let (was, is) = (curvature(section.element, from_s), curvature(section.element, to_s));
        for i in 0..2 {
            section.set[i] += is[i] - was[i];
        }
    }
    if from_s >= ageing.rigid_s {
        return;
    }
    let middle_s = 0.5 * (from_s + to_s);
    let middle = (ageing.compliance_per_pa)(section.element, middle_s);
    let end = (ageing.compliance_per_pa)(section.element, to_s);
    let (early, late) = (middle - section.compliance, end - middle);
    let compliance = (end - section.compliance).max(0.0);
    section.compliance = end;
    share.flow = compliance * section.per_inertia;
    share.stretch = compliance * section.per_area;
    if !determinate(hold) && compliance > 0.0 && time.to_s > time.from_s {
        let quarter_s = 0.25 * (to_s - from_s);
        let flows_s = section.birth_s + middle_s + quarter_s * (late - early) / compliance;
        let speed_m_s = (time.to_m - time.from_m) / (time.to_s - time.from_s);
        share.arm_m = speed_m_s * (flows_s - 0.5 * (time.from_s + time.to_s));
    }
}

pub(super) fn spring(strand: &Strand, section: &Section, time: &Interval, share: &mut Share) {
    let Some(modulus) = strand.ageing.modulus_pa else { return };
    let springs = |age_s: f64| {
        let pa = modulus(section.element, age_s.max(0.0));
        if pa > 0.0 && pa.is_finite() { 1.0 / pa } else { 0.0 }
    };
    let to_s = time.to_s - section.birth_s;
    share.reach_m = time.to_m - section.at_m;
    (share.was, share.was_pull, share.newborn) = ([0.0; 2], 0.0, 0.0);
    let softness = match strand.ageing.elastic {
        Elastic::Total => springs(to_s),
        Elastic::Rate => {
            match section.last {
                Some((moment, pull)) => (share.was, share.was_pull) = (moment, pull),
                None => share.newborn = 1.0,
            }
            springs(to_s - 0.5 * to_s.min(time.to_s - time.from_s))
        }
    };
    share.spring = softness * section.per_inertia;
    share.spring_stretch = softness * section.per_area;
}
