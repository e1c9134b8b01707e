//! How the drives follow the hardest stop of the program, by rapier3d.

use crate::cell::{Job, Mode};
use crate::dynamics::drives::{Drives, FeedForward, Gains, Watched, follow};
use crate::dynamics::{Timed, differentiate};
use crate::finding::Phase;
use crate::kinematics::Posture;
use crate::motion::{Leg, Motion};
use crate::pose::{Point, Pose};

/// How the arm follows the end of the transit that moves its joints fastest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tracking {
    /// Index of the leg.
    pub leg: usize,
    /// When it stops, s.
    pub stop_s: f64,
    /// Greatest distance of the orifice from the plan, m.
    pub greatest_m: f64,
    /// Root mean square of it, m.
    pub rms_m: f64,
    /// Time after the stop until the orifice stays within [`SETTLED_M`], s; `None`: it does not in
    /// [`REST_S`].
    pub settling_s: Option<f64>,
    /// Natural frequency of the drives that is assumed, Hz.
    pub frequency_hz: f64,
}

/// Drives as stiff as this in every joint, Hz, and damped as this; ours, assumed: makers do not
/// publish them. Structural frequencies of small arms lie between 10 and 30 Hz.
const FREQUENCY_HZ: f64 = 12.0;
const DAMPING_RATIO: f64 = 0.7;
const STEP_S: f64 = 1e-3;
/// What is looked at before and after the stop, s.
const MOVE_S: f64 = 0.6;
const REST_S: f64 = 0.6;
/// A tenth of a millimetre is a settled arm.
pub const SETTLED_M: f64 = 1e-4;

/// `None` where no masses are known, nothing moves, or rapier cannot model the arm.
pub(super) fn tracking(job: &Job, motion: &Motion) -> Option<Tracking> {
    let model = job.cell.dynamics()?;
    let model = job.cell.flange_load().map_or(model.clone(), |load| model.with_payload(&load));
    let transits = motion.legs.iter().enumerate().filter(|(_, leg)| leg.phase == Phase::Transit);
    let (index, leg) = transits
        .filter(|(_, leg)| leg.moments.len() > 2)
        .max_by(|a, b| fastest(job, a.1).total_cmp(&fastest(job, b.1)))?;
    let (first, last) = (leg.moments.first()?, leg.moments.last()?);
    let motion = planned(leg);
    let gains = Gains::for_posture(&model, &last.q, FREQUENCY_HZ, DAMPING_RATIO);
    let drives = Drives { gains, feed_forward: FeedForward::Gravity, step_s: STEP_S };
    let stop_s = last.time_s;
    let window_s = ((stop_s - MOVE_S).max(first.time_s), stop_s + REST_S);
    let followed = follow(&model, &drives, &motion, window_s, &watched(job)).ok()?;
    Some(Tracking {
        leg: index,
        stop_s,
        greatest_m: followed.greatest().0,
        rms_m: followed.rms_m(),
        settling_s: followed.settling_s(stop_s, SETTLED_M),
        frequency_hz: FREQUENCY_HZ,
    })
}

fn watched(job: &Job) -> Watched {
    let orifice = |pose: &Pose| Point::from(pose.translation.vector);
    match job.cell.mode {
        Mode::ToolOnFlange => Watched::OnTip(orifice(&job.cell.tool_pose)),
        Mode::BedOnFlange => Watched::AtRest(orifice(&job.cell.tool_pose)),
    }
}

/// Greatest share of a joint's speed limit between two moments.
fn fastest(job: &Job, leg: &Leg) -> f64 {
    let axes = job.cell.robot.arm.chain.axes();
    let share = |pair: &[crate::motion::Moment]| {
        let dt_s = (pair[1].time_s - pair[0].time_s).max(1e-9);
        let joints = axes.iter().zip(pair[0].q.iter().zip(pair[1].q.iter()));
        joints.map(|(axis, (a, b))| (b - a).abs() / dt_s / axis.velocity).fold(0.0, f64::max)
    };
    leg.moments.windows(2).map(share).fold(0.0, f64::max)
}

/// The leg and the rest after it, with speeds and accelerations.
fn planned(leg: &Leg) -> Vec<Timed> {
    let mut samples: Vec<(f64, Posture)> = Vec::new();
    for pair in leg.moments.windows(2) {
        let n_steps = ((pair[1].time_s - pair[0].time_s) / 0.02).ceil().clamp(1.0, 200.0) as usize;
        for k in 0..n_steps {
            let share = k as f64 / n_steps as f64;
            let time_s = pair[0].time_s + (pair[1].time_s - pair[0].time_s) * share;
            samples.push((time_s, pair[0].q.toward(&pair[1].q, share)));
        }
    }
    if let Some(last) = leg.moments.last() {
        samples.extend(
            (0..=(REST_S / 0.02) as usize + 2).map(|k| (last.time_s + 0.02 * k as f64, last.q)),
        );
    }
    differentiate(&samples, 0.06)
}
