use proptest::prelude::*;

use super::*;
use crate::process::tests::{close, within};

#[test]
fn interface_of_two_half_spaces_against_a_finite_volume_solution() {
    // ABS at 240 °C on aluminium-like 22 °C, then on ABS: the mean.
    within(interface_k(1.0, 513.15, 1.0, 295.15), 404.15, 1e-9);
    let (k, c) = ([0.19, 2.0], [1.6e6, 2.4e6]); // W/(m K), J/(m³ K)
    let (cells, size) = (400, 5e-6);
    let mut kelvin: Vec<f64> =
        (0..2 * cells).map(|i| if i < cells { 500.0 } else { 300.0 }).collect();
    let of = |i: usize| usize::from(i >= cells);
    let step_s = 0.2 * size * size * c[1] / k[1];
    let conductance = |i: usize| {
        let (a, b) = (k[of(i)], k[of(i + 1)]);
        2.0 / size * a * b / (a + b)
    };
    for _ in 0..4000 {
        let flux: Vec<f64> =
            (0..2 * cells - 1).map(|i| conductance(i) * (kelvin[i] - kelvin[i + 1])).collect();
        for i in 0..2 * cells - 1 {
            kelvin[i] -= flux[i] * step_s / (c[of(i)] * size);
            kelvin[i + 1] += flux[i] * step_s / (c[of(i + 1)] * size);
        }
    }
    let at_face = (k[0] * kelvin[cells - 1] + k[1] * kelvin[cells]) / (k[0] + k[1]);
    let want = interface_k(effusivity(k[0], c[0], 1.0), 500.0, effusivity(k[1], 1.0, c[1]), 300.0);
    within(at_face, want, 0.2);
}

#[test]
fn cooling_of_a_contact() {
    let contact = Contact { interface_k: 404.0, air_k: 295.0, hold_s: 0.3, rate_per_s: 0.2 };
    let samples = contact.samples(378.0, 600.0, 50);
    close(samples[1].0, 0.3, 1e-14);
    for &(time_s, kelvin) in &samples {
        close(kelvin, contact.temperature_k(time_s), 1e-13);
    }
    let last = samples[samples.len() - 1];
    close(last.0, 0.3 + (109.0_f64 / 83.0).ln() / 0.2, 1e-13);
    close(last.1, 378.0, 1e-13);
    // Never cold enough: to the longest time. Not warm enough: no time at all. No cooling: held.
    close(contact.samples(200.0, 20.0, 50).last().unwrap().0, 20.0, 1e-9);
    assert_eq!(contact.samples(500.0, 20.0, 50).len(), 2);
    let held = Contact { rate_per_s: 0.0, ..contact }.samples(378.0, 20.0, 50);
    assert_eq!(held.last(), Some(&(20.0, 404.0)));
    // R² / (16 α)
    close(front_s(0.002, 1e-7), 1e-6 / 16e-7, 1e-14);
}

/// The law as printed in process-physics.md section 5, for Γ/(a0 η) = 1.
fn printed_slope(angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    2.0_f64.powf(-5.0 / 3.0) * cos * sin * (2.0 - cos).cbrt() / ((1.0 - cos) * (1.0 + cos).cbrt())
}

#[test]
fn neck_slope_is_the_printed_law() {
    for angle in [1e-3, 0.1, 0.5, 1.0, 1.5] {
        close(neck_slope(angle * angle), 2.0 * angle * printed_slope(angle), 1e-9);
    }
    close(neck_slope(0.0), 1.0, 1e-15);
}

#[test]
fn neck_grows_as_the_root_of_time_at_first_and_stops_at_a_right_angle() {
    for flow in [1e-6, 1e-4, 1e-2] {
        // θ² = flow (1 + O(flow))
        close(neck_angle_after_rad(flow, 200).powi(2), flow, 0.5 * flow);
    }
    let mut last = 0.0;
    for i in 0..400 {
        let angle = neck_angle_after_rad(0.2 * f64::from(i), 200);
        assert!(angle >= last && angle <= FRAC_PI_2);
        last = angle;
    }
    close(last, FRAC_PI_2, 1e-9);
    close(neck_half_width_m(1.0, FRAC_PI_2), 2.0_f64.cbrt(), 1e-14);
    close(neck_half_width_m(1.0, 1e-4), 1e-4, 1e-7);
    assert!(neck_angle_after_rad(-1.0, 9) == 0.0 && neck_angle_after_rad(f64::NAN, 9) == 0.0);
}

#[test]
fn neck_solver_is_fourth_order_and_inverts_the_quadrature() {
    // Time to an angle is ∫ dθ / slope: brute force by the midpoint rule.
    let to = 1.2;
    let pieces = 200_000;
    let flow: f64 = (0..pieces)
        .map(|i| to * (f64::from(i) + 0.5) / f64::from(pieces))
        .map(|angle| to / f64::from(pieces) / printed_slope(angle))
        .sum();
    within(neck_angle_after_rad(flow, 200), to, 1e-9);
    for flow in [1e-4, 0.02, 0.3, 1.0, 3.0, 10.0, 30.0, 60.0, 1e9] {
        // The steps that `neck_angle_rad` takes.
        let fine = neck_angle_after_rad(flow, 20_000);
        within(neck_angle_after_rad(flow, 24), fine, 1e-6);
    }
    let exact = neck_angle_after_rad(flow, 6400);
    let errors = [4, 8, 16, 32].map(|steps| (neck_angle_after_rad(flow, steps) - exact).abs());
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((3.6..4.6).contains(&order), "{order} of {errors:?}");
    }
}

/// ABS of materials/abs.toml, surface tension 0.029 N/m of materials_reference.json (memory).
fn abs_neck_rad(samples: &[(f64, f64)]) -> f64 {
    neck_angle_rad(samples, 0.635e-3, 0.029, |kelvin| {
        let above = 51.6 + kelvin - 373.15;
        if above <= 0.0 {
            f64::INFINITY
        } else {
            9.95e11 * (-27.322 * (kelvin - 373.15) / above).exp()
        }
    })
}

#[test]
fn neck_of_abs_grows_only_when_hot() {
    let second = |celsius: f64| {
        let kelvin = celsius + 273.15;
        let angle = abs_neck_rad(&[(0.0, kelvin), (1.0, kelvin)]);
        neck_half_width_m(0.635e-3, angle) / 0.635e-3
    };
    // Half-width over radius after a second: "only fast above ~200 °C" (section 5).
    within(second(240.0), 0.146, 0.002);
    assert!(second(200.0) < 0.07 && second(131.0) < 2e-3, "{} {}", second(200.0), second(131.0));
    // A stretch cut in two flows the same, and what is rigid flows not at all.
    let whole = abs_neck_rad(&[(0.0, 500.0), (2.0, 420.0)]);
    close(abs_neck_rad(&[(0.0, 500.0), (0.5, 480.0), (2.0, 420.0)]), whole, 1e-6);
    assert!(abs_neck_rad(&[(0.0, 320.0), (2.0, 300.0)]) == 0.0);
}

#[test]
fn area_of_contact_against_a_count_of_the_gap() {
    let (diameter_m, half_m) = (0.002, 0.0002);
    let gap_m = half_m * half_m / (0.5 * diameter_m);
    for angle in [0.5, 1.0, FRAC_PI_2, 2.2] {
        let want = contact_area_m2(diameter_m, half_m, Touch::Crossing(angle));
        // Each bead is a parabola across its own axis; count the points where both leave less than the gap.
        let (side, cell) = (800, 2.4e-6);
        let (sin, cos) = angle.sin_cos();
        let mut inside = 0;
        for i in -side..side {
            for j in -side..side {
                let (x, y) = ((f64::from(i) + 0.5) * cell, (f64::from(j) + 0.5) * cell);
                let (across_one, across_two) = (y, x * sin - y * cos);
                let gap = (across_one.powi(2) + across_two.powi(2)) / diameter_m;
                inside += i32::from(gap <= gap_m);
            }
        }
        close(f64::from(inside) * cell * cell, want, 2e-3);
    }
    close(contact_area_m2(diameter_m, half_m, Touch::Alongside(0.05)), 2e-5, 1e-14);
    // Pressed flat altogether: the rhombus, not more.
    let flat = contact_area_m2(diameter_m, 0.01, Touch::Crossing(FRAC_PI_2));
    close(flat, diameter_m * diameter_m, 1e-14);
    assert!(contact_area_m2(diameter_m, -1.0, Touch::Crossing(1.0)) == 0.0);
}

#[test]
fn flat_of_pressed_beads() {
    close(pressed_half_width_m(0.002, 0.0016), 0.6e-3, 1e-12);
    assert!(pressed_half_width_m(0.002, 0.0021) == 0.0);
    close(pressed_half_width_m(0.002, 0.0), 0.001, 1e-14);
}

proptest! {
    #[test]
    fn any_contact_ends(
        interface_k in any::<f64>(), air_k in any::<f64>(), hold_s in any::<f64>(),
        rate_per_s in any::<f64>(), until in any::<f64>(), longest in any::<f64>(),
    ) {
        let contact = Contact { interface_k, air_k, hold_s, rate_per_s };
        let samples = contact.samples(until, longest, 8);
        prop_assert!(samples.len() <= 10);
        let angle = neck_angle_rad(&samples, until, longest, |t| t * rate_per_s);
        prop_assert!((0.0..=FRAC_PI_2).contains(&angle), "{angle}");
        let _ = contact_area_m2(air_k, hold_s, Touch::Crossing(until));
    }
}
