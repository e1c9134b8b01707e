use proptest::prelude::*;

use super::*;
use crate::interval::Interval;
use crate::process::contact::{Contact, effusivity, front_s, interface_k};
use crate::process::heat::{cooling_rate_per_s, effective_h_w_m2k};
use crate::process::tests::{close, within};
use crate::process::viscosity::CrossWlf;

/// P400 ABS: materials_reference.json abs.weld_time, status memory.
const P400: WeldTime = WeldTime { prefactor_s: 1.08e-47, activation_j_mol: 388.7e3 };
/// Glass transitions of materials/abs.toml and pla.toml, K.
const ABS_GLASS_K: f64 = 378.15;
const PLA_GLASS_K: f64 = 333.15;

#[test]
fn weld_time_of_p400() {
    // ln t_w = ln A + Q/(R T), and its values about the joints of section 5.
    let log = (1.08e-47_f64).ln() + 388.7e3 / (8.314_462_618 * 423.15);
    close(P400.at_s(423.15), log.exp(), 1e-9);
    assert!(P400.at_s(0.0).is_infinite() && P400.at_s(-3.0).is_infinite());
    // Reptation: η0 = (π²/12) G t.
    let time = reptation_time_s(1e5, 0.7e6);
    close(PI * PI / 12.0 * 0.7e6 * time, 1e5, 1e-14);
}

#[test]
fn healing_at_one_temperature_is_the_fourth_root_of_time() {
    let degree = |kelvin: f64, time_s: f64| {
        healing_degree(&[(0.0, kelvin), (time_s, kelvin)], ABS_GLASS_K, |t| P400.at_s(t))
    };
    for (kelvin, time_s) in [(403.15, 1.0), (403.15, 16.0), (413.15, 3.0), (423.15, 0.2)] {
        close(degree(kelvin, time_s), (time_s / P400.at_s(kelvin)).powf(0.25), 1e-13);
    }
    close(degree(403.15, 16.0) / degree(403.15, 1.0), 2.0, 1e-13);
    assert!(degree(500.0, 10.0) == 1.0);
    assert!(degree(ABS_GLASS_K, 1e9) == 0.0 && degree(ABS_GLASS_K + 0.01, 1e9) > 0.0);
    // A stretch cut in two heals the same; so does one with a cold time in its middle.
    let cut = [(0.0, 403.15), (0.7, 403.15), (3.0, 403.15)];
    close(healing_degree(&cut, ABS_GLASS_K, |t| P400.at_s(t)), degree(403.15, 3.0), 1e-13);
}

#[test]
fn healing_converges_at_second_order_in_the_samples() {
    // 160 °C down through Tg at 0.3 /s in air of 22 °C; reference: midpoint rule in time of the exact curve.
    let curve = |age: f64| 295.15 + 138.0 * (-0.3 * age).exp();
    let end_s = 6.0;
    let share = |n: usize| {
        let samples: Vec<_> =
            (0..=n).map(|i| end_s * i as f64 / n as f64).map(|age| (age, curve(age))).collect();
        healing_degree(&samples, ABS_GLASS_K, |t| 1e4 * P400.at_s(t)).powi(4)
    };
    let fine = 400_000;
    let exact: f64 = (0..fine)
        .map(|i| curve(end_s * (i as f64 + 0.5) / fine as f64))
        .filter(|&t| t > ABS_GLASS_K)
        .map(|t| end_s / fine as f64 / (1e4 * P400.at_s(t)))
        .sum();
    let errors = [20, 40, 80, 160].map(|n| (share(n) / exact - 1.0).abs());
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.85..2.15).contains(&order), "{order} of {errors:?}");
    }
    assert!(errors[2] < 2e-3, "{errors:?}"); // 80 samples: 5e-4 of the degree itself
}

/// A tip of melt on a cold strut of the same material: conductivity, density, specific heat, nozzle °C, glass °C,
/// with 1.27 mm, 100 W/(m² K), 22 °C of air.
fn node(numbers: [f64; 5], strut_c: f64, dwell_s: f64) -> (Contact, Vec<(f64, f64)>) {
    let [k, density, cp, nozzle_c, glass_c] = numbers;
    let (diameter_m, air_k) = (0.00127, 295.15);
    let e = effusivity(k, density, cp);
    let h = effective_h_w_m2k(100.0, diameter_m, k);
    let contact = Contact {
        interface_k: interface_k(e, nozzle_c + 273.15, e, strut_c + 273.15),
        air_k,
        hold_s: front_s(diameter_m, k / (density * cp)) + dwell_s,
        rate_per_s: cooling_rate_per_s(h, density, cp, diameter_m),
    };
    (contact, contact.samples(glass_c + 273.15, 600.0, 200))
}

/// materials/abs.toml and pla.toml: k, density, cp, nozzle, glass.
const ABS: [f64; 5] = [0.19, 1040.0, 1550.0, 240.0, 105.0];
const PLA: [f64; 5] = [0.18, 1240.0, 1800.0, 210.0, 60.0];

fn fit(d1_pa_s: f64, a1: f64) -> CrossWlf {
    let factor = Interval::exact(1.0);
    CrossWlf { d1_pa_s, t_star_k: 373.15, a1, a2_k: 51.6, factor }
}

/// Weld time by reptation, plateau modulus (Young) 2 MPa of both materials, times a factor.
fn reptation(fit: CrossWlf, factor: f64) -> impl Fn(f64) -> f64 {
    move |kelvin| factor * reptation_time_s(fit.zero_shear_pa_s(kelvin), 2e6 / 3.0)
}

/// What the model gives for a node touched in free air, as printed in process-physics.md section 5: "interface 115–130 °C,
/// expect ABS 0.4–0.6, PLA 0.6–0.8 [D/M]". Nothing is tuned. The P400 weld time gives far less for ABS: its
/// 1.08e-47 s and 388.7 kJ/mol say 2400 s at 130 °C. The expectation is met by neither.
#[test]
fn nodes_in_free_air_with_library_values() {
    let degree = |samples: &[(f64, f64)], glass_k: f64, weld: &dyn Fn(f64) -> f64| {
        healing_degree(samples, glass_k, weld)
    };
    let (abs_contact, abs) = node(ABS, 22.0, 0.0);
    let (pla_contact, pla) = node(PLA, 22.0, 0.0);
    within(abs_contact.interface_k - 273.15, 131.0, 1e-9);
    within(pla_contact.interface_k - 273.15, 116.0, 1e-9);
    let abs_p400 = degree(&abs, ABS_GLASS_K, &|t| P400.at_s(t));
    let abs_reptation = degree(&abs, ABS_GLASS_K, &reptation(fit(9.95e11, 27.322), 1.0));
    let pla_reptation = degree(&pla, PLA_GLASS_K, &reptation(fit(3.317_19e9, 20.194), 1.0));
    within(abs_p400, 0.121, 0.001);
    within(abs_reptation, 0.289, 0.001);
    within(pla_reptation, 0.336, 0.001);
    // A factor of ten either way in the reptation time is 1.78 in the degree: 0.16–0.51 and 0.19–0.60.
    let slow = degree(&abs, ABS_GLASS_K, &reptation(fit(9.95e11, 27.322), 10.0));
    close(abs_reptation / slow, 10.0_f64.powf(0.25), 1e-9);
    // What the reference says raises it does: a dwell (3 s: 0.21, 10 s: 0.27), and far more a strut still warm (60 °C: 0.44;
    // with 3 s: 0.76).
    let p400 = |strut_c: f64, dwell_s: f64| {
        degree(&node(ABS, strut_c, dwell_s).1, ABS_GLASS_K, &|t| P400.at_s(t))
    };
    within(p400(22.0, 3.0), 0.207, 0.001);
    within(p400(22.0, 10.0), 0.273, 0.001);
    within(p400(60.0, 0.0), 0.438, 0.001);
    within(p400(60.0, 3.0), 0.756, 0.001);
}

#[test]
fn dob_range() {
    // DOB-RANGE gives 0.39 to 0.86 and no conditions. Taken here: cooling at 100 K/s at first (SEPPALA-MIGLER) in
    // air of 22 °C, P400. Which interface temperatures give the ends of the range, and do they agree
    // with the second of that case above Tg (factor two)?
    let degree = |interface_k: f64| {
        let air_k = 295.15;
        let rate_per_s = 100.0 / (interface_k - air_k);
        let contact = Contact { interface_k, air_k, hold_s: 0.0, rate_per_s };
        let samples = contact.samples(ABS_GLASS_K, 100.0, 400);
        let hot_s = time_above_s(&samples, ABS_GLASS_K);
        (healing_degree(&samples, ABS_GLASS_K, |t| P400.at_s(t)), hot_s)
    };
    let at = |want: f64| {
        let (mut low, mut high) = (ABS_GLASS_K, 513.15);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if degree(middle).0 < want { low = middle } else { high = middle }
        }
        low
    };
    let (low_k, high_k) = (at(0.39), at(0.86));
    // 157 and 170 °C: melt of 240 °C on a layer at 74 to 99 °C. The range is a window of 13 K.
    within(low_k - 273.15, 157.0, 0.1);
    within(high_k - 273.15, 169.6, 0.1);
    for (kelvin, want) in [(low_k, 0.66), (high_k, 0.85)] {
        let hot_s = degree(kelvin).1;
        within(hot_s, want, 0.01);
        assert!((0.5..2.0).contains(&hot_s));
    }
    // Every layer between gives a degree inside the range.
    for i in 0..=10 {
        let got = degree(low_k + (high_k - low_k) * f64::from(i) / 10.0).0;
        assert!((0.39 - 1e-9..=0.86 + 1e-9).contains(&got));
    }
    // A node in free air (131 °C) is not such a layer: see `nodes_in_free_air_with_library_values`.
    assert!(degree(404.15).0 < 0.2);
}

#[test]
fn aniso_table() {
    // ANISO-TABLE against bond_fraction of materials/abs.toml. That interval was read off this very table
    // (its source line says so): this shows which rows it covers, it predicts nothing.
    let (value, low, high): (f64, f64, f64) = (0.56, 0.537, 0.6);
    let table: [(&str, f64, bool); 7] = [
        ("Rodriguez", 0.56, true),
        ("Ahn", 0.57, true),
        ("Ziemian", 0.56, true),
        ("Tam & Mueller", 0.55, true),
        ("Torrado Z", 0.5, false),
        ("Alaimo in plane", 0.6, true),
        ("ULTEM, Bagsik: another material", 0.64, false),
    ];
    for (name, ratio, covered) in table {
        assert_eq!((low..=high).contains(&ratio), covered, "{name}");
        // 0.04 is the tolerance of the case; on the interval all seven are within it, on the value five are.
        assert!(ratio >= low - 0.04 && ratio <= high + 0.04, "{name}");
    }
    let near = table.iter().filter(|row| (row.1 - value).abs() <= 0.04 + 1e-12).count();
    assert_eq!(near, 5);
}

// HEAL-R2 (R² 0.795 of a diffusion integral against measured ABS z strength, Coogan & Kazmer) is not a test: the
// measured strengths and the weld temperatures behind it are not public, only the abstract is. An R² against numbers
// of our own making would show nothing.

#[test]
fn bonds_by_light_and_by_the_clock() {
    let bond = |cure| photopolymer_bond(cure, 0.8, 0.9);
    assert_eq!(bond(0.0), Bond { degree: 1.0, limited_by: BondLimit::Nothing });
    close(bond(0.8).degree, 0.9, 1e-15);
    close(bond(0.4).degree, 0.5 + 0.5 * 0.9, 1e-15);
    assert_eq!(bond(0.4).limited_by, BondLimit::Reacted);
    // The range of the material: 0.7 to 1.0, on a substrate that is done.
    close(photopolymer_bond(0.8, 0.8, 0.7).degree, 0.7, 1e-15);
    assert_eq!(photopolymer_bond(0.8, 0.8, 1.0).limited_by, BondLimit::Nothing);
    close(two_part_bond(0.3, 0.6, 0.6).degree, 0.8, 1e-15);
    close(two_part_bond(60.0, 0.6, 0.6).degree, 0.6, 1e-15);
    close(two_part_bond(0.0, 0.6, 0.6).degree, 1.0, 1e-15);
}

#[test]
fn what_limits_a_thermoplastic_bond_and_its_joint() {
    let bond = |kelvin: f64| {
        thermoplastic_bond(&[(0.0, kelvin), (1.0, kelvin)], ABS_GLASS_K, |t| P400.at_s(t))
    };
    assert_eq!(bond(370.0), Bond { degree: 0.0, limited_by: BondLimit::Cold });
    assert_eq!(bond(400.0).limited_by, BondLimit::Time);
    assert_eq!(bond(480.0), Bond { degree: 1.0, limited_by: BondLimit::Nothing });
    // min(axial, σ A D_h): 45 MPa, 1 mm², 0.4 is 18 N.
    close(joint_strength_n(50.0, 45e6, 1e-6, 0.4), 18.0, 1e-12);
    close(joint_strength_n(10.0, 45e6, 1e-6, 0.4), 10.0, 1e-12);
}

proptest! {
    #[test]
    fn any_history_gives_a_degree(
        samples in prop::collection::vec((any::<f64>(), any::<f64>()), 0..12),
        glass in any::<f64>(), prefactor in any::<f64>(), activation in any::<f64>(),
    ) {
        let weld = WeldTime { prefactor_s: prefactor, activation_j_mol: activation };
        let bond = thermoplastic_bond(&samples, glass, |t| weld.at_s(t));
        prop_assert!((0.0..=1.0).contains(&bond.degree), "{bond:?}");
        let bond = photopolymer_bond(glass, prefactor, activation);
        prop_assert!((0.0..=1.0).contains(&bond.degree), "{bond:?}");
    }

    #[test]
    fn hotter_or_longer_never_heals_less(
        kelvin in 380.0..460.0f64, more in 0.0..20.0f64, time in 0.01..10.0f64, factor in 1.0..5.0f64,
    ) {
        let degree = |kelvin: f64, time: f64| healing_degree(
            &[(0.0, kelvin), (time, kelvin - 30.0)], ABS_GLASS_K, |t| P400.at_s(t));
        prop_assert!(degree(kelvin + more, time) >= degree(kelvin, time) * (1.0 - 1e-6));
        prop_assert!(degree(kelvin, time * factor) >= degree(kelvin, time));
    }
}
