//! Six by six blocks, column by column, and the few products the factor needs.

/// A block: entry (row, column) at `6 column + row`.
pub(super) type Block = [f64; 36];

pub(super) const ZERO: Block = [0.0; 36];
/// What stands for a node that does not take part.
pub(super) const ONE: Block = {
    let mut one = ZERO;
    let mut at = 0;
    while at < 36 {
        one[at] = 1.0;
        at += 7;
    }
    one
};

/// `c += a b`.
#[inline]
pub(super) fn add_product(c: &mut Block, a: &Block, b: &Block) {
    for (to, by) in c.chunks_exact_mut(6).zip(b.chunks_exact(6)) {
        let mut sum: [f64; 6] = [to[0], to[1], to[2], to[3], to[4], to[5]];
        for (from, by) in a.chunks_exact(6).zip(by) {
            for (sum, from) in sum.iter_mut().zip(from) {
                *sum += from * by;
            }
        }
        to.copy_from_slice(&sum);
    }
}

/// `a b`.
pub(super) fn product(a: &Block, b: &Block) -> Block {
    let mut c = ZERO;
    add_product(&mut c, a, b);
    c
}

pub(super) fn transposed(a: &Block) -> Block {
    std::array::from_fn(|at| a[6 * (at % 6) + at / 6])
}

pub(super) fn negated(a: &Block) -> Block {
    a.map(|value| -value)
}

/// Lower Cholesky factor of a symmetric block of which the lower half is read; each pivot has to
/// exceed its own `floor`.
///
/// # Errors
/// The first row whose pivot does not (a pivot that is not a number among them).
pub(super) fn cholesky(a: &Block, floor: &[f64; 6]) -> Result<Block, usize> {
    let mut l = ZERO;
    for column in 0..6 {
        for row in column..6 {
            let mut sum = a[6 * column + row];
            for k in 0..column {
                sum -= l[6 * k + row] * l[6 * k + column];
            }
            if row > column {
                l[6 * column + row] = sum / l[7 * column];
            } else if sum > floor[column] && sum.is_finite() {
                l[7 * column] = sum.sqrt();
            } else {
                return Err(column);
            }
        }
    }
    Ok(l)
}

/// `l⁻¹ b` for a lower triangle.
pub(super) fn forward(l: &Block, b: &Block) -> Block {
    let mut x = *b;
    for column in x.chunks_exact_mut(6) {
        for k in 0..6 {
            column[k] /= l[7 * k];
            for row in k + 1..6 {
                column[row] -= l[6 * k + row] * column[k];
            }
        }
    }
    x
}

/// `l⁻ᵀ b` for a lower triangle.
pub(super) fn backward(l: &Block, b: &Block) -> Block {
    let mut x = *b;
    for column in x.chunks_exact_mut(6) {
        for k in (0..6).rev() {
            for row in k + 1..6 {
                column[k] -= l[6 * k + row] * column[row];
            }
            column[k] /= l[7 * k];
        }
    }
    x
}
