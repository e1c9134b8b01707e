//! R108: the true speed of the TCP against the asked one.

use std::f64::consts::PI;

use super::orifice;
use crate::cell::Job;
use crate::finding::{Check, Code, Findings, Phase, Site, Words};
use crate::interval::Interval;
use crate::motion::{Leg, Motion};
use crate::pose::Point;
use crate::toolpath::{Path, Sample};

/// Speeds past this many times the asked one are told as this.
const ENDLESS: f64 = 1e9;

/// Where the speed is furthest from what was asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedExtreme {
    /// True speed over asked speed, mean over one bead.
    pub ratio: f64,
    /// Asked speed there, m/s.
    pub asked_m_s: f64,
    /// Arc length, m.
    pub at_m: f64,
    /// The same in part axes.
    pub point: Point,
    /// Time, s.
    pub time_s: f64,
}

impl SpeedExtreme {
    /// Diameter of the bead over that at the asked speed: the same flow on another length,
    /// `d ∝ 1/√v`.
    pub fn bead_factor(&self) -> f64 {
        1.0 / self.ratio.sqrt()
    }
}

/// The true speed along one strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrandSpeed {
    /// Index of the strand in the job.
    pub strand: usize,
    /// Slowest and fastest place beyond the ramps.
    pub beyond: [SpeedExtreme; 2],
    /// Slowest and fastest place with the ramps.
    pub overall: [SpeedExtreme; 2],
    /// Length of the ramp at its start and at its end, m; zero where it keeps moving.
    pub ramps_m: [f64; 2],
    /// Length over which speed is averaged, m: one bead.
    pub window_m: f64,
}

/// True speed along every printed strand, in order of printing.
///
/// A bead cannot change over less than its own diameter `w`, so speed is the mean over that length,
///
/// ```text
/// ratio(s) = ∫ ds/v_asked / ∫ dt    over s … s + w
/// ```
///
/// with `ds` the way of the orifice in part axes, two chords from one moment to the next. Of moments
/// h apart on a curve of curvature κ the chords are short by (κh)²/96 of their length. The ramp a
/// controller needs from rest and to rest, [`crate::cell::Controller::ramp`], lies at both ends of
/// the motion, the overrun included; `beyond` leaves it out. On a strand shorter than its ramps the
/// middle is judged.
pub fn speeds(job: &Job, paths: &[Path], motion: &Motion) -> Vec<StrandSpeed> {
    let prints = motion.legs.iter().filter(|leg| leg.phase == Phase::Print);
    prints.filter_map(|leg| along(job, &paths[leg.strand?], leg)).collect()
}

/// Holds the speeds beyond the ramps against the band, one check per strand.
pub fn judge_speeds(job: &Job, speeds: &[StrandSpeed], findings: &mut Findings) {
    for speed in speeds {
        let off = |extreme: &SpeedExtreme| (extreme.ratio - 1.0).abs();
        let [slow, fast] = speed.beyond;
        let worst = if off(&slow) > off(&fast) { slow } else { fast };
        let check = Check {
            code: Code::R108,
            measured: Interval::exact(off(&worst)),
            limit: job.limits.speed_band,
            warn_limit: None,
            site: Site::strand(speed.strand, worst.at_m).during(Phase::Print).at(worst.point),
            time_s: Some(worst.time_s),
        };
        findings.check(check, || words(job, speed, &worst));
    }
}

fn words(job: &Job, speed: &StrandSpeed, worst: &SpeedExtreme) -> Words {
    let word = if worst.ratio > 1.0 { "faster" } else { "slower" };
    let [slow, fast] = speed.overall;
    let true_mm_s = worst.asked_m_s * worst.ratio * 1e3;
    Words {
        message: format!(
            "the TCP goes {:.1} % {word} than asked on strand `{}` at {:.1} mm, {true_mm_s:.2} of {:.2} mm/s: the bead is {:.0} % as thick; with ramps of {:.2} and {:.2} mm {:.0} to {:.0} % of the asked speed",
            (worst.ratio - 1.0).abs() * 100.0,
            job.strands[speed.strand].id,
            worst.at_m * 1e3,
            worst.asked_m_s * 1e3,
            worst.bead_factor() * 100.0,
            speed.ramps_m[0] * 1e3,
            speed.ramps_m[1] * 1e3,
            slow.ratio * 100.0,
            fast.ratio * 100.0
        ),
        hint: format!(
            "{:.2} times the flow here keeps the bead; or ask for {true_mm_s:.2} mm/s, more points, linear interpolation, rounder corners",
            worst.ratio
        ),
    }
}

/// A place on the way of the orifice.
#[derive(Debug, Clone, Copy)]
struct Mark {
    /// Way so far, m.
    way_m: f64,
    /// Time, s.
    time_s: f64,
    /// Time it should have taken so far, s.
    asked_s: f64,
    at_m: f64,
    point: Point,
    asked_m_s: f64,
}

fn along(job: &Job, path: &Path, leg: &Leg) -> Option<StrandSpeed> {
    let (marks, total_m) = marks(job, path, leg);
    let (first, last) = (marks.first()?, marks.last()?);
    if last.way_m <= first.way_m {
        return None;
    }
    let window_m = window_m(job, path);
    let controller = &job.cell.controller;
    let ramps_m = [
        controller.ramp(first.asked_m_s).1,
        (controller.ramp(last.asked_m_s).1 - (total_m - last.way_m)).max(0.0),
    ];
    Some(StrandSpeed {
        strand: path.strand,
        beyond: extremes(&marks, [first.way_m + ramps_m[0], last.way_m - ramps_m[1]], window_m),
        overall: extremes(&marks, [first.way_m, last.way_m], window_m),
        ramps_m,
        window_m,
    })
}

/// Marks at the moments that extrude, and the whole way with the overrun.
fn marks(job: &Job, path: &Path, leg: &Leg) -> (Vec<Mark>, f64) {
    let strand = &job.strands[path.strand];
    let mut marks: Vec<Mark> = Vec::with_capacity(leg.moments.len());
    let (mut way_m, mut asked_s) = (0.0, 0.0);
    let mut before: Option<(&crate::motion::Moment, Point)> = None;
    for moment in &leg.moments {
        let point = orifice(job, &moment.q);
        let asked_m_s = strand.asked(moment.at_m).0;
        if let Some((last, last_point)) = before {
            let middle = orifice(job, &last.q.toward(&moment.q, 0.5));
            let step_m = (middle - last_point).norm() + (point - middle).norm();
            way_m += step_m;
            asked_s += step_m / strand.asked(last.at_m).0;
        }
        if moment.at_m <= path.length_m + 1e-9 {
            marks.push(Mark {
                way_m,
                time_s: moment.time_s,
                asked_s,
                at_m: moment.at_m,
                point,
                asked_m_s,
            });
        }
        before = Some((moment, point));
    }
    (marks, way_m)
}

/// Diameter of the bead at the asked speed, the orifice where nothing is told.
fn window_m(job: &Job, path: &Path) -> f64 {
    let bead_m = |sample: &Sample| {
        let (speed_m_s, flow_m3_s) = job.strands[path.strand].asked(sample.at_m);
        (4.0 * flow_m3_s / (PI * speed_m_s)).sqrt()
    };
    let bead_m = path.samples.first().map_or(0.0, bead_m);
    if bead_m > 0.0 { bead_m } else { job.cell.tool.orifice_m }
}

/// Slowest and fastest window within `range`. Between marks speed is constant, so an extreme mean
/// has an end of its window on a mark or on an end of the range.
fn extremes(marks: &[Mark], [low_m, high_m]: [f64; 2], window_m: f64) -> [SpeedExtreme; 2] {
    let mut found: Option<[SpeedExtreme; 2]> = None;
    let mut note = |from: Mark, to: Mark| {
        let extreme = extreme(&from, &to);
        let [slow, fast] = found.get_or_insert([extreme; 2]);
        if extreme.ratio < slow.ratio {
            *slow = extreme;
        }
        if extreme.ratio > fast.ratio {
            *fast = extreme;
        }
    };
    if high_m - low_m > window_m {
        note(at(marks, low_m), at(marks, low_m + window_m));
        note(at(marks, high_m - window_m), at(marks, high_m));
        for mark in marks.iter().filter(|mark| (low_m..=high_m).contains(&mark.way_m)) {
            if mark.way_m + window_m <= high_m {
                note(*mark, at(marks, mark.way_m + window_m));
            }
            if mark.way_m - window_m >= low_m {
                note(at(marks, mark.way_m - window_m), *mark);
            }
        }
    } else {
        let (first_m, last_m) = (marks[0].way_m, marks[marks.len() - 1].way_m);
        let half_m = window_m.min(last_m - first_m) / 2.0;
        let middle_m = ((low_m + high_m) / 2.0).max(first_m + half_m).min(last_m - half_m);
        note(at(marks, middle_m - half_m), at(marks, middle_m + half_m));
    }
    found.expect("at least one window was noted")
}

fn extreme(from: &Mark, to: &Mark) -> SpeedExtreme {
    let ratio = (to.asked_s - from.asked_s) / (to.time_s - from.time_s);
    SpeedExtreme {
        ratio: if ratio.is_finite() { ratio.clamp(0.0, ENDLESS) } else { ENDLESS },
        asked_m_s: from.asked_m_s,
        at_m: (from.at_m + to.at_m) / 2.0,
        point: nalgebra::center(&from.point, &to.point),
        time_s: from.time_s,
    }
}

/// The mark at `way_m`, even in between.
fn at(marks: &[Mark], way_m: f64) -> Mark {
    let k = marks.partition_point(|mark| mark.way_m < way_m).clamp(1, marks.len() - 1);
    let (a, b) = (&marks[k - 1], &marks[k]);
    let step_m = b.way_m - a.way_m;
    let share = if step_m > 0.0 { ((way_m - a.way_m) / step_m).clamp(0.0, 1.0) } else { 0.0 };
    let even = |a: f64, b: f64| a + (b - a) * share;
    Mark {
        way_m,
        time_s: even(a.time_s, b.time_s),
        asked_s: even(a.asked_s, b.asked_s),
        at_m: even(a.at_m, b.at_m),
        point: a.point + (b.point - a.point) * share,
        asked_m_s: a.asked_m_s,
    }
}
