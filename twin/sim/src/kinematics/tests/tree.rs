//! Chains out of a URDF's tree, and where the other links ride.

use super::*;

fn two_arms() -> Option<slam::urdf::RobotDescription> {
    robot("motoman_sda10f")
}

#[test]
fn the_other_arm_rides_on_the_torso() {
    let Some(robot) = two_arms() else { return };
    let held = [("arm_right_joint_2_l", 0.4), ("arm_right_joint_4_u", -0.6)];
    let tree = from_urdf(&robot, "base_link", "arm_left_link_tool0", &held).unwrap();
    assert_eq!(tree.chain.dof(), 8);
    assert_eq!(tree.links.len(), robot.links.len());
    let other = tree.links.iter().find(|link| link.link == "arm_right_link_tool0").unwrap();
    assert_eq!(other.carrier, Some(0), "torso");
    // The same place by the other arm's own chain.
    let right = from_urdf(&robot, "base_link", "arm_right_link_tool0", &[]).unwrap().chain;
    let torso = 0.8;
    let mut q = vec![0.0; 8];
    (q[0], q[2], q[4]) = (torso, 0.4, -0.6);
    let mut poses = Vec::new();
    tree.chain.link_poses(&[torso, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0], &mut poses);
    let (v, w) = pose_error(&(poses[0] * other.carrier_from_link), &right.forward(&q));
    assert!(v.norm() < 1e-14 && w.norm() < 1e-14);
    let follower = tree.links.iter().find(|link| link.link == "torso_link_b2").unwrap();
    assert!(follower.frozen_mimic);
}

#[test]
fn held_in_the_tree_is_held_in_the_chain() {
    let Some(robot) = two_arms() else { return };
    let tip = "arm_left_link_tool0";
    let held = [("torso_joint_b1", 0.5)];
    let whole = from_urdf(&robot, "base_link", tip, &[]).unwrap().chain;
    let tree = from_urdf(&robot, "base_link", tip, &held).unwrap();
    let q = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7];
    let (v, w) = pose_error(&tree.chain.forward(&q), &whole.hold(&held).unwrap().forward(&q));
    assert!(v.norm() < 1e-14 && w.norm() < 1e-14);
    assert!(tree.links.iter().all(|link| !link.frozen_mimic));
    let torso = tree.links.iter().find(|link| link.link == "torso_link_b2").unwrap();
    assert_eq!(torso.carrier, None);
    assert!((torso.carrier_from_link.rotation.angle() - 0.5).abs() < 1e-14);
}

#[test]
fn a_chain_may_run_up_and_down_the_tree() {
    let Some(robot) = two_arms() else { return };
    let (left, right) = ("arm_left_link_tool0", "arm_right_link_tool0");
    let across = from_urdf(&robot, right, left, &[]).unwrap().chain;
    assert_eq!(across.dof(), 14);
    let [to_left, to_right] =
        [left, right].map(|tip| from_urdf(&robot, "base_link", tip, &[]).unwrap().chain);
    let mut random = Xorshift::new(31);
    for _ in 0..20 {
        let (mut l, mut r) = (random_q(&to_left, &mut random), random_q(&to_right, &mut random));
        r[0] = l[0];
        let expected = to_right.forward(&r).inverse() * to_left.forward(&l);
        let mut q: Vec<f64> = r.drain(1..).rev().collect();
        q.extend(l.drain(1..));
        let (v, w) = pose_error(&across.forward(&q), &expected);
        assert!(v.norm() < 1e-13 && w.norm() < 1e-13);
    }
    assert!(condition_number(&across, &[0.1; 14]).is_finite());
}

#[test]
fn bad_names_are_refused() {
    let Some(robot) = two_arms() else { return };
    let fault = |base, tip, held: &[(&str, f64)]| from_urdf(&robot, base, tip, held).unwrap_err();
    assert!(matches!(fault("base_link", "nowhere", &[]), ChainFault::UnknownLink { .. }));
    let tip = "arm_left_link_tool0";
    assert!(matches!(fault("base_link", tip, &[("no", 0.0)]), ChainFault::UnknownJoint { .. }));
    let mimic = [("torso_joint_b2", 0.0)];
    assert!(matches!(fault("base_link", tip, &mimic), ChainFault::MimicHeld { .. }));
    let fixed = [("base_link_torso", 0.0)];
    assert!(matches!(fault("base_link", tip, &fixed), ChainFault::UnknownJoint { .. }));
    let still = from_urdf(&robot, "base_link", "base_link", &[]).unwrap();
    assert_eq!(still.chain.dof(), 0);
}
