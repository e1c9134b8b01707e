//! Times of the program: the motion a controller makes of the ways.
//!
//! | way | path parameter | ceiling | ramps |
//! |---|---|---|---|
//! | print | arc length of the strand | the asked TCP speed | the controller's along the path; joint limits |
//! | approach, retract | way of the orifice | travel speed | the same |
//! | transit, given move | time at full joint speed, or at travel speed where that is longer | 1 | joint limits; the controller's in proportion |
//!
//! Every way begins and ends at rest. Prints are rounded at corners as the controller blends; moves
//! without extrusion stop at theirs, since what was found clear is the way itself. Times that a
//! job gives are kept.

use rayon::prelude::*;

use super::drives::{Drives, Need};
use super::rides::{self, Ride};
use super::{Act, Leg, Moment, Motion, Printing, Station, Way, between, strand, true_speed};
use crate::cell::{Interpolation, Job, Strand};
use crate::finding::Phase;
use crate::kinematics::Posture;
use crate::timing::{self, Law, Limits};
use crate::toolpath::Path;

/// Turn of the way of the orifice, or of a joint path, that counts as a corner, rad: less than that
/// is a curve drawn with straight lines.
const CORNER_RAD: f64 = 0.35;

/// Gives the program its times. Ways do not know each other's: they are timed in parallel.
pub(super) fn timed(job: &Job, paths: &[Path], acts: Vec<Act>) -> Motion {
    let controller = Controller { job, paths, drives: Drives::new(job) };
    let times: Vec<Times> = acts
        .par_iter()
        .map(|act| match act {
            Act::Go(way) => controller.times(way),
            Act::Wait(_) | Act::Release(_) => Times::default(),
        })
        .collect();
    let mut motion = Motion {
        legs: Vec::new(),
        printings: Vec::new(),
        releases: Vec::new(),
        needs: Vec::new(),
        rides: Vec::new(),
        speeds_m_s: vec![Vec::new(); job.strands.len()],
        total_s: 0.0,
        lost: Vec::new(),
    };
    for (act, times) in acts.into_iter().zip(times) {
        match act {
            Act::Wait(wait_s) => motion.total_s += wait_s,
            Act::Release(form) => {
                motion.releases.push((form, motion.printings.len(), motion.total_s));
            }
            Act::Go(way) => go(job, &mut motion, way, times),
        }
    }
    motion
}

/// Adds a way to the program, with priming and rests around a print.
fn go(job: &Job, motion: &mut Motion, way: Way, times: Times) {
    let Way { phase, strand, printed, stations, unreached } = way;
    let prints = strand.filter(|_| phase == Phase::Print);
    if let Some(strand) = prints.filter(|_| !stations.is_empty()).map(|s| &job.strands[s]) {
        motion.total_s += strand.settings.prime_s + strand.start.dwell_s;
    }
    let start_s = motion.total_s;
    let moment = |(station, time_s): (&Station, &f64)| Moment {
        time_s: start_s + time_s,
        at_m: station.at_m,
        q: station.q,
    };
    let moments: Vec<Moment> = stations.iter().zip(&times.at_s).map(moment).collect();
    let end_s = moments.last().map_or(start_s, |moment| moment.time_s);
    motion.total_s = end_s;
    if let Some(index) = prints {
        if !moments.is_empty() {
            motion.total_s += job.strands[index].end.dwell_s;
        }
        let leg = motion.legs.len();
        let placed = |need: Need| Need { leg, time_s: start_s + need.time_s, ..need };
        motion.needs.extend(times.needs.into_iter().map(placed));
        motion.speeds_m_s[index] = times.speeds_m_s;
        motion.printings.push(Printing { strand: index, start_s, end_s });
    }
    let leg = motion.legs.len();
    let placed = |ride: Ride| Ride { leg, time_s: start_s + ride.time_s, ..ride };
    motion.rides.extend(times.rides.into_iter().map(placed));
    motion.legs.push(Leg { phase, strand, printed, moments, unreached });
}

/// Times of one way from its start, and what its drives need at the asked speed.
#[derive(Debug, Clone, Default)]
struct Times {
    at_s: Vec<f64>,
    needs: Vec<Need>,
    rides: Vec<Ride>,
    /// Of a print: true speed after every sample of the strand, m/s.
    speeds_m_s: Vec<f64>,
}

struct Controller<'a> {
    job: &'a Job,
    paths: &'a [Path],
    drives: Drives<'a>,
}

impl Controller<'_> {
    fn times(&self, way: &Way) -> Times {
        match (way.phase, way.strand) {
            (Phase::Print, Some(strand)) => {
                self.print_times(way, &self.paths[strand], &self.job.strands[strand])
            }
            (Phase::Approach | Phase::Retract, _) => self.straight_times(way),
            _ => self.joint_times(way),
        }
    }

    /// Time of every station from the start of the extrusion, s, what the drives need at the asked
    /// speed, and the speed the orifice really has.
    fn print_times(&self, way: &Way, path: &Path, strand: &Strand) -> Times {
        let asked_s = asked_times(way, path, strand);
        let without_ramps = |needs: Vec<Need>| Times {
            speeds_m_s: true_speed::by_times(self.job, &way.stations, &asked_s, path),
            at_s: asked_s.clone(),
            needs,
            rides: rides::of_times(self.job, &way.stations, &asked_s),
        };
        if strand.times_s.is_some() {
            return without_ramps(Vec::new());
        }
        // Joints that turn evenly from row to row have a corner at every row.
        let by_rows = strand.settings.interpolation == Interpolation::Joint;
        let stations = print_stations(way, path, by_rows);
        let asked = timing::time_law(&stations, &self.limits(false));
        let Ok(asked) = asked else { return without_ramps(Vec::new()) };
        let needs = self.drives.needs(&asked);
        let slowed = self.exceeds(&asked);
        let law = if slowed { timing::time_law(&stations, &self.limits(true)) } else { Ok(asked) };
        let Ok(law) = law else { return without_ramps(needs) };
        Times { needs, speeds_m_s: true_speed::by_law(self.job, &law, path), ..self.by_law(&law) }
    }

    fn by_law(&self, law: &Law) -> Times {
        Times {
            at_s: law.passings.iter().map(|passing| passing.time_s).collect(),
            rides: rides::of_law(self.job, law),
            ..Times::default()
        }
    }

    /// Whether a joint would have to do more than it can.
    fn exceeds(&self, law: &Law) -> bool {
        let within = |value: f64, limit: f64| value <= limit;
        let mut speeds = law.peaks.speed.iter().zip(self.drives.velocity.iter());
        let mut accelerations = law.peaks.acceleration.iter().zip(&self.drives.acceleration);
        !(speeds.all(|(&value, &limit)| within(value, limit))
            && accelerations.all(|(&value, limit)| limit.is_none_or(|limit| within(value, limit))))
    }

    /// The controller's limits, with or without what the joints can.
    fn limits(&self, joints: bool) -> Limits<'_> {
        let controller = &self.job.cell.controller;
        let mut velocity = Posture::zeros(self.drives.velocity.len());
        velocity.fill(f64::INFINITY);
        Limits {
            velocity: if joints { self.drives.velocity } else { velocity },
            acceleration: if joints { &self.drives.acceleration } else { &[] },
            jerk: &[],
            path_acceleration: Some(controller.acceleration_m_s2),
            path_jerk: Some(controller.jerk_m_s3),
            blend_m: controller.blend_m,
            torque: None,
        }
    }

    /// A straight way of the orifice.
    fn straight_times(&self, way: &Way) -> Times {
        let travel_m_s = self.job.cell.extruder.travel_m_s;
        let lengths = self.lengths(way, |tcp_m, _| tcp_m);
        let stations = stations_of(way, &lengths, travel_m_s);
        let limits = Limits { blend_m: 0.0, ..self.limits(true) };
        match timing::time_law(&stations, &limits) {
            Ok(law) => self.by_law(&law),
            Err(_) => Times {
                at_s: self.lengths(way, |tcp_m, joint_s| joint_s.max(tcp_m / travel_m_s)),
                ..Times::default()
            },
        }
    }

    /// A way in joint space: the parameter is the time it takes at full speed.
    fn joint_times(&self, way: &Way) -> Times {
        let controller = &self.job.cell.controller;
        let travel_m_s = self.job.cell.extruder.travel_m_s;
        let share = controller.joint_move_share;
        let full_s = self.lengths(way, |tcp_m, joint_s| (joint_s / share).max(tcp_m / travel_m_s));
        let stations = stations_of(way, &full_s, 1.0);
        let limits = Limits {
            path_acceleration: Some(controller.acceleration_m_s2 / travel_m_s),
            path_jerk: Some(controller.jerk_m_s3 / travel_m_s),
            blend_m: 0.0,
            ..self.limits(true)
        };
        match timing::time_law(&stations, &limits) {
            Ok(law) => self.by_law(&law),
            Err(_) => Times { at_s: full_s, ..Times::default() },
        }
    }

    /// A running sum over the steps of a way, of a measure of the way of the orifice, m, and the
    /// time at full joint speed, s.
    fn lengths(&self, way: &Way, step: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let axes = self.job.cell.robot.arm.chain.axes();
        let mut total = 0.0;
        let mut before: Option<(Posture, crate::pose::Point)> = None;
        way.stations
            .iter()
            .map(|station| {
                let (point, _) = between::nozzle_at(self.job, &station.q);
                if let Some((q, last)) = before {
                    let joints = axes.iter().zip(q.iter().zip(station.q.iter()));
                    let joint_s = joints.map(|(axis, (a, b))| (a - b).abs() / axis.velocity);
                    let joint_s = joint_s.fold(0.0, f64::max);
                    total += step(nalgebra::distance(&point, &last), joint_s);
                }
                before = Some((station.q, point));
                total
            })
            .collect()
    }
}

/// Times at the asked speed, or the given ones, without ramps.
fn asked_times(way: &Way, path: &Path, strand: &Strand) -> Vec<f64> {
    let times = strand::times(strand, path);
    let at = |station: &Station| {
        let k = path.samples.partition_point(|sample| sample.at_m < station.at_m - 1e-12);
        let k = k.min(times.len() - 1);
        // Stations that the search added stand before the sample.
        let rest_m = (path.samples[k].at_m - station.at_m).max(0.0);
        let rest_s = k.checked_sub(1).map_or(0.0, |k| rest_m / path.samples[k].speed_m_s);
        times[k] - rest_s
    };
    way.stations.iter().map(at).collect()
}

fn print_stations(way: &Way, path: &Path, by_rows: bool) -> Vec<timing::Station> {
    let samples = &path.samples;
    let sample_at = |at_m: f64| {
        let k = samples.partition_point(|sample| sample.at_m <= at_m + 1e-12);
        &samples[k.saturating_sub(1)]
    };
    let n = way.stations.len();
    let station = |k: usize, station: &Station| {
        let sample = sample_at(station.at_m);
        let before = k.checked_sub(1).map(|k| sample_at(way.stations[k].at_m));
        let turns = before.is_some_and(|before| before.tangent.angle(&sample.tangent) > CORNER_RAD);
        timing::Station {
            s: station.at_m,
            q: station.q,
            ceiling: sample.speed_m_s,
            stop: k == 0 || k + 1 == n,
            corner: (turns || (by_rows && sample.vertex)) && k > 0 && k + 1 < n,
        }
    };
    way.stations.iter().enumerate().map(|(k, each)| station(k, each)).collect()
}

/// Stations of a way in joint space; a corner is where the direction of the joints jumps.
fn stations_of(way: &Way, lengths: &[f64], ceiling: f64) -> Vec<timing::Station> {
    let n = way.stations.len();
    let step = |k: usize| -> Option<Vec<f64>> {
        let (a, b) = (way.stations.get(k)?, way.stations.get(k + 1)?);
        Some(a.q.iter().zip(b.q.iter()).map(|(a, b)| b - a).collect())
    };
    let turns = |k: usize| {
        let Some((before, after)) = k.checked_sub(1).and_then(step).zip(step(k)) else {
            return false;
        };
        let dot: f64 = before.iter().zip(&after).map(|(a, b)| a * b).sum();
        let norm = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        dot < CORNER_RAD.cos() * norm(&before) * norm(&after)
    };
    let station = |k: usize| timing::Station {
        s: lengths[k],
        q: way.stations[k].q,
        ceiling,
        stop: k == 0 || k + 1 == n,
        corner: turns(k),
    };
    (0..n).map(station).collect()
}
