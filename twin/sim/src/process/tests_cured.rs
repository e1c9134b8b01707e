//! Cure under any history of light, heat and oxygen against brute force.

use proptest::prelude::*;

use super::cured::{Exposed, cure};
use super::kamal::Kamal;
use super::kinetics::Kinetics;
use super::oxygen::{self, Oxygen, Reoxygenation};
use super::solid;
use super::tests::{close, within};
use super::tests_kinetics::{acrylate, at, brute_force, resin, run, steady};

#[test]
fn any_history_against_brute_force() {
    let kinetics = Kinetics { b: 0.6, ..resin(1.0) };
    let (dark, bright) = (0.0, 900.0);
    let history = [at(0.0, dark, 298.0), at(0.7, bright, 340.0), at(2.0, 300.0, 375.0)];
    let light = |t: f64| if t < 0.7 { bright * t / 0.7 } else { bright - 600.0 * (t - 0.7) / 1.3 };
    let heat = |t: f64| if t < 0.7 { 298.0 + 60.0 * t } else { 340.0 + 35.0 * (t - 0.7) / 1.3 };
    let rate = |t: f64, degree: f64| kinetics.rate_per_s(degree, light(t), heat(t));
    let cured = run(&kinetics, &history);
    // light and rate have corners at 0 and 0.7 s, so brute force comes in slowly
    let want = brute_force(rate, 2.0, 40_000);
    println!("history {} brute force {want}", cured.at(2.0));
    within(cured.at(2.0), want, 3e-6);
    let partial = brute_force(rate, 0.35, 40_000);
    within(cured.at(0.35), partial, 3e-6);
    // where all is smooth, brute force is of fourth order and meets the table
    let smooth = Kinetics { kamal: Kamal { m: 1.0, n: 1.0, ..kinetics.kamal }, b: 1.0, ..kinetics };
    let warming = [at(0.0, 200.0, 298.0), at(2.0, 300.0, 340.0)];
    let rate = |t: f64, d: f64| smooth.rate_per_s(d, 200.0 + 50.0 * t, 298.0 + 21.0 * t);
    let ends = [8, 16, 32].map(|steps| brute_force(rate, 0.4, steps));
    let order = ((ends[0] - ends[1]) / (ends[1] - ends[2])).abs().log2();
    assert!((order - 4.0).abs() < 0.3, "order {order}");
    let fine = brute_force(rate, 0.4, 4000);
    within(run(&smooth, &warming).at(0.4), fine, 1e-6);
}

#[test]
fn passes_and_split_steps_add() {
    let kinetics = resin(0.6);
    let passes = [
        at(0.0, 0.0, 298.15),
        at(0.5, 0.0, 298.15),
        at(0.5, 300.0, 298.15),
        at(0.7, 300.0, 298.15),
        at(0.7, 0.0, 298.15),
        at(30.0, 0.0, 298.15),
        at(30.0, 300.0, 298.15),
        at(30.6, 300.0, 298.15),
    ];
    let cured = run(&kinetics, &passes);
    assert!(cured.at(0.5) == 0.0 && cured.at(-1.0) == 0.0);
    within(cured.at(30.0), cured.at(0.7), 0.0); // in the dark nothing happens
    let at_once = run(&kinetics, &steady(300.0, 0.8));
    within(cured.at(1e6), at_once.at(0.8), 1e-12);
    within(cured.at(0.65), at_once.at(0.15), 1e-12);
    assert!(cured.gel_age_s > 30.0); // 300 W/m² for 0.2 s is not enough, the second pass is
    // A sample in the middle of a slope changes nothing.
    let slope = [at(0.0, 10.0, 300.0), at(2.0, 510.0, 350.0)];
    let split = [slope[0], at(0.8, 210.0, 320.0), slope[1]];
    let (one, two) = (run(&kinetics, &slope), run(&kinetics, &split));
    within(one.at(2.0), two.at(2.0), 1e-8);
    close(one.gel_age_s, two.gel_age_s, 1e-7);
    within(one.at(one.gel_age_s), 0.15, 1e-6);
    // A shift of all ages shifts the gel point.
    let later = split.map(|s| at(s.age_s + 5.0, s.irradiance_w_m2, s.temperature_k));
    close(run(&kinetics, &later).gel_age_s, two.gel_age_s + 5.0, 1e-12);
}

#[test]
fn a_share_of_the_light() {
    for b in [0.5, 0.6, 1.0] {
        let kinetics = resin(b);
        let history = [at(0.0, 0.0, 298.0), at(1.0, 700.0, 330.0), at(3.0, 90.0, 320.0)];
        let cured = run(&kinetics, &history);
        for share in [0.9, 0.3, 0.04, 0.0] {
            let dimmed =
                history.map(|s| Exposed { irradiance_w_m2: share * s.irradiance_w_m2, ..s });
            let whole = run(&kinetics, &dimmed);
            for age_s in [0.2, 0.9, 1.7, 3.0, 4.0] {
                within(cured.at_behind(age_s, share), whole.at(age_s), 1e-12);
            }
            let (behind, direct) = (cured.gel_age_behind_s(share), whole.gel_age_s);
            assert!(behind == direct || (behind - direct).abs() < 1e-9, "{behind} {direct}");
        }
    }
}

#[test]
fn heat_adds_up() {
    let kinetics = resin(0.6);
    let history =
        [at(0.0, 50.0, 298.0), at(0.4, 800.0, 310.0), at(1.5, 0.0, 360.0), at(2.0, 300.0, 330.0)];
    let cured = run(&kinetics, &history);
    let (density, enthalpy) = (1130.0, 330e3);
    for steps in [3_u32, 17, 2000] {
        let h = 2.0 / f64::from(steps);
        let stepped: f64 = (0..steps)
            .map(|i| (cured.at(f64::from(i) * h), cured.at(f64::from(i + 1) * h)))
            .map(|(a, b)| h * solid::cure_heat_w_m3(density, enthalpy, (b - a) / h))
            .sum();
        close(stepped, density * enthalpy * cured.at(2.0), 1e-12);
    }
    // and with the rate itself, which is a quadrature
    let light = |t: f64| match t {
        t if t < 0.4 => (50.0 + 750.0 * t / 0.4, 298.0 + 30.0 * t),
        t if t < 1.5 => (800.0 * (1.5 - t) / 1.1, 310.0 + 50.0 * (t - 0.4) / 1.1),
        t => (600.0 * (t - 1.5), 360.0 - 60.0 * (t - 1.5)),
    };
    let h = 2.0 / 20_000.0;
    let heat = |i: u32| {
        let age_s = (f64::from(i) + 0.5) * h;
        let (irradiance, kelvin) = light(age_s);
        let rate = kinetics.rate_per_s(cured.at(age_s), irradiance, kelvin);
        h * solid::cure_heat_w_m3(density, enthalpy, rate)
    };
    close((0..20_000).map(heat).sum(), density * enthalpy * cured.at(2.0), 1e-4);
    // 330e3 · 0.7/1800, about 130 K
    within(solid::adiabatic_rise_k(330e3, 0.7, 1800.0), 130.0, 2.0);
}

#[test]
fn oxygen_numbers_of_the_reference() {
    let oxygen = |penetration_m| Oxygen {
        dissolved_mol_m3: 1.5,
        diffusivity_m2_s: 1.08e-10,
        quantum_yield: 0.6,
        penetration_m,
        wavelength_m: 405e-9,
    };
    let (pr48, clear) = (oxygen(53e-6), oxygen(192e-6));
    within(pr48.dose_j_m2(), 39.0, 0.5); // 3.9 and 14.2 mJ/cm²
    within(clear.dose_j_m2(), 142.0, 0.5);
    let skin_m = clear.skin_m(210.0);
    assert!((10e-6..50e-6).contains(&skin_m), "{skin_m}");
    println!("skin {skin_m}");
    close(clear.skin_m(840.0), 0.5 * skin_m, 1e-12); // δ ~ Da^−½
    close(clear.damkohler(210.0, skin_m), oxygen::DAMKOHLER_ONSET, 1e-12);
    assert!(clear.damkohler(210.0, 1.5e-3) > 4.0);
    // induction is a dose: π/4 of what is dissolved, at any irradiance and thickness
    for (irradiance, thickness) in [(50.0, 1e-3), (400.0, 2e-4)] {
        let number = clear.damkohler(irradiance, thickness);
        let time_s = oxygen::induction_s(number, thickness, 1.08e-10);
        close(time_s * irradiance, std::f64::consts::FRAC_PI_4 * clear.dose_j_m2(), 1e-12);
    }
    let again = clear.reoxygenation(30e-6);
    within(again.refill_s, 6.5, 0.1);
}

#[test]
fn oxygen_eats_the_next_light() {
    let kinetics = resin(0.6);
    let curve = kinetics.kamal.curve();
    let oxygen = Some(Reoxygenation { dose_j_m2: 60.0, refill_s: 8.0 });
    let passes = |gap_s: f64| {
        [
            at(0.0, 0.0, 298.15),
            at(50.0, 0.0, 298.15), // a shadow before the first light owes nothing
            at(50.0, 300.0, 298.15),
            at(50.2, 300.0, 298.15),
            at(50.2, 0.0, 298.15),
            at(50.2 + gap_s, 0.0, 298.15),
            at(50.2 + gap_s, 300.0, 298.15),
            at(51.2 + gap_s, 300.0, 298.15),
        ]
    };
    let end = |gap_s: f64, oxygen| cure(&kinetics, &curve, &passes(gap_s), oxygen).at(1e9);
    let lit = |time_s: f64| run(&kinetics, &steady(300.0, time_s)).at(time_s);
    // 60 J/m² at 300 W/m² are 0.2 s; a quarter of the time fills half of it
    within(end(8.0, oxygen), lit(1.0), 1e-12);
    within(end(80.0, oxygen), lit(1.0), 1e-12);
    within(end(2.0, oxygen), lit(1.1), 1e-12);
    within(end(8.0, None), lit(1.2), 1e-12);
    // a dose too small for what is owed does nothing, and the rest stays owed
    let ramp = [
        at(0.0, 300.0, 298.15),
        at(0.1, 300.0, 298.15),
        at(0.1, 0.0, 298.15),
        at(20.0, 0.0, 298.15),
        at(20.0, 0.0, 298.15),
        at(20.5, 100.0, 298.15), // 25 J/m²
        at(20.6, 600.0, 298.15), // 35 more J/m²: all of it
        at(21.0, 600.0, 298.15),
    ];
    let cured = cure(&kinetics, &curve, &ramp, oxygen);
    within(cured.at(20.6), cured.at(0.1), 1e-12);
    let both = [
        at(0.0, 300.0, 298.15),
        at(0.1, 300.0, 298.15),
        at(0.1, 600.0, 298.15),
        at(0.5, 600.0, 298.15),
    ];
    within(cured.at(21.0), run(&kinetics, &both).at(0.5), 1e-9);
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![any::<f64>(), -1.0..3.0, 0.0..1e3, Just(0.0), Just(1.0), Just(f64::NAN)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn any_input_is_bounded(
        v in prop::array::uniform10(any_number()),
        samples in prop::collection::vec((any_number(), any_number(), any_number()), 0..8),
        eaten in (any_number(), any_number()),
        share in any_number(),
    ) {
        let kamal =
            Kamal { m: v[0], n: v[1], k1_per_s: v[2], k2_per_s: v[3], gel: v[4], max: v[5] };
        let kinetics = Kinetics {
            kamal,
            b: v[6],
            activation_j_mol: v[7],
            reference_w_m2: v[8],
            reference_k: v[9],
        };
        let top = if v[5] > 0.0 { v[5] } else { 0.0 };
        for kinetics in [kinetics, kinetics.calibrated(share)] {
            let history: Vec<_> = samples.iter().map(|&(a, i, t)| at(a, i, t)).collect();
            let oxygen = Reoxygenation { dose_j_m2: eaten.0, refill_s: eaten.1 };
            let cured = cure(&kinetics, &kinetics.kamal.curve(), &history, Some(oxygen));
            let mut last = 0.0;
            for &degree in &cured.alpha {
                prop_assert!(degree >= last - 1e-9 * top && degree <= top);
                last = degree;
            }
            prop_assert!(!cured.gel_age_s.is_nan());
            for age_s in [share, 0.0, 1.0, f64::NAN] {
                for degree in [cured.at(age_s), cured.at_behind(age_s, share)] {
                    prop_assert!((0.0..=top).contains(&degree));
                }
            }
            prop_assert!(!cured.gel_age_behind_s(share).is_nan());
        }
    }

    #[test]
    fn cure_never_goes_back(
        m in 0.0..3.0_f64, n in 0.0..4.0_f64, ratio in 0.0..1e4_f64, b in 0.0..1.5_f64,
        lights in prop::collection::vec((0.01..2.0_f64, 0.0..2e3_f64, 250.0..450.0_f64), 2..7),
    ) {
        let kamal = Kamal { m, n, k2_per_s: ratio, ..acrylate() };
        let kinetics = Kinetics { kamal, b, ..resin(1.0) }.calibrated(100.0);
        let mut age_s = 0.0;
        let history: Vec<_> = lights
            .iter()
            .map(|&(dt, light, kelvin)| { age_s += dt; at(age_s, light, kelvin) })
            .collect();
        let cured = run(&kinetics, &history);
        let mut last = 0.0;
        for i in 0..=200 {
            let degree = cured.at(age_s * f64::from(i) / 200.0);
            prop_assert!(degree >= last - 1e-12 && degree <= 0.8, "{degree} after {last}");
            last = degree;
        }
        if cured.gel_age_s.is_finite() {
            within(cured.at(cured.gel_age_s), 0.15, 5e-5);
        } else {
            prop_assert!(last < 0.15 + 5e-5);
        }
    }
}

#[test]
fn reduced_time_against_a_sum() {
    // light from darkness while the strand warms by 50 K, and back; the sum crowds at the dark end
    for b in [0.5, 0.6, 1.0] {
        let kinetics = resin(b);
        for [first, last] in [[0.0, 900.0], [900.0, 0.0], [90.0, 900.0], [300.0, 900.0]] {
            let cured = run(&kinetics, &[at(0.0, first, 300.0), at(2.0, last, 350.0)]);
            let steps = 4000;
            let term = |i: i32| {
                let u = (f64::from(i) + 0.5) / f64::from(steps);
                let weight = 4.0 * u.powi(3) / f64::from(steps);
                let x = if first < last { u.powi(4) } else { 1.0 - u.powi(4) };
                2.0 * weight * kinetics.drive(first + x * (last - first), 300.0 + 50.0 * x)
            };
            let want: f64 = (0..steps).map(term).sum();
            println!("b {b} light {first} to {last}: {:e}", cured.reduced_s(2.0) / want - 1.0);
            close(cured.reduced_s(2.0), want, 1e-6);
            assert_eq!(cured.reduced_s(5.0), cured.reduced_s(2.0));
        }
    }
}
