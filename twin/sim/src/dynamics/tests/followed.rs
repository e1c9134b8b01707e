//! rapier's multibody against what can be worked by hand, and against our own dynamics.

use std::f64::consts::TAU;

use super::drives::{DriveFault, Drives, FeedForward, Followed, Gains, Multibody, Watched};
use super::*;
use crate::pose::Point;

/// Followed at the tip.
fn follow(
    model: &Model,
    drives: &Drives,
    motion: &[Timed],
    window_s: (f64, f64),
) -> Result<Followed, DriveFault> {
    drives::follow(model, drives, motion, window_s, &Watched::OnTip(Point::origin()))
}

/// A swing of 0.02 rad; closed form `2π √((I + m l²)/(m g l)) (1 + φ²/16)`.
#[test]
fn a_pendulum_swings_in_its_time() {
    let (mass, length, inertia) = (2.0, 0.5, 0.05);
    let (_, model) = pendulum(1, mass, length, inertia);
    let swing = 0.02;
    let expected = TAU
        * ((inertia + mass * length * length) / (mass * 9.806_65 * length)).sqrt()
        * (1.0 + swing * swing / 16.0);
    let step_s = 5e-4;
    let mut arm = Multibody::new(&model, &[swing], &[0.0], step_s).unwrap();
    let (mut before, mut t_s, mut crossings) = (swing, 0.0, Vec::new());
    while crossings.len() < 21 {
        arm.step();
        let now = arm.q()[0];
        if (now > 0.0) != (before > 0.0) {
            crossings.push(t_s + step_s * before / (before - now));
        }
        (before, t_s) = (now, t_s + step_s);
        assert!(t_s < 60.0, "does not swing");
    }
    let period = (crossings[20] - crossings[0]) / 10.0;
    println!("period {period:.6} s, closed form {expected:.6} s");
    assert!((period / expected - 1.0).abs() < 2e-4, "{period} {expected}");
}

/// Two links let go: the first step's acceleration is `M⁻¹ (−τ_g)`, by hand for the double
/// pendulum.
#[test]
fn two_links_begin_to_fall_as_they_should() {
    let (mass, length) = (1.5, 0.4);
    let (_, model) = pendulum(2, mass, length, 0.01);
    let q = [0.9, -0.5];
    let step_s = 1e-3;
    let mut arm = Multibody::new(&model, &q, &[0.0, 0.0], step_s).unwrap();
    arm.step();
    let fall = arm.qd();
    let (unit, weight, cos) = (mass * length * length, mass * 9.806_65 * length, q[1].cos());
    let (m11, m12, m22) = (unit * (3.0 + 2.0 * cos) + 0.02, unit * (1.0 + cos) + 0.01, unit + 0.01);
    let outer = weight * (q[0] + q[1]).sin();
    let inner = outer + 2.0 * weight * q[0].sin();
    let determinant = m11 * m22 - m12 * m12;
    let by_hand =
        [(m12 * outer - m22 * inner) / determinant, (m12 * inner - m11 * outer) / determinant];
    let ours = model.accelerations(&q, &[0.0; 2], &[0.0; 2]).unwrap();
    for joint in 0..2 {
        assert!((ours[joint] / by_hand[joint] - 1.0).abs() < 1e-12);
        let theirs = fall[joint] / step_s;
        assert!((theirs / by_hand[joint] - 1.0).abs() < 1e-5, "{theirs} {}", by_hand[joint]);
    }
}

/// Greatest difference of rapier's accelerations over its first step from ours, as a share of the
/// greatest.
fn disagreement(model: &Model, states: usize, step_s: f64) -> f64 {
    let mut random = Random(41);
    let dof = model.dof();
    let mut worst = 0.0_f64;
    for _ in 0..states {
        let (q, qd) = (random_vector(dof, 2.0, &mut random), random_vector(dof, 1.0, &mut random));
        let ours = model.accelerations(&q, &qd, &vec![0.0; dof]).unwrap();
        let mut arm = Multibody::new(model, &q, &qd, step_s).unwrap();
        let before = arm.qd();
        arm.step();
        let after = arm.qd();
        let greatest = ours.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        for joint in 0..dof {
            let theirs = (after[joint] - before[joint]) / step_s;
            worst = worst.max((theirs - ours[joint]).abs() / greatest);
        }
    }
    worst
}

/// All joints, all terms: gravity, centrifugal, Coriolis, gyroscopic. rapier's step is implicit in
/// the last three, so the difference falls with the step, until `f32` ends it.
#[test]
fn arms_accelerate_in_rapier_as_in_our_own_dynamics() {
    use JointKind::{Prismatic, Revolute};
    let load = Body::cuboid(2.0, Vector::new(0.1, 0.1, 0.2), &Pose::translation(0.02, 0.0, 0.1));
    let (chain, bodies) = random_arm(&[Prismatic, Revolute, Prismatic, Revolute], &mut Random(6));
    let mixed = Model::new(&chain, &bodies, EARTH).unwrap();
    let geared = arm(KR6).1.with_rotors(&[2.0, 3.0, 1.0, 0.1, 0.2, 0.05]);
    let arms =
        [(KR6, arm(KR6).1), (UR10E, arm(UR10E).1), ("mixed", mixed), ("with rotors", geared)];
    for (name, model) in arms {
        let model = model.with_payload(&load).with_gravity(Vector::new(3.0, -4.0, 8.0));
        let [coarse, fine] = [1e-3, 1e-4].map(|step_s| disagreement(&model, 100, step_s));
        println!("{name}: accelerations differ by {coarse:.1e} at 1 ms, {fine:.1e} at 0.1 ms");
        assert!(coarse < 2e-2 && fine < 2e-3 && fine < 0.3 * coarse, "{name}: {coarse} {fine}");
    }
}

/// A point at rest sees the same error as the point on the tip that should be there.
#[test]
fn a_bed_on_the_flange_is_watched_where_the_nozzle_stands() {
    let (_, model) = arm(KR6);
    let q = [0.3, -1.2, 1.0, 0.4, 0.7, -0.2];
    let gains = Gains::for_posture(&model, &q, 12.0, 0.7);
    let drives = Drives { gains, feed_forward: FeedForward::None, step_s: 1e-3 };
    let on_tip = Point::new(0.02, -0.03, 0.15);
    let at_rest = model.tip(&q) * on_tip;
    let [one, other] = [Watched::OnTip(on_tip), Watched::AtRest(at_rest)]
        .map(|watched| drives::follow(&model, &drives, &held(&q), (0.0, 0.1), &watched).unwrap());
    for (a, b) in one.steps.iter().zip(&other.steps) {
        assert!(a.offset.norm() > 1e-3 && (a.offset - b.offset).norm() < 1e-12);
    }
}

fn held(q: &[f64]) -> Vec<Timed> {
    vec![Timed { t_s: 0.0, state: State::at_rest(q) }]
}

/// Springs without feed-forward: the joints droop by `τ_g / k`, the tip by what that gives.
#[test]
fn an_arm_on_springs_droops_by_gravity_over_stiffness() {
    let (_, model) = arm(KR6);
    let q = [0.3, -1.2, 1.0, 0.4, 0.7, -0.2];
    let gains = Gains::for_posture(&model, &q, 12.0, 0.7);
    let drives = Drives { gains, feed_forward: FeedForward::None, step_s: 1e-3 };
    let followed = follow(&model, &drives, &held(&q), (0.0, 1.0)).unwrap();
    let at = followed.steps.last().unwrap().q;
    let torques = model.holding_torques(&at);
    for joint in 0..6 {
        let (droop, expected) = (q[joint] - at[joint], torques[joint] / gains.stiffness[joint]);
        println!("joint {joint}: droop {droop:.3e} rad, τ/k {expected:.3e} rad");
        assert!((droop - expected).abs() < 1e-3 * expected.abs() + 3e-6, "{droop} {expected}");
        let share = followed.torque[joint] / torques[joint].abs().max(0.05);
        assert!((share - 1.0).abs() < 0.05 || torques[joint].abs() < 0.05, "{joint}: {share}");
    }
    let fed = Drives { feed_forward: FeedForward::Gravity, ..drives };
    let followed = follow(&model, &fed, &held(&q), (0.0, 0.5)).unwrap();
    println!("held with gravity fed forward: {:.1e} m", followed.greatest().0);
    assert!(followed.greatest().0 < 5e-6, "{:?}", followed.greatest());
}

/// One joint let go off its rest: frequency and decay are those asked for.
#[test]
fn a_drive_rings_at_its_frequency() {
    let (_, model) = pendulum(1, 2.0, 0.5, 0.05);
    let model = model.with_gravity(Vector::zeros());
    let (hertz, ratio) = (4.0, 0.1);
    let gains = Gains::for_posture(&model, &[0.0], hertz, ratio);
    let step_s = 1e-4;
    let mut arm = Multibody::new(&model, &[0.1], &[0.0], step_s).unwrap();
    let rest = State::at_rest(&[0.0]);
    let damped = TAU * hertz * (1.0_f64 - ratio * ratio).sqrt();
    let mut worst = 0.0_f64;
    for step in 1..=5000 {
        arm.set_drives(&gains, &rest, &JointVector::zeros(1));
        arm.step();
        let t = f64::from(step) * step_s;
        let decay = ratio * TAU * hertz;
        let law =
            0.1 * (-decay * t).exp() * ((damped * t).cos() + decay / damped * (damped * t).sin());
        worst = worst.max((arm.q()[0] - law).abs());
    }
    println!("worst {worst:.1e} rad of 0.1");
    assert!(worst < 5e-4, "{worst}");
}

/// A swing of joint 1 and 2 that starts and stops smoothly within 0.5 s.
fn swing(q: &[f64; 6]) -> Vec<Timed> {
    let moment = |k: u32| {
        let t_s = f64::from(k) * 0.005;
        let u = (t_s / 0.5).min(1.0);
        let mut state = State::at_rest(q);
        let rise = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
        let speed = 30.0 * u * u * (1.0 - u) * (1.0 - u) / 0.5;
        let rate = 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / 0.25;
        for (joint, size) in [(0, 0.6), (1, -0.3)] {
            state.q[joint] += size * rise;
            state.qd[joint] = size * speed;
            state.qdd[joint] = size * rate;
        }
        Timed { t_s, state }
    };
    (0..=100).map(moment).collect()
}

#[test]
fn stiffer_drives_follow_closer_and_settle_sooner() {
    let (_, model) = arm(KR6);
    let q = [0.0, -1.2, 1.3, 0.0, 0.6, 0.0];
    let motion = swing(&q);
    let mut last = (f64::INFINITY, f64::INFINITY);
    for hertz in [6.0, 12.0, 24.0] {
        let gains = Gains::for_posture(&model, &q, hertz, 0.7);
        let drives = Drives { gains, feed_forward: FeedForward::Gravity, step_s: 5e-4 };
        let followed = follow(&model, &drives, &motion, (0.0, 1.5)).unwrap();
        let (greatest, _) = followed.greatest();
        let settling = followed.settling_s(0.5, 1e-4).unwrap();
        println!(
            "{hertz} Hz: {:.3} mm, rms {:.3} mm, settles in {:.0} ms",
            greatest * 1e3,
            followed.rms_m() * 1e3,
            settling * 1e3
        );
        assert!(greatest < last.0 && settling < last.1);
        assert_eq!(followed, follow(&model, &drives, &motion, (0.0, 1.5)).unwrap());
        last = (greatest, settling);
        // The error is that of the drives and not of the plan: fed with the whole torque, little is
        // left.
        let fed = Drives { feed_forward: FeedForward::Motion, ..drives };
        let fed = follow(&model, &fed, &motion, (0.0, 1.5)).unwrap();
        println!("{hertz} Hz, all fed forward: {:.4} mm", fed.greatest().0 * 1e3);
        assert!(fed.greatest().0 < 0.1 * greatest);
        // What the drives then give is what our own dynamics asks for.
        for peak in torque_peaks(&model, &[], &motion) {
            let theirs = fed.torque[peak.joint];
            assert!((theirs - peak.torque.abs()).abs() < 0.05 * peak.torque.abs() + 0.5);
        }
    }
}

#[test]
fn stretches_that_cannot_be_followed_are_refused() {
    let (_, model) = arm(KR6);
    let q = [0.0; 6];
    let gains = Gains::for_posture(&model, &q, 10.0, 0.7);
    let drives = Drives { gains, feed_forward: FeedForward::None, step_s: 1e-3 };
    let fault = |drives: &Drives, motion: &[Timed], window| {
        follow(&model, drives, motion, window).unwrap_err()
    };
    assert_eq!(fault(&drives, &[], (0.0, 1.0)), DriveFault::NoMotion);
    assert_eq!(fault(&drives, &held(&[0.0]), (0.0, 1.0)), DriveFault::NoMotion);
    for (window, step_s) in
        [((1.0, 0.0), 1e-3), ((0.0, 1.0), 0.0), ((0.0, 1e9), 1e-3), ((0.0, f64::NAN), 1e-3)]
    {
        let drives = Drives { step_s, ..drives };
        assert!(matches!(fault(&drives, &held(&q), window), DriveFault::Steps { .. }));
    }
    let mut limp = drives;
    limp.gains.stiffness[2] = 0.0;
    assert_eq!(fault(&limp, &held(&q), (0.0, 1.0)), DriveFault::Gains { joint: 2 });
}
