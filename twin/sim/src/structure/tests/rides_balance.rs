//! A frame on a moving bed: what must balance, and what a turn of the whole must not change.

use super::grows::Chance;
use super::rides::{posture, ribbons, stage};
use super::*;
use crate::structure::beam::{Beam, beams};
use crate::structure::{Ridden, Riding};

/// Every unit case: the supports carry `∫ f dm` and `∫ x × f dm` of all members.
#[test]
fn unit_cases_balance() {
    let (frame, supports) = ribbons(90, 2);
    let riding = Riding::of_stage(&frame, &stage(90, &supports)).unwrap();
    let mut chance = Chance(8);
    let beams = beams(&frame);
    for _ in 0..20 {
        let at = posture(&mut chance);
        let all: Vec<usize> = (0..90).collect();
        let [mut force, mut moment] = carried(&frame, &beams, &all, &at);
        let size = [force.norm(), moment.norm()];
        for (support, six) in supports.iter().zip(riding.reactions(&at)) {
            let own = Vector::new(six[0], six[1], six[2]);
            force += own;
            moment += frame.nodes()[support.node].coords.cross(&own);
            moment += Vector::new(six[3], six[4], six[5]);
        }
        assert!(force.norm() < 1e-9 * size[0], "{force} of {}", size[0]);
        assert!(moment.norm() < 1e-9 * size[1], "{moment} of {}", size[1]);
    }
}

/// Force and moment about the origin of what some members feel, by Simpson's rule: exact here.
fn carried(frame: &Frame, beams: &[Beam], members: &[usize], at: &Ridden) -> [Vector; 2] {
    let (mut force, mut moment) = (Vector::zeros(), Vector::zeros());
    for &member in members {
        let [a, b] = frame.members()[member].ends.map(|node| frame.nodes()[node].coords);
        let mass_kg = beams[member].line_kg_per_m * beams[member].length_m;
        for (x, share) in [(a, 1.0), ((a + b) / 2.0, 4.0), (b, 1.0)] {
            let own = at.at_m_s2(&x) * (mass_kg * share / 6.0);
            force += own;
            moment += x.cross(&own);
        }
    }
    [force, moment]
}

/// A cut through a frame, through members half way: what the lower piece hands over holds the upper
/// one.
#[test]
fn a_cut_off_piece_balances() {
    let (frame, supports) = ribbons(90, 5);
    let riding = Riding::of_stage(&frame, &stage(90, &supports)).unwrap();
    let beams = beams(&frame);
    let mut chance = Chance(6);
    // upper: nodes above the middle one that no support holds
    let middle_m = frame.nodes()[frame.nodes().len() / 2].z;
    let upper = |node: usize| {
        frame.nodes()[node].z > middle_m && supports.iter().all(|support| support.node != node)
    };
    for _ in 0..20 {
        let at = posture(&mut chance);
        let (mut sum, mut about) = (Vector::zeros(), Vector::zeros());
        let mut sizes = [0.0; 2];
        for (member, each) in frame.members().iter().enumerate() {
            let [a, b] = each.ends.map(upper);
            let beam = &beams[member];
            let x = beam.axes.column(0).into_owned();
            let [from, to] = each.ends.map(|node| frame.nodes()[node].coords);
            if a && b {
                let [force, moment] = carried(&frame, &beams, &[member], &at);
                (sum, about) = (sum + force, about + moment);
            } else if a || b {
                // the half that belongs to the upper piece, and what acts on its cut
                let s = 0.3 * beam.length_m;
                let place = from + x * s;
                let half = if a { [from, place] } else { [place, to] };
                let mass_kg = beam.line_kg_per_m * (half[1] - half[0]).norm();
                for (x, share) in [(half[0], 1.0), ((half[0] + half[1]) / 2.0, 4.0), (half[1], 1.0)]
                {
                    let own = at.at_m_s2(&x) * (mass_kg * share / 6.0);
                    (sum, about) = (sum + own, about + x.cross(&own));
                }
                let [force, moment] = riding.cut(member, &at).on_cut(&x, s);
                let sign = if a { 1.0 } else { -1.0 };
                sum += force * sign;
                about += (moment + place.cross(&force)) * sign;
                sizes[0] += force.norm();
                sizes[1] += (moment + place.cross(&force)).norm();
            }
        }
        assert!(sum.norm() < 1e-9 * sizes[0], "{sum} of {}", sizes[0]);
        assert!(about.norm() < 1e-9 * sizes[1], "{about} of {}", sizes[1]);
    }
}

/// Turn the frame with its motion: the answer turns with it.
#[test]
fn a_turned_ride_answers_turned() {
    let (frame, supports) = ribbons(60, 13);
    let straight = Riding::of_stage(&frame, &stage(60, &supports)).unwrap();
    let mut chance = Chance(21);
    for rpy in [[1.1, -0.4, 2.0], [0.0, 3.0, -1.0]] {
        // turned about the origin: a place keeps its distance from it
        let turn = crate::pose::from_xyz_rpy([0.0; 3], rpy);
        let nodes = frame.nodes().iter().map(|node| turn * node).collect();
        let members = frame.members().iter();
        let members = members.map(|m| Member { side: turn.rotation * m.side, ..*m }).collect();
        let turned = Frame::new(nodes, members).unwrap();
        let riding = Riding::of_stage(&turned, &stage(60, &supports)).unwrap();
        for _ in 0..5 {
            let at = posture(&mut chance);
            let of = |v: Vector| turn.rotation * v;
            let there = Ridden {
                specific_m_s2: of(at.specific_m_s2),
                alpha_rad_s2: of(at.alpha_rad_s2),
                omega_rad_s: of(at.omega_rad_s),
            };
            let back = |six: [f64; 6]| {
                [0, 3].map(|k| {
                    let own = turn.rotation.inverse() * Vector::new(six[k], six[k + 1], six[k + 2]);
                    [own.x, own.y, own.z]
                })
            };
            let got: Vec<f64> =
                riding.displacements(&there).into_iter().flat_map(back).flatten().collect();
            assert!(block_gap(&got, &straight.displacements(&at).concat()) < 1e-9);
        }
    }
}
