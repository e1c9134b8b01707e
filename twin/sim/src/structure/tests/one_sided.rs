//! Supports that let go: closed forms of what lifts and what rests.

use super::*;
use crate::structure::{
    Ask, Hold, Holding, Stage, StageRecord, StageState, solve_held, solve_held_stages, solve_stages,
};

pub(super) const DOWN: [f64; 3] = [0.0, 0.0, -9.80665];

pub(super) fn stage(born: usize, supports: &[Support], gravity_m_s2: [f64; 3]) -> Stage {
    let supports = supports.to_vec();
    Stage { born, supports, gravity_m_s2, ..Stage::default() }
}

pub(super) fn hold(node: usize, normal: Vector, pull_n: f64) -> Hold {
    Hold { node, normal, pull_n, from: 0, until: usize::MAX }
}

pub(super) fn force(node: usize, f: Vector) -> NodeLoad {
    NodeLoad { node, load: [f.x, f.y, f.z, 0.0, 0.0, 0.0] }
}

/// Every stage kept.
pub(super) fn run(frame: &Frame, stages: &[Stage], holds: &[Hold]) -> Vec<StageRecord> {
    let keep: Vec<usize> = (0..stages.len()).collect();
    let ask = Ask { staged: true, keep: &keep, ..Ask::default() };
    solve_held_stages(frame, stages, holds, ask).unwrap()
}

pub(super) fn staged(record: &StageRecord) -> &StageState {
    record.staged.as_ref().unwrap()
}

pub(super) fn holding(record: &StageRecord) -> &Holding {
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
    // on a wall as well it would have to slide along one of the two; on the same surface twice it is held twice
    for (other, goes) in
        [(Vector::x(), false), (up, false), (Vector::new(0.1, 0.0, 1.0).normalize(), false)]
    {
        let holds = [hold(1, up, held_n * 0.9), hold(1, other, held_n * 0.2)];
        let record = &run(&frame, &[pulled.clone()], &holds)[0];
        assert_eq!(!holding(record).let_go.is_empty(), goes);
        assert_eq!(holding(record).worst.is_none(), other == Vector::x());
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
    let give = |f: Vector| f.x * along * normal.x + f.z * across * normal.z;
    for (record, load) in
        records[1..].iter().zip([Vector::z() * -1.5, Vector::x() * -2.0, Vector::x()])
    {
        let gap_m = give(load);
        let wanted = (-gap_m / give(normal)).max(0.0);
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
