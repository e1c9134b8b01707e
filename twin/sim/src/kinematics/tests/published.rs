//! Arms built from published figures, so that these checks need no files: the SDA10D with the poses that
//! Kirkman's programs command, and the UR10e.

use std::f64::consts::FRAC_PI_2;

use super::*;

fn joint(name: &str, parent_from_joint: Pose, axis: [f64; 3], limit_deg: f64) -> ChainJoint {
    ChainJoint {
        name: name.to_owned(),
        kind: JointKind::Revolute,
        parent_from_joint,
        axis: axis.into(),
        lower: -limit_deg.to_radians(),
        upper: limit_deg.to_radians(),
        velocity: 3.0,
        effort: None,
        mimic: None,
    }
}

/// Left arm of the SDA10F (the SDA10D has the same arms) from the torso at shoulder height
/// (ros-industrial/motoman, `motoman_sda10f_support`: `torso_link_b1` to `arm_left_link_tool0`).
pub(super) fn sda10_left() -> Chain {
    let row = |name, xyz, roll, sign, limit| {
        joint(name, from_xyz_rpy(xyz, [roll, 0.0, 0.0]), [0.0, 0.0, sign], limit)
    };
    let (here, along) = ([0.0; 3], [0.0, 0.36, 0.0]);
    let joints = vec![
        row("s", [0.1, 0.265, 0.0], FRAC_PI_2, -1.0, 180.0),
        row("l", here, -FRAC_PI_2, -1.0, 110.0),
        row("e", along, FRAC_PI_2, -1.0, 170.0),
        row("u", here, -FRAC_PI_2, 1.0, 135.0),
        row("r", along, FRAC_PI_2, 1.0, 180.0),
        row("b", here, -FRAC_PI_2, 1.0, 110.0),
        row("t", [0.0, 0.155, 0.0], -FRAC_PI_2, -1.0, 180.0),
    ];
    Chain::new(joints, from_xyz_rpy([0.0; 3], [0.0, 0.0, PI])).unwrap()
}

/// UR10e by its Denavit–Hartenberg lengths (Universal Robots, "DH parameters for calculations of
/// kinematics and dynamics"), with its angles exact; all joints ±360°.
pub(super) fn ur10e() -> Chain {
    let link = |a: f64, d: f64, alpha: f64| from_xyz_rpy([a, 0.0, d], [alpha, 0.0, 0.0]);
    let links = [
        Pose::identity(),
        link(0.0, 0.1807, FRAC_PI_2),
        link(-0.6127, 0.0, 0.0),
        link(-0.57155, 0.0, 0.0),
        link(0.0, 0.17415, FRAC_PI_2),
        link(0.0, 0.11985, -FRAC_PI_2),
    ];
    let row = |(index, link): (usize, Pose)| {
        joint(&format!("joint_{}", index + 1), link, [0.0, 0.0, 1.0], 360.0)
    };
    let joints = links.into_iter().enumerate().map(row).collect();
    Chain::new(joints, link(0.0, 0.11655, 0.0)).unwrap()
}

/// Kirkman-DM/Motoman-SDA-10D-freeform-toolpath-code @ d05313f9: where the programs command the tip of
/// the moving bed (`C` point, robot axes) and the bed in the flange's axes (`Tool_bed`), mm; all
/// rotations are zero. The UV box is visited with the bed of the fibre system.
const COMMANDED: [(&str, [f64; 3], [f64; 3]); 3] = [
    ("fibre nozzle", [-34.999, 652.941, 321.979], [0.126, -0.096, 30.452]),
    ("resin nozzle", [-37.387, 768.190, 352.742], [0.699, 2.048, 30.490]),
    ("UV box", [-309.929, 605.559, 424.927], [0.126, -0.096, 30.452]),
];

/// Elbow angles, of 360, at which some posture within limits is on the pose, with the robot's axes put
/// at `torso_from_robot`.
fn elbows_reaching(torso_from_robot: &Pose, at_mm: [f64; 3], tool_mm: [f64; 3]) -> usize {
    let metres = |mm: [f64; 3]| from_xyz_rpy(mm.map(|x| 1e-3 * x), [0.0; 3]);
    let arm = recognise(&sda10_left().with_tip(&metres(tool_mm))).unwrap();
    assert!(matches!(arm.solver, Solver::Srs(_)));
    let target = torso_from_robot * metres(at_mm);
    let mut out = Vec::new();
    let reached = |degrees: &i32| {
        let elbow_rad = f64::from(*degrees).to_radians();
        let coverage = arm.inverse(&target, &IkOptions { seed: None, elbow_rad }, &mut out);
        assert_eq!(coverage, Coverage::Complete);
        check_solutions(&arm, &target, &out);
        !out.is_empty()
    };
    (0..360).filter(reached).count()
}

#[test]
#[allow(clippy::print_stderr)]
fn kirkmans_poses_are_reached_with_axes_at_the_torso() {
    for (name, at_mm, tool_mm) in COMMANDED {
        let count = elbows_reaching(&Pose::identity(), at_mm, tool_mm);
        eprintln!("{name}: {count} of 360 elbow angles");
        assert!(count > 0, "{name}");
    }
}

/// The other simple reading of the robot's axes, at the left shoulder, cannot be what was used.
#[test]
fn kirkmans_poses_are_out_of_reach_with_axes_at_the_shoulder() {
    let shoulder = Pose::translation(0.1, 0.265, 0.0);
    for (name, at_mm, tool_mm) in &COMMANDED[1..] {
        assert_eq!(elbows_reaching(&shoulder, *at_mm, *tool_mm), 0, "{name}");
    }
}

/// Exact and, as `ur_description` prints it, with π/2 rounded to nine digits.
fn ur_arms() -> Vec<(&'static str, Arm)> {
    let exact = ur10e();
    let mut joints = exact.joints().to_vec();
    let rounded = |roll: f64| from_xyz_rpy([0.0; 3], [roll, 0.0, 0.0]);
    let quarter = (FRAC_PI_2 * 1e9).round() * 1e-9;
    for (index, turn) in [(1, quarter), (4, quarter), (5, -quarter)] {
        joints[index].parent_from_joint.rotation = rounded(turn).rotation;
    }
    let printed = Chain::new(joints, *exact.last_from_tip()).unwrap();
    let mut arms = vec![("exact", recognise(&exact).unwrap())];
    arms.push(("rounded", recognise(&printed).unwrap()));
    arms.extend(arm("ur10e", "tool0", &[]).map(|arm| ("file", arm)));
    arms
}

/// A posture `distance` from the singularity of `kind` (0 wrist, 1 elbow, 2 shoulder), rad or m.
fn near_singular(arm: &Arm, kind: usize, distance: f64, random: &mut Xorshift) -> Vec<f64> {
    let mut q: Vec<f64> = (0..6).map(|_| -3.0 + 6.0 * random.unit()).collect();
    match kind {
        0 => q[4] = distance,
        1 => q[2] = distance,
        _ => {
            // Leans the upper arm until the hand stands `distance` in front of axis 1: by bisection.
            let ahead = |q2: f64| {
                let mut at = q.clone();
                at[1] = q2;
                signed_forward(arm, &at) - distance
            };
            let step = |k: u32| -3.0 + 0.01 * f64::from(k);
            let Some(k) = (0..600).find(|&k| ahead(step(k)) * ahead(step(k + 1)) < 0.0) else {
                return near_singular(arm, kind, distance, random);
            };
            let (mut low, mut high) = (step(k), step(k + 1));
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                if ahead(low) * ahead(middle) <= 0.0 { high = middle } else { low = middle }
            }
            q[1] = 0.5 * (low + high);
        }
    }
    q
}

/// Meeting point of axes 5 and 6 in front of axis 1, m; negative behind.
fn signed_forward(arm: &Arm, q: &[f64]) -> f64 {
    let away = nearness(arm, q).shoulder_m.unwrap();
    if arm.branch(q).shoulder { -away } else { away }
}

/// Beyond this condition number two singularities meet: a posture is then known to the square root of
/// the rounding at best, and an URDF's rounding alone moves it.
const KNOWN_CONDITION: f64 = 1e7;

#[test]
#[allow(clippy::print_stderr)]
fn three_parallel_axes_near_their_singularities() {
    for (name, arm) in ur_arms() {
        assert!(matches!(arm.solver, Solver::Parallel(_)), "{name}");
        for (kind, what) in ["wrist", "elbow", "shoulder"].into_iter().enumerate() {
            let mut random = Xorshift::new(77);
            let mut out = Vec::new();
            let (mut worst, mut hardest) = (0.0_f64, 0.0_f64);
            for round in 0..700 {
                let size = 10.0_f64.powi(-1 - round / 100);
                let distance = if round % 2 == 0 { size } else { -size };
                let q = near_singular(&arm, kind, distance, &mut random);
                let target = arm.chain.forward(&q);
                arm.inverse(&target, &options(&arm, &q, Some(&q)), &mut out);
                check_solutions(&arm, &target, &out);
                assert!(!out.is_empty(), "{name} {what} {distance}");
                let condition = condition_number(&arm.chain, &q);
                if condition < KNOWN_CONDITION {
                    let near = out.iter().map(|found| found.q.distance(&q));
                    let near = near.fold(f64::MAX, f64::min);
                    assert!(near < 1e-6, "{name} {what} {distance}: {near}, {condition}, {q:?}");
                    (worst, hardest) = (worst.max(near), hardest.max(condition));
                }
            }
            assert!(hardest > 1e6, "{hardest}");
            eprintln!("{name} {what}: {worst:.1e} rad at most, condition up to {hardest:.0e}");
        }
    }
}

#[test]
fn all_turns_of_the_ur10e_are_listed() {
    let arm = recognise(&ur10e()).unwrap();
    let q = [0.4, -1.1, 1.3, -0.7, 0.9, 0.2];
    let mut out = Vec::new();
    arm.inverse(&arm.chain.forward(&q), &IkOptions::default(), &mut out);
    // Eight branches, and each of six joints at two places within ±360°.
    assert_eq!(out.len(), 8 * 64);
    for mask in 0..64_u32 {
        let other = |(joint, value): (usize, &f64)| {
            if mask >> joint & 1 == 0 { *value } else { value - TAU * value.signum() }
        };
        let copy: Vec<f64> = q.iter().enumerate().map(other).collect();
        assert!(out.iter().any(|found| found.q.distance(&copy) < 1e-9), "{copy:?}");
    }
}
