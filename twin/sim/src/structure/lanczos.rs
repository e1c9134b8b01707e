//! The largest eigenvalue of `G x = θ K x`, K positive definite, by Lanczos in the inner product of K.
//!
//! `K⁻¹ G` is symmetric there whatever the signs of G. Every vector is made orthogonal to all
//! earlier ones, twice over, so that none comes back by rounding.

use nalgebra::{DMatrix, SymmetricEigen};

use super::divided::Pencil;

/// Solves before giving up.
const MOST_SOLVES: usize = 400;
/// `‖K⁻¹ G x - θ x‖` wanted, relative to θ, in the norm of K; θ itself is then good to the square
/// of it over the relative gap to its neighbours, and never worse than it.
const WANTED: f64 = 1e-6;
/// The same, recomputed from the finished vector: more is a failure.
const ACCEPTED: f64 = 1e-5;
/// Steps between two looks at the small eigenproblem.
const LOOK: usize = 2;
/// Below this part of the largest number around, a number is rounding.
const NOTHING: f64 = 1e-12;

/// An eigenvector with `xᵀ K x = 1`.
#[derive(Debug, Clone)]
pub(crate) struct Pair {
    pub(crate) theta: f64,
    pub(crate) vector: Vec<f64>,
    /// `‖K⁻¹ G x - θ x‖/θ` in the norm of K, recomputed.
    pub(crate) residual: f64,
    /// Solves it took.
    pub(crate) solves: usize,
}

/// Where it stood when it gave up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stuck {
    pub(crate) theta: f64,
    pub(crate) residual: f64,
    pub(crate) solves: usize,
}

/// The largest positive eigenvalue of what the `found` ones leave, with its vector; `None` where no
/// positive one is left. Finding pair after pair so, equal eigenvalues come as often as they occur.
///
/// `start` is any vector with a part in the wanted one. Cost: a solve, three products and, at step
/// m, 4 m dot products; memory a vector per step.
///
/// # Errors
/// [`Stuck`] after [`MOST_SOLVES`] solves.
pub(crate) fn largest(
    pencil: &Pencil,
    found: &[Pair],
    start: &[f64],
) -> Result<Option<Pair>, Stuck> {
    let mut basis = Basis::past(found);
    let (mut diagonal, mut beside) = (Vec::new(), Vec::new());
    let mut next = basis.remainder(pencil, pencil.solve(&pencil.geometric(start)));
    let mut best = Stuck { theta: 0.0, residual: f64::INFINITY, solves: 1 };
    if !next.norm.is_finite() {
        return Err(best);
    }
    if next.norm <= NOTHING * next.before {
        return Ok(None);
    }
    for step in 1..MOST_SOLVES {
        basis.push(next);
        let last = &basis.vectors[basis.vectors.len() - 1];
        let worked = pencil.geometric(last);
        diagonal.push(dot(last, &worked));
        next = basis.remainder(pencil, pencil.solve(&worked));
        let spent = next.norm <= NOTHING * next.before || basis.vectors.len() >= pencil.freedoms();
        best.solves = step + 1;
        if spent || step % LOOK == 0 || step + 1 == MOST_SOLVES {
            // where a number is not finite there is no top
            let Some((theta, weights, widest)) = top(&diagonal, &beside) else { return Err(best) };
            if spent && theta <= NOTHING * widest {
                return Ok(None);
            }
            let off = next.norm * weights[weights.len() - 1].abs() / theta.abs();
            best = Stuck { theta, residual: off, ..best };
            if theta > 0.0 && (spent || off <= WANTED) {
                return basis.finish(pencil, found.len(), &weights, best).map(Some);
            }
        }
        if spent {
            return Err(best);
        }
        beside.push(next.norm);
    }
    Err(best)
}

/// Vectors orthonormal in K; those found before come first.
struct Basis {
    vectors: Vec<Vec<f64>>,
}

/// What is left of a vector, its norm, and the norm it had.
struct Remainder {
    vector: Vec<f64>,
    norm: f64,
    before: f64,
}

impl Basis {
    fn past(found: &[Pair]) -> Self {
        Self { vectors: found.iter().map(|pair| pair.vector.clone()).collect() }
    }

    fn remainder(&self, pencil: &Pencil, mut vector: Vec<f64>) -> Remainder {
        let mut norms = [0.0; 2];
        let mut before = 0.0;
        for norm in &mut norms {
            let image = pencil.elastic(&vector);
            let whole = dot(&vector, &image);
            let parts: Vec<f64> = self.vectors.iter().map(|other| dot(other, &image)).collect();
            for (other, part) in self.vectors.iter().zip(&parts) {
                add(&mut vector, -part, other);
            }
            let rest = whole - dot(&parts, &parts);
            // not `max`, which would lose a NaN
            *norm = if rest < 0.0 { 0.0 } else { rest.sqrt() };
            before = whole.max(before);
        }
        Remainder { vector, norm: norms[1], before: before.sqrt() }
    }

    fn push(&mut self, mut next: Remainder) {
        next.vector.iter_mut().for_each(|value| *value /= next.norm);
        self.vectors.push(next.vector);
    }

    /// The vector of some weights on those after `first`, checked afresh.
    fn finish(
        &self,
        pencil: &Pencil,
        first: usize,
        weights: &[f64],
        at: Stuck,
    ) -> Result<Pair, Stuck> {
        let mut vector = vec![0.0; pencil.freedoms()];
        for (weight, each) in weights.iter().zip(&self.vectors[first..]) {
            add(&mut vector, *weight, each);
        }
        let norm = dot(&vector, &pencil.elastic(&vector)).sqrt();
        vector.iter_mut().for_each(|value| *value /= norm);
        let worked = pencil.geometric(&vector);
        // the quotient of the vector itself: its error is that of the vector squared
        let theta = dot(&vector, &worked);
        let mut gap = pencil.solve(&worked);
        add(&mut gap, -theta, &vector);
        let residual = dot(&gap, &pencil.elastic(&gap)).max(0.0).sqrt() / theta;
        let solves = at.solves + 1;
        if residual <= ACCEPTED {
            Ok(Pair { theta, vector, residual, solves })
        } else {
            Err(Stuck { theta, residual, solves })
        }
    }
}

/// Largest eigenvalue of a symmetric tridiagonal matrix, its vector, and the largest magnitude.
fn top(diagonal: &[f64], beside: &[f64]) -> Option<(f64, Vec<f64>, f64)> {
    let size = diagonal.len();
    if !diagonal.iter().chain(beside).all(|x| x.is_finite()) {
        return None;
    }
    let matrix = DMatrix::from_fn(size, size, |row, column| match row.abs_diff(column) {
        0 => diagonal[row],
        1 => beside[row.min(column)],
        _ => 0.0,
    });
    let eigen = SymmetricEigen::try_new(matrix, f64::EPSILON, 1000 + 100 * size)?;
    let (at, theta) = eigen.eigenvalues.argmax();
    Some((theta, eigen.eigenvectors.column(at).iter().copied().collect(), eigen.eigenvalues.amax()))
}

/// In eight sums side by side: one would wait for itself at every step.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (eights, others) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest = eights.remainder().iter().zip(others.remainder());
    let mut sums = [0.0; 8];
    for (a, b) in eights.zip(others) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().chain(&[rest.map(|(a, b)| a * b).sum()]).sum()
}

fn add(to: &mut [f64], factor: f64, other: &[f64]) {
    for (to, other) in to.iter_mut().zip(other) {
        *to += factor * other;
    }
}
