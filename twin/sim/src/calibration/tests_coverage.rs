//! Row 6 of the issue: how often the reported 90 % intervals hold the truth.
//!
//! Measurements are the model's own with 3 % noise, and the fit is told so: this tests the statistics, not
//! the laws. A truth drawn from the priors must be held in 90 of 100 whatever the prints say; one that stands
//! fixed off the middle only where the prints outweigh the prior, hence the three free hangs. Over 2000 seeds
//! instead of 100: 89 to 92 % of fixed truths, 88 to 91 % of drawn ones (the ridge is not the whole posterior).

use std::collections::BTreeMap;

use super::prior::Prior;
use super::tests::{blown, gel_strand, hang, measured, pla, resin, set};
use super::*;
use crate::interval::Interval;

const SEEDS: u64 = 100;

/// A small generator (splitmix64), so that a seed is the same numbers everywhere.
struct Dice(u64);

impl Dice {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (((bits ^ (bits >> 31)) >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }

    /// A normal number by Box and Muller.
    fn normal(&mut self) -> f64 {
        let (radius, turn) = ((-2.0 * self.uniform().ln()).sqrt(), self.uniform());
        radius * (std::f64::consts::TAU * turn).cos()
    }
}

fn plastic_prints() -> Vec<Print> {
    vec![
        hang(),
        hang(),
        hang(),
        Print::Bridge(blown(0.06, 0.004)),
        Print::Bridge(blown(0.03, 0.012)),
        Print::Cantilever(blown(0.1, 0.005)),
    ]
}

fn resin_prints() -> Vec<Print> {
    let doses = [400.0, 800.0, 1600.0, 3200.0];
    let mut prints: Vec<Print> = doses.map(|dose_j_m2| Print::CuredDepth { dose_j_m2 }).to_vec();
    prints.extend([Print::FreeHang { nozzle_diameter_m: 0.003 }; 3]);
    prints.push(Print::Cantilever(gel_strand(0.1, 0.003)));
    prints.push(Print::Bridge(gel_strand(0.06, 0.003)));
    prints
}

/// In how many of the seeds each parameter that was informed lies in its interval, and of how many.
fn covered(
    known: &Known,
    prints: &[Print],
    truth_of: impl Fn(&mut Dice) -> Known,
) -> BTreeMap<Parameter, (u64, u64)> {
    let mut covered = BTreeMap::new();
    for seed in 0..SEEDS {
        let mut dice = Dice(seed);
        let truth = truth_of(&mut dice);
        let measured: Vec<Measured> =
            prints.iter().map(|print| measured(*print, &truth, dice.normal())).collect();
        let fit = fit(known, &measured, None);
        for it in fit.parameters.iter().filter(|it| it.informed) {
            let true_value = truth.get(it.parameter).expect("has one").nominal;
            let inside = it.after.low <= true_value && true_value <= it.after.high;
            let (held, of) = covered.entry(it.parameter).or_insert((0, 0));
            (*held, *of) = (*held + u64::from(inside), *of + 1);
        }
    }
    println!("held, of: {covered:?}");
    covered
}

/// Every one of these parameters is informed by every seed, and held in 82 to 97 of 100.
fn assert_held(covered: &BTreeMap<Parameter, (u64, u64)>, parameters: &[Parameter]) {
    assert_eq!(covered.keys().copied().collect::<Vec<_>>(), parameters);
    for (parameter, (held, of)) in covered {
        assert!((82..=97).contains(held) && *of == SEEDS, "{parameter:?} {held} of {of}");
    }
}

/// Each parameter from its own prior, independently.
fn drawn(known: &Known, dice: &mut Dice) -> Known {
    Parameter::ALL.into_iter().fold(known.clone(), |truth, parameter| {
        match known.get(parameter).and_then(Prior::of) {
            Some(prior) => truth.with(parameter, Interval::exact(prior.value(dice.normal()))),
            None => truth,
        }
    })
}

const PLASTIC: [Parameter; 4] =
    [Parameter::Viscosity, Parameter::Slack, Parameter::Shrinkage, Parameter::Swell];
/// A gel that shrinks by a percent is taut on every bridge: it tells nothing of slack.
const RESIN: [Parameter; 4] =
    [Parameter::Shrinkage, Parameter::Penetration, Parameter::CriticalExposure, Parameter::Swell];

#[test]
fn ninety_percent_intervals_hold_a_fixed_thermoplastic() {
    let truth = set(
        &pla(),
        &[
            (Parameter::Viscosity, 1.5),
            (Parameter::Slack, 0.004),
            (Parameter::Shrinkage, 5.2e-5),
            (Parameter::Swell, 1.1),
        ],
    );
    assert_held(&covered(&pla(), &plastic_prints(), |_| truth.clone()), &PLASTIC);
}

#[test]
fn ninety_percent_intervals_hold_a_fixed_photopolymer() {
    let truth = set(
        &resin(),
        &[
            (Parameter::Slack, 0.0),
            (Parameter::Shrinkage, 0.012),
            (Parameter::Penetration, 2.2e-4),
            (Parameter::CriticalExposure, 120.0),
            (Parameter::Swell, 1.1),
        ],
    );
    assert_held(&covered(&resin(), &resin_prints(), |_| truth.clone()), &RESIN);
}

#[test]
fn ninety_percent_intervals_hold_a_thermoplastic_drawn_from_the_prior() {
    // In four of five draws the bridges are taut, and slack has an end on one side only.
    assert_held(&covered(&pla(), &plastic_prints(), |dice| drawn(&pla(), dice)), &PLASTIC);
}

#[test]
fn ninety_percent_intervals_hold_a_photopolymer_drawn_from_the_prior() {
    let mut covered = covered(&resin(), &resin_prints(), |dice| drawn(&resin(), dice));
    covered.remove(&Parameter::Slack);
    assert_held(&covered, &RESIN);
}
