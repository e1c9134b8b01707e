//! Types and parameters of arms, found from their axes alone.

use super::*;

/// The chain of a catalogue entry, `base_link` to `tool0`, from its list of joints.
fn catalogue_chain(entry: &Value) -> Chain {
    let list = entry["joints"].as_array().unwrap();
    let at = |joint: &Value| {
        let xyz = numbers(&joint["xyz"]);
        let rpy = numbers(&joint["rpy"]);
        from_xyz_rpy([xyz[0], xyz[1], xyz[2]], [rpy[0], rpy[1], rpy[2]])
    };
    let mut path = Vec::new();
    let mut link = "tool0";
    while link != "base_link" {
        let joint = list.iter().find(|joint| joint["child"] == link).unwrap();
        path.push(joint);
        link = joint["parent"].as_str().unwrap();
    }
    let (mut joints, mut carried) = (Vec::new(), Pose::identity());
    for joint in path.into_iter().rev() {
        carried *= at(joint);
        if joint["type"] == "fixed" {
            continue;
        }
        let axis = numbers(&joint["axis"]);
        joints.push(ChainJoint {
            name: joint["name"].as_str().unwrap().to_owned(),
            kind: JointKind::Revolute,
            parent_from_joint: carried,
            axis: [axis[0], axis[1], axis[2]].into(),
            lower: joint["lower"].as_f64().unwrap(),
            upper: joint["upper"].as_f64().unwrap(),
            velocity: joint["velocity"].as_f64().unwrap(),
            effort: None,
            mimic: None,
        });
        carried = Pose::identity();
    }
    Chain::new(joints, carried).unwrap()
}

#[test]
fn opw_parameters_are_the_published_ones() {
    let Some(catalogue) = shared_json("data/robots/catalog.json") else { return };
    let mut seen = 0;
    for (name, entry) in catalogue.as_object().unwrap() {
        let Some(opw) = entry.get("opw") else { continue };
        let Solver::Opw(arm) = recognise(&catalogue_chain(entry)).unwrap().solver else {
            panic!("{name} is not recognised")
        };
        let p = arm.parameters;
        let ours = [p.a1, p.a2, p.b, p.c1, p.c2, p.c3, p.c4];
        for (value, key) in ours.iter().zip(["a1", "a2", "b", "c1", "c2", "c3", "c4"]) {
            let published = opw[key].as_f64().unwrap();
            // Two URDFs print π short: the arms they describe differ from the table by that much.
            let tolerance = 10.0 * opw["max_fk_error_m"].as_f64().unwrap() + 1e-12;
            assert!((value - published).abs() < tolerance, "{name} {key}: {value}, {published}");
        }
        let (offsets, signs) = (numbers(&opw["offsets_rad"]), numbers(&opw["sign_corrections"]));
        for (index, map) in arm.maps.iter().enumerate() {
            assert_eq!(map.sign, signs[index], "{name} joint {}", index + 1);
            let difference = (map.offset_rad() - offsets[index]).rem_euclid(TAU);
            assert!(difference.min(TAU - difference) < 1e-6, "{name} joint {}", index + 1);
        }
        seen += 1;
    }
    assert_eq!(seen, 18);
}

#[test]
fn every_catalogue_arm_finds_the_generating_posture() {
    let Some(catalogue) = shared_json("data/robots/catalog.json") else { return };
    let mut random = Xorshift::new(23);
    for (name, entry) in catalogue.as_object().unwrap() {
        // Two-armed and seven-jointed ones have other tips; they are tested from their URDF.
        if name.starts_with("motoman_s") {
            continue;
        }
        let arm = recognise(&catalogue_chain(entry)).unwrap();
        let opw = entry.get("opw").is_some();
        assert_eq!(matches!(arm.solver, Solver::Opw(_)), opw, "{name}");
        assert_eq!(matches!(arm.solver, Solver::Parallel(_)), !opw, "{name}");
        let mut out = Vec::new();
        for _ in 0..100 {
            let q = random_q(&arm.chain, &mut random);
            let target = arm.chain.forward(&q);
            assert_eq!(arm.inverse(&target, &IkOptions::default(), &mut out), Coverage::Complete);
            check_solutions(&arm, &target, &out);
            assert!(out.iter().any(|found| found.q.distance(&q) < 1e-6), "{name} {q:?}");
        }
    }
}

#[test]
fn seven_joint_arms_have_the_published_lengths() {
    for side in ["left", "right"] {
        let tip = format!("arm_{side}_link_tool0");
        let Some(arm) = arm("motoman_sda10f", &tip, &[("torso_joint_b1", 0.7)]) else { return };
        let Solver::Srs(srs) = &arm.solver else { panic!("not recognised") };
        assert!((srs.parameters.upper - 0.36).abs() < 1e-12);
        assert!((srs.parameters.lower - 0.36).abs() < 1e-12);
        let whole = from_urdf(&robot("motoman_sda10f").unwrap(), "base_link", &tip, &[]).unwrap();
        let whole = recognise(&whole.chain).unwrap();
        assert!(matches!(whole.solver, Solver::Numeric(_)), "eight joints");
        let mut chain = whole.chain.joints().to_vec();
        chain.extend(whole.chain.joints().to_vec());
        let chain = Chain::new(chain, Pose::identity()).unwrap();
        assert!(matches!(recognise(&chain), Err(ChainFault::TooManyJoints { dof: 16, .. })));
    }
}

#[test]
fn type_and_lengths_do_not_depend_on_base_or_tip() {
    let new_from_base = from_xyz_rpy([1.0, -2.0, 0.5], [0.4, 2.0, -1.0]);
    let tip_from_new = from_xyz_rpy([0.1, 0.2, 0.3], [1.0, 0.2, 0.3]);
    for (name, arm) in closed_form_arms() {
        let moved =
            recognise(&arm.chain.with_base(&new_from_base).with_tip(&tip_from_new)).unwrap();
        match (&arm.solver, &moved.solver) {
            (Solver::Opw(a), Solver::Opw(b)) => {
                let (a, b) = (a.parameters, b.parameters);
                for (a, b) in [(a.a1, b.a1), (a.a2, b.a2), (a.c2, b.c2), (a.c3, b.c3)] {
                    assert!((a - b).abs() < 1e-12, "{name}");
                }
            }
            (Solver::Srs(a), Solver::Srs(b)) => {
                assert!((a.parameters.upper - b.parameters.upper).abs() < 1e-12);
            }
            (Solver::Parallel(a), Solver::Parallel(b)) => {
                assert!((a.parameters.c3 - b.parameters.c3).abs() < 1e-12);
            }
            other => panic!("{name}: {other:?}"),
        }
    }
}

#[test]
fn a_bent_wrist_is_left_to_the_search() {
    let Some(arm) = arm("kuka_kr6r900sixx", "tool0", &[]) else { return };
    let mut joints = arm.chain.joints().to_vec();
    joints[4].parent_from_joint *= Pose::translation(0.0, 0.0, 1e-3);
    let bent = recognise(&Chain::new(joints, *arm.chain.last_from_tip()).unwrap()).unwrap();
    assert!(matches!(bent.solver, Solver::Numeric(_)));
    assert_eq!(bent.coverage(), Coverage::Sampled);
    let q = [0.3, -1.2, 1.4, 0.4, 0.8, -0.2];
    let target = bent.chain.forward(&q);
    let mut out = Vec::new();
    bent.inverse(&target, &IkOptions::default(), &mut out);
    check_solutions(&bent, &target, &out);
    assert!(out.iter().any(|found| found.q.distance(&q) < 1e-6), "{out:?}");
}
