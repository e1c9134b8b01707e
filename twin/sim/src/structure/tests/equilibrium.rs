//! What every answer must do: supports carry all loads, a piece cut off balances, and a turn of frame
//! and gravity turns the answer. Moving beds: `rides_balance`.

use super::grows::Chance;
use super::rides::ribbons;
use super::*;
use crate::pose::{Pose, from_xyz_rpy};
use crate::structure::beam::beams;
use crate::structure::strength::cuts;
use crate::structure::{Ask, BucklingAsk, Stage, StageState, buckling, solve, solve_stages};

/// Forces and moments, N and 0.01 N m, on nodes that no support holds.
fn loads(frame: &Frame, supports: &[Support], count: usize, chance: &mut Chance) -> Vec<NodeLoad> {
    let (ground, free) = (supports.len(), frame.nodes().len() - supports.len());
    let mut load = || NodeLoad {
        node: ground + chance.below(free),
        load: std::array::from_fn(|k| (2.0 * chance.next() - 1.0) * if k < 3 { 1.0 } else { 0.01 }),
    };
    (0..count).map(|_| load()).collect()
}

fn gravity(chance: &mut Chance) -> [f64; 3] {
    std::array::from_fn(|_| 10.0 * (2.0 * chance.next() - 1.0))
}

/// A sum of forces and of moments about the origin, and the sizes of what went into it.
#[derive(Default)]
struct Sum {
    force: Vector,
    moment: Vector,
    sizes: [f64; 2],
}

impl Sum {
    fn add(&mut self, place: &Point, six: &[f64; 6]) {
        let force = Vector::new(six[0], six[1], six[2]);
        let moment = Vector::new(six[3], six[4], six[5]) + place.coords.cross(&force);
        self.force += force;
        self.moment += moment;
        self.sizes = [self.sizes[0] + force.norm(), self.sizes[1] + moment.norm()];
    }

    fn push(&mut self, place: &Point, force: &Vector) {
        self.add(place, &[force.x, force.y, force.z, 0.0, 0.0, 0.0]);
    }

    /// What is left over, relative to what went into it.
    fn left(&self) -> f64 {
        (self.force.norm() / self.sizes[0]).max(self.moment.norm() / self.sizes[1])
    }
}

/// Weight of the first members and loads at nodes.
fn acting(frame: &Frame, born: usize, gravity: [f64; 3], at_nodes: &[NodeLoad]) -> Sum {
    let mut sum = Sum::default();
    for (member, beam) in frame.members().iter().zip(beams(frame)).take(born) {
        let [a, b] = member.ends.map(|node| frame.nodes()[node]);
        sum.push(&nalgebra::center(&a, &b), &(beam.line_load(gravity) * beam.length_m));
    }
    at_nodes.iter().for_each(|load| sum.add(&frame.nodes()[load.node], &load.load));
    sum
}

#[test]
fn supports_carry_all_loads() {
    let (frame, supports) = ribbons(120, 3);
    let mut chance = Chance(17);
    let mut worst = 0.0f64;
    for _ in 0..10 {
        let at_nodes = loads(&frame, &supports, 5, &mut chance);
        let load = Load { at_nodes, ..falling(gravity(&mut chance)) };
        let solution = solve(&frame, &supports, &load).unwrap();
        let mut sum = acting(&frame, 120, load.gravity_m_s2, &load.at_nodes);
        for (support, six) in supports.iter().zip(&solution.reactions) {
            sum.add(&frame.nodes()[support.node], six);
        }
        worst = worst.max(sum.left());
    }
    eprintln!("reactions against loads: {worst:.1e}");
    assert!(worst < 1e-9);
}

/// A print whose bed turns, whose members harden and whose nozzle pushes: both answers, every stage.
fn print(frame: &Frame, supports: &[Support], turn: &Pose) -> Vec<Stage> {
    let mut chance = Chance(29);
    let there = |v: Vector| turn.rotation * v;
    let stage = |born: usize| {
        let down = there(Vector::from(gravity(&mut chance)));
        let node = frame.members()[born - 1].ends[1];
        let push = there(Vector::new(0.3, -0.2, 0.5));
        Stage {
            born,
            supports: supports.to_vec(),
            gravity_m_s2: down.into(),
            at_nodes: vec![NodeLoad { node, load: [push.x, push.y, push.z, 0.0, 0.0, 0.0] }],
            stiffness: (0..born).map(|member| 1.0 - 0.7 / (born - member) as f64).collect(),
            ..Stage::default()
        }
    };
    (1..=frame.members().len()).map(stage).collect()
}

#[test]
fn supports_carry_every_stage() {
    let (frame, supports) = ribbons(60, 19);
    let stages = print(&frame, &supports, &Pose::identity());
    let records = solve_stages(&frame, &stages, Ask { staged: true, ..Ask::default() }).unwrap();
    let mut worst = [0.0f64; 2];
    for (stage, record) in stages.iter().zip(&records) {
        for (worst, state) in worst.iter_mut().zip([&record.one_shot, &record.staged]) {
            let state: &StageState = state.as_ref().unwrap();
            let mut sum = acting(&frame, stage.born, stage.gravity_m_s2, &stage.at_nodes);
            for (support, six) in stage.supports.iter().zip(&state.reactions) {
                sum.add(&frame.nodes()[support.node], six);
            }
            *worst = worst.max(sum.left());
        }
    }
    eprintln!("reactions of stages against loads: one-shot, staged {worst:.1?}");
    assert!(worst.iter().all(|gap| *gap < 1e-9));
}

/// The upper half of a frame, cut off at 0.3 of each member that leads to it.
#[test]
fn a_piece_of_a_solve_balances() {
    let (frame, supports) = ribbons(120, 23);
    let mut chance = Chance(31);
    let upper = |node: usize| node >= frame.nodes().len() / 2;
    let beams = beams(&frame);
    let mut worst = 0.0f64;
    for _ in 0..10 {
        let at_nodes = loads(&frame, &supports, 5, &mut chance);
        let load = Load { at_nodes, ..falling(gravity(&mut chance)) };
        let solution = solve(&frame, &supports, &load).unwrap();
        let cuts = cuts(&frame, &solution, load.gravity_m_s2).unwrap();
        let mut sum = Sum::default();
        for load in load.at_nodes.iter().filter(|load| upper(load.node)) {
            sum.add(&frame.nodes()[load.node], &load.load);
        }
        for ((member, beam), cut) in frame.members().iter().zip(&beams).zip(&cuts) {
            let [a, b] = member.ends.map(upper);
            let [from, to] = member.ends.map(|node| frame.nodes()[node]);
            let x = beam.axes.column(0).into_owned();
            let s = 0.3 * beam.length_m;
            let place = from + x * s;
            let [start, end] = [if a { from } else { place }, if b { to } else { place }];
            if a || b {
                let weight = beam.line_load(load.gravity_m_s2) * (end - start).norm();
                sum.push(&nalgebra::center(&start, &end), &weight);
            }
            if a != b {
                let [force, moment] = cut.on_cut(&x, s).map(|v| if a { v } else { -v });
                sum.add(&place, &[force.x, force.y, force.z, moment.x, moment.y, moment.z]);
            }
        }
        worst = worst.max(sum.left());
    }
    eprintln!("a piece cut off: {worst:.1e}");
    assert!(worst < 1e-9);
}

/// The frame turned about the origin and moved.
fn turned(frame: &Frame, pose: &Pose) -> Frame {
    let nodes = frame.nodes().iter().map(|node| pose * node).collect();
    let members = frame.members().iter();
    let members = members.map(|m| Member { side: pose.rotation * m.side, ..*m }).collect();
    Frame::new(nodes, members).unwrap()
}

/// Displacements in axes that the pose turned, seen in the old ones.
fn back(pose: &Pose, displacement: &[[f64; 6]]) -> Vec<f64> {
    let of_six = |six: &[f64; 6]| {
        [0, 3].map(|k| {
            let own = pose.rotation.inverse() * Vector::new(six[k], six[k + 1], six[k + 2]);
            [own.x, own.y, own.z]
        })
    };
    displacement.iter().flat_map(of_six).flatten().collect()
}

const POSE: ([f64; 3], [f64; 3]) = ([0.3, -0.2, 0.7], [1.1, -0.4, 2.0]);

#[test]
fn a_turned_print_answers_turned() {
    let (frame, supports) = ribbons(60, 37);
    let pose = from_xyz_rpy(POSE.0, POSE.1);
    let keep: Vec<usize> = (0..60).collect();
    let ask = Ask { staged: true, keep: &keep, ..Ask::default() };
    let straight = solve_stages(&frame, &print(&frame, &supports, &Pose::identity()), ask).unwrap();
    let there = turned(&frame, &pose);
    let records = solve_stages(&there, &print(&there, &supports, &pose), ask).unwrap();
    let mut worst = 0.0f64;
    for (got, wanted) in records.iter().zip(&straight) {
        for (got, wanted) in [(&got.one_shot, &wanted.one_shot), (&got.staged, &wanted.staged)] {
            let [got, wanted] = [got, wanted].map(|state| state.as_ref().unwrap());
            let got = back(&pose, &got.displacement);
            worst = worst.max(block_gap(&got, &wanted.displacement.concat()));
        }
    }
    eprintln!("stages of a turned print: {worst:.1e}");
    assert!(worst < 1e-9);
}

#[test]
fn a_turned_frame_buckles_turned() {
    let (frame, supports) = ribbons(60, 41);
    let pose = from_xyz_rpy(POSE.0, POSE.1);
    let down = pose.rotation * Vector::new(0.0, 0.0, -9.80665);
    let ask = BucklingAsk { modes: 2, ..BucklingAsk::default() };
    let straight = buckling(&frame, &supports, &falling([0.0, 0.0, -9.80665]), ask).unwrap();
    let there = turned(&frame, &pose);
    let modes = buckling(&there, &supports, &falling(down.into()), ask).unwrap();
    for (got, wanted) in modes.iter().zip(&straight) {
        near(got.factor, wanted.factor, 1e-9);
        // a shape is found to 1e-6, and up to its sign
        let (got, wanted) = (back(&pose, &got.displacement), wanted.displacement.concat());
        let other: Vec<f64> = got.iter().map(|value| -value).collect();
        let gap = block_gap(&got, &wanted).min(block_gap(&other, &wanted));
        assert!(gap < 1e-4, "{gap:e}");
    }
}
