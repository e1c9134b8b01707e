//! A member more or less: a change `K ± V Vᵀ` of rank six, carried up the elimination tree.
//!
//! Davis and Hager (SIAM J. Matrix Anal. 22, 2001) by blocks of six freedoms. With `W` the rows of
//! the change that are still to come and `R Rᵀ` what is left of it, at place j with `Y = W_j R`:
//! ```text
//! D' = D ± Y Yᵀ            G = ± R Yᵀ D'⁻¹
//! W_b' = W_b - L_b W_j      L_b' = L_b + W_b' G      R' = R M^(-T/2), M = I ± Yᵀ D⁻¹ Y
//! ```
//! All six columns go together, as products of blocks. R only shrinks as members come, by a factor
//! that is never a difference, so nothing cancels. Where the pivot grows much, `L_b' = L_b D D'⁻¹ +
//! W_b G` takes the place of the third formula: it does not keep what rounding left in a soft
//! column (Gill, Golub, Murray and Saunders 1974, method C1).
//!
//! A node's first member finds `D = 0`: then `D' = Y Yᵀ`, `L_b' = W_b G`, and R' is nothing, for what
//! hangs on one free node alone stiffens nothing else. Its last member goes the same way backwards.

use nalgebra::SMatrix;

use super::block::{
    Block, ONE, ZERO, add_product, cholesky, forward, negated, product, transposed,
};
use super::factor::{Factor, Part, Rank, Stuck};
use super::symbolic::NONE;

/// Growth of a pivot above which the second formula is used.
const GROWN: f64 = 4.0;

/// No pivot is asked to exceed more than nothing.
const ANY: [f64; 6] = [0.0; 6];

impl Factor {
    /// Adds a part, or takes it away where its factor is negative.
    ///
    /// A node without member so far has to be `New` (see [`Factor::bear`]), the other end settled.
    ///
    /// # Errors
    /// A pivot too small, or gone; the factor is then good for nothing until it is made anew.
    pub(crate) fn change(&mut self, part: &Part) -> Result<(), Stuck> {
        let places = part
            .ends
            .map(|node| self.place(node).filter(|&place| self.rank[place] != Rank::Absent));
        let Some(first) = places.into_iter().flatten().min() else { return Ok(()) };
        let Some(v) = root_of(part) else {
            return Err(Stuck { place: first, freedom: 0 });
        };
        for (end, place) in places.iter().enumerate() {
            let Some(j) = *place else { continue };
            for (at, to) in self.w[j].iter_mut().enumerate() {
                *to = if self.free[j][at % 6] { v[(6 * end + at % 6, at / 6)] } else { 0.0 };
            }
            for freedom in (0..6).filter(|&freedom| self.free[j][freedom]) {
                let at = 6 * end + freedom;
                self.diagonal[j][freedom] += part.factor * part.stiffness[(at, at)];
            }
        }
        let done = self.climb(first, part.factor.signum());
        if done.is_err() {
            self.w.fill(ZERO);
        }
        done
    }

    fn climb(&mut self, first: usize, sign: f64) -> Result<(), Stuck> {
        let (mut j, mut r) = (first, ONE);
        while j != NONE {
            let w = std::mem::replace(&mut self.w[j], ZERO);
            let y = product(&w, &r);
            match self.rank[j] {
                Rank::Absent => {}
                Rank::New => return self.first_member(j, &y, &r),
                Rank::Last => {
                    self.leave(j);
                    return Ok(());
                }
                Rank::Alive => r = self.pass(j, &w, &y, &r, sign)?,
            }
            j = self.symbolic.parent(j);
        }
        Ok(())
    }

    /// One place on the way; what is left of the change.
    fn pass(
        &mut self,
        j: usize,
        w: &Block,
        y: &Block,
        r: &Block,
        sign: f64,
    ) -> Result<Block, Stuck> {
        let stuck = |freedom| Stuck { place: j, freedom };
        let yt = transposed(y);
        let signed = if sign < 0.0 { negated(&yt) } else { yt };
        let before = self.d[j];
        let old_c = self.c[j];
        add_product(&mut self.d[j], y, &signed);
        self.c[j] = cholesky(&self.d[j], &self.floor(j)).map_err(stuck)?;
        // the change seen from the softer of the two pivots: what is left is then no difference
        let t = forward(if sign < 0.0 { &self.c[j] } else { &old_c }, y);
        let mut m = ONE;
        add_product(&mut m, &transposed(&t), &t);
        let root = cholesky(&m, &ANY).map_err(stuck)?;
        let shrinks = if sign < 0.0 { (0..6).map(|k| m[7 * k]).fold(1.0, f64::max) } else { 1.0 };
        self.worn[j] = (self.worn[j] + f64::EPSILON) * shrinks;
        self.most_worn = self.most_worn.max(self.worn[j]);
        let g = transposed(&self.solved_by_pivot(j, &transposed(&product(r, &signed))));
        let grown = sign > 0.0 && (0..6).any(|k| m[7 * k] > GROWN);
        if grown {
            let keep = transposed(&self.solved_by_pivot(j, &before));
            self.rows_anew(j, &negated(w), &g, &keep);
        } else {
            self.rows(j, &negated(w), &g);
        }
        Ok(if sign < 0.0 {
            product(r, &root)
        } else {
            // r root⁻ᵀ
            transposed(&forward(&root, &transposed(r)))
        })
    }

    /// `W_b -= L_b W_j`, `L_b += W_b G`.
    fn rows(&mut self, j: usize, minus_w: &Block, g: &Block) {
        for at in self.symbolic.start[j]..self.symbolic.start[j + 1] {
            let b = self.symbolic.rows[at];
            match self.rank[b] {
                Rank::Absent => {}
                Rank::Last => self.l[at] = ZERO,
                Rank::New | Rank::Alive => {
                    let (l, w) = (&mut self.l[at], &mut self.w[b]);
                    add_product(w, l, minus_w);
                    add_product(l, w, g);
                }
            }
        }
    }

    /// `L_b = L_b keep + W_b G`, `W_b -= L_b W_j` with the former of both on the right.
    fn rows_anew(&mut self, j: usize, minus_w: &Block, g: &Block, keep: &Block) {
        for at in self.symbolic.start[j]..self.symbolic.start[j + 1] {
            let b = self.symbolic.rows[at];
            if self.rank[b] != Rank::Absent {
                let former = self.l[at];
                let mut l = product(&former, keep);
                add_product(&mut l, &self.w[b], g);
                add_product(&mut self.w[b], &former, minus_w);
                self.l[at] = l;
            }
        }
    }

    /// `D = Y Yᵀ`, `L_b = W_b R Y⁻¹`; nothing is left of the change.
    fn first_member(&mut self, j: usize, y: &Block, r: &Block) -> Result<(), Stuck> {
        let stuck = |freedom| Stuck { place: j, freedom };
        let yt = transposed(y);
        self.d[j] = product(y, &yt);
        self.c[j] = cholesky(&self.d[j], &self.floor(j)).map_err(stuck)?;
        self.rank[j] = Rank::Alive;
        self.worn[j] = f64::EPSILON;
        let g = transposed(&self.solved_by_pivot(j, &transposed(&product(r, &yt))));
        for at in self.symbolic.start[j]..self.symbolic.start[j + 1] {
            let b = self.symbolic.rows[at];
            let w = std::mem::replace(&mut self.w[b], ZERO);
            self.l[at] = if self.rank[b] == Rank::Absent { ZERO } else { product(&w, &g) };
        }
        Ok(())
    }

    /// Empties the column of a node whose last member goes. Its blocks in earlier columns have been
    /// emptied on the way here: only that member ever filled them.
    fn leave(&mut self, j: usize) {
        self.rank[j] = Rank::Absent;
        self.free[j] = [false; 6];
        (self.d[j], self.c[j]) = (ONE, ONE);
        self.diagonal[j] = [0.0; 6];
        for at in self.symbolic.start[j]..self.symbolic.start[j + 1] {
            self.l[at] = ZERO;
            self.w[self.symbolic.rows[at]] = ZERO;
        }
    }

    /// Lets a node take part from its first member on, free in all six freedoms.
    pub(crate) fn bear(&mut self, node: usize) {
        if let Some(j) = self.place(node) {
            self.rank[j] = Rank::New;
            self.free[j] = [true; 6];
            self.diagonal[j] = [0.0; 6];
        }
    }

    /// Says that the next part taken away is the last at this node.
    pub(crate) fn bury(&mut self, node: usize) {
        if let Some(j) = self.place(node) {
            self.rank[j] = Rank::Last;
        }
    }

    /// Whether members can be put on this node as it is.
    pub(crate) fn is_settled(&self, node: usize) -> bool {
        self.place(node).is_none_or(|j| self.rank[j] != Rank::New)
    }

    /// Block products of a change at these nodes: all the way up, or to a node that is new.
    pub(crate) fn change_cost(&self, ends: [usize; 2]) -> usize {
        let places = ends.map(|node| self.place(node).unwrap_or(NONE));
        let (mut j, mut blocks) = (places[0].min(places[1]), 0);
        while j != NONE {
            blocks += self.symbolic.below(j).iter().filter(|&&b| self.takes_part(b)).count() + 6;
            let starts = self.rank[j] == Rank::Absent && places.contains(&j);
            j = if starts { NONE } else { self.symbolic.parent(j) };
        }
        2 * blocks
    }

    /// Block products of making the factor anew with these freedoms.
    pub(crate) fn refactor_cost(&self, free: &[[bool; 6]]) -> usize {
        self.symbolic.products(|j| free[self.symbolic.node[j]].contains(&true))
    }
}

/// `|factor| k = V Vᵀ` of rank six: with C the root of the block of the second end, which one
/// end held makes definite, `V = (k_12 C⁻ᵀ, C)`. The rest follows, as the member moves freely as a
/// whole.
fn root_of(part: &Part) -> Option<SMatrix<f64, 12, 6>> {
    let part_of = |row: usize, column: usize| -> Block {
        std::array::from_fn(|at| part.stiffness[(6 * row + at % 6, 6 * column + at / 6)])
    };
    let c = cholesky(&part_of(1, 1), &ANY).ok()?;
    let upper = transposed(&forward(&c, &part_of(1, 0)));
    let size = part.factor.abs().sqrt();
    Some(SMatrix::from_fn(|row, column| {
        size * if row < 6 { upper[6 * column + row] } else { c[6 * column + row - 6] }
    }))
}
