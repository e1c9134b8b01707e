//! Findings of reach and motion.

use nalgebra::center;

use super::given::Rows;
use super::measure::{Spot, StrandMotion};
use super::place::{self, sample_at};
use super::{Leg, Moment, Motion, transit};
use crate::cell::{Interpolation, Job};
use crate::finding::{Check, Code, Findings, Phase, Site, Words};
use crate::interval::Interval;
use crate::kinematics::{JointKind, Nearness, limit_margins, nearness};
use crate::pose::Point;
use crate::toolpath::{Path, STEP_M, Sample, stations};

/// TCP off the line by more than this share of the step between two samples is a flip: an even
/// motion of both ends leaves the middle by a part of it that falls with the step.
pub(super) const FLIP_SHARE: f64 = 0.5;
/// A joint that turns further than this between two samples flips.
const FLIP_RAD: f64 = std::f64::consts::FRAC_PI_2;
/// Joints that turn less than this do not flip: a nozzle that tilts fast bows its tip off the line.
pub(super) const EVEN_RAD: f64 = std::f64::consts::PI / 6.0;

/// Judges the motion; one entry per strand of the job, `None` where nothing is reached.
pub fn check(
    job: &Job,
    paths: &[Path],
    motion: &Motion,
    findings: &mut Findings,
) -> Vec<Option<StrandMotion>> {
    transit::tell(job, motion, findings);
    let mut strands = vec![None; job.strands.len()];
    for leg in &motion.legs {
        if let (Phase::Print, Some(strand)) = (leg.phase, leg.strand) {
            reach(job, leg, strand, findings);
            strands[strand] = along(&Along::new(job, &paths[strand], leg, strand), findings);
        }
    }
    strands
}

fn reach(job: &Job, leg: &Leg, strand: usize, findings: &mut Findings) {
    let first = leg.unreached.first();
    let (at_m, point) = first.copied().unwrap_or((0.0, job.strands[strand].points[0]));
    let site = Site::strand(strand, at_m).during(Phase::Print).at(point);
    let time_s = leg.moments.first().map(|moment| moment.time_s);
    findings.forbid(Code::R101, first.is_some(), site, time_s, || Words {
        message: format!(
            "{} of {} samples of strand `{}` are out of reach, the first at {:.1} mm",
            leg.unreached.len(),
            leg.unreached.len() + leg.moments.len(),
            job.strands[strand].id,
            at_m * 1e3
        ),
        hint: "move the part with `placement`, allow more tilt, or leave the spin free".to_owned(),
    });
}

struct Along<'a> {
    job: &'a Job,
    path: &'a Path,
    leg: &'a Leg,
    strand: usize,
    /// The strand's own joint path.
    rows: Option<Rows<'a>>,
    stations: Vec<f64>,
}

fn along(this: &Along<'_>, findings: &mut Findings) -> Option<StrandMotion> {
    let mut worst: Option<StrandMotion> = None;
    let mut before: Option<(&Moment, Sample)> = None;
    for moment in &this.leg.moments {
        let (_, sample) = sample_at(&this.path.samples, moment.at_m);
        let mut here = this.posture(moment, &sample, findings);
        let at_rows = this.offs(&sample, &moment.q, None);
        here = this.deviates(here, at_rows, moment, &sample, findings);
        if let Some((last, from)) = before {
            let (share, axis) = this.speed(last, moment, &sample, findings);
            here.joint_speed_share = share;
            here.joint_speed_at = Spot { at_m: sample.at_m, axis };
            let flips = this.flips((last, &from), (moment, &sample), findings);
            let middle = place::sample_between(&from, &sample, 0.5);
            let offs = this.offs(&middle, &last.q.toward(&moment.q, 0.5), Some((&from, &sample)));
            if !flips {
                here = this.deviates(here, offs, moment, &middle, findings);
            }
        }
        worst = Some(worst.map_or(here, |worst| worst.worse(here)));
        before = Some((moment, sample));
    }
    this.wraps(findings);
    worst
}

/// Distances of the TCP from the strand, m: with lines of the TCP, with joints turning evenly.
struct Offs {
    linear_m: f64,
    joint_m: f64,
}

impl<'a> Along<'a> {
    fn new(job: &'a Job, path: &'a Path, leg: &'a Leg, strand: usize) -> Self {
        let given = job.strands[strand].joints.as_ref();
        let rows = given.and_then(|rows| Rows::new(job, strand, rows));
        let stations = stations(&job.strands[strand].points);
        Self { job, path, leg, strand, rows, stations }
    }

    fn site(&self, sample: &Sample) -> Site {
        Site::strand(self.strand, sample.at_m).during(Phase::Print).at(sample.point)
    }

    fn id(&self) -> &str {
        &self.job.strands[self.strand].id
    }

    fn moves_joints(&self) -> bool {
        self.job.strands[self.strand].settings.interpolation == Interpolation::Joint
    }

    /// Margins and singularity of one posture.
    fn posture(&self, moment: &Moment, sample: &Sample, findings: &mut Findings) -> StrandMotion {
        let margin = self.margin(moment, sample, findings);
        let near = nearness(&self.job.cell.robot.arm, &moment.q);
        let limits = &self.job.limits;
        let [warn, stop] = limits.condition_number;
        let condition = near.condition.min(1e9);
        let check = Check {
            code: Code::R103,
            measured: Interval::exact(condition.max(on_condition_scale(&near, limits))),
            limit: stop,
            warn_limit: Some(warn),
            site: self.site(sample),
            time_s: Some(moment.time_s),
        };
        findings.check(check, || Words {
            message: match near.wrist_rad.filter(|_| near.condition <= warn) {
                Some(wrist_rad) => format!(
                    "wrist {:.1}° from its singularity, less than {:.1}°, on strand `{}` at {:.1} mm; condition number {:.1} (length scale 1 m)",
                    wrist_rad.to_degrees(),
                    limits.wrist_rad.to_degrees(),
                    self.id(),
                    sample.at_m * 1e3,
                    near.condition
                ),
                None => format!(
                    "condition number {:.1} (length scale 1 m) on strand `{}` at {:.1} mm, nearest to the {}",
                    near.condition,
                    self.id(),
                    sample.at_m * 1e3,
                    nearest_singularity(&near)
                ),
            },
            hint: "turn the spin, tilt the nozzle or move the part away from this posture".to_owned(),
        });
        StrandMotion::of(sample.at_m, &near, margin)
    }

    /// The joint nearest to a stop, and how near, rad.
    fn margin(
        &self,
        moment: &Moment,
        sample: &Sample,
        findings: &mut Findings,
    ) -> Option<(usize, f64)> {
        let chain = &self.job.cell.robot.arm.chain;
        let margins = limit_margins(chain, &moment.q);
        let revolute =
            |axis: usize| chain.joints()[chain.axes()[axis].joint].kind == JointKind::Revolute;
        let axis = (0..chain.dof())
            .filter(|&axis| revolute(axis) && margins[axis].is_finite())
            .min_by(|&a, &b| margins[a].total_cmp(&margins[b]))?;
        let margin = margins[axis];
        let check = Check {
            code: Code::R102,
            measured: Interval::exact(margin),
            limit: self.job.limits.joint_margin_rad,
            warn_limit: None,
            site: self.site(sample),
            time_s: Some(moment.time_s),
        };
        findings.check(check, || Words {
            message: format!(
                "joint {} is {:.1}° from its stop on strand `{}` at {:.1} mm",
                chain.axis_name(axis),
                margin.to_degrees(),
                self.id(),
                sample.at_m * 1e3
            ),
            hint: "turn the spin or move the part; a stop met in mid-strand ends the print"
                .to_owned(),
        });
        Some((axis, margin))
    }

    /// Joint speed between two moments, as a share of the limit, with the joint.
    fn speed(
        &self,
        before: &Moment,
        moment: &Moment,
        sample: &Sample,
        findings: &mut Findings,
    ) -> (f64, Option<usize>) {
        let chain = &self.job.cell.robot.arm.chain;
        // What the asked speed needs: the controller slows down where a joint cannot keep up. Given
        // times are what is asked.
        let dt_s = if self.job.strands[self.strand].times_s.is_some() {
            moment.time_s - before.time_s
        } else {
            (moment.at_m - before.at_m) / sample_at(&self.path.samples, before.at_m).1.speed_m_s
        }
        .max(1e-9);
        let share = |axis: usize| {
            (moment.q[axis] - before.q[axis]).abs() / dt_s / chain.axes()[axis].velocity
        };
        let Some(axis) = (0..chain.dof()).max_by(|&a, &b| share(a).total_cmp(&share(b))) else {
            return (0.0, None);
        };
        let (share, limit) = (share(axis), self.job.limits.joint_speed_share);
        let check = Check {
            code: Code::R105,
            measured: Interval::exact(share),
            limit,
            warn_limit: None,
            site: self.site(sample),
            time_s: Some(moment.time_s),
        };
        findings.check(check, || Words {
            message: format!(
                "joint {} needs {:.0} % of its speed limit on strand `{}` at {:.1} mm",
                chain.axis_name(axis),
                share * 100.0,
                self.id(),
                sample.at_m * 1e3
            ),
            hint: format!(
                "print at {:.2} mm/s or slower here",
                sample.speed_m_s * 1e3 * limit / share
            ),
        });
        (share, Some(axis))
    }

    /// The middle of two postures against the middle of the strand between them.
    fn flips(
        &self,
        (before, from): (&Moment, &Sample),
        (moment, sample): (&Moment, &Sample),
        findings: &mut Findings,
    ) -> bool {
        let step_m = (sample.point - from.point).norm();
        let middle = self.tcp(&before.q.toward(&moment.q, 0.5));
        // The TCP may be off the strand by itself (set tools, given rows): the chord is its own.
        let chord = center(&self.tcp(&before.q), &self.tcp(&moment.q));
        let deviation_m = (middle - chord).norm();
        let turn_rad = moment.q.distance(&before.q);
        let off_line = deviation_m > FLIP_SHARE * step_m + 1e-6;
        let flips = turn_rad > FLIP_RAD || (off_line && turn_rad > EVEN_RAD);
        findings.forbid(Code::R104, flips, self.site(sample), Some(moment.time_s), || Words {
            message: format!(
                "the arm flips on strand `{}` between {:.1} and {:.1} mm: half way the TCP is {:.1} mm off",
                self.id(),
                from.at_m * 1e3,
                sample.at_m * 1e3,
                deviation_m * 1e3
            ),
            hint: "split the strand here, or give it another spin or posture".to_owned(),
        });
        flips
    }

    /// Given rows between which the arm turns over, or a joint goes the long way round.
    fn wraps(&self, findings: &mut Findings) {
        let Some(rows) = &self.rows else { return };
        // Rows no further apart than the samples are compared there, and so are lines, which end on the
        // branch they began on.
        let far = |row: usize| rows.at_m(row) - rows.at_m(row - 1) > STEP_M + 1e-9;
        for row in (1..rows.len()).filter(|&row| self.moves_joints() && far(row)) {
            let Some(off_m) = rows.turns_over(row) else { continue };
            let (_, sample) = sample_at(&self.path.samples, rows.at_m(row));
            findings.forbid(Code::R104, true, self.site(&sample), None, || Words {
                message: format!(
                    "the arm turns over between rows {row} and {} of strand `{}`: half way the TCP is {:.1} mm off",
                    row + 1,
                    self.id(),
                    off_m * 1e3
                ),
                hint: "compute the joint path again on one branch, or split the strand here".to_owned(),
            });
        }
        for (row, axis, turn_rad) in rows.wraps() {
            let (_, sample) = sample_at(&self.path.samples, rows.at_m(row));
            let moment = self.leg.moments.iter().find(|moment| moment.at_m >= sample.at_m - 1e-12);
            let site = self.site(&sample);
            findings.forbid(Code::R104, true, site, moment.map(|m| m.time_s), || Words {
                message: format!(
                    "joint {} turns by {:.0}° between rows {} and {} of strand `{}`: a full turn more than the short way",
                    self.job.cell.robot.arm.chain.axis_name(axis),
                    turn_rad.to_degrees(),
                    row,
                    row + 1,
                    self.id()
                ),
                hint: "unwrap the joint path, or split the strand and unwind in between".to_owned(),
            });
        }
    }

    /// How far the TCP is off the strand at a place; `half` has the samples around a place between two.
    fn offs(&self, place: &Sample, q: &[f64], half: Option<(&Sample, &Sample)>) -> Offs {
        let part_from_bed = self.job.bed_from_part.inverse();
        match &self.rows {
            Some(rows) => {
                let linear =
                    part_from_bed * Point::from(rows.linear(place.at_m).translation.vector);
                Offs {
                    linear_m: self.off(&linear, place),
                    joint_m: self.off(&self.tcp(&rows.joint(place.at_m)), place),
                }
            }
            // Of postures found here the line between is that of the samples.
            None => {
                let off_m = self.off(&self.tcp(q), place);
                Offs { linear_m: if half.is_some() { 0.0 } else { off_m }, joint_m: off_m }
            }
        }
    }

    /// Distance from the strand: at a vertex from the vertex, else from the segment.
    fn off(&self, tcp: &Point, place: &Sample) -> f64 {
        let last = self.stations.len() - 1;
        if place.vertex || place.at_m >= self.stations[last] {
            return (tcp - place.point).norm();
        }
        let k = self.stations.partition_point(|&x| x <= place.at_m).clamp(1, last);
        let points = &self.job.strands[self.strand].points;
        let along = points[k] - points[k - 1];
        let share = ((tcp - points[k - 1]).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        (tcp - (points[k - 1] + along * share)).norm()
    }

    /// Takes note of both distances and judges the one of the job's own interpolation.
    fn deviates(
        &self,
        mut here: StrandMotion,
        offs: Offs,
        moment: &Moment,
        place: &Sample,
        findings: &mut Findings,
    ) -> StrandMotion {
        let off_m = if self.moves_joints() { offs.joint_m } else { offs.linear_m };
        here.deviation_linear_m = here.deviation_linear_m.max(offs.linear_m);
        here.deviation_joint_m = here.deviation_joint_m.max(offs.joint_m);
        here.deviation_m = here.deviation_m.max(off_m);
        let check = Check {
            code: Code::R107,
            measured: Interval::exact(off_m),
            limit: self.job.limits.node_miss_m,
            warn_limit: None,
            site: self.site(place),
            time_s: Some(moment.time_s),
        };
        findings.check(check, || self.off_words(off_m, place));
        here
    }

    fn off_words(&self, off_m: f64, place: &Sample) -> Words {
        let (how, hint) = match (&self.rows, place.vertex) {
            (Some(_), true) => {
                ("at a given joint row", "compute the joint path again for this cell")
            }
            _ if self.moves_joints() => (
                "between two joint rows",
                "compute the joint path again, with more points or linear interpolation",
            ),
            _ => (
                "while the part turns on its way to the next point",
                "give the strand more points, or turn the nozzle less between two of them",
            ),
        };
        Words {
            message: format!(
                "the TCP is {:.2} mm off strand `{}` {how} at {:.1} mm",
                off_m * 1e3,
                self.id(),
                place.at_m * 1e3
            ),
            hint: hint.to_owned(),
        }
    }

    /// Place of the orifice in part axes.
    fn tcp(&self, q: &[f64]) -> Point {
        self.job.part_from_tool(q) * Point::origin()
    }
}

/// A wrist nearer to its singularity than the cell allows, on the scale of the condition number: at
/// the allowed angle it counts as the number that warns, nearer as more in proportion, and never
/// past the one that stops.
fn on_condition_scale(near: &Nearness, limits: &crate::cell::Limits) -> f64 {
    let [warn, stop] = limits.condition_number;
    match near.wrist_rad {
        Some(wrist_rad) if wrist_rad < limits.wrist_rad => {
            (warn * limits.wrist_rad / wrist_rad).min(stop)
        }
        _ => 0.0,
    }
}

fn nearest_singularity(near: &Nearness) -> String {
    let angle = |name: &str, rad: Option<f64>| {
        rad.map(|rad| (rad, format!("{name} singularity, {:.1}° away", rad.to_degrees())))
    };
    let candidates = [
        angle("wrist", near.wrist_rad),
        angle("elbow", near.elbow_rad),
        angle("shoulder", near.shoulder_rad),
    ];
    let nearest = candidates.into_iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.map_or_else(|| "edge of its reach".to_owned(), |(_, words)| words)
}
