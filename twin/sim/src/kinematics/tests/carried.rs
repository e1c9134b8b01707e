//! Motion of what rides on the tip, against differences of forward kinematics.

use super::*;
use crate::pose::{Point, Vector};

fn joint(kind: JointKind, axis: Vector, from: Pose, mimic: Option<Mimic>) -> ChainJoint {
    ChainJoint {
        name: format!("{kind:?} {axis}"),
        kind,
        parent_from_joint: from,
        axis,
        lower: -9.0,
        upper: 9.0,
        velocity: 1.0,
        effort: None,
        mimic,
    }
}

/// Turning, sliding, turning, one that follows, sliding, turning.
fn chain() -> Chain {
    let at = |k: f64| from_xyz_rpy([0.1 * k, 0.2, 0.3 - 0.1 * k], [0.3 * k, -0.2, 0.5]);
    let follows = Some(Mimic { master: 2, multiplier: -0.7, offset: 0.2 });
    let (turns, slides) = (JointKind::Revolute, JointKind::Prismatic);
    let joints = vec![
        joint(turns, Vector::z(), at(1.0), None),
        joint(slides, Vector::new(1.0, 2.0, -1.0), at(2.0), None),
        joint(turns, Vector::y(), at(3.0), None),
        joint(turns, Vector::new(1.0, 1.0, 0.0), at(-1.0), follows),
        joint(slides, Vector::x(), at(0.5), None),
        joint(turns, Vector::new(0.2, -1.0, 0.4), at(-2.0), None),
    ];
    Chain::new(joints, from_xyz_rpy([0.05, -0.1, 0.2], [0.4, 0.1, -0.9])).unwrap()
}

#[test]
fn what_rides_moves_as_differences_of_the_pose_say() {
    let chain = chain();
    let tip_from_axes = from_xyz_rpy([0.1, 0.2, -0.3], [1.0, -0.5, 0.3]);
    let (q, speed) = ([0.3, -0.2, 1.1, 0.15, -0.8], [1.5, -0.4, 2.0, 0.3, -1.2]);
    let gain = [3.0, 1.0, -4.0, -0.5, 2.0];
    let pose = |t: f64| {
        let q: Vec<f64> = (0..5).map(|k| q[k] + speed[k] * t + gain[k] * t * t / 2.0).collect();
        chain.forward(&q) * tip_from_axes
    };
    let here = pose(0.0);
    let told = chain.carried([&q, &speed, &gain], &tip_from_axes);
    // a mass at some places of the axes: d²/dt² is a₀ + α × x + ω × (ω × x)
    for x in [Vector::zeros(), Vector::new(0.3, -0.1, 0.2), Vector::new(-1.0, 0.5, 2.0)] {
        let place = |t: f64| pose(t) * Point::from(x);
        let second = |h: f64| {
            let (before, now, after) = (place(-h), place(0.0), place(h));
            here.rotation.inverse() * ((after - now) - (now - before)) / (h * h)
        };
        // Richardson: of the fourth order
        let wanted = (second(1e-3) * 4.0 - second(2e-3)) / 3.0;
        let omega = told.omega_rad_s;
        let got =
            told.acceleration_m_s2 + told.alpha_rad_s2.cross(&x) + omega.cross(&omega.cross(&x));
        assert!((got - wanted).norm() < 1e-7 * wanted.norm(), "{got} {wanted}");
    }
}

/// A wheel: the rim goes inwards by ω² r.
#[test]
fn a_wheel() {
    let one = joint(JointKind::Revolute, Vector::z(), Pose::identity(), None);
    let chain = Chain::new(vec![one], Pose::translation(0.5, 0.0, 0.0)).unwrap();
    let told = chain.carried([&[0.7], &[3.0], &[2.0]], &Pose::identity());
    assert!((told.acceleration_m_s2 - Vector::new(-4.5, 1.0, 0.0)).norm() < 1e-14);
    assert_eq!(told.omega_rad_s, Vector::z() * 3.0);
    assert_eq!(told.alpha_rad_s2, Vector::z() * 2.0);
}
