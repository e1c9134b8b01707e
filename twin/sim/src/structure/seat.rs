//! Nodes that have let go of a surface: how far they are from it, and how it presses on them.

use nalgebra::DMatrix;

use super::complementary::complementary;
use super::ldl::Pair;
use super::stages::{Sequence, Stage};
use super::standing::{ONE_SHOT, STAGED, Standing};
use crate::pose::Vector;

/// A node that has let go.
#[derive(Debug, Clone)]
pub(super) struct Seat {
    pub(super) node: usize,
    /// Out of the surface.
    pub(super) normal: Vector,
    /// Displacement along the normal at which it touches the surface, m: nothing one-shot, staged
    /// that at which it let go.
    at_m: Pair,
    /// What the surface presses, N.
    pub(super) force_n: Pair,
}

/// Forces of the surfaces, on both answers.
pub(super) fn add_pressed(seats: &[Seat], to: &mut [Pair]) {
    for seat in seats {
        for axis in 0..3 {
            for side in [ONE_SHOT, STAGED] {
                to[6 * seat.node + axis][side] += seat.normal[axis] * seat.force_n[side];
            }
        }
    }
}

/// Reactions in the order of a stage's supports from those of the supports that still hold.
pub(super) fn all_reactions(
    stage: &Stage,
    seats: &[Seat],
    still: &[[f64; 6]],
    side: usize,
) -> Vec<[f64; 6]> {
    let mut still = still.iter();
    let of_support = |node: usize| match seats.iter().find(|seat| seat.node == node) {
        Some(seat) => {
            let f = seat.normal * seat.force_n[side];
            [f.x, f.y, f.z, 0.0, 0.0, 0.0]
        }
        None => still.next().copied().unwrap_or_default(),
    };
    stage.supports.iter().map(|support| support.node).map(of_support).collect()
}

impl Standing {
    /// A node lets go where it is.
    pub(super) fn let_go(&mut self, node: usize, normal: Vector) {
        let at_m = [0.0, self.along_m(node, &normal, STAGED)];
        self.seats.push(Seat { node, normal, at_m, force_n: [0.0; 2] });
    }

    /// Force of a support on its node.
    pub(super) fn held_force(&self, node: usize, side: usize) -> Vector {
        Vector::from_fn(|axis, _| -self.gap[6 * node + axis][side])
    }

    /// Largest translation along an axis, of both answers, m.
    pub(super) fn largest_m(&self) -> f64 {
        let of_node = |six: &[Pair]| six[..3].iter().flatten().fold(0.0f64, |m, u| m.max(u.abs()));
        self.u.chunks_exact(6).map(of_node).fold(0.0, f64::max)
    }

    /// How far the seats are above their surfaces, m; `None` for those of a piece that floats.
    pub(super) fn gaps_m(&self) -> Vec<Option<Pair>> {
        let gap = |seat: &Seat| {
            let side = |side| self.along_m(seat.node, &seat.normal, side) - seat.at_m[side];
            (self.free[seat.node] == [true; 6]).then(|| [side(ONE_SHOT), side(STAGED)])
        };
        self.seats.iter().map(gap).collect()
    }

    fn along_m(&self, node: usize, normal: &Vector, side: usize) -> f64 {
        (0..3).map(|axis| self.u[6 * node + axis][side] * normal[axis]).sum()
    }
}

impl Sequence<'_> {
    /// Finds what the surface presses on the seats that are `near` it, each answer by itself; whether
    /// it was found. The others are not pressed.
    pub(super) fn press(&mut self, near: &[bool], gaps_m: &[Option<Pair>]) -> bool {
        let at: Vec<usize> = (0..near.len()).filter(|&seat| near[seat]).collect();
        let w = self.flexibility(&at);
        let old: Vec<Pair> = self.standing.seats.iter().map(|seat| seat.force_n).collect();
        self.standing.seats.iter_mut().for_each(|seat| seat.force_n = [0.0; 2]);
        let mut is_settled = true;
        for side in [ONE_SHOT, STAGED] {
            let gap = |i: usize| gaps_m[at[i]].map_or(0.0, |gap| gap[side]);
            let by_old =
                |i: usize| -> f64 { (0..at.len()).map(|j| w[(i, j)] * old[at[j]][side]).sum() };
            let q: Vec<f64> = (0..at.len()).map(|i| gap(i) - by_old(i)).collect();
            let pressing: Vec<bool> =
                (0..at.len()).map(|i| old[at[i]][side] > 0.0 || gap(i) < 0.0).collect();
            let pressed = complementary(&w, &q, &pressing);
            is_settled &= pressed.is_settled;
            for (&seat, force) in at.iter().zip(&pressed.force_n) {
                self.standing.seats[seat].force_n[side] = *force;
            }
        }
        is_settled
    }

    /// `n_i · K⁻¹ n_j` of some seats, m/N; two solves at a time.
    fn flexibility(&self, at: &[usize]) -> DMatrix<f64> {
        let seats: Vec<&Seat> = at.iter().map(|&seat| &self.standing.seats[seat]).collect();
        let mut w = DMatrix::zeros(seats.len(), seats.len());
        for pair in (0..seats.len()).step_by(2) {
            let mut moved = vec![[0.0; 2]; self.standing.u.len()];
            for (side, seat) in seats[pair..].iter().take(2).enumerate() {
                (0..3).for_each(|axis| moved[6 * seat.node + axis][side] = seat.normal[axis]);
            }
            self.growing.solve(&mut moved);
            for side in 0..seats.len().min(pair + 2) - pair {
                for (i, seat) in seats.iter().enumerate() {
                    let along = |axis: usize| moved[6 * seat.node + axis][side] * seat.normal[axis];
                    w[(i, pair + side)] = (0..3).map(along).sum();
                }
            }
        }
        (&w + w.transpose()) * 0.5
    }
}
