//! The sparse stiffness matrix: its pattern and order of elimination once, its numbers per stage.
//!
//! A freedom that does not take part at some stage (node unborn, floating or held) keeps its row as
//! `1 · u = 0`, uncoupled. So one symbolic factorisation serves every stage of the same pattern, and
//! the rows that do take part are never altered: nothing is regularised.

pub(crate) mod indefinite;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};

use super::beam::Matrix12;
use super::frame::Member;

/// A pivot below this part of its own diagonal entry is a mechanism. Rounding leaves 1e-15 there;
/// the tip of a chain of a hundred slender members leaves 1e-8.
pub(crate) const PIVOT_RATIO: f64 = 1e-10;

const ABSENT: usize = usize::MAX;

/// Where the factorisation met a motion without stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Mechanism {
    pub(crate) node: usize,
    pub(crate) freedom: usize,
}

/// Lower triangle by columns, six freedoms per kept node, and the order of elimination.
#[derive(Debug)]
pub(crate) struct Pattern {
    /// Kept nodes, ascending; freedom `6 a + i` here is `6 kept[a] + i` of the frame.
    pub(crate) kept: Vec<usize>,
    place: Vec<usize>,
    /// Higher neighbours of each kept node, ascending.
    above: Vec<Vec<usize>>,
    column_start: Vec<usize>,
    rows: Vec<usize>,
    symbolic: Option<SymbolicCholesky<usize>>,
}

impl Pattern {
    /// The pattern of `members` on the nodes of which `keep` is true. One AMD ordering and one
    /// symbolic factorisation, O(members) and near it. `None` where memory or indices run out.
    pub(crate) fn new(keep: &[bool], members: &[Member]) -> Option<Self> {
        let kept: Vec<usize> = (0..keep.len()).filter(|&node| keep[node]).collect();
        let mut place = vec![ABSENT; keep.len()];
        for (a, &node) in kept.iter().enumerate() {
            place[node] = a;
        }
        let mut above = vec![Vec::new(); kept.len()];
        for member in members {
            let [a, b] = member.ends.map(|node| place[node]);
            if a != ABSENT && b != ABSENT {
                above[a.min(b)].push(a.max(b));
            }
        }
        let (mut column_start, mut rows) = (vec![0], Vec::new());
        for (a, neighbours) in above.iter_mut().enumerate() {
            neighbours.sort_unstable();
            neighbours.dedup();
            for column in 0..6 {
                rows.extend((column..6).map(|row| 6 * a + row));
                rows.extend(neighbours.iter().flat_map(|b| (0..6).map(move |row| 6 * b + row)));
                column_start.push(rows.len());
            }
        }
        let mut pattern = Self { kept, place, above, column_start, rows, symbolic: None };
        if pattern.freedoms() > 0 {
            let symbolic = factorize_symbolic_cholesky(
                pattern.shape(),
                Side::Lower,
                SymmetricOrdering::Amd,
                // blocks of six rows: supernodes pay from the smallest frame on
                CholeskySymbolicParams {
                    supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
                    ..CholeskySymbolicParams::default()
                },
            );
            pattern.symbolic = Some(symbolic.ok()?);
        }
        Some(pattern)
    }

    /// Rows of the system.
    pub(crate) fn freedoms(&self) -> usize {
        6 * self.kept.len()
    }

    fn shape(&self) -> SymbolicSparseColMatRef<'_, usize> {
        let n = self.freedoms();
        SymbolicSparseColMatRef::new_checked(n, n, &self.column_start, None, &self.rows)
    }

    /// Six freedoms per node of the frame, cut down to the kept ones.
    pub(crate) fn gather(&self, of_frame: &[f64]) -> Vec<f64> {
        self.kept.iter().flat_map(|&node| of_frame[6 * node..6 * node + 6].to_vec()).collect()
    }

    /// Adds kept freedoms to those of the frame.
    pub(crate) fn scatter_add(&self, of_pattern: &[f64], of_frame: &mut [f64]) {
        for (values, &node) in of_pattern.chunks_exact(6).zip(&self.kept) {
            for (freedom, value) in values.iter().enumerate() {
                of_frame[6 * node + freedom] += value;
            }
        }
    }

    /// The stiffness of some members, each with a factor; rows that are not `active` are `1 · u`.
    pub(crate) fn assemble<'a>(
        &self,
        parts: impl Iterator<Item = (&'a Member, &'a Matrix12, f64)>,
        active: &[bool],
    ) -> Vec<f64> {
        let mut values = vec![0.0; self.rows.len()];
        for (member, stiffness, factor) in parts {
            for column_end in 0..2 {
                for row_end in 0..2 {
                    let [a, b] = [column_end, row_end].map(|end| self.place[member.ends[end]]);
                    if a != ABSENT && b != ABSENT && a <= b {
                        let corner = (6 * row_end, 6 * column_end);
                        self.add_block(&mut values, (b, a), stiffness, corner, factor, active);
                    }
                }
            }
        }
        for freedom in (0..self.freedoms()).filter(|&freedom| !active[freedom]) {
            values[self.column_start[freedom]] = 1.0;
        }
        values
    }

    fn add_block(
        &self,
        values: &mut [f64],
        (b, a): (usize, usize),
        stiffness: &Matrix12,
        corner: (usize, usize),
        factor: f64,
        active: &[bool],
    ) {
        let rank = self.above[a].partition_point(|&other| other < b);
        for column in (0..6).filter(|column| active[6 * a + column]) {
            let start = self.column_start[6 * a + column];
            // a column holds its own node from the diagonal down, then six rows per neighbour
            let (first, offset) =
                if a == b { (column, start) } else { (0, start + 6 - column + 6 * rank) };
            for row in (first..6).filter(|row| active[6 * b + row]) {
                values[offset + row - first] +=
                    factor * stiffness[(corner.0 + row, corner.1 + column)];
            }
        }
    }

    /// faer's `L D Lᵀ` of the assembled values, and whether it met an exact zero.
    fn ldlt(&self, symbolic: &SymbolicCholesky<usize>, values: &[f64]) -> (Vec<f64>, bool) {
        let mut factor = vec![0.0; symbolic.len_val()];
        let request = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default());
        let stuck = symbolic
            .factorize_numeric_ldlt(
                &mut factor,
                SparseColMatRef::new(self.shape(), values),
                Side::Lower,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut MemBuffer::new(request)),
                Default::default(),
            )
            .is_err();
        (factor, stuck)
    }

    /// `L D Lᵀ` of the assembled values.
    ///
    /// # Errors
    /// The first pivot, in the order of elimination, that is not above [`PIVOT_RATIO`] of its
    /// diagonal entry.
    pub(crate) fn factor(&self, values: &[f64], active: &[bool]) -> Result<Vec<f64>, Mechanism> {
        let Some(symbolic) = &self.symbolic else { return Ok(Vec::new()) };
        let (factor, stuck) = self.ldlt(symbolic, values);
        // faer names the step of an exact zero now with, now without an offset: look at D instead
        let step_of = |step: usize| symbolic.perm().map_or(step, |perm| perm.arrays().0[step]);
        for (step, pivot) in pivots(symbolic, &factor).into_iter().enumerate() {
            let freedom = step_of(step);
            let diagonal = values[self.column_start[freedom]];
            let sound = pivot > PIVOT_RATIO * diagonal && pivot.is_finite();
            if active[freedom] && !sound {
                return Err(self.mechanism(freedom));
            }
        }
        if stuck {
            return Err(self.mechanism(step_of(self.freedoms() - 1)));
        }
        Ok(factor)
    }

    fn mechanism(&self, freedom: usize) -> Mechanism {
        Mechanism { node: self.kept[freedom / 6], freedom: freedom % 6 }
    }

    /// Overwrites the right side by the solution.
    pub(crate) fn solve(&self, factor: &[f64], right: &mut [f64]) {
        let Some(symbolic) = &self.symbolic else { return };
        let request = symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        LdltRef::new(symbolic, factor).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(right, self.freedoms(), 1),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(request)),
        );
    }

    /// `K u` of the assembled values.
    pub(crate) fn multiply(&self, values: &[f64], u: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; u.len()];
        for column in 0..self.freedoms() {
            let span = self.column_start[column]..self.column_start[column + 1];
            for (&row, value) in self.rows[span.clone()].iter().zip(&values[span]) {
                product[row] += value * u[column];
                if row != column {
                    product[column] += value * u[row];
                }
            }
        }
        product
    }
}

/// D in the order of elimination.
fn pivots(symbolic: &SymbolicCholesky<usize>, factor: &[f64]) -> Vec<f64> {
    match symbolic.raw() {
        SymbolicCholeskyRaw::Simplicial(simplicial) => {
            let starts = &simplicial.col_ptr()[..simplicial.ncols()];
            starts.iter().map(|&start| factor[start]).collect()
        }
        SymbolicCholeskyRaw::Supernodal(supernodal) => {
            let mut found = Vec::with_capacity(supernodal.nrows());
            for s in 0..supernodal.n_supernodes() {
                let width = supernodal.supernode_end()[s] - supernodal.supernode_begin()[s];
                let height = width + supernodal.supernode(s).pattern().len();
                let start = supernodal.col_ptr_for_val()[s];
                found.extend((0..width).map(|j| factor[start + j * height + j]));
            }
            found
        }
    }
}
