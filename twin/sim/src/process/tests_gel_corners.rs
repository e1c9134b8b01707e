//! The sag of a gel strand: its corners, and what they say they used.

use proptest::prelude::*;

use super::history::Corner;
use super::soft::{nozzle_sag, offset};
use super::tests_strand::{gel_strand, resin, ring};
use super::*;
use crate::interval::Interval;

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

fn known() -> Material {
    let flow = GelFlow {
        consistency_pa_sn: Interval::new(20.0, 5.0, 80.0),
        index: Interval::new(0.5, 0.3, 0.7),
        recovery_s: Interval::new(5.0, 1.0, 60.0),
    };
    photopolymer(|resin| resin.flow = Some(flow))
}

#[test]
fn recovery_is_of_the_slow_corner() {
    let with = |recovery_s: f64| {
        let mut material = known();
        if let Setting::Photopolymer(resin) = &mut material.setting {
            resin.yield_stress_pa = Interval::exact(60.0);
            resin.flow = resin
                .flow
                .map(|flow| GelFlow { recovery_s: Interval::new(0.01, 0.01, recovery_s), ..flow });
        }
        sag_m(&gel_strand(), &material)
    };
    let (quick, slow) = (with(0.01), with(60.0));
    assert_eq!((quick.nominal, quick.low), (0.0, 0.0));
    assert_eq!((slow.nominal, slow.low), (0.0, 0.0));
    assert!(slow.high > 1e-3 && quick.high < 1e-6, "{quick:?} {slow:?}");
}

#[test]
fn outcomes_say_what_they_used() {
    let known = known();
    let recovers = "gel recovery after the nozzle (slow corner)";
    assert!(simulate(&gel_strand(), &known).laws.contains(&recovers));
    assert!(!simulate(&gel_strand(), &resin()).laws.contains(&recovers));
    // nothing flows on a bed
    let resting = StrandInput { ends: Ends::Resting, ..gel_strand() };
    assert!(!simulate(&resting, &known).laws.iter().any(|law| law.contains("behind the nozzle")));
}

proptest! {
    #[test]
    fn corners_are_in_order(
        yield_pa in 0.0..40.0_f64, k in 1.0..40.0_f64, n in 0.3..0.9_f64, spread in 1.0..2.0_f64,
        span_m in 1e-3..0.05_f64, speed_m_s in 1e-3..0.02_f64, start_held: bool, told: bool, dark: bool,
    ) {
        let range = |x: f64| Interval::new(x, x / spread, x * spread);
        let material = photopolymer(|resin| {
            resin.yield_stress_pa = range(yield_pa);
            resin.base_viscosity_pa_s = range(k);
            resin.flow = told.then_some(GelFlow {
                consistency_pa_sn: range(k),
                index: Interval::new(n, n / spread.sqrt(), n * spread.sqrt()),
                recovery_s: range(5.0),
            });
        });
        let input = StrandInput {
            ends: if start_held { Ends::StartHeld } else { Ends::BothHeld },
            light: (!dark).then_some(ring()),
            flow_m3_s: bead::flow_m3_s(2e-3, speed_m_s),
            speed_m_s,
            span_m,
            ..gel_strand()
        };
        let heats = Heats::new(&input, &material);
        let [fast, nominal, slow] = [Corner::Fast, Corner::Nominal, Corner::Slow]
            .map(|corner| offset(&input, &material, &heats, corner).0);
        prop_assert!(fast <= nominal * (1.0 + 1e-6) && nominal <= slow * (1.0 + 2e-3), "{fast} {nominal} {slow}");
    }
}
