//! Bodies, and what joints carry.

use super::*;

#[test]
fn bodies_join_like_their_points() {
    let box_body = |size: f64| Body::cuboid(size, Vector::repeat(size), &Pose::identity());
    // Two halves of a box make the box.
    let half = Body::cuboid(1.0, Vector::new(0.5, 1.0, 1.0), &Pose::translation(0.25, 0.0, 0.0));
    let other = Body::cuboid(1.0, Vector::new(0.5, 1.0, 1.0), &Pose::translation(-0.25, 0.0, 0.0));
    let whole = half.with(&other);
    let expected = Body::cuboid(2.0, Vector::repeat(1.0), &Pose::identity());
    assert!((whole.centre - expected.centre).norm() < 1e-15);
    assert!((whole.inertia - expected.inertia).norm() < 1e-15);
    // A rod of two halves, seen from elsewhere.
    let mut random = Random(1);
    let (a, b) = (random.vector(), random.vector());
    let middle = (a + b) / 2.0;
    let joined = Body::rod(0.5, a, middle).with(&Body::rod(0.5, middle, b));
    assert!((joined.inertia - Body::rod(1.0, a, b).inertia).norm() < 1e-15);
    let pose = random.pose();
    let there = box_body(1.0).with(&joined).seen_from(&pose);
    let also = box_body(1.0).seen_from(&pose).with(&joined.seen_from(&pose));
    assert!((there.inertia - also.inertia).norm() < 1e-14);
    assert!((there.centre - also.centre).norm() < 1e-14);
    assert_eq!(Body::none().with(&Body::none()), Body::none());
}

#[test]
fn fixed_links_ride_on_their_joint() {
    let text = r#"<robot name="r">
      <link name="a"/><link name="b"><inertial><origin xyz="0 0 0.1"/><mass value="2"/>
        <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
      <link name="c"><inertial><mass value="1"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
      <link name="tip"/>
      <joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" velocity="1"/></joint>
      <joint name="f" type="fixed"><origin xyz="0 0 0.4"/><parent link="b"/><child link="c"/></joint>
      <joint name="k" type="revolute"><parent link="c"/><child link="tip"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" velocity="1"/></joint>
    </robot>"#;
    let robot = slam::urdf::parse(&slam::Source::new("r", text)).unwrap();
    let tree = from_urdf(&robot, "a", "c", &[]).unwrap();
    let bodies = bodies_from_urdf(&robot, &tree).unwrap();
    assert_eq!(bodies.len(), 1);
    assert!((bodies[0].mass_kg - 3.0).abs() < 1e-15);
    assert!((bodies[0].centre.z - 0.2).abs() < 1e-15);
    // 0.1 of the link and μ d² = (2/3)·0.3² about the joint centre.
    assert!((bodies[0].inertia[(0, 0)] - 0.16).abs() < 1e-15);
    let tree = from_urdf(&robot, "a", "tip", &[]).unwrap();
    let fault = bodies_from_urdf(&robot, &tree).unwrap_err();
    assert_eq!(fault.to_string(), "the URDF states no mass for anything that joint `k` carries");
}

/// The arms of the library that have masses have those of the files they name.
#[test]
fn published_masses_stand_in_the_library() {
    for (path, moving_kg) in [(KR6, 38.243_552_62), (UR10E, 29.104)] {
        let (chain, model) = arm(path);
        assert!((model.mass_kg() - moving_kg).abs() < 1e-9, "{path}: {}", model.mass_kg());
        assert!(chain.joints().iter().all(|joint| joint.effort.is_some()), "{path}");
    }
    for path in ["kuka/kr6_r900_sixx/robot.urdf", "kuka/kr10_r1100_sixx/robot.urdf"] {
        let (robot, tree) = read(path);
        assert!(bodies_from_urdf(&robot, &tree).is_err(), "{path}");
    }
}

#[test]
fn bodies_that_fit_no_chain_are_refused() {
    let (chain, _) = pendulum(2, 1.0, 1.0, 0.0);
    let body = Body::point(1.0, Vector::zeros());
    let fault = |bodies: &[Body]| Model::new(&chain, bodies, EARTH).unwrap_err();
    assert_eq!(fault(&[body]), ModelFault::Bodies { joints: 2, bodies: 1 });
    let bad = Body::point(f64::NAN, Vector::zeros());
    assert_eq!(fault(&[body, bad]), ModelFault::BadBody { joint: "j".to_owned() });
    let joints = vec![joint(JointKind::Revolute, Pose::identity(), Vector::y()); 9];
    let long = Chain::new(joints, Pose::identity()).unwrap();
    let fault = Model::new(&long, &[body; 9], EARTH).unwrap_err();
    assert_eq!(fault, ModelFault::TooManyJoints { joints: 9, dof: 9 });
}
