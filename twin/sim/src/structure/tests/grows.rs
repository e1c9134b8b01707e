//! Long prints of generated frames: the updated factor against fresh ones, and what it costs.

use std::time::Duration;

use super::*;
use crate::structure::assembly::Pattern;
use crate::structure::beam::beams;
use crate::structure::growing::Growing;
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
        ..Stage::default()
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

pub(super) fn kept(frame: &Frame, supports: &[Support]) -> Vec<bool> {
    let mut keep = vec![true; frame.nodes().len()];
    supports.iter().for_each(|support| keep[support.node] = false);
    keep
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
