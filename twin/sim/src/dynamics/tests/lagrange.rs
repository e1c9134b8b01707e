//! Torques against Lagrange's equation, energies against points in motion.

use super::*;

/// Derivative by central differences, extrapolated to h → 0 (Romberg): error of order h¹⁰.
fn derivative(step: f64, f: impl Fn(f64) -> f64) -> f64 {
    let mut column = [0.0; 5];
    for (level, entry) in column.iter_mut().enumerate() {
        let h = step / f64::powi(2.0, level as i32);
        *entry = (f(h) - f(-h)) / (2.0 * h);
    }
    for order in 1..5 {
        let factor = f64::powi(4.0, order);
        for level in (order as usize..5).rev() {
            column[level] = (factor * column[level] - column[level - 1]) / (factor - 1.0);
        }
    }
    column[4]
}

fn moved(q: &JointVector, joint: usize, by: f64) -> JointVector {
    let mut moved = *q;
    moved[joint] += by;
    moved
}

/// `τ_i = d/dt ∂T/∂q̇_i − ∂T/∂q_i + ∂V/∂q_i`, from nothing but the two energies. `T` is quadratic
/// in `q̇`, so that its central difference there is exact for any step.
fn lagrange(model: &Model, state: &State) -> JointVector {
    let momentum = |q: &JointVector, qd: &JointVector, joint: usize| {
        let energy = |by: f64| model.kinetic_energy_j(q, &moved(qd, joint, by));
        (energy(1.0) - energy(-1.0)) / 2.0
    };
    let later = |t: f64| {
        let (mut q, mut qd) = (state.q, state.qd);
        for joint in 0..q.len() {
            q[joint] += state.qd[joint] * t + 0.5 * state.qdd[joint] * t * t;
            qd[joint] += state.qdd[joint] * t;
        }
        (q, qd)
    };
    let mut torques = JointVector::zeros(model.dof());
    for joint in 0..model.dof() {
        let rate = derivative(0.1, |t| {
            let (q, qd) = later(t);
            momentum(&q, &qd, joint)
        });
        let pull = derivative(0.4, |by| {
            let q = moved(&state.q, joint, by);
            model.potential_energy_j(&q) - model.kinetic_energy_j(&q, &state.qd)
        });
        torques[joint] = rate + pull;
    }
    torques
}

fn random_state(dof: usize, random: &mut Random) -> State {
    State {
        q: random_vector(dof, 3.0, random),
        qd: random_vector(dof, 2.0, random),
        qdd: random_vector(dof, 5.0, random),
    }
}

/// Greatest difference of any joint over that joint's own torque or, where that is small, over a
/// thousandth of the greatest torque of the state.
fn worst(model: &Model, states: usize, seed: u64) -> f64 {
    let mut random = Random(seed);
    let mut worst = 0.0_f64;
    for _ in 0..states {
        let down = random.vector().normalize() * 9.806_65;
        let model = model.with_gravity(down);
        let state = random_state(model.dof(), &mut random);
        let (ours, theirs) = (model.torques(&state), lagrange(&model, &state));
        let greatest = theirs.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        for (a, b) in ours.iter().zip(theirs.iter()) {
            worst = worst.max((a - b).abs() / b.abs().max(1e-3 * greatest));
        }
    }
    worst
}

/// Row 6 of the issue: 1000 random states of both arms, gravity in any direction (walls, ceilings),
/// a tool on them.
#[test]
fn torques_of_the_arms_agree_with_the_energy() {
    let tool = Body::cuboid(
        2.0,
        Vector::new(0.1, 0.06, 0.2),
        &Pose::new(Vector::new(0.03, -0.02, 0.08), Vector::new(0.2, 0.4, -0.3)),
    );
    for (path, seed) in [(KR6, 11), (UR10E, 23)] {
        let (_, model) = arm(path);
        let bare = worst(&model, 1000, seed);
        let geared = model.with_payload(&tool).with_rotors(&[2.0, 3.0, 1.0, 0.1, 0.2, 0.05]);
        let loaded = worst(&geared, 1000, seed + 1);
        println!(
            "{path}: worst relative difference {bare:.1e} bare, {loaded:.1e} with tool and rotors"
        );
        assert!(bare < 1e-6 && loaded < 1e-6, "{path}: {bare} {loaded}");
    }
}

#[test]
fn torques_of_chains_with_sliding_and_following_joints_agree_with_the_energy() {
    use JointKind::{Prismatic, Revolute};
    let mut random = Random(5);
    for kinds in [
        vec![Prismatic, Revolute, Prismatic, Revolute, Revolute],
        vec![Revolute, Prismatic, Prismatic, Revolute],
        vec![Prismatic, Prismatic, Prismatic],
        vec![Revolute; 7],
    ] {
        let (chain, bodies) = random_arm(&kinds, &mut random);
        let model = Model::new(&chain, &bodies, EARTH).unwrap();
        let worst = worst(&model, 50, 3);
        assert!(worst < 1e-6, "{kinds:?}: {worst}");
    }
    let (chain, bodies) = random_arm(&[Revolute; 5], &mut random);
    let mut joints = chain.joints().to_vec();
    joints[1].mimic = Some(crate::kinematics::Mimic { master: 3, multiplier: -2.0, offset: 0.3 });
    joints[4].mimic = Some(crate::kinematics::Mimic { master: 1, multiplier: 0.5, offset: -0.1 });
    let chain = Chain::new(joints, Pose::identity()).unwrap();
    let model = Model::new(&chain, &bodies, EARTH).unwrap();
    assert_eq!(model.dof(), 3);
    let worst = worst(&model, 50, 4);
    assert!(worst < 1e-6, "followers: {worst}");
}

/// Six points that weigh, balance and turn like the body: two on each principal axis of `½ tr I 1 −
/// I`.
fn points(body: &Body) -> Vec<(f64, Vector)> {
    let second = Matrix3::from_diagonal_element(body.inertia.trace() / 2.0) - body.inertia;
    let eigen = second.symmetric_eigen();
    let mut points = Vec::new();
    for (value, axis) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        let reach = axis * (3.0 * value.max(0.0) / body.mass_kg).sqrt();
        for side in [-1.0, 1.0] {
            points.push((body.mass_kg / 6.0, body.centre + reach * side));
        }
    }
    points
}

/// The energies that the torques were held against, from forward kinematics of the chain alone:
/// every body as points, their speeds by differences of their places.
#[test]
fn energies_are_those_of_points_in_motion() {
    use JointKind::{Prismatic, Revolute};
    let mut random = Random(17);
    let (robot, tree) = read(KR6);
    let bodies = bodies_from_urdf(&robot, &tree).unwrap();
    let mixed = random_arm(&[Revolute, Prismatic, Revolute, Prismatic], &mut random);
    for (chain, bodies) in [(tree.chain, bodies), mixed] {
        let model = Model::new(&chain, &bodies, EARTH).unwrap();
        for _ in 0..20 {
            let state = random_state(model.dof(), &mut random);
            let place = |t: f64, link: usize, point: &Vector| {
                let mut q = state.q;
                q.iter_mut().zip(state.qd.iter()).for_each(|(q, qd)| *q += qd * t);
                let mut poses = Vec::new();
                chain.link_poses(&q, &mut poses);
                poses[link].transform_point(&(*point).into()).coords
            };
            let (mut kinetic, mut potential) = (0.0, 0.0);
            for (link, body) in bodies.iter().enumerate() {
                for (mass_kg, point) in points(body) {
                    let speed = |i: usize| derivative(0.05, |t| place(t, link, &point)[i]);
                    let speed = Vector::new(speed(0), speed(1), speed(2));
                    kinetic += 0.5 * mass_kg * speed.norm_squared();
                    potential -= mass_kg * EARTH.dot(&place(0.0, link, &point));
                }
            }
            let ours = model.kinetic_energy_j(&state.q, &state.qd);
            assert!((ours - kinetic).abs() < 1e-9 * kinetic, "{ours} {kinetic}");
            let ours = model.potential_energy_j(&state.q);
            assert!(
                (ours - potential).abs() < 1e-9 * (1.0 + potential.abs()),
                "{ours} {potential}"
            );
        }
    }
}
