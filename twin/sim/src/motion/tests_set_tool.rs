//! Tools set per point: the nozzle leaves the chord where the part turns.

use super::set_tool::nozzle_at;
use super::tests::{PROCESS, nozzle, planned, prints};
use super::*;
use crate::cell::{Job, LinearMove};
use crate::finding::{Code, Findings};
use crate::test_job::{job, strand, text};

/// The move played in the world: the bed's next point runs straight to the nozzle, the bed turns evenly.
#[test]
fn the_closed_form_is_what_the_world_does() {
    let from = pose::from_xyz_rpy([0.01, -0.02, 0.03], [0.3, -0.2, 1.0]);
    let to = pose::from_xyz_rpy([0.05, 0.01, 0.02], [0.1, 0.4, 1.3]);
    let world_from_nozzle = pose::from_xyz_rpy([-0.037, 0.768, 1.55], [3.1, 0.1, 0.2]);
    let world_from_bed =
        [from, to].map(|bed_from_nozzle| world_from_nozzle * bed_from_nozzle.inverse());
    let next = Point::from(to.translation.vector);
    let start = world_from_bed[0] * next;
    let end = Point::from(world_from_nozzle.translation.vector);
    for k in 0..=20 {
        let t = f64::from(k) / 20.0;
        let turned = world_from_bed[0].rotation.slerp(&world_from_bed[1].rotation, t);
        let place = start + (end - start) * t;
        // the bed so that its next point is at `place`
        let origin = place - turned * next.coords;
        let bed = Pose::from_parts(origin.coords.into(), turned);
        let wanted = bed.inverse() * world_from_nozzle;
        let got = nozzle_at(&from, &to, t);
        assert!((got.translation.vector - wanted.translation.vector).norm() < 1e-12, "{t}");
        assert!(got.rotation.angle_to(&wanted.rotation) < 1e-7, "{t}");
    }
}

/// 50 mm and 20° about an axis across: half way 25 mm·sin 10° = 4.34 mm off the chord, L·θ/4 = 4.36 mm.
#[test]
fn fifty_millimetres_and_twenty_degrees_leave_the_chord_by_four() {
    let to = pose::from_xyz_rpy([0.05, 0.0, 0.0], [0.0, 20f64.to_radians(), 0.0]);
    let half = nozzle_at(&Pose::identity(), &to, 0.5).translation.vector;
    let wanted_m = 25e-3 * 10f64.to_radians().sin();
    assert!((half.y.hypot(half.z) - wanted_m).abs() < 1e-12, "{half}");
    assert!((wanted_m - 50e-3 * 20f64.to_radians() / 4.0).abs() < 0.03e-3);
    // Turned about the chord itself it does not leave it.
    let to = pose::from_xyz_rpy([0.05, 0.0, 0.0], [20f64.to_radians(), 0.0, 0.0]);
    let half = nozzle_at(&Pose::identity(), &to, 0.5).translation.vector;
    assert!((half - Vector::new(0.025, 0.0, 0.0)).norm() < 1e-12);
}

/// A strand of 50 mm in `n` segments along which the nozzle tilts by 20° about the axis across.
fn tilting(n: usize) -> Job {
    let at = |k: usize| k as f64 / n as f64;
    let points_mm: Vec<[f64; 3]> = (0..=n).map(|k| [50.0 * at(k) - 25.0, 0.0, 20.0]).collect();
    let direction = |k: usize| {
        let tilt = (20.0 * at(k)).to_radians();
        [tilt.sin(), 0.0, -tilt.cos()]
    };
    let directions: Vec<[f64; 3]> = (0..=n).map(direction).collect();
    let more = format!(r#", "directions": {directions:?}, "orientation": {{ "spin": 0 }}"#);
    job(&text("kirkman-sda10d", PROCESS, &strand("a", &points_mm, &more)))
}

/// In the cell: the nozzle is where the closed form says, the deviation is told and judged as R107, and
/// more points mend it.
#[test]
fn the_cell_leaves_the_strand_and_says_so() {
    let job = tilting(1);
    assert_eq!(job.cell.controller.linear, LinearMove::SetTool);
    let (paths, motion) = planned(&job);
    let leg = prints(&motion).next().expect("one print");
    assert!(leg.unreached.is_empty());
    let ends: Vec<Pose> =
        [0, leg.moments.len() - 1].map(|k| job.cell.bed_from_tool(&leg.moments[k].q)).into();
    for moment in &leg.moments {
        let wanted = nozzle_at(&ends[0], &ends[1], moment.at_m / paths[0].length_m);
        let (point, _) = nozzle(&job, &moment.q);
        let wanted = job.bed_from_part.inverse() * Point::from(wanted.translation.vector);
        assert!((point - wanted).norm() < 1e-8, "{} at {}", (point - wanted).norm(), moment.at_m);
    }
    let mut findings = Findings::default();
    let along = check(&job, &paths, &motion, &mut findings)[0].expect("it is reached");
    assert!((along.deviation_m - 4.34e-3).abs() < 0.05e-3, "{}", along.deviation_m);
    let off = findings.sorted().into_iter().find(|finding| finding.code == Code::R107);
    assert!((off.expect("a finding").measured.nominal - along.deviation_m).abs() < 1e-12);

    let fine = tilting(10);
    let (paths, motion) = planned(&fine);
    let mut findings = Findings::default();
    let along = check(&fine, &paths, &motion, &mut findings)[0].expect("it is reached");
    assert!(along.deviation_m < 0.06e-3, "{}", along.deviation_m);
    assert!(findings.sorted().iter().all(|finding| finding.code != Code::R107));

    let mut straight = tilting(1);
    straight.cell.controller.linear = LinearMove::Tcp;
    let (paths, motion) = planned(&straight);
    let along = check(&straight, &paths, &motion, &mut Findings::default())[0].expect("reached");
    assert!(along.deviation_linear_m < 1e-8, "{}", along.deviation_linear_m);
}

/// A free spin that turned along a long segment would leave it by millimetres: the search holds it.
#[test]
fn a_free_spin_is_held_where_it_would_leave_the_strand() {
    let points_mm = [[-40.0, -10.0, 20.0], [40.0, 10.0, 20.0]];
    let job = job(&text("kirkman-sda10d", PROCESS, &strand("a", &points_mm, "")));
    let (paths, motion) = planned(&job);
    let along = check(&job, &paths, &motion, &mut Findings::default())[0].expect("it is reached");
    assert!(along.deviation_m < 0.2e-3, "{}", along.deviation_m);
}
