use proptest::prelude::*;

use super::*;
use crate::process::age_samples::at_age;
use crate::process::heat::{cooling_rate_per_s, effective_h_w_m2k};
use crate::process::tests::{close, within};
use crate::process::tests_heat::one_rate;

/// Density, specific heat, conductivity, nozzle °C, set °C, expansion.
type Plastic = [f64; 6];

/// The values the table of process-physics.md section 2.6 and case ENDPOINT-ABS were computed with.
const ABS: Plastic = [1040.0, 1950.0, 0.19, 240.0, 105.0, 8.8e-5];
const PLA: Plastic = [1240.0, 1800.0, 0.18, 210.0, 60.0, 6.8e-5];

fn law(plastic: Plastic, diameter_m: f64, h: f64) -> Cooling {
    let [density, cp, k, nozzle_c, ..] = plastic;
    let effective = effective_h_w_m2k(h, diameter_m, k);
    let rate = cooling_rate_per_s(effective, density, cp, diameter_m);
    one_rate(nozzle_c + 273.15, 295.15, rate)
}

/// Stations at one speed.
fn steady(length_m: f64, speed_m_s: f64, count: usize) -> Vec<(f64, f64)> {
    (0..=count)
        .map(|i| length_m * i as f64 / count as f64)
        .map(|place_m| (place_m, place_m / speed_m_s))
        .collect()
}

/// Samples of a cooling law, until nothing is left.
fn sampled(law: &Cooling, count: usize, until_s: f64) -> Vec<(f64, f64)> {
    (0..=count)
        .map(|i| until_s * i as f64 / count as f64)
        .map(|age_s| (age_s, law.temperature_k(age_s)))
        .collect()
}

/// The general way, from samples: 100 mm at 5 mm/s.
fn miss_mm(plastic: Plastic, diameter_m: f64, h: f64) -> f64 {
    let law = law(plastic, diameter_m, h);
    let strain =
        remaining_by_cooling(&sampled(&law, 400, 40.0), plastic[4] + 273.15, law.air_k, |_| {
            plastic[5]
        });
    1e3 * end_miss_m(&steady(0.1, 0.005, 50), 20.0, |age_s| at_age(&strain, age_s))
}

#[test]
fn endpoint_abs() {
    // ENDPOINT-ABS: 0.268 mm ± 3 %
    close(miss_mm(ABS, 0.00127, 200.0), 0.268, 0.03);
    within(miss_mm(ABS, 0.00127, 200.0), 0.268, 0.0005);
}

#[test]
fn end_misses_printed_in_section_2_6() {
    for (plastic, diameter_m, h, want) in [
        (ABS, 0.00127, 40.0, 0.72),
        (ABS, 0.00127, 100.0, 0.46),
        (ABS, 0.00127, 200.0, 0.27),
        (PLA, 0.00127, 40.0, 0.26),
        (PLA, 0.00127, 100.0, 0.22),
        (PLA, 0.00127, 200.0, 0.14),
        (ABS, 0.003, 40.0, 0.73),
        (ABS, 0.003, 100.0, 0.73),
        (ABS, 0.003, 200.0, 0.61),
    ] {
        within(miss_mm(plastic, diameter_m, h), want, 0.006);
    }
}

#[test]
fn endpoint_order() {
    // ENDPOINT-ORDER with the nominal values of materials/*.toml (density, cp, k, nozzle, glass, expansion).
    let library = [
        [1040.0, 1550.0, 0.19, 240.0, 105.0, 1.18e-4],
        [1240.0, 1800.0, 0.18, 210.0, 60.0, 6.8e-5],
        [1290.0, 1650.0, 0.26, 215.0, 60.0, 4.5e-5],
    ];
    for (diameter_m, h) in [(0.00127, 40.0), (0.00127, 200.0), (0.003, 100.0)] {
        let [abs, pla, carbon] = library.map(|plastic| miss_mm(plastic, diameter_m, h));
        assert!(abs > pla && pla > carbon, "{abs} {pla} {carbon}");
    }
    let [abs, pla, carbon] = library.map(|plastic| miss_mm(plastic, 0.00127, 200.0));
    within(abs, 0.287, 0.0005);
    within(pla, 0.138, 0.0005);
    within(carbon, 0.084, 0.0005);
    // The ranges of PLA (4.1–8.5e-5) and of PLA with carbon (1.5–6.2e-5) overlap: the order of these two is that
    // of the nominal values only. ABS at its lowest expansion is above PLA at its highest.
    let with = |i: usize, expansion: f64| {
        let mut plastic = library[i];
        plastic[5] = expansion;
        miss_mm(plastic, 0.00127, 200.0)
    };
    assert!(with(0, 8.8e-5) > with(1, 8.5e-5));
    assert!(with(1, 4.1e-5) < with(2, 6.2e-5));
}

#[test]
fn constant_speed_is_the_closed_form() {
    for (plastic, diameter_m, h) in [(ABS, 0.00127, 200.0), (PLA, 0.003, 100.0)] {
        let law = law(plastic, diameter_m, h);
        let set_k = plastic[4] + 273.15;
        for dwell_s in [0.0, 3.0, 30.0] {
            let want = cooling_end_miss_m(plastic[5], set_k, &law, 0.1, 0.005, dwell_s);
            let exact = |age_s: f64| plastic[5] * (law.temperature_k(age_s).min(set_k) - law.air_k);
            let miss = |count: usize| end_miss_m(&steady(0.1, 0.005, count), 20.0 + dwell_s, exact);
            close(miss(1), want, 2e-3); // one stretch, 64 pieces
            close(miss(100), want, 1e-4);
            // Straight between samples a tenth of a second apart.
            let strain =
                remaining_by_cooling(&sampled(&law, 600, 60.0), set_k, law.air_k, |_| plastic[5]);
            let read =
                end_miss_m(&steady(0.1, 0.005, 100), 20.0 + dwell_s, |age| at_age(&strain, age));
            close(read, want, 3e-4);
        }
    }
}

#[test]
fn samples_converge_at_second_order() {
    let law = law(ABS, 0.00127, 200.0);
    let want = cooling_end_miss_m(8.8e-5, 378.15, &law, 0.1, 0.005, 0.0);
    let errors = [20, 40, 80, 160].map(|count| {
        let strain =
            remaining_by_cooling(&sampled(&law, count, 40.0), 378.15, law.air_k, |_| 8.8e-5);
        let stations = steady(0.1, 0.005, 4000);
        (end_miss_m(&stations, 20.0, |age_s| at_age(&strain, age_s)) / want - 1.0).abs()
    });
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.5..2.5).contains(&order), "{order} of {errors:?}");
    }
}

#[test]
fn a_strand_cut_at_a_station_sums_to_the_same() {
    // Uneven speed, a stop in the middle.
    let stations = [(0.0, 0.0), (0.01, 3.0), (0.03, 5.0), (0.03, 9.0), (0.08, 14.0), (0.1, 26.0)];
    let law = law(ABS, 0.00127, 100.0);
    let strain = |age_s: f64| 8.8e-5 * (law.temperature_k(age_s).min(378.15) - law.air_k);
    let whole = end_miss_m(&stations, 27.0, strain);
    for cut in 1..5 {
        let parts = end_miss_m(&stations[..=cut], 27.0, strain)
            + end_miss_m(&stations[cut..], 27.0, strain);
        close(parts, whole, 1e-14);
    }
    // Named from elsewhere and started later: the same.
    let moved: Vec<_> = stations.iter().map(|&(s, t)| (s + 7.0, t + 100.0)).collect();
    close(end_miss_m(&moved, 127.0, strain), whole, 1e-12);
    // Brute force: 0.1 ms and metre by metre.
    let steps = 200_000;
    let sum: f64 = (0..steps)
        .map(|i| 0.1 * (f64::from(i) + 0.5) / f64::from(steps))
        .map(|place_m| {
            let pair = stations.windows(2).find(|pair| pair[1].0 >= place_m).unwrap();
            let ((from_m, from_s), (to_m, to_s)) = (pair[0], pair[1]);
            strain(27.0 - from_s - (place_m - from_m) / (to_m - from_m) * (to_s - from_s))
        })
        .sum();
    close(whole, sum * 0.1 / f64::from(steps), 1e-4);
}

#[test]
fn expansion_that_changes_with_temperature() {
    // α = a + b T: ∫ is a (T − T∞) + b (T² − T∞²)/2, whole above the set temperature.
    let (a, b, air_k, set_k) = (4e-5, 1e-7, 295.0, 378.0);
    let out =
        remaining_by_cooling(&[(0.0, 500.0), (2.0, 300.0), (3.0, 295.0)], set_k, air_k, |t| {
            a + b * t
        });
    let strain = |t: f64| a * (t - air_k) + 0.5 * b * (t * t - air_k * air_k);
    assert_eq!(out.len(), 4);
    close(out[0].1, strain(set_k), 1e-12);
    close(out[1].0, 2.0 * 122.0 / 200.0, 1e-12);
    close(out[1].1, strain(set_k), 1e-12);
    close(out[2].1, strain(300.0), 1e-12);
    within(out[3].1, 0.0, 1e-18);
}

#[test]
fn curing_strand_at_constant_speed_is_the_run() {
    // The run of a light ring, with its shadow cut off, and the degree of cure that makes its line.
    let run = CureRun { strain: 0.01, shadow_m: 0.0, gel_s: 0.3, done_s: 4.5 };
    for dwell_s in [0.0, 1.0, 60.0] {
        let want = run.end_miss_m(0.1, 0.002, dwell_s);
        let stations = steady(0.1, 0.002, 200);
        let by_run = end_miss_m(&stations, 50.0 + dwell_s, |age| 0.01 * run.remaining(age));
        let by_cure =
            end_miss_m(&stations, 50.0 + dwell_s, |age| remaining_by_cure(0.01, age, 0.3, 4.5));
        within(by_run, want, 2e-3 * want);
        close(by_cure, by_run, 1e-12);
    }
    close(remaining_by_cure(0.02, 0.475, 0.15, 0.8), 0.01, 1e-12);
    assert_eq!(remaining_by_cure(0.02, 0.9, 0.15, 0.8), 0.0);
    assert_eq!(remaining_by_cure(0.02, 0.1, 0.15, 0.8), 0.02);
}

#[test]
fn vol_shrink() {
    // VOL-SHRINK: 7.28 to 11.2 % measured. materials_reference.json has 8 (7.28–11.2) % for the resin: inside.
    let (low, high) = (0.0728, 0.112);
    assert!((low..=high).contains(&0.08));
    // What is linear of it, and of that what comes after the gel point (0.15 of 0.8): against linear_shrinkage of
    // materials/sla-resin-silica.toml, 1.5 (0.3–2.4) %.
    let after_gel = |volumetric: f64| {
        linear_shrinkage(volumetric) * (1.0 - remaining_by_cure(1.0, 0.8 - 0.15, 0.0, 0.8))
    };
    within(linear_shrinkage(low), 0.0249, 5e-5);
    within(linear_shrinkage(high), 0.0388, 5e-5);
    within(after_gel(low), 0.0202, 5e-5);
    within(after_gel(0.08), 0.0223, 5e-5);
    within(after_gel(high), 0.0315, 5e-5);
    // The low end and the middle of the band lie in the material's interval, its high end (3.2 %) does not: the
    // interval is that of data sheets, and its nominal 1.5 % is below all of the band.
    let (toml_low, toml_high) = (3.0e-3, 0.024);
    assert!((toml_low..=toml_high).contains(&after_gel(low)));
    assert!((toml_low..=toml_high).contains(&after_gel(0.08)));
    assert!(after_gel(high) > toml_high && after_gel(low) > 0.015);
    // A cube of what is left has the volume left.
    close((1.0 - linear_shrinkage(0.1)).powi(3), 0.9, 1e-14);
}

#[test]
fn a_miss_or_a_force_and_never_both() {
    let stiffness_n = 2.3e9 * 1.267e-6;
    let free = Shrinkage::new(0.268e-3, 0.1, FarEnd::Free);
    let joined = Shrinkage::new(0.268e-3, 0.1, FarEnd::Joined { stiffness_n });
    assert_eq!(
        (free.end_miss_m(), free.locked_strain(), free.locked_force_n()),
        (0.268e-3, 0.0, 0.0)
    );
    assert_eq!(joined.end_miss_m(), 0.0);
    close(joined.locked_strain(), 2.68e-3, 1e-12);
    close(joined.locked_force_n(), 2.3e9 * 1.267e-6 * 2.68e-3, 1e-12); // 7.8 N
    let none = Shrinkage::new(0.0, 0.0, FarEnd::Joined { stiffness_n });
    assert_eq!((none.locked_strain(), none.locked_force_n()), (0.0, 0.0));
}

#[test]
fn dwell_that_holds_a_limit() {
    // All of it below the set temperature when the nozzle has gone: δ falls as exp(−r dwell), so
    // the dwell to a share is ln(1/share)/r.
    let law = law(ABS, 0.00127, 200.0);
    let rate = law.room_rate_per_s;
    let cold = one_rate(378.15, law.air_k, rate);
    let strain = |age_s: f64| 8.8e-5 * (cold.temperature_k(age_s) - cold.air_k);
    let stations = steady(0.1, 0.005, 50);
    let after = |wait_s: f64| end_miss_m(&stations, 20.0 + wait_s, strain);
    for share in [0.9, 0.5, 0.01] {
        let got = remedy(share * after(0.0), 600.0, after);
        within(got.dwell_s.unwrap(), -f64::ln(share) / rate, 600.0 / 16e6);
        assert!(after(got.dwell_s.unwrap()) <= share * after(0.0));
        assert_eq!(got.over_travel_m, after(0.0));
    }
    // Held already: neither. Too short a wait allowed, or a limit below what is left for ever: none.
    let held = remedy(1.0, 600.0, after);
    assert_eq!((held.dwell_s, held.over_travel_m), (Some(0.0), 0.0));
    assert_eq!(remedy(0.01 * after(0.0), 1.0, after).dwell_s, None);
    assert_eq!(remedy(-1.0, 1e9, after).dwell_s, None);
    assert_eq!(remedy(0.0, f64::INFINITY, |_| f64::NAN).dwell_s, None);
    // Going past by the miss leaves a share of it as small as the strain.
    let far = end_miss_m(&steady(0.1 + after(0.0), 0.005, 50), 20.0 + after(0.0) / 0.005, strain);
    within(far - after(0.0), 0.0, 8.8e-5 * 83.0 * after(0.0));
}

proptest! {
    #[test]
    fn any_stations_and_samples_end(
        stations in prop::collection::vec((any::<f64>(), any::<f64>()), 0..6),
        samples in prop::collection::vec((any::<f64>(), any::<f64>()), 0..6),
        numbers in prop::array::uniform4(any::<f64>()),
    ) {
        let [left_s, set_k, air_k, limit] = numbers;
        let strain = remaining_by_cooling(&samples, set_k, air_k, |t| t);
        let miss = |wait_s: f64| end_miss_m(&stations, left_s + wait_s, |age| at_age(&strain, age));
        let got = remedy(limit, set_k, miss);
        prop_assert!(!got.dwell_s.is_some_and(|wait_s| wait_s < 0.0));
        let cure = remaining_by_cure(0.01, left_s, set_k, air_k);
        prop_assert!(cure.is_nan() || (0.0..=0.01).contains(&cure), "{cure}");
    }

    #[test]
    fn a_dwell_never_adds_to_the_miss(
        wait in 0.0..30.0f64, more in 0.0..30.0f64, h in 20.0..400.0f64, speed in 0.001..0.02f64,
    ) {
        let law = law(ABS, 0.00127, h);
        let strain = |age_s: f64| 8.8e-5 * (law.temperature_k(age_s).min(378.15) - law.air_k);
        let after = |wait_s: f64| {
            end_miss_m(&steady(0.1, speed, 20), 0.1 / speed + wait_s, strain)
        };
        prop_assert!(after(wait + more) <= after(wait));
    }
}
