//! What moments fixed in space add to the symmetric tangent.
//!
//! Each makes the rate of its node lean by `-½ M̃`: six numbers of the whole matrix. The symmetric
//! factor is kept and the lean put in afterwards (Woodbury), three solves per such node.

use nalgebra::{DMatrix, DVector, Dyn, LU};

use crate::pose::Vector;

/// Moments fixed in space and the freedoms they turn.
#[derive(Debug, Default)]
pub(super) struct Lean {
    /// Kept freedom, its node among those here, its axis.
    turns: Vec<(usize, usize, usize)>,
    moments: Vec<Vector>,
}

/// A lean made ready for solving: `x = y - Z (I + C Zᵢ)⁻¹ C yᵢ`, with Z the answer to a unit moment
/// at each leaning freedom i.
#[derive(Debug)]
pub(super) struct Leaning {
    answers: Vec<Vec<f64>>,
    c: DMatrix<f64>,
    inner: LU<f64, Dyn, Dyn>,
}

impl Lean {
    /// From six loads per kept node; freedoms that are not active do not turn.
    pub(super) fn new(loads: &[f64], active: &[bool]) -> Self {
        let mut lean = Self::default();
        for (node, six) in loads.chunks_exact(6).enumerate() {
            let moment = Vector::new(six[3], six[4], six[5]);
            let turns = (0..3).filter(|axis| active[6 * node + 3 + axis]);
            if moment != Vector::zeros() {
                let here = lean.moments.len();
                lean.turns.extend(turns.map(|axis| (6 * node + 3 + axis, here, axis)));
                lean.moments.push(moment);
            }
        }
        lean
    }

    /// `None` where nothing leans, or where the leaning tangent is singular.
    pub(super) fn ready(
        &self,
        factor: f64,
        count: usize,
        solve: impl Fn(&mut [f64]),
    ) -> Option<Leaning> {
        let size = self.turns.len();
        if size == 0 || factor == 0.0 {
            return None;
        }
        let answer = |&(freedom, ..): &(usize, usize, usize)| {
            let mut unit = vec![0.0; count];
            unit[freedom] = 1.0;
            solve(&mut unit);
            unit
        };
        let answers: Vec<Vec<f64>> = self.turns.iter().map(answer).collect();
        let c = DMatrix::from_fn(size, size, |row, column| {
            let ((_, node, a), (_, other, b)) = (self.turns[row], self.turns[column]);
            let spin = self.moments[node].cross_matrix();
            if node == other { -0.5 * factor * spin[(a, b)] } else { 0.0 }
        });
        let z = DMatrix::from_fn(size, size, |row, column| answers[column][self.turns[row].0]);
        let inner = (DMatrix::identity(size, size) + &c * z).lu();
        inner.is_invertible().then_some(Leaning { answers, c, inner })
    }

    /// Turns the symmetric answer into that with the lean.
    pub(super) fn put_in(&self, leaning: &Leaning, answer: &mut [f64]) {
        let own = self.turns.iter().map(|&(freedom, ..)| answer[freedom]);
        let own = DVector::from_iterator(self.turns.len(), own);
        let Some(weights) = leaning.inner.solve(&(&leaning.c * own)) else { return };
        for (by, weight) in leaning.answers.iter().zip(weights.iter()) {
            answer.iter_mut().zip(by).for_each(|(x, z)| *x -= weight * z);
        }
    }
}
