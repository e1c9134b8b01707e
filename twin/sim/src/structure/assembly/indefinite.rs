//! `L D Lᵀ` of a tangent that need not be positive: past a limit point a pivot is negative.

use super::{Pattern, pivots};

/// A factor and what its pivots say.
#[derive(Debug, Clone)]
pub(crate) struct Signed {
    pub(crate) factor: Vec<f64>,
    /// Directions in which the structure would run away: by Sylvester's law the count is the
    /// matrix's own, whatever the order of elimination.
    pub(crate) negative: usize,
}

impl Pattern {
    /// `L D Lᵀ` with pivots of either sign, not interchanged: sound unless a leading block is
    /// itself singular, so the caller must look at the residual of what it solves. `None` for an
    /// exact zero or a number that is not finite.
    pub(crate) fn factor_signed(&self, values: &[f64]) -> Option<Signed> {
        let Some(symbolic) = &self.symbolic else {
            return Some(Signed { factor: Vec::new(), negative: 0 });
        };
        let (factor, stuck) = self.ldlt(symbolic, values);
        let pivots = pivots(symbolic, &factor);
        let sound = !stuck && pivots.iter().all(|pivot| pivot.is_finite() && *pivot != 0.0);
        let negative = pivots.iter().filter(|pivot| **pivot < 0.0).count();
        sound.then_some(Signed { factor, negative })
    }
}
