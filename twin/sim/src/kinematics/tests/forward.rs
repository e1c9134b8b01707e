//! Forward kinematics and Jacobian against Pinocchio's figures and central differences.

use super::*;
use crate::pose::from_quaternion_wxyz;
use nalgebra::{Matrix3, Matrix6xX, Rotation3};

#[test]
fn agrees_with_pinocchio() {
    let Some(reference) = shared_json("data/robots/fk_reference.json") else { return };
    for (name, entry) in reference["robots"].as_object().unwrap() {
        let file = name.split(':').next().unwrap();
        let tree =
            from_urdf(&robot(file).unwrap(), "base_link", entry["tool"].as_str().unwrap(), &[])
                .unwrap();
        let chain = tree.chain;
        let names: Vec<&str> = (0..chain.dof()).map(|axis| chain.axis_name(axis)).collect();
        let asked: Vec<&str> =
            entry["joints"].as_array().unwrap().iter().map(|x| x.as_str().unwrap()).collect();
        assert_eq!(names, asked, "{name}");
        for (axis, lower) in chain.axes().iter().zip(numbers(&entry["lower"])) {
            assert!((axis.lower - lower).abs() < 1e-12, "{name}");
        }
        let cases = entry["cases"].as_array().unwrap();
        assert!(!cases.is_empty());
        let (mut worst_m, mut worst_rad, mut worst_jacobian) = (0.0_f64, 0.0_f64, 0.0_f64);
        for case in cases {
            let q = numbers(&case["q"]);
            let tip = chain.forward(&q);
            let rows: Vec<f64> = case["T"].as_array().unwrap().iter().flat_map(numbers).collect();
            let rotation = Matrix3::from_fn(|row, column| rows[4 * row + column]);
            let position = nalgebra::Vector3::from_fn(|row, _| rows[4 * row + 3]);
            worst_m = worst_m.max((tip.translation.vector - position).norm());
            let turn = tip.rotation.to_rotation_matrix().inverse()
                * Rotation3::from_matrix_unchecked(rotation);
            // The angle from its sine: the trace is blind below 1e-8.
            let axial = turn.matrix() - turn.matrix().transpose();
            let sine = 0.5 * axial[(2, 1)].hypot(axial[(0, 2)]).hypot(axial[(1, 0)]);
            worst_rad = worst_rad.max(sine.atan2(0.5 * (turn.matrix().trace() - 1.0)));
            let jacobian = chain.jacobian(&q);
            for (row, values) in case["J_world_aligned"].as_array().unwrap().iter().enumerate() {
                for (column, value) in numbers(values).into_iter().enumerate() {
                    worst_jacobian = worst_jacobian.max((jacobian[(row, column)] - value).abs());
                }
            }
            let sigma = numbers(&case["sigma"]);
            let condition = condition_number(&chain, &q);
            let ours = sigma[0] / condition;
            assert!((ours - sigma[5]).abs() < 1e-9, "{name}: {ours} {}", sigma[5]);
        }
        assert!(worst_m < 1e-9 && worst_rad < 1e-9, "{name}: {worst_m} m, {worst_rad} rad");
        assert!(worst_jacobian < 1e-8, "{name}: {worst_jacobian}");
    }
}

fn central_differences(chain: &Chain, q: &[f64], step: f64) -> Matrix6xX<f64> {
    let columns: Vec<Vector6<f64>> = (0..chain.dof())
        .map(|axis| {
            let (mut ahead, mut behind) = (q.to_vec(), q.to_vec());
            ahead[axis] += step;
            behind[axis] -= step;
            let (v, w) = pose_error(&chain.forward(&behind), &chain.forward(&ahead));
            Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z) / (2.0 * step)
        })
        .collect();
    Matrix6xX::from_columns(&columns)
}

#[test]
fn jacobian_is_the_derivative() {
    let mut chains: Vec<Chain> = closed_form_arms().into_iter().map(|(_, arm)| arm.chain).collect();
    chains.push(mixed_chain());
    let mut random = Xorshift::new(11);
    for chain in chains {
        for _ in 0..20 {
            let q = random_q(&chain, &mut random);
            let exact = chain.jacobian(&q);
            let coarse = (&exact - central_differences(&chain, &q, 1e-3)).amax();
            let fine = (&exact - central_differences(&chain, &q, 5e-4)).amax();
            // Second order: half the step, a quarter of the error.
            assert!(fine < 1e-6 && (fine < 0.3 * coarse || fine < 1e-10), "{coarse} {fine}");
        }
    }
}

/// Sliding and turning joints, and one that follows another with a factor and an offset.
pub(super) fn mixed_chain() -> Chain {
    let joint = |name: &str, kind, xyz, axis: [f64; 3], mimic| ChainJoint {
        name: name.to_owned(),
        kind,
        parent_from_joint: from_xyz_rpy(xyz, [0.3, -0.2, 0.5]),
        axis: axis.into(),
        lower: -1.0,
        upper: 1.0,
        velocity: 1.0,
        effort: None,
        mimic,
    };
    let follows = Some(Mimic { master: 1, multiplier: -2.0, offset: 0.25 });
    let joints = vec![
        joint("rail", JointKind::Prismatic, [0.0, 0.0, 0.5], [1.0, 0.0, 0.0], None),
        joint("turn", JointKind::Revolute, [0.1, 0.2, 0.3], [0.0, 2.0, 1.0], None),
        joint("follower", JointKind::Revolute, [0.4, 0.0, 0.1], [0.0, 0.0, 1.0], follows),
        joint("slide", JointKind::Prismatic, [0.0, 0.1, 0.1], [0.0, 1.0, 1.0], None),
    ];
    Chain::new(joints, from_quaternion_wxyz([0.1, 0.0, 0.2], [0.9, 0.1, 0.3, 0.2])).unwrap()
}

#[test]
fn a_follower_narrows_its_master() {
    let chain = mixed_chain();
    assert_eq!(chain.dof(), 3);
    let turn = chain.axes()[1];
    // -2 q + 0.25 within ±1 and half the speed.
    assert!((turn.lower + 0.375).abs() < 1e-15 && (turn.upper - 0.625).abs() < 1e-15);
    assert!((turn.velocity - 0.5).abs() < 1e-15);
}

#[test]
fn held_joints_change_nothing_else() {
    let chain = mixed_chain();
    let mut random = Xorshift::new(5);
    for _ in 0..20 {
        let q = random_q(&chain, &mut random);
        for (held, rest) in
            [("rail", vec![q[1], q[2]]), ("turn", vec![q[0], q[2]]), ("slide", vec![q[0], q[1]])]
        {
            let index = (0..3).find(|&axis| chain.axis_name(axis) == held).unwrap();
            let part = chain.hold(&[(held, q[index])]).unwrap();
            assert_eq!(part.dof(), 2);
            let (v, w) = pose_error(&part.forward(&rest), &chain.forward(&q));
            assert!(v.norm() < 1e-14 && w.norm() < 1e-14);
        }
        let all = [("rail", q[0]), ("turn", q[1]), ("slide", q[2])];
        let still = chain.hold(&all).unwrap();
        let (v, w) = pose_error(&still.forward(&[]), &chain.forward(&q));
        assert!(still.dof() == 0 && v.norm() < 1e-14 && w.norm() < 1e-14);
    }
    assert!(matches!(chain.hold(&[("nobody", 0.0)]), Err(ChainFault::UnknownJoint { .. })));
    assert!(matches!(chain.hold(&[("follower", 0.0)]), Err(ChainFault::MimicHeld { .. })));
}

#[test]
fn links_stand_where_the_tip_walk_says() {
    let chain = mixed_chain();
    let q = [0.1, 0.2, -0.3];
    let mut poses = Vec::new();
    chain.link_poses(&q, &mut poses);
    assert_eq!(poses.len(), 4);
    let (v, w) = pose_error(&(poses[3] * chain.last_from_tip()), &chain.forward(&q));
    assert!(v.norm() < 1e-15 && w.norm() < 1e-15);
}

#[test]
fn impossible_joints_are_refused() {
    let chain = mixed_chain();
    let with = |change: &dyn Fn(&mut ChainJoint)| {
        let mut joints = chain.joints().to_vec();
        change(&mut joints[2]);
        Chain::new(joints, Pose::identity())
    };
    let bad = with(&|joint| joint.axis *= 0.0);
    assert!(matches!(bad, Err(ChainFault::BadGeometry { .. })));
    let bad = with(&|joint| joint.axis.x = f64::NAN);
    assert!(matches!(bad, Err(ChainFault::BadGeometry { .. })));
    for master in [2, 99] {
        let mimic = Some(Mimic { master, multiplier: 1.0, offset: 0.0 });
        let bad = with(&|joint| joint.mimic = mimic);
        assert!(matches!(bad, Err(ChainFault::MimicLoop { .. })));
    }
}
