//! Copies of a joint value a full turn apart.

use std::f64::consts::{PI, TAU};

use super::chain::{Chain, ChainAxis};
use super::posture::MAX_DOF;

/// How far past a limit rounding may put a solution; it is then set on the limit.
const LIMIT_SLACK: f64 = 1e-10;
/// A division is what this file would wait for.
const TURNS_PER_RAD: f64 = 1.0 / TAU;

/// All values of a joint within its limits that leave the arm where a given value puts it; one
/// that rounding has put past a limit is set on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turns {
    /// The least of them, rad or m.
    pub(super) first: f64,
    /// How many follow, each a full turn further.
    pub(super) more: u32,
}

impl Turns {
    /// One value, whatever the limits.
    pub(super) fn only(value: f64) -> Self {
        Self { first: value, more: 0 }
    }

    /// Copies of `value` within the limits of `axis`; `None` where there are none. A joint with an open
    /// end has endless ones: then the one nearest to `near` (else to zero).
    #[inline]
    pub(super) fn within(axis: &ChainAxis, value: f64, near: Option<f64>) -> Option<Self> {
        let (lower, upper) = (axis.lower - LIMIT_SLACK, axis.upper + LIMIT_SLACK);
        let inside = value >= lower && value <= upper;
        // The common cases first.
        let found = if !axis.periodic || (inside && value - TAU < lower && value + TAU > upper) {
            inside.then_some(Self::only(value))
        } else if lower.is_finite() && upper.is_finite() {
            Self::turned(lower, upper, value)
        } else {
            Self::nearest(lower, upper, value, near.unwrap_or(0.0))
        };
        let found = found?;
        Some(Self { first: found.first.max(axis.lower).min(axis.upper), ..found })
    }

    fn turned(lower: f64, upper: f64, value: f64) -> Option<Self> {
        let first = ((lower - value) * TURNS_PER_RAD).ceil();
        let last = ((upper - value) * TURNS_PER_RAD).floor();
        // More than a thousand turns each way is a limit that means nothing.
        let more = (last - first).min(2000.0) as u32;
        (last >= first).then_some(Self { first: value + first * TAU, more })
    }

    /// The one of endless copies that lies next to `near`.
    fn nearest(lower: f64, upper: f64, value: f64, near: f64) -> Option<Self> {
        let mut only = value + ((near - value) / TAU).round() * TAU;
        if lower.is_finite() && only < lower {
            only += ((lower - only) / TAU).ceil() * TAU;
        }
        if upper.is_finite() && only > upper {
            only -= ((only - upper) / TAU).ceil() * TAU;
        }
        only.is_finite().then_some(Self::only(only))
    }
}

/// Turns of every entry of `q`; `None` where some joint cannot be brought within its limits.
pub(super) fn all_turns(
    chain: &Chain,
    q: &[f64],
    near: Option<&[f64]>,
) -> Option<[Turns; MAX_DOF]> {
    let mut turns = [Turns::only(0.0); MAX_DOF];
    for (index, (axis, &value)) in chain.axes().iter().zip(q).enumerate().take(MAX_DOF) {
        let near = near.and_then(|seed| seed.get(index).copied());
        turns[index] = Turns::within(axis, value, near)?;
    }
    Some(turns)
}

/// Whether two values of a joint are nearer than `same`, full turns aside.
pub(super) fn same_turned(axis: &ChainAxis, a: f64, b: f64, same: f64) -> bool {
    let mut apart = (a - b).abs();
    if axis.periodic && apart > PI {
        apart = (apart - TAU * (apart / TAU).round()).abs();
    }
    apart <= same
}
