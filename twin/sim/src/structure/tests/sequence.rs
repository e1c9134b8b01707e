//! The printing order of f150, one-shot and staged, and what a stage must not do.

use super::peers::{in_mm, numbers, own, reference};
use super::*;
use crate::structure::{Ask, Stage, StageRecord, Strength, solve, solve_stages};

const DOWN: [f64; 3] = [0.0, 0.0, -9.80665];

fn stage(born: usize, supports: &[Support]) -> Stage {
    Stage {
        born,
        supports: supports.to_vec(),
        gravity_m_s2: DOWN,
        at_nodes: Vec::new(),
        ..Stage::default()
    }
}

fn growing(frame: &Frame, supports: &[Support]) -> Vec<Stage> {
    (1..=frame.members().len()).map(|born| stage(born, supports)).collect()
}

/// f150 with its members in the order of printing.
fn printed() -> (Frame, Vec<Support>, serde_json::Value) {
    let (reference, order) = (reference("f150.json"), own("f150_sequence.json"));
    let members = numbers(&order["sequence"])
        .iter()
        .map(|&member| reference.frame.members()[member as usize])
        .collect();
    let frame = Frame::new(reference.frame.nodes().to_vec(), members).unwrap();
    (frame, reference.supports, order)
}

#[test]
fn printing_order_of_f150() {
    let (frame, supports, file) = printed();
    let snapshots = file["snapshots"].as_object().unwrap();
    let keep: Vec<usize> =
        snapshots.keys().map(|born| born.parse::<usize>().unwrap() - 1).collect();
    let ask = Ask { staged: true, keep: &keep, ..Ask::default() };
    let records = solve_stages(&frame, &growing(&frame, &supports), ask).unwrap();
    for (key, pick) in [("M1", true), ("M2", false)] {
        let state_of = |record: &StageRecord| {
            if pick { record.one_shot.clone() } else { record.staged.clone() }.unwrap()
        };
        let wanted = numbers(&file[format!("{key}_max_translation_and_node")]);
        let mut worst = 0.0f64;
        for (record, wanted) in records.iter().zip(wanted.chunks_exact(2)) {
            let state = state_of(record);
            assert!(record.floats.is_empty() && record.mechanism.is_none());
            assert!(state.residual < 1e-10, "{}", state.residual);
            assert_eq!(state.max_node, wanted[1] as usize);
            worst = worst.max((state.max_translation_m * 1e3 / wanted[0] - 1.0).abs());
        }
        let mut gap = 0.0f64;
        for &at in &keep {
            let got = state_of(&records[at]).displacement.into_iter().flatten();
            let wanted = numbers(&snapshots[&(at + 1).to_string()][format!("{key}_u")]);
            gap = gap.max(block_gap(&in_mm(got, 0), &wanted));
        }
        eprintln!("{key}: worst of 150 maxima {worst:.1e}, worst snapshot {gap:.1e}");
        assert!(worst < 1e-8 && gap < 1e-8);
    }
    let finals = records.last().unwrap();
    let one_shot = finals.one_shot.as_ref().unwrap().max_translation_m;
    let staged = finals.staged.as_ref().unwrap().max_translation_m;
    assert!(staged > 100.0 * one_shot, "the two answers differ, and are both wanted");
}

/// Every stage is what a fresh solve of the members so far gives.
#[test]
fn one_shot_is_a_solve_of_the_part_so_far() {
    let (frame, supports, _) = printed();
    let keep: Vec<usize> = (0..frame.members().len()).collect();
    let ask = Ask { keep: &keep, ..Ask::default() };
    let records = solve_stages(&frame, &growing(&frame, &supports), ask).unwrap();
    for born in [1, 15, 16, 17, 90, 150] {
        let members = &frame.members()[..born];
        let used = |node: &usize| members.iter().any(|member| member.ends.contains(node));
        let names: Vec<usize> = (0..frame.nodes().len()).filter(used).collect();
        let place = |node: usize| names.binary_search(&node).unwrap();
        let part = Frame::new(
            names.iter().map(|&node| frame.nodes()[node]).collect(),
            members.iter().map(|m| Member { ends: m.ends.map(place), ..*m }).collect(),
        )
        .unwrap();
        let held = supports.iter().filter(|support| used(&support.node));
        let held = clamped(held.map(|support| place(support.node)));
        let fresh = solve(&part, &held, &falling(DOWN)).unwrap();
        let state = records[born - 1].one_shot.as_ref().unwrap();
        let got: Vec<f64> = names.iter().flat_map(|&node| state.displacement[node]).collect();
        let wanted: Vec<f64> = fresh.displacement.into_iter().flatten().collect();
        assert!(block_gap(&got, &wanted) < 1e-10);
    }
}

#[test]
fn same_bytes_on_one_thread_and_on_four() {
    let (frame, supports, _) = printed();
    let strengths = vec![Strength { tension_pa: 4e7, compression_pa: 5e7 }; 150];
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let ask = Ask { staged: true, strengths: &strengths, keep: &[3, 149], ..Ask::default() };
        pool.install(|| solve_stages(&frame, &growing(&frame, &supports), ask)).unwrap()
    };
    let (one, four) = (run(1), run(4));
    assert_eq!(one, four);
    let state = one[149].staged.as_ref().unwrap();
    assert!(state.utilisation.unwrap().value > 0.0);
}

/// Printing a far piece first changes nothing here.
#[test]
fn a_separate_piece_does_not_matter() {
    let near = chain(Vector::new(1.0, 0.0, 0.5), 0.05, 3);
    let mut nodes = near.nodes().to_vec();
    nodes.extend((0..3).map(|k| Point::new(5.0, 0.0, 0.02 * k as f64)));
    let mut members = vec![rod([4, 5]), rod([5, 6])];
    members.extend_from_slice(near.members());
    let both = Frame::new(nodes, members).unwrap();
    let ask = Ask { staged: true, keep: &[2, 4], ..Ask::default() };
    let alone = solve_stages(&near, &growing(&near, &clamped([0])), ask).unwrap();
    let beside = solve_stages(&both, &growing(&both, &clamped([0, 4])), ask).unwrap();
    for pick in [true, false] {
        let of = |record: &StageRecord| {
            let state = if pick { &record.one_shot } else { &record.staged };
            state.as_ref().unwrap().displacement[..4].concat()
        };
        assert!(block_gap(&of(&beside[4]), &of(&alone[2])) < 1e-12);
    }
}

/// Floating members are named and left out until something ties them down; their weight then counts.
#[test]
fn a_floating_piece_waits() {
    // ground 0 - 1, then 2 - 3 in the air, then 1 - 2 closes the gap
    let whole = chain(Vector::x(), 0.06, 3);
    let order = [0, 2, 1].map(|k| whole.members()[k]);
    let frame = Frame::new(whole.nodes().to_vec(), order.to_vec()).unwrap();
    let strengths = [Strength { tension_pa: 4e7, compression_pa: 5e7 }; 3];
    let ask = Ask { staged: true, strengths: &strengths, keep: &[0, 1, 2], ..Ask::default() };
    let records = solve_stages(&frame, &growing(&frame, &clamped([0])), ask).unwrap();
    assert!(records[0].floats.is_empty());
    assert_eq!(records[1].floats, [2]);
    assert!(records[2].floats.is_empty());
    let state = |at: usize| records[at].one_shot.as_ref().unwrap();
    assert_eq!(state(0).displacement, state(1).displacement);
    assert_eq!(state(0).reactions, state(1).reactions);
    let weight = 3.0 * 1240.0 * Section::circle(2e-3).area_m2 * 0.02 * 9.80665;
    near(state(2).reactions[0][2], weight, 1e-10);
    near(records[2].staged.as_ref().unwrap().reactions[0][2], weight, 1e-10);
}

#[test]
fn nothing_but_floating_is_no_panic() {
    let frame = chain(Vector::x(), 0.05, 2);
    let mut stages = growing(&frame, &[]);
    stages.insert(0, stage(0, &[]));
    let ask = Ask { staged: true, ..Ask::default() };
    let records = solve_stages(&frame, &stages, ask).unwrap();
    assert_eq!(records[0].floats, Vec::<usize>::new());
    assert_eq!(records[2].floats, [0]);
    assert_eq!(records[2].one_shot.as_ref().unwrap().max_translation_m, 0.0);
    // a load where there is nothing yet
    stages[1].at_nodes = vec![NodeLoad { node: 2, load: [1.0; 6] }];
    let records = solve_stages(&frame, &stages, ask).unwrap();
    assert_eq!(records[1].floats, [0, 2]);
}

/// Gravity that turns with the bed, and a nozzle force that goes: both leave no trace behind.
#[test]
fn staged_forgets_what_is_taken_away() {
    let frame = chain(Vector::z(), 0.05, 2);
    let held = clamped([0]);
    let turned = Stage { gravity_m_s2: [9.8, 0.0, 0.0], ..stage(2, &held) };
    let push = NodeLoad { node: 2, load: [0.0, 0.1, 0.0, 0.0, 0.0, 0.0] };
    let pushed = Stage { at_nodes: vec![push], ..stage(2, &held) };
    let upright = stage(2, &held);
    let stages = [upright.clone(), turned, pushed, upright];
    let ask = Ask { staged: true, keep: &[0, 1, 2, 3], ..Ask::default() };
    let records = solve_stages(&frame, &stages, ask).unwrap();
    for record in &records {
        // all members are born at once: staged and one-shot agree
        let (one_shot, staged) =
            (record.one_shot.as_ref().unwrap(), record.staged.as_ref().unwrap());
        let flat = |six: &[[f64; 6]]| six.concat();
        let most = one_shot.max_translation_m.max(1e-9);
        for (a, b) in flat(&one_shot.displacement).iter().zip(flat(&staged.displacement)) {
            assert!((a - b).abs() < 1e-9 * most.max(1e-3), "{a} {b}");
        }
    }
    assert!(records[2].staged.as_ref().unwrap().max_translation_m > 1e-5);
}

/// A prop that is taken away hands its reaction to the frame; one-shot and staged then agree.
#[test]
fn a_support_may_go() {
    let frame = chain(Vector::x(), 0.06, 2);
    let stages = [stage(2, &clamped([0, 2])), stage(2, &clamped([0]))];
    let ask = Ask { staged: true, keep: &[0, 1], ..Ask::default() };
    let records = solve_stages(&frame, &stages, ask).unwrap();
    let (one_shot, staged) =
        (records[1].one_shot.as_ref().unwrap(), records[1].staged.as_ref().unwrap());
    assert!(block_gap(&staged.displacement.concat(), &one_shot.displacement.concat()) < 1e-10);
    assert!(one_shot.max_translation_m > records[0].one_shot.as_ref().unwrap().max_translation_m);
}

/// A strand that hardens keeps the sag it took on while soft.
#[test]
fn hardening_keeps_the_stress() {
    let frame = chain(Vector::x(), 0.05, 1);
    let held = clamped([0]);
    let soft = Stage { stiffness: vec![0.01], ..stage(1, &held) };
    let ask = Ask { staged: true, ..Ask::default() };
    let records = solve_stages(&frame, &[soft, stage(1, &held)], ask).unwrap();
    let sag = |at: usize| records[at].staged.as_ref().unwrap().max_translation_m;
    near(sag(1), sag(0), 1e-12);
    near(records[1].one_shot.as_ref().unwrap().max_translation_m, 0.01 * sag(0), 1e-10);
}

#[test]
fn unusable_stages_are_refused() {
    let frame = chain(Vector::x(), 0.05, 2);
    let held = clamped([0]);
    let run = |stages: &[Stage]| solve_stages(&frame, stages, Ask::default());
    assert!(run(&[stage(3, &held)]).is_err());
    assert!(run(&[stage(2, &held), stage(1, &held)]).is_err());
    assert!(run(&[stage(1, &clamped([7]))]).is_err());
    assert!(run(&[Stage { stiffness: vec![1.0], ..stage(2, &held) }]).is_err());
    assert!(run(&[Stage { stiffness: vec![0.0], ..stage(1, &held) }]).is_err());
    let ask = Ask { strengths: &[], ..Ask::default() };
    assert!(solve_stages(&frame, &[], ask).unwrap().is_empty());
}
