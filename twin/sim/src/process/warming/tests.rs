//! Heat of cure against closed forms, its limits and its own refinement.

use proptest::prelude::*;

use super::*;
use crate::process::cure::cure_depth_m;
use crate::process::cured::cure;
use crate::process::tests::{close, within};
use crate::process::tests_kinetics::{resin, run as cured, steady};

/// Numbers of materials/sla-resin-silica.toml, 3 mm.
fn body() -> Body {
    Body {
        radius_m: 1.5e-3,
        density_kg_m3: 1130.0,
        cp_j_kgk: 1800.0,
        conductivity_w_mk: 0.19,
        enthalpy_j_kg: 330e3,
        penetration_m: 0.3e-3,
    }
}

const AIR_K: f64 = 298.15;

fn lit(to_s: f64) -> [Stretch; 1] {
    [Stretch { from_s: 0.0, to_s, irradiance_w_m2: 200.0 }]
}

fn at_h(h: f64, body: &Body, stretches: &[Stretch], grid: [usize; 2]) -> Warmed {
    let kinetics = resin(0.6);
    let around = Around { air_k: AIR_K, h_w_m2k: &|_, _| h };
    let curve = kinetics.kamal.curve();
    warm_with(&kinetics, &curve, body, stretches, &around, grid).expect("a body")
}

#[test]
fn no_loss_is_the_adiabatic_rise() {
    // Light alike through the section, long enough: all of it at T0 + ΔH α_max/cp, 146.7 K.
    let clear = Body { penetration_m: 1e3, ..body() };
    let whole = at_h(0.0, &clear, &lit(1e5), [RINGS, STEPS]);
    let rise_k = adiabatic_rise_k(330e3, whole.mean_degree, 1800.0);
    within(whole.mean_degree, 0.8, 1e-3);
    close(whole.warmest_k - AIR_K, rise_k, 1e-9);
    within(whole.warmest_k - AIR_K, 146.7, 0.2);
    // At any degree and penetration the heat adds up, whatever the steps.
    for (to_s, steps) in [(0.5, 3), (2.0, 32), (8.0, 100)] {
        let part = at_h(0.0, &body(), &lit(to_s), [RINGS, steps]);
        let rise_k = adiabatic_rise_k(330e3, part.mean_degree, 1800.0);
        close(part.warmest_mean_k - AIR_K, rise_k, 1e-9);
        assert!(part.warmest_k > part.warmest_mean_k);
    }
}

#[test]
fn endless_loss_is_the_cold_run() {
    // The surface is as warm as the air, so its cure is that at air temperature; with a strand that conducts
    // without end all of it is.
    let kinetics = resin(0.6);
    let cold = cured(&kinetics, &steady(200.0, 2.0));
    let chilled = at_h(f64::INFINITY, &body(), &lit(2.0), [RINGS, STEPS]);
    assert!(chilled.surface.iter().all(|at| (at.temperature_k - AIR_K).abs() < 1e-6));
    let warm = cure(&kinetics, &kinetics.kamal.curve(), &chilled.surface, None);
    close(warm.gel_age_s, cold.gel_age_s, 1e-6);
    within(chilled.surface_degree, cold.at(2.0), 1e-6);
    assert!(chilled.warmest_k > AIR_K + 5.0); // inside it is warm all the same
    let metal = Body { conductivity_w_mk: 1e9, ..body() };
    let all = at_h(f64::INFINITY, &metal, &lit(2.0), [RINGS, STEPS]);
    within(all.warmest_k, AIR_K, 1e-4);
    // no heat, no warmth
    let inert = Body { enthalpy_j_kg: 0.0, ..body() };
    close(at_h(10.0, &inert, &lit(2.0), [RINGS, STEPS]).warmest_k, AIR_K, 1e-12);
}

#[test]
fn without_heat_the_front_of_gel_is_that_of_the_working_curve() {
    let inert = Body { enthalpy_j_kg: 0.0, ..body() };
    let kinetics = resin(0.6);
    let cold = cured(&kinetics, &steady(200.0, 2.0));
    for grid in [[8, 16], [64, 64]] {
        let got = at_h(10.0, &inert, &lit(2.0), grid);
        let middles = (0..grid[0]).map(|i| 1.5e-3 * ((i as f64 + 0.5) / grid[0] as f64).sqrt());
        // A share e of the rate is a share e^(1/b) of the light to `Cured`.
        let share = |r: f64| ((r - 1.5e-3) / 0.3e-3_f64).exp();
        let want: Vec<f64> =
            middles.clone().map(|r| cold.at_behind(2.0, share(r).powf(1.0 / 0.6))).collect();
        within(got.mean_degree, want.iter().sum::<f64>() / grid[0] as f64, 1e-9);
        let depth_m = cure_depth_m(0.3e-3, 400.0, 100.0);
        let gelled = middles.zip(&want).all(|(r, a)| (*a >= 0.15) == (1.5e-3 - r <= depth_m));
        assert!(gelled, "the rings that gel are those above Jacobs' depth");
    }
}

#[test]
fn one_rate_cools_a_strand_that_conducts() {
    // Cured at once and left in the dark: the lumped law, T∞ + ΔT exp(−4 h t/(ρ cp D)).
    let metal = Body { conductivity_w_mk: 1e6, penetration_m: 1e3, ..body() };
    let dark = |to_s| Stretch { from_s: 1e-6, to_s, irradiance_w_m2: 0.0 };
    let flash = Stretch { from_s: 0.0, to_s: 1e-6, irradiance_w_m2: 1e15 };
    let rate_per_s = 4.0 * 50.0 / (1130.0 * 1800.0 * 3e-3);
    for to_s in [5.0, 30.0, 100.0] {
        let cooled = at_h(50.0, &metal, &[flash, dark(to_s)], [RINGS, 400]);
        let last_k = cooled.surface.last().expect("samples").temperature_k;
        let rise_k = adiabatic_rise_k(330e3, cooled.mean_degree, 1800.0);
        within(last_k - AIR_K, rise_k * (-rate_per_s * to_s).exp(), 2e-3 * rise_k);
    }
}

#[test]
fn steps_converge_with_the_square_and_rings_do() {
    // Air side that changes with the surface, so that it is in the order as well.
    let kinetics = resin(0.6);
    let curve = kinetics.kamal.curve();
    let around = Around {
        air_k: AIR_K,
        h_w_m2k: &|surface_k, age_s| 20.0 + 0.3 * (surface_k - AIR_K) + 20.0 * age_s,
    };
    let run =
        |grid| warm_with(&kinetics, &curve, &body(), &lit(2.0), &around, grid).expect("a body");
    let ends = [32, 64, 128, 256].map(|steps| run([8, steps]));
    for value in [|w: &Warmed| w.warmest_mean_k, |w: &Warmed| w.surface_degree] {
        let [a, b, c, d] = ends.each_ref().map(value);
        let order = ((b - c) / (c - d)).abs().log2();
        println!("{a} {b} {c} {d}: order {order}");
        assert!((1.7..2.4).contains(&order), "order {order}");
    }
    let fine = run([64, 512]);
    let usual = run([RINGS, STEPS]);
    println!("usual {:?}", (usual.warmest_k, usual.warmest_mean_k, usual.surface_degree));
    println!("fine {:?}", (fine.warmest_k, fine.warmest_mean_k, fine.surface_degree));
    close(usual.warmest_k - AIR_K, fine.warmest_k - AIR_K, 0.05);
    close(usual.warmest_mean_k - AIR_K, fine.warmest_mean_k - AIR_K, 0.01);
    within(usual.surface_degree, fine.surface_degree, 5e-3);
    // The history it gives cures the same by the law of any history.
    let by_history = cure(&kinetics, &curve, &usual.surface, None);
    within(by_history.at(2.0), usual.surface_degree, 2e-3);
    assert!(by_history.gel_age_s < kinetics.gel_time_s(200.0, AIR_K));
}

proptest! {
    #[test]
    fn any_body_is_finite_or_none(v in prop::array::uniform10(prop_oneof![
        any::<f64>(), 0.0..3.0, 1e-4..1e3, Just(0.0), Just(f64::NAN), Just(f64::INFINITY)
    ])) {
        let kinetics = resin(0.6);
        let body = Body {
            radius_m: v[0], density_kg_m3: v[1], cp_j_kgk: v[2], conductivity_w_mk: v[3],
            enthalpy_j_kg: v[4], penetration_m: v[5],
        };
        let stretches = [
            Stretch { from_s: 0.0, to_s: v[7], irradiance_w_m2: v[8] },
            Stretch { from_s: v[7], to_s: v[9], irradiance_w_m2: v[6] },
        ];
        let around = Around { air_k: 298.15, h_w_m2k: &|_, _| v[9] };
        let curve = kinetics.kamal.curve();
        for body in [body, self::body()] {
            if let Some(out) = warm(&kinetics, &curve, &body, &stretches, &around) {
                prop_assert!(out.warmest_k.is_finite() && out.warmest_k >= 298.15);
                prop_assert!((0.0..=0.8).contains(&out.mean_degree) && (0.0..=0.8).contains(&out.surface_degree));
            }
        }
    }
}
