//! E502: hoses and cables, how far they are pulled and how far they are twisted.

use nalgebra::UnitQuaternion;

use super::{orifice, place};
use crate::cell::{Hose, Job, Mode};
use crate::finding::{Check, Code, Findings, Phase, Site, Words};
use crate::interval::Interval;
use crate::kinematics::Posture;
use crate::motion::Motion;
use crate::pose::{Point, Pose};

/// Joints turn no further than this between two looks, rad (m for sliding ones): a distance that
/// swings on a lever of 1 m is missed by at most 0.3 mm, a turn is never mistaken for its complement.
const STEP: f64 = 0.05;

/// Below this the swing of the hose's end is a half turn and its twist undefined.
const HALF_TURN: f64 = 1e-4;

/// The worst of one hose, and where.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pull {
    /// Distance of the ends, m; or signed twist from home, rad.
    pub value: f64,
    /// Time, s.
    pub time_s: f64,
    /// What the arm is doing.
    pub phase: Phase,
    /// The strand that belongs to, if any.
    pub strand: Option<usize>,
    /// Arc length on it, m.
    pub at_m: f64,
    /// Place of the orifice, part axes.
    pub point: Point,
}

/// What the program does to one hose.
#[derive(Debug, Clone, PartialEq)]
pub struct HoseUse {
    /// Index of the hose in the cell.
    pub hose: usize,
    /// Greatest distance of its ends.
    pub stretch: Pull,
    /// Greatest twist.
    pub twist: Pull,
}

/// Follows every hose of the cell through the program, from home; none where nothing moves.
///
/// Stretch is the straight distance of the hose's two ends. Twist is the turn about the end's own z
/// (tool's or bed's) in the swing–twist split of the end's rotation since home, seen from the link
/// the hose is fixed to,
///
/// ```text
/// q = home⁻¹ · link_from_end,   τ = 2 atan2(q.z, q.w)
/// ```
///
/// followed without jumps, so that full turns count. Where the swing is a half turn τ is undefined
/// and keeps its value.
pub fn hoses(job: &Job, motion: &Motion) -> Vec<HoseUse> {
    let mut tracks: Vec<Track> = job.cell.hoses.iter().map(|hose| Track::new(job, hose)).collect();
    if tracks.is_empty() {
        return Vec::new();
    }
    let mut walk = Walk { job, poses: Vec::new() };
    let mut before = (Posture::new(&job.cell.home), 0.0);
    let mut first = 0;
    for leg in &motion.legs {
        for moment in &leg.moments {
            let n_steps = (moment.q.distance(&before.0) / STEP).ceil().max(1.0) as usize;
            for k in first..=n_steps {
                let share = k as f64 / n_steps as f64;
                let at = Pull {
                    value: 0.0,
                    time_s: before.1 + (moment.time_s - before.1) * share,
                    phase: leg.phase,
                    strand: leg.strand,
                    at_m: moment.at_m,
                    point: Point::origin(),
                };
                walk.look(&before.0.toward(&moment.q, share), &at, &mut tracks);
            }
            before = (moment.q, moment.time_s);
            first = 1; // home was looked at
        }
    }
    let used = |(hose, track): (usize, Track)| {
        Some(HoseUse { hose, stretch: track.stretch?, twist: track.worst_twist? })
    };
    tracks.into_iter().enumerate().filter_map(used).collect()
}

/// Holds the hoses against their length and twist; one finding for each.
pub fn judge_hoses(job: &Job, used: &[HoseUse], findings: &mut Findings) {
    for used in used {
        let hose = &job.cell.hoses[used.hose];
        let (pull, twist) = (&used.stretch, &used.twist);
        hold(pull, pull.value / hose.length_m, hose, true, findings, || Words {
            message: format!(
                "hose `{}` is pulled to {:.1} mm {}; it is {:.0} mm long",
                hose.name,
                pull.value * 1e3,
                place(job, pull.phase, pull.strand, pull.at_m),
                hose.length_m * 1e3
            ),
            hint: format!(
                "{:.0} mm of hose would just reach; or fix it to `{}` nearer to the tool",
                (pull.value * 1e3).ceil(),
                hose.link
            ),
        });
        hold(twist, twist.value.abs() / hose.twist_rad, hose, false, findings, || Words {
            message: format!(
                "hose `{}` is twisted by {:.0}° from home {}; it takes {:.0}°",
                hose.name,
                twist.value.to_degrees(),
                place(job, twist.phase, twist.strand, twist.at_m),
                hose.twist_rad.to_degrees()
            ),
            hint: format!(
                "turn it back by {:.0}° before: hold the spin, or move through home between strands",
                (twist.value.abs() - hose.twist_rad).to_degrees().max(0.0).ceil()
            ),
        });
    }
}

fn hold(
    pull: &Pull,
    share: f64,
    hose: &Hose,
    with_link: bool,
    findings: &mut Findings,
    words: impl FnOnce() -> Words,
) {
    let mut bodies = vec![hose.name.clone()];
    bodies.extend(with_link.then(|| hose.link.clone()));
    let on_strand = pull.strand.filter(|_| pull.phase == Phase::Print);
    let site = Site {
        strand: pull.strand,
        at_m: on_strand.map(|_| pull.at_m),
        phase: Some(pull.phase),
        bodies,
        point: Some(pull.point),
        ..Site::default()
    };
    let measured = Interval::exact(share);
    let time_s = Some(pull.time_s);
    findings.check(
        Check { code: Code::E502, measured, limit: 1.0, warn_limit: None, site, time_s },
        words,
    );
}

/// One hose on its way through the program.
struct Track<'a> {
    hose: &'a Hose,
    /// Rotation of the end seen from the link, at home.
    home: UnitQuaternion<f64>,
    /// Last angle of the split, and the twist it has come to.
    angle_rad: f64,
    twist_rad: f64,
    stretch: Option<Pull>,
    worst_twist: Option<Pull>,
}

impl<'a> Track<'a> {
    fn new(job: &Job, hose: &'a Hose) -> Self {
        let mut poses = Vec::new();
        let chain = &job.cell.robot.arm.chain;
        chain.link_poses(&job.cell.home, &mut poses);
        let world_from_end = world_from_end(job, &chain.forward(&job.cell.home));
        let home = world_from_link(hose, &poses).rotation.inverse() * world_from_end.rotation;
        Self { hose, home, angle_rad: 0.0, twist_rad: 0.0, stretch: None, worst_twist: None }
    }

    fn turn(&mut self, link_from_end: &UnitQuaternion<f64>) {
        use std::f64::consts::{PI, TAU};
        let since_home = self.home.inverse() * link_from_end;
        let (z, w) = (since_home.k, since_home.w);
        if z * z + w * w < HALF_TURN {
            return;
        }
        let angle_rad = 2.0 * z.atan2(w);
        self.twist_rad += (angle_rad - self.angle_rad + PI).rem_euclid(TAU) - PI;
        self.angle_rad = angle_rad;
    }
}

struct Walk<'a> {
    job: &'a Job,
    poses: Vec<Pose>,
}

impl Walk<'_> {
    fn look(&mut self, q: &Posture, at: &Pull, tracks: &mut [Track<'_>]) {
        let chain = &self.job.cell.robot.arm.chain;
        chain.link_poses(q, &mut self.poses);
        let last = self.poses.last().copied().unwrap_or_else(Pose::identity);
        let world_from_end = world_from_end(self.job, &(last * chain.last_from_tip()));
        for track in tracks {
            let world_from_link = world_from_link(track.hose, &self.poses);
            let ends = [world_from_link * track.hose.from, world_from_end * track.hose.to];
            track.turn(&(world_from_link.rotation.inverse() * world_from_end.rotation));
            let noted = |value: f64| Pull { value, point: orifice(self.job, q), ..*at };
            let apart_m = (ends[1] - ends[0]).norm();
            if track.stretch.is_none_or(|worst| apart_m > worst.value) {
                track.stretch = Some(noted(apart_m));
            }
            if track.worst_twist.is_none_or(|worst| track.twist_rad.abs() > worst.value.abs()) {
                track.worst_twist = Some(noted(track.twist_rad));
            }
        }
    }
}

/// What rides on the flange.
fn world_from_end(job: &Job, world_from_tip: &Pose) -> Pose {
    match job.cell.mode {
        Mode::ToolOnFlange => job.cell.world_from_tool(world_from_tip),
        Mode::BedOnFlange => job.cell.world_from_bed(world_from_tip),
    }
}

fn world_from_link(hose: &Hose, poses: &[Pose]) -> Pose {
    hose.carrier.map_or_else(Pose::identity, |joint| poses[joint]) * hose.carrier_from_link
}
