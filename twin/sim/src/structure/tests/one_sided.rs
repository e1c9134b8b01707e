//! Supports that let go: what lifts, what rests, and that it does not depend on who is asked first.

use nalgebra::{DMatrix, DVector, Rotation3, Unit};
use proptest::prelude::*;

use super::grows::Chance;
use super::*;
use crate::structure::complementary::{complementary, one_by_one};
use crate::structure::{
    Ask, Hold, Holding, Stage, StageRecord, StageState, solve_held, solve_held_stages, solve_stages,
};

const DOWN: [f64; 3] = [0.0, 0.0, -9.80665];

pub(super) fn stage(born: usize, supports: &[Support], gravity_m_s2: [f64; 3]) -> Stage {
    let supports = supports.to_vec();
    Stage { born, supports, gravity_m_s2, at_nodes: Vec::new(), stiffness: Vec::new() }
}

fn hold(node: usize, normal: Vector, pull_n: f64) -> Hold {
    Hold { node, normal, pull_n, from: 0, until: usize::MAX }
}

fn force(node: usize, f: Vector) -> NodeLoad {
    NodeLoad { node, load: [f.x, f.y, f.z, 0.0, 0.0, 0.0] }
}

/// Every stage kept.
fn run(frame: &Frame, stages: &[Stage], holds: &[Hold]) -> Vec<StageRecord> {
    let keep: Vec<usize> = (0..stages.len()).collect();
    let ask = Ask { staged: true, keep: &keep, ..Ask::default() };
    solve_held_stages(frame, stages, holds, ask).unwrap()
}

fn staged(record: &StageRecord) -> &StageState {
    record.staged.as_ref().unwrap()
}

fn holding(record: &StageRecord) -> &Holding {
    record.holding.as_ref().unwrap()
}

/// Forces and moments (about the origin) of supports, weight and loads together, over the sum of their
/// sizes and of what shrinkage may pull; the worse of both answers.
pub(super) fn balance(frame: &Frame, stage: &Stage, record: &StageRecord) -> f64 {
    let states = [record.one_shot.as_ref(), record.staged.as_ref()];
    let of = |state: &StageState| {
        let (mut sum, mut size, mut strain_n) = ([0.0; 6], 0.0f64, 0.0);
        let mut add = |at: Point, f: Vector, m: Vector| {
            let m = m + at.coords.cross(&f);
            for axis in 0..3 {
                sum[axis] += f[axis];
                // a metre is far for these frames: forces and moments of one size
                sum[3 + axis] += m[axis];
            }
            size += f.norm() + m.norm();
        };
        for member in &frame.members()[..stage.born] {
            let [a, b] = member.ends.map(|node| frame.nodes()[node]);
            let kg = member.density_kg_m3 * member.section.area_m2 * (b - a).norm();
            strain_n += member.elastic.e_pa * member.section.area_m2 * member.initial_strain.abs();
            add(nalgebra::center(&a, &b), Vector::from(stage.gravity_m_s2) * kg, Vector::zeros());
        }
        let loads = stage.at_nodes.iter().map(|load| (load.node, load.load));
        let supports =
            stage.supports.iter().map(|support| support.node).zip(state.reactions.clone());
        for (node, six) in loads.chain(supports) {
            add(
                frame.nodes()[node],
                Vector::from_column_slice(&six[..3]),
                Vector::from_column_slice(&six[3..]),
            );
        }
        sum.iter().fold(0.0f64, |most, s| most.max(s.abs()))
            / (size + strain_n).max(f64::MIN_POSITIVE)
    };
    states.into_iter().flatten().map(of).fold(0.0, f64::max)
}

/// A weightless beam of two nodes, one clamped: all that pulls at the other goes into its support.
#[test]
fn what_pulls_as_hard_as_it_is_held_lets_go() {
    let frame = chain(Vector::x(), 0.05, 1);
    let mut pulled = stage(1, &clamped([0, 1]), [0.0; 3]);
    let (up, held_n) = (Vector::z(), 1.3);
    pulled.at_nodes = vec![force(1, up * held_n)];
    for (pull_n, goes) in [(held_n, true), (held_n.next_up(), false), (held_n * 0.9, true)] {
        let record = &run(&frame, &[pulled.clone()], &[hold(1, up, pull_n)])[0];
        assert_eq!(holding(record).let_go.len(), usize::from(goes), "{pull_n}");
        assert_eq!(holding(record).worst.unwrap().pull_n, held_n);
        assert!(holding(record).is_settled && balance(&frame, &pulled, record) < 1e-12);
        let moved = Vector::from_column_slice(&staged(record).displacement[1][..3]);
        assert_eq!(moved.norm() > 0.0, goes);
    }
    // pressed, it holds without adhesion
    pulled.at_nodes = vec![force(1, -up)];
    let record = &run(&frame, &[pulled], &[hold(1, up, 0.0)])[0];
    assert!(holding(record).let_go.is_empty());
}

/// The plain form for one frame is a print of one stage; shrinkage only where it is asked for.
#[test]
fn one_frame_by_itself() {
    let frame = Frame::new(
        vec![Point::origin(), Point::new(0.0, 0.0, 0.04)],
        vec![Member { initial_strain: -0.001, ..rod([0, 1]) }],
    )
    .unwrap();
    let supports = clamped([0, 1]);
    let pull_n = 0.001 * 3.5e9 * rod([0, 1]).section.area_m2;
    for (with_initial_strain, held_n, goes) in
        [(true, 1.01, false), (true, 0.99, true), (false, 0.99, false)]
    {
        let load = Load { with_initial_strain, ..Load::default() };
        let holds = [hold(0, Vector::z(), held_n * pull_n)];
        let record = solve_held(&frame, &supports, &holds, &load).unwrap();
        assert_eq!(holding(&record).let_go, if goes { vec![0] } else { vec![] });
        let wanted = if with_initial_strain { pull_n } else { 0.0 };
        assert!((holding(&record).worst.unwrap().pull_n - wanted).abs() < 1e-12 * pull_n);
        if goes {
            near(staged(&record).displacement[0][2], 4e-5, 1e-12);
        }
    }
    assert!(solve_held(&frame, &supports, &[hold(2, Vector::z(), 1.0)], &Load::default()).is_err());
    assert!(
        solve_held(&frame, &supports, &[hold(0, Vector::zeros(), 1.0)], &Load::default()).is_err()
    );
}

/// With holds that cannot lift the answers are, to the bit, those without holds.
#[test]
fn unlimited_adhesion_changes_nothing() {
    let (frame, supports) = super::grows::grown(60, 3);
    let stages: Vec<Stage> = (1..=60).map(|born| stage(born, &supports, DOWN)).collect();
    let holds: Vec<Hold> =
        supports.iter().map(|it| hold(it.node, Vector::z(), f64::INFINITY)).collect();
    let ask = Ask { staged: true, ..Ask::default() };
    let plain = solve_stages(&frame, &stages, ask).unwrap();
    let held = solve_held_stages(&frame, &stages, &holds, ask).unwrap();
    for (plain, held) in plain.into_iter().zip(held) {
        assert!(plain.holding.is_none() && holding(&held).let_go.is_empty());
        assert_eq!(plain, StageRecord { holding: None, ..held });
    }
}

/// A cantilever whose tip is pressed on a slope: `λ = n·F P/(n·F n)` with F the flexibilities of the
/// tip, `L/EA` along and `L³/3EI` across. Nothing sinks in.
#[test]
fn a_tip_rests_on_a_slope() {
    let frame = chain(Vector::x(), 0.05, 1);
    let (section, elastic) = (rod([0, 1]).section, rod([0, 1]).elastic);
    let normal = Vector::new(-0.6, 0.0, 0.8);
    let across = 0.05f64.powi(3) / (3.0 * elastic.e_pa * section.iy_m4);
    let along = 0.05 / (elastic.e_pa * section.area_m2);
    let supports = clamped([0, 1]);
    let mut stages = vec![stage(1, &supports, [0.0; 3]); 4];
    stages[0].at_nodes = vec![force(1, normal)]; // torn off
    stages[1].at_nodes = vec![force(1, Vector::z() * -1.5)];
    stages[2].at_nodes = vec![force(1, Vector::x() * -2.0)];
    stages[3].at_nodes = vec![force(1, Vector::x())]; // the slope is on the side it goes to
    let records = run(&frame, &stages, &[hold(1, normal, 0.5)]);
    assert_eq!(holding(&records[0]).let_go, [1]);
    let give = |f: Vector| (f.x * along * normal.x + f.z * across * normal.z, ());
    for (record, load) in
        records[1..].iter().zip([Vector::z() * -1.5, Vector::x() * -2.0, Vector::x()])
    {
        let gap_m = give(load).0;
        let wanted = (-gap_m / give(normal).0).max(0.0);
        for state in [staged(record), record.one_shot.as_ref().unwrap()] {
            let pressed = Vector::from_column_slice(&state.reactions[1][..3]);
            assert!((pressed - normal * wanted).norm() < 1e-12, "{pressed:?}, {wanted}");
            let u = Vector::from_column_slice(&state.displacement[1][..3]);
            assert!((u.dot(&normal) - gap_m.max(0.0)).abs() < 1e-15);
        }
        assert_eq!(holding(record).resting.len(), usize::from(wanted > 0.0));
    }
}

/// A heavy beam on many supports without adhesion is lifted at its end by P: on a plane the lifted length is
/// `a = 2 P/q` (no moment and no slope where it lies again) and its end rises by `q a⁴/(24 E I)`.
/// Supports a pitch h apart give it to first order in h at worst.
#[test]
fn a_beam_is_lifted_at_its_end() {
    let length_m = 0.3;
    let (section, elastic) = (rod([0, 1]).section, rod([0, 1]).elastic);
    let q = 1240.0 * section.area_m2 * 9.80665;
    let (a, ei) = (0.17f64, elastic.e_pa * section.iy_m4);
    let rise_m = q * a.powi(4) / (24.0 * ei);
    let error = |count: usize| {
        let frame = chain(Vector::x(), length_m, count);
        let supports = clamped(0..=count);
        let mut torn = stage(count, &supports, [0.0; 3]);
        torn.at_nodes = (0..count).map(|node| force(node, Vector::z() * 1e-3)).collect();
        let mut lifted = stage(count, &supports, DOWN);
        lifted.at_nodes = vec![force(0, Vector::z() * (q * a / 2.0))];
        let holds: Vec<Hold> = (0..count).map(|node| hold(node, Vector::z(), 0.0)).collect();
        let records = run(&frame, &[torn, lifted.clone()], &holds);
        assert_eq!(holding(&records[0]).let_go.len(), count);
        let state = staged(&records[1]);
        assert!(holding(&records[1]).is_settled);
        let off = balance(&frame, &lifted, &records[1]);
        assert!(off < 1e-9, "{off:e}");
        let first = holding(&records[1]).resting[0] as f64 * length_m / count as f64;
        let risen = state.displacement[0][2] / rise_m - 1.0;
        eprintln!("{count} supports: lies from {:.4} of {a}, end off by {risen:+.2e}", first);
        assert!((first - a).abs() <= 2.0 * length_m / count as f64);
        for node in 0..count {
            let (u, r) = (state.displacement[node][2], state.reactions[node][2]);
            assert!(
                r >= 0.0 && u >= -1e-9 * rise_m && r * u <= 1e-9 * q * a * rise_m,
                "{node}: {u:e}, {r:e}"
            );
        }
        risen.abs()
    };
    let [coarse, fine] = [20, 80].map(error);
    assert!(fine < 0.01 && fine < coarse / 4.0, "{coarse:e}, {fine:e}");
}

/// Held down without adhesion and clamped where it still lies, a beam lifted by P peels back to the first
/// support that is pressed: `(k + ½) h ≥ P/q`, and its end rises as that cantilever's does.
#[test]
fn a_clamped_beam_peels_from_its_end() {
    let count = 40;
    let frame = chain(Vector::x(), 0.2, count);
    let pitch_m = 0.2 / count as f64;
    let section = rod([0, 1]).section;
    let (q, ei) = (1240.0 * section.area_m2 * 9.80665, 3.5e9 * section.iy_m4);
    let mut lifted = stage(count, &clamped(0..=count), DOWN);
    let p = q * pitch_m * 13.3;
    lifted.at_nodes = vec![force(0, Vector::z() * p)];
    let holds: Vec<Hold> = (0..=count).map(|node| hold(node, Vector::z(), 0.0)).collect();
    let record = &run(&frame, &[lifted.clone()], &holds)[0];
    assert_eq!(holding(record).let_go, (0..13).collect::<Vec<usize>>());
    assert!(holding(record).is_settled && holding(record).resting.is_empty());
    let a = 13.0 * pitch_m;
    let rise_m = (p * a.powi(3) / 3.0 - q * a.powi(4) / 8.0) / ei;
    near(staged(record).displacement[0][2], rise_m, 1e-9);
    near(record.one_shot.as_ref().unwrap().displacement[0][2], rise_m, 1e-9);
    assert!(balance(&frame, &lifted, record) < 1e-9);
}

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
                    [part(0), part(3)].map(|v| <[f64; 3]>::from(v)).concat()
                };
                let (a, b) = (&staged(plain).displacement, &staged(&other).displacement);
                let turned: Vec<f64> = b.iter().flat_map(back).collect();
                assert!(block_gap(&turned, &a.concat()) < 1e-7);
            }
        }
    }
    assert!(went > 20, "{went} let go: too few to show anything");
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
