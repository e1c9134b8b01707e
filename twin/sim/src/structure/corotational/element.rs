//! One co-rotational beam: forces on its ends and their rate, for any displacements and turns.
//!
//! The member's axes go with the chord (x) and with the mean of the two ends' turns (roll), in
//! the manner of Battini and Pacoste (2002) but with y and z alike. In them the beam is the linear
//! one of `beam`, turned at its ends by their rotation vectors θ, with engineering strain of the
//! bowed axis, `ε = (l - L)/L + θᵀ H θ/2L`: what a cubic beam sags shortens its chord, so that two
//! parts of a strut already buckle as they should (without it the error in Euler's load is π²/12
//! by the square of the parts per half wave). The rate is exact, the terms of the roll with it.

use nalgebra::{Matrix3, SMatrix, SVector};

use super::local::Local;
use super::turn::{change_of_moment, rate_of_vector, rotation_vector};
use crate::pose::Vector;
use crate::structure::beam::{Beam, Matrix12, Vector12};
use crate::structure::frame::Member;

pub(super) type Matrix7 = SMatrix<f64, 7, 7>;
pub(super) type Vector7 = SVector<f64, 7>;

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
        let ends = turns.map(|turn| turn * self.axes);
        let mean = (ends[0] + ends[1]) * 0.5;
        // y as near as can be to the ends' y and to their z turned back
        let z = x.cross(&(mean.column(1) + mean.column(2).cross(&x))).normalize();
        let axes = Matrix3::from_columns(&[x, z.cross(&x), z]);
        let local_ends = ends.map(|end| axes.transpose() * end);

        let theta = local_ends.map(|end| rotation_vector(&end));
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
        let local = Local {
            length_m,
            conjugate: to_vector.transpose() * raw,
            sides: local_ends.map(|end| [end.column(1).into(), end.column(2).into()]),
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
