//! Members that turn, in closed form.

use super::*;
use crate::structure::{Ridden, Riding, Stage};

fn stage(born: usize, supports: Vec<Support>) -> Stage {
    Stage { born, supports, gravity_m_s2: [0.0; 3], at_nodes: Vec::new(), ..Stage::default() }
}

fn turning(alpha_rad_s2: Vector, omega_rad_s: Vector) -> Ridden {
    Ridden { alpha_rad_s2, omega_rad_s, ..Ridden::at_rest(Vector::zeros()) }
}

/// A rod that turns about its foot: `u(L) = ρ ω² L³/(3 E)`, and `N(0) = ρ A ω² L²/2`, in one member
/// as in seven.
#[test]
fn a_turning_rod_stretches() {
    let omega = 30.0;
    for count in [1, 7] {
        let frame = chain(Vector::z(), 0.2, count);
        let riding = Riding::of_stage(&frame, &stage(count, clamped([0]))).unwrap();
        let at = turning(Vector::zeros(), Vector::new(0.0, omega, 0.0));
        let tip = riding.displacement(count, &at);
        near(tip[2], 1240.0 * omega * omega * 0.2f64.powi(3) / (3.0 * 3.5e9), 1e-12);
        // nothing across, and about its own axis nothing at all
        assert!(tip[0].abs() < 1e-12 * tip[2] && tip[1].abs() < 1e-12 * tip[2]);
        let about = riding.displacement(count, &turning(Vector::zeros(), Vector::z() * omega));
        assert_eq!(about, [0.0; 6]);
        let area = Section::circle(2e-3).area_m2;
        let reaction = riding.reactions(&at)[0];
        near(reaction[2], -1240.0 * area * omega * omega * 0.02, 1e-12);
    }
}

/// A cantilever that starts to turn about its foot: the load grows with the distance, `w₀ = ρ A α L`
/// at the tip, which moves by `11 w₀ L⁴/(120 E I)`, with shear by `w₀ L²/(3 κ G A)` more, and turns by
/// `w₀ L³/(8 E I)`.
#[test]
fn a_cantilever_that_starts_to_turn() {
    let alpha = 50.0;
    for count in [1, 3] {
        for kappa in [f64::INFINITY, 0.9, 1e-3] {
            let frame = chain(Vector::x(), 0.2, count);
            let sheared = |m: &Member| Member { section: m.section.sheared(kappa), ..*m };
            let members: Vec<Member> = frame.members().iter().map(sheared).collect();
            let frame = Frame::new(frame.nodes().to_vec(), members).unwrap();
            let riding = Riding::of_stage(&frame, &stage(count, clamped([0]))).unwrap();
            let tip = riding.displacement(count, &turning(Vector::z() * alpha, Vector::zeros()));
            let Member { section, elastic, .. } = frame.members()[0];
            let ei = elastic.e_pa * section.iz_m4;
            let w = 1240.0 * section.area_m2 * alpha * 0.2;
            let bent = 11.0 * w * 0.2f64.powi(4) / (120.0 * ei);
            let slid = w * 0.04 / (3.0 * kappa * elastic.g_pa * section.area_m2);
            near(tip[1], -(bent + slid), 1e-10);
            near(tip[5], -w * 0.2f64.powi(3) / (8.0 * ei), 1e-10);
        }
    }
}

/// A rod held at both ends that starts to turn about its middle: nodes that do not move, so only the
/// loads at the ends tell. With φ = 12 E I/(κ G A L²) the moment at an end is
/// `w L²/(60 (1+φ))` and the force `w L (6+5φ)/(30 (1+φ))`.
#[test]
fn held_at_both_ends() {
    for kappa in [f64::INFINITY, 0.9, 1e-4] {
        let section = Section::ellipse(4e-3, 2e-3).sheared(kappa);
        let rod = Member { section, side: Vector::y(), ..rod([0, 1]) };
        let nodes = vec![Point::new(-0.05, 0.0, 0.0), Point::new(0.05, 0.0, 0.0)];
        let frame = Frame::new(nodes, vec![rod]).unwrap();
        let riding = Riding::of_stage(&frame, &stage(1, clamped([0, 1]))).unwrap();
        for (alpha, second_moment_m4) in
            [(Vector::z(), section.iz_m4), (Vector::y(), section.iy_m4)]
        {
            let phi = 12.0 * rod.elastic.e_pa * second_moment_m4
                / (kappa * rod.elastic.g_pa * section.area_m2 * 0.01);
            // at the second end the load is ρ A |α| 0.05 m, against α × x
            let w = 1240.0 * section.area_m2 * 0.05;
            let load = -alpha.cross(&Vector::x()) * w;
            let [first, second] = riding.reactions(&turning(alpha, Vector::zeros()))[..] else {
                panic!("two supports")
            };
            let force = load * (-0.1 * (6.0 + 5.0 * phi) / (30.0 * (1.0 + phi)));
            let moment = Vector::x().cross(&load) * (0.01 / (60.0 * (1.0 + phi)));
            let of = |force: Vector| [force.x, force.y, force.z, moment.x, moment.y, moment.z];
            assert!(block_gap(&second, &of(force)) < 1e-12, "{second:?}");
            assert!(block_gap(&first, &of(-force)) < 1e-12, "{first:?}");
        }
    }
}

/// Held in place, and in its turn about x.
fn pinned_foot() -> Support {
    Support { node: 0, fixed: [true, true, true, true, false, false] }
}

/// Where a member is used most under a load that is not uniform, against a fine look along it.
#[test]
fn stations_of_a_linear_load() {
    use crate::structure::Strength;
    let strength = Strength { tension_pa: 50e6, compression_pa: 60e6 };
    let mut chance = super::grows::Chance(3);
    let mut any = |size: f64| Vector::from_fn(|_, _| size * (2.0 * chance.next() - 1.0));
    let mut least = [1.0f64; 2];
    for case in 0..200 {
        let fine = 256;
        // held at both ends, or only in place, where it is used most between them
        let (from, held) = (any(0.2), case % 2 == 0);
        let step = Vector::x() * (0.1 / fine as f64);
        let supports = |last: usize| {
            if held { clamped([0, last]) } else { vec![pinned_foot(), Support::pinned(last)] }
        };
        let node = |k: usize| Point::from(from + step * k as f64);
        let whole = Frame::new(vec![node(0), node(fine)], vec![rod([0, 1])]).unwrap();
        let at =
            Ridden { specific_m_s2: any(10.0), alpha_rad_s2: any(200.0), omega_rad_s: any(20.0) };
        let used = Riding::of_stage(&whole, &stage(1, supports(1))).unwrap();
        let used = used.utilisation(&at, &[strength]).unwrap().unwrap();
        let members = (0..fine).map(|k| rod([k, k + 1])).collect();
        let cut = Frame::new((0..=fine).map(node).collect(), members).unwrap();
        let cut = Riding::of_stage(&cut, &stage(fine, supports(fine))).unwrap();
        let wanted = cut.utilisation(&at, &vec![strength; fine]).unwrap().unwrap();
        // bond 1: what counts at an end counts anywhere
        least[case % 2] = least[case % 2].min(used.value / wanted.value);
        assert!(used.value <= wanted.value * (1.0 + 1e-6), "{case}: {used:?} {wanted:?}");
    }
    eprintln!("stations find {least:.6?} of the largest or more, held and pinned");
    assert!(least.iter().all(|least| *least > 0.99));
}
