//! Closed forms and identities.

use super::*;

#[test]
fn mass_matrix_energy_and_forward_dynamics_agree() {
    let mut random = Random(31);
    for path in [KR6, UR10E] {
        let (_, model) = arm(path);
        for _ in 0..50 {
            let (q, qd) = (random_vector(6, 3.0, &mut random), random_vector(6, 2.0, &mut random));
            let mass = model.mass_matrix(&q);
            let speed = nalgebra::DVector::from_column_slice(&qd);
            let energy = 0.5 * speed.dot(&(&mass * &speed));
            let theirs = model.kinetic_energy_j(&q, &qd);
            assert!((energy - theirs).abs() < 1e-12 * theirs.max(1.0), "{energy} {theirs}");
            let qdd = random_vector(6, 10.0, &mut random);
            let torques = model.torques(&State { q, qd, qdd });
            let back = model.accelerations(&q, &qd, &torques).unwrap();
            assert!(back.distance(&qdd) < 1e-8, "{back:?} {qdd:?}");
        }
    }
}

/// A double pendulum of points, by hand: Lagrange's equations in absolute angles, turned to
/// relative ones.
#[test]
fn two_links_are_those_of_the_textbook() {
    let (mass, length) = (1.3, 0.7);
    let (_, model) = pendulum(2, mass, length, 0.0);
    let mut random = Random(3);
    for _ in 0..100 {
        let state = State {
            q: random_vector(2, 3.0, &mut random),
            qd: random_vector(2, 3.0, &mut random),
            qdd: random_vector(2, 3.0, &mut random),
        };
        let (q, v, a) = (state.q, state.qd, state.qdd);
        let (sin, cos) = q[1].sin_cos();
        let unit = mass * length * length;
        let weight = mass * 9.806_65 * length;
        let outer =
            unit * ((1.0 + cos) * a[0] + a[1] + sin * v[0] * v[0]) + weight * (q[0] + q[1]).sin();
        let inner = unit
            * ((3.0 + 2.0 * cos) * a[0] + (1.0 + cos) * a[1]
                - sin * (2.0 * v[0] * v[1] + v[1] * v[1]))
            + weight * (2.0 * q[0].sin() + (q[0] + q[1]).sin());
        let torques = model.torques(&state);
        assert!((torques[0] - inner).abs() < 1e-12 * 100.0, "{} {inner}", torques[0]);
        assert!((torques[1] - outer).abs() < 1e-12 * 100.0, "{} {outer}", torques[1]);
    }
}

#[test]
fn a_force_on_the_tip_is_the_transposed_jacobian() {
    let mut random = Random(8);
    for path in [KR6, UR10E] {
        let (chain, model) = arm(path);
        for _ in 0..50 {
            let state = State {
                q: random_vector(6, 3.0, &mut random),
                qd: random_vector(6, 1.0, &mut random),
                qdd: random_vector(6, 1.0, &mut random),
            };
            let tip = Wrench { force: random.vector() * 50.0, moment: random.vector() * 5.0 };
            let (free, pushed) = (model.torques(&state), model.torques_against(&state, &tip));
            let jacobian = chain.jacobian(&state.q);
            for joint in 0..6 {
                let column = jacobian.column(joint);
                let power =
                    (0..3).map(|i| column[i] * tip.force[i] + column[i + 3] * tip.moment[i]);
                let expected = free[joint] - power.sum::<f64>();
                assert!((pushed[joint] - expected).abs() < 1e-10, "{path}");
            }
        }
    }
}

/// A payload at the tip is the same arm with a heavier last link, and weighs on it like its weight
/// on the tip.
#[test]
fn a_payload_weighs_what_it_weighs() {
    let (chain, model) = arm(KR6);
    let mut random = Random(9);
    let load = Body::point(3.0, Vector::zeros());
    let loaded = model.with_payload(&load);
    assert!((loaded.mass_kg() - model.mass_kg() - 3.0).abs() < 1e-12);
    for _ in 0..20 {
        let q = random_vector(6, 2.0, &mut random);
        let weight = Wrench { force: EARTH * 3.0, moment: Vector::zeros() };
        let pushed = model.torques_against(&State::at_rest(&q), &weight);
        assert!(loaded.holding_torques(&q).distance(&pushed) < 1e-11);
        let (tip, theirs) = (model.tip(&q), chain.forward(&q));
        assert!((tip.translation.vector - theirs.translation.vector).norm() < 1e-14);
    }
}

/// Turning gravity is turning the base.
#[test]
fn an_arm_on_a_wall_holds_what_the_turned_arm_holds() {
    let (robot, tree) = read(KR6);
    let bodies = bodies_from_urdf(&robot, &tree).unwrap();
    let wall = Pose::rotation(Vector::new(0.3, 1.4, -0.2));
    let turned = Model::new(&tree.chain.with_base(&wall), &bodies, EARTH).unwrap();
    let down = wall.rotation.inverse_transform_vector(&EARTH);
    let tilted = Model::new(&tree.chain, &bodies, down).unwrap();
    let mut random = Random(2);
    for _ in 0..20 {
        let q = random_vector(6, 2.0, &mut random);
        assert!(turned.holding_torques(&q).distance(&tilted.holding_torques(&q)) < 1e-11);
    }
}

#[test]
fn torque_along_a_path_is_linear_in_acceleration_and_squared_speed() {
    let (_, model) = arm(UR10E);
    let mut random = Random(12);
    for _ in 0..50 {
        let [q, dq, ddq] = [2.0, 1.0, 1.0].map(|scale| random_vector(6, scale, &mut random));
        let along = model.along(&q, &dq, &ddq);
        let (speed, acceleration) = (2.0 * random.next(), 3.0 * random.next());
        let mut state = State { q, qd: dq, qdd: ddq };
        for joint in 0..6 {
            state.qd[joint] = dq[joint] * speed;
            state.qdd[joint] = dq[joint] * acceleration + ddq[joint] * speed * speed;
        }
        let torques = model.torques(&state);
        for joint in 0..6 {
            let theirs = along.torque(joint, speed, acceleration);
            assert!((torques[joint] - theirs).abs() < 1e-10, "{joint}");
        }
    }
}

#[test]
fn speeds_and_accelerations_come_back_from_samples() {
    let (_, model) = arm(KR6);
    let swing = |t: f64| {
        let q: Vec<f64> = (0..6).map(|i| (0.5 + 0.1 * i as f64) * (t + i as f64).sin()).collect();
        JointVector::new(&q)
    };
    // Uneven steps, a time that stands still, one that runs back.
    let mut samples: Vec<(f64, JointVector)> = (0..400)
        .map(|k| 0.005 * f64::from(k) + 0.001 * f64::from(k % 3))
        .map(|t| (t, swing(t)))
        .collect();
    samples.insert(100, samples[99]);
    samples.insert(200, (samples[199].0 - 0.5, swing(0.0)));
    let motion = differentiate(&samples, 0.02);
    assert_eq!(motion.len(), 400);
    for moment in &motion[5..395] {
        for joint in 0..6 {
            let (size, phase) = (0.5 + 0.1 * joint as f64, moment.t_s + joint as f64);
            let (speed, rate) = (size * phase.cos(), -size * phase.sin());
            assert!((moment.state.qd[joint] - speed).abs() < 3e-4);
            assert!((moment.state.qdd[joint] - rate).abs() < 5e-3);
            let between = at_time(&motion, moment.t_s + 0.002).unwrap();
            let there = size * (phase + 0.002).sin();
            assert!((between.q[joint] - there).abs() < 1e-6);
        }
    }
    let peaks = torque_shares(&model, &[Some(100.0), None], &samples, 0.02);
    assert_eq!(peaks.len(), 6);
    assert!(peaks[0].share().unwrap() > 0.0 && peaks[1].share().is_none());
    let exact = torque_peaks(&model, &[], &motion);
    assert_eq!(exact[2].torque, peaks[2].torque);
    assert!(torque_shares(&model, &[], &[], 0.02).is_empty());
    for few in 1..5 {
        assert_eq!(differentiate(&samples[..few], 0.02).len(), few);
    }
    let line = [(0.0, swing(0.0)), (1.0, swing(1.0))];
    let rate = differentiate(&line, 0.1)[0].state;
    assert!((rate.qd[0] - 0.5 * 1.0_f64.sin()).abs() < 1e-12 && rate.qdd[0] == 0.0);
}
