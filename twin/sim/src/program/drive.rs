//! R106: acceleration and torque against what the drives have.

use super::place;
use crate::cell::Job;
use crate::finding::{Check, Code, Findings, Phase, Site, Words};
use crate::interval::Interval;
use crate::pose::Point;

/// What is asked of a drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DriveLoad {
    /// Acceleration.
    Acceleration,
    /// Torque or force; `resting` is the share that gravity alone takes there, without sign.
    Torque {
        /// Share of the limit at rest.
        resting: f64,
    },
}

/// The most that is asked of a joint on one stretch of the program.
#[derive(Debug, Clone, PartialEq)]
pub struct DrivePeak {
    /// The strand it belongs to.
    pub strand: Option<usize>,
    /// What the arm is doing.
    pub phase: Phase,
    /// Arc length on the strand, m.
    pub at_m: f64,
    /// Place of the orifice in part axes.
    pub point: Option<Point>,
    /// Time, s.
    pub time_s: f64,
    /// Name of the joint.
    pub joint: String,
    /// What is asked.
    pub load: DriveLoad,
    /// As a share of the joint's limit, without sign.
    pub share: Interval,
}

/// Holds peaks against the shares the cell allows; torque and acceleration are told apart by joint.
pub fn judge_drives(job: &Job, peaks: &[DrivePeak], findings: &mut Findings) {
    for peak in peaks {
        let (limit, what) = match peak.load {
            DriveLoad::Acceleration => (job.limits.acceleration_share, "acceleration"),
            DriveLoad::Torque { .. } => (job.limits.torque_share, "torque"),
        };
        let printing = peak.phase == Phase::Print;
        let site = Site {
            strand: peak.strand,
            at_m: printing.then_some(peak.at_m),
            phase: Some(peak.phase),
            bodies: vec![peak.joint.clone()],
            point: peak.point,
            ..Site::default()
        };
        let check = Check {
            code: Code::R106,
            measured: peak.share,
            limit,
            warn_limit: None,
            site,
            time_s: Some(peak.time_s),
        };
        findings.check(check, || Words {
            message: format!(
                "joint {} needs {:.0} % of its {what} {}",
                peak.joint,
                peak.share.nominal * 100.0,
                place(job, peak.phase, peak.strand, peak.at_m)
            ),
            hint: slower(peak, limit),
        });
    }
}

/// Along a given path both acceleration and the torque beyond gravity's grow with the square of the
/// speed: `share(k v) = resting + k² (share − resting)`.
fn slower(peak: &DrivePeak, limit: f64) -> String {
    let resting = match peak.load {
        DriveLoad::Acceleration => 0.0,
        DriveLoad::Torque { resting } => resting,
    };
    let share = if peak.share.nominal > limit { peak.share.nominal } else { peak.share.high };
    if resting >= limit || share <= resting {
        return format!(
            "gravity alone takes {:.0} %: a lighter tool, or a posture nearer to the base",
            resting * 100.0
        );
    }
    let factor = ((limit - resting) / (share - resting)).sqrt();
    format!("go at {:.0} % of this speed here, or round the corner", (factor * 100.0).floor())
}
