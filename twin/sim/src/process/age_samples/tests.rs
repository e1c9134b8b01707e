use super::*;
use crate::process::tests::{close, within};

#[test]
fn a_history_is_read_straight_between_its_samples() {
    let samples = [(1.0, 500.0), (2.0, 400.0), (4.0, 300.0)];
    for (age, want) in [(0.0, 500.0), (1.0, 500.0), (1.25, 475.0), (2.0, 400.0), (3.0, 350.0)] {
        close(at_age(&samples, age), want, 1e-14);
    }
    close(at_age(&samples, 9.0), 300.0, 1e-14);
    assert!(at_age(&[], 1.0).is_nan());
    close(time_above_s(&samples, 350.0), 2.0, 1e-14);
    assert!(time_above_s(&samples, 500.0) == 0.0);
}

#[test]
fn gauss_is_exact_to_degree_five_and_sixth_order_beyond() {
    let poly = |x: f64| 1.0 + x * (2.0 + x * (3.0 + x * (4.0 + x * (5.0 + 6.0 * x))));
    close(gauss(0.0, 2.0, 1, poly), 2.0 + 4.0 + 8.0 + 16.0 + 32.0 + 64.0, 1e-14);
    let error = |pieces| (gauss(0.0, 3.0, pieces, f64::exp) - 3.0_f64.exp_m1()).abs();
    let order = (error(2) / error(4)).log2();
    assert!((5.8..6.2).contains(&order), "{order}");
}

#[test]
fn a_steep_rate_on_one_stretch() {
    // ∫ exp(T/θ) along one straight line of 30 e-folds: θ per kelvin and second, closed.
    let (from, to, fold) = (300.0, 600.0, 10.0);
    let got = integral_above(&[(0.0, from), (5.0, to)], 0.0, |t| ((t - to) / fold).exp());
    let want = 5.0 * fold / (to - from) * -(-(to - from) / fold).exp_m1();
    close(got, want, 1e-6);
    // Falling is the same as rising, and a bound cuts the line where it crosses.
    close(integral_above(&[(0.0, to), (5.0, from)], 0.0, |t| ((t - to) / fold).exp()), got, 1e-13);
    let cut = integral_above(&[(0.0, from), (5.0, to)], 550.0, |t| ((t - to) / fold).exp());
    close(cut, 5.0 * fold / (to - from) * -(-50.0 / fold).exp_m1(), 1e-6);
    // Out of order or not a number: nothing.
    within(integral_above(&[(5.0, 1.0), (0.0, 1.0)], 0.0, |_| 1.0), 0.0, 0.0);
    within(integral_above(&[(0.0, f64::NAN), (1.0, 2.0)], 3.0, |_| 1.0), 0.0, 0.0);
}
