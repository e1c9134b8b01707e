//! Struts and supports that come, change and go: each time against a factor made from nothing.

use super::grows::{Chance, grown, kept};
use super::*;
use crate::structure::assembly::Pattern;
use crate::structure::beam::beams;
use crate::structure::ground::{Tie, ground};
use crate::structure::growing::Growing;
use crate::structure::ldl::Pair;
use crate::structure::solve::{add_ends, fixed_freedoms, masked};
use crate::structure::{Ask, Stage, solve_stages};

/// Members in use and freedoms, as `Growing` wants them: what is tied to the ground.
fn tied(frame: &Frame, supports: &[Support], used: &[f64]) -> (Vec<f64>, Vec<[bool; 6]>) {
    let there: Vec<usize> = (0..used.len()).filter(|&member| used[member] != 0.0).collect();
    let members: Vec<Member> = there.iter().map(|&member| frame.members()[member]).collect();
    let tie = ground(frame.nodes().len(), &members, supports).tie;
    let mut wanted = used.to_vec();
    for &member in &there {
        if tie[frame.members()[member].ends[0]] != Tie::Held {
            wanted[member] = 0.0;
        }
    }
    let fixed = fixed_freedoms(frame.nodes().len(), supports).into_iter().zip(&tie);
    (wanted, fixed.map(|(fixed, tie)| fixed.map(|f| !f && *tie == Tie::Held)).collect())
}

/// Largest difference of two solutions for the same right side, block by block, and of the second
/// and one by faer: what the frame makes of rounding.
fn apart(one: &Growing, other: &Growing, frame: &Frame, (w, free): (&[f64], &[[bool; 6]])) -> Pair {
    let mut chance = Chance(77);
    let right: Vec<Pair> = free.concat().iter().map(|_| [chance.next() - 0.5, 0.0]).collect();
    let solved = |growing: &Growing| {
        let mut x = right.clone();
        growing.solve(&mut x);
        x.iter().map(|pair| pair[0]).collect::<Vec<f64>>()
    };
    let (one, other) = (solved(one), solved(other));
    let pattern = Pattern::new(&vec![true; free.len()], frame.members()).unwrap();
    let (beams, active) = (beams(frame), free.concat());
    let parts = frame.members().iter().zip(&beams).zip(w);
    let values = pattern.assemble(parts.map(|((m, b), w)| (m, &b.stiffness, *w)), &active);
    let factor = pattern.factor(&values, &active).unwrap();
    let mut peer = masked(right.iter().map(|pair| pair[0]).collect(), &active);
    pattern.solve(&factor, &mut peer);
    [block_gap(&one, &other), block_gap(&other, &peer)]
}

/// Row 6: from 400 struts, in random order, each time against a factor made from nothing.
#[test]
fn struts_go_in_random_order() {
    let (frame, supports) = grown(400, 11);
    let (keep, beams) = (kept(&frame, &supports), beams(&frame));
    let mut removed = Growing::new(&frame, &beams, &keep, 400);
    let mut fresh = Growing::new(&frame, &beams, &keep, 400);
    let mut used = vec![1.0; 400];
    let (wanted, free) = tied(&frame, &supports, &used);
    removed.advance(&wanted, &free).unwrap();
    let mut chance = Chance(12);
    let mut order: Vec<usize> = (0..400).collect();
    (1..400).rev().for_each(|at| order.swap(at, chance.below(at + 1)));
    let (mut worst, mut peer, mut updates) = (0.0f64, 0.0f64, 0);
    for member in order {
        used[member] = 0.0;
        let (wanted, free) = tied(&frame, &supports, &used);
        removed.advance(&wanted, &free).unwrap();
        updates += usize::from(!removed.was_made());
        fresh.start_from_nothing();
        fresh.advance(&wanted, &free).unwrap();
        assert!(fresh.was_made());
        let gaps = apart(&removed, &fresh, &frame, (&wanted, &free));
        (worst, peer) = (worst.max(gaps[0]), peer.max(gaps[1]));
    }
    eprintln!(
        "400 struts taken away, {updates} as updates: {worst:.1e} apart at worst, a new one and faer's {peer:.1e}"
    );
    assert!(updates > 100 && worst < 1e-9);
}

/// Coming, hardening, softening and going by chance, with pieces that float and come back.
#[test]
fn struts_come_harden_and_go() {
    let (frame, supports) = grown(240, 13);
    let (keep, beams) = (kept(&frame, &supports), beams(&frame));
    let mut changed = Growing::new(&frame, &beams, &keep, 240);
    let mut fresh = Growing::new(&frame, &beams, &keep, 240);
    let mut chance = Chance(14);
    let mut used = vec![0.0; 240];
    let (mut worst, mut peer, mut updates) = (0.0f64, 0.0f64, 0);
    for _ in 0..600 {
        for _ in 0..=chance.below(3) {
            used[chance.below(240)] = if chance.next() < 0.3 { 0.0 } else { 0.05 + chance.next() };
        }
        let (wanted, free) = tied(&frame, &supports, &used);
        changed.advance(&wanted, &free).unwrap();
        updates += usize::from(!changed.was_made());
        fresh.start_from_nothing();
        fresh.advance(&wanted, &free).unwrap();
        let gaps = apart(&changed, &fresh, &frame, (&wanted, &free));
        (worst, peer) = (worst.max(gaps[0]), peer.max(gaps[1]));
    }
    eprintln!(
        "600 changes, {updates} as updates: {worst:.1e} apart at worst, a new one and faer's {peer:.1e}"
    );
    // soft chains come by: there, what rounding does to any two factors is more
    assert!(updates > 100 && worst < 1e-9_f64.max(2.0 * peer));
}

/// Pinned feet, a swinging strand that is caught, props that come and go, ageing, a turning bed:
/// every stage is what a fresh solve of the members so far gives.
#[test]
fn whatever_changes_the_stage_is_that_of_a_fresh_solve() {
    let (frame, supports) = grown(60, 16);
    let mut chance = Chance(17);
    let last = frame.nodes().len() - 1;
    let stages: Vec<Stage> = (1..=60)
        .map(|born| {
            let mut supports = supports.clone();
            supports.iter_mut().for_each(|support| *support = Support::pinned(support.node));
            if (20..40).contains(&born) {
                supports.push(Support::pinned(frame.members()[12].ends[1]));
            }
            if born == 60 {
                supports
                    .push(Support { node: last, fixed: [false, false, true, false, false, false] });
            }
            let angle = if born % 7 == 0 { 0.3 * born as f64 } else { 0.0 };
            Stage {
                born,
                supports,
                gravity_m_s2: [9.8 * angle.sin(), 0.0, -9.8 * angle.cos()],
                at_nodes: Vec::new(),
                stiffness: (0..born)
                    .map(
                        |member| {
                            if born > 30 && member + 4 > born { 0.2 + chance.next() } else { 1.0 }
                        },
                    )
                    .collect(),
                ..Stage::default()
            }
        })
        .collect();
    let keep: Vec<usize> = (0..60).collect();
    let ask = Ask { staged: true, keep: &keep, ..Ask::default() };
    let records = solve_stages(&frame, &stages, ask).unwrap();
    let (mut solved, mut swinging) = (0, 0);
    for (stage, record) in stages.iter().zip(&records) {
        let used: Vec<f64> = (0..60)
            .map(|member| if member < stage.born { stage.stiffness_of(member) } else { 0.0 })
            .collect();
        let (wanted, free) = tied(&frame, &stage.supports, &used);
        let beams = beams(&frame);
        let active: Vec<bool> = free.concat();
        let pattern = Pattern::new(&vec![true; frame.nodes().len()], frame.members()).unwrap();
        let parts = frame.members().iter().zip(&beams).zip(&wanted);
        let values = pattern.assemble(parts.map(|((m, b), w)| (m, &b.stiffness, *w)), &active);
        let Ok(factor) = pattern.factor(&values, &active) else {
            swinging += 1;
            let (node, freedom) = record.mechanism.unwrap();
            assert!(free[node][freedom], "named is what can move");
            continue;
        };
        solved += 1;
        assert!(record.mechanism.is_none() && record.floats.is_empty());
        let mut f = vec![0.0; active.len()];
        for (member, beam) in frame.members()[..stage.born].iter().zip(&beams) {
            add_ends(&mut f, member, &beam.weight_load(stage.gravity_m_s2));
        }
        let mut u = masked(f, &active);
        pattern.solve(&factor, &mut u);
        let got = record.one_shot.as_ref().unwrap();
        let gap = block_gap(&got.displacement.concat(), &u);
        assert!(gap < 1e-8 && got.residual < 1e-10, "{}: {gap:e}", stage.born);
    }
    eprintln!("{solved} stages stand, {swinging} swing");
    assert!(solved > 30 && swinging >= 2);
}
