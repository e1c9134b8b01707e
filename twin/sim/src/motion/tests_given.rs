//! Joint paths that a job brings.

use super::tests::{PROCESS, planned, prints};
use super::*;
use crate::cell::Job;
use crate::finding::{Code, Findings, Severity};
use crate::kinematics::Posture;
use crate::test_job::{job, strand, text};
use crate::toolpath::STEP_M;

/// A job's own joint path is followed row by row, however near its points are to each other.
#[test]
fn given_joints_are_followed_as_they_stand() {
    let points_mm: Vec<[f64; 3]> = (0..40).map(|k| [0.4 * f64::from(k), 0.0, 1.0]).collect();
    let free = job(&text("kr10-cone", PROCESS, &strand("a", &points_mm, "")));
    let arm = &free.cell.robot.arm;
    let mut rows = Vec::new();
    let mut before = Posture::new(&free.cell.home);
    for point in &free.strands[0].points {
        let mut solutions = Vec::new();
        solve(&free, *point, -Vector::z(), 0.0, 0.0, Some(&before), &mut solutions);
        before = strand::nearest(&solutions, &before).expect("within reach");
        rows.push(before.iter().map(|q| q.to_degrees()).collect::<Vec<f64>>());
    }
    let given = job(&text(
        "kr10-cone",
        PROCESS,
        &strand("a", &points_mm, &format!(", \"joints\": {rows:?}")),
    ));
    let (paths, motion) = planned(&given);
    let leg = prints(&motion).next().expect("one print");
    assert_eq!(leg.moments.len(), rows.len());
    for (moment, row) in leg.moments.iter().zip(&rows) {
        for (q, deg) in moment.q.iter().zip(row) {
            assert!((q - deg.to_radians()).abs() < 1e-15);
        }
    }
    let mut findings = Findings::default();
    let along = check(&given, &paths, &motion, &mut findings)[0].expect("it is reached");
    assert!(along.deviation_m < 1e-6, "{}", along.deviation_m);
    assert!(findings.sorted().is_empty(), "{:?}", findings.sorted());
    assert!(STEP_M > 0.4e-3 && arm.chain.dof() == 6);
}

/// A joint row that stands a millimetre beside its point is a TCP off the strand by a millimetre.
#[test]
fn given_joints_beside_the_strand_are_found() {
    let points_mm = [[0.0, 0.0, 1.0], [3.0, 0.0, 1.0]];
    let free = job(&text("kr10-cone", PROCESS, &strand("a", &points_mm, "")));
    let mut rows = Vec::new();
    for (point, off_m) in free.strands[0].points.iter().zip([0.0, 1e-3]) {
        let mut solutions = Vec::new();
        let beside = point + Vector::new(0.0, off_m, 0.0);
        solve(&free, beside, -Vector::z(), 0.0, 0.0, None, &mut solutions);
        let q = strand::nearest(&solutions, &free.cell.home).expect("within reach");
        rows.push(q.iter().map(|q| q.to_degrees()).collect::<Vec<f64>>());
    }
    let job = job(&text(
        "kr10-cone",
        PROCESS,
        &strand("a", &points_mm, &format!(", \"joints\": {rows:?}")),
    ));
    let (paths, motion) = planned(&job);
    let along = check(&job, &paths, &motion, &mut Findings::default())[0].expect("it is reached");
    assert!((along.deviation_m - 1e-3).abs() < 1e-6, "{}", along.deviation_m);
}

/// Rows in degrees of a straight strand with the nozzle down; each is the posture nearest to the one before.
fn rows_along(free: &Job) -> Vec<Vec<f64>> {
    let mut before = Posture::new(&free.cell.home);
    let mut rows = Vec::new();
    for point in &free.strands[0].points {
        let mut solutions = Vec::new();
        solve(free, *point, -Vector::z(), 0.0, 0.0, Some(&before), &mut solutions);
        before = strand::nearest(&solutions, &before).expect("within reach");
        rows.push(before.iter().map(|q| q.to_degrees()).collect::<Vec<f64>>());
    }
    rows
}

fn judged(points_mm: &[[f64; 3]], rows: &[Vec<f64>], way: &str) -> (StrandMotion, Findings) {
    let more = format!(", \"joints\": {rows:?}, \"interpolation\": \"{way}\"");
    let job = job(&text("kr10-cone", PROCESS, &strand("a", points_mm, &more)));
    let (paths, motion) = planned(&job);
    let mut findings = Findings::default();
    let along = check(&job, &paths, &motion, &mut findings)[0].expect("it is reached");
    (along, findings)
}

/// Two rows 120 mm apart: a line of the TCP keeps to the strand, a line of the joints bulges off it.
/// Both are told, the one that the job asks for is judged.
#[test]
fn both_interpolations_are_told_and_one_is_judged() {
    let points_mm = [[-60.0, 0.0, 1.0], [60.0, 0.0, 1.0]];
    let free = job(&text("kr10-cone", PROCESS, &strand("a", &points_mm, "")));
    let rows = rows_along(&free);
    let off = |findings: &Findings| findings.sorted().iter().any(|f| f.code == Code::R107);
    let (linear, found) = judged(&points_mm, &rows, "linear");
    assert!(linear.deviation_linear_m < 1e-6, "{}", linear.deviation_linear_m);
    assert!(linear.deviation_joint_m > 1e-3, "{}", linear.deviation_joint_m);
    assert!(!off(&found) && linear.deviation_m == linear.deviation_linear_m);
    let (joint, found) = judged(&points_mm, &rows, "joint");
    assert!(off(&found) && joint.deviation_m == joint.deviation_joint_m);
    assert!((joint.deviation_joint_m - linear.deviation_joint_m).abs() < 2e-5);
    // Against the rows themselves, joints turning evenly, by brute force.
    let [from, to] = [&rows[0], &rows[1]]
        .map(|row| Posture::new(&row.iter().map(|deg| deg.to_radians()).collect::<Vec<f64>>()));
    let mut furthest_m = 0.0f64;
    for k in 0..=1000 {
        let mut q = from;
        for (value, target) in q.iter_mut().zip(to.iter()) {
            *value += (target - *value) * f64::from(k) / 1000.0;
        }
        let (point, _) = super::tests::nozzle(&free, &q);
        furthest_m = furthest_m.max(point.y.hypot(point.z - 1e-3));
    }
    assert!((joint.deviation_joint_m - furthest_m).abs() < 2e-5, "{furthest_m}");
}

/// The last joint a full turn further in the second row: the nozzle stays where it is, the cable does not.
#[test]
fn rows_a_full_turn_apart_are_a_flip() {
    let points_mm = [[-40.0, 0.0, 1.0], [40.0, 0.0, 1.0]];
    let free = job(&text("kr10-cone", PROCESS, &strand("a", &points_mm, "")));
    let mut rows = rows_along(&free);
    let last = rows[1].len() - 1;
    let turn = if rows[1][last] > 0.0 { -360.0 } else { 360.0 };
    for way in ["linear", "joint"] {
        let (_, found) = judged(&points_mm, &rows, way);
        assert!(found.sorted().iter().all(|f| f.code != Code::R104), "{way}");
    }
    rows[1][last] += turn;
    for way in ["linear", "joint"] {
        let (_, found) = judged(&points_mm, &rows, way);
        let flip = found.sorted().into_iter().find(|f| f.code == Code::R104).expect("a flip");
        assert_eq!(flip.severity, Severity::Error);
    }
}

/// The other wrist posture in the second row: same place, same axis, but the way there is none.
#[test]
fn rows_on_two_branches_are_a_flip() {
    let points_mm = [[-40.0, 0.0, 1.0], [40.0, 0.0, 1.0]];
    let free = job(&text("kr10-cone", PROCESS, &strand("a", &points_mm, "")));
    let arm = &free.cell.robot.arm;
    let mut rows = rows_along(&free);
    let first: Vec<f64> = rows[0].iter().map(|deg| deg.to_radians()).collect();
    let mut solutions = Vec::new();
    solve(&free, free.strands[0].points[1], -Vector::z(), 0.0, 0.0, None, &mut solutions);
    let other = solutions.iter().find(|s| {
        let (a, b) = (s.branch, arm.branch(&first));
        a.wrist != b.wrist && a.elbow == b.elbow && a.shoulder == b.shoulder
    });
    rows[1] = other.expect("two wrists").q.iter().map(|q| q.to_degrees()).collect();
    for way in ["linear", "joint"] {
        let (_, found) = judged(&points_mm, &rows, way);
        assert!(found.sorted().iter().any(|f| f.code == Code::R104), "{way}");
    }
}
