//! Buckling against dense matrices, and at a stage of a print.

use nalgebra::{DMatrix, SymmetricEigen};
use proptest::prelude::*;

use super::buckles::parts;
use super::peers::reference;
use super::*;
use crate::structure::assembly::Pattern;
use crate::structure::beam::{beams, turned};
use crate::structure::buckling::critical;
use crate::structure::divided::Standing;
use crate::structure::geometric::under_tension;
use crate::structure::ground::{Tie, ground};
use crate::structure::solve::{active_freedoms, fixed_freedoms, masked, parts as structure_parts};
use crate::structure::strength::Cut;
use crate::structure::{BucklingAsk, BucklingError, buckling, solve};

/// Widest over wanted θ from which on rounding may keep a shape from settling.
const ROUNDED_AWAY: f64 = 1e9;
const DOWN: [f64; 3] = [0.0, 0.0, -9.80665];

/// The same factors from dense matrices, with shear, twist, pulled members and odd supports.
#[test]
fn brute_force_agrees() {
    let reference = reference("f050.json");
    let ribbon = |at: usize| {
        Section::ellipse(3e-3, if at.is_multiple_of(2) { 1e-3 } else { 2e-3 }).sheared(0.8)
    };
    let members = reference.frame.members().iter().enumerate();
    let members = members.map(|(at, m)| Member { section: ribbon(at), side: Vector::x(), ..*m });
    let frame = Frame::new(reference.frame.nodes().to_vec(), members.collect()).unwrap();
    let load = Load { at_nodes: reference.nodal(), ..falling(DOWN) };
    for with_twist in [false, true] {
        let ask = BucklingAsk { modes: 4, with_twist, ..parts(2) };
        let modes = buckling(&frame, &reference.supports, &load, ask).unwrap();
        let wanted = dense(&frame, &reference.supports, &load, 2, with_twist);
        for (mode, wanted) in modes.iter().zip(&wanted) {
            near(mode.factor, *wanted, 1e-9);
        }
    }
}

/// The positive factors, ascending.
fn dense(
    frame: &Frame,
    supports: &[Support],
    load: &Load,
    count: usize,
    with_twist: bool,
) -> Vec<f64> {
    let thetas = dense_thetas(frame, supports, load, count, with_twist);
    let least = 1e-12 * thetas.iter().fold(0.0f64, |most, theta| most.max(theta.abs()));
    thetas.iter().filter(|theta| **theta > least).map(|theta| 1.0 / theta).collect()
}

/// Every member replaced by shorter ones, K and `K_g` as full matrices: all θ, descending.
fn dense_thetas(
    frame: &Frame,
    supports: &[Support],
    load: &Load,
    count: usize,
    with_twist: bool,
) -> Vec<f64> {
    let mut cut = frame.clone();
    for at in 0..frame.members().len() {
        for part in 0..count - 1 {
            let fraction = 1.0 / (count - part) as f64;
            cut = cut.split(at * count + part, fraction).unwrap().0;
        }
    }
    let solution = solve(&cut, supports, load).unwrap();
    let size = 6 * cut.nodes().len();
    let (mut k, mut g) = (DMatrix::zeros(size, size), DMatrix::zeros(size, size));
    for ((member, beam), ends) in cut.members().iter().zip(beams(&cut)).zip(&solution.end_forces) {
        let x = beam.axes.column(0);
        let [first, second] = [0, 6].map(|at| Vector::from_column_slice(&ends[at..at + 3]).dot(&x));
        let unit = turned(&under_tension(member, beam.length_m, with_twist), &beam.axes);
        let geometric = unit * (0.5 * (second - first));
        for (a, b) in (0..12).flat_map(|a| (0..12).map(move |b| (a, b))) {
            let [row, column] = [a, b].map(|at: usize| 6 * member.ends[at / 6] + at % 6);
            k[(row, column)] += beam.stiffness[(a, b)];
            g[(row, column)] -= geometric[(a, b)];
        }
    }
    let held: Vec<usize> = supports.iter().flat_map(|s| (0..6).map(|f| 6 * s.node + f)).collect();
    let (k, g) = (
        k.remove_rows_at(&held).remove_columns_at(&held),
        g.remove_rows_at(&held).remove_columns_at(&held),
    );
    let root = k.cholesky().unwrap().l();
    let half = root.solve_lower_triangular(&g).unwrap();
    let both = root.solve_lower_triangular(&half.transpose()).unwrap();
    let symmetric = (&both + both.transpose()) * 0.5;
    let mut thetas: Vec<f64> = SymmetricEigen::new(symmetric).eigenvalues.iter().copied().collect();
    thetas.sort_by(|a, b| b.total_cmp(a));
    thetas
}

/// A gate pulled up by its corners, pressed a little by its weight elsewhere: the right
/// factor however hard it is pulled, or none rather than a wrong one.
#[test]
fn pulled_much_harder_than_pressed() {
    let nodes = [[0.0, 0.0], [0.0, 0.1], [0.1, 0.1], [0.1, 0.0], [0.05, 0.05]];
    let nodes = nodes.map(|[x, z]| Point::new(x, 0.0, z)).to_vec();
    let members = [[0, 1], [1, 2], [2, 3], [1, 4], [4, 2]].map(rod).to_vec();
    let frame = Frame::new(nodes, members).unwrap();
    let mut refused = 0;
    for power in 2..9 {
        let up = [0.0, 0.0, 10f64.powi(power), 0.0, 0.0, 0.0];
        let at_nodes = [1, 2].map(|node| NodeLoad { node, load: up }).to_vec();
        let load = Load { at_nodes, ..falling([1.0, 0.0, -9.8]) };
        match buckling(&frame, &clamped([0, 3]), &load, parts(2)) {
            Ok(modes) => {
                near(modes[0].factor, dense(&frame, &clamped([0, 3]), &load, 2, false)[0], 1e-5)
            }
            Err(BucklingError::NotConverged { .. }) => refused += 1,
            Err(error) => panic!("{error}"),
        }
    }
    assert!(refused < 5, "{refused}");
}

/// A stage by its own pattern, with aged members and nodes yet unborn, is the frame so far.
#[test]
fn a_stage_is_the_frame_so_far() {
    let reference = reference("f150.json");
    let whole = &reference.frame;
    // printed in some other order: these leave nodes unborn and others floating
    let born = &whole.members()[10..40];
    let ages: Vec<f64> = (0..born.len()).map(|at| 0.4 + 0.02 * at as f64).collect();
    let tie = ground(whole.nodes().len(), born, &reference.supports).tie;
    let held = |member: &Member| member.ends.iter().all(|&node| tie[node] == Tie::Held);
    let aged = born.iter().zip(&ages).filter(|(member, _)| held(member)).map(|(m, age)| Member {
        elastic: Elastic { e_pa: m.elastic.e_pa * age, g_pa: m.elastic.g_pa * age },
        ..*m
    });
    let names: Vec<usize> = (0..tie.len()).filter(|&node| tie[node] == Tie::Held).collect();
    assert!(tie.contains(&Tie::Unborn) && tie.contains(&Tie::Floating));
    let place = |node: usize| names.binary_search(&node).unwrap();
    let part = Frame::new(
        names.iter().map(|&node| whole.nodes()[node]).collect(),
        aged.map(|m| Member { ends: m.ends.map(place), ..m }).collect(),
    )
    .unwrap();
    let supports = reference.supports.iter().filter(|s| tie[s.node] == Tie::Held);
    let supports = clamped(supports.map(|s| place(s.node)));
    let wanted = buckling(&part, &supports, &falling(DOWN), parts(2)).unwrap().remove(0);

    let beams = &beams(whole)[10..40];
    let pattern = Pattern::new(&vec![true; tie.len()], born).unwrap();
    let fixed = fixed_freedoms(tie.len(), &reference.supports);
    let active = active_freedoms(&pattern, &tie, &fixed);
    let values = pattern.assemble(structure_parts(born, beams, &ages), &active);
    let factor = pattern.factor(&values, &active).unwrap();
    let solve_nodes = |forces: &[f64]| {
        let mut u = masked(forces.to_vec(), &active);
        pattern.solve(&factor, &mut u);
        u
    };
    // the forces of the part, none in what floats
    let solution = solve(&part, &supports, &falling(DOWN)).unwrap();
    let mut forces = solution.end_forces.iter();
    let cuts: Vec<Cut> = born
        .iter()
        .zip(beams)
        .map(|(member, beam)| match held(member) {
            true => Cut::new(forces.next().unwrap(), beam.line_load(DOWN)),
            false => Cut::new(&[0.0; 12], Vector::zeros()),
        })
        .collect();
    let of = Standing {
        members: born,
        beams,
        stiffness: &ages,
        cuts: &cuts,
        free: &active,
        solve: &solve_nodes,
    };
    let mode = critical(&of, parts(2)).unwrap().remove(0);
    near(mode.factor, wanted.factor, 1e-9);
    for (node, six) in mode.displacement.iter().enumerate() {
        let moves = six.iter().any(|value| *value != 0.0);
        assert!(!moves || tie[node] == Tie::Held);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Any small frame under any load, mostly pulled or mostly pushed: the dense answer, or an
    /// honest word.
    #[test]
    fn any_frame(
        xyz in prop::collection::vec(-0.1..0.1f64, 15),
        load in prop::collection::vec(-1.0..1.0f64, 12),
        size in -3.0..6.0f64,
        ends in prop::collection::vec((0usize..5, 0usize..5), 0..4),
        count in 1usize..4,
    ) {
        let ends: Vec<(usize, usize)> = ends;
        pressed_or_pulled(&xyz, &load, size, &ends, count)?;
    }
}

/// A frame of five nodes under a load: factors as the dense answer has them, so many and no fewer.
fn pressed_or_pulled(
    xyz: &[f64],
    load: &[f64],
    size: f64,
    ends: &[(usize, usize)],
    count: usize,
) -> Result<(), TestCaseError> {
    let nodes = xyz.chunks_exact(3).map(|p| Point::new(p[0], p[1], p[2])).collect();
    let more = ends.iter().filter(|(a, b)| a != b).map(|&(a, b)| [a, b]);
    let members = [[0, 2], [1, 3], [2, 3], [3, 4]].into_iter().chain(more).map(rod).collect();
    let frame = Frame::new(nodes, members).unwrap();
    let at_nodes = (0..2).map(|k| NodeLoad {
        node: 3 + k,
        load: std::array::from_fn(|f| {
            load[6 * k + f] * 10f64.powf(size) * if f < 3 { 1.0 } else { 0.02 }
        }),
    });
    let load = Load { at_nodes: at_nodes.collect(), ..falling(DOWN) };
    let supports = clamped([0, 1]);
    let wanted = dense(&frame, &supports, &load, count, false);
    match buckling(&frame, &supports, &load, BucklingAsk { modes: 2, ..parts(count) }) {
        Ok(modes) => {
            prop_assert_eq!(modes.len(), wanted.len().min(2));
            for (mode, wanted) in modes.iter().zip(&wanted) {
                prop_assert!((mode.factor / wanted - 1.0).abs() < 1e-6);
                prop_assert!(mode.residual < 1e-5 && mode.solves < 400);
            }
        }
        // pulled so much harder that rounding, 1e-15 of the widest θ, is more than the 1e-5 of the
        // one looked for that a shape may be off
        Err(BucklingError::NotConverged { .. }) => {
            let thetas = dense_thetas(&frame, &supports, &load, count, false);
            let widest = thetas.iter().fold(0.0f64, |most, theta| most.max(theta.abs()));
            let least = wanted.iter().take(2).fold(f64::INFINITY, |least, f| least.min(1.0 / f));
            prop_assert!(widest > ROUNDED_AWAY * least, "{:e} against {:e}", least, widest);
        }
        Err(error) => prop_assert!(false, "{}", error),
    }
    Ok(())
}

/// Pulled 20 000 times harder than pressed, and the second factor 330 times the first: what the first
/// shape lacks in accuracy must not be held against the second.
#[test]
fn a_far_second_factor() {
    let xyz = [
        0.09614455995761625,
        0.0,
        0.0,
        -0.0964763742705326,
        -0.08707344854815798,
        0.0,
        0.0,
        -0.036545405219884496,
        -0.06738488395566967,
        -0.05659503362508939,
        0.04807205490525197,
        -0.004221582247711419,
        0.0359283822693058,
        -0.08097729348105423,
        -0.09797177600364763,
    ];
    let load = [
        0.19912634695198564,
        0.7073552206204913,
        -0.30637301202016815,
        0.0,
        0.0,
        0.0,
        -0.30955758882876605,
        0.32939071872461456,
        0.18001996272269305,
        0.0,
        0.0,
        0.955301977891709,
    ];
    pressed_or_pulled(&xyz, &load, -2.446470615802451, &[(1, 2)], 1).unwrap();
}
