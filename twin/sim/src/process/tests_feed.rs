//! Lagged flow against small steps in time, closed forms, and itself.

use std::f64::consts::PI;

use proptest::prelude::*;

use super::bead::{Station, arc_at_m};
use super::drive::{Drive, diameter_error};
use super::feed::{
    Delivered, Feed, Told, coast_time_s, prime_time_s, sphere_diameter_m, stored_m3,
};
use super::tests::{close, within};

fn any_drive(lag_s: f64) -> Feed {
    Feed { lag_s, drive: Drive::Any }
}

fn deliver(lag_s: f64, steps: &[(f64, f64)]) -> Delivered {
    any_drive(lag_s).deliver(&Told::new(steps.to_vec()))
}

const STEPS: [(f64, f64); 5] = [(-1.0, 4e-9), (0.5, 6e-9), (1.7, 1e-9), (3.0, 5e-9), (4.0, 0.0)];

/// Flow and volume at the end by the classical Runge–Kutta method from rest at −1 s, a whole number of steps
/// to each piece.
fn marched(lag_s: f64, end_s: f64, per_piece: u32) -> (f64, f64) {
    let (mut flow, mut volume) = (0.0, 0.0);
    for (i, &(from_s, told)) in STEPS.iter().enumerate() {
        let to_s = STEPS.get(i + 1).map_or(end_s, |next| next.0);
        let step = (to_s - from_s) / f64::from(per_piece);
        let slope = |q: f64| (told - q) / lag_s;
        for _ in 0..per_piece {
            let (q1, k1) = (flow, slope(flow));
            let (q2, k2) = (flow + 0.5 * step * k1, slope(flow + 0.5 * step * k1));
            let (q3, k3) = (flow + 0.5 * step * k2, slope(flow + 0.5 * step * k2));
            let (q4, k4) = (flow + step * k3, slope(flow + step * k3));
            volume += step * (q1 + 2.0 * q2 + 2.0 * q3 + q4) / 6.0;
            flow += step * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
        }
    }
    (flow, volume)
}

#[test]
fn exact_against_marching() {
    for lag in [0.1, 0.6, 3.0] {
        let out = deliver(lag, &STEPS);
        let errors: Vec<f64> = [20, 40]
            .map(|count| {
                let (flow, volume) = marched(lag, 4.5, count);
                close(flow, out.flow_m3_s(4.5), 1e-2);
                ((volume - out.volume_m3(-1.0, 4.5)) / volume).abs()
            })
            .to_vec();
        // The march closes in on ours at its own fourth order
        assert!((12.0..22.0).contains(&(errors[0] / errors[1])), "{lag}: {errors:?}");
        let (flow, volume) = marched(lag, 4.5, 1000);
        close(flow, out.flow_m3_s(4.5), 1e-8);
        close(volume, out.volume_m3(-1.0, 4.5), 1e-10);
    }
}

#[test]
fn no_lag_and_endless_lag() {
    let steady = deliver(0.0, &STEPS);
    assert!(steady.flow_m3_s(-1.1) == 0.0 && steady.flow_m3_s(0.5) == 6e-9);
    close(steady.volume_m3(-2.0, 9.0), 6e-9 + 1.2 * 6e-9 + 1.3e-9 + 5e-9, 1e-12);
    close(deliver(1e-9, &STEPS).volume_m3(0.0, 3.5), steady.volume_m3(0.0, 3.5), 1e-8);
    for (lag, want) in [(-1.0, 6e-9), (f64::NAN, 6e-9), (f64::INFINITY, 0.0)] {
        assert!(deliver(lag, &STEPS).flow_m3_s(1.0) == want);
    }
    assert!(deliver(f64::INFINITY, &STEPS).volume_m3(-5.0, 9.0) == 0.0);
    // In the end all that was given has come: a lag moves volume, it loses none
    close(deliver(2.0, &STEPS).volume_m3(-1.0, f64::INFINITY), steady.volume_m3(-1.0, 5.0), 1e-12);
    assert!(deliver(2.0, &STEPS[..2]).volume_m3(0.0, f64::INFINITY).is_infinite());
    // Out of order, doubled, broken
    let shuffled: Vec<(f64, f64)> = STEPS.iter().rev().copied().collect();
    assert_eq!(deliver(0.6, &shuffled), deliver(0.6, &STEPS));
    let broken = [&[(f64::NAN, 1.0), (0.0, f64::INFINITY)], &STEPS[..]].concat();
    assert_eq!(deliver(0.6, &broken), deliver(0.6, &STEPS));
    assert!(deliver(0.6, &[]).volume_m3(0.0, 1.0) == 0.0);
}

#[test]
fn priming_fills_the_lag() {
    // 95 % after τ ln 20 from rest; from half the flow, ln 10
    close(prime_time_s(0.5, 0.0, 5e-9, 0.95), 0.5 * 20.0_f64.ln(), 1e-12);
    close(prime_time_s(0.5, 2.5e-9, 5e-9, 0.95), 0.5 * 10.0_f64.ln(), 1e-12);
    for (lag, old) in [(0.1, 0.0), (0.7, 3e-9), (4.0, 1e-9)] {
        let given = 6e-9;
        let prime = prime_time_s(lag, old, given, 0.95);
        // The old flow is reached at zero by having been told it for ages
        let out = deliver(lag, &[(-1000.0, old), (0.0, given)]);
        close(out.flow_m3_s(prime), 0.95 * given, 1e-12);
    }
    assert!(
        prime_time_s(0.5, 5e-9, 5e-9, 0.95) == 0.0 && prime_time_s(0.0, 0.0, 5e-9, 0.95) == 0.0
    );
    assert!(prime_time_s(0.5, 0.0, 5e-9, 1.0).is_infinite());
    assert!(prime_time_s(0.5, 0.0, f64::NAN, 0.95) == 0.0);
}

#[test]
fn starvation_from_rest() {
    let (lag, flow, speed, share) = (0.5, 6e-9, 0.005, 0.9);
    let out = deliver(lag, &[(0.0, flow), (20.0, 0.0)]);
    let starved = out.starved(0.0, 20.0, share);
    close(starved.missing_m3, flow * lag * (1.0 - (-20.0_f64 / lag).exp()), 1e-12);
    close(starved.missing_m3, flow * 20.0 - out.volume_m3(0.0, 20.0), 1e-12);
    close(starved.thin_s, lag * (1.0 / (1.0 - share * share)).ln(), 1e-12);
    // Just there the bead is the share of its diameter; as a length along the path
    close((out.flow_m3_s(starved.thin_s) / flow).sqrt(), share, 1e-12);
    let path = [(0.0, 0.0), (20.0, 20.0 * speed)].map(|(time_s, arc_m)| Station { time_s, arc_m });
    close(arc_at_m(&path, starved.thin_s), speed * starved.thin_s, 1e-12);
    // Priming for the time that fills the lag to share² leaves no thin start; longer primes leave less missing
    let prime = prime_time_s(lag, 0.0, flow, share * share);
    let primed = deliver(lag, &[(-prime, flow)]).starved(0.0, 20.0, share);
    assert!(primed.thin_s < 1e-12 && primed.missing_m3 < starved.missing_m3);
    // Told late: thin until then too. Told nothing: thin all along.
    let late = deliver(lag, &[(1.0, flow)]).starved(0.0, 20.0, share);
    close(late.thin_s, 1.0 + starved.thin_s, 1e-12);
    assert!(deliver(lag, &[]).starved(0.0, 20.0, share).thin_s == 20.0);
    assert!(deliver(lag, &[(-1.0, 0.0)]).starved(0.0, 20.0, share).thin_s == 20.0);
    assert!(deliver(0.0, &[(0.0, flow)]).starved(0.0, 20.0, share).thin_s == 0.0);
}

#[test]
fn starvation_against_small_steps() {
    let out = deliver(0.6, &STEPS);
    let count = 200_000;
    let step = 4.0 / f64::from(count);
    let missing: f64 = (0..count)
        .map(|i| (f64::from(i) + 0.5) * step)
        .map(|time| (out.given_m3_s(time) - out.flow_m3_s(time)).max(0.0) * step)
        .sum();
    close(out.starved(0.0, 4.0, 0.9).missing_m3, missing, 1e-6);
    // A share so high that the next step comes before it is reached
    let thin = out.starved(0.0, 4.0, 0.99).thin_s;
    let brute = (0..count)
        .map(|i| (f64::from(i) + 0.5) * step)
        .find(|&time| out.flow_m3_s(time) >= 0.99 * 0.99 * out.given_m3_s(time));
    within(thin, brute.unwrap(), 2.0 * step);
}

#[test]
fn blobs_at_both_ends() {
    let (lag, flow, prime, dwell) = (0.8, 6e-9, 1.5, 0.5);
    let out = deliver(lag, &[(-prime, flow), (10.0, 0.0)]);
    let blobs = out.blobs(-prime, 0.0, 10.0, 10.0 + dwell, f64::INFINITY);
    let filled = |time: f64| 1.0 - (-time / lag).exp();
    close(blobs.start_m3, flow * (prime - lag * filled(prime)), 1e-12);
    let last = out.flow_m3_s(10.0);
    close(blobs.end_m3, last * lag * filled(dwell), 1e-12);
    close(blobs.ooze_m3, last * lag * (-dwell / lag).exp(), 1e-12);
    // All that the drive gave is in blobs, bead and ooze
    let bead = out.volume_m3(0.0, 10.0);
    close(blobs.start_m3 + bead + blobs.end_m3 + blobs.ooze_m3, flow * (10.0 + prime), 1e-12);
    // Sphere of 1 mm: π/6 mm³
    close(sphere_diameter_m(PI / 6.0 * 1e-9), 1e-3, 1e-12);
    assert!(sphere_diameter_m(-1.0) == 0.0);
    // Stopping early by the coast time leaves that volume after the end
    let coast = coast_time_s(lag, flow, 1e-9);
    let early = deliver(lag, &[(-100.0, flow), (10.0 - coast, 0.0)]);
    close(early.volume_m3(10.0, f64::INFINITY), 1e-9, 1e-9);
    // A retract of what is stored leaves nothing to come
    let stored = stored_m3(lag, flow);
    close(early.volume_m3(10.0 - coast, f64::INFINITY), stored, 1e-9);
    let drawn = deliver(lag, &[(-100.0, flow), (10.0, -stored / 0.3), (10.3, 0.0)]);
    within(drawn.volume_m3(10.0, f64::INFINITY) / stored, 0.0, 1e-9);
    assert!(stored_m3(-1.0, flow) == 0.0);
    assert!(coast_time_s(lag, flow, 1.0) == 0.0 && coast_time_s(lag, flow, 0.0).is_infinite());
}

#[test]
fn kirkman_levels_and_on_off() {
    // Eight levels of three relay bits, 0 to 7 times 1 mm³/s
    let levels = Drive::Levels((0..8).map(|i| f64::from(i) * 1e-9).collect());
    close(levels.given_m3_s(3.4e-9), 3e-9, 1e-12);
    close(levels.given_m3_s(99e-9), 7e-9, 1e-12);
    assert!(Drive::Levels(vec![2.0, 1.0, 3.0]).given_m3_s(2.5) == 2.0); // as near: the first
    // dD/D = ½ dQ/Q to first order
    let error = levels.flow_error(6.1e-9);
    close(error, 6.0 / 6.1 - 1.0, 1e-12);
    within(diameter_error(error), 0.5 * error, error * error);
    let second = |e: f64| (diameter_error(e) - 0.5 * e).abs();
    close(second(1e-3) / second(5e-4), 4.0, 1e-3);
    assert!(diameter_error(-2.0) == -1.0);
    let stepper = Drive::OnOff(5e-9);
    assert!(stepper.given_m3_s(1e-12) == 5e-9 && stepper.given_m3_s(0.0) == 0.0);
    assert!(stepper.given_m3_s(-1e-9) == 0.0 && Drive::Levels(vec![]).given_m3_s(1.0) == 0.0);
    let out = Feed { lag_s: 0.2, drive: stepper }.deliver(&Told::new(vec![(0.0, 2e-9)]));
    close(out.flow_m3_s(0.2), 5e-9 * (1.0 - (-1.0_f64).exp()), 1e-12);
}

#[test]
fn long_programs_stay_quick_and_exact() {
    // 10⁴ steps: volumes over 10⁴ stations add up to the whole
    let steps: Vec<(f64, f64)> =
        (0..10_000).map(|i| (0.1 * f64::from(i), 1e-9 * f64::from(i % 7))).collect();
    let out = deliver(0.3, &steps);
    let times: Vec<f64> = (0..10_001).map(|i| 0.099 * f64::from(i)).collect();
    close(out.volumes_m3(&times).iter().sum(), out.volume_m3(0.0, 990.0), 1e-9);
}

proptest! {
    #[test]
    fn splitting_a_step_changes_nothing(
        lag in 0.01..5.0_f64, flow in 0.0..1e-8_f64, at in 0.01..4.9_f64, time in 0.0..10.0_f64,
    ) {
        let one = deliver(lag, &[(-1.0, 3e-9), (0.0, flow), (5.0, 1e-9)]);
        let two = deliver(lag, &[(-1.0, 3e-9), (0.0, flow), (at, flow), (5.0, 1e-9)]);
        prop_assert!((one.flow_m3_s(time) - two.flow_m3_s(time)).abs() <= 1e-12 * 1e-8);
        prop_assert!((one.volume_m3(-1.0, time) - two.volume_m3(-1.0, time)).abs() <= 1e-12 * 1e-7);
        // Between told limits always
        prop_assert!((0.0..=1e-8).contains(&one.flow_m3_s(time)));
    }

    #[test]
    fn volume_is_the_flow_summed(lag in 0.05..3.0_f64, from in -2.0..4.0_f64, length in 0.1..4.0_f64) {
        let out = deliver(lag, &STEPS);
        let count = 4000;
        let step = length / f64::from(count);
        let sum: f64 =
            (0..count).map(|i| out.flow_m3_s(from + (f64::from(i) + 0.5) * step) * step).sum();
        prop_assert!((out.volume_m3(from, from + length) - sum).abs() <= 6e-9 * step);
    }

    #[test]
    fn any_program(
        steps in prop::collection::vec(any::<(f64, f64)>(), 0..6), lag in any::<f64>(),
        times in any::<[f64; 3]>(), levels in prop::collection::vec(any::<f64>(), 0..4),
    ) {
        for drive in [Drive::Any, Drive::Levels(levels), Drive::OnOff(lag)] {
            let out = Feed { lag_s: lag, drive }.deliver(&Told::new(steps.clone()));
            let _ = (out.flow_m3_s(times[0]), out.volumes_m3(&times), out.volume_m3(times[0], times[1]));
            let blobs = out.blobs(times[0], times[1], times[2], times[0], times[1]);
            prop_assert!(!(blobs.start_m3 < 0.0 || blobs.end_m3 < 0.0 || blobs.ooze_m3 < 0.0));
            let starved = out.starved(times[0], times[1], times[2]);
            prop_assert!(!(starved.thin_s < 0.0));
        }
        prop_assert!(prime_time_s(times[0], times[1], times[2], lag) >= 0.0);
        prop_assert!(coast_time_s(times[0], times[1], times[2]) >= 0.0);
        prop_assert!(!(sphere_diameter_m(lag) < 0.0));
    }
}
