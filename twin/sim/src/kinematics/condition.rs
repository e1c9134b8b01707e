//! Ratio of the extreme singular values of a Jacobian.

use nalgebra::Vector6;

use super::posture::MAX_DOF;

/// σmax/σmin over the min(6, n) singular values of the 6×n matrix with these columns (n ≤
/// [`MAX_DOF`]); ∞ where singular, 1 without columns.
///
/// Law: Householder reflections from both sides make the matrix upper bidiagonal, `B`; the extreme
/// eigenvalues of `BᵀB` are the outermost roots of its characteristic polynomial, which Laguerre's
/// method reaches from outside without passing them. The shifted factors of `BᵀB` come from
/// those of `B` (stationary qd transform: Fernando and Parlett, *Accurate singular values and
/// differential qd algorithms*, 1994), so nothing is lost by squaring: the error is that of the
/// reflections, 1e-15 times the condition number.
pub(super) fn condition(jacobian: &[Vector6<f64>]) -> f64 {
    match jacobian.len() {
        0 => 1.0,
        1..=6 => of_tall::<6>(jacobian),
        _ => of_tall::<MAX_DOF>(jacobian),
    }
}

/// With columns padded by zeros to `ROWS`.
fn of_tall<const ROWS: usize>(jacobian: &[Vector6<f64>]) -> f64 {
    let count = jacobian.len().min(6);
    let mut columns = [[0.0; ROWS]; 6];
    for (index, joint) in jacobian.iter().enumerate() {
        for row in 0..6 {
            // The taller way up: rows of a long Jacobian become columns.
            if count < jacobian.len() {
                columns[row][index] = joint[row];
            } else {
                columns[index][row] = joint[row];
            }
        }
    }
    let (diagonal, beside) = bidiagonal(&mut columns[..count]);
    let square = |values: [f64; 6]| values.map(|value| value * value);
    let (diagonal, beside) = (square(diagonal), square(beside));
    let (diagonal, beside) = (&diagonal[..count], &beside[..count]);
    ratio(greatest(diagonal, beside).sqrt(), least(diagonal, beside).sqrt())
}

/// σmax/σmin, ∞ where the least is rounding, about 1e-16 of the greatest.
pub(super) fn ratio(greatest: f64, least: f64) -> f64 {
    if greatest == 0.0 && least == 0.0 {
        return f64::INFINITY;
    }
    if least > 1e-14 * greatest { greatest / least } else { f64::INFINITY }
}

/// Diagonal of `B` and the entries right of it.
fn bidiagonal<const ROWS: usize>(columns: &mut [[f64; ROWS]]) -> ([f64; 6], [f64; 6]) {
    let (mut diagonal, mut beside) = ([0.0; 6], [0.0; 6]);
    for k in 0..columns.len() {
        let mut mirror = columns[k];
        mirror[..k].fill(0.0);
        let (alpha, beta) = reflection(&mut mirror, k);
        diagonal[k] = alpha;
        for column in &mut columns[k + 1..] {
            let along = beta * dot(&mirror, column);
            subtract(column, along, &mirror);
        }
        let rest = &mut columns[k + 1..];
        let mut mirror = [0.0; ROWS];
        for (entry, column) in mirror.iter_mut().zip(rest.iter()) {
            *entry = column[k];
        }
        if rest.len() < 2 {
            beside[k] = mirror[0];
            continue;
        }
        let (alpha, beta) = reflection(&mut mirror, 0);
        beside[k] = alpha;
        let mut along = [0.0; ROWS];
        for (entry, column) in mirror.iter().zip(rest.iter()) {
            subtract(&mut along, -beta * entry, column);
        }
        for (entry, column) in mirror.iter().zip(rest.iter_mut()) {
            subtract(column, *entry, &along);
        }
    }
    (diagonal, beside)
}

/// Turns `x` into the mirror `v` for which `x − β v vᵀx` has nothing but `alpha` at `at`;
/// returns `(alpha, β)`.
fn reflection<const ROWS: usize>(x: &mut [f64; ROWS], at: usize) -> (f64, f64) {
    let norm = dot(x, x).sqrt();
    if norm == 0.0 {
        return (0.0, 0.0);
    }
    let alpha = if x[at] > 0.0 { -norm } else { norm };
    let beta = 1.0 / (norm * (norm + x[at].abs()));
    x[at] -= alpha;
    (alpha, beta)
}

/// Sum of products, for an even number of them, in two lanes.
fn dot<const ROWS: usize>(a: &[f64; ROWS], b: &[f64; ROWS]) -> f64 {
    let mut sums = [0.0; 2];
    for pair in 0..ROWS / 2 {
        sums[0] += a[2 * pair] * b[2 * pair];
        sums[1] += a[2 * pair + 1] * b[2 * pair + 1];
    }
    sums[0] + sums[1]
}

fn subtract<const ROWS: usize>(from: &mut [f64; ROWS], factor: f64, what: &[f64; ROWS]) {
    for (entry, other) in from.iter_mut().zip(what) {
        *entry -= factor * other;
    }
}

/// A root that will move by less than this share of itself is good.
const CONVERGED: f64 = 1e-13;
/// Three to five are taken.
const STEPS: usize = 40;

/// Where the outermost root of the characteristic polynomial of `BᵀB` lies next to `shift`, outside of
/// all roots: the step of Laguerre's method. From squared entries of `B`; `outside` is the sign that
/// the polynomial's factors have outside the roots, `None` where one of them has not: at the root.
fn step(diagonal: &[f64], beside: &[f64], shift: f64, outside: f64) -> Option<f64> {
    // Remainder before each factor, with its first and second derivative by the shift.
    let (mut rest, mut first, mut second) = (-shift, -1.0, 0.0);
    // Sums of 1/|shift − root| and of their squares.
    let (mut sum, mut squares) = (0.0, 0.0);
    for (q, e) in diagonal.iter().zip(beside) {
        let factor = q + rest;
        if !(factor * outside > 0.0) {
            return None;
        }
        let inverse = 1.0 / factor;
        let share = first * inverse;
        sum += share;
        squares += share * share - second * inverse;
        let carried = e * inverse;
        let scale = carried * q * inverse;
        second = scale * (second - 2.0 * first * share);
        first = scale * first - 1.0;
        rest = rest * carried - shift;
    }
    let count = diagonal.len() as f64;
    let spread = (count - 1.0) * (count * squares - sum * sum);
    Some(count / (sum.abs() + spread.max(0.0).sqrt()))
}

/// Walks from `start` to the outermost root there, against `outside` times the axis.
fn root(diagonal: &[f64], beside: &[f64], start: f64, outside: f64) -> f64 {
    let (mut root, mut before) = (start, f64::INFINITY);
    for _ in 0..STEPS {
        let Some(step) = step(diagonal, beside, root, outside) else { break };
        root += outside * step;
        // Steps shrink at least as fast as before.
        if step * (step / before).min(1.0) < CONVERGED * root && before.is_finite() {
            break;
        }
        before = step;
    }
    root
}

fn least(diagonal: &[f64], beside: &[f64]) -> f64 {
    root(diagonal, beside, 0.0, 1.0)
}

fn greatest(diagonal: &[f64], beside: &[f64]) -> f64 {
    // The Frobenius norm of BᵀB is at least its greatest eigenvalue.
    let (mut above, mut square) = (0.0, 0.0);
    for (q, e) in diagonal.iter().zip(beside) {
        square += (q + above) * (q + above) + 2.0 * q * e;
        above = *e;
    }
    root(diagonal, beside, square.sqrt() * (1.0 + 1e-14), -1.0)
}
