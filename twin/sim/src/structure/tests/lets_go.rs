//! Supports that let go, against every other way it could be: all sets, all orders, all axes.

use nalgebra::{DMatrix, DVector, Rotation3, Unit};
use proptest::prelude::*;

use super::grows::Chance;
use super::one_sided::{DOWN, balance, force, hold, holding, run, stage, staged};
use super::*;
use crate::structure::complementary::{complementary, one_by_one};
use crate::structure::{Hold, Stage};

/// A tower on `feet` feet in a ring, of which the last is clamped for good, and holds of the others.
fn tower(
    chance: &mut Chance,
    feet: usize,
    normals: impl Fn(&mut Chance) -> Vector,
) -> (Frame, Vec<Hold>) {
    let mut nodes: Vec<Point> = (0..feet)
        .map(|k| {
            let angle = std::f64::consts::TAU * (k as f64 + 0.5 * chance.next()) / feet as f64;
            Point::new(0.03 * angle.cos(), 0.03 * angle.sin(), 0.0)
        })
        .collect();
    nodes.push(Point::new(0.0, 0.0, 0.03 + 0.02 * chance.next()));
    let rods = (0..feet).map(|k| rod([k, feet])).chain((1..feet).map(|k| rod([k - 1, k])));
    let frame = Frame::new(nodes, rods.collect()).unwrap();
    let holds =
        (0..feet - 1).map(|node| hold(node, normals(chance), 0.4 * chance.next())).collect();
    (frame, holds)
}

fn pushed_about(chance: &mut Chance, feet: usize) -> Vec<NodeLoad> {
    let any = |chance: &mut Chance| Vector::from_fn(|_, _| 4.0 * chance.next() - 2.0);
    (0..=feet).map(|node| force(node, any(chance))).collect()
}

/// All 2ⁿ sets of feet that press, each solved as a frame of its own with those feet held up and
/// down: exactly one neither pulls nor sinks in, and it is ours.
#[test]
fn brute_force_finds_the_same_feet() {
    let mut chance = Chance(5);
    for trial in 0..20 {
        let feet = 3 + trial % 5;
        let (frame, holds) = tower(&mut chance, feet, |_| Vector::z());
        let supports = clamped(0..feet);
        let all = frame.members().len();
        let mut torn = stage(all, &supports, [0.0; 3]);
        torn.at_nodes = (0..feet - 1).map(|node| force(node, Vector::z() * 100.0)).collect();
        let mut loaded = stage(all, &supports, DOWN);
        loaded.at_nodes = pushed_about(&mut chance, feet);
        let records = run(&frame, &[torn, loaded.clone()], &holds);
        assert_eq!(holding(&records[0]).let_go.len(), feet - 1);
        let load =
            Load { gravity_m_s2: DOWN, at_nodes: loaded.at_nodes.clone(), ..Load::default() };
        let mut found = Vec::new();
        for set in 0..1usize << (feet - 1) {
            let presses = |node: usize| set >> node & 1 == 1;
            let up_down = [false, false, true, false, false, false];
            let mut held = vec![Support::clamped(feet - 1)];
            held.extend(
                (0..feet - 1).filter(|&k| presses(k)).map(|node| Support { node, fixed: up_down }),
            );
            let solution = crate::structure::solve(&frame, &held, &load).unwrap();
            let pulls = solution.reactions[1..].iter().any(|r| r[2] < 0.0);
            let sinks = (0..feet - 1).any(|k| !presses(k) && solution.displacement[k][2] < 0.0);
            if !pulls && !sinks {
                found.push(solution);
            }
        }
        assert_eq!(found.len(), 1);
        // it was torn off and put back, so staged stands where one-shot does
        for state in [staged(&records[1]), records[1].one_shot.as_ref().unwrap()] {
            assert!(
                block_gap(&state.displacement.concat(), &found[0].displacement.concat()) < 1e-8
            );
        }
        assert!(balance(&frame, &loaded, &records[1]) < 1e-9);
    }
}

/// `W λ + q` against all 2ⁿ sets, n up to 6, and larger ones against the three conditions.
#[test]
fn forces_of_contacts_are_the_only_ones() {
    let mut chance = Chance(9);
    for trial in 0..200 {
        let n = if trial < 150 { 1 + trial % 6 } else { 40 };
        let a = DMatrix::from_fn(n, n, |_, _| chance.next() - 0.5);
        let w = &a * a.transpose() + DMatrix::identity(n, n) * 0.01;
        let q: Vec<f64> = (0..n).map(|_| chance.next() - 0.6).collect();
        let start: Vec<bool> = (0..n).map(|_| chance.next() < 0.5).collect();
        let got = complementary(&w, &q, &start);
        assert!(got.is_settled);
        let one = one_by_one(&w, &q).unwrap();
        assert!(got.force_n.iter().zip(&one).all(|(a, b)| (a - b).abs() < 1e-7 * (1.0 + a)));
        let gap = &w * DVector::from_row_slice(&got.force_n) + DVector::from_row_slice(&q);
        for (force, gap) in got.force_n.iter().zip(gap.iter()) {
            assert!(*force >= 0.0 && *gap > -1e-9 && force * gap < 1e-8);
        }
        let start = vec![false; n];
        let other = complementary(&w, &q, &start).force_n;
        assert!(got.force_n.iter().zip(&other).all(|(a, b)| (a - b).abs() < 1e-7 * (1.0 + a)));
        let sets = if n <= 6 { 0..1usize << n } else { 0..0 };
        let fits = sets.filter(|set| {
            let of: Vec<usize> = (0..n).filter(|i| set >> i & 1 == 1).collect();
            let part = DMatrix::from_fn(of.len(), of.len(), |i, j| w[(of[i], of[j])]);
            let right = DVector::from_fn(of.len(), |i, _| -q[of[i]]);
            let found = if of.is_empty() { right } else { part.lu().solve(&right).unwrap() };
            let mut force = DVector::zeros(n);
            of.iter().zip(found.iter()).for_each(|(&i, f)| force[i] = *f);
            let gap = &w * &force + DVector::from_row_slice(&q);
            let ours =
                force.iter().zip(&got.force_n).all(|(a, b)| (a - b).abs() < 1e-8 * (1.0 + b));
            force.iter().all(|f| *f >= 0.0) && gap.iter().all(|g| *g >= -1e-12) && ours
        });
        assert!(n > 6 || fits.count() == 1);
    }
}

/// A matrix that is none of a frame is told and does not go round for ever.
#[test]
fn contacts_without_answer_are_told() {
    let w = DMatrix::from_row_slice(2, 2, &[-1.0, 0.0, 0.0, -1.0]);
    assert!(!complementary(&w, &[-1.0, -1.0], &[true, true]).is_settled);
    let w = DMatrix::from_row_slice(2, 2, &[f64::NAN; 4]);
    assert!(!complementary(&w, &[-1.0, -1.0], &[false, false]).is_settled);
}

/// The whole story (torn off by a load, weight, pushes) with supports and holds in another order, and
/// with all of it turned: the same feet let go and rest, the answer turns with the frame.
#[test]
fn neither_order_nor_axes_matter() {
    let mut chance = Chance(21);
    let mut went = 0;
    for _ in 0..12 {
        let feet = 6;
        let lean = |chance: &mut Chance| {
            Vector::new(chance.next() - 0.5, chance.next() - 0.5, 1.0).normalize()
        };
        let (frame, holds) = tower(&mut chance, feet, lean);
        let all = frame.members().len();
        let loads: Vec<Vec<NodeLoad>> = (0..4).map(|_| pushed_about(&mut chance, feet)).collect();
        let about = |turn: &Rotation3<f64>, backwards: bool| {
            let nodes = frame.nodes().iter().map(|node| turn * node).collect();
            let turned = Frame::new(nodes, frame.members().to_vec()).unwrap();
            let g = turn * Vector::from(DOWN);
            let mut supports = clamped(0..feet);
            let mut holds: Vec<Hold> =
                holds.iter().map(|it| Hold { normal: turn * it.normal, ..*it }).collect();
            if backwards {
                supports.reverse();
                holds.reverse();
            }
            let stages: Vec<Stage> = loads
                .iter()
                .map(|loads| {
                    let mut it = stage(all, &supports, g.into());
                    let of = |load: &NodeLoad| {
                        force(load.node, turn * Vector::from_column_slice(&load.load[..3]))
                    };
                    it.at_nodes = loads.iter().map(of).collect();
                    it
                })
                .collect();
            let records = run(&turned, &stages, &holds);
            for (stage, record) in stages.iter().zip(&records) {
                assert!(holding(record).is_settled && balance(&turned, stage, record) < 1e-8);
            }
            records
        };
        let axis = Unit::new_normalize(Vector::new(1.0, -0.4, 0.7));
        let (none, turn) = (Rotation3::identity(), Rotation3::from_axis_angle(&axis, 1.1));
        let plain = about(&none, false);
        went += plain.iter().map(|record| holding(record).let_go.len()).sum::<usize>();
        for (turn, backwards) in [(none, true), (turn, false)] {
            for (plain, other) in plain.iter().zip(about(&turn, backwards)) {
                assert_eq!(holding(plain).let_go, holding(&other).let_go);
                assert_eq!(holding(plain).resting, holding(&other).resting);
                let back = |six: &[f64; 6]| {
                    let part = |from: usize| {
                        turn.inverse() * Vector::from_column_slice(&six[from..from + 3])
                    };
                    [part(0), part(3)].map(<[f64; 3]>::from).concat()
                };
                let (a, b) = (&staged(plain).displacement, &staged(&other).displacement);
                let turned: Vec<f64> = b.iter().flat_map(back).collect();
                assert!(block_gap(&turned, &a.concat()) < 1e-7);
            }
        }
    }
    assert!(went > 20, "{went} let go: too few to show anything");
}

/// A load all at once lets go of the same feet as one that grows by a thousandth at a time.
#[test]
fn all_at_once_is_as_if_it_had_grown() {
    let mut chance = Chance(33);
    let mut went = 0;
    for trial in 0..10 {
        let feet = 4 + trial % 4;
        let (frame, holds) = tower(&mut chance, feet, |_| Vector::z());
        let (all, supports) = (frame.members().len(), clamped(0..feet));
        let up = 3.0 * chance.next();
        let loaded = |share: f64| {
            let mut it = stage(all, &supports, [0.0; 3]);
            it.at_nodes = vec![force(feet, Vector::new(0.3, -0.2, 1.0) * (up * share))];
            it
        };
        let once = run(&frame, &[loaded(1.0)], &holds);
        let steps: Vec<Stage> = (1..=1000).map(|k| loaded(f64::from(k) / 1000.0)).collect();
        let slowly = run(&frame, &steps, &holds);
        let order: Vec<usize> =
            slowly.iter().flat_map(|record| holding(record).let_go.clone()).collect();
        assert_eq!(holding(&once[0]).let_go, order);
        let (a, b) = (&staged(&once[0]).displacement, &staged(&slowly[999]).displacement);
        assert!(block_gap(&a.concat(), &b.concat()) < 1e-8);
        went += order.len();
    }
    assert!(went > 5, "{went}");
}

/// A piece all of whose supports have let go floats, and is named; nothing else does.
#[test]
fn a_piece_that_is_torn_off_floats() {
    let nodes = [0.0, 0.02, 0.1, 0.12].map(|x| Point::new(x, 0.0, 0.0)).to_vec();
    let frame = Frame::new(nodes, vec![rod([0, 1]), rod([2, 3])]).unwrap();
    let mut up = stage(2, &clamped([0, 2, 3]), DOWN);
    up.at_nodes = vec![force(3, Vector::z())];
    let holds = [2, 3].map(|node| hold(node, Vector::z(), 0.1));
    let records = run(&frame, &[up.clone(), stage(2, &clamped([0, 2, 3]), DOWN)], &holds);
    assert_eq!(holding(&records[0]).let_go, [3, 2]);
    assert_eq!((&records[0].floats, &records[1].floats), (&vec![2], &vec![2]));
    assert!(staged(&records[1]).reactions[0][2] > 0.0);
    // what is left on the ground is as without the other piece
    let alone = run(&frame, &[stage(1, &clamped([0]), DOWN)], &[]);
    assert_eq!(staged(&alone[0]).displacement[1], staged(&records[1]).displacement[1]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Any frame, any holds, any supports: no panic, bounded rounds, and where it says it is settled
    /// the conditions hold.
    #[test]
    fn any_frame_comes_to_an_end(
        coordinates in proptest::collection::vec(-0.05f64..0.05, 24),
        pairs in proptest::collection::vec((0usize..8, 0usize..8), 1..14),
        holds in proptest::collection::vec((0usize..8, -1.0f64..1.0, -1.0f64..1.0, 0.0f64..2.0), 0..10),
        loads in proptest::collection::vec((0usize..8, -5.0f64..5.0), 0..8),
        free_turns in proptest::bool::ANY,
    ) {
        let nodes = coordinates.chunks_exact(3).map(|c| Point::new(c[0], c[1], c[2])).collect();
        let apart = pairs.iter().filter(|(a, b)| a != b);
        let members: Vec<Member> = apart.map(|&(a, b)| Member { initial_strain: -0.003, ..rod([a, b]) }).collect();
        let Ok(frame) = Frame::new(nodes, members) else { return Ok(()) };
        let all = frame.members().len();
        let support = if free_turns { Support::pinned } else { Support::clamped };
        let supports: Vec<Support> = (0..5).map(support).collect();
        let normal = |x: f64, y: f64| Vector::new(x, y, 1.0).normalize();
        let holds: Vec<Hold> = holds.iter().map(|&(node, x, y, pull)| Hold { from: node % 3, ..hold(node, normal(x, y), pull) }).collect();
        let stages: Vec<Stage> = [all.div_ceil(2), all, all].into_iter().enumerate().map(|(k, born)| {
            let supports = &supports[k / 2..];
            Stage { at_nodes: loads.iter().map(|&(node, f)| force(node, Vector::z() * f * k as f64)).collect(), ..stage(born, supports, DOWN) }
        }).collect();
        for (stage, record) in stages.iter().zip(run(&frame, &stages, &holds)) {
            let Some(held) = &record.holding else { continue };
            prop_assert!(held.rounds <= 64);
            prop_assert!(held.let_go.len() <= 5);
            prop_assert_eq!(record.staged.as_ref().map(|s| s.reactions.len()), record.staged.as_ref().map(|_| stage.supports.len()));
            for node in &held.resting {
                prop_assert!(stage.supports.iter().any(|support| support.node == *node));
            }
        }
    }
}
