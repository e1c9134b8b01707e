//! Sections of rings, moduli and sag risk against closed forms and the validation cases.

use super::cure::{cure_depth_m, shell_area_fraction, shell_stiffness_fraction};
use super::gel::clamped_span_m;
use super::sag::{Fluidity, SoftBeam};
use super::solid::{self, Stiffening};
use super::tests::{close, within};
use super::tests_kinetics::{resin, run, steady};

/// Edges of rings of one thickness, and the degree where light comes in through `penetration_m` all round.
fn rings(count: usize, radius_m: f64, degree: impl Fn(f64) -> f64) -> (Vec<f64>, Vec<f64>) {
    let edges = (0..=count).map(|i| radius_m * i as f64 / count as f64).collect::<Vec<_>>();
    let degrees = edges.windows(2).map(|pair| degree(0.5 * (pair[0] + pair[1]))).collect();
    (edges, degrees)
}

#[test]
fn rings_meet_shell_and_working_curve() {
    let stiffening = Stiffening { gel_pa: 1e6, full_pa: 1.6e9, gel: 0.15, full: 0.8 };
    let (radius_m, depth_m) = (1.5e-3, 0.5e-3);
    // SHELL-EI: a shell cured in full
    let (edges, degrees) = rings(300, radius_m, |r| if r > radius_m - depth_m { 0.8 } else { 0.0 });
    let shell = solid::section(&edges, &degrees, &stiffening, 0.0);
    close(shell.axial, shell_area_fraction(depth_m, radius_m), 1e-9);
    close(shell.bending, shell_stiffness_fraction(depth_m, radius_m), 1e-9);
    close(shell.core_m, 1e-3, 1e-12);
    assert!(!shell.core_gelled);
    // a skin that stays tacky
    let (edges, degrees) = rings(12, radius_m, |_| 0.8);
    let skinned = solid::section(&edges, &degrees, &stiffening, 30e-6);
    close(skinned.axial, 0.98_f64.powi(2), 1e-12);
    close(skinned.bending, 0.98_f64.powi(4), 1e-12);
    assert!(skinned.core_gelled && skinned.core_m == 0.0);
    close(skinned.mean_degree, 0.8, 1e-12);
    // the gel front of a dose is Jacobs' depth where dose alone counts, deeper where b is less than one
    let front = |b: f64, count: usize| {
        let kinetics = resin(b);
        let cured = run(&kinetics, &steady(800.0, 2.0)); // 1600 J/m²
        let (edges, degrees) =
            rings(count, radius_m, |r| cured.at_behind(2.0, (-(radius_m - r) / 0.2e-3).exp()));
        solid::section(&edges, &degrees, &stiffening, 0.0).core_m
    };
    let want = radius_m - cure_depth_m(0.2e-3, 1600.0, 100.0);
    for count in [30, 120, 480] {
        within(front(1.0, count), want, 0.51 * radius_m / count as f64);
    }
    // at b = 1/2: (I/I0)^½ t = Ec/I0 gives 2 Dp ln[(800/200)^½ 2/0.5]
    let deep = radius_m - 2.0 * 0.2e-3 * 8.0_f64.ln();
    within(front(0.5, 480), deep, 0.51 * radius_m / 480.0);
}

#[test]
fn green_post() {
    let file = include_str!("../../../../materials/sla-resin-silica.toml");
    let number = |section: &str, key: &str| -> f64 {
        let after = file.split(&format!("[{section}]")).nth(1).expect("section");
        let line = after.lines().find(|line| line.starts_with(key)).expect("key");
        line.split('=').nth(1).expect("value").trim().parse().expect("number")
    };
    let cured = "setting.photopolymer.cured_modulus_pa";
    // Formlabs Clear 1.6 and 2.8 GPa, Durable 0.45 and 1.26: nominal and low end of the file
    for (key, green_gpa, post_gpa) in [("value", 1.6, 2.8), ("low", 0.45, 1.26)] {
        close(number("youngs_modulus_pa", key), green_gpa * 1e9, 0.15);
        close(number(cured, key), post_gpa * 1e9, 0.15);
        // the log-linear law takes that much more conversion, which a post-cure can give (to 0.92)
        let law = Stiffening { gel_pa: 1e6, full_pa: green_gpa * 1e9, gel: 0.15, full: 0.8 };
        let degree = law.degree_at(post_gpa * 1e9);
        println!("post-cured at {degree}");
        assert!((0.8..0.92).contains(&degree), "{degree}");
        close(law.modulus_pa(degree), post_gpa * 1e9, 1e-12);
        close(law.modulus_pa(0.8), green_gpa * 1e9, 1e-12);
        assert_eq!((law.modulus_pa(0.149), law.modulus_pa(0.15)), (0.0, 1e6));
    }
    assert_eq!(solid::shrunk_strain(0.015, 0.15, 0.8, 0.1), 0.0);
    close(solid::shrunk_strain(0.015, 0.15, 0.8, 0.475), 0.0075, 1e-12);
    close(solid::shrunk_strain(0.015, 0.15, 0.8, 0.9), 0.015, 1e-12);
}

#[test]
fn drepp_gravity() {
    // weaker light makes the zone longer; a runny gel of 5 Pa, 3 mm thick, at 4 mm/s
    let mut last_zone_m = 0.0;
    let mut last = [-1.0; 3];
    for irradiance in [400.0, 100.0, 25.0] {
        let gel_s = resin(1.0).gel_time_s(irradiance, 298.15);
        let zone_m = 4e-3 * gel_s;
        assert!(zone_m > last_zone_m);
        last_zone_m = zone_m;
        let risk = [0.0, 1.62, 9.81].map(|g| {
            let beam = SoftBeam {
                diameter_m: 3e-3,
                density_kg_m3: 1130.0,
                across_m_s2: g,
                speed_m_s: 4e-3,
                span_m: 0.1,
            };
            let sag_m = beam.clamped_sag_m(Fluidity::constant(0.3, gel_s));
            let carried = zone_m / clamped_span_m(5.0, 1130.0 * g, 3e-3);
            (sag_m, carried)
        });
        assert_eq!(risk[0], (0.0, 0.0)); // weightless, no zone is too long
        for pair in risk.windows(2) {
            assert!(pair[1].0 > pair[0].0 && pair[1].1 > pair[0].1); // more g, more sag, less carried
        }
        for (i, &(sag_m, carried)) in risk.iter().enumerate().skip(1) {
            assert!(sag_m > 0.0 && carried > last[i]); // a longer zone likewise
            last[i] = carried;
        }
    }
}

/// A box that no heat leaves, stepped as a thermal model steps: middle of the step, degree from reduced time.
fn box_temperature_k(steps: u32) -> (f64, f64) {
    let kinetics = resin(1.0);
    let curve = kinetics.kamal.curve();
    let (enthalpy, cp, start_k) = (330e3, 1800.0, 298.15);
    let rise = |degree: f64| start_k + solid::adiabatic_rise_k(enthalpy, degree, cp);
    let step_s = 1.0 / f64::from(steps);
    let (mut reduced_s, mut heat_j_m3) = (0.0, 0.0);
    for _ in 0..steps {
        let before = curve.degree(reduced_s);
        let half_s = 0.5 * step_s * kinetics.drive(200.0, rise(before));
        let middle_k = rise(curve.degree(reduced_s + half_s));
        reduced_s += step_s * kinetics.drive(200.0, middle_k);
        let rate = (curve.degree(reduced_s) - before) / step_s;
        heat_j_m3 += step_s * solid::cure_heat_w_m3(1130.0, enthalpy, rate);
    }
    (start_k + heat_j_m3 / (1130.0 * cp), rise(curve.degree(reduced_s)))
}

#[test]
fn a_box_that_keeps_its_heat() {
    for steps in [3, 50] {
        let (by_heat_k, by_degree_k) = box_temperature_k(steps);
        close(by_heat_k, by_degree_k, 1e-12); // no heat is lost by stepping
    }
    let ends = [50, 100, 200].map(|steps| box_temperature_k(steps).0);
    let order = ((ends[0] - ends[1]) / (ends[1] - ends[2])).abs().log2();
    println!("after 1 s {} K, order {order}", ends[2]);
    assert!((order - 2.0).abs() < 0.2, "order {order}");
    // its own heat speeds it up
    assert!(
        ends[2]
            > 298.15
                + solid::adiabatic_rise_k(
                    330e3,
                    run(&resin(1.0), &steady(200.0, 1.0)).at(1.0),
                    1800.0
                )
    );
}

proptest::proptest! {
    #[test]
    fn any_section_is_bounded(
        edges in proptest::collection::vec(proptest::num::f64::ANY, 0..6),
        degrees in proptest::collection::vec(proptest::num::f64::ANY, 0..6),
        good in proptest::collection::vec(0.0..0.8_f64, 6),
        skin in 0.0..2e-3_f64,
    ) {
        let stiffening = Stiffening { gel_pa: 1e6, full_pa: 1.6e9, gel: 0.15, full: 0.8 };
        let _ = solid::section(&edges, &degrees, &stiffening, skin);
        let (edges, degrees) = rings(6, 1.5e-3, |r| good[((r / 0.25e-3) as usize).min(5)]);
        let section = solid::section(&edges, &degrees, &stiffening, skin);
        proptest::prop_assert!((0.0..=1.0).contains(&section.axial) && (0.0..=1.0).contains(&section.bending));
        proptest::prop_assert!((0.0..=0.8).contains(&section.mean_degree));
        proptest::prop_assert!((0.0..=1.5e-3 + 1e-15).contains(&section.core_m));
    }
}
