//! Which of several one-sided contacts press, and how hard.

use nalgebra::{DMatrix, DVector};

/// A gap or force this far below zero, as part of the largest, is rounding.
const ROUNDING: f64 = 1e-12;
/// Rounds of turning over all that is wrong without getting better (Júdice and Pires allow ten).
const TRIES: usize = 10;

/// Forces of contacts.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Pressed {
    /// One per contact, never negative.
    pub(super) force_n: Vec<f64>,
    /// Whether all of `force ≥ 0`, `gap ≥ 0`, `force · gap = 0` hold; else no set of contacts was
    /// found within the rounds allowed, and there are no forces.
    pub(super) is_settled: bool,
}

/// Solves `λ ≥ 0`, `W λ + q ≥ 0`, `λᵀ (W λ + q) = 0`.
///
/// `W` (m/N, n × n, symmetric, positive definite): how far the places of contact give way under unit
/// forces along the normals; `q` (m, n): their gaps without contact. The answer is unique: it is the
/// least of `½ λᵀ W λ + qᵀ λ` over `λ ≥ 0`. `pressing` is where to start.
///
/// All that is wrong is turned over as long as that gets better (block pivoting; Júdice and Pires,
/// Computers & Operations Research 21, 1994), which takes few rounds but may go round in circles; then one
/// contact after the other by an active set that only goes down (Lawson and Hanson, Solving Least
/// Squares Problems, 1974, ch. 23), which cannot. Each is bounded all the same.
pub(super) fn complementary(w: &DMatrix<f64>, q: &[f64], pressing: &[bool]) -> Pressed {
    let force_n = turned_over(w, q, pressing).or_else(|| one_by_one(w, q));
    match force_n {
        Some(force_n) => Pressed { force_n, is_settled: true },
        None => Pressed { force_n: vec![0.0; q.len()], is_settled: false },
    }
}

fn turned_over(w: &DMatrix<f64>, q: &[f64], pressing: &[bool]) -> Option<Vec<f64>> {
    let mut pressing = pressing.to_vec();
    let (mut best, mut tries) = (q.len() + 1, TRIES);
    while tries > 0 {
        let force_n = forces(w, q, &pressing)?;
        let gap_m = gaps(w, q, &force_n);
        let (most_n, most_m) = (largest(&force_n), largest(q));
        let is_wrong = |&i: &usize| {
            let (value, size) = if pressing[i] { (force_n[i], most_n) } else { (gap_m[i], most_m) };
            // what is not a number is wrong
            !(value >= -ROUNDING * size)
        };
        let wrong: Vec<usize> = (0..q.len()).filter(is_wrong).collect();
        if wrong.is_empty() {
            return Some(force_n.iter().map(|force| force.max(0.0)).collect());
        }
        if wrong.len() < best {
            (best, tries) = (wrong.len(), TRIES);
        } else {
            tries -= 1;
        }
        wrong.into_iter().for_each(|i| pressing[i] = !pressing[i]);
    }
    None
}

pub(super) fn one_by_one(w: &DMatrix<f64>, q: &[f64]) -> Option<Vec<f64>> {
    let n = q.len();
    let (mut pressing, mut force_n) = (vec![false; n], vec![0.0; n]);
    for _ in 0..4 * n + 4 {
        let gap_m = gaps(w, q, &force_n);
        let open = (0..n).filter(|&i| !pressing[i]);
        let deepest = open.reduce(|a, b| if gap_m[b] < gap_m[a] { b } else { a });
        let Some(next) = deepest.filter(|&i| !(gap_m[i] >= -ROUNDING * largest(q))) else {
            return Some(force_n);
        };
        pressing[next] = true;
        // each round lets go of one at least
        for _ in 0..=n {
            let wanted_n = forces(w, q, &pressing)?;
            let pulls = (0..n).filter(|&i| pressing[i] && wanted_n[i] <= 0.0);
            let way = |i: usize| force_n[i] / (force_n[i] - wanted_n[i]);
            let first = pulls.map(|i| (i, way(i))).reduce(|a, b| if b.1 < a.1 { b } else { a });
            let Some((first, way)) = first else {
                force_n = wanted_n;
                break;
            };
            for (force, wanted) in force_n.iter_mut().zip(&wanted_n) {
                *force += way * (wanted - *force);
            }
            (force_n[first], pressing[first]) = (0.0, false);
        }
    }
    None
}

fn gaps(w: &DMatrix<f64>, q: &[f64], force_n: &[f64]) -> Vec<f64> {
    let by_force = |i: usize| (0..q.len()).map(|j| w[(i, j)] * force_n[j]).sum::<f64>();
    (0..q.len()).map(|i| q[i] + by_force(i)).collect()
}

fn largest(of: &[f64]) -> f64 {
    of.iter().fold(0.0, |most, value| most.max(value.abs()))
}

/// Forces that close the gaps of what presses; `None` where W is not positive definite.
fn forces(w: &DMatrix<f64>, q: &[f64], pressing: &[bool]) -> Option<Vec<f64>> {
    let of: Vec<usize> = (0..q.len()).filter(|&i| pressing[i]).collect();
    let mut force_n = vec![0.0; q.len()];
    if of.is_empty() {
        return Some(force_n);
    }
    let part = DMatrix::from_fn(of.len(), of.len(), |i, j| w[(of[i], of[j])]);
    let right = DVector::from_fn(of.len(), |i, _| -q[of[i]]);
    let found = part.cholesky()?.solve(&right);
    for (&i, force) in of.iter().zip(found.iter()) {
        force_n[i] = *force;
    }
    found.iter().all(|force| force.is_finite()).then_some(force_n)
}
