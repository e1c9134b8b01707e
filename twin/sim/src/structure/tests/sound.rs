//! What is refused by name, and what a turn of the whole frame must not change.

use super::peers::reference;
use super::*;
use crate::pose::from_xyz_rpy;
use crate::structure::{FrameFault, SolveError, solve};

const DOWN: [f64; 3] = [0.0, 0.0, -9.80665];

#[test]
fn floating_pieces_are_named() {
    let frame = chain(Vector::x(), 0.05, 3);
    let weight = falling(DOWN);
    assert_eq!(solve(&frame, &[], &weight), Err(SolveError::Floats { node: 0 }));
    let members = vec![rod([0, 1]), rod([3, 2])];
    let apart = Frame::new(frame.nodes().to_vec(), members).unwrap();
    assert_eq!(solve(&apart, &clamped([0]), &weight), Err(SolveError::Floats { node: 2 }));
    // a node without member
    let lonely = Frame::new(frame.nodes().to_vec(), vec![rod([0, 1]), rod([1, 3])]).unwrap();
    assert_eq!(solve(&lonely, &clamped([0]), &weight), Err(SolveError::Floats { node: 2 }));
}

#[test]
fn mechanisms_are_named() {
    let frame = chain(Vector::new(1.0, 0.5, 0.3), 0.05, 3);
    let weight = falling(DOWN);
    // pinned at one end: it swings; pinned at both: it spins about itself
    for supports in [vec![Support::pinned(0)], vec![Support::pinned(0), Support::pinned(3)]] {
        let error = solve(&frame, &supports, &weight).unwrap_err();
        assert!(matches!(error, SolveError::Mechanism { node: 0..=3, freedom: 0..=5 }), "{error}");
    }
    let spin = chain(Vector::x(), 0.05, 2);
    let error = solve(&spin, &[Support::pinned(0), Support::pinned(2)], &weight).unwrap_err();
    assert!(matches!(error, SolveError::Mechanism { freedom: 3, .. }), "{error}");
    // and one held freedom more is enough
    let mut second = Support::pinned(2);
    second.fixed[3] = true;
    assert!(solve(&spin, &[Support::pinned(0), second], &weight).is_ok());
}

/// Slender and long is not a mechanism.
#[test]
fn a_long_chain_is_not_a_mechanism() {
    let frame = chain(Vector::new(0.2, 0.1, 1.0), 2.0, 200);
    let solution = solve(&frame, &clamped([0]), &pushed(200, [1e-3, 0.0, 0.0, 0.0, 0.0, 0.0]));
    let solution = solution.unwrap();
    // the residual says how ill-conditioned this is: rounding of K u, 1e-16 * 1e6 N/m * 1 m, over 1 mN
    assert!(solution.residual < 1e-5, "{}", solution.residual);
    let x = Vector::new(0.2, 0.1, 1.0).normalize();
    let push = Vector::x() * 1e-3;
    let side = push - x * x.dot(&push);
    let ei = 3.5e9 * Section::circle(2e-3).iy_m4;
    let tip = Vector::from_column_slice(&solution.displacement[200][..3]);
    near((tip - x * x.dot(&tip)).norm(), side.norm() * 8.0 / (3.0 * ei), 1e-5);
}

/// A short stocky link between slender strands is solved too, if it has shear.
#[test]
fn a_short_link_is_not_a_mechanism() {
    let nodes = vec![
        Point::origin(),
        Point::new(0.05, 0.0, 0.0),
        Point::new(0.05, 0.0, 2e-5),
        Point::new(0.05, 0.05, 2e-5),
    ];
    let link =
        Member { density_kg_m3: 0.0, section: Section::circle(2e-3).sheared(0.9), ..rod([1, 2]) };
    let frame = Frame::new(nodes, vec![rod([0, 1]), link, rod([2, 3])]).unwrap();
    let solution = solve(&frame, &clamped([0]), &falling(DOWN)).unwrap();
    assert!(solution.residual < 1e-8, "{}", solution.residual);
}

#[test]
fn unusable_frames_are_refused() {
    let nodes = vec![Point::origin(), Point::new(0.0, 0.0, 0.1), Point::origin()];
    let made = |member: Member| Frame::new(nodes.clone(), vec![member]);
    assert_eq!(made(rod([0, 3])), Err(FrameFault::NoSuchNode { member: 0, node: 3 }));
    assert_eq!(made(rod([0, 2])), Err(FrameFault::NoLength { member: 0 }));
    assert_eq!(made(rod([1, 1])), Err(FrameFault::NoLength { member: 0 }));
    let thin = Member { section: Section::circle(0.0), ..rod([0, 1]) };
    assert_eq!(made(thin), Err(FrameFault::Constants { member: 0 }));
    let nan = Member { elastic: Elastic { e_pa: f64::NAN, g_pa: 1.0 }, ..rod([0, 1]) };
    assert_eq!(made(nan), Err(FrameFault::Constants { member: 0 }));
    let far = vec![Point::new(f64::INFINITY, 0.0, 0.0)];
    assert_eq!(Frame::new(far, vec![]), Err(FrameFault::NotFinite { node: 0 }));
    let frame = made(rod([0, 1])).unwrap();
    let bad = solve(&frame, &clamped([9]), &falling(DOWN));
    assert_eq!(bad, Err(SolveError::BadNode { node: 9 }));
    let bad = solve(&frame, &clamped([0]), &falling([0.0, f64::NAN, 0.0]));
    assert_eq!(bad, Err(SolveError::BadGravity));
    let bad = solve(&frame, &clamped([0]), &pushed(1, [f64::NAN; 6]));
    assert_eq!(bad, Err(SolveError::BadNode { node: 1 }));
}

/// Turn and move the frame, its loads and gravity: the answer turns with it.
#[test]
fn a_turned_frame_answers_turned() {
    let reference = reference("f050.json");
    let frame = &reference.frame;
    let straight = solve(frame, &reference.supports, &falling(DOWN)).unwrap();
    for rpy in [[1.1, -0.4, 2.0], [std::f64::consts::FRAC_PI_2, 0.0, 0.0], [0.0, 3.0, -1.0]] {
        let pose = from_xyz_rpy([0.3, -2.0, 0.7], rpy);
        let nodes = frame.nodes().iter().map(|node| pose * node).collect();
        let turned = Frame::new(nodes, frame.members().to_vec()).unwrap();
        let gravity = pose.rotation * Vector::from(DOWN);
        let load = falling([gravity.x, gravity.y, gravity.z]);
        let solution = solve(&turned, &reference.supports, &load).unwrap();
        let back = |six: &[f64; 6]| {
            [0, 3].map(|from| {
                let part = Vector::new(six[from], six[from + 1], six[from + 2]);
                let part = pose.rotation.inverse() * part;
                [part.x, part.y, part.z]
            })
        };
        let got: Vec<f64> = solution.displacement.iter().flat_map(back).flatten().collect();
        let wanted: Vec<f64> = straight.displacement.iter().flatten().copied().collect();
        assert!(block_gap(&got, &wanted) < 1e-10);
    }
}

/// A section with two different stiffnesses bends about the axis its side names.
#[test]
fn side_names_the_axis() {
    let ribbon = Section::ellipse(4e-3, 1e-3);
    for (side, second_moment_m4) in
        [(Vector::x(), ribbon.iz_m4), (Vector::new(0.0, 2.0, 5.0), ribbon.iy_m4)]
    {
        let nodes = vec![Point::origin(), Point::new(0.0, 0.0, 0.05)];
        let one = Member { section: ribbon, side, ..rod([0, 1]) };
        let frame = Frame::new(nodes, vec![one]).unwrap();
        let load = pushed(1, [0.01, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let tip = solve(&frame, &clamped([0]), &load).unwrap().displacement[1][0];
        near(tip, 0.01 * 0.05f64.powi(3) / (3.0 * 3.5e9 * second_moment_m4), 1e-10);
    }
}
