//! Nearness to singularities and limits.

use super::*;

#[test]
fn measures_are_zero_where_the_arm_is_singular() {
    let Some(arm) = arm("kuka_kr6r900sixx", "tool0", &[]) else { return };
    // A3 stretched is at -atan(35/420) from zero (reference: 4.76°).
    let straight = (0.035_f64 / 0.42).atan();
    let q = [0.1, -1.0, 1.2, 0.3, 0.4, 0.5];
    let near = nearness(&arm, &q);
    assert!((near.wrist_rad.unwrap() - 0.4).abs() < 1e-12);
    let elbow = near.elbow_rad.unwrap();
    let expected = [(1.2 - straight).abs(), (1.2 + straight).abs()];
    assert!(expected.iter().any(|value| (elbow - value).abs() < 1e-9), "{elbow}");
    for (joint, value) in [(4, 0.0), (2, straight), (2, -straight)] {
        let mut at = q;
        at[joint] = value;
        let near = nearness(&arm, &at);
        let measure = near.wrist_rad.unwrap().min(near.elbow_rad.unwrap());
        assert_eq!(measure < 1e-12, near.condition > 1e12, "{joint} {value} {near:?}");
    }
    let sharp = [q[0], q[1], straight, q[3], q[4], q[5]];
    let other = [q[0], q[1], -straight, q[3], q[4], q[5]];
    let least = |q: &[f64]| nearness(&arm, q).elbow_rad.unwrap();
    assert!(least(&sharp).min(least(&other)) < 1e-12);
}

#[test]
fn wrist_centre_distance_is_measured_from_axis_one() {
    let Some(arm) = arm("kuka_kr10r1100sixx", "tool0", &[]) else { return };
    let mut random = Xorshift::new(2);
    let mut poses = Vec::new();
    for _ in 0..50 {
        let q = random_q(&arm.chain, &mut random);
        arm.chain.link_poses(&q, &mut poses);
        let centre = poses[4].translation.vector;
        let distance = nearness(&arm, &q).shoulder_m.unwrap();
        assert!((distance - centre.x.hypot(centre.y)).abs() < 1e-12);
    }
}

#[test]
fn seven_joint_measures() {
    let Some(arm) = arm("motoman_sda10f", "arm_left_link_tool0", &[("torso_joint_b1", 0.0)]) else {
        return;
    };
    let near = nearness(&arm, &[0.3, 0.5, -0.4, 0.9, 0.2, -0.7, 0.6]);
    assert!((near.shoulder_rad.unwrap() - 0.5).abs() < 1e-9);
    assert!((near.elbow_rad.unwrap() - 0.9).abs() < 1e-9);
    assert!((near.wrist_rad.unwrap() - 0.7).abs() < 1e-9);
    assert!(near.condition > 1.0 && near.condition < 100.0);
    let straight = nearness(&arm, &[0.3, 0.5, -0.4, 0.0, 0.2, -0.7, 0.6]);
    assert!(straight.elbow_rad.unwrap() < 1e-12 && straight.condition > 1e12);
}

#[test]
fn margins_count_from_the_nearer_limit() {
    let chain = super::forward::mixed_chain();
    let margins = limit_margins(&chain, &[0.9, 0.0, -1.5]);
    let expected = [0.1, 0.375, -0.5];
    assert!(margins.distance(&expected) < 1e-12, "{margins:?}");
}

#[test]
#[allow(clippy::print_stderr)]
fn condition_is_that_of_the_singular_values() {
    let mut random = Xorshift::new(61);
    let mut chains: Vec<Chain> = closed_form_arms().into_iter().map(|(_, arm)| arm.chain).collect();
    chains.extend([
        super::forward::mixed_chain(),
        super::published::sda10_left(),
        super::published::ur10e(),
    ]);
    let (mut worst, mut hardest) = (0.0_f64, 0.0_f64);
    for chain in chains {
        for round in 0..300 {
            let mut q = random_q(&chain, &mut random);
            // Every third a little off a singular posture: lined-up wrist, straight elbow.
            let joint = [4, 5, 2, 3][round / 3 % 4];
            if round % 3 == 0 && joint < chain.dof() {
                q[joint] = 10.0_f64.powf(-6.0 * random.unit());
            }
            let sigma = chain.jacobian(&q).singular_values();
            let exact = sigma.max() / sigma.min();
            if exact > 1e6 {
                continue;
            }
            let off = (condition_number(&chain, &q) / exact - 1.0).abs();
            assert!(off < 1e-9, "{exact}: {off}");
            (worst, hardest) = (worst.max(off), hardest.max(exact));
        }
    }
    assert!(hardest > 1e4, "{hardest}");
    eprintln!("condition number: {worst:.1e} relative at most, up to {hardest:.0}");
}
