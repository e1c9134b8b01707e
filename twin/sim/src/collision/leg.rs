//! One leg of the motion under the glass.

use super::{Nearest, nearer, words};
use crate::cell::{Interpolation, Mode};
use crate::clearance::{Asked, Covered, Kind, Measure, Named, Space, Touch, Track};
use crate::deposit::Contact;
use crate::finding::{Check, Code, Findings, Phase, Site};
use crate::interval::Interval;
use crate::motion::{Leg, Motion};
use crate::pose::Point;

pub(super) struct Look<'a> {
    space: &'a Space<'a>,
    leg: &'a Leg,
    track: Track<'a>,
    touch: Touch,
    /// How far the path of a controller that moves in lines may lie off ours, m.
    off_line_m: f64,
    findings: Findings,
    nearest: Option<Nearest>,
}

/// What was found in a leg.
pub(super) type Found = (Findings, Option<Nearest>);

impl<'a> Look<'a> {
    /// `order`: printing order of the leg's strand; `by_order`: contacts of every strand.
    pub(super) fn new(
        space: &'a Space<'a>,
        motion: &Motion,
        leg: &'a Leg,
        order: Option<usize>,
        by_order: &[Vec<&Contact>],
    ) -> Self {
        let q = leg.moments.iter().map(|moment| moment.q).collect();
        let at_m = leg.moments.iter().map(|moment| moment.at_m).collect();
        let mut look = Self {
            space,
            leg,
            track: space.track(q, at_m),
            touch: Touch::nothing(),
            off_line_m: 0.0,
            findings: Findings::default(),
            nearest: None,
        };
        if leg.moments.is_empty() {
            return look;
        }
        look.touch = look.touch_of(order, by_order).without(gone(motion, leg));
        look.off_line_m = look.off_line_m(order);
        look
    }

    fn touch_of(&self, order: Option<usize>, by_order: &[Vec<&Contact>]) -> Touch {
        if self.leg.strand.is_none() {
            return self.touch_of_given(by_order);
        }
        let Some(order) = order.filter(|_| self.leg.phase != Phase::Transit) else {
            return Touch::nothing();
        };
        let extrudes = self.leg.phase == Phase::Print;
        let (job, deposit) = (self.space.job, self.space.deposit);
        let touch = Touch::strand(job, deposit, order, by_order[order].iter().copied(), extrudes);
        match self.leg.phase {
            Phase::Retract => touch.leaving(order, self.tip(0.0)),
            _ => touch,
        }
    }

    /// A move that the job gives, and the way home, leave the strand before them and lead to the one
    /// after them.
    fn touch_of_given(&self, by_order: &[Vec<&Contact>]) -> Touch {
        let (job, deposit) = (self.space.job, self.space.deposit);
        let before = self.leg.printed.checked_sub(1);
        let after = Some(self.leg.printed).filter(|&order| order < deposit.strands.len());
        let mut touch = Touch::nothing();
        for (order, is_end) in [(before, true), (after, false)] {
            let Some(order) = order else { continue };
            let points = &job.strands[deposit.strands[order].strand].points;
            let Some(place) = (if is_end { points.last() } else { points.first() }) else {
                continue;
            };
            let contacts = by_order[order].iter().copied();
            let mut of = Touch::strand(job, deposit, order, contacts, false).only_near(&[*place]);
            if is_end {
                of = of.leaving(order, *place);
            }
            touch = touch.and(of);
        }
        touch
    }

    /// Measures and judges every pair, once over the whole leg.
    pub(super) fn judged(mut self) -> Found {
        if self.leg.moments.is_empty() {
            return (self.findings, self.nearest);
        }
        let mut found: Vec<((usize, Named), Covered, f64)> = Vec::new();
        let measure = Measure::new(self.space, &self.track, &self.touch, self.leg.printed);
        measure.each(
            |_| self.asked(),
            &mut found,
            |found, pair, covered| {
                let allowance_m = match pair {
                    (thing, Named::Thing(other)) => measure.allowance_m([thing, other], covered.u),
                    _ => 0.0,
                };
                found.push((pair, covered, allowance_m));
                true
            },
        );
        for (pair, covered, allowance_m) in found {
            self.measured(pair, &covered, allowance_m);
        }
        (self.findings, self.nearest)
    }

    fn asked(&self) -> Asked {
        let limit_m = self.space.job.limits.clearance_m;
        let doubt_m = self.space.job.cell.robot.accuracy_m + self.off_line_m;
        Asked {
            horizon_m: 2.0 * limit_m,
            judged_at_m: [limit_m, limit_m + doubt_m],
            enough_m: f64::NEG_INFINITY,
        }
    }

    /// The orifice in part axes.
    fn tip(&self, u: f64) -> Point {
        Measure::new(self.space, &self.track, &self.touch, 0).tip(&self.track.at(u))
    }

    fn code(&self, (thing, other): (usize, Named)) -> Code {
        let bed_rides = self.space.job.cell.mode == Mode::BedOnFlange;
        let kind = self.space.things[thing].kind;
        match other {
            Named::Strand(order) => match kind {
                Kind::Nozzle | Kind::Tool if self.touch.extrudes && order == self.leg.printed => {
                    Code::C204
                }
                Kind::Nozzle => Code::C201,
                Kind::Tool => Code::C202,
                Kind::Link => Code::C203,
                Kind::Bed | Kind::Form(_) | Kind::Obstacle => Code::C205,
            },
            Named::Thing(other) => match (kind, self.space.things[other].kind) {
                (Kind::Nozzle | Kind::Tool | Kind::Link, Kind::Link) => Code::C206,
                (Kind::Bed | Kind::Form(_), Kind::Link) if bed_rides => Code::C206,
                _ => Code::C205,
            },
        }
    }

    /// Holds one covered clearance against its limit.
    ///
    /// Where two may touch, their overlap is held against the limit by how much is missing of the full
    /// clearance, so that both kinds have a margin on one scale.
    fn measured(&mut self, pair: (usize, Named), covered: &Covered, allowance_m: f64) {
        let job = self.space.job;
        let code = self.code(pair);
        let names = [self.space.things[pair.0].body.name.as_str(), self.space.name(pair.1)];
        // The arm's error moves the strand in progress with the nozzle, and is what those that may
        // touch may press into each other for.
        let moves_together = code == Code::C204 || allowance_m > 0.0;
        let accuracy_m = if moves_together { 0.0 } else { job.cell.robot.accuracy_m };
        let off_line_m = if moves_together { 0.0 } else { self.off_line_m };
        let here = Nearest {
            clearance_m: covered.found_m - allowance_m,
            resolution_m: covered.found_m - covered.low_m + off_line_m,
            accuracy_m,
            bodies: names.map(str::to_owned),
            phase: self.leg.phase,
            strand: self.leg.strand,
            at_m: self.track.at_m(covered.u),
            time_s: self.track.between(covered.u, |k| self.leg.moments[k].time_s),
            point: self.tip(covered.u),
        };
        let site = Site {
            strand: self.leg.strand,
            at_m: (self.leg.phase == Phase::Print).then_some(here.at_m),
            phase: Some(self.leg.phase),
            point: Some(here.point),
            ..Site::default()
        };
        let low_m = covered.low_m - off_line_m - accuracy_m;
        let limit = job.limits.clearance_m;
        let check = Check {
            code,
            measured: Interval::new(covered.found_m, low_m, covered.found_m + accuracy_m),
            limit,
            warn_limit: None,
            site: site.between(names),
            time_s: Some(here.time_s),
        };
        let words = words::Measured {
            code,
            clearance_m: here.clearance_m,
            limit_m: limit - allowance_m,
            names,
            phase: self.leg.phase,
            strand: self.leg.strand,
        };
        self.findings.check(check, || words::clearance(job, &words));
        if allowance_m == 0.0 {
            self.nearest = nearer(self.nearest.take(), Some(here));
        }
    }

    /// Largest distance of the orifice, half way between two moments, from the line between them,
    /// and of a given joint path from its strand: a controller that moves in lines is there, we
    /// are not. Zero where joints turn evenly.
    fn off_line_m(&self, order: Option<usize>) -> f64 {
        let Some(strand) = self.leg.strand.map(|strand| &self.space.job.strands[strand]) else {
            return 0.0;
        };
        let in_lines = match self.leg.phase {
            Phase::Print => strand.settings.interpolation == Interpolation::Linear,
            Phase::Approach | Phase::Retract => true,
            Phase::Dwell | Phase::Transit => false,
        };
        if !in_lines {
            return 0.0;
        }
        let n_moments = self.leg.moments.len();
        let tips: Vec<Point> = (0..n_moments).map(|k| self.tip(k as f64)).collect();
        let bow =
            |k: usize| (self.tip(k as f64 + 0.5) - nalgebra::center(&tips[k], &tips[k + 1])).norm();
        let bow_m = (0..n_moments - 1).map(bow).fold(0.0, f64::max);
        let given = order.filter(|_| self.leg.phase == Phase::Print && strand.joints.is_some());
        let off = |order: usize| {
            let printed = &self.space.deposit.strands[order];
            let off = |(moment, tip): (&crate::motion::Moment, &Point)| {
                let place = along(&printed.as_planned, &printed.at_m, moment.at_m)?;
                Some((place - tip).norm())
            };
            self.leg.moments.iter().zip(&tips).filter_map(off).fold(0.0, f64::max)
        };
        bow_m + given.map_or(0.0, off)
    }
}

/// Place on a polyline; `None` beyond its end.
fn along(points: &[Point], stations: &[f64], at_m: f64) -> Option<Point> {
    let k = stations.partition_point(|&station| station < at_m).max(1);
    let (from, to) = (points.get(k - 1)?, points.get(k)?);
    let share = (at_m - stations[k - 1]) / (stations[k] - stations[k - 1]);
    Some(from + (to - from) * share)
}

/// Forms released before this leg. The retract after a strand comes before a release that follows it.
fn gone(motion: &Motion, leg: &Leg) -> Vec<usize> {
    let Some(first) = leg.moments.first() else { return Vec::new() };
    let is_gone = |&&(_, printed, time_s): &&(usize, usize, f64)| {
        let before = if leg.phase == Phase::Retract {
            printed < leg.printed
        } else {
            printed <= leg.printed
        };
        before && time_s <= first.time_s
    };
    motion.releases.iter().filter(is_gone).map(|&(form, _, _)| form).collect()
}
