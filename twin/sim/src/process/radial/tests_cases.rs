//! Radial cooling against the cases of `process_validation_cases.json`, the printed table and the series.

use super::tests::{NO_SOURCE, plain, span};
use super::{Surroundings, cool, uniform_profile_k};
use crate::process::reference::fourier_to;
use crate::process::tests::{close, within};
use crate::process::tests_heat::RADIAL;

/// Times to flow and glass, mean and core, of a COOL-RADIAL case with twelve rings.
fn cool_radial(id: &str) {
    let (_, [rho, cp, k, start, flow, glass, d_mm, h], want) =
        RADIAL.into_iter().find(|case| case.0 == id).expect("a case of that id");
    let strand = plain(d_mm * 1e-3, rho, k, cp);
    let around = Surroundings { air_k: 295.15, h_w_m2k: &|_, _| h, source_w_m3: &NO_SOURCE };
    let got = cool(&strand, &uniform_profile_k(start + 273.15, 12), &around, &span(60.0, 0.1));
    let (flow, glass) = (flow + 273.15, glass + 273.15);
    within(got.time_to_s(flow), want[0], 0.02);
    within(got.core_time_to_s(flow), want[1], 0.02);
    within(got.time_to_s(glass), want[2], 0.02);
    within(got.core_time_to_s(glass), want[3], 0.02);
    let steps = got.ages_s.len();
    assert!(steps < 130, "{steps}");
}

#[test]
fn cool_radial_abs_1_27_100() {
    cool_radial("ABS-1.27-100");
}

#[test]
fn cool_radial_abs_3_200() {
    cool_radial("ABS-3-200");
}

#[test]
fn cool_radial_pla_1_27_200() {
    cool_radial("PLA-1.27-200");
}

#[test]
fn cool_radial_pla_3_100() {
    cool_radial("PLA-3-100");
}

#[test]
fn cool_radial_pla_3_400() {
    cool_radial("PLA-3-400");
}

#[test]
fn printed_times_of_the_mean() {
    // process-physics.md 2.2, to flow arrest and to Tg at h = 40, 100, 200, 400; PLA at 3 mm and 400: 12.5.
    let abs = |d_mm: f64| (plain(d_mm * 1e-3, 1040.0, 0.19, 1950.0), [240.0, 150.0, 105.0]);
    let pla = |d_mm: f64| (plain(d_mm * 1e-3, 1240.0, 0.18, 1800.0), [210.0, 155.0, 60.0]);
    let table = [
        (abs(1.27), [[8.9, 16.0], [3.7, 6.7], [2.0, 3.6], [1.1, 2.1]]),
        (abs(3.0), [[22.0, 40.0], [9.6, 18.0], [5.5, 10.0], [3.3, 6.5]]),
        (pla(1.27), [[6.3, 29.0], [2.7, 12.0], [1.4, 6.7], [0.8, 3.9]]),
        (pla(3.0), [[16.0, 73.0], [6.8, 32.0], [3.8, 19.0], [2.3, 12.5]]),
    ];
    for ((strand, [start, flow, glass]), row) in table {
        for (h, want) in [40.0, 100.0, 200.0, 400.0].into_iter().zip(row) {
            let around =
                Surroundings { air_k: 295.15, h_w_m2k: &|_, _| h, source_w_m3: &NO_SOURCE };
            let start = uniform_profile_k(start + 273.15, 12);
            let got = cool(&strand, &start, &around, &span(100.0, 0.1));
            for (target, want) in [flow, glass].into_iter().zip(want) {
                // Half of the last digit printed, and the 0.02 s of COOL-RADIAL-*.
                let half = if want < 10.0 { 0.07 } else { 0.52 };
                within(got.time_to_s(target + 273.15), want, half);
            }
        }
    }
}

#[test]
fn second_order_in_space() {
    // Against the series, so fine in time that only the rings count: PLA-3-400, Bi 3.3.
    let strand = plain(3e-3, 1240.0, 0.18, 1800.0);
    let around = Surroundings { air_k: 295.15, h_w_m2k: &|_, _| 400.0, source_w_m3: &NO_SOURCE };
    let error_s = |rings: usize| {
        let start = uniform_profile_k(483.15, rings);
        let got = cool(&strand, &start, &around, &span(7.0, 2e-3));
        [got.time_to_s(428.15), got.core_time_to_s(428.15)].map(f64::abs)
    };
    let per_fourier = 0.0015_f64.powi(2) * 1240.0 * 1800.0 / 0.18;
    let exact = [false, true]
        .map(|centre| per_fourier * fourier_to(400.0 * 0.0015 / 0.18, 133.0 / 188.0, centre));
    let errors = [6, 12, 24].map(|rings| {
        let got = error_s(rings);
        [got[0] - exact[0], got[1] - exact[1]]
    });
    for i in [0, 1] {
        let orders = [0, 1].map(|j| (errors[j][i] / errors[j + 1][i]).log2());
        assert!(orders.iter().all(|o| (1.7..2.6).contains(o)), "{orders:?} of {errors:?}");
    }
}

#[test]
fn one_ring_that_conducts_well_is_the_lumped_law() {
    // COOL-LUMP
    let strand = plain(0.00127, 1040.0, 1e6, 1950.0);
    let around = Surroundings { air_k: 295.15, h_w_m2k: &|_, _| 100.0, source_w_m3: &NO_SOURCE };
    let got = cool(&strand, &uniform_profile_k(513.15, 1), &around, &span(20.0, 0.01));
    close(got.time_to_s(378.15), 6.217_752_470_251_151, 1e-4);
    close(got.core_time_to_s(378.15), 6.217_752_470_251_151, 1e-4);
}
