//! Poses at which a closed form divides by nothing: no NaN, no panic, the posture still found.

use super::*;

/// Reaches `forward(q)` with `q` as seed; the result holds, and `q` is in it.
fn reaches(arm: &Arm, q: &[f64], tolerance: f64) -> Vec<Solution> {
    let target = arm.chain.forward(q);
    let mut out = Vec::new();
    arm.inverse(&target, &options(arm, q, None), &mut out);
    check_solutions(arm, &target, &out);
    assert!(!out.is_empty(), "nothing without seed at {q:?}");
    arm.inverse(&target, &options(arm, q, Some(q)), &mut out);
    check_solutions(arm, &target, &out);
    let nearest = out.iter().map(|found| found.q.distance(q)).fold(f64::MAX, f64::min);
    assert!(nearest < tolerance, "{nearest} at {q:?}");
    out
}

fn opw_arms() -> Vec<(Arm, Opw)> {
    let arms = closed_form_arms().into_iter().filter_map(|(_, arm)| match arm.solver.clone() {
        Solver::Opw(opw) => Some((arm, opw)),
        _ => None,
    });
    arms.collect()
}

#[test]
fn straight_wrist() {
    for (arm, opw) in opw_arms() {
        for tiny in [0.0, 1e-16, -1e-13, 1e-11, 4e-10, 6e-10, -1e-9, 1e-8, 1e-7] {
            let mut q = [0.2, -0.9, 0.6, 0.7, 0.0, -0.4];
            q[4] = opw.maps[4].q(tiny);
            let out = reaches(&arm, &q, if tiny.abs() < 1e-9 { 1e-6 } else { 1e-5 });
            assert!(out.iter().all(|found| found.q.iter().all(|value| value.is_finite())));
        }
    }
}

#[test]
fn folded_wrist() {
    // θ5 = π is past every maker's limit; with limits opened it must still be solved.
    for (arm, opw) in opw_arms() {
        let mut joints = arm.chain.joints().to_vec();
        joints[4].lower = -7.0;
        joints[4].upper = 7.0;
        let arm = recognise(&Chain::new(joints, *arm.chain.last_from_tip()).unwrap()).unwrap();
        let mut q = [0.2, -0.9, 0.6, 0.7, 0.0, -0.4];
        q[4] = opw.maps[4].q(PI);
        reaches(&arm, &q, 1e-6);
    }
}

#[test]
fn stretched_arm() {
    for (arm, opw) in opw_arms() {
        let p = opw.parameters;
        let straight = opw.maps[2].q(-p.a2.atan2(p.c3));
        for tiny in [0.0, 1e-12, 1e-9, 1e-6] {
            let q = [0.3, -0.5, straight + tiny, 0.4, 0.6, 0.1];
            // The elbow's two branches meet here: an angle is known only to the root of the rounding.
            reaches(&arm, &q, 2e-6);
        }
        let mut beyond = arm.chain.forward(&[0.3, -0.5, straight, 0.4, 0.6, 0.1]);
        beyond.translation.vector *= 1.5;
        let mut out = Vec::new();
        arm.inverse(&beyond, &IkOptions::default(), &mut out);
        assert!(out.is_empty());
    }
}

#[test]
fn wrist_centre_on_axis_one() {
    for (arm, opw) in opw_arms() {
        // Lean back until the wrist centre stands over axis 1: bisection on θ2 with the elbow bent.
        let p = opw.parameters;
        let elbow = 1.9;
        let forward = |theta2: f64| {
            p.a1 + p.c2 * theta2.sin()
                + p.a2.hypot(p.c3) * (theta2 + elbow + p.a2.atan2(p.c3)).sin()
        };
        let (mut low, mut high) = (-2.0, 0.5);
        assert!(forward(low) * forward(high) < 0.0);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if forward(low) * forward(middle) <= 0.0 { high = middle } else { low = middle }
        }
        let mut q = [0.4, 0.0, 0.0, 0.3, 0.5, 0.2];
        q[1] = opw.maps[1].q(0.5 * (low + high));
        q[2] = opw.maps[2].q(elbow);
        let mut joints = arm.chain.joints().to_vec();
        for joint in &mut joints {
            (joint.lower, joint.upper) = (-7.0, 7.0);
        }
        let free = recognise(&Chain::new(joints, *arm.chain.last_from_tip()).unwrap()).unwrap();
        reaches(&free, &q, 1e-6);
        assert!(nearness(&free, &q).shoulder_m.unwrap() < 1e-12);
        assert!(nearness(&free, &q).condition > 1e6);
    }
}

#[test]
fn seven_joints_lined_up() {
    for (_, arm) in closed_form_arms() {
        let Solver::Srs(_) = &arm.solver else { continue };
        let general = [0.3, 0.5, -0.4, 0.9, 0.2, -0.7, 0.6];
        for zeros in [[1, 1], [3, 3], [5, 5], [1, 5], [3, 5], [1, 3]] {
            let mut q = general;
            for index in zeros {
                q[index] = 0.0;
            }
            // A stretched arm's elbow angle is known to the root of the rounding only.
            reaches(&arm, &q, 2e-6);
        }
        reaches(&arm, &[0.0; 7], 1e-6);
        let mut far = arm.chain.forward(&general);
        far.translation.vector.z += 5.0;
        let mut out = Vec::new();
        assert_eq!(arm.inverse(&far, &IkOptions::default(), &mut out), Coverage::Complete);
        assert!(out.is_empty());
    }
}

#[test]
fn no_number_is_no_solution() {
    for (_, arm) in closed_form_arms() {
        let mut target = arm.chain.forward(&[0.1; 7]);
        let mut out = Vec::new();
        for bad in [f64::NAN, f64::INFINITY, 1e300] {
            target.translation.vector.x = bad;
            arm.inverse(&target, &IkOptions::default(), &mut out);
            assert!(out.is_empty());
            let search = Arm { solver: Solver::Numeric(Numeric::default()), ..arm.clone() };
            search.inverse(&target, &IkOptions::default(), &mut out);
            assert!(out.is_empty());
        }
        arm.inverse(
            &arm.chain.forward(&[0.1; 7]),
            &IkOptions { seed: Some(&[f64::NAN; 7]), elbow_rad: f64::NAN },
            &mut out,
        );
        assert!(out.iter().all(|found| found.q.iter().all(|value| value.is_finite())));
    }
}

#[test]
fn solutions_on_a_limit_are_kept() {
    for (name, arm) in closed_form_arms() {
        let mut random = Xorshift::new(7);
        for axis in 0..arm.chain.dof() {
            for upper in [false, true] {
                let mut q = random_q(&arm.chain, &mut random);
                let limits = arm.chain.axes()[axis];
                q[axis] = if upper { limits.upper } else { limits.lower };
                let target = arm.chain.forward(&q);
                let mut out = Vec::new();
                arm.inverse(&target, &options(&arm, &q, None), &mut out);
                check_solutions(&arm, &target, &out);
                assert!(!out.is_empty(), "{name} joint {axis}");
                // Limits of the UR10e are singular postures (elbow folded at ±π, wrist lined up at ±2π):
                // there the posture is one of endless many, or known to the root of the rounding.
                let measures = nearness(&arm, &q);
                let singular = [measures.elbow_rad, measures.wrist_rad];
                if singular.into_iter().flatten().any(|angle| angle < 1e-9) {
                    continue;
                }
                let near = out.iter().map(|found| found.q.distance(&q)).fold(f64::MAX, f64::min);
                assert!(near < 1e-6, "{name} joint {axis}: {near}");
            }
        }
    }
}

#[test]
fn endless_joints_give_the_turn_next_to_the_seed() {
    let Some(arm) = arm("kuka_kr6r900sixx", "tool0", &[]) else { return };
    let mut joints = arm.chain.joints().to_vec();
    (joints[5].lower, joints[5].upper) = (f64::NEG_INFINITY, f64::INFINITY);
    let arm = recognise(&Chain::new(joints, *arm.chain.last_from_tip()).unwrap()).unwrap();
    let q = [0.3, -1.2, 1.4, 0.4, 0.8, 5.0 * TAU + 0.3];
    let out = reaches(&arm, &q, 1e-6);
    assert!(out.iter().all(|found| (found.q[5] - q[5]).abs() <= PI + 1e-9));
}
