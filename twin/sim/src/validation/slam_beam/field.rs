//! The stress in a flat rectangular plate, by bilinear elements on an even grid.

use std::ops::Range;

/// Stress in the plane: σx, σy, τxy.
pub(super) type Tensor = [f64; 3];
/// Stiffness of a cell; freedoms x, y of its corners (0,0), (1,0), (1,1), (0,1).
type Matrix8 = [[f64; 8]; 8];

/// A plate from the origin to (length, height), x along, y up, in equal cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grid {
    pub(super) size_m: [f64; 2],
    pub(super) cells: [usize; 2],
}

impl Grid {
    pub(super) fn node(&self, column: usize, row: usize) -> usize {
        column * (self.cells[1] + 1) + row
    }

    pub(super) fn freedoms(&self) -> usize {
        2 * (self.cells[0] + 1) * (self.cells[1] + 1)
    }

    pub(super) fn cell_m(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.size_m[axis] / self.cells[axis] as f64)
    }

    /// Loads at the nodes of a row for a traction of unit total, even over a part of the length.
    pub(super) fn spread(&self, row: usize, over_m: Range<f64>) -> Vec<(usize, f64)> {
        let [cell_m, _] = self.cell_m();
        let width_m = over_m.end - over_m.start;
        let mut loads = vec![0.0; self.cells[0] + 1];
        for column in 0..self.cells[0] {
            let from = over_m.start.max(column as f64 * cell_m);
            let to = over_m.end.min((column + 1) as f64 * cell_m);
            if to > from {
                // linear shapes: the mean of the covered piece is where it counts
                let right = (0.5 * (from + to) / cell_m - column as f64).clamp(0.0, 1.0);
                loads[column] += (1.0 - right) * (to - from) / width_m;
                loads[column + 1] += right * (to - from) / width_m;
            }
        }
        let at = |(column, load): (usize, f64)| (self.node(column, row), load);
        loads.into_iter().enumerate().filter(|(_, load)| *load != 0.0).map(at).collect()
    }
}

/// Stress at the centres of the cells, where bilinear elements are best, and between.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field {
    grid: Grid,
    centres: Vec<Tensor>,
}

/// Solves the plate of unit thickness and modulus under forces by freedom (x and y of each node),
/// some freedoms held. The stress is of order h² in the cell. `None` where the plate is not held
/// enough, or a number is not finite.
pub(super) fn plate(grid: Grid, poisson: f64, forces: &[f64], held: &[usize]) -> Option<Field> {
    let [width_m, height_m] = grid.cell_m();
    let cell = cell_stiffness(width_m, height_m, poisson);
    let n = grid.freedoms();
    // the farthest coupling of a node is to the cell's other corner
    let band = 2 * (grid.cells[1] + 2) + 2;
    let mut banded = Banded::new(n, band);
    for column in 0..grid.cells[0] {
        for row in 0..grid.cells[1] {
            let freedoms = corner_freedoms(&grid, column, row);
            for (i, &a) in freedoms.iter().enumerate() {
                for (j, &b) in freedoms.iter().enumerate().filter(|(_, b)| **b <= a) {
                    *banded.at(a, b) += cell[i][j];
                }
            }
        }
    }
    let mut u = forces.to_vec();
    u.resize(n, 0.0);
    for &freedom in held.iter().filter(|freedom| **freedom < n) {
        banded.hold(freedom);
        u[freedom] = 0.0;
    }
    banded.solve(&mut u)?;
    let at_centre = |column: usize, row: usize| {
        let corner = corner_freedoms(&grid, column, row).map(|freedom| u[freedom]);
        let strain = strain(width_m, height_m, [0.0, 0.0]).map(|line| dot(&line, &corner));
        stress(poisson, strain)
    };
    let cells = (0..grid.cells[0]).flat_map(|i| (0..grid.cells[1]).map(move |j| (i, j)));
    let centres = cells.map(|(column, row)| at_centre(column, row)).collect();
    Some(Field { grid, centres })
}

impl Field {
    /// The tensor, bilinear between the four nearest centres; carried on straight past the outermost.
    pub(super) fn stress(&self, at_m: [f64; 2]) -> Tensor {
        let cell_m = self.grid.cell_m();
        let place = |axis: usize| {
            let last = self.grid.cells[axis].saturating_sub(2) as f64;
            let along = at_m[axis] / cell_m[axis] - 0.5;
            let first = along.floor().clamp(0.0, last.max(0.0));
            (first as usize, along - first)
        };
        let ((i, right), (j, up)) = (place(0), place(1));
        let centre = |i: usize, j: usize| {
            let [i, j] = [i.min(self.grid.cells[0] - 1), j.min(self.grid.cells[1] - 1)];
            self.centres[i * self.grid.cells[1] + j]
        };
        let corners = [centre(i, j), centre(i + 1, j), centre(i + 1, j + 1), centre(i, j + 1)];
        let weight =
            [(1.0 - right) * (1.0 - up), right * (1.0 - up), right * up, (1.0 - right) * up];
        [0, 1, 2].map(|part| (0..4).map(|corner| weight[corner] * corners[corner][part]).sum())
    }
}

fn corner_freedoms(grid: &Grid, column: usize, row: usize) -> [usize; 8] {
    let nodes = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| grid.node(column + i, row + j));
    std::array::from_fn(|k| 2 * nodes[k / 2] + k % 2)
}

/// Strain from the corners' displacements at a place in -1 to 1.
fn strain(width_m: f64, height_m: f64, [r, s]: [f64; 2]) -> [[f64; 8]; 3] {
    let mut rows = [[0.0; 8]; 3];
    for (corner, [a, b]) in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].iter().enumerate()
    {
        let along = a * (1.0 + b * s) / (2.0 * width_m);
        let up = b * (1.0 + a * r) / (2.0 * height_m);
        rows[0][2 * corner] = along;
        rows[1][2 * corner + 1] = up;
        rows[2][2 * corner] = up;
        rows[2][2 * corner + 1] = along;
    }
    rows
}

/// Plane stress, E = 1.
fn stress(poisson: f64, [ex, ey, shear]: [f64; 3]) -> Tensor {
    let plate = 1.0 / (1.0 - poisson * poisson);
    [plate * (ex + poisson * ey), plate * (ey + poisson * ex), shear / (2.0 * (1.0 + poisson))]
}

/// `∫ Bᵀ D B` by 2 × 2 points.
fn cell_stiffness(width_m: f64, height_m: f64, poisson: f64) -> Matrix8 {
    let point = 1.0 / 3f64.sqrt();
    let mut k = [[0.0; 8]; 8];
    for at in [[-point, -point], [point, -point], [point, point], [-point, point]] {
        let rows = strain(width_m, height_m, at);
        for j in 0..8 {
            let column = stress(poisson, [rows[0][j], rows[1][j], rows[2][j]]);
            for i in 0..8 {
                let work: f64 = (0..3).map(|part| rows[part][i] * column[part]).sum();
                k[i][j] += work * width_m * height_m / 4.0;
            }
        }
    }
    k
}

fn dot(a: &[f64; 8], b: &[f64; 8]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A symmetric matrix near its diagonal, lower half by rows; and its Cholesky factor in place.
struct Banded {
    n: usize,
    band: usize,
    values: Vec<f64>,
}

impl Banded {
    fn new(n: usize, band: usize) -> Self {
        Self { n, band, values: vec![0.0; n * (band + 1)] }
    }

    /// Entry of a row at or left of the diagonal, at most `band` away.
    fn at(&mut self, row: usize, column: usize) -> &mut f64 {
        &mut self.values[row * (self.band + 1) + self.band + column - row]
    }

    /// The stored part of a row between two columns.
    fn part(&self, row: usize, columns: Range<usize>) -> &[f64] {
        let shift = row * (self.band + 1) + self.band;
        &self.values[shift + columns.start - row..shift + columns.end - row]
    }

    /// Makes a freedom `1 · u = 0`, uncoupled.
    fn hold(&mut self, freedom: usize) {
        for other in freedom.saturating_sub(self.band)..(freedom + self.band + 1).min(self.n) {
            let same = if other == freedom { 1.0 } else { 0.0 };
            *self.at(other.max(freedom), other.min(freedom)) = same;
        }
    }

    /// Overwrites the right side by the solution; `None` at a pivot that is not positive.
    fn solve(mut self, right: &mut [f64]) -> Option<()> {
        for row in 0..self.n {
            let first = row.saturating_sub(self.band);
            let whole = *self.at(row, row);
            for column in first..=row {
                let start = first.max(column.saturating_sub(self.band));
                let (a, b) = (self.part(row, start..column), self.part(column, start..column));
                let sum: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
                let left = *self.at(row, column) - sum;
                if column < row {
                    *self.at(row, column) = left / *self.at(column, column);
                } else if left > 1e-12 * whole && left.is_finite() {
                    *self.at(row, row) = left.sqrt();
                } else {
                    return None;
                }
            }
        }
        for row in 0..self.n {
            let first = row.saturating_sub(self.band);
            let known = self.part(row, first..row).iter().zip(&right[first..row]);
            let sum: f64 = known.map(|(l, u)| l * u).sum();
            right[row] = (right[row] - sum) / *self.at(row, row);
        }
        for row in (0..self.n).rev() {
            let first = row.saturating_sub(self.band);
            right[row] /= *self.at(row, row);
            let known = right[row];
            for (u, l) in right[first..row].iter_mut().zip(self.part(row, first..row)) {
                *u -= l * known;
            }
        }
        right.iter().all(|u| u.is_finite()).then_some(())
    }
}
