use super::fall::STEP_S;
use super::*;
use crate::structure::{Elastic, Member, Section};
use proptest::prelude::*;

const G: f64 = 9.80665;
const RADIUS_M: f64 = 1e-3;
/// What rapier may leave of an overlap, m: its slop of 0.01 mm, and what its soft contacts add.
const SINKS_M: f64 = 5e-5;

fn frame(nodes: &[[f64; 3]], members: &[[usize; 2]]) -> Frame {
    let member = |ends: &[usize; 2]| Member {
        ends: *ends,
        section: Section::circle(2.0 * RADIUS_M),
        elastic: Elastic::isotropic(3.5e9, 0.33),
        density_kg_m3: 1240.0,
        initial_strain: 0.0,
        side: Vector::zeros(),
        strand: 0,
    };
    let nodes = nodes.iter().map(|&node| Point::from(node)).collect();
    Frame::new(nodes, members.iter().map(member).collect()).expect("a sound frame")
}

fn down() -> Vector {
    Vector::new(0.0, 0.0, -G)
}

const BED: Ground =
    Ground { part_from_bed: Pose { rotation: UNTURNED, translation: ORIGIN }, forms: &[] };
const UNTURNED: nalgebra::UnitQuaternion<f64> =
    nalgebra::UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(1.0, 0.0, 0.0, 0.0));
const ORIGIN: nalgebra::Translation3<f64> =
    nalgebra::Translation3 { vector: nalgebra::Vector3::new(0.0, 0.0, 0.0) };

fn drop_it(frame: &Frame, supports: &[Support], breaks: &[Break]) -> Collapse {
    let born = frame.members().len();
    let failing = Failing { frame, born, supports, breaks, gravity_m_s2: down() };
    collapse(&failing, &BED).expect("a usable frame")
}

/// Lowest point of a piece over the bed, m.
fn lowest_m(piece: &Piece, at: usize) -> f64 {
    let ends = piece.bits.iter().flat_map(|bit| bit.ends.map(|end| (end, bit.radius_m)));
    ends.map(|(end, radius_m)| (piece.poses[at] * end).z - radius_m).fold(f64::INFINITY, f64::min)
}

/// `z = -g t²/2` until it lands, within `g t dt/2`, the error of a step that is explicit in place; rounding of `f32`
/// is 1e-5 m of 0.3 m, and gravity leans by a part in a thousand.
#[test]
fn a_free_piece_falls_as_galilei_says() {
    let height_m = 0.3;
    let frame = frame(
        &[[0.0, 0.0, height_m], [0.05, 0.0, height_m], [0.05, 0.03, height_m]],
        &[[0, 1], [1, 2]],
    );
    let fallen = drop_it(&frame, &[], &[]);
    assert_eq!((fallen.pieces.len(), fallen.rest.len()), (1, 0));
    let lands_s = (2.0 * (height_m - RADIUS_M) / G).sqrt();
    let mut seen = 0;
    for (&time_s, pose) in fallen.times_s.iter().zip(&fallen.pieces[0].poses) {
        if time_s >= lands_s {
            break;
        }
        let wanted_m = -G * time_s * time_s / 2.0;
        let z_m = pose.translation.z;
        assert!((z_m - wanted_m).abs() <= G * time_s * STEP_S / 2.0 + 1e-5, "{z_m} for {wanted_m}");
        assert!(pose.translation.vector.xy().norm() <= 1.1e-3 * wanted_m.abs() + 1e-5);
        assert!(pose.rotation.angle() < 1e-5);
        seen += 1;
    }
    assert!(seen > 10, "{seen}");
}

#[test]
fn what_fell_lies_on_the_bed() {
    let frame = frame(&[[0.0, 0.0, 0.1], [0.05, 0.0, 0.12], [0.05, 0.03, 0.15]], &[[0, 1], [1, 2]]);
    let fallen = drop_it(&frame, &[], &[]);
    let piece = &fallen.pieces[0];
    let last = piece.poses.len() - 1;
    let low_m = lowest_m(piece, last);
    println!("lowest point at 1 s: {:.4} mm", low_m * 1e3);
    assert!(low_m.abs() < SINKS_M, "{low_m}");
    let deepest_m = (0..=last).map(|at| lowest_m(piece, at)).fold(0.0, f64::min);
    println!("deepest at any moment: {:.4} mm", deepest_m * 1e3);
    assert!(deepest_m > -SINKS_M, "{deepest_m}");
}

/// What falls on a strand that stands does not go through it.
#[test]
fn a_piece_lands_on_what_stands() {
    let nodes = [[-0.1, 0.0, 0.05], [0.1, 0.0, 0.05], [0.0, -0.02, 0.2], [0.0, 0.021, 0.2]];
    let frame = frame(&nodes, &[[0, 1], [2, 3]]);
    let fallen = drop_it(&frame, &[Support::clamped(0)], &[]);
    assert_eq!((fallen.pieces.len(), fallen.rest.len()), (1, 1));
    // at 0.2 s a free one would have passed the bar at 0.05 m by far
    let at = fallen.times_s.iter().position(|t| *t >= 0.199).expect("told");
    assert!(fallen.times_s[at] < 0.201);
    let middle = fallen.pieces[0].poses[at] * Point::new(0.0, 0.0, 0.2);
    println!("over the bar's axis: {:.3} mm", (middle.z - 0.05) * 1e3);
    assert!((middle.z - 0.05 - 2.0 * RADIUS_M).abs() < 5e-4, "{middle}");
}

/// A leaf that stands on its tip topples: it is shown lying, and to the same side on every machine.
#[test]
fn nothing_stands_on_its_tip() {
    let frame = frame(&[[0.0, 0.0, 0.0015], [0.0, 0.0, 0.015]], &[[0, 1]]);
    let fallen = drop_it(&frame, &[], &[]);
    let top = fallen.pieces[0].poses[50] * Point::new(0.0, 0.0, 0.015);
    println!("top after 1 s: {top}");
    assert!(top.z < 2.0 * RADIUS_M && top.x > 0.005 && top.y > 0.005, "{top}");
}

/// A form is hit too.
#[test]
fn a_piece_lands_on_a_form() {
    let vertices =
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| Point::new(x, y, 0.1));
    let form = Mesh { vertices: &vertices, triangles: &[[0, 1, 2], [0, 2, 3]] };
    let frame = frame(&[[0.0, 0.1, 0.15], [0.05, 0.1, 0.15]], &[[0, 1]]);
    let failing =
        Failing { frame: &frame, born: 1, supports: &[], breaks: &[], gravity_m_s2: down() };
    let fallen = collapse(&failing, &Ground { forms: &[form], ..BED }).expect("usable");
    let low_m = lowest_m(&fallen.pieces[0], 50) - 0.1;
    println!("over the form: {:.4} mm", low_m * 1e3);
    assert!(low_m.abs() < SINKS_M, "{low_m}");
}

#[test]
fn a_held_frame_gives_no_pieces() {
    let frame = frame(&[[0.0, 0.0, 0.1], [0.05, 0.0, 0.12], [0.05, 0.03, 0.15]], &[[0, 1], [1, 2]]);
    let three = [0, 1, 2].map(Support::pinned);
    for supports in [&[Support::clamped(1)][..], &three] {
        let fallen = drop_it(&frame, supports, &[]);
        assert_eq!((fallen.pieces.len(), fallen.rest.len()), (0, 2));
        assert_eq!(fallen.times_s.len(), 51);
    }
}

/// Two pins leave a turn about the line through them: it swings, and the pins stay.
#[test]
fn a_mechanism_swings() {
    let nodes = [[0.0, 0.0, 0.2], [0.1, 0.0, 0.2], [0.05, 0.06, 0.2]];
    let frame = frame(&nodes, &[[0, 1], [1, 2], [2, 0]]);
    let fallen = drop_it(&frame, &[Support::pinned(0), Support::pinned(1)], &[]);
    assert_eq!(fallen.pieces.len(), 1);
    let mut swung_m = 0.0f64;
    for pose in &fallen.pieces[0].poses {
        for node in &nodes[..2] {
            let node = Point::from(*node);
            assert!((pose * node - node).norm() < 1e-4, "{}", (pose * node - node).norm());
        }
        swung_m = swung_m.max((pose * Point::from(nodes[2]) - Point::from(nodes[2])).norm());
    }
    assert!(swung_m > 0.08, "{swung_m}");
}

#[test]
fn a_broken_cantilever_leaves_a_stub_and_drops_the_rest() {
    let frame = frame(&[[0.0, 0.0, 0.1], [0.1, 0.0, 0.1]], &[[0, 1]]);
    let fallen = drop_it(&frame, &[Support::clamped(0)], &[Break { member: 0, share: 0.25 }]);
    assert_eq!((fallen.pieces.len(), fallen.rest.len()), (1, 1));
    let x = |point: &Point| point.x;
    let (stub, free) = (fallen.rest[0].ends, fallen.pieces[0].bits[0].ends);
    let wanted = [0.0, 0.025 - RADIUS_M, 0.025 + RADIUS_M, 0.1];
    for (found, wanted) in stub.iter().chain(&free).map(x).zip(wanted) {
        assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
    }
    assert!(lowest_m(&fallen.pieces[0], 50).abs() < SINKS_M);
    // at the support itself nothing is left standing
    let fallen = drop_it(&frame, &[Support::clamped(0)], &[Break { member: 0, share: 0.0 }]);
    assert_eq!((fallen.pieces.len(), fallen.rest.len()), (1, 0));
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let (nodes, members) = grid(6);
    let frame = frame(&nodes, &members);
    let supports = [Support::clamped(0)];
    let breaks = [
        Break { member: 3, share: 0.3 },
        Break { member: 10, share: 0.5 },
        Break { member: 0, share: 1.0 },
        Break { member: 1, share: 0.9 },
    ];
    let once = drop_it(&frame, &supports, &breaks);
    assert!(!once.pieces.is_empty());
    assert_eq!(once, drop_it(&frame, &supports, &breaks));
}

#[test]
fn what_cannot_be_used_is_refused() {
    let frame = frame(&[[0.0, 0.0, 0.1], [0.1, 0.0, 0.1]], &[[0, 1]]);
    let good = Failing { frame: &frame, born: 1, supports: &[], breaks: &[], gravity_m_s2: down() };
    let refused = |failing: Failing| collapse(&failing, &BED).err();
    assert_eq!(refused(good), None);
    let far = [Support::clamped(2)];
    assert_eq!(refused(Failing { supports: &far, ..good }), Some(Refused::NotThere));
    assert_eq!(refused(Failing { born: 2, ..good }), Some(Refused::NotThere));
    assert_eq!(refused(Failing { born: MOST_MEMBERS + 1, ..good }), Some(Refused::TooMany));
    let nowhere = [Break { member: 0, share: f64::NAN }];
    assert_eq!(refused(Failing { breaks: &nowhere, ..good }), Some(Refused::NotThere));
    let strong = Vector::new(f64::INFINITY, 0.0, 0.0);
    assert_eq!(refused(Failing { gravity_m_s2: strong, ..good }), Some(Refused::OutOfRange));
    let form = Mesh { vertices: &[], triangles: &[[0, 1, 2]] };
    assert_eq!(collapse(&good, &Ground { forms: &[form], ..BED }), Err(Refused::NotThere));
}

/// A flat grid of `n` by `n` squares, one bead apart from the bed, 20 mm wide each.
fn grid(n: usize) -> (Vec<[f64; 3]>, Vec<[usize; 2]>) {
    let at = |i: usize, j: usize| i * (n + 1) + j;
    let mut nodes = Vec::new();
    let mut members = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            nodes.push([0.02 * i as f64, 0.02 * j as f64, 0.1 + 0.001 * (i + j) as f64]);
            if j < n {
                members.push([at(i, j), at(i, j + 1)]);
            }
            if i < n {
                members.push([at(i, j), at(i + 1, j)]);
            }
        }
    }
    (nodes, members)
}

/// The most members there may be, in one piece that falls: the cost that the limit stands for.
#[test]
#[ignore = "some ten seconds"]
fn the_largest_frame_falls_in_bounded_time() {
    let (nodes, members) = grid(49);
    let frame = frame(&nodes, &members);
    assert!(members.len() > 4_800 && members.len() <= MOST_MEMBERS);
    let begun = std::time::Instant::now();
    let fallen = drop_it(&frame, &[], &[]);
    println!("{} members fell in {:.2?}", members.len(), begun.elapsed());
    assert_eq!(fallen.pieces.len(), 1);
}

#[test]
fn a_struck_strand_turns_about_its_end_to_where_the_nozzle_is() {
    let (held, struck) = (Point::new(0.01, 0.02, 0.0), Point::new(0.01, 0.02, 0.05));
    let by = Vector::new(0.0, 0.05, 0.0);
    let pose = pushed_aside(held, struck, by);
    assert!((pose * held - held).norm() < 1e-15);
    assert!((pose.rotation.angle() - std::f64::consts::FRAC_PI_4).abs() < 1e-12);
    let moved = pose * struck - held;
    assert!((moved.normalize() - Vector::new(0.0, 0.5f64.sqrt(), 0.5f64.sqrt())).norm() < 1e-12);
    for (by, angle_rad) in
        [(Vector::zeros(), 0.0), (Vector::new(0.0, 0.0, -0.1), std::f64::consts::PI)]
    {
        assert!((pushed_aside(held, struck, by).rotation.angle() - angle_rad).abs() < 1e-12);
    }
    assert_eq!(pushed_aside(held, held, by), Pose::identity());
}

/// Nodes that flood from a clamped node along members that are not broken.
fn flooded(nodes: usize, members: &[[usize; 2]], broken: &[usize], held: &[usize]) -> Vec<bool> {
    let mut reached = vec![false; nodes];
    held.iter().for_each(|&node| reached[node] = true);
    for _ in 0..nodes {
        for (at, [a, b]) in members.iter().enumerate().filter(|(at, _)| !broken.contains(at)) {
            let _ = at;
            let both = reached[*a] || reached[*b];
            (reached[*a], reached[*b]) = (both, both);
        }
    }
    reached
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Pieces by union of sets against a flood, broken members in the middle.
    #[test]
    fn what_is_held_is_what_a_flood_reaches(
        members in prop::collection::vec((0usize..12, 0usize..12), 1..20),
        broken in prop::collection::vec(0usize..20, 0..5),
        held in prop::collection::vec(0usize..12, 0..3),
    ) {
        let members: Vec<[usize; 2]> = members.into_iter().filter(|(a, b)| a != b).map(|(a, b)| [a, b]).collect();
        let broken: Vec<usize> = broken.into_iter().filter(|at| *at < members.len()).collect();
        let nodes: Vec<[f64; 3]> = (0..12).map(|k| {
            let turn = f64::from(k) * 0.7;
            [0.05 * turn.cos(), 0.05 * turn.sin(), 0.02 * f64::from(k)]
        }).collect();
        let frame = frame(&nodes, &members);
        let supports: Vec<Support> = held.iter().map(|&node| Support::clamped(node)).collect();
        let breaks: Vec<Break> = broken.iter().map(|&member| Break { member, share: 0.5 }).collect();
        let failing = Failing { frame: &frame, born: members.len(), supports: &supports, breaks: &breaks, gravity_m_s2: down() };
        let (loose, rest) = pieces::pieces(&failing);
        let reached = flooded(12, &members, &broken, &held);
        for bit in &rest {
            let ends = members[bit.member];
            prop_assert!(ends.iter().any(|&node| reached[node]));
            prop_assert!(broken.contains(&bit.member) || ends.iter().all(|&node| reached[node]));
        }
        for bit in loose.iter().flat_map(|piece| &piece.bits) {
            let ends = members[bit.member];
            prop_assert!(ends.iter().any(|&node| !reached[node]) || broken.contains(&bit.member));
        }
        let whole = rest.iter().chain(loose.iter().flat_map(|piece| &piece.bits));
        let whole: std::collections::BTreeSet<usize> = whole.map(|bit| bit.member).collect();
        prop_assert_eq!(whole.len(), members.len());
    }

    #[test]
    fn any_strike_leaves_a_rigid_turn_about_the_held_end(
        numbers in prop::collection::vec(prop_oneof![-1.0f64..1.0, any::<f64>()], 9),
    ) {
        let p = |k: usize| Point::new(numbers[k], numbers[k + 1], numbers[k + 2]);
        let pose = pushed_aside(p(0), p(3), p(6).coords);
        prop_assert!(pose.to_homogeneous().iter().all(|x| x.is_finite()));
        if numbers.iter().all(|x| x.abs() <= 1.0) {
            prop_assert!((pose * p(0) - p(0)).norm() < 1e-12);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Whatever the numbers: an answer or a refusal, and every pose finite.
    #[test]
    fn any_frame_falls_or_is_refused(
        nodes in prop::collection::vec(prop::array::uniform3(-0.1f64..0.3), 2..7),
        members in prop::collection::vec((0usize..7, 0usize..7), 1..8),
        breaks in prop::collection::vec((0usize..8, -0.2f64..1.2), 0..4),
        fixed in prop::collection::vec((0usize..7, prop::array::uniform6(any::<bool>())), 0..4),
        gravity in prop::array::uniform3(prop_oneof![-20.0f64..20.0, any::<f64>()]),
        radius_m in prop_oneof![1e-7f64..0.5, Just(1e-3)],
    ) {
        let nodes: Vec<Point> = nodes.into_iter().map(Point::from).collect();
        let ends = members.into_iter().filter(|(a, b)| a != b && a.max(b) < &nodes.len());
        let base = frame(&[[0.0; 3], [1.0, 0.0, 0.0]], &[[0, 1]]).members()[0];
        let section = Section::circle(2.0 * radius_m);
        let members: Vec<Member> = ends.map(|(a, b)| Member { ends: [a, b], section, ..base }).collect();
        let Ok(frame) = Frame::new(nodes, members) else { return Ok(()) };
        let supports: Vec<Support> = fixed.into_iter().map(|(node, fixed)| Support { node, fixed }).collect();
        let breaks: Vec<Break> = breaks.into_iter().map(|(member, share)| Break { member, share }).collect();
        let failing = Failing {
            frame: &frame,
            born: frame.members().len(),
            supports: &supports,
            breaks: &breaks,
            gravity_m_s2: Vector::from(gravity),
        };
        if let Ok(fallen) = collapse(&failing, &BED) {
            for pose in fallen.pieces.iter().flat_map(|piece| &piece.poses) {
                prop_assert!(pose.to_homogeneous().iter().all(|x| x.is_finite()));
            }
        }
    }
}
