//! E508: what errors of calibration do to the place of the nozzle relative to the part.

use crate::cell::{Form, Job, Join, Mode, On};
use crate::finding::{Check, Code, Findings, Phase, Site, Words};
use crate::interval::Interval;
use crate::motion::{Leg, Motion};
use crate::pose::{Point, Pose};
use crate::toolpath::Path;

/// What was measured not quite right.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ErrorSource {
    /// Place of the tool, key `tool_mm`.
    ToolOffset,
    /// Turn of the tool, `tool_deg`.
    ToolTurn,
    /// Place of the bed, `base_mm`.
    BaseOffset,
    /// Turn of the bed, `base_deg`.
    BaseTurn,
    /// Place of the form, `form_mm`.
    FormOffset,
    /// Turn of the form, `form_deg`.
    FormTurn,
}

impl ErrorSource {
    /// The key of the cell file it stands under.
    pub fn key(self) -> &'static str {
        match self {
            Self::ToolOffset => "tool_mm",
            Self::ToolTurn => "tool_deg",
            Self::BaseOffset => "base_mm",
            Self::BaseTurn => "base_deg",
            Self::FormOffset => "form_mm",
            Self::FormTurn => "form_deg",
        }
    }
}

/// What one error does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contribution {
    /// The error.
    pub source: ErrorSource,
    /// How far it moves the nozzle relative to the part at most, m.
    pub displacement_m: f64,
}

/// Two strands that touch: the later and where on it, the earlier and where on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Meeting {
    /// The strand that is printed later, index in the job.
    pub strand: usize,
    /// Arc length on it, m.
    pub at_m: f64,
    /// The strand that is there.
    pub earlier: usize,
    /// Arc length on that one, m.
    pub earlier_at_m: f64,
}

/// The error budget of one strand.
#[derive(Debug, Clone, PartialEq)]
pub struct StrandBudget {
    /// Index of the strand in the job.
    pub strand: usize,
    /// Worst place by arc length, m, and in part axes.
    pub at_m: f64,
    /// The same in part axes.
    pub point: Point,
    /// Root of the sum of squares there, against bed, form and fixtures, m. As much may be missing
    /// from a clearance.
    pub displacement_m: f64,
    /// What it is made of.
    pub parts: Vec<Contribution>,
    /// Against the strands it meets, m: what moves all of them alike does not count.
    pub between_m: f64,
    /// Whether bed or form decide where it must be; else only the strands it meets do.
    pub grounded: bool,
}

impl StrandBudget {
    /// What is held against the limit, m.
    pub fn held_m(&self) -> f64 {
        if self.grounded { self.displacement_m.max(self.between_m) } else { self.between_m }
    }
}

/// Error budget of every strand of the job, in its order.
///
/// To first order an error of `d` in place and `ω` in turn of tool, bed or form moves the nozzle
/// relative to what it prints on by `d + ω × r`; over all directions that is at most
///
/// ```text
/// |d|   and   |ω| · |r|
/// ```
///
/// with lever `r` from the flange's centre to the orifice (tool on flange; zero for a tool that
/// stands), from the bed's origin to the place, from the form's middle to the place. The six add by
/// the root of their squares: they are independent. The error of second order is `|ω|²|r|/2`, a
/// thousandth of the first at 0.1°.
///
/// Two strands printed with rotations `R₁`, `R₂` of the tool (part axes) share the errors of bed and
/// form; an error `e` of the tool parts them by `|(R₁ − R₂) e| ≤ 2 sin(φ/2) |e|`, φ the angle between.
pub fn budget(
    job: &Job,
    paths: &[Path],
    motion: &Motion,
    meetings: &[Meeting],
) -> Vec<StrandBudget> {
    let mut budgets: Vec<StrandBudget> = paths.iter().map(|path| against_bed(job, path)).collect();
    let mut prints: Vec<Option<&Leg>> = vec![None; job.strands.len()];
    for leg in motion.legs.iter().filter(|leg| leg.phase == Phase::Print) {
        if let Some(strand) = leg.strand {
            prints[strand] = Some(leg);
        }
    }
    let calibration = &job.cell.calibration;
    let tool_m = calibration.tool.offset_m.hypot(calibration.tool.turn_rad * tool_lever_m(job));
    let rotation = |strand: usize, at_m: f64| {
        let moments = &prints[strand]?.moments;
        let k = moments.partition_point(|moment| moment.at_m < at_m - 1e-12);
        let moment = moments.get(k).or(moments.last())?;
        Some(job.part_from_tool(&moment.q).rotation)
    };
    let mut meets = vec![false; budgets.len()];
    for meeting in meetings {
        meets[meeting.strand] = true;
        let turns = rotation(meeting.strand, meeting.at_m)
            .zip(rotation(meeting.earlier, meeting.earlier_at_m));
        let angle_rad = turns.map_or(std::f64::consts::PI, |(one, other)| one.angle_to(&other));
        let apart_m = 2.0 * (angle_rad / 2.0).sin() * tool_m;
        let budget = &mut budgets[meeting.strand];
        budget.between_m = budget.between_m.max(apart_m);
    }
    for (budget, meets) in budgets.iter_mut().zip(meets) {
        budget.grounded |= !meets;
    }
    budgets
}

/// Holds the budget against the capture radius of a landing. Errors that nobody measured can only
/// warn: nominally they are zero.
pub fn judge_budget(job: &Job, budgets: &[StrandBudget], findings: &mut Findings) {
    let limit = job.limits.node_miss_m;
    for budget in budgets {
        let held_m = budget.held_m();
        let measured = if job.cell.calibration.stated {
            Interval::exact(held_m)
        } else {
            Interval::new(0.0, 0.0, held_m)
        };
        let site = Site::strand(budget.strand, budget.at_m).during(Phase::Print).at(budget.point);
        let check =
            Check { code: Code::E508, measured, limit, warn_limit: None, site, time_s: None };
        findings.check(check, || words(job, budget, limit));
    }
}

fn words(job: &Job, budget: &StrandBudget, limit: f64) -> Words {
    let id = &job.strands[budget.strand].id;
    let assumed = if job.cell.calibration.stated { "" } else { " (assumed, not measured)" };
    if budget.held_m() > budget.displacement_m || !budget.grounded {
        return Words {
            message: format!(
                "errors of the tool{assumed} part strand `{id}` by {:.2} mm from the strands it meets, printed with the tool turned otherwise",
                budget.between_m * 1e3
            ),
            hint: format!(
                "measure the tool {:.1} times better, or hold the spin of both alike",
                budget.between_m / limit
            ),
        };
    }
    let mut parts = budget.parts.clone();
    parts.sort_by(|a, b| b.displacement_m.total_cmp(&a.displacement_m));
    let told: Vec<String> = parts
        .iter()
        .map(|part| format!("{} {:.2}", part.source.key(), part.displacement_m * 1e3))
        .collect();
    Words {
        message: format!(
            "calibration{assumed} leaves the nozzle {:.2} mm of doubt on strand `{id}` at {:.1} mm, in mm: {}",
            budget.displacement_m * 1e3,
            budget.at_m * 1e3,
            told.join(", ")
        ),
        hint: better(job, budget, &parts[0], limit),
    }
}

/// The accuracy of the largest part with which the whole would be at its limit.
fn better(job: &Job, budget: &StrandBudget, worst: &Contribution, limit: f64) -> String {
    let rest = budget.displacement_m.powi(2) - worst.displacement_m.powi(2);
    let left = limit * limit - rest;
    if left <= 0.0 {
        let factor = budget.displacement_m / limit;
        return format!("measure tool, bed and form {factor:.1} times better");
    }
    let factor = left.sqrt() / worst.displacement_m;
    let calibration = &job.cell.calibration;
    let (key, now) = match worst.source {
        ErrorSource::ToolOffset => ("tool_mm", calibration.tool.offset_m * 1e3),
        ErrorSource::ToolTurn => ("tool_deg", calibration.tool.turn_rad.to_degrees()),
        ErrorSource::BaseOffset => ("base_mm", calibration.base.offset_m * 1e3),
        ErrorSource::BaseTurn => ("base_deg", calibration.base.turn_rad.to_degrees()),
        ErrorSource::FormOffset => ("form_mm", calibration.form.offset_m * 1e3),
        ErrorSource::FormTurn => ("form_deg", calibration.form.turn_rad.to_degrees()),
    };
    format!("measure so that `{key}` is {:.3} or less instead of {now:.3}", now * factor)
}

fn against_bed(job: &Job, path: &Path) -> StrandBudget {
    let strand = &job.strands[path.strand];
    let joins = [strand.start.join, strand.end.join];
    let on_form =
        |index: usize| strand.on == On::Form(index) || joins.contains(&Some(Join::Form(index)));
    let form = (0..job.forms.len()).find(|&index| on_form(index)).map(|k| middle(&job.forms[k]));
    let grounded = strand.on != On::Air || joins.contains(&Some(Join::Bed)) || form.is_some();
    let mut worst: Option<StrandBudget> = None;
    for sample in &path.samples {
        let parts = parts(job, &job.bed_from_part, &sample.point, form);
        let squares: f64 = parts.iter().map(|part| part.displacement_m.powi(2)).sum();
        let displacement_m = squares.sqrt();
        if worst.as_ref().is_none_or(|worst| displacement_m > worst.displacement_m) {
            worst = Some(StrandBudget {
                strand: path.strand,
                at_m: sample.at_m,
                point: sample.point,
                displacement_m,
                parts,
                between_m: 0.0,
                grounded,
            });
        }
    }
    worst.expect("a path has samples")
}

fn parts(job: &Job, bed_from_part: &Pose, point: &Point, form: Option<Point>) -> Vec<Contribution> {
    let calibration = &job.cell.calibration;
    let part = |source, displacement_m| Contribution { source, displacement_m };
    let bed_lever_m = (bed_from_part * point).coords.norm();
    let mut parts = vec![
        part(ErrorSource::ToolOffset, calibration.tool.offset_m),
        part(ErrorSource::ToolTurn, calibration.tool.turn_rad * tool_lever_m(job)),
        part(ErrorSource::BaseOffset, calibration.base.offset_m),
        part(ErrorSource::BaseTurn, calibration.base.turn_rad * bed_lever_m),
    ];
    if let Some(middle) = form {
        let lever_m = (point - middle).norm();
        parts.push(part(ErrorSource::FormOffset, calibration.form.offset_m));
        parts.push(part(ErrorSource::FormTurn, calibration.form.turn_rad * lever_m));
    }
    parts
}

/// From the flange's centre to the orifice, m; a tool that stands in the world is taken as turned
/// about its orifice.
fn tool_lever_m(job: &Job) -> f64 {
    match job.cell.mode {
        Mode::ToolOnFlange => job.cell.tool_pose.translation.vector.norm(),
        Mode::BedOnFlange => 0.0,
    }
}

/// Middle of the box around a form, part axes.
fn middle(form: &Form) -> Point {
    let mut corners = form.vertices.iter().copied();
    let first = corners.next().unwrap_or_else(Point::origin);
    let (low, high) = corners.fold((first, first), |(low, high), p| (low.inf(&p), high.sup(&p)));
    nalgebra::center(&low, &high)
}
