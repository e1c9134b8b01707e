//! Heat transfer and cooling against tables and the Bessel series.

use super::heat;
use super::reference::{eigenvalues, fourier_to};
use super::tests::{close, within};

#[test]
fn nusselt_thin() {
    // materials_reference.json air_cooling_h_w_m2k: Ts 160 °C, Ta 22 °C, radiation apart.
    let table = [
        (0.4, [57.5, 134.0, 180.0, 246.0, 376.0, 524.0, 735.0]),
        (1.0, [32.0, 80.0, 109.0, 150.0, 234.0, 328.0, 464.0]),
        (1.27, [27.9, 70.0, 96.0, 133.0, 207.0, 291.0, 412.0]),
        (1.75, [23.5, 59.0, 81.0, 112.0, 176.0, 248.0, 352.0]),
        (3.0, [18.1, 44.0, 61.0, 85.0, 134.0, 190.0, 271.0]),
    ];
    let (surface, air) = (433.15, 295.15);
    let mut worst: f64 = 0.0;
    for (diameter_mm, row) in table {
        let diameter = diameter_mm * 1e-3;
        for (air_m_s, want) in [0.0, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0].into_iter().zip(row) {
            let got = if air_m_s == 0.0 {
                heat::natural_h_w_m2k(diameter, surface, air)
            } else {
                heat::forced_h_w_m2k(diameter, surface, air, air_m_s)
            };
            worst = worst.max((got / want - 1.0).abs());
        }
    }
    assert!(worst < 0.02, "{worst}");
    within(heat::radiation_h_w_m2k(0.92, surface, air), 10.4, 0.05);
}

#[test]
fn cool_lump() {
    let rate = heat::cooling_rate_per_s(100.0, 1040.0, 1950.0, 0.00127);
    let law = one_rate(513.15, 295.15, rate);
    close(law.time_to_s(378.15), 6.217_752_470_251_151, 1e-9);
    close(law.temperature_k(law.time_to_s(378.15)), 378.15, 1e-12);
    assert!(law.time_to_s(290.0).is_infinite() && law.time_to_s(600.0) == 0.0);
    // Two rates: continuous, and the excess is the integral of the temperature.
    let law = heat::Cooling { jet_until_s: 1.5, jet_rate_per_s: 0.8, ..law };
    let target = law.temperature_k(2.7);
    close(law.time_to_s(target), 2.7, 1e-12);
    let steps = 20_000;
    let sum: f64 = (0..steps)
        .map(|i| law.temperature_k(0.4 + 3.0 * (f64::from(i) + 0.5) / f64::from(steps)) - law.air_k)
        .sum();
    close(law.excess_k_s(0.4, 3.4), sum * 3.0 / f64::from(steps), 1e-7);
}

pub(super) fn one_rate(start_k: f64, air_k: f64, rate: f64) -> heat::Cooling {
    heat::Cooling { start_k, air_k, jet_rate_per_s: rate, jet_until_s: 0.0, room_rate_per_s: rate }
}

/// First root and its amplitude at the centre.
fn cylinder(biot: f64, zeta: f64, amplitude: f64) {
    let (z, c) = eigenvalues(biot)[0];
    within(z, zeta, 2e-5);
    within(c, amplitude, 2e-5);
}

#[test]
fn cyl_eigen_bi0_1() {
    cylinder(0.1, 0.44168, 1.02458);
}

#[test]
fn cyl_eigen_bi0_5() {
    cylinder(0.5, 0.94077, 1.11425);
}

#[test]
fn cyl_eigen_bi1() {
    cylinder(1.0, 1.25578, 1.20709);
}

#[test]
fn cyl_eigen_bi2() {
    cylinder(2.0, 1.59945, 1.33838);
}

#[test]
fn cyl_eigen_bi5() {
    cylinder(5.0, 1.98981, 1.50287);
}

/// rho, cp, k, T0, T_flow, T_glass, D mm, h; times: mean and centre to flow, mean and centre to glass.
pub(super) const RADIAL: [(&str, [f64; 8], [f64; 4]); 5] = [
    (
        "ABS-1.27-100",
        [1040.0, 1950.0, 0.19, 240.0, 150.0, 105.0, 1.27, 100.0],
        [3.71, 4.25, 6.74, 7.28],
    ),
    (
        "ABS-3-200",
        [1040.0, 1950.0, 0.19, 240.0, 150.0, 105.0, 3.0, 200.0],
        [5.46, 8.59, 10.19, 13.34],
    ),
    (
        "PLA-1.27-200",
        [1240.0, 1800.0, 0.18, 210.0, 155.0, 60.0, 1.27, 200.0],
        [1.42, 2.06, 6.68, 7.32],
    ),
    (
        "PLA-3-100",
        [1240.0, 1800.0, 0.18, 210.0, 155.0, 60.0, 3.0, 100.0],
        [6.84, 10.42, 32.45, 36.04],
    ),
    (
        "PLA-3-400",
        [1240.0, 1800.0, 0.18, 210.0, 155.0, 60.0, 3.0, 400.0],
        [2.27, 5.77, 12.5, 16.28],
    ),
];

#[test]
fn radial_cooling_and_the_lumped_law() {
    // COOL-RADIAL-*: the series, and the law used, held to the error its docs state for its Biot number.
    for (_, [rho, cp, k, start, flow, glass, d_mm, h], want) in RADIAL {
        let diameter = d_mm * 1e-3;
        let biot = h * diameter / 2.0 / k;
        let per_fourier = diameter * diameter / 4.0 * rho * cp / k;
        let share = |target: f64| (target - 22.0) / (start - 22.0);
        let got = [(flow, false), (flow, true), (glass, false), (glass, true)]
            .map(|(target, centre)| per_fourier * fourier_to(biot, share(target), centre));
        let effective = heat::effective_h_w_m2k(h, diameter, k);
        let law = one_rate(start, 22.0, heat::cooling_rate_per_s(effective, rho, cp, diameter));
        for (got, want) in got.into_iter().zip(want) {
            within(got, want, 0.02);
        }
        let bound = if biot <= 0.7 {
            0.02
        } else if biot <= 1.7 {
            0.065
        } else {
            0.21
        };
        close(law.time_to_s(flow), want[0], bound);
        close(law.time_to_s(glass), want[2], bound);
    }
}

#[test]
fn cool_effh() {
    for (biot, want) in [(0.1, 0.001), (0.7, 0.016), (1.5, 0.057), (3.0, 0.145)] {
        let worst = [0.7, 0.5, 0.4, 0.2]
            .map(|share: f64| {
                // With D = 2, k = 1, rho cp = 1 time is the Fourier number and h the Biot number.
                let h = heat::effective_h_w_m2k(biot, 2.0, 1.0);
                let rate = heat::cooling_rate_per_s(h, 1.0, 1.0, 2.0);
                (-share.ln() / rate / fourier_to(biot, share, false) - 1.0).abs()
            })
            .into_iter()
            .fold(0.0, f64::max);
        within(worst, want, 0.01);
    }
}
