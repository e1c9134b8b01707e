//! A frame on a bed that moves: twelve unit cases per stage, combined at any posture of the arm.
//!
//! In axes of the part, whose origin accelerates by a₀ while the axes turn with ω and α, a mass at
//! x feels `g - a₀ - α × x - ω × (ω × x)` times itself: three numbers for `g - a₀`, three for α, six
//! products ωᵢ ωⱼ. A member carries it as a line load that is linear along it. So twelve solves of
//! a stage answer every posture that the arm takes while the stage stands.
//!
//! The frame follows at once: its own vibration is not modelled, nor that it drags on the arm.
//! Mass sits on the axes of the members: what the width of a section adds to its turning inertia,
//! `ρ I α` per length beside `ρ A L² α`, is left out, and so is all that a member does that turns about
//! its own axis.

mod field;
mod unit;

pub use field::Ridden;
use field::UNITS;
#[cfg(test)]
pub(crate) use field::line_ends;
pub use unit::ride_stages;

use super::frame::Frame;
use super::solve::SolveError;
use super::stages::Stage;
use super::strength::{Cut, Span, Strength, Utilisation, check_strengths, worst};
use crate::pose::Vector;

/// Numbers per unit case.
pub(crate) type Twelve = [f64; UNITS];

/// The answers of one stage to the twelve unit cases.
///
/// Made once per stage: twelve solves with its factor, O(12 × numbers in the factor), and 0.6 kB
/// per node and per born member. Any posture is then a sum of twelve.
#[derive(Debug, Clone)]
pub struct Riding<'a> {
    frame: &'a Frame,
    spans: Vec<Span<'a>>,
    line_kg_per_m: Vec<f64>,
    /// By node: x, y, z, turns.
    displacement: Vec<[Twelve; 6]>,
    /// By born member: force and moment on its first end.
    first_ends: Vec<[Twelve; 6]>,
    /// In the order of the supports.
    reactions: Vec<[Twelve; 6]>,
    /// Largest translation of a node by each of the three groups of numbers, per norm of the group.
    reach: [f64; 3],
    residual: f64,
}

/// Where a moving frame is farthest from where it would be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Farthest {
    /// Translation, m.
    pub translation_m: f64,
    /// Its node.
    pub node: usize,
}

impl<'a> Riding<'a> {
    /// The unit cases of a stage; its gravity and node loads play no part. Nodes that are unborn or
    /// float stay where they are.
    ///
    /// # Errors
    /// Unusable input, and a mechanism.
    pub fn of_stage(frame: &'a Frame, stage: &Stage) -> Result<Self, SolveError> {
        let mut only = Err(SolveError::TooLarge);
        ride_stages(frame, std::slice::from_ref(stage), |_, riding| only = riding)?;
        only
    }

    /// Displacement of a node: x, y, z, turns; m and rad. O(1).
    pub fn displacement(&self, node: usize, at: &Ridden) -> [f64; 6] {
        let numbers = at.numbers();
        self.displacement[node].map(|row| dot(&row, &numbers))
    }

    /// Displacements of all nodes. O(12 nodes).
    pub fn displacements(&self, at: &Ridden) -> Vec<[f64; 6]> {
        let numbers = at.numbers();
        self.displacement.iter().map(|six| six.map(|row| dot(&row, &numbers))).collect()
    }

    /// The first of the nodes that move farthest. O(12 nodes).
    pub fn farthest(&self, at: &Ridden) -> Farthest {
        let numbers = at.numbers();
        let mut worst = Farthest { translation_m: 0.0, node: 0 };
        for (node, six) in self.displacement.iter().enumerate() {
            let translation_m = Vector::from_fn(|k, _| dot(&six[k], &numbers)).norm();
            if translation_m > worst.translation_m {
                worst = Farthest { translation_m, node };
            }
        }
        worst
    }

    /// What no node moves beyond, m, in O(1): a posture where this is less than what is known
    /// already need not be looked at.
    ///
    /// `Σ max ‖U_n‖ |c|` over the three groups of numbers c, with U the unit answers of a node and the
    /// norm that of Frobenius (Cauchy and Schwarz).
    pub fn bound_m(&self, at: &Ridden) -> f64 {
        let numbers = at.numbers();
        GROUPS
            .iter()
            .zip(self.reach)
            .map(|(group, reach)| reach * norm(&numbers[group.clone()]))
            .sum()
    }

    /// What each support does to the frame, N and N m, in their order.
    pub fn reactions(&self, at: &Ridden) -> Vec<[f64; 6]> {
        let numbers = at.numbers();
        self.reactions.iter().map(|six| six.map(|row| dot(&row, &numbers))).collect()
    }

    /// Force and moment on the first end of a born member, axes of the part.
    pub fn first_end(&self, member: usize, at: &Ridden) -> [f64; 6] {
        let numbers = at.numbers();
        self.first_ends[member].map(|row| dot(&row, &numbers))
    }

    /// The most used of the born members; `strengths` for all members of the frame. O(members).
    ///
    /// # Errors
    /// [`SolveError::BadMember`] where a strength is missing or not positive.
    pub fn utilisation(
        &self,
        at: &Ridden,
        strengths: &[Strength],
    ) -> Result<Option<Utilisation>, SolveError> {
        check_strengths(self.frame.members().len(), strengths)?;
        let born = self.first_ends.len();
        let cuts: Vec<Cut> = (0..born).map(|member| self.cut(member, at)).collect();
        Ok(worst(&self.spans[..born], &cuts, &strengths[..born]))
    }

    /// Forces all along a born member.
    pub(crate) fn cut(&self, member: usize, at: &Ridden) -> Cut {
        let lines = self.lines(member, at);
        Cut::linear(&self.first_end(member, at), lines, self.spans[member].length_m)
    }

    /// Line loads at both ends of a member, N/m; none on one that floats.
    fn lines(&self, member: usize, at: &Ridden) -> [Vector; 2] {
        let line_kg_per_m = self.line_kg_per_m[member];
        self.spans[member]
            .member
            .ends
            .map(|node| at.at_m_s2(&self.frame.nodes()[node].coords) * line_kg_per_m)
    }

    /// The worst `‖K u - f‖/‖f‖` of the unit cases.
    pub fn residual(&self) -> f64 {
        self.residual
    }
}

/// The numbers of a specific force, of α, of the products of ω.
const GROUPS: [std::ops::Range<usize>; 3] = [0..3, 3..6, 6..12];

fn dot(a: &Twelve, b: &Twelve) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    a.iter().map(|a| a * a).sum::<f64>().sqrt()
}

/// [`Riding::bound_m`]'s norms.
fn reach(displacement: &[[Twelve; 6]]) -> [f64; 3] {
    GROUPS.map(|group| {
        let of_node = |six: &[Twelve; 6]| norm(&[0, 1, 2].map(|k| norm(&six[k][group.clone()])));
        displacement.iter().map(of_node).fold(0.0, f64::max)
    })
}
