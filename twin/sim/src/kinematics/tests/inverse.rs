//! All branches, checked by forward kinematics, the generating one among them.

use super::*;

/// Poses per arm: 2 000, or 100 000 with `TWIN_SLOW=1`.
fn poses() -> usize {
    if std::env::var_os("TWIN_SLOW").is_some() { 100_000 } else { 2_000 }
}

#[test]
#[allow(clippy::print_stderr)]
fn the_generating_posture_is_always_found() {
    for (name, arm) in closed_form_arms() {
        let mut random = Xorshift::new(0xfeed);
        let mut out = Vec::new();
        let (mut total, mut worst) = (0, 0.0_f64);
        for _ in 0..poses() {
            let q = random_q(&arm.chain, &mut random);
            let target = arm.chain.forward(&q);
            let coverage = arm.inverse(&target, &options(&arm, &q, None), &mut out);
            assert_eq!(coverage, Coverage::Complete);
            check_solutions(&arm, &target, &out);
            let nearest = out.iter().map(|found| found.q.distance(&q)).fold(f64::MAX, f64::min);
            // The UR10e's URDF rounds π/2 to 2e-10, which a condition number of 1e7 makes a posture.
            let parallel = matches!(arm.solver, Solver::Parallel(_));
            if parallel && nearness(&arm, &q).condition > 1e7 {
                continue;
            }
            assert!(nearest < 1e-6, "{name}: {nearest} from {q:?}");
            worst = worst.max(nearest);
            total += out.len();
        }
        let mean = total as f64 / poses() as f64;
        eprintln!("{name}: {} poses, {mean:.2} postures each, worst {worst:.1e} rad", poses());
    }
}

#[test]
fn branches_name_what_postures_are() {
    for (name, arm) in closed_form_arms() {
        let mut random = Xorshift::new(3);
        let mut out = Vec::new();
        for _ in 0..300 {
            let q = random_q(&arm.chain, &mut random);
            let target = arm.chain.forward(&q);
            arm.inverse(&target, &options(&arm, &q, None), &mut out);
            for found in &out {
                assert_eq!(found.branch, arm.branch(&found.q), "{name} {found:?}");
            }
            let own = out.iter().find(|found| found.q.distance(&q) < 1e-6).unwrap();
            assert_eq!(own.branch, arm.branch(&q), "{name}");
        }
    }
}

#[test]
fn solutions_are_all_different_and_all_copies_are_there() {
    for (name, arm) in closed_form_arms() {
        let mut random = Xorshift::new(17);
        let mut out = Vec::new();
        for _ in 0..100 {
            let q = random_q(&arm.chain, &mut random);
            let target = arm.chain.forward(&q);
            arm.inverse(&target, &options(&arm, &q, None), &mut out);
            for (index, found) in out.iter().enumerate() {
                for other in &out[..index] {
                    assert!(found.q.distance(&other.q) > 1e-7, "{name}");
                }
                for (index, axis) in arm.chain.axes().iter().enumerate() {
                    for turn in [-TAU, TAU] {
                        let mut copy = found.q;
                        copy[index] += turn;
                        let within = axis.lower <= copy[index] && copy[index] <= axis.upper;
                        let bounded = axis.lower.is_finite() && axis.upper.is_finite();
                        if axis.periodic && bounded && within {
                            let there = out.iter().any(|known| known.q.distance(&copy) < 1e-9);
                            assert!(there, "{name}: a copy is missing");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn closed_form_finds_what_the_search_finds() {
    for (name, arm) in closed_form_arms() {
        if matches!(arm.solver, Solver::Srs(_)) {
            continue;
        }
        let search = Arm { solver: Solver::Numeric(Numeric::default()), ..arm.clone() };
        let mut random = Xorshift::new(29);
        let (mut exact, mut searched) = (Vec::new(), Vec::new());
        for _ in 0..10 {
            let q = random_q(&arm.chain, &mut random);
            let target = arm.chain.forward(&q);
            arm.inverse(&target, &IkOptions::default(), &mut exact);
            search.inverse(&target, &IkOptions::default(), &mut searched);
            check_solutions(&arm, &target, &searched);
            assert!(!searched.is_empty(), "{name}");
            for found in &searched {
                let known = exact.iter().any(|other| other.q.distance(&found.q) < 1e-5);
                assert!(known, "{name}: {found:?}");
            }
        }
    }
}

#[test]
fn moving_the_base_moves_nothing_else() {
    let new_from_base = from_xyz_rpy([3.0, -1.0, 0.2], [0.1, 0.5, 2.0]);
    for (name, arm) in closed_form_arms() {
        let moved = recognise(&arm.chain.with_base(&new_from_base)).unwrap();
        let mut random = Xorshift::new(41);
        let (mut here, mut there) = (Vec::new(), Vec::new());
        for _ in 0..50 {
            let q = random_q(&arm.chain, &mut random);
            let target = arm.chain.forward(&q);
            let options = options(&arm, &q, None);
            arm.inverse(&target, &options, &mut here);
            moved.inverse(&(new_from_base * target), &options, &mut there);
            assert_eq!(here.len(), there.len(), "{name}");
            for found in &here {
                let same = |other: &Solution| {
                    other.q.distance(&found.q) < 1e-7 && other.branch == found.branch
                };
                let same = there.iter().any(same);
                assert!(same, "{name}: {found:?}");
            }
            if let (Some(one), Some(other)) = (arm.elbow_angle(&q), moved.elbow_angle(&q)) {
                assert!((one - other).abs() < 1e-9, "{name}");
            }
        }
    }
}

#[test]
fn elbow_angle_is_what_the_issue_says() {
    let Some(arm) = arm("motoman_sda10f", "arm_left_link_tool0", &[("torso_joint_b1", 0.0)]) else {
        return;
    };
    let mut random = Xorshift::new(43);
    let mut poses = Vec::new();
    for _ in 0..200 {
        let q = random_q(&arm.chain, &mut random);
        arm.chain.link_poses(&q, &mut poses);
        // Shoulder, elbow, wrist are origins of links 2, 4, 6; the first axis in base.
        let [shoulder, elbow, wrist] = [1, 3, 5].map(|index| poses[index].translation.vector);
        let first = poses[0].rotation * arm.chain.joints()[0].axis;
        let line = (wrist - shoulder).normalize();
        let across = |v: crate::pose::Vector| v - line * line.dot(&v);
        let (zero, out) = (across(first), across(elbow - shoulder));
        let angle = line.dot(&zero.cross(&out)).atan2(zero.dot(&out));
        let difference = (arm.elbow_angle(&q).unwrap() - angle + PI).rem_euclid(TAU) - PI;
        assert!(difference.abs() < 1e-9, "{difference}");
    }
}

#[test]
fn a_printer_says_whether_the_orientation_fits() {
    let axis = |name: &str, direction: [f64; 3], upper| ChainJoint {
        name: name.to_owned(),
        kind: JointKind::Prismatic,
        parent_from_joint: from_xyz_rpy([0.01, 0.02, 0.03], [0.0, 0.0, 0.2]),
        axis: direction.into(),
        lower: 0.0,
        upper,
        velocity: 0.1,
        effort: None,
        mimic: None,
    };
    let joints = vec![
        axis("y", [0.0, 1.0, 0.0], 0.3),
        axis("x", [1.0, 0.0, 0.0], 0.2),
        axis("z", [0.0, 0.1, 1.0], 0.4),
    ];
    let printer = recognise(&Chain::new(joints, Pose::identity()).unwrap()).unwrap();
    assert!(matches!(printer.solver, Solver::Cartesian(_)));
    let q = [0.1, 0.15, 0.3];
    let target = printer.chain.forward(&q);
    let mut out = Vec::new();
    let coverage = printer.inverse(&target, &IkOptions::default(), &mut out);
    assert_eq!((coverage, out.len()), (Coverage::Complete, 1));
    assert!(out[0].q.distance(&q) < 1e-12 && out[0].rotation_error_rad < 1e-12);
    let turned = target * from_xyz_rpy([0.0; 3], [0.0, 0.0, 0.4]);
    printer.inverse(&turned, &IkOptions::default(), &mut out);
    assert!((out[0].rotation_error_rad - 0.4).abs() < 1e-12);
    let beyond = Pose::translation(0.0, 0.0, 9.0) * target;
    printer.inverse(&beyond, &IkOptions::default(), &mut out);
    assert!(out.is_empty());
    let near = nearness(&printer, &q);
    let block = printer.chain.jacobian(&q).fixed_view::<3, 3>(0, 0).into_owned();
    let sigma = block.singular_values();
    assert!((near.condition - sigma.max() / sigma.min()).abs() < 1e-9 && near.wrist_rad.is_none());
}
