//! Long prints of generated frames: the updated factor against fresh ones, and what it costs.

use std::time::Duration;

use super::*;
use crate::structure::assembly::Pattern;
use crate::structure::beam::beams;
use crate::structure::ground::{Tie, ground};
use crate::structure::growing::Growing;
use crate::structure::ldl::Pair;
use crate::structure::solve::{add_ends, fixed_freedoms, masked};
use crate::structure::{Ask, Stage, StageRecord, solve, solve_stages};

const DOWN: [f64; 3] = [0.0, 0.0, -9.80665];

/// Numbers in [0, 1) from a seed (Knuth's multiplier, upper bits).
pub(in crate::structure) struct Chance(pub(in crate::structure) u64);

impl Chance {
    pub(in crate::structure) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(in crate::structure) fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }
}

/// Random points in a cube with some 20 mm between them, the lowest clamped, each of the others tied
/// to the three nearest below it as it comes: no stage floats.
pub(in crate::structure) fn grown(members: usize, seed: u64) -> (Frame, Vec<Support>) {
    let mut chance = Chance(seed);
    let (risen, ground) = (members.div_ceil(3), (members / 40).max(4));
    let side_m = 0.02 * ((risen + ground) as f64).cbrt();
    let mut nodes: Vec<Point> = (0..risen + ground)
        .map(|_| Point::from(Vector::from_fn(|_, _| side_m * chance.next())))
        .collect();
    nodes.sort_by(|a, b| a.z.total_cmp(&b.z));
    let mut found = Vec::new();
    for node in ground..nodes.len() {
        let mut below: Vec<usize> = (0..node).collect();
        let far = |other: usize| (nodes[other] - nodes[node]).norm();
        below.sort_by(|&a, &b| far(a).total_cmp(&far(b)));
        for &other in below.iter().take(3.min(members - found.len())) {
            found.push(rod([other, node]));
        }
    }
    (Frame::new(nodes, found).unwrap(), clamped(0..ground))
}

fn growing(frame: &Frame, supports: &[Support]) -> Vec<Stage> {
    let stage = |born| Stage {
        born,
        supports: supports.to_vec(),
        gravity_m_s2: DOWN,
        at_nodes: Vec::new(),
        stiffness: Vec::new(),
    };
    (1..=frame.members().len()).map(stage).collect()
}

fn worst_residual(records: &[StageRecord]) -> (f64, f64) {
    let of = |record: &StageRecord| {
        let of = |state: &Option<crate::structure::StageState>| state.as_ref().unwrap().residual;
        of(&record.one_shot).max(of(&record.staged))
    };
    (records.iter().map(of).fold(0.0, f64::max), of(records.last().unwrap()))
}

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

fn kept(frame: &Frame, supports: &[Support]) -> Vec<bool> {
    let mut keep = vec![true; frame.nodes().len()];
    supports.iter().for_each(|support| keep[support.node] = false);
    keep
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

/// Row 4, small: the end of the print is that of a fresh solve, and nothing drifts.
#[test]
fn a_long_print_does_not_drift() {
    let (frame, supports) = grown(400, 15);
    let last = frame.members().len() - 1;
    let ask = Ask { staged: true, keep: &[last], ..Ask::default() };
    let records = solve_stages(&frame, &growing(&frame, &supports), ask).unwrap();
    let (worst, at_end) = worst_residual(&records);
    eprintln!("residual {worst:.1e} at worst, {at_end:.1e} at the end");
    assert!(worst <= 1e-10);
    let fresh = solve(&frame, &supports, &falling(DOWN)).unwrap();
    let one_shot = records[last].one_shot.as_ref().unwrap();
    assert!(block_gap(&one_shot.displacement.concat(), &fresh.displacement.concat()) < 1e-9);
    assert!(block_gap(&one_shot.reactions.concat(), &fresh.reactions.concat()) < 1e-9);
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

/// Factor at every strut with faer on one core, one order and symbolic factorisation for all.
fn refactored(frame: &Frame, supports: &[Support]) -> f64 {
    let keep = kept(frame, supports);
    let beams = beams(frame);
    let pattern = Pattern::new(&keep, frame.members()).unwrap();
    let mut active = vec![false; pattern.freedoms()];
    let mut sum = 0.0;
    for born in 1..=frame.members().len() {
        let members = &frame.members()[..born];
        for node in members[born - 1].ends {
            if let Ok(place) = pattern.kept.binary_search(&node) {
                active[6 * place..6 * place + 6].fill(true);
            }
        }
        let parts = members.iter().zip(&beams).map(|(member, beam)| (member, &beam.stiffness, 1.0));
        let values = pattern.assemble(parts, &active);
        let factor = pattern.factor(&values, &active).unwrap();
        for _ in 0..2 {
            let mut right: Vec<f64> = active.iter().map(|&active| f64::from(active)).collect();
            pattern.solve(&factor, &mut right);
            sum += right[0];
        }
    }
    sum
}

/// Time this thread has run: the machine is shared.
struct Cpu(f64);

impl Cpu {
    fn now() -> Self {
        let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
        Self(text.split(' ').next().and_then(|ns| ns.parse().ok()).unwrap_or(0.0))
    }

    fn elapsed(&self) -> Duration {
        Duration::from_nanos((Self::now().0 - self.0) as u64)
    }
}

#[test]
#[ignore = "takes minutes; prints what a print costs"]
fn what_a_print_costs() {
    let only = std::env::var("ONLY").ok().and_then(|only| only.parse::<usize>().ok());
    for members in [400, 900, 2500, 5000].into_iter().filter(|size| only.is_none_or(|o| o == *size))
    {
        let (frame, supports) = grown(members, 7);
        let stages = growing(&frame, &supports);
        let start = Cpu::now();
        let keep = kept(&frame, &supports);
        let beams = beams(&frame);
        let mut alone = Growing::new(&frame, &beams, &keep, members);
        let ordered = start.elapsed();
        let start = Cpu::now();
        let mut wanted = vec![0.0; members];
        let mut free = vec![[false; 6]; keep.len()];
        let mut made = 0;
        for member in 0..members {
            wanted[member] = 1.0;
            for node in frame.members()[member].ends.into_iter().filter(|&node| keep[node]) {
                free[node] = [true; 6];
            }
            alone.advance(&wanted, &free).unwrap();
            made += usize::from(alone.was_made());
        }
        let updates = start.elapsed();
        let start = Cpu::now();
        alone.refactor().unwrap();
        let anew = start.elapsed();
        let start = Cpu::now();
        let mut right = vec![[1.0; 2]; 6 * keep.len()];
        alone.solve(&mut right);
        let solve = start.elapsed();
        let start = Cpu::now();
        let ask = Ask { staged: true, ..Ask::default() };
        let records = solve_stages(&frame, &stages, ask).unwrap();
        let all = start.elapsed();
        let (worst, last) = worst_residual(&records);
        let start = Cpu::now();
        let theirs = if members <= 2500 { refactored(&frame, &supports) } else { 0.0 };
        let faer = start.elapsed();
        let per = |time: std::time::Duration| time.as_secs_f64() * 1e3 / members as f64;
        eprintln!(
            "{members}: order {ordered:.1?}, lnz {}, update {:.3} ms ({made} made anew), all {:.3} ms, anew {anew:.1?}, solve {solve:.1?}; faer {:.3} ms ({:.1}x) {theirs:.1e}; residual {worst:.1e}, last {last:.1e}",
            alone.filled(),
            per(updates),
            per(all),
            per(faer),
            per(faer) / per(all)
        );
    }
}
