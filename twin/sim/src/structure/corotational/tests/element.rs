//! The beam by itself.

use nalgebra::{Matrix3, Rotation3};
use proptest::prelude::*;

use crate::pose::{Point, Vector};
use crate::structure::beam::{Matrix12, Vector12, beams};
use crate::structure::corotational::element::{Bar, Response, block_turned};
use crate::structure::corotational::turn::{change_of_moment, rate_of_vector, rotation_vector};
use crate::structure::{Elastic, Frame, Member, Section};

const GRAVITY: [f64; 3] = [1.0, -2.0, 3.0];

/// A stocky flat member with shear, strained, of order one in everything.
fn bar() -> Bar {
    let member = Member {
        ends: [0, 1],
        section: Section::ellipse(0.5, 0.3).sheared(0.8),
        elastic: Elastic { e_pa: 90.0, g_pa: 40.0 },
        density_kg_m3: 2.0,
        initial_strain: -0.05,
        side: Vector::new(0.2, 1.0, 0.4),
        strand: 0,
    };
    let frame =
        Frame::new(vec![Point::new(0.3, 0.1, -0.2), Point::new(1.2, 0.7, 0.5)], vec![member])
            .unwrap();
    Bar::new(&member, &beams(&frame)[0], GRAVITY, true)
}

fn turn(vector: [f64; 3]) -> Matrix3<f64> {
    *Rotation3::from_scaled_axis(Vector::from(vector)).matrix()
}

/// Moved by `step` from a far state: shifts add, spins turn on top.
fn at(shifts: [Vector; 2], turns: [Matrix3<f64>; 2], step: &Vector12) -> Response {
    let three = |row: usize| Vector::from(step.fixed_rows::<3>(row));
    let spun = |end: usize| turn(three(6 * end + 3).into()) * turns[end];
    bar().response([shifts[0] + three(0), shifts[1] + three(6)], [spun(0), spun(1)], 0.7)
}

/// Central differences of the force by every freedom, Richardson from two steps.
fn differences(shifts: [Vector; 2], turns: [Matrix3<f64>; 2]) -> Matrix12 {
    let by = |column: usize, h: f64| {
        let step = |h: f64| Vector12::from_fn(|row, _| if row == column { h } else { 0.0 });
        (at(shifts, turns, &step(h)).force - at(shifts, turns, &step(-h)).force) / (2.0 * h)
    };
    let columns: Vec<Vector12> =
        (0..12).map(|column| (by(column, 1e-3) * 4.0 - by(column, 2e-3)) / 3.0).collect();
    Matrix12::from_columns(&columns)
}

/// A large common turn, local turns of half a radian, a large stretch.
fn far(common: [f64; 3]) -> ([Vector; 2], [Matrix3<f64>; 2]) {
    let common_turn = turn(common);
    let shift = Vector::new(0.9, 0.6, 0.7);
    let moved = common_turn * (shift * 1.3) - shift;
    let turns = [common_turn * turn([0.3, -0.4, 0.2]), common_turn * turn([-0.35, 0.1, 0.45])];
    ([Vector::new(5.0, -3.0, 2.0), Vector::new(5.0, -3.0, 2.0) + moved], turns)
}

#[test]
fn tangent_is_the_rate_of_the_force() {
    for common in [[0.0; 3], [1.0, -2.0, 0.5], [0.0, 0.0, 3.0]] {
        let (shifts, turns) = far(common);
        let tangent = at(shifts, turns, &Vector12::zeros()).tangent;
        let wanted = differences(shifts, turns);
        let gap = (tangent - wanted).amax() / wanted.amax();
        assert!(gap < 1e-9, "{gap:e}");
        // the test sees the terms of the roll and of turned moments
        assert!((tangent - tangent.transpose()).amax() > 1e-3 * wanted.amax());
    }
}

/// Off equilibrium each moment makes its block lean by half its spin, and nothing else leans.
#[test]
fn only_moments_make_the_tangent_lean() {
    let (shifts, turns) = far([1.0, -2.0, 0.5]);
    let response = at(shifts, turns, &Vector12::zeros());
    let mut lean = (response.tangent - response.tangent.transpose()) * 0.5;
    for row in [3, 9] {
        let spin = Vector::from(response.force.fixed_rows::<3>(row)).cross_matrix();
        let mut block = lean.fixed_view_mut::<3, 3>(row, row);
        block += spin * 0.5;
    }
    assert!(lean.amax() < 1e-12 * response.tangent.amax(), "{:e}", lean.amax());
}

#[test]
fn rates_of_the_rotation_vector() {
    for length in [1e-4, 0.2, 0.499, 0.501, 1.5, 2.8] {
        let theta = Vector::new(0.6, -0.5, 0.62).normalize() * length;
        let moment = Vector::new(0.3, 1.0, -0.7);
        let h = 1e-4;
        let by = |axis: usize, f: &dyn Fn(Vector) -> Vector| {
            let step = |h: f64| Vector::from_fn(|row, _| if row == axis { h } else { 0.0 });
            let once = |h: f64| (f(step(h)) - f(step(-h))) / (2.0 * h);
            (once(h) * 4.0 - once(2.0 * h)) / 3.0
        };
        let spun = |w: Vector| rotation_vector(&(turn(w.into()) * turn(theta.into())));
        let rate = Matrix3::from_columns(&[0, 1, 2].map(|axis| by(axis, &spun)));
        assert!((rate - rate_of_vector(&theta)).amax() < 1e-10, "{length}");
        let turned = |step: Vector| rate_of_vector(&(theta + step)).transpose() * moment;
        let rate = Matrix3::from_columns(&[0, 1, 2].map(|axis| by(axis, &turned)));
        assert!((rate - change_of_moment(&theta, &moment)).amax() < 1e-10, "{length}");
    }
}

proptest! {
    /// A turn of the whole deformed member turns its forces, to rounding.
    #[test]
    fn turning_all_turns_the_forces(
        common in prop::array::uniform3(-3.0..3.0f64),
        local in prop::array::uniform3(-0.5..0.5f64),
        shift in prop::array::uniform3(-0.4..0.4f64),
    ) {
        let whole = turn(common);
        let (first, second) = (Vector::new(0.3, 0.1, -0.2), Vector::new(1.2, 0.7, 0.5));
        let shifts = [Vector::zeros(), Vector::from(shift)];
        let turns = [turn(local), turn([-local[1], local[2], local[0]])];
        let before = bar().response(shifts, turns, 0.7);
        let along = Vector::new(3.0, -4.0, 1.0);
        let moved = [
            whole * (first + shifts[0]) - first + along,
            whole * (second + shifts[1]) - second + along,
        ];
        let after = bar().response(moved, turns.map(|turn| whole * turn), 0.7);
        let gap = after.force - block_turned(&before.force, &whole);
        prop_assert!(gap.amax() < 1e-12 * before.force.amax().max(1.0), "{:e}", gap.amax());
    }

    /// Moved and turned as a whole, the member carries nothing.
    #[test]
    fn turning_alone_costs_nothing(common in prop::array::uniform3(-3.0..3.0f64)) {
        let whole = turn(common);
        let (first, second) = (Vector::new(0.3, 0.1, -0.2), Vector::new(1.2, 0.7, 0.5));
        let shifts = [whole * first - first, whole * second - second];
        let response = bar().response(shifts, [whole; 2], 0.0);
        prop_assert!(response.force.amax() < 1e-12);
    }
}
