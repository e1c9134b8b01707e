//! The viscous catenary: bending law, stretching law, where they meet.

use super::super::sag::{LINEAR_LIMIT, stretched_sag_m, viscous_bridge_m};
use super::super::tests::{close, within};
use super::*;

/// `(3 s/128)^⅓`, sag over diameter by stretching alone.
fn stretching(load: f64) -> f64 {
    (3.0 * load / 128.0).cbrt()
}

fn filament(load: f64) -> f64 {
    filament_sag(&[load], 64, 40)[0]
}

#[test]
fn visc_catenary_early_filament() {
    for load in [0.1, 1.0, 3.0] {
        close(filament(load), load / 72.0, 0.02);
    }
    let bending = viscous_bridge_m(12_164.4, 0.05, 0.5, 4000.0, 0.0015);
    close(held_sag_m(bending * 1e-3, 0.0015), bending * 1e-3, 1e-3);
}

#[test]
fn visc_catenary_stretch() {
    for load in [1e4, 1e5, 1e6] {
        close(filament(load), stretching(load), 0.1);
        close(held_sag_m(load / 72.0, 1.0), stretching(load), 0.1);
    }
    // t^⅓
    let exponent = (filament(1e6) / filament(1e4)).ln() / 100.0_f64.ln();
    within(exponent, 1.0 / 3.0, 0.01);
}

#[test]
fn visc_catenary_xover() {
    // Where the law of the early filament, c t, meets that of the late one, k t^⅓: at (k³/c)^½.
    let early = filament(0.5) / 0.5;
    let late = filament(1e6) / 1e6_f64.cbrt();
    close((late.powi(3) / early).sqrt(), 1.299, 0.1);
    let early = held_sag_m(1e-3, 1.0) / (72.0 * 1e-3);
    let late = held_sag_m(1e8 / 72.0, 1.0) / 1e8_f64.cbrt();
    close((late.powi(3) / early).sqrt(), LINEAR_LIMIT, 1e-3);
}

#[test]
fn one_amplitude_is_the_filament() {
    let loads: Vec<f64> = (0..47).map(|i| 0.2 * 1.35_f64.powi(i)).collect();
    let sags = filament_sag(&loads, 64, 40);
    let mut worst = 0.0_f64;
    for (load, sag) in loads.iter().zip(&sags) {
        worst = worst.max((held_sag_m(load / 72.0, 1.0) / sag - 1.0).abs());
    }
    assert!(worst < 0.041, "{worst}");
    assert!(sags.windows(2).all(|pair| pair[0] < pair[1]));
    // below the lower of both laws, and nowhere less than 0.68 of it
    for load in loads {
        let share = held_sag_m(load / 72.0, 1.0) / stretched_sag_m(load / 72.0, 1.0).0;
        assert!((0.68..=1.0).contains(&share), "{share}");
    }
}

#[test]
fn filament_orders() {
    let at = |cells, steps| filament_sag(&[300.0], cells, steps)[0];
    let order = |a: f64, b: f64, c: f64| ((a - b) / (b - c)).abs().log2();
    let cells = order(at(16, 40), at(32, 40), at(64, 40));
    let steps = order(at(32, 2), at(32, 4), at(32, 8));
    assert!((1.9..2.1).contains(&cells), "{cells}");
    assert!((3.5..5.5).contains(&steps), "{steps}");
    // loads asked for on the way change nothing but by the steps
    let on_the_way = filament_sag(&[10.0, 100.0, 300.0], 32, 40);
    close(on_the_way[2], at(32, 40), 1e-6);
}

proptest::proptest! {
    #![proptest_config(proptest::test_runner::Config::with_cases(24))]
    #[test]
    fn any_sag(bending in proptest::num::f64::ANY, diameter in proptest::num::f64::ANY) {
        let held = held_sag_m(bending, diameter);
        proptest::prop_assert!(held.is_nan() || held <= bending * (1.0 + 1e-12) || !(bending > 0.0));
        proptest::prop_assert_eq!(filament_sag(&[bending.min(1e9)], 4, 1).len(), 1);
    }
}
