//! The numbers of the factor, and how they are made from nothing.

use super::block::{
    Block, ONE, ZERO, add_product, backward, cholesky, forward, negated, transposed,
};
use super::symbolic::{NONE, Symbolic};
use crate::structure::beam::Matrix12;

/// Where elimination met a pivot too small: place and freedom.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Stuck {
    pub(crate) place: usize,
    pub(crate) freedom: usize,
}

/// A member's share of the matrix: `factor` times its stiffness between two nodes of the frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Part<'a> {
    pub(crate) ends: [usize; 2],
    pub(crate) stiffness: &'a Matrix12,
    pub(crate) factor: f64,
}

/// What a node is to the factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rank {
    /// Takes no part: its column is empty.
    Absent,
    /// Takes part, and has no member yet.
    New,
    /// Takes part.
    Alive,
    /// Takes part until the member that goes now is gone.
    Last,
}

/// `K = L D Lᵀ` with L and D in blocks of six: D is kept as Cholesky factors `D = C Cᵀ`.
///
/// Freedoms that are held keep `1 · u = 0`.
#[derive(Debug, Clone)]
pub(crate) struct Factor {
    pub(super) symbolic: Symbolic,
    /// Blocks of L below the diagonal, column by column.
    pub(super) l: Vec<Block>,
    /// C by place.
    pub(super) c: Vec<Block>,
    /// D by place: kept beside C, so that a change is added to it and not to a square.
    pub(super) d: Vec<Block>,
    /// Diagonal of K, by place and freedom.
    pub(super) diagonal: Vec<[f64; 6]>,
    pub(super) rank: Vec<Rank>,
    pub(super) free: Vec<[bool; 6]>,
    /// Least pivot, as part of the diagonal of K.
    pub(super) least: f64,
    /// Bound on the relative error of each pivot, as far as updates made it.
    pub(super) worn: Vec<f64>,
    /// Its largest since the factor was made.
    pub(super) most_worn: f64,
    /// Workspace of updates by place; nothing but zeros between them.
    pub(super) w: Vec<Block>,
}

impl Factor {
    /// Nothing there yet. A pivot not above `least_pivot` of its diagonal is none.
    pub(crate) fn new(symbolic: Symbolic, least_pivot: f64) -> Self {
        let (n, blocks) = (symbolic.len(), symbolic.blocks());
        Self {
            symbolic,
            l: vec![ZERO; blocks],
            c: vec![ONE; n],
            d: vec![ONE; n],
            diagonal: vec![[0.0; 6]; n],
            rank: vec![Rank::Absent; n],
            free: vec![[false; 6]; n],
            least: least_pivot,
            worn: vec![0.0; n],
            most_worn: 0.0,
            w: vec![ZERO; n],
        }
    }

    /// Bound on the relative error that updates have brought into a pivot: each adds a rounding, and
    /// one that takes away multiplies what was there by how much the pivot shrinks.
    pub(crate) fn wear(&self) -> f64 {
        self.most_worn
    }

    pub(crate) fn symbolic(&self) -> &Symbolic {
        &self.symbolic
    }

    /// Place of a node that may move.
    pub(super) fn place(&self, node: usize) -> Option<usize> {
        Some(self.symbolic.place[node]).filter(|&place| place != NONE)
    }

    /// What a pivot of a node has to exceed; a held freedom has 1.
    pub(super) fn floor(&self, j: usize) -> [f64; 6] {
        let of =
            |freedom: usize| if self.free[j][freedom] { self.diagonal[j][freedom] } else { 0.0 };
        std::array::from_fn(|freedom| self.least * of(freedom))
    }

    /// Factorises the sum of `parts` with `free` freedoms by node of the frame, from nothing.
    ///
    /// Right-looking by blocks; O(squares of column heights).
    ///
    /// # Errors
    /// The first pivot too small in the order of elimination. The factor is then good for nothing
    /// until the next call.
    pub(crate) fn refactor<'a>(
        &mut self,
        parts: impl Iterator<Item = Part<'a>>,
        free: &[[bool; 6]],
    ) -> Result<(), Stuck> {
        self.d.fill(ZERO);
        self.worn.fill(0.0);
        self.most_worn = 0.0;
        self.diagonal.fill([0.0; 6]);
        for j in 0..self.symbolic.len() {
            if self.takes_part(j) {
                self.l[self.symbolic.start[j]..self.symbolic.start[j + 1]].fill(ZERO);
            }
            self.free[j] = free[self.symbolic.node[j]];
            let moves = self.free[j].contains(&true);
            self.rank[j] = if moves { Rank::Alive } else { Rank::Absent };
        }
        parts.for_each(|part| self.assemble(&part));
        for j in 0..self.symbolic.len() {
            for freedom in (0..6).filter(|&freedom| !self.free[j][freedom]) {
                self.d[j][7 * freedom] = 1.0;
            }
            self.eliminate(j)?;
        }
        Ok(())
    }

    fn assemble(&mut self, part: &Part) {
        let places = part.ends.map(|node| self.place(node));
        for (row_end, column_end) in [(0, 0), (1, 1), (0, 1)] {
            let (Some(b), Some(a)) = (places[row_end], places[column_end]) else { continue };
            let (high, low) = (b.max(a), b.min(a));
            let (row_end, column_end) =
                if b >= a { (row_end, column_end) } else { (column_end, row_end) };
            let (rows, columns) = (self.free[high], self.free[low]);
            let entry = |at: usize| {
                let (row, column) = (at % 6, at / 6);
                let taken = rows[row] && columns[column];
                let value = part.stiffness[(6 * row_end + row, 6 * column_end + column)];
                if taken { part.factor * value } else { 0.0 }
            };
            let to = if high == low {
                Some(&mut self.d[low])
            } else {
                self.symbolic.at(high, low).map(|at| &mut self.l[at])
            };
            if let Some(to) = to {
                to.iter_mut().enumerate().for_each(|(at, to)| *to += entry(at));
            }
            if high == low {
                (0..6).for_each(|freedom| self.diagonal[low][freedom] += entry(7 * freedom));
            }
        }
    }

    /// Column j, complete but for its own pivot, and what it takes from the columns above.
    fn eliminate(&mut self, j: usize) -> Result<(), Stuck> {
        if !self.takes_part(j) {
            return Ok(());
        }
        let stuck = |freedom| Stuck { place: j, freedom };
        self.c[j] = cholesky(&self.d[j], &self.floor(j)).map_err(stuck)?;
        let span = self.symbolic.start[j]..self.symbolic.start[j + 1];
        for at in span.clone() {
            let a = self.symbolic.rows[at];
            if !self.takes_part(a) {
                continue;
            }
            // the blocks still below are of L D, those before are of L by now
            let minus_at = negated(&transposed(&self.l[at]));
            let minus_lt = self.solved_by_pivot(j, &minus_at);
            self.l[at] = negated(&transposed(&minus_lt));
            add_product(&mut self.d[a], &self.l[at], &minus_at);
            let (here, above) = self.l.split_at_mut(span.end);
            let mut target = self.symbolic.start[a];
            let below = &self.symbolic.rows[at + 1..span.end];
            for (&b, from) in below.iter().zip(&here[at + 1..]) {
                if self.rank[b] == Rank::Absent {
                    continue;
                }
                while self.symbolic.rows[target] < b {
                    target += 1;
                }
                add_product(&mut above[target - span.end], from, &minus_lt);
            }
        }
        Ok(())
    }

    /// Whether a place has equations of its own now.
    pub(super) fn takes_part(&self, j: usize) -> bool {
        self.rank[j] != Rank::Absent
    }

    /// `D⁻¹ b` of one node.
    pub(super) fn solved_by_pivot(&self, j: usize, b: &Block) -> Block {
        backward(&self.c[j], &forward(&self.c[j], b))
    }
}
