//! Ranges as probabilities.

use crate::interval::Interval;

/// Standard deviations from the middle to the end of a 90 % interval of a normal distribution.
pub(super) const NINETY: f64 = 1.644_853_626_951_472_2;

/// A range taken as normal: 5 % below `low`, 5 % above `high`; in the logarithm where `low` is positive.
///
/// That the ranges of a material file hold 90 % is ours; they are not statistics. The middle is that of
/// the range, on its scale; the nominal value, often elsewhere in it, plays no role.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Prior {
    range: Interval,
    is_log: bool,
    middle: f64,
    deviation: f64,
}

impl Prior {
    /// The prior of a range; `None` where it has no width or is not finite: then there is nothing to fit.
    pub(super) fn of(range: Interval) -> Option<Self> {
        let is_log = range.low > 0.0;
        let scale = |value: f64| if is_log { value.ln() } else { value };
        let (low, high) = (scale(range.low), scale(range.high));
        let (middle, deviation) = (0.5 * (low + high), 0.5 * (high - low) / NINETY);
        let usable = middle.is_finite() && deviation.is_finite() && deviation > 0.0;
        usable.then_some(Self { range, is_log, middle, deviation })
    }

    /// The value so many standard deviations from the middle; what cannot be negative is held at zero.
    pub(super) fn value(&self, deviations: f64) -> f64 {
        let at = self.middle + deviations * self.deviation;
        match self.is_log {
            true => at.exp(),
            false if self.range.low >= 0.0 => at.max(0.0),
            false => at,
        }
    }
}

/// Nodes to a side of the integral over a density.
const NODES: usize = 24;

/// Shortest interval around zero that holds 90 % of a density `exp(−rise/2)`, by trapezoids.
///
/// `rise` is zero at the mode, zero. Each side is followed to where the density is below 0.5 % and, should it
/// never fall, a hundred deviations far; what is not finite counts as empty.
pub(super) fn ninety_percent(rise: impl Fn(f64) -> f64) -> [f64; 2] {
    let density = |at: f64| {
        let density = (-0.5 * rise(at)).exp();
        if density.is_finite() { density } else { 0.0 }
    };
    let sides = [-1.0, 1.0].map(|side: f64| {
        let mut far = 0.2;
        while density(side * far) > 0.005 && far < 100.0 {
            far *= 2.0;
        }
        let step = far / NODES as f64;
        let nodes: Vec<f64> = (0..=NODES).map(|node| density(side * step * node as f64)).collect();
        (step, nodes)
    });
    let mass = |side: usize, node: usize| {
        let (step, nodes) = &sides[side];
        0.5 * step * (nodes[node] + nodes[node + 1])
    };
    let whole: f64 = (0..NODES).map(|node| mass(0, node) + mass(1, node)).sum();
    // Always the side where the density is higher, cell by cell; the last cell in part.
    let (mut held, mut at) = (0.0, [0_usize; 2]);
    loop {
        let next = |side: usize| sides[side].1.get(at[side] + 1).copied();
        let side = match (next(0), next(1)) {
            (Some(low), Some(high)) => usize::from(high > low),
            (Some(_), None) => 0,
            (None, Some(_)) => 1,
            (None, None) => break,
        };
        let more = mass(side, at[side]);
        if held + more >= 0.9 * whole {
            let part = if more > 0.0 { (0.9 * whole - held) / more } else { 0.0 };
            let mut ends = [0, 1].map(|side| sides[side].0 * at[side] as f64);
            ends[side] += part * sides[side].0;
            return [-ends[0], ends[1]];
        }
        held += more;
        at[side] += 1;
    }
    [-1.0, 1.0].map(|side| side * NINETY)
}
