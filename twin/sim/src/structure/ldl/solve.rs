//! Two right sides at once through the factor: each block of L is read once for both.

use super::factor::{Factor, Rank};

/// The two right sides, or solutions, at one freedom.
pub(crate) type Pair = [f64; 2];

impl Factor {
    /// Overwrites two right sides, six freedoms per node of the frame, by the solutions; freedoms
    /// that are held or absent become 0.
    ///
    /// O(blocks of L).
    pub(crate) fn solve(&self, of_frame: &mut [Pair]) {
        let n = self.symbolic.len();
        let mut x = vec![[[0.0; 2]; 6]; n];
        for (j, six) in x.iter_mut().enumerate() {
            let node = self.symbolic.node[j];
            for freedom in (0..6).filter(|&freedom| self.free[j][freedom]) {
                six[freedom] = of_frame[6 * node + freedom];
            }
        }
        of_frame.fill([0.0; 2]);
        for j in (0..n).filter(|&j| self.rank[j] != Rank::Absent) {
            self.descend(j, &mut x);
        }
        for j in (0..n).rev().filter(|&j| self.rank[j] != Rank::Absent) {
            self.ascend(j, &mut x);
            let node = self.symbolic.node[j];
            for freedom in (0..6).filter(|&freedom| self.free[j][freedom]) {
                of_frame[6 * node + freedom] = x[j][freedom];
            }
        }
    }

    /// Takes the share of place j from all below it, then divides by its pivot.
    fn descend(&self, j: usize, x: &mut [[Pair; 6]]) {
        let own = x[j];
        // a right side that has nothing here has nothing to hand on
        if own == [[0.0; 2]; 6] {
            return;
        }
        for at in self.symbolic.start[j]..self.symbolic.start[j + 1] {
            let b = self.symbolic.rows[at];
            if self.rank[b] != Rank::Absent {
                let mut sum = x[b];
                for (column, by) in self.l[at].chunks_exact(6).zip(&own) {
                    for (sum, value) in sum.iter_mut().zip(column) {
                        sum[0] -= value * by[0];
                        sum[1] -= value * by[1];
                    }
                }
                x[b] = sum;
            }
        }
        let c = &self.c[j];
        let mut own = own;
        for k in 0..6 {
            own[k] = own[k].map(|value| value / c[7 * k]);
            for row in k + 1..6 {
                take(&mut own, row, c[6 * k + row], k);
            }
        }
        for k in (0..6).rev() {
            for row in k + 1..6 {
                take(&mut own, k, c[6 * k + row], row);
            }
            own[k] = own[k].map(|value| value / c[7 * k]);
        }
        x[j] = own;
    }

    fn ascend(&self, j: usize, x: &mut [[Pair; 6]]) {
        let mut sum = x[j];
        for at in self.symbolic.start[j]..self.symbolic.start[j + 1] {
            let b = self.symbolic.rows[at];
            if self.rank[b] != Rank::Absent {
                let below = x[b];
                for (sum, column) in sum.iter_mut().zip(self.l[at].chunks_exact(6)) {
                    for (value, below) in column.iter().zip(&below) {
                        sum[0] -= value * below[0];
                        sum[1] -= value * below[1];
                    }
                }
            }
        }
        x[j] = sum;
    }
}

/// Takes a multiple of one freedom from another.
fn take(x: &mut [Pair; 6], to: usize, factor: f64, from: usize) {
    let [one, two] = x[from];
    x[to][0] -= factor * one;
    x[to][1] -= factor * two;
}
