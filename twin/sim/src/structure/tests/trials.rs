//! The nozzle tries the frame, and the frame is asked for its buckling, as it grows.

use super::*;
use crate::structure::{
    Ask, At, BucklingAsk, Load, NodeLoad, Stage, Strength, Trial, Weld, buckling, solve,
    solve_stages, utilisation,
};

const STRENGTH: Strength = Strength { tension_pa: 4e7, compression_pa: 5e7 };
const DOWN: [f64; 3] = [0.0, 0.0, -9.80665];

fn stage(born: usize) -> Stage {
    Stage { born, supports: clamped([0]), gravity_m_s2: DOWN, ..Stage::default() }
}

fn push(node: usize, load: [f64; 3]) -> Vec<NodeLoad> {
    vec![NodeLoad { node, load: [load[0], load[1], load[2], 0.0, 0.0, 0.0] }]
}

fn trial(node: usize, load: [f64; 3]) -> Trial {
    Trial { loads: push(node, load), is_bound: false }
}

/// A trial is what one more load does to the frame as it stands, and nothing stays of it.
#[test]
fn a_trial_is_one_more_load_and_leaves_no_trace() {
    let frame = chain(Vector::new(0.3, 0.1, 0.9), 0.04, 5);
    let x = Vector::new(0.3, 0.1, 0.9).normalize();
    let weld = Weld {
        node: 0,
        through: vec![(0, At::First)],
        area_m2: 1e-6,
        normal: x,
        tension_pa: 2e7,
        shear_pa: 1e7,
    };
    let (strengths, welds) = ([STRENGTH; 5], [weld]);
    let ask = Ask { staged: true, strengths: &strengths, welds: &welds, ..Ask::default() };
    let loads = [[0.1, 0.0, -0.3], [0.0, 0.2, 0.1], [-0.05, 0.0, 0.0]];
    let plain: Vec<Stage> = (1..=5).map(stage).collect();
    let tried: Vec<Stage> = plain
        .iter()
        .map(|stage| Stage {
            trials: loads.iter().map(|load| trial(stage.born, *load)).collect(),
            watch: vec![stage.born, 0],
            ..stage.clone()
        })
        .collect();
    let without = solve_stages(&frame, &plain, ask).unwrap();
    let with = solve_stages(&frame, &tried, ask).unwrap();
    for (without, with) in without.iter().zip(&with) {
        let (a, b) = (without.staged.as_ref().unwrap(), with.staged.as_ref().unwrap());
        assert_eq!((a.max_translation_m, a.utilisation), (b.max_translation_m, b.utilisation));
        assert_eq!(b.watched[1], [0.0; 6]);
        assert_eq!(with.trials.len(), 3);
    }
    // the last stage against a frame that is pushed as a whole
    let end = &with[4];
    let watched = end.staged.as_ref().unwrap().watched[0];
    for (load, trial) in loads.iter().zip(&end.trials) {
        let at_nodes = push(5, *load);
        let alone = Load { at_nodes: at_nodes.clone(), ..Load::default() };
        let alone = solve(&frame, &clamped([0]), &alone).unwrap();
        let (node, six) = trial.displacement[0];
        assert_eq!(node, 5);
        assert!(block_gap(&six, &alone.displacement[5]) < 1e-9);
        let moved = Vector::from_fn(|axis, _| watched[axis] + six[axis]).norm();
        assert!(trial.max_translation_m >= moved * (1.0 - 1e-12));
        assert!(trial.weld.unwrap().value > 0.0);
    }
}

/// All born at once, staged is one-shot: then the use of strength under a trial is that of the sum of both loads.
#[test]
fn strength_under_a_trial_is_that_of_both_loads() {
    let frame = chain(Vector::new(0.6, 0.0, 0.8), 0.03, 4);
    let mut all = stage(4);
    all.trials = vec![trial(4, [0.4, 0.1, -0.2]), trial(2, [0.0, -0.6, 0.0])];
    let strengths = [STRENGTH; 4];
    let ask = Ask { staged: true, strengths: &strengths, ..Ask::default() };
    let records = solve_stages(&frame, &[all.clone()], ask).unwrap();
    for (trial, state) in all.trials.iter().zip(&records[0].trials) {
        let load = Load { gravity_m_s2: DOWN, at_nodes: trial.loads.clone(), ..Load::default() };
        let both = solve(&frame, &clamped([0]), &load).unwrap();
        let used = utilisation(&frame, &strengths, &both, DOWN).unwrap().unwrap();
        let found = state.utilisation.unwrap();
        assert_eq!((found.member, found.governs), (used.member, used.governs));
        near(found.value, used.value, 1e-9);
    }
}

/// Peaks are the most that a member used at any stage so far; a bound leaves none.
#[test]
fn peaks_are_what_stages_and_trials_came_to() {
    let frame = chain(Vector::new(0.6, 0.0, 0.8), 0.03, 4);
    let bound = Trial { loads: push(2, [5.0, 0.0, 0.0]), is_bound: true };
    let mut stages: Vec<Stage> = (1..=4).map(stage).collect();
    stages[1].trials = vec![trial(2, [0.0, -0.6, 0.0]), bound];
    // lighter at the end: what was used before stays
    stages[3].gravity_m_s2 = [0.0; 3];
    let strengths = [STRENGTH; 4];
    let of = |stages: &[Stage]| {
        let keep = [stages.len() - 1];
        let ask = Ask { staged: true, strengths: &strengths, keep: &keep, ..Ask::default() };
        solve_stages(&frame, stages, ask).unwrap()
    };
    let records = of(&stages);
    assert!(records[2].peaks.is_empty());
    let peaks = &records[3].peaks;
    let most = |found: &[Option<crate::structure::Utilisation>]| {
        found.iter().flatten().map(|used| used.value).fold(0.0, f64::max)
    };
    let staged: Vec<_> = records.iter().map(|it| it.staged.as_ref().unwrap().utilisation).collect();
    let tried = records[1].trials[0].utilisation;
    let worst = most(&staged).max(most(&[tried]));
    assert_eq!(peaks.iter().copied().fold(0.0, f64::max), worst);
    assert!(records[1].trials[1].utilisation.unwrap().value > worst, "the bound is more");
    assert!(most(&staged[3..]) < worst);
    // each member: the most of its own over runs that end at each stage without trials, and at the trial
    let plain: Vec<Stage> =
        stages.iter().map(|it| Stage { trials: Vec::new(), ..it.clone() }).collect();
    let without = &of(&plain)[3].peaks;
    assert!(without.iter().zip(peaks).all(|(less, more)| less <= more));
    assert_eq!(without[3], peaks[3], "the trial came before it was there");
    assert!(without[0] < peaks[0]);
}

/// The factor of a stage is that of the frame as it then is; it falls as a mast grows, and goes with the cube of its height.
#[test]
fn stages_buckle_as_the_frame_they_are() {
    let frame = chain(Vector::z(), 0.06, 6);
    let stages: Vec<Stage> = (1..=6).map(stage).collect();
    let ask = Ask { staged: true, buckling_every: 1, ..Ask::default() };
    let records = solve_stages(&frame, &stages, ask).unwrap();
    let mut before = f64::INFINITY;
    for (k, record) in records.iter().enumerate() {
        let found = record.buckling.unwrap().unwrap();
        let part = chain(Vector::z(), 0.01 * (k + 1) as f64, k + 1);
        let wanted =
            buckling(&part, &clamped([0]), &falling(DOWN), BucklingAsk::default()).unwrap();
        near(found.factor, wanted[0].factor, 1e-6);
        assert_eq!(found.member, k);
        assert!(found.factor < before);
        before = found.factor;
    }
    // not asked: the screen flags none of these, but the last is always asked
    let ask = Ask { buckling_every: 100, ..ask };
    let asked = |records: &[crate::structure::StageRecord]| -> Vec<usize> {
        (0..records.len()).filter(|&k| records[k].buckling.is_some()).collect()
    };
    assert_eq!(asked(&solve_stages(&frame, &stages, ask).unwrap()), [0, 5]);
    let none = Ask { buckling_every: 0, ..ask };
    assert_eq!(asked(&solve_stages(&frame, &stages, none).unwrap()), Vec::<usize>::new());
    // the top loaded with a quarter of its Euler load is flagged at every stage
    let rod = frame.members()[0];
    let press = 0.25 * std::f64::consts::PI.powi(2) * rod.elastic.e_pa * rod.section.iy_m4 / 1e-4;
    let pressed: Vec<Stage> = stages
        .iter()
        .map(|stage| Stage { at_nodes: push(stage.born, [0.0, 0.0, -press]), ..stage.clone() })
        .collect();
    assert_eq!(asked(&solve_stages(&frame, &pressed, ask).unwrap()).len(), 6);
}

#[test]
fn unusable_trials_are_refused() {
    let frame = chain(Vector::z(), 0.06, 3);
    let refused = |stage: Stage| solve_stages(&frame, &[stage], Ask::default()).is_err();
    assert!(refused(Stage { trials: vec![trial(9, [0.0; 3])], ..stage(3) }));
    assert!(refused(Stage { trials: vec![trial(1, [f64::NAN, 0.0, 0.0])], ..stage(3) }));
    assert!(refused(Stage { watch: vec![4], ..stage(3) }));
    // a node that is not there yet does not move
    let early = Stage { trials: vec![trial(3, [1.0, 0.0, 0.0])], watch: vec![3], ..stage(1) };
    let records = solve_stages(&frame, &[early], Ask::default()).unwrap();
    assert_eq!(records[0].trials[0].displacement, [(3, [0.0; 6])]);
}
