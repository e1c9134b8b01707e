//! A member in axes that go with it: how nodes move its ends, and the forces that follow.

use nalgebra::SMatrix;

use super::element::{Matrix7, Vector7};
use super::turn::spin;
use crate::pose::Vector;
use crate::structure::beam::{Matrix12, Vector12};

pub(super) type Matrix7x12 = SMatrix<f64, 7, 12>;
type Matrix12x7 = SMatrix<f64, 12, 7>;
type Matrix3x12 = SMatrix<f64, 3, 12>;
type Row6 = SMatrix<f64, 1, 6>;

/// The member in its own axes, and what its rate needs.
pub(super) struct Local {
    pub(super) length_m: f64,
    /// Axial force, and moments conjugate to the ends' spins.
    pub(super) conjugate: Vector7,
    /// y and z of the ends.
    pub(super) sides: [[Vector; 2]; 2],
}

impl Local {
    /// Stretch and spins of the ends in the member's axes, by motion of the nodes.
    pub(super) fn b(&self) -> Matrix7x12 {
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
    pub(super) fn forces(&self, b: &Matrix7x12, rate: &Matrix7) -> (Vector12, Matrix12) {
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

    /// Means `p` of the ends' y and z, and `D = p_y·y + p_z·z`.
    fn roll(&self) -> ([Vector; 2], f64) {
        let mean = [0, 1].map(|side| (self.sides[0][side] + self.sides[1][side]) * 0.5);
        (mean, mean[0].y + mean[1].z)
    }

    /// Gᵀ: the spin of the member's axes. Across, of the chord; along, what keeps the ends' y and z
    /// turned as little one way as the other, `p_y·z = p_z·y`:
    /// `ω₁ D = ω₂ p_yx + ω₃ p_zx + ½ Σ (w_x (y_y + z_z) - w_y y_x - w_z z_x)`.
    fn spin_of_axes(&self) -> Matrix3x12 {
        let mut frame = Matrix3x12::zeros();
        let by_length = 1.0 / self.length_m;
        frame[(1, 2)] = by_length;
        frame[(1, 8)] = -by_length;
        frame[(2, 1)] = -by_length;
        frame[(2, 7)] = by_length;
        let ([y, z], whole) = self.roll();
        let along = frame.row(1) * (y.x / whole) + frame.row(2) * (z.x / whole);
        frame.row_mut(0).copy_from(&along);
        for (end, column) in [3, 9].into_iter().enumerate() {
            let share = self.share(end) / whole;
            frame.fixed_view_mut::<1, 3>(0, column).copy_from(&share.transpose());
        }
        frame
    }

    /// An end's part in the roll: `½ (y_y + z_z, -y_x, -z_x)`.
    fn share(&self, end: usize) -> Vector {
        let [y, z] = self.sides[end];
        Vector::new(y.y + z.z, -y.x, -z.x) * 0.5
    }

    /// Rate of `Bᵀ p` for constant p with stretch and the ends' spins.
    fn change_of_b(&self) -> Matrix12x7 {
        let sum =
            Vector::from(self.conjugate.fixed_rows::<3>(1) + self.conjugate.fixed_rows::<3>(4));
        let l = self.length_m;
        let ([y, z], whole) = self.roll();
        let tilt = [y.x / whole, z.x / whole];
        let mut change = Matrix12x7::zeros();
        let across = [(sum.z + sum.x * tilt[1]) / (l * l), -(sum.y + sum.x * tilt[0]) / (l * l)];
        for (axis, value) in across.into_iter().enumerate() {
            change[(7 + axis, 0)] = value;
            change[(1 + axis, 0)] = -value;
        }
        // a side of an end goes with its spin, δq = w × q: by component, over the six spins
        let part = |end: usize, side: usize, axis: usize| {
            let mut row = Row6::zeros();
            let own = -spin(&self.sides[end][side]);
            row.fixed_view_mut::<1, 3>(0, 3 * end).copy_from(&own.row(axis));
            row
        };
        let both = |side: usize, axis: usize| (part(0, side, axis) + part(1, side, axis)) * 0.5;
        let of_whole = both(0, 1) + both(1, 2);
        let mut add = |row: usize, values: Row6| {
            let mut place = change.fixed_view_mut::<1, 6>(row, 1);
            place += values * (sum.x / whole);
        };
        for (side, (up, down)) in [(8, 2), (1, 7)].into_iter().enumerate() {
            let lift = (both(side, 0) - of_whole * tilt[side]) / l;
            add(up, lift);
            add(down, -lift);
        }
        for (end, row) in [3, 9].into_iter().enumerate() {
            let share = self.share(end) / whole;
            add(row, of_whole * share.x - (part(end, 0, 1) + part(end, 1, 2)) * 0.5);
            add(row + 1, of_whole * share.y + part(end, 0, 0) * 0.5);
            add(row + 2, of_whole * share.z + part(end, 1, 0) * 0.5);
        }
        change
    }
}
