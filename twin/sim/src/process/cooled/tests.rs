//! What is drawn between the steps and after them.

use proptest::prelude::*;

use super::*;
use crate::process::radial::{Linear, RoundStrand, Span, Surroundings, cool};
use crate::process::tests::{close, within};

const STRAND: RoundStrand = RoundStrand {
    diameter_m: 3e-3,
    density_kg_m3: 1240.0,
    conductivity_w_mk: Linear::constant(0.18),
    cp_j_kgk: Linear::constant(1800.0),
};

fn span(until_s: f64, tolerance_k: f64) -> Span {
    Span { from_s: 0.0, until_s, stop_k: 0.0, tolerance_k, longest_step_s: f64::INFINITY }
}

#[test]
fn what_is_between_the_steps() {
    let around = Surroundings { air_k: 295.15, h_w_m2k: &|_, _| 200.0, source_w_m3: &|_| 0.0 };
    let got = cool(&STRAND, &[483.15; 12], &around, &span(25.0, 0.1));
    let fine = cool(&STRAND, &[483.15; 12], &around, &span(25.0, 1e-3));
    let mut sum = 0.0;
    for i in 0..50_000 {
        let age_s = 0.3 + 40.0 * (f64::from(i) + 0.5) / 50_000.0;
        sum += (got.mean_at_k(age_s) - 295.15) * 40.0 / 50_000.0;
        if age_s < 25.0 && i % 50 == 0 {
            within(got.mean_at_k(age_s), fine.mean_at_k(age_s), 0.05);
            within(got.core_at_k(age_s), fine.core_at_k(age_s), 0.1);
            let (surface, mean, core) =
                (got.surface_at_k(age_s), got.mean_at_k(age_s), got.core_at_k(age_s));
            assert!(surface < mean && mean < core, "{surface} {mean} {core} at {age_s}");
        }
    }
    close(got.excess_k_s(0.3, 40.3), sum, 1e-8);
    close(got.excess_k_s(2.0, 9.0) + got.excess_k_s(9.0, 31.0), got.excess_k_s(2.0, 31.0), 1e-12);
    for target_k in [483.0, 470.0, 400.0, 330.0, 305.0, 296.0] {
        close(got.mean_at_k(got.time_to_s(target_k)), target_k, 1e-9);
        close(got.core_at_k(got.core_time_to_s(target_k)), target_k, 1e-9);
    }
    assert!(got.time_to_s(500.0) == 0.0 && got.time_to_s(295.0).is_infinite());
    // A constant h: the tail after the last step is the true one, and its integral is finite.
    let cut = Span { stop_k: 380.0, ..span(1e4, 0.01) };
    let short = cool(&STRAND, &[483.15; 12], &around, &cut);
    let end_s = *short.ages_s.last().expect("an end");
    assert!(end_s < 25.0 && short.profile_k.iter().all(|&t| t <= 380.0));
    close(short.mean_at_k(24.0) - 295.15, fine.mean_at_k(24.0) - 295.15, 2e-3);
    assert!(short.excess_k_s(0.0, f64::INFINITY).is_finite());
}

#[test]
fn one_age_only() {
    let unknown = Cooled::unknown(300.0, 2.0);
    assert!(unknown.mean_at_k(1.0).is_nan() && unknown.surface_at_k(1.0).is_nan());
    assert!(unknown.core_at_k(3.0).is_nan() && unknown.time_to_s(310.0).is_infinite());
    let around = Surroundings { air_k: 300.0, h_w_m2k: &|_, _| 9.0, source_w_m3: &|_| 0.0 };
    let still = cool(&STRAND, &[400.0; 3], &around, &span(0.0, 0.1));
    assert_eq!(still.ages_s, [0.0]);
    close(still.mean_at_k(-1.0), 400.0, 1e-12);
    close(still.excess_k_s(-2.0, 0.0), 200.0, 1e-12);
}

proptest! {
    #[test]
    fn never_outside_its_ends(
        values in prop::array::uniform4(300.0..500.0_f64),
        slopes in prop::array::uniform4(-1e3..1e3_f64),
        share in 0.0..3.0_f64,
    ) {
        let ages_s = [0.0, 0.1, 0.7, 3.0];
        let curve = Curve { ages_s: &ages_s, values: &values, slopes: &slopes };
        let i = (share as usize).min(2);
        let width_s = ages_s[i + 1] - ages_s[i];
        let got = curve.piece(i).value((share - i as f64) * width_s);
        let (low, high) = (values[i].min(values[i + 1]), values[i].max(values[i + 1]));
        prop_assert!((low - 1e-9..=high + 1e-9).contains(&got));
        close(curve.piece(i).value(width_s), values[i + 1], 1e-12);
    }
}
