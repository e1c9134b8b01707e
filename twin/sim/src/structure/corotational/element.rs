//! One co-rotational beam: forces on its ends and their rate, for any displacements and turns.
//!
//! The member's axes go with the chord (x) and with the mean of the two ends' y (roll), as in
//! Battini and Pacoste (2002); in them the beam is the linear one of `beam`, turned at its ends by
//! their rotation vectors θ, with engineering strain of the bowed axis,
//! `ε = (l - L)/L + ½ θᵀ H θ`: what a cubic beam sags shortens its chord, so that two parts of a
//! strut already buckle as they should (without it the error in Euler's load is π²/12 by the square
//! of the parts per half wave). The rate is exact: to Battini's terms are added those of the roll.

use nalgebra::{Matrix3, SMatrix, SVector};

use super::turn::{change_of_moment, rate_of_vector, rotation_vector, spin};
use crate::pose::Vector;
use crate::structure::beam::{Beam, Matrix12, Vector12};
use crate::structure::frame::Member;

type Matrix7 = SMatrix<f64, 7, 7>;
type Vector7 = SVector<f64, 7>;
type Matrix7x12 = SMatrix<f64, 7, 12>;
type Matrix12x7 = SMatrix<f64, 12, 7>;
type Matrix3x12 = SMatrix<f64, 3, 12>;
type Row6 = SMatrix<f64, 1, 6>;

/// A member free of stress: nothing in it depends on the state.
#[derive(Debug, Clone)]
pub(super) struct Bar {
    pub(super) ends: [usize; 2],
    along: Vector,
    length_m: f64,
    /// Columns are x, y, z of the member free of stress.
    pub(super) axes: Matrix3<f64>,
    /// By stretch, turns of the first end, turns of the second.
    stiffness: Matrix7,
    /// Shortening of the bowed axis is `½ θᵀ H θ`: this is H, m (nothing for the stretch).
    bow: Matrix7,
    /// Weight per length, N/m.
    pub(super) line_n_per_m: Vector,
    /// `E A ε₀`.
    pull_n: f64,
}

/// Member at a state, in the axes of the part.
#[derive(Debug, Clone)]
pub(super) struct Response {
    /// Columns are the member's axes now.
    pub(super) axes: Matrix3<f64>,
    /// What the nodes put on the member's ends.
    pub(super) force: Vector12,
    /// Loads at its ends per unit of load factor: weight alone, and weight with initial strain.
    pub(super) weight: Vector12,
    pub(super) load: Vector12,
    /// Rate of `force` with shifts and spins of the ends; not symmetric out of equilibrium.
    pub(super) tangent: Matrix12,
    /// Errors of a force and of a moment that rounding of the state explains.
    pub(super) rounding: [f64; 2],
}

/// The member in its own axes, and what its rate needs.
struct Local {
    length_m: f64,
    /// Axial force, and moments conjugate to the ends' spins.
    conjugate: Vector7,
    /// y of the ends.
    roll: [Vector; 2],
    /// Mean of them.
    mean: Vector,
}

impl Bar {
    pub(super) fn new(
        member: &Member,
        beam: &Beam,
        gravity_m_s2: [f64; 3],
        with_strain: bool,
    ) -> Self {
        // stretch of the second end, then the turns, of the linear beam in its own axes
        const OF_BEAM: [usize; 7] = [6, 3, 4, 5, 9, 10, 11];
        let local = turned(&beam.stiffness, &beam.axes.transpose());
        let strain = if with_strain { member.initial_strain } else { 0.0 };
        let stiffness = Matrix7::from_fn(|row, column| local[(OF_BEAM[row], OF_BEAM[column])]);
        Self {
            ends: member.ends,
            along: beam.axes.column(0) * beam.length_m,
            length_m: beam.length_m,
            axes: beam.axes,
            bow: bow(&stiffness, beam.length_m),
            stiffness,
            line_n_per_m: beam.line_load(gravity_m_s2),
            pull_n: member.elastic.e_pa * member.section.area_m2 * strain,
        }
    }

    /// Largest turn or stretch that a relative shift of the ends means.
    pub(super) fn reach(&self, relative: &Vector) -> f64 {
        relative.norm() / self.length_m
    }

    /// Forces and rate where the ends have moved by `shifts` and turned by `turns`, with `factor`
    /// on initial strain. Numbers that are not finite where the ends meet or the roll is lost.
    ///
    /// The weight's moments at the ends are `x × w L²/12` with the x of now; their own rate is left
    /// out of the tangent (it goes with the square of the member's length).
    pub(super) fn response(
        &self,
        shifts: [Vector; 2],
        turns: [Matrix3<f64>; 2],
        factor: f64,
    ) -> Response {
        let change = shifts[1] - shifts[0];
        let now = self.along + change;
        let length_m = now.norm();
        // (l² - L²)/(l + L): nothing cancels
        let stretch = (self.along * 2.0 + change).dot(&change) / (length_m + self.length_m);
        let x = now / length_m;
        let sides = turns.map(|turn| turn * self.axes.column(1));
        let z = x.cross(&((sides[0] + sides[1]) * 0.5)).normalize();
        let axes = Matrix3::from_columns(&[x, z.cross(&x), z]);

        let theta = turns.map(|turn| rotation_vector(&(axes.transpose() * turn * self.axes)));
        let mut wanted = Vector7::zeros();
        wanted[0] = stretch;
        wanted.fixed_rows_mut::<3>(1).copy_from(&theta[0]);
        wanted.fixed_rows_mut::<3>(4).copy_from(&theta[1]);
        let (raw, raw_rate, along) = self.bowed(&wanted, factor);
        let rates = theta.map(|theta| rate_of_vector(&theta));
        let mut to_vector = Matrix7::identity();
        for (row, rate) in [1, 4].into_iter().zip(&rates) {
            to_vector.fixed_view_mut::<3, 3>(row, row).copy_from(rate);
        }
        let mut spun_rate = to_vector.transpose() * raw_rate * to_vector;
        for (end, row) in [1, 4].into_iter().enumerate() {
            let moment = Vector::from(raw.fixed_rows::<3>(row));
            let mut block = spun_rate.fixed_view_mut::<3, 3>(row, row);
            block += change_of_moment(&theta[end], &moment) * rates[end];
        }
        let roll = sides.map(|side| axes.transpose() * side);
        let local = Local {
            length_m,
            conjugate: to_vector.transpose() * raw,
            mean: (roll[0] + roll[1]) * 0.5,
            roll,
        };
        let b = local.b();
        let (force, tangent) = local.forces(&b, &spun_rate);
        let pull = b.transpose() * (to_vector.transpose() * along) * self.pull_n;

        let half = self.line_n_per_m * (self.length_m / 2.0);
        let moment = x.cross(&self.line_n_per_m) * (self.length_m.powi(2) / 12.0);
        let weight = stacked([half, moment, half, -moment]);
        let size_m = shifts[0].norm() + shifts[1].norm();
        let bend_n_m = f64::EPSILON * self.stiffness.diagonal().rows(1, 6).amax();
        let stretch_n = f64::EPSILON * self.stiffness[(0, 0)] * size_m;
        Response {
            axes,
            force: block_turned(&force, &axes),
            weight,
            load: weight + block_turned(&pull, &axes),
            tangent: turned(&tangent, &axes),
            rounding: [stretch_n + bend_n_m / self.length_m, bend_n_m],
        }
    }

    /// Axial force and moments conjugate to stretch and rotation vectors, their rate, and the rate
    /// of the bowed axis: `e = ū + ½ θᵀ H θ`, `N = E A e/L - λ E A ε₀`, `m = k θ + N H θ`.
    fn bowed(&self, wanted: &Vector7, factor: f64) -> (Vector7, Matrix7, Vector7) {
        let sag = self.bow * wanted;
        let stretch_n_per_m = self.stiffness[(0, 0)];
        let bowed_n = stretch_n_per_m * 0.5 * wanted.dot(&sag);
        let mut along = sag;
        along[0] = 1.0;
        let mut raw = self.stiffness * wanted;
        raw[0] += bowed_n - factor * self.pull_n;
        let axial_n = raw[0];
        let mut rate = self.stiffness + self.bow * axial_n;
        rate[(0, 0)] = 0.0;
        rate += along * along.transpose() * stretch_n_per_m;
        raw += sag * axial_n;
        (raw, rate, along)
    }
}

/// H of a beam with cubic shape, by its turns at the ends: with `a = (θ₁ + θ₂)/2` and
/// `s = (θ₁ - θ₂)/2`, `½ ∫ v'² = L (a²/(10 (1 + φ)²) + s²/6)` in each plane; φ (shear) is read off
/// the stiffness, `k_a = 6 E I/((1 + φ) L)`, `k_s = 2 E I/L`.
fn bow(stiffness: &Matrix7, length_m: f64) -> Matrix7 {
    let mut bow = Matrix7::zeros();
    for (first, second) in [(2, 5), (3, 6)] {
        let (own, cross) = (stiffness[(first, first)], stiffness[(first, second)]);
        let bends = (own + cross) / (3.0 * (own - cross));
        let (a, s) = (bends * bends / 10.0, 1.0 / 6.0);
        for (row, column, value) in [
            (first, first, a + s),
            (second, second, a + s),
            (first, second, a - s),
            (second, first, a - s),
        ] {
            bow[(row, column)] = 0.5 * length_m * value;
        }
    }
    bow
}

impl Local {
    /// Stretch and spins of the ends in the member's axes, by motion of the nodes.
    fn b(&self) -> Matrix7x12 {
        let frame = self.spin_of_axes();
        let mut b = Matrix7x12::zeros();
        b[(0, 0)] = -1.0;
        b[(0, 6)] = 1.0;
        for (row, column) in [(1, 3), (4, 9)] {
            b.fixed_view_mut::<3, 12>(row, 0).copy_from(&-frame);
            for axis in 0..3 {
                b[(row + axis, column + axis)] += 1.0;
            }
        }
        b
    }

    /// Forces on the ends and their rate in the member's axes:
    /// `f = Bᵀ p`, `k = (Bᵀ kₐ + ∂Bᵀ p) B - f̃ Gᵀ`.
    fn forces(&self, b: &Matrix7x12, rate: &Matrix7) -> (Vector12, Matrix12) {
        let frame = self.spin_of_axes();
        let force = b.transpose() * self.conjugate;
        let mut tangent = (b.transpose() * rate + self.change_of_b()) * b;
        for row in (0..12).step_by(3) {
            let turned = spin(&Vector::from(force.fixed_rows::<3>(row))) * frame;
            let mut rows = tangent.fixed_view_mut::<3, 12>(row, 0);
            rows -= turned;
        }
        (force, tangent)
    }

    /// Gᵀ: the spin of the member's axes. Across, of the chord; along, what keeps the mean y in the
    /// x-y plane: `ω₁ q_y = ω₂ q_x + Σ (w_x q_iy - w_y q_ix)/2`.
    fn spin_of_axes(&self) -> Matrix3x12 {
        let mut frame = Matrix3x12::zeros();
        let by_length = 1.0 / self.length_m;
        frame[(1, 2)] = by_length;
        frame[(1, 8)] = -by_length;
        frame[(2, 1)] = -by_length;
        frame[(2, 7)] = by_length;
        let eta = self.mean.x / self.mean.y;
        frame[(0, 2)] = eta * by_length;
        frame[(0, 8)] = -eta * by_length;
        for (end, column) in [3, 9].into_iter().enumerate() {
            frame[(0, column)] = 0.5 * self.roll[end].y / self.mean.y;
            frame[(0, column + 1)] = -0.5 * self.roll[end].x / self.mean.y;
        }
        frame
    }

    /// Rate of `Bᵀ p` for constant p with stretch and the ends' spins.
    fn change_of_b(&self) -> Matrix12x7 {
        let sum =
            Vector::from(self.conjugate.fixed_rows::<3>(1) + self.conjugate.fixed_rows::<3>(4));
        let (l, q) = (self.length_m, self.mean);
        let eta = q.x / q.y;
        let mut change = Matrix12x7::zeros();
        let across = [sum.z / (l * l), -(sum.y + sum.x * eta) / (l * l)];
        for (axis, value) in across.into_iter().enumerate() {
            change[(7 + axis, 0)] = value;
            change[(1 + axis, 0)] = -value;
        }
        // y of an end goes with its spin: δq = w × q; by component, over the six spins
        let part = |end: usize, axis: usize| {
            let mut row = Row6::zeros();
            row.fixed_view_mut::<1, 3>(0, 3 * end).copy_from(&-spin(&self.roll[end]).row(axis));
            row
        };
        let parts = [[part(0, 0), part(0, 1)], [part(1, 0), part(1, 1)]];
        let [mean_x, mean_y] = [0, 1].map(|axis| (parts[0][axis] + parts[1][axis]) * 0.5);
        let lift = (mean_x - mean_y * eta) * (sum.x / (l * q.y));
        let mut add = |row: usize, values: Row6| {
            let mut place = change.fixed_view_mut::<1, 6>(row, 1);
            place += values;
        };
        add(8, lift);
        add(2, -lift);
        for (end, row) in [3, 9].into_iter().enumerate() {
            let scale = 0.5 * sum.x / q.y;
            let roll = self.roll[end];
            add(row, (parts[end][1] - mean_y * (roll.y / q.y)) * -scale);
            add(row + 1, (parts[end][0] - mean_y * (roll.x / q.y)) * scale);
        }
        change
    }
}

/// Four vectors, one under the other.
fn stacked(blocks: [Vector; 4]) -> Vector12 {
    Vector12::from_fn(|row, _| blocks[row / 3][row % 3])
}

/// Each of the four vectors turned.
pub(super) fn block_turned(forces: &Vector12, axes: &Matrix3<f64>) -> Vector12 {
    stacked([0, 3, 6, 9].map(|row| axes * forces.fixed_rows::<3>(row)))
}

/// `T k Tᵀ` with T four times the axes on the diagonal.
fn turned(local: &Matrix12, axes: &Matrix3<f64>) -> Matrix12 {
    let mut k = Matrix12::zeros();
    for row in (0..12).step_by(3) {
        for column in (0..12).step_by(3) {
            let block = axes * local.fixed_view::<3, 3>(row, column) * axes.transpose();
            k.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
        }
    }
    k
}
