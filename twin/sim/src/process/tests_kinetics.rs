//! The law of cure by light against closed forms, its own refinement and the validation cases.

use super::cure::critical_exposure_at;
use super::cured::{Cured, Exposed, cure};
use super::kamal::Kamal;
use super::kinetics::Kinetics;
use super::tests::{close, within};

/// The reference's orders and degrees; the ratio of the rates is ours.
pub(super) fn acrylate() -> Kamal {
    Kamal { m: 0.7, n: 1.5, k1_per_s: 1.0, k2_per_s: 20.0, gel: 0.15, max: 0.8 }
}

/// Calibrated at 100 J/m², 200 W/m² and 25 °C.
pub(super) fn resin(b: f64) -> Kinetics {
    Kinetics {
        kamal: acrylate(),
        b,
        activation_j_mol: 30e3,
        reference_w_m2: 200.0,
        reference_k: 298.15,
    }
    .calibrated(100.0)
}

pub(super) fn at(age_s: f64, irradiance_w_m2: f64, temperature_k: f64) -> Exposed {
    Exposed { age_s, irradiance_w_m2, temperature_k }
}

pub(super) fn run(kinetics: &Kinetics, history: &[Exposed]) -> Cured {
    cure(kinetics, &kinetics.kamal.curve(), history, None)
}

/// Steady light at the reference temperature.
pub(super) fn steady(irradiance_w_m2: f64, until_s: f64) -> [Exposed; 2] {
    [at(0.0, irradiance_w_m2, 298.15), at(until_s, irradiance_w_m2, 298.15)]
}

/// Runge–Kutta of fourth order on the law as printed, steps of equal length.
pub(super) fn brute_force(rate: impl Fn(f64, f64) -> f64, until_s: f64, steps: u32) -> f64 {
    let h = until_s / f64::from(steps);
    let mut degree = 0.0;
    for i in 0..steps {
        let t = f64::from(i) * h;
        let a = rate(t, degree);
        let b = rate(t + 0.5 * h, degree + 0.5 * h * a);
        let c = rate(t + 0.5 * h, degree + 0.5 * h * b);
        let d = rate(t + h, degree + h * c);
        degree += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
    degree
}

#[test]
fn closed_forms_of_the_law() {
    let (k1, k2, max) = (0.3, 0.9, 0.8);
    let law = |m, n| Kamal { m, n, k1_per_s: k1, k2_per_s: k2, gel: 0.15, max };
    let (first, second, logistic) =
        (law(0.0, 1.0).curve(), law(0.0, 2.0).curve(), law(1.0, 1.0).curve());
    let zeroth = law(0.0, 0.0);
    for i in 1..400 {
        let t = 0.1 * f64::from(i);
        let k = k1 + k2;
        within(first.degree(t), max * -(-k * t).exp_m1(), 1e-14);
        within(second.degree(t), max * (1.0 - 1.0 / (1.0 + max * k * t)), 1e-14);
        within(zeroth.curve().degree(t), (k * t).min(max), 1e-12);
        let fade = (-(k1 + k2 * max) * t).exp();
        within(logistic.degree(t), max * (1.0 - fade) / (1.0 + k2 * max / k1 * fade), 5e-8);
    }
    for degree in [1e-9, 1e-4, 0.15, 0.5, 0.79, 0.799_999] {
        let logs = (k2 / k1 * degree).ln_1p() - (-degree / max).ln_1p();
        let want = logs / (k1 + k2 * max);
        close(law(1.0, 1.0).time_to_s(degree), want, 1e-9);
        close(law(0.0, 2.0).time_to_s(degree), degree / (k1 + k2) / max / (max - degree), 1e-9);
    }
}

/// The table's worst error against a finer one over a cure, with a number of cells.
fn table_error(law: &Kamal, cells: usize) -> f64 {
    let (fine, curve) = (law.curve_with(1600), law.curve_with(cells));
    let until_s = law.time_to_s(0.999 * law.max);
    let miss = |i: i32| {
        let t = until_s * 0.5_f64.powf(f64::from(i) / 40.0);
        (curve.degree(t) - fine.degree(t)).abs()
    };
    (0..800).map(miss).fold(0.0, f64::max)
}

#[test]
fn the_table_converges_with_the_fourth_power() {
    for (m, n, ratio) in [(0.7, 1.5, 20.0), (1.0, 1.0, 100.0), (0.4, 2.0, 5.0), (2.0, 1.2, 1e3)] {
        let law = Kamal { m, n, k1_per_s: 1.0, k2_per_s: ratio, ..acrylate() };
        let errors = [40, 80, 160].map(|cells| table_error(&law, cells));
        println!("m {m} n {n} k2/k1 {ratio}: {errors:?}");
        assert!(errors[2] < 3e-6, "{errors:?}");
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!(order > 3.6, "order {order}");
        }
    }
}

#[test]
fn the_critical_exposure_just_gels() {
    for b in [0.5, 0.6, 1.0] {
        let kinetics = resin(b);
        for ratio in [0.0, 1.0, 1e3] {
            let kamal = Kamal { k2_per_s: ratio, k1_per_s: 1.0, ..acrylate() };
            let kinetics = Kinetics { kamal, ..kinetics }.calibrated(100.0);
            let cured = run(&kinetics, &steady(200.0, 0.5));
            within(cured.at(0.5), 0.15, 1e-6);
            close(kinetics.gel_time_s(200.0, 298.15), 0.5, 1e-9);
            close(run(&kinetics, &steady(200.0, 9.0)).gel_age_s, 0.5, 1e-9);
            assert_eq!(run(&kinetics, &steady(200.0, 0.499)).gel_age_s, f64::INFINITY);
        }
    }
    // what the unknown ratio does after the gel point: time from 100 J/m² to nine tenths of the cure
    let late = |ratio| {
        let kamal = Kamal { k2_per_s: ratio, k1_per_s: 1.0, ..acrylate() }.gelling_in(0.5);
        kamal.time_to_s(0.72)
    };
    println!("t(0.72)/t(gel) for k2/k1 0, 20, 1000: {:?}", [0.0, 20.0, 1e3].map(|r| late(r) / 0.5));
    assert!(late(0.0) > 2.0 * late(20.0) && late(20.0) > late(1e3));
    // a gel point that is never reached never gels
    let kamal = Kamal { gel: 0.9, ..acrylate() }.gelling_in(0.5);
    assert_eq!(kamal.curve().degree(1e9), 0.0);
}

#[test]
fn ect_num() {
    // 5 mJ/cm² at 25 °C is 2.800 at 40 °C, out of the rates
    let kinetics = Kinetics { reference_w_m2: 10.0, ..resin(1.0) }.calibrated(50.0);
    let dose = kinetics.gel_time_s(10.0, 313.15) * 10.0;
    close(dose, 28.002_870_876_011_476, 1e-3);
    close(dose, critical_exposure_at(50.0, 30e3, 298.15, 313.15), 1e-9);
}

#[test]
fn light_doubled() {
    let doubled = |b: f64| {
        let kinetics = resin(b);
        let at = |irradiance| run(&kinetics, &steady(irradiance, 60.0));
        (at(200.0), at(400.0))
    };
    let (one, two) = doubled(1.0);
    for i in 1..100 {
        let age_s = 0.2 * f64::from(i);
        within(two.at(age_s), one.at(2.0 * age_s), 1e-12);
    }
    close(two.gel_age_s, 0.5 * one.gel_age_s, 1e-12);
    // reciprocity fails at b = 1/2: half the time takes √2 of the light back, the dose to gel is √2 Ec
    let (one, two) = doubled(0.5);
    close(two.gel_age_s, one.gel_age_s / 2.0_f64.sqrt(), 1e-12);
    close(two.gel_age_s * 400.0, 2.0_f64.sqrt() * 100.0, 1e-9);
    assert!(two.at(0.25) < one.at(0.5));
}
