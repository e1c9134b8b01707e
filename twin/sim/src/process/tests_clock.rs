//! Setting by the clock against closed forms and the validation cases.

use proptest::prelude::*;

use super::clock::{Clock, MeltLife, Mixed, Thickening, age_at_nozzle_s, least_flow_m3_s};
use super::cure::set_distance_m;
use super::cured::{Exposed, cure};
use super::kamal::Kamal;
use super::sag::Fluidity;
use super::tests::{close, within};
use super::tests_kinetics::acrylate;

/// A slow resin: half a minute to set, ten to go off in the mixer would be another; 25 °C.
fn clock() -> Clock {
    Clock { set_time_s: 40.0, pot_life_s: 90.0, activation_j_mol: 50e3, reference_k: 298.15 }
}

#[test]
fn laarman_set() {
    // 0.3 s behind the nozzle at 20 cm/min is 1 mm, whatever the mixer holds
    let speed_m_s = 0.2 / 60.0;
    for residence_s in [0.0, 0.05, 2.0] {
        let clock = Clock { activation_j_mol: 0.0, ..clock() };
        let clock = clock.seen_behind_nozzle(0.3, residence_s);
        let set_s = clock.set_after_nozzle_s(residence_s, 298.15, 298.15);
        within(set_s, 0.3, 1e-12);
        close(set_distance_m(0.0, speed_m_s, set_s), 1e-3, 1e-9);
        let curve = clock.kamal(acrylate()).curve();
        let mixed = Mixed { clock, curve: &curve, residence_s, mixer_k: 298.15, strand_k: 298.15 };
        within(mixed.degree(0.3), 0.15, 1e-6);
        assert!(mixed.degree(0.29) < 0.15 && mixed.degree(0.31) > 0.15);
    }
}

#[test]
fn warm_resin_sets_sooner() {
    let clock = clock();
    // exp(50e3/8.314 (1/298.15 − 1/308.15)) = 1.9246
    close(clock.speed(308.15), 1.924_6, 1e-3);
    let cold_s = clock.set_after_nozzle_s(10.0, 298.15, 298.15);
    close(cold_s, 30.0, 1e-12);
    close(clock.set_after_nozzle_s(10.0, 298.15, 308.15), 30.0 / clock.speed(308.15), 1e-12);
    let warm_mixer_s = clock.set_after_nozzle_s(10.0, 308.15, 298.15);
    close(warm_mixer_s, 40.0 - 10.0 * clock.speed(308.15), 1e-12);
    assert_eq!(clock.set_after_nozzle_s(40.0, 298.15, 298.15), 0.0); // sets in the mixer
    assert_eq!(clock.set_after_nozzle_s(1.0, 298.15, 0.0), f64::INFINITY);
    // the same as a history of heat alone
    let kinetics = clock.kinetics(acrylate());
    let at = |age_s, temperature_k| Exposed { age_s, irradiance_w_m2: 1.0, temperature_k };
    let history = [at(-10.0, 308.15), at(0.0, 308.15), at(0.0, 298.15), at(60.0, 298.15)];
    let curve = kinetics.kamal.curve();
    let cured = cure(&kinetics, &curve, &history, None);
    let mixed =
        Mixed { clock, curve: &curve, residence_s: 10.0, mixer_k: 308.15, strand_k: 298.15 };
    for age_s in [0.0, 3.0, 20.0, 60.0] {
        within(mixed.degree(age_s), cured.at(age_s), 1e-12);
    }
    close(cured.gel_age_s, warm_mixer_s, 1e-9);
}

#[test]
fn idle_time() {
    // 0.3 ml in the mixer at 20 mm³/s: 15 s old at the nozzle, 75 s may pass
    let residence_s = age_at_nozzle_s(3e-7, 20e-9);
    close(residence_s, 15.0, 1e-12);
    close(clock().longest_idle_s(residence_s, 298.15), 75.0, 1e-12);
    // at 35 °C the pot life is 46.8 s
    close(clock().longest_idle_s(residence_s, 308.15), 90.0 / clock().speed(308.15) - 15.0, 1e-12);
    // at the least flow nothing is left, below it the mixer blocks while running
    let least = least_flow_m3_s(3e-7, 90.0);
    within(clock().longest_idle_s(age_at_nozzle_s(3e-7, least), 298.15), 0.0, 1e-12);
    assert!(clock().longest_idle_s(age_at_nozzle_s(3e-7, 0.9 * least), 298.15) < 0.0);
    assert_eq!(clock().longest_idle_s(age_at_nozzle_s(3e-7, 0.0), 298.15), f64::NEG_INFINITY);
    // a melt: 10 min at 240 °C, hotter is shorter
    let melt = MeltLife { life_s: 600.0, activation_j_mol: 120e3, reference_k: 513.15 };
    close(melt.longest_idle_s(30.0, 513.15), 570.0, 1e-12);
    assert!(melt.longest_idle_s(30.0, 533.15) < 300.0);
    assert_eq!(melt.longest_idle_s(30.0, -5.0), f64::INFINITY);
}

#[test]
fn it_thickens_to_the_gel_point() {
    let law = Thickening { viscosity_pa_s: 20.0, gel: 0.15, a: 1.5, b: 1.0 };
    close(law.viscosity_pa_s(0.0), 20.0, 1e-15);
    close(law.viscosity_pa_s(0.075), 20.0 * 2.0_f64.powf(1.575), 1e-12);
    assert_eq!(law.viscosity_pa_s(0.15), f64::INFINITY);
    let curve = clock().kamal(acrylate()).curve();
    let mixed = Mixed {
        clock: clock(),
        curve: &curve,
        residence_s: 15.0,
        mixer_k: 298.15,
        strand_k: 298.15,
    };
    // without thickening it is the constant fluid of the sag laws, with it less
    let flat = Thickening { a: 0.0, b: 0.0, ..law };
    let (constant, thick) = (mixed.fluidity(&flat, 3600.0), mixed.fluidity(&law, 3600.0));
    let want = Fluidity::constant(20.0, 25.0);
    for n in 0..5 {
        close(constant.moments[n], want.moments[n], 1e-9);
        assert!(thick.moments[n] < constant.moments[n]);
    }
    // closed: first order alone, α = 1 − e^(−kt), a = 1: ∫ (1 − α/α_gel) dt from the nozzle to the gel point
    let first = Kamal { m: 0.0, n: 1.0, k1_per_s: 1.0, k2_per_s: 0.0, gel: 0.15, max: 1.0 };
    let curve = clock().kamal(first).curve();
    let mixed = Mixed { curve: &curve, ..mixed };
    let k = -(0.85_f64.ln()) / 40.0;
    let left = (-k * 15.0_f64).exp() - 0.85;
    let area_s = 25.0 * (1.0 - 1.0 / 0.15) + (left + 0.0) / (0.15 * k);
    let simple = Thickening { a: 1.0, b: 0.0, ..law };
    close(mixed.fluidity(&simple, 3600.0).moments[0], area_s / 60.0, 1e-9);
    // a strand that leaves the mixer set does not flow, one that never sets is cut off
    let set = Mixed { residence_s: 50.0, ..mixed };
    assert_eq!(set.fluidity(&law, 3600.0).moments, [0.0; 5]);
    let frozen = Mixed { strand_k: 1.0, ..mixed };
    assert!(frozen.fluidity(&flat, 3600.0).moments.iter().all(|moment| moment.is_finite()));
}

#[test]
fn quadrature_of_the_thickening_converges() {
    let curve = clock().kamal(acrylate()).curve();
    let mixed = Mixed {
        clock: clock(),
        curve: &curve,
        residence_s: 15.0,
        mixer_k: 298.15,
        strand_k: 298.15,
    };
    for (a, b) in [(1.0, 0.0), (1.5, 1.0), (2.0, 2.0), (0.5, 0.0)] {
        let law = Thickening { viscosity_pa_s: 20.0, gel: 0.15, a, b };
        let fluid = |age: f64| 1.0 / (3.0 * law.viscosity_pa_s(mixed.degree(age)));
        let fine = Fluidity::integrate(fluid, &[0.0, 25.0], 4000);
        let got = mixed.fluidity(&law, 3600.0);
        for n in 0..5 {
            close(got.moments[n], fine.moments[n], 1e-5);
        }
    }
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![any::<f64>(), -1.0..3.0, 0.0..1e3, Just(0.0), Just(f64::NAN), Just(f64::INFINITY)]
}

proptest! {
    #[test]
    fn any_clock_is_bounded(v in prop::array::uniform10(any_number())) {
        let clock = Clock {
            set_time_s: v[0],
            pot_life_s: v[1],
            activation_j_mol: v[2],
            reference_k: v[3],
        };
        let curve = clock.kamal(acrylate()).curve();
        let mixed = Mixed { clock, curve: &curve, residence_s: v[4], mixer_k: v[5], strand_k: v[6] };
        prop_assert!((0.0..=0.8).contains(&mixed.degree(v[7])));
        let law = Thickening { viscosity_pa_s: v[8], gel: 0.15, a: v[9], b: v[7] };
        let _ = (mixed.fluidity(&law, 3600.0), clock.longest_idle_s(v[4], v[5]));
        let _ = age_at_nozzle_s(v[8], v[9]);
    }
}

#[test]
fn a_strand_sets_by_the_clock_of_its_mixer_where_the_material_tells() {
    use super::history::{Corner, clock_set_s};
    use super::kinetics::arrhenius;
    use super::tests_strand::{strand, two_part};
    use super::*;
    use crate::interval::Interval;
    let Setting::TwoPart(seen) = two_part().setting else { panic!("two parts") };
    let set_s = |input: &StrandInput, mix: &TwoPart| {
        Corner::interval(|corner| clock_set_s(input, mix, corner))
    };
    let mixed = StrandInput { mixer_m3: 63.3e-9, ..strand() }; // 10 s at 6.33 mm³/s
    let residence_s = age_at_nozzle_s(mixed.mixer_m3, mixed.flow_m3_s);
    // without the clock's numbers, mixer and air change nothing, to the bit
    assert_eq!(simulate(&mixed, &two_part()), simulate(&strand(), &two_part()));
    assert_eq!(set_s(&mixed, &seen), seen.set_time_s);
    assert_eq!(
        set_s(&mixed, &TwoPart { reference_k: Some(300.0), ..seen.clone() }),
        seen.set_time_s
    );
    // with them it is the clock's, and at the reference with no mixer the set time itself
    let air_k = strand().air.temperature_k;
    let told = TwoPart {
        set_time_s: Interval::new(40.0, 30.0, 60.0),
        activation_j_mol: Some(Interval::new(50e3, 40e3, 60e3)),
        reference_k: Some(298.15),
        ..seen
    };
    let at_reference = TwoPart { reference_k: Some(air_k), ..told.clone() };
    assert_eq!(set_s(&strand(), &at_reference), told.set_time_s);
    let got = set_s(&mixed, &told);
    close(got.nominal, 40.0 / arrhenius(50e3, 298.15, air_k) - residence_s, 1e-12);
    // 22 °C is below the reference: the greater activation energy is the slower one
    close(got.high, 60.0 / arrhenius(60e3, 298.15, air_k) - residence_s, 1e-12);
    close(got.low, 30.0 / arrhenius(40e3, 298.15, air_k) - residence_s, 1e-12);
    let material = Material { setting: Setting::TwoPart(told.clone()), ..two_part() };
    let out = simulate(&mixed, &material);
    assert_eq!(out.set_time_s, got);
    assert!(out.laws.contains(&"Arrhenius clock"));
    close(History::new(&mixed, &material).modulus_pa(got.nominal * 1.001), 1.6e9, 1e-12);
    assert_eq!(History::new(&mixed, &material).modulus_pa(got.nominal * 0.999), 0.0);
    // a mixer too large for the flow: it comes out set and does not sag
    let slow = StrandInput { mixer_m3: 1e-6, ..mixed };
    assert_eq!(set_s(&slow, &told), Interval::exact(0.0));
    assert_eq!(simulate(&slow, &material).sag_nozzle_m.nominal, 0.0);
}
