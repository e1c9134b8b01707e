//! Findings of reach and motion.

use nalgebra::center;

use super::{Leg, Moment, Motion};
use crate::cell::{Interpolation, Job};
use crate::finding::{Check, Code, Findings, Phase, Site, Words};
use crate::interval::Interval;
use crate::kinematics::{JointKind, limit_margins, nearness};
use crate::pose::Point;
use crate::toolpath::{Path, Sample};

/// What the arm does along one strand, at its worst.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrandMotion {
    /// Largest share of a joint's speed limit at the asked print speed.
    pub joint_speed_share: f64,
    /// Least distance of a revolute joint to its stop, rad.
    pub joint_margin_rad: f64,
    /// Largest condition number, length scale 1 m.
    pub condition_number: f64,
    /// Largest distance of the TCP from the strand, at and between samples, m.
    pub deviation_m: f64,
}

/// TCP off the line by more than this share of the step between two samples is a flip: an even
/// motion of both ends leaves the middle by a part of it that falls with the step.
const FLIP_SHARE: f64 = 0.5;
/// A joint that turns further than this between two samples flips.
const FLIP_RAD: f64 = std::f64::consts::FRAC_PI_2;
/// Joints that turn less than this do not flip: a nozzle that tilts fast bows its tip off the line.
const EVEN_RAD: f64 = std::f64::consts::PI / 6.0;

/// Judges the motion; one entry per strand of the job, `None` where nothing is reached.
pub fn check(
    job: &Job,
    paths: &[Path],
    motion: &Motion,
    findings: &mut Findings,
) -> Vec<Option<StrandMotion>> {
    let mut strands = vec![None; job.strands.len()];
    for leg in &motion.legs {
        if let (Phase::Print, Some(strand)) = (leg.phase, leg.strand) {
            reach(job, leg, strand, findings);
            strands[strand] = along(&Along { job, path: &paths[strand], leg, strand }, findings);
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
}

fn along(this: &Along<'_>, findings: &mut Findings) -> Option<StrandMotion> {
    let mut worst: Option<StrandMotion> = None;
    for (k, moment) in this.leg.moments.iter().enumerate() {
        let sample = this.sample(moment);
        let mut here = this.posture(moment, sample, findings);
        if let Some(before) = k.checked_sub(1).map(|k| &this.leg.moments[k]) {
            here.joint_speed_share = this.speed(before, moment, sample, findings);
            here.deviation_m = here.deviation_m.max(this.between(before, moment, sample, findings));
        }
        worst = Some(worst.map_or(here, |w| StrandMotion {
            joint_speed_share: w.joint_speed_share.max(here.joint_speed_share),
            joint_margin_rad: w.joint_margin_rad.min(here.joint_margin_rad),
            condition_number: w.condition_number.max(here.condition_number),
            deviation_m: w.deviation_m.max(here.deviation_m),
        }));
    }
    worst
}

impl Along<'_> {
    fn sample(&self, moment: &Moment) -> &Sample {
        let samples = &self.path.samples;
        let k = samples.partition_point(|sample| sample.at_m < moment.at_m - 1e-12);
        &samples[k.min(samples.len() - 1)]
    }

    fn site(&self, sample: &Sample) -> Site {
        Site::strand(self.strand, sample.at_m).during(Phase::Print).at(sample.point)
    }

    fn id(&self) -> &str {
        &self.job.strands[self.strand].id
    }

    /// Margins, singularity and place of one posture.
    fn posture(&self, moment: &Moment, sample: &Sample, findings: &mut Findings) -> StrandMotion {
        let arm = &self.job.cell.robot.arm;
        let limits = &self.job.limits;
        let joint_margin_rad = self.margin(moment, sample, findings);
        let near = nearness(arm, &moment.q);
        let [warn, stop] = limits.condition_number;
        let check = Check {
            code: Code::R103,
            measured: Interval::exact(near.condition.min(1e9)),
            limit: stop,
            warn_limit: Some(warn),
            site: self.site(sample),
            time_s: Some(moment.time_s),
        };
        findings.check(check, || Words {
            message: format!(
                "condition number {:.1} (length scale 1 m) on strand `{}` at {:.1} mm, nearest to the {}",
                near.condition,
                self.id(),
                sample.at_m * 1e3,
                nearest_singularity(&near)
            ),
            hint: "turn the spin, tilt the nozzle or move the part away from this posture".to_owned(),
        });
        let deviation_m = (self.tcp(&moment.q) - sample.point).norm();
        // Between given rows a controller that moves in lines keeps to the strand by itself.
        let strand = &self.job.strands[self.strand];
        let as_moved = sample.vertex || strand.settings.interpolation == Interpolation::Joint;
        if strand.joints.is_some() && as_moved {
            let place =
                if sample.vertex { "at a given joint row" } else { "between two joint rows" };
            self.deviation(deviation_m, moment, sample, place, findings);
        }
        StrandMotion {
            joint_speed_share: 0.0,
            joint_margin_rad,
            condition_number: near.condition,
            deviation_m: if as_moved { deviation_m } else { 0.0 },
        }
    }

    fn margin(&self, moment: &Moment, sample: &Sample, findings: &mut Findings) -> f64 {
        let chain = &self.job.cell.robot.arm.chain;
        let margins = limit_margins(chain, &moment.q);
        let revolute =
            |axis: usize| chain.joints()[chain.axes()[axis].joint].kind == JointKind::Revolute;
        let worst = (0..chain.dof())
            .filter(|&axis| revolute(axis))
            .min_by(|&a, &b| margins[a].total_cmp(&margins[b]));
        let Some(axis) = worst else { return f64::INFINITY };
        let margin = margins[axis];
        if margin.is_finite() {
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
        }
        margin
    }

    /// Joint speed between two moments, as a share of the limit.
    fn speed(
        &self,
        before: &Moment,
        moment: &Moment,
        sample: &Sample,
        findings: &mut Findings,
    ) -> f64 {
        let chain = &self.job.cell.robot.arm.chain;
        let dt_s = (moment.time_s - before.time_s).max(1e-9);
        let share = |axis: usize| {
            (moment.q[axis] - before.q[axis]).abs() / dt_s / chain.axes()[axis].velocity
        };
        let Some(axis) = (0..chain.dof()).max_by(|&a, &b| share(a).total_cmp(&share(b))) else {
            return 0.0;
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
        share
    }

    /// The middle of two postures against the middle of the strand between them.
    fn between(
        &self,
        before: &Moment,
        moment: &Moment,
        sample: &Sample,
        findings: &mut Findings,
    ) -> f64 {
        let mut middle = before.q;
        for (value, other) in middle.iter_mut().zip(moment.q.iter()) {
            *value = (*value + other) / 2.0;
        }
        let from = self.sample(before);
        let step_m = (sample.point - from.point).norm();
        let deviation_m = (self.tcp(&middle) - center(&from.point, &sample.point)).norm();
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
        let joint = self.job.strands[self.strand].settings.interpolation == Interpolation::Joint;
        if joint && !flips {
            self.deviation(deviation_m, moment, sample, "between two joint rows", findings);
        }
        if joint { deviation_m } else { 0.0 }
    }

    fn deviation(
        &self,
        off_m: f64,
        moment: &Moment,
        sample: &Sample,
        place: &str,
        findings: &mut Findings,
    ) {
        let check = Check {
            code: Code::R107,
            measured: Interval::exact(off_m),
            limit: self.job.limits.node_miss_m,
            warn_limit: None,
            site: self.site(sample),
            time_s: Some(moment.time_s),
        };
        findings.check(check, || Words {
            message: format!(
                "the TCP is {:.2} mm off strand `{}` {place} at {:.1} mm",
                off_m * 1e3,
                self.id(),
                sample.at_m * 1e3
            ),
            hint: "compute the joint path again, with more points or linear interpolation"
                .to_owned(),
        });
    }

    /// Place of the orifice in part axes.
    fn tcp(&self, q: &[f64]) -> Point {
        let cell = &self.job.cell;
        let world_from_tip = cell.robot.arm.chain.forward(q);
        let world_from_part = cell.world_from_bed(&world_from_tip) * self.job.bed_from_part;
        world_from_part.inverse() * (cell.world_from_tool(&world_from_tip) * Point::origin())
    }
}

fn nearest_singularity(near: &crate::kinematics::Nearness) -> String {
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
