use super::*;
use crate::cell::{Calibration, PoseError};
use crate::pose::Vector;
use crate::{motion, toolpath};
use nalgebra::{Translation3, UnitQuaternion};

const NONE: PoseError = PoseError { offset_m: 0.0, turn_rad: 0.0 };

fn planned(cell: &str) -> (Job, Vec<crate::toolpath::Path>, Motion) {
    let strands = [strand("a", &LYING, ""), strand("b", &RISING, "")].join(",");
    let job = job(&text(cell, "", &strands));
    let paths = toolpath::paths(&job);
    let motion = motion::plan(&job, &paths);
    (job, paths, motion)
}

/// Largest move of the orifice relative to the part over directions of the error, in posture `q`.
fn moved(job: &Job, q: &Posture, wrong: impl Fn(&mut Job, Vector)) -> f64 {
    let right = orifice(job, q);
    let mut worst = 0.0_f64;
    // A few hundred directions: the best of them is within 1 % of the worst there is.
    for i in 0..24 {
        for k in 0..24 {
            let (polar, round) = (f64::from(i) * 0.131, f64::from(k) * 0.262);
            let direction =
                Vector::new(polar.sin() * round.cos(), polar.sin() * round.sin(), polar.cos());
            let mut other = job.clone();
            wrong(&mut other, direction);
            worst = worst.max((orifice(&other, q) - right).norm());
        }
    }
    worst
}

/// Row of the budget against the cell with that error put in: both modes, within 1 %.
#[test]
fn the_budget_is_what_a_wrong_cell_does() {
    let (offset_m, turn_rad) = (0.1e-3, 0.1_f64.to_radians());
    let error = PoseError { offset_m, turn_rad };
    for cell in ["kr6-hot-end", "kirkman-sda10d"] {
        let (mut job, paths, motion) = planned(cell);
        job.cell.calibration = Calibration { tool: error, base: error, form: NONE, stated: true };
        let budgets = budget(&job, &paths, &motion, &[]);
        for leg in motion.legs.iter().filter(|leg| leg.phase == Phase::Print) {
            let budget = &budgets[leg.strand.unwrap()];
            let at = leg.moments.iter().find(|moment| moment.at_m == budget.at_m).unwrap();
            let turn = |axis: Vector| UnitQuaternion::from_scaled_axis(axis * turn_rad);
            let on_flange = job.cell.mode == Mode::ToolOnFlange;
            let check = |source: ErrorSource, wrong: &dyn Fn(&mut Job, Vector)| {
                let part = budget.parts.iter().find(|part| part.source == source).unwrap();
                let found_m = moved(&job, &at.q, wrong);
                let off = (part.displacement_m - found_m).abs();
                assert!(
                    off < 0.01 * found_m + 1e-12,
                    "{cell} {source:?}: {} for {found_m}",
                    part.displacement_m
                );
            };
            check(ErrorSource::ToolOffset, &|job, along| {
                job.cell.tool_pose.translation.vector += along * offset_m;
            });
            check(ErrorSource::ToolTurn, &|job, axis| {
                let pose = job.cell.tool_pose;
                // On the flange about the flange's centre, else about the orifice.
                job.cell.tool_pose = if on_flange { turn(axis) * pose } else { pose * turn(axis) };
            });
            check(ErrorSource::BaseOffset, &|job, along| {
                job.cell.bed.pose.translation.vector += along * offset_m;
            });
            check(ErrorSource::BaseTurn, &|job, axis| {
                let pose = job.cell.bed.pose;
                job.cell.bed.pose = pose * turn(axis);
            });
            let squares: f64 = budget.parts.iter().map(|part| part.displacement_m.powi(2)).sum();
            assert!((budget.displacement_m - squares.sqrt()).abs() < 1e-15);
        }
    }
}

/// Two strands that meet: an error of the tool parts them by how much the tool turned in between.
#[test]
fn strands_that_meet_share_the_errors_of_the_bed() {
    let (mut job, paths, mut motion) = planned("kr6-hot-end");
    let error = PoseError { offset_m: 0.2e-3, turn_rad: 0.0 };
    job.cell.calibration = Calibration { tool: error, base: error, form: NONE, stated: true };
    let meeting = Meeting { strand: 1, at_m: 0.0, earlier: 0, earlier_at_m: 0.04 };
    let spun = 2.0;
    let print = motion.legs.iter_mut().rfind(|leg| leg.phase == Phase::Print).unwrap();
    for moment in &mut print.moments {
        moment.q[5] += spun;
    }
    let budgets = budget(&job, &paths, &motion, &[meeting]);
    assert!(!budgets[1].grounded && budgets[0].grounded);
    let q_of = |strand: usize, first: bool| {
        let is_it = |leg: &&Leg| leg.phase == Phase::Print && leg.strand == Some(strand);
        let moments = &motion.legs.iter().find(is_it).unwrap().moments;
        if first { moments[0].q } else { moments[moments.len() - 1].q }
    };
    let (earlier, later) = (q_of(0, false), q_of(1, true));
    let mut worst = 0.0_f64;
    for k in 0..360 {
        let angle = f64::from(k).to_radians();
        let mut wrong = job.clone();
        wrong.cell.tool_pose.translation.vector +=
            Vector::new(angle.cos(), angle.sin(), 0.0) * 0.2e-3;
        let shift = |q: &Posture| orifice(&wrong, q) - orifice(&job, q);
        worst = worst.max((shift(&later) - shift(&earlier)).norm());
    }
    assert!(worst > 0.05e-3, "the tool turned: {worst}");
    assert!((budgets[1].between_m - worst).abs() < 0.01 * worst, "{}", budgets[1].between_m);
    assert!((budgets[1].held_m() - budgets[1].between_m).abs() < 1e-18);
    // A bed that is off moves both alike.
    let lift = Translation3::new(0.0, 0.0, 0.2e-3);
    let mut wrong = job.clone();
    wrong.cell.bed.pose = lift * wrong.cell.bed.pose;
    let shift = |q: &Posture| orifice(&wrong, q) - orifice(&job, q);
    assert!((shift(&later) - shift(&earlier)).norm() < 1e-12);
}

/// The hint names the largest part and the accuracy with which the whole is at its limit; an
/// assumed error only warns.
#[test]
fn the_hint_of_the_budget_is_enough() {
    let (mut job, paths, motion) = planned("kr6-hot-end");
    let (tool, base) = (
        PoseError { offset_m: 1e-4, turn_rad: 0.004 },
        PoseError { offset_m: 1e-4, turn_rad: 0.02 },
    );
    job.cell.calibration = Calibration { tool, base, form: NONE, stated: true };
    job.limits.node_miss_m = 0.65e-3;
    let told = |job: &Job| {
        let budgets = budget(job, &paths, &motion, &[]);
        found(|findings| judge_budget(job, &budgets, findings))
    };
    let first = told(&job);
    assert_eq!((first.len(), first[0].code, first[0].severity), (2, Code::E508, Severity::Error));
    let mut keys = Vec::new();
    for finding in &first {
        let number = finding.hint.split_whitespace().find_map(|word| word.parse::<f64>().ok());
        // The number is told to three decimals.
        let enough_rad = (number.expect("a number") - 5e-4).to_radians();
        let mut better = job.clone();
        let calibration = &mut better.cell.calibration;
        let (key, turn_rad) = if finding.hint.contains("base_deg") {
            ("base_deg", &mut calibration.base.turn_rad)
        } else {
            ("tool_deg", &mut calibration.tool.turn_rad)
        };
        assert!(finding.message.contains(key) && enough_rad < *turn_rad, "{}", finding.message);
        keys.push(key);
        *turn_rad = enough_rad;
        let again = told(&better);
        let same = again.iter().find(|other| other.site.strand == finding.site.strand);
        assert!(same.is_none(), "{} {:?}", finding.hint, same);
    }
    // What lies near the bed's origin suffers from the tool, what stands up from the bed.
    assert_eq!(keys, ["tool_deg", "base_deg"]);
    job.cell.calibration.stated = false;
    let warned = told(&job);
    assert_eq!((warned.len(), warned[0].severity), (2, Severity::Warning));
    assert_eq!(warned[0].measured.nominal, 0.0);
}
