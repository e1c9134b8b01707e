//! Payload and wrist moments.

use super::*;

#[test]
fn a_bed_gets_heavier_as_it_is_printed_on() {
    let plate = Body::cuboid(4.0, Vector::new(0.3, 0.3, 0.01), &Pose::identity());
    let strand = Body::rod(0.5, Vector::new(0.1, 0.0, 0.0), Vector::new(0.1, 0.0, 0.2));
    let load = carried(&[plate, strand]);
    let mass = payload(&load, 4.2);
    assert_eq!((mass.measured, mass.limit), (4.5, 4.2));
    assert!((load.centre - Vector::new(0.05 / 4.5, 0.0, 0.05 / 4.5)).norm() < 1e-15);
}

/// A horizontal KR 6 wrist with 3 kg 0.1 m off the flange axis: by hand.
#[test]
fn wrist_moments_are_weights_times_levers() {
    let (chain, model) = arm(KR6);
    let load = Body::point(3.0, Vector::new(0.1, 0.0, 0.05));
    // The flange is 90 mm from the wrist centre: the farthest about joint 5 is the whole arm of the
    // point.
    let along = 0.09 + 0.05;
    let about_five = f64::hypot(along, 0.1);
    for (joint, expected) in [(5, 0.1), (4, about_five), (3, about_five)] {
        let lever = greatest_lever(&chain, joint, load.centre);
        assert!(
            lever <= expected + 1e-12 && lever > (1.0 - 1e-6) * expected,
            "{joint}: {lever} {expected}"
        );
    }
    let rated = Some((6.0, Vector::new(0.06, 0.0, 0.08)));
    let q = [JointVector::zeros(6), JointVector::new(&[0.0, -1.0, 1.0, 0.5, 1.2, 0.0])];
    let moments = wrist_moments(&chain, &q, EARTH, &load, None, rated);
    assert_eq!(moments.iter().map(|m| m.joint).collect::<Vec<_>>(), [3, 4, 5]);
    assert!(moments.iter().all(|moment| moment.basis == Basis::RatedPayload));
    let last = moments[2].moment;
    assert!((last.measured - 3.0 * 9.806_65 * 0.1).abs() < 1e-9);
    assert!((last.limit - 6.0 * 9.806_65 * 0.06).abs() < 1e-9);
    let limits: Vec<Option<f64>> = chain.joints().iter().map(|joint| joint.effort).collect();
    let moments = wrist_moments(&chain, &q, EARTH, &load, Some((&model, &limits)), rated);
    assert!(moments.iter().all(|moment| moment.basis == Basis::Torque));
    let loaded = model.with_payload(&load);
    let held = q.map(|q| loaded.holding_torques(&q)[4].abs());
    assert_eq!(moments[1].moment.measured, held[0].max(held[1]));
    assert_eq!(moments[1].moment.limit, limits[4].unwrap());
    assert!(wrist_moments(&chain, &q, EARTH, &load, None, None).is_empty());
    // The tilted wrist is heavier on joint 5 than the same arm with the load turned round its
    // flange.
    assert!(held[0] > 0.0 && held[1] > 0.0);
    // A rated centre on the flange axis allows joint 6 nothing to be measured by.
    let on_axis = Some((6.0, Vector::new(0.0, 0.0, 0.08)));
    assert_eq!(wrist_moments(&chain, &q, EARTH, &load, None, on_axis).len(), 2);
}
