//! The largest eigenvalue of `G x = θ K x`, K positive definite, by Lanczos in the inner product of K.
//!
//! `K⁻¹ G` is symmetric there whatever the signs of G. Every vector is made orthogonal to all
//! earlier ones, twice over, so that none comes back by rounding.

use nalgebra::{DMatrix, Dyn, SymmetricEigen};

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

/// Finds one more pair: the largest positive eigenvalue of what the `found` ones leave, with its
/// vector; false where no positive one is left. Finding pair after pair so, equal eigenvalues come
/// as often as they occur.
///
/// `start` is any vector with a part in the wanted one. Cost: a solve, three products and, at step
/// m, 4 m dot products; memory a vector per step.
///
/// # Errors
/// [`Stuck`] after [`MOST_SOLVES`] solves.
pub(crate) fn largest(
    pencil: &Pencil,
    found: &mut Vec<Pair>,
    start: &[f64],
) -> Result<bool, Stuck> {
    let mut basis = Basis::past(found);
    let (mut diagonal, mut beside) = (Vec::new(), Vec::new());
    let mut next = basis.remainder(pencil, pencil.solve(&pencil.geometric(start)));
    let mut best = Stuck { theta: 0.0, residual: f64::INFINITY, solves: 1 };
    if !next.norm.is_finite() {
        return Err(best);
    }
    if next.norm <= NOTHING * next.before {
        return Ok(false);
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
                return Ok(false);
            }
            let off = next.norm * weights[weights.len() - 1].abs() / theta.abs();
            best = Stuck { theta, residual: off, ..best };
            if theta > 0.0 && (spent || off <= WANTED) {
                let vector = basis.weighted(found.len(), &weights);
                join(pencil, found, checked(pencil, vector, best.solves))?;
                return Ok(true);
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

    /// The vector of some weights on those after `first`.
    fn weighted(&self, first: usize, weights: &[f64]) -> Vec<f64> {
        combined(weights.iter().copied().zip(self.vectors[first..].iter().map(Vec::as_slice)))
    }
}

/// A vector of norm 1 with its quotient and residual, afresh.
fn checked(pencil: &Pencil, mut vector: Vec<f64>, solves: usize) -> Pair {
    let norm = dot(&vector, &pencil.elastic(&vector)).sqrt();
    vector.iter_mut().for_each(|value| *value /= norm);
    let worked = pencil.geometric(&vector);
    // the quotient of the vector itself: its error is that of the vector squared
    let theta = dot(&vector, &worked);
    let mut gap = pencil.solve(&worked);
    add(&mut gap, -theta, &vector);
    let residual = dot(&gap, &pencil.elastic(&gap)).max(0.0).sqrt() / theta;
    Pair { theta, vector, residual, solves: solves + 1 }
}

/// Puts a new pair to those found.
///
/// The new vector is orthogonal to those found as they are, not as they should be. What they lack,
/// `r = K⁻¹ G x₁ - θ₁ x₁`, comes back in its residual as `x₂ᵀ K r`, relative to θ₂ larger by
/// `θ₁/θ₂`: 1e-6 of the first is 1e-3 of a second a thousand times smaller. All of it lies among
/// the vectors found, so turning them together (Rayleigh and Ritz) takes it out but for its square.
fn join(pencil: &Pencil, found: &mut Vec<Pair>, new: Pair) -> Result<(), Stuck> {
    let short = new.residual > WANTED;
    found.push(new);
    if short && found.len() > 1 {
        turn(pencil, found);
    }
    // not the other way about: a residual that is not a number is none to accept
    let sound = |pair: &Pair| pair.residual <= ACCEPTED;
    match found.iter().find(|pair| !sound(pair)) {
        None => Ok(()),
        Some(&Pair { theta, residual, solves, .. }) => Err(Stuck { theta, residual, solves }),
    }
}

/// The best vectors of `G x = θ K x` among all combinations of those found.
fn turn(pencil: &Pencil, found: &mut [Pair]) {
    let images: Vec<Vec<f64>> = found.iter().map(|pair| pencil.geometric(&pair.vector)).collect();
    let within = |a: usize, b: usize| dot(&found[a.max(b)].vector, &images[a.min(b)]);
    let Some(eigen) = spectrum(DMatrix::from_fn(found.len(), found.len(), within)) else { return };
    let mut order: Vec<usize> = (0..found.len()).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let turned: Vec<Vec<f64>> = order
        .into_iter()
        .map(|column| {
            let weights = eigen.eigenvectors.column(column);
            let parts = weights.iter().zip(found.iter());
            combined(parts.map(|(weight, pair)| (*weight, pair.vector.as_slice())))
        })
        .collect();
    for (pair, vector) in found.iter_mut().zip(turned) {
        *pair = checked(pencil, vector, pair.solves);
    }
}

/// The sum of vectors by their weights; there is at least one.
fn combined<'a>(parts: impl Iterator<Item = (f64, &'a [f64])>) -> Vec<f64> {
    let mut sum = Vec::new();
    for (weight, vector) in parts {
        sum.resize(vector.len(), 0.0);
        add(&mut sum, weight, vector);
    }
    sum
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
    let eigen = spectrum(matrix)?;
    let (at, theta) = eigen.eigenvalues.argmax();
    Some((theta, eigen.eigenvectors.column(at).iter().copied().collect(), eigen.eigenvalues.amax()))
}

fn spectrum(matrix: DMatrix<f64>) -> Option<SymmetricEigen<f64, Dyn>> {
    let most = 1000 + 100 * matrix.nrows();
    SymmetricEigen::try_new(matrix, f64::EPSILON, most)
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
