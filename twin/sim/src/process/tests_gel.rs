//! Gels behind the nozzle: the Newtonian closed forms, limits, and the corners of a strand.

use super::gel_sag::{FreshGel, GelStrand};
use super::sag::{Fluidity, SoftBeam};
use super::soft::nozzle_sag;
use super::tests::close;
use super::tests_strand::{gel_strand, resin, ring};
use super::yield_stress::HerschelBulkley;
use super::*;
use crate::interval::Interval;

const WEIGHT: f64 = 1130.0 * 9.81;

fn bingham(yield_pa: f64) -> HerschelBulkley {
    HerschelBulkley { yield_pa, consistency_pa_sn: 0.3, index: 1.0 }
}

/// A 3 mm strand at 5 mm/s, set after 2 s: a soft zone of 10 mm.
fn strand(gel: FreshGel, span_m: f64) -> GelStrand {
    GelStrand { gel, diameter_m: 3e-3, weight_n_m3: WEIGHT, speed_m_s: 5e-3, span_m, until_s: 2.0 }
}

fn photopolymer(change: impl Fn(&mut Photopolymer)) -> Material {
    let mut material = resin();
    if let Setting::Photopolymer(resin) = &mut material.setting {
        change(resin);
    }
    material
}

fn sag_m(input: &StrandInput, material: &Material) -> Interval {
    nozzle_sag(input, material, &Heats::new(input, material)).offset_m
}

#[test]
fn no_yield_stress_and_no_weight_is_no_sag() {
    let watery = photopolymer(|resin| resin.yield_stress_pa = Interval::exact(0.0));
    for ends in [Ends::BothHeld, Ends::StartHeld] {
        for light in [None, Some(ring())] {
            let input = StrandInput { gravity_across_m_s2: 0.0, light, ends, ..gel_strand() };
            assert_eq!(sag_m(&input, &watery), Interval::exact(0.0));
        }
    }
}

#[test]
fn without_yield_stress_it_is_the_newtonian() {
    let fluidity = Fluidity::constant(0.3, 2.0);
    // shorter than the zone, about as long, and where the span no longer matters
    for span_m in [4e-3, 8e-3, 11e-3, 15e-3, 40e-3] {
        let beam = SoftBeam {
            diameter_m: 3e-3,
            density_kg_m3: 1130.0,
            across_m_s2: 9.81,
            speed_m_s: 5e-3,
            span_m,
        };
        let gel = strand(FreshGel::rested(bingham(0.0)), span_m);
        close(gel.clamped_sag_m(), beam.clamped_sag_m(fluidity), 1e-9);
        close(gel.tip_drop_m(), beam.tip_drop_m(fluidity), 1e-9);
        // the bound of a short span is 1/184.6 as printed, and its place is found to a node
        close(gel.hinged_sag_m(), beam.hinged_sag_m(fluidity), 2e-3);
        close(gel.shear_sag_m(), beam.shear_sag_m(0.3, 2.0), 1e-12);
    }
    let gel = strand(FreshGel::rested(bingham(0.0)), 0.04);
    let inertia_m4 = sag::inertia_m4(3e-3);
    let line = WEIGHT * std::f64::consts::PI / 4.0 * 9e-6;
    close(gel.hinged_sag_m(), line * 1e-10 / (360.0 * 0.3 * inertia_m4 * 5e-3), 1e-9);
    // and comes to it as the yield stress goes
    let off = |yield_pa: f64| {
        let gel = strand(FreshGel::rested(bingham(yield_pa)), 0.04);
        [gel.clamped_sag_m(), gel.hinged_sag_m(), gel.tip_drop_m(), gel.shear_sag_m()]
    };
    let (none, little, less) = (off(0.0), off(1e-2), off(1e-3));
    for k in 0..4 {
        let ratio = (none[k] - little[k]) / (none[k] - less[k]);
        assert!((9.0..11.0).contains(&ratio), "{k}: {ratio}");
    }
}

#[test]
fn outcomes_say_what_they_used() {
    let flow = GelFlow {
        consistency_pa_sn: Interval::new(20.0, 5.0, 80.0),
        index: Interval::new(0.5, 0.3, 0.7),
        recovery_s: Interval::new(5.0, 1.0, 60.0),
    };
    let known = photopolymer(|resin| resin.flow = Some(flow));
    let recovers = "gel recovery after the nozzle (slow corner)";
    assert!(simulate(&gel_strand(), &known).laws.contains(&recovers));
    assert!(!simulate(&gel_strand(), &resin()).laws.contains(&recovers));
    println!("{:?} {:?}", sag_m(&gel_strand(), &known), sag_m(&gel_strand(), &resin()));
}
