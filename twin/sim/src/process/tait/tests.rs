//! Tait's fit against printed densities and its own derivatives.

use proptest::prelude::*;

use super::*;
use crate::process::tests::{close, within};

/// ABS Cycolac MG47, materials_reference.json (Kazmer App. A, second hand).
fn abs() -> Tait {
    Tait {
        b5_k: 370.6,
        b6_k_pa: 2.3e-7,
        melt: TaitBranch {
            b1_m3_kg: 9.83e-4,
            b2_m3_kgk: 6.51e-7,
            b3_pa: 1.33e8,
            b4_per_k: 4.38e-3,
        },
        solid: TaitBranch {
            b1_m3_kg: 9.83e-4,
            b2_m3_kgk: 3.47e-7,
            b3_pa: 2.16e8,
            b4_per_k: 4.14e-3,
        },
    }
}

#[test]
fn abs_tait() {
    let fit = abs();
    close(fit.density_kg_m3(296.15, 0.0), 1044.8, 0.002);
    close(fit.density_kg_m3(513.15, 0.0), 929.5, 0.002);
    close(-100.0 * fit.linear_strain(370.6, 296.15), 0.884, 0.002);
    close(100.0 * (1.0 - fit.volume_ratio(513.15, 370.6)), 8.63, 0.002);
    // Printed in process-physics.md: transition 97.4 °C, 118e-6 per K just below it, D_cold/D_hot 0.945.
    within(fit.transition_k(0.0) - 273.15, 97.45, 0.051);
    within(fit.linear_expansion_per_k(370.5, 0.0), 118e-6, 0.5e-6);
    within(fit.volume_ratio(513.15, 296.15).sqrt(), 0.945, 0.002);
}

#[test]
fn pressure() {
    let fit = abs();
    within(fit.transition_k(100e6), 393.6, 1e-9);
    // v (1 − C ln(1 + P/B)) by hand: at 400 K and 50 MPa, B = 1.33e8 exp(−4.38e-3 · 29.4).
    let stiffness = 1.33e8 * (-4.38e-3 * 29.4_f64).exp();
    let want = (9.83e-4 + 6.51e-7 * 29.4) * (1.0 - 0.0894 * (1.0 + 50e6 / stiffness).ln());
    close(fit.specific_volume_m3_kg(400.0, 50e6), want, 1e-12);
    // Where the branches meet: even at no pressure, at 100 MPa the solid 1.1 % lighter, as the docs say.
    let jump = |p: f64| {
        let at = fit.transition_k(p);
        fit.density_kg_m3(at + 1e-9, p) / fit.density_kg_m3(at - 1e-9, p) - 1.0
    };
    within(jump(0.0), 0.0, 1e-9);
    within(jump(100e6), 0.011, 5e-4);
}

#[test]
fn expansion_is_the_slope_and_its_sum_the_strain() {
    let fit = abs();
    for (t, p) in [(300.0, 0.0), (350.0, 40e6), (380.0, 0.0), (480.0, 90e6)] {
        let volume = |t: f64| fit.specific_volume_m3_kg(t, p);
        let slope = (volume(t + 1e-3) - volume(t - 1e-3)) / 2e-3;
        close(fit.linear_expansion_per_k(t, p), slope / (3.0 * volume(t)), 1e-7);
    }
    let steps = 2000;
    let sum: f64 = (0..steps)
        .map(|i| {
            let t = 300.0 + 200.0 * (f64::from(i) + 0.5) / f64::from(steps);
            fit.linear_expansion_per_k(t, 0.0) * 200.0 / f64::from(steps)
        })
        .sum();
    close(fit.linear_strain(300.0, 500.0), sum.exp_m1(), 1e-4);
    // By way of a temperature between, the same.
    let by = (1.0 + fit.linear_strain(500.0, 340.0)) * (1.0 + fit.linear_strain(340.0, 300.0));
    close(by, 1.0 + fit.linear_strain(500.0, 300.0), 1e-12);
    assert_eq!(fit.linear_strain(333.0, 333.0), 0.0);
}

proptest! {
    #[test]
    fn never_panics(t in prop::num::f64::ANY, p in prop::num::f64::ANY) {
        let fit = abs();
        let _ = (fit.density_kg_m3(t, p), fit.linear_expansion_per_k(t, p), fit.linear_strain(t, p));
    }

    #[test]
    fn lighter_when_hotter_denser_when_pressed(t in 290.0..520.0_f64, p in 0.0..150e6_f64) {
        let fit = abs();
        prop_assert!(fit.linear_expansion_per_k(t, p) > 0.0);
        // On a branch; where they meet the fit jumps.
        if (t > fit.transition_k(p)) == (t > fit.transition_k(p + 1e6)) {
            prop_assert!(fit.density_kg_m3(t, p + 1e6) > fit.density_kg_m3(t, p));
        }
    }
}
