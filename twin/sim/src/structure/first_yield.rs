//! The factor on a load at which the first member, or the first node, is used up.

use super::beam::beams;
use super::frame::Frame;
use super::solve::{Solution, SolveError};
use super::strength::{Cut, Span, Strength, check_strengths, cuts, spans, worst_by};
use super::weld::{Weld, check_welds, worst_weld};

/// What decides that something is used up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Criterion {
    /// Tension or compression of a member alone: a bound for frames that bend a little.
    Axial,
    /// A member's outermost fibre, with bending and torsion.
    Fibre,
    /// What holds strands together at a node.
    Node,
}

impl Criterion {
    /// All, in the order of the answer.
    pub const ALL: [Self; 3] = [Self::Axial, Self::Fibre, Self::Node];

    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Axial => "axial",
            Self::Fibre => "fibre",
            Self::Node => "node",
        }
    }
}

/// Where and when the first thing is used up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstYield {
    /// By what.
    pub criterion: Criterion,
    /// On the growing load; 0 where the lasting load alone is too much, infinite where it never is.
    pub factor: f64,
    /// The member, or for [`Criterion::Node`] the weld; `None` where nothing is ever used up.
    pub at: Option<usize>,
}

/// The factors on the second load at which the first member (axial; outermost fibre) and the first weld
/// are used up, the first load staying as it is; in the order of [`Criterion::ALL`].
///
/// What is used is convex in the factor (norms and positive parts of straight lines), so each crossing is the only one;
/// it is bisected to a relative 1e-13. O((members + welds) · 150).
///
/// # Errors
/// [`SolveError::BadMember`], [`SolveError::BadNode`] where a strength, weld or force is missing or unusable.
pub fn first_yield(
    frame: &Frame,
    (strengths, welds): (&[Strength], &[Weld]),
    lasting: (&Solution, [f64; 3]),
    growing: (&Solution, [f64; 3]),
) -> Result<[FirstYield; 3], SolveError> {
    check_strengths(frame.members().len(), strengths)?;
    check_welds(welds, frame.members().len(), frame.nodes().len())?;
    let base = cuts(frame, lasting.0, lasting.1)?;
    let step = cuts(frame, growing.0, growing.1)?;
    let beams = beams(frame);
    let spans = spans(frame, &beams);
    Ok(Criterion::ALL.map(|criterion| {
        let used = |factor: f64| {
            let both: Vec<Cut> = base.iter().zip(&step).map(|(a, b)| a.plus(b, factor)).collect();
            most_used(criterion, &spans, &both, (strengths, welds))
        };
        let factor = crossing(|factor| used(factor).map_or(0.0, |(value, _)| value));
        let at = if factor.is_finite() { used(factor).map(|(_, at)| at) } else { None };
        FirstYield { criterion, factor, at }
    }))
}

fn most_used(
    criterion: Criterion,
    spans: &[Span],
    cuts: &[Cut],
    (strengths, welds): (&[Strength], &[Weld]),
) -> Option<(f64, usize)> {
    let member = match criterion {
        Criterion::Axial => worst_by(spans, cuts, strengths, |_, span, cut, strength| {
            span.axial_utilisation(cut, strength)
        }),
        Criterion::Fibre => worst_by(spans, cuts, strengths, |_, span, cut, strength| {
            span.utilisation(cut, strength)
        }),
        Criterion::Node => {
            return worst_weld(welds, spans, cuts).map(|worst| (worst.value, worst.weld));
        }
    };
    member.map(|worst| (worst.value, worst.member))
}

/// Where a convex function that begins below 1 reaches it.
fn crossing(used: impl Fn(f64) -> f64) -> f64 {
    if used(0.0) >= 1.0 {
        return 0.0;
    }
    let Some((mut low, mut high)) = (0..400)
        .map(|k| 2f64.powi(k - 100))
        .find(|&factor| used(factor) >= 1.0)
        .map(|factor| (factor / 2.0, factor))
    else {
        return f64::INFINITY;
    };
    if used(low) >= 1.0 {
        return low;
    }
    while high - low > 1e-13 * high {
        let middle = 0.5 * (low + high);
        if used(middle) >= 1.0 { high = middle } else { low = middle }
    }
    low
}
