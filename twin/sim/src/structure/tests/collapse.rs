//! Lower bounds of collapse loads beside exact ones: never above, and how far below.

use proptest::prelude::*;

use super::*;
use crate::structure::{Collapse, Strength, plastic_bound};

pub(super) const YIELD_PA: f64 = 40e6;
pub(super) const EQUAL: Strength = Strength { tension_pa: YIELD_PA, compression_pa: YIELD_PA };
/// Diameter of the rods, m.
const ROD_M: f64 = 2e-3;

/// Full plastic moment of the rod, N m.
fn full_moment() -> f64 {
    ROD_M.powi(3) / 6.0 * YIELD_PA
}

/// Full plastic axial force of the rod, N.
fn full_axial() -> f64 {
    Section::circle(ROD_M).area_m2 * YIELD_PA
}

fn bound(frame: &Frame, supports: &[Support], growing: &Load) -> Collapse {
    let strengths = vec![EQUAL; frame.members().len()];
    plastic_bound(frame, supports, &strengths, &Load::default(), growing).unwrap()
}

#[track_caller]
fn just_below(got: &Collapse, exact: f64, short: f64) {
    println!("{got:?}: {:.5} of {exact}", got.bound / exact);
    assert!(got.bound <= exact * (1.0 + 1e-9), "{got:?} is above {exact}");
    assert!(got.bound >= exact * (1.0 - short), "{got:?} is far below {exact}");
    assert!(got.reserve() >= 1.0);
}

fn bars(nodes: &[[f64; 3]], members: &[[usize; 2]]) -> Frame {
    let nodes = nodes.iter().map(|&at| Point::from(at)).collect();
    Frame::new(nodes, members.iter().map(|&ends| rod(ends)).collect()).unwrap()
}

const DOWN: [f64; 6] = [0.0, 0.0, -1.0, 0.0, 0.0, 0.0];

/// `P = 8 Mp/L`; the elastic moments are already equal, so it is the shape factor `16/(3π)` alone.
#[test]
fn fixed_at_both_ends_pushed_in_the_middle() {
    let frame = chain(Vector::x(), 0.2, 2);
    let got = bound(&frame, &clamped([0, 2]), &pushed(1, DOWN));
    just_below(&got, 8.0 * full_moment() / 0.2, 1e-9);
    near(got.reserve(), 16.0 / (3.0 * std::f64::consts::PI), 1e-9);
}

/// `P = 9 Mp/L` at a third of a beam fixed at both ends: `2 Mp L/(a b)`.
#[test]
fn fixed_at_both_ends_pushed_off_the_middle() {
    let frame = chain(Vector::x(), 0.3, 3);
    let got = bound(&frame, &clamped([0, 3]), &pushed(1, DOWN));
    just_below(&got, 2.0 * full_moment() * 0.3 / (0.1 * 0.2), 0.02);
}

/// `q = 16 Mp/L²` under its own weight.
#[test]
fn fixed_at_both_ends_under_weight() {
    let frame = chain(Vector::x(), 0.2, 4);
    let got = bound(&frame, &clamped([0, 4]), &falling([0.0, 0.0, -1.0]));
    let line = 1240.0 * Section::circle(ROD_M).area_m2;
    just_below(&got, 16.0 * full_moment() / 0.04 / line, 0.03);
}

/// `P = 6 Mp/L` on a beam fixed at one end, hinged at the other, pushed in the middle.
#[test]
fn propped_cantilever() {
    let frame = chain(Vector::x(), 0.2, 2);
    let prop = Support { node: 2, fixed: [false, true, true, true, false, false] };
    let got = bound(&frame, &[Support::clamped(0), prop], &pushed(1, DOWN));
    just_below(&got, 6.0 * full_moment() / 0.2, 0.02);
    let elastic = 16.0 / 3.0 / 0.2 * full_moment() * 3.0 * std::f64::consts::PI / 16.0;
    near(got.first_yield, elastic, 1e-9);
}

/// Portal, feet fixed: the least of beam `V L/2 = 4 Mp`, sway `H h = 4 Mp` and both
/// `H h + V L/2 = 6 Mp`.
#[test]
fn portal_frame() {
    let (height, length) = (0.2, 0.3);
    let nodes = [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, height],
        [length / 2.0, 0.0, height],
        [length, 0.0, height],
        [length, 0.0, 0.0],
    ];
    let frame = bars(&nodes, &[[0, 1], [1, 2], [2, 3], [3, 4]]);
    for (side, down) in [(0.0, 1.0), (1.0, 0.0), (1.0, 1.0), (1.0, 2.0), (1.0, 0.5)] {
        let load = Load {
            at_nodes: vec![
                NodeLoad { node: 1, load: [side, 0.0, 0.0, 0.0, 0.0, 0.0] },
                NodeLoad { node: 2, load: [0.0, 0.0, -down, 0.0, 0.0, 0.0] },
            ],
            ..Load::default()
        };
        let got = bound(&frame, &clamped([0, 4]), &load);
        let m = full_moment();
        let (sway, sag) = (side * height, down * length / 2.0);
        let exact = (4.0 * m / sway).min(4.0 * m / sag).min(6.0 * m / (sway + sag));
        just_below(&got, exact, 0.03);
    }
}

/// Frames of cells 0.3 m by 0.21 m, exact by a linear program over all moments in balance (HiGHS, run
/// outside): four by two cells on hinge and roller, pushed in the middle of the top, `10 Mp/w`; on
/// clamped feet, pushed sideways at both floors, `7.142857 Mp/w`.
#[test]
fn frames_of_many_cells() {
    let (wide, high) = (0.3, 0.21);
    let id = |i: usize, j: usize| 3 * i + j;
    let places = (0..5).flat_map(|i| (0..3).map(move |j| (i as f64, j as f64)));
    let nodes: Vec<[f64; 3]> = places.map(|(i, j)| [i * wide, 0.0, j * high]).collect();
    let along = (0..4).flat_map(|i| (0..3).map(move |j| [id(i, j), id(i + 1, j)]));
    let upright = (0..5).flat_map(|i| (0..2).map(move |j| [id(i, j), id(i, j + 1)]));
    let frame = bars(&nodes, &along.chain(upright).collect::<Vec<_>>());
    let in_plane = [false, true, false, true, false, true];
    let plane = (0..15).map(|node| Support { node, fixed: in_plane });
    let unit = full_moment() / wide;

    let hinge = Support { node: id(0, 0), fixed: [true, false, true, false, false, false] };
    let roller = Support { node: id(4, 0), fixed: [false, false, true, false, false, false] };
    let held: Vec<Support> = plane.clone().chain([hinge, roller]).collect();
    just_below(&bound(&frame, &held, &pushed(id(2, 2), DOWN)), 10.0 * unit, 0.03);

    let held: Vec<Support> = plane.chain(clamped((0..5).map(|i| id(i, 0)))).collect();
    let side = |node| NodeLoad { node, load: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0] };
    let load = Load { at_nodes: vec![side(id(0, 1)), side(id(0, 2))], ..Load::default() };
    just_below(&bound(&frame, &held, &load), 50.0 / 7.0 * unit, 0.03);
}

/// Three bars from a ceiling to one node, the outer ones at 45°: `P = Np (1 + √2)`; the elastic
/// frame yields at `Np (1 + √2/2)`. Rigid joints add what bending hinges of the outer bars take.
#[test]
fn three_bars() {
    let frame = bars(
        &[[0.0; 3], [0.0, 0.0, 0.5], [0.5, 0.0, 0.5], [-0.5, 0.0, 0.5]],
        &[[0, 1], [0, 2], [0, 3]],
    );
    let got = bound(&frame, &clamped([1, 2, 3]), &pushed(0, DOWN));
    let hinges = 2.0 * 2.0 * full_moment() * 0.5f64.sqrt() / 0.5f64.hypot(0.5);
    just_below(&got, full_axial() * (1.0 + 2f64.sqrt()) + hinges, 0.01);
    near(got.first_yield, full_axial() * (1.0 + 0.5f64.sqrt()), 0.01);
}

/// A bar pulled and bent by an arm at its end: the curve `n = (2/π)(θ + sin θ cos θ)`, `m = cos³ θ`.
#[test]
fn pulled_and_bent() {
    let frame = chain(Vector::x(), 0.1, 1);
    for theta in [0.2f64, 0.7, 1.2] {
        let n = 2.0 / std::f64::consts::PI * (theta + theta.sin() * theta.cos());
        let m = theta.cos().powi(3);
        let load = [n * full_axial(), 0.0, 0.0, 0.0, m * full_moment(), 0.0];
        just_below(&bound(&frame, &clamped([0]), &pushed(1, load)), 1.0, 1e-5);
    }
    // torque alone: 2/3 π r³ f/√3
    let full = 2.0 / 3.0 * std::f64::consts::PI * 1e-9 * YIELD_PA / 3f64.sqrt();
    let load = [0.0, 0.0, 0.0, full, 0.0, 0.0];
    just_below(&bound(&frame, &clamped([0]), &pushed(1, load)), 1.0, 1e-9);
    // stronger in compression: a column of strips, tension 40, compression 60: mean 50
    let strong = Strength { compression_pa: 1.5 * YIELD_PA, ..EQUAL };
    let bent = pushed(1, [0.0, 0.0, 0.0, 0.0, full_moment(), 0.0]);
    let push = pushed(1, [-full_axial(), 0.0, 0.0, 0.0, 0.0, 0.0]);
    let of = |load| {
        plastic_bound(&frame, &clamped([0]), &[strong], &Load::default(), load).unwrap().bound
    };
    near(of(&push), 1.5, 1e-9);
    // no axial force: n = 0.2 of the mean
    assert!(of(&bent) < 1.25 && of(&bent) > 1.15, "{}", of(&bent));
}

/// What lasts takes its part: the middle load of the fixed beam, and the rest on top of it.
#[test]
fn lasting_load_takes_its_part() {
    let frame = chain(Vector::x(), 0.2, 2);
    let held = clamped([0, 2]);
    let whole = 8.0 * full_moment() / 0.2;
    let lasting = pushed(1, DOWN.map(|x| 0.25 * whole * x));
    let of = |lasting: &Load| {
        plastic_bound(&frame, &held, &[EQUAL; 2], lasting, &pushed(1, DOWN)).unwrap()
    };
    near(of(&lasting).bound, 0.75 * whole, 1e-9);
    assert_eq!(of(&pushed(1, DOWN.map(|x| 2.0 * whole * x))).bound, 0.0);
    // self-stress brings the first yield on early, not the collapse
    let mut rods: Vec<Member> = frame.members().to_vec();
    rods[0].initial_strain = -0.008;
    rods[1].initial_strain = -0.008;
    let shrunk = Frame::new(frame.nodes().to_vec(), rods).unwrap();
    let pull = Load { with_initial_strain: true, ..Load::default() };
    let got = plastic_bound(&shrunk, &held, &[EQUAL; 2], &pull, &pushed(1, DOWN)).unwrap();
    near(got.bound, whole, 1e-6);
    assert!(got.first_yield < 0.4 * whole, "{got:?}");
}

#[test]
fn nonsense_is_refused() {
    let frame = chain(Vector::x(), 0.2, 2);
    let none = Load::default();
    let of = |strengths: &[Strength], supports: &[Support], load: &Load| {
        plastic_bound(&frame, supports, strengths, &none, load)
    };
    assert!(of(&[EQUAL; 1], &clamped([0]), &none).is_err());
    assert!(of(&[EQUAL; 2], &[], &none).is_err());
    assert!(of(&[EQUAL; 2], &clamped([9]), &none).is_err());
    assert!(of(&[EQUAL; 2], &clamped([0]), &pushed(7, DOWN)).is_err());
    // nothing grows: no limit, no reserve
    let got = of(&[EQUAL; 2], &clamped([0]), &none).unwrap();
    assert_eq!((got.bound, got.reserve()), (f64::INFINITY, 1.0));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// One node on bars to clamped ends: moved alone, without turning, it costs every bar its full
    /// axial force times the stretch and two hinges. No bound is above that.
    #[test]
    fn never_above_a_mechanism(
        ends in prop::collection::vec(prop::array::uniform3(-0.1..0.1f64), 2..6),
        force in prop::array::uniform3(-1.0..1.0f64),
        moved in prop::array::uniform3(-1.0..1.0f64),
    ) {
        let far = |at: &[f64; 3]| Vector::from(*at).norm() > 0.01;
        prop_assume!(ends.iter().all(far));
        let nodes: Vec<[f64; 3]> =
            std::iter::once([0.0; 3]).chain(ends.iter().copied()).collect();
        let members: Vec<[usize; 2]> = (1..nodes.len()).map(|end| [0, end]).collect();
        let frame = bars(&nodes, &members);
        let (push, moved) = (Vector::from(force), Vector::from(moved));
        let work = push.dot(&moved);
        prop_assume!(work.abs() > 0.05);
        let cost = |end: &[f64; 3]| {
            let bar = Vector::from(*end);
            let along = moved.dot(&bar.normalize());
            let across = (moved.norm_squared() - along * along).max(0.0).sqrt();
            full_axial() * along.abs() + 2.0 * full_moment() * across / bar.norm()
        };
        let above = ends.iter().map(cost).sum::<f64>() / work.abs();
        let load = pushed(0, [force[0], force[1], force[2], 0.0, 0.0, 0.0]);
        let got = bound(&frame, &clamped(1..nodes.len()), &load);
        prop_assert!(got.bound <= above * (1.0 + 1e-9), "{got:?} is above {above}");
        prop_assert!(got.bound >= got.first_yield);
    }

    #[test]
    fn any_input_is_answered(
        numbers in prop::array::uniform6(any::<f64>()),
        strengths in prop::array::uniform2(any::<f64>()),
        lasting in any::<f64>(),
    ) {
        let frame = bars(&[[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]], &[[0, 1], [1, 2]]);
        let [tension_pa, compression_pa] = strengths;
        let strength = Strength { tension_pa, compression_pa };
        let last = Load { gravity_m_s2: [lasting, 0.0, 1.0], ..Load::default() };
        for strengths in [[EQUAL; 2], [strength; 2]] {
            let held = clamped([0, 2]);
            let got = plastic_bound(&frame, &held, &strengths, &last, &pushed(1, numbers));
            if let Ok(got) = got {
                prop_assert!(got.bound >= got.first_yield, "{got:?}");
            }
        }
    }
}
