//! The fastest law without jerk limits: two passes through the phase plane.
//!
//! With `x = ṡ²` and `u = s̈` constant in a cell, `x` is linear in `s`: `x₊ = x + 2 Δ u`. Every
//! bound is linear in `(x, u)`, at both ends of the cell. Backward: the largest `x` of each node from
//! which the end can be reached; forward: as fast as that allows. O(cells · joints).

use super::grid::{Grid, Row};

/// A coefficient of `u` below this share of what it changes by over the cell is zero.
const NO_INERTIA: f64 = 1e-9;
/// Least share of the largest `x`.
const STANDING: f64 = 1e-9;

/// Bounds of each cell that change from one pass to the next.
#[derive(Debug, Clone)]
pub(super) struct Allowance {
    /// Largest ds/dt.
    pub(super) speed: Vec<f64>,
    /// Largest |d²s/dt²|.
    pub(super) ramp: Vec<f64>,
    /// Share of the joints' speed that may be used.
    pub(super) slow: Vec<f64>,
    /// Share of the joints' acceleration and torque that may be used.
    pub(super) soft: Vec<f64>,
}

/// `ṡ²` at the nodes, zero at both ends; all zero if some cell cannot be passed.
pub(super) fn sweep(grid: &Grid, allowance: &Allowance) -> Vec<f64> {
    let n = grid.cells.len();
    let mut x = tops(grid, allowance);
    x[n] = 0.0;
    for k in (0..n).rev() {
        x[k] = highest(grid, allowance, k, x[k], x[k + 1]);
    }
    x[0] = 0.0;
    for k in 0..n {
        let range = range(grid, allowance, k, x[k], x[k + 1]);
        let next = x[k] + 2.0 * grid.cells[k].width * range.high.here;
        // Where rounding leaves no acceleration possible it must not leave the arm standing.
        x[k + 1] = next.clamp(STANDING * x[k + 1], x[k + 1]);
    }
    x
}

/// Largest `x` of the nodes by speed alone.
fn tops(grid: &Grid, allowance: &Allowance) -> Vec<f64> {
    let n = grid.cells.len();
    let side = |node: usize, cell: usize| {
        allowance.speed[cell].min(allowance.slow[cell] * grid.nodes[node].speed)
    };
    let top = |node: usize| {
        let before = if node > 0 { side(node, node - 1) } else { f64::INFINITY };
        let after = if node < n { side(node, node) } else { f64::INFINITY };
        let speed = before.min(after);
        // Far above any machine, and its square is still a number.
        speed.min(1e100).powi(2)
    };
    (0..=n).map(top).collect()
}

/// A bound on `u` that is linear in `x`.
#[derive(Clone, Copy)]
struct Edge {
    at_zero: f64,
    slope: f64,
    /// At the `x` looked at.
    here: f64,
}

/// The accelerations possible in a cell from `x` at its start.
struct Range {
    x: f64,
    low: Edge,
    high: Edge,
}

impl Range {
    fn new(x: f64, ramp: f64) -> Self {
        let flat = |here| Edge { at_zero: here, slope: 0.0, here };
        Self { x, low: flat(-ramp), high: flat(ramp) }
    }

    fn below(&mut self, at_zero: f64, slope: f64) {
        let here = at_zero + slope * self.x;
        if here < self.high.here {
            self.high = Edge { at_zero, slope, here };
        }
    }

    fn above(&mut self, at_zero: f64, slope: f64) {
        let here = at_zero + slope * self.x;
        if here > self.low.here {
            self.low = Edge { at_zero, slope, here };
        }
    }

    /// `low ≤ a u + b x ≤ high`, times `share`.
    fn cut(&mut self, row: &Row, a: f64, twice: f64, share: f64) {
        if no_inertia(row, a, twice) {
            return;
        }
        let slope = -row.b / a;
        let (one, other) = (share * row.high / a, share * row.low / a);
        self.below(one.max(other), slope);
        self.above(one.min(other), slope);
    }
}

fn range(grid: &Grid, allowance: &Allowance, k: usize, x: f64, next: f64) -> Range {
    let cell = &grid.cells[k];
    let ramp = allowance.ramp[k];
    let mut range = Range::new(x, ramp);
    let twice = 2.0 * cell.width;
    range.below(next / twice, -1.0 / twice);
    range.above(0.0, -1.0 / twice);
    let middle = (allowance.slow[k] * cell.speed).min(1e100).powi(2);
    range.below(middle / cell.width, -1.0 / cell.width);
    let soft = allowance.soft[k];
    for row in &grid.nodes[k].rows[..grid.nodes[k].n_rows] {
        range.cut(row, row.a, twice, soft);
    }
    for row in &grid.nodes[k + 1].rows[..grid.nodes[k + 1].n_rows] {
        range.cut(row, row.a + twice * row.b, twice, soft);
    }
    range
}

/// The largest `x ≤ top` at the start of cell `k` from which its end is reached with at most
/// `next`: the largest root of a concave function by Newton's method from above.
fn highest(grid: &Grid, allowance: &Allowance, k: usize, top: f64, next: f64) -> f64 {
    let soft = allowance.soft[k];
    let twice = 2.0 * grid.cells[k].width;
    // Where `u` does not matter to a joint, `x` alone is bounded.
    let still = |row: &Row, a: f64| {
        let bound = if row.b > 0.0 { row.high } else { row.low };
        if row.b != 0.0 && no_inertia(row, a, twice) { soft * bound / row.b } else { f64::INFINITY }
    };
    let (from, to) = (&grid.nodes[k], &grid.nodes[k + 1]);
    let own = from.rows[..from.n_rows].iter().map(|row| still(row, row.a));
    let other = to.rows[..to.n_rows].iter().map(|row| still(row, row.a + twice * row.b));
    let mut x = own.chain(other).fold(top, f64::min);
    for _ in 0..64 {
        let range = range(grid, allowance, k, x, next);
        let closing = range.low.slope - range.high.slope;
        if range.high.here >= range.low.here || !(closing > 0.0) {
            return x;
        }
        // From the values at zero: far from the root those at `x` are all rounding.
        let lower = ((range.high.at_zero - range.low.at_zero) / closing).max(0.0);
        if lower >= x {
            return x;
        }
        x = lower;
    }
    x
}

fn no_inertia(row: &Row, a: f64, twice: f64) -> bool {
    a.abs() <= NO_INERTIA * (row.a.abs() + twice * row.b.abs())
}
