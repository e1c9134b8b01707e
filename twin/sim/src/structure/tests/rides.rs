//! A frame on a moving bed: unit cases against direct solves, brute force, and what must balance.

use super::grows::{Chance, grown};
use super::*;
use crate::structure::beam::beams;
use crate::structure::riding::line_ends;
use crate::structure::solve::{Held, add_ends, by_node};
use crate::structure::{
    Ridden, Riding, Solution, Stage, Strength, ride_stages, solve, utilisation,
};

const DOWN: [f64; 3] = [0.0, 0.0, -9.80665];

pub(super) fn stage(born: usize, supports: &[Support]) -> Stage {
    Stage { born, supports: supports.to_vec(), gravity_m_s2: DOWN, ..Stage::default() }
}

/// A posture of an arm that moves fast: g and 5 m/s², 50 rad/s², 5 rad/s.
pub(super) fn posture(chance: &mut Chance) -> Ridden {
    let mut any = |size: f64| Vector::from_fn(|_, _| size * (2.0 * chance.next() - 1.0));
    Ridden {
        specific_m_s2: any(9.80665) + any(5.0),
        alpha_rad_s2: any(50.0),
        omega_rad_s: any(5.0),
    }
}

/// Flat, sheared members far from the origin, so that each law has its say.
pub(super) fn ribbons(members: usize, seed: u64) -> (Frame, Vec<Support>) {
    let (frame, supports) = grown(members, seed);
    let away = Vector::new(0.15, -0.1, 0.05);
    let nodes = frame.nodes().iter().map(|node| node + away).collect();
    let flat = Section::ellipse(3e-3, 1.2e-3).sheared(0.85);
    let members = frame.members().iter();
    let members = members.map(|m| Member { section: flat, side: Vector::z(), ..*m }).collect();
    (Frame::new(nodes, members).unwrap(), supports)
}

/// One solve under the whole load, by the other factorisation.
fn direct(frame: &Frame, supports: &[Support], at: &Ridden) -> (Vec<f64>, Vec<f64>) {
    let mut forces = vec![0.0; 6 * frame.nodes().len()];
    let load = |(member, beam): (&Member, &crate::structure::beam::Beam)| {
        let ends = member.ends.map(|node| at.at_m_s2(&frame.nodes()[node].coords));
        line_ends(beam, &ends.map(|field| field * beam.line_kg_per_m))
    };
    let beams = beams(frame);
    let loads: Vec<_> = frame.members().iter().zip(&beams).map(load).collect();
    for (member, load) in frame.members().iter().zip(&loads) {
        add_ends(&mut forces, member, load);
    }
    let u = Held::new(frame, supports).unwrap().displacement(&forces);
    let mut first_ends = Vec::new();
    for ((member, beam), load) in frame.members().iter().zip(&beams).zip(&loads) {
        let ends = beam.stiffness * crate::structure::solve::ends_of(&u, member) - load;
        first_ends.extend(ends.iter().take(6));
    }
    (u, first_ends)
}

/// Row 9: twelve unit cases combined against a direct solve at 50 random postures.
#[test]
fn unit_cases_are_direct_solves() {
    let (frame, supports) = ribbons(120, 7);
    let riding = Riding::of_stage(&frame, &stage(120, &supports)).unwrap();
    assert!(riding.residual() < 1e-10, "{}", riding.residual());
    let mut chance = Chance(50);
    let mut worst = [0.0f64; 2];
    for _ in 0..50 {
        let at = posture(&mut chance);
        let (u, first_ends) = direct(&frame, &supports, &at);
        let got: Vec<f64> = riding.displacements(&at).concat();
        worst[0] = worst[0].max(block_gap(&got, &u));
        let got: Vec<f64> = (0..120).flat_map(|member| riding.first_end(member, &at)).collect();
        worst[1] = worst[1].max(block_gap(&got, &first_ends));
        let far = riding.farthest(&at);
        let six = riding.displacement(far.node, &at);
        near(far.translation_m, Vector::new(six[0], six[1], six[2]).norm(), 1e-14);
        let most = by_node(&u).into_iter().map(|six| Vector::new(six[0], six[1], six[2]).norm());
        near(far.translation_m, most.fold(0.0, f64::max), 1e-9);
        assert!(far.translation_m <= riding.bound_m(&at) * (1.0 + 1e-12));
    }
    eprintln!(
        "unit cases against direct solves at 50 postures: displacement {:.1e}, end forces {:.1e}; \
         residual {:.1e}",
        worst[0],
        worst[1],
        riding.residual()
    );
    assert!(worst.iter().all(|gap| *gap < 1e-9));
}

/// At rest a posture is gravity alone, as [`solve`] has it, with its utilisation.
#[test]
fn at_rest_it_is_weight() {
    let (frame, supports) = ribbons(90, 11);
    let riding = Riding::of_stage(&frame, &stage(90, &supports)).unwrap();
    let strength = Strength { tension_pa: 30e6, compression_pa: 40e6 };
    let strengths = vec![strength; 90];
    for gravity in [DOWN, [3.0, -8.0, 5.0]] {
        let wanted = solve(&frame, &supports, &falling(gravity)).unwrap();
        let at = Ridden::at_rest(Vector::from(gravity));
        let got = riding.displacements(&at).concat();
        assert!(block_gap(&got, &wanted.displacement.concat()) < 1e-9);
        assert!(block_gap(&riding.reactions(&at).concat(), &wanted.reactions.concat()) < 1e-9);
        let used = riding.utilisation(&at, &strengths).unwrap().unwrap();
        let wanted = utilisation(&frame, &strengths, &wanted, gravity).unwrap().unwrap();
        near(used.value, wanted.value, 1e-9);
        assert_eq!((used.member, used.governs), (wanted.member, wanted.governs));
    }
}

/// Members cut into pieces with their mass at the nodes: the second order, towards the unit cases.
#[test]
fn pieces_with_lumped_mass_converge() {
    let nodes = [[0.0, 0.0, 0.0], [0.03, 0.01, 0.05], [-0.02, 0.04, 0.06], [0.05, 0.05, 0.0]];
    let nodes: Vec<Point> = nodes.iter().map(|p| Point::new(p[0] + 0.1, p[1], p[2])).collect();
    let flat = Section::ellipse(3e-3, 1.2e-3).sheared(0.85);
    let members = [[0, 1], [1, 2], [3, 1]];
    let members = members.map(|ends| Member { section: flat, side: Vector::x(), ..rod(ends) });
    let frame = Frame::new(nodes, members.to_vec()).unwrap();
    let supports = clamped([0, 3]);
    let riding = Riding::of_stage(&frame, &stage(3, &supports)).unwrap();
    let mut chance = Chance(4);
    for _ in 0..3 {
        let at = posture(&mut chance);
        let got = riding.displacements(&at).concat();
        let gaps = [50, 100, 200].map(|pieces| {
            let lumped = lumped(&frame, &supports, &at, pieces);
            let wanted = lumped.displacement[..4].concat();
            block_gap(&got, &wanted)
        });
        eprintln!(
            "lumped in 50, 100, 200 pieces: off by {:.1e}, {:.1e}, {:.1e}",
            gaps[0], gaps[1], gaps[2]
        );
        assert!(gaps[2] < 1e-4);
        for pair in gaps.windows(2) {
            assert!((3.6..4.4).contains(&(pair[0] / pair[1])), "second order");
        }
    }
}

fn lumped(frame: &Frame, supports: &[Support], at: &Ridden, pieces: usize) -> Solution {
    let mut cut = frame.clone();
    for member in 0..frame.members().len() {
        for piece in 0..pieces - 1 {
            let fraction = 1.0 / (pieces - piece) as f64;
            cut = cut.split(member * pieces + piece, fraction).unwrap().0;
        }
    }
    let mut mass_kg = vec![0.0; cut.nodes().len()];
    for member in cut.members() {
        let [a, b] = member.ends.map(|node| cut.nodes()[node]);
        for node in member.ends {
            mass_kg[node] += member.density_kg_m3 * member.section.area_m2 * (b - a).norm() / 2.0;
        }
    }
    let of_node = |(node, mass_kg): (usize, &f64)| {
        let force = at.at_m_s2(&cut.nodes()[node].coords) * *mass_kg;
        NodeLoad { node, load: [force.x, force.y, force.z, 0.0, 0.0, 0.0] }
    };
    let at_nodes = mass_kg.iter().enumerate().map(of_node).collect();
    solve(&cut, supports, &Load { at_nodes, ..Load::default() }).unwrap()
}

/// Stages one after another, by updates, are the stages each on its own; unborn and floating nodes
/// stay, and a mechanism is told.
#[test]
fn stages_in_a_row() {
    let (frame, supports) = ribbons(60, 9);
    let stages: Vec<Stage> = [6, 7, 20, 59, 60]
        .map(|born| Stage {
            stiffness: vec![0.3 + 0.01 * born as f64; 60],
            ..stage(born, &supports)
        })
        .to_vec();
    let at = posture(&mut Chance(1));
    let mut seen = 0;
    ride_stages(&frame, &stages, |index, riding| {
        let riding = riding.unwrap();
        let alone = Riding::of_stage(&frame, &stages[index]).unwrap();
        let [got, wanted] = [&riding, &alone].map(|riding| riding.displacements(&at).concat());
        assert!(block_gap(&got, &wanted) < 1e-9);
        let born = &frame.members()[..stages[index].born];
        for (node, six) in riding.displacements(&at).iter().enumerate() {
            assert!(*six == [0.0; 6] || born.iter().any(|m| m.ends.contains(&node)));
        }
        seen += 1;
    })
    .unwrap();
    assert_eq!(seen, stages.len());
    let swings = vec![Support::pinned(0)];
    let one = chain(Vector::x(), 0.1, 2);
    assert!(Riding::of_stage(&one, &stage(2, &swings)).is_err());
    let apart = Frame::new(
        [[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.0, 0.1], [0.1, 0.0, 0.1]].map(Point::from).to_vec(),
        vec![rod([0, 1]), rod([2, 3])],
    )
    .unwrap();
    let riding = Riding::of_stage(&apart, &stage(2, &clamped([0]))).unwrap();
    assert_eq!(riding.displacement(3, &at), [0.0; 6]);
    assert_eq!(riding.first_end(1, &at), [0.0; 6]);
    assert!(riding.displacement(1, &at) != [0.0; 6]);
}
