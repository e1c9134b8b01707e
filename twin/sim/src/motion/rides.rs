//! How a bed that rides on the arm moves: at both sides of every change of the law, and between.

use super::Station;
use super::drives::places;
use crate::cell::{Job, Mode};
use crate::dynamics::differentiate;
use crate::kinematics::{Carried, Posture};
use crate::timing::Law;

/// Motion of the part at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ride {
    /// Index of the leg.
    pub leg: usize,
    /// When, s.
    pub time_s: f64,
    /// Of the part's axes, told in them.
    pub carried: Carried,
}

/// Nothing where the bed stands. Speeds and accelerations are those of the law that the controller
/// is taken to follow, ramps and all; corners are rounded as the law has them.
pub(super) fn of_law(job: &Job, law: &Law) -> Vec<Ride> {
    if job.cell.mode != Mode::BedOnFlange {
        return Vec::new();
    }
    let at = |time_s: f64| {
        let state = law.at(time_s);
        ride(job, time_s, [&state.q, &state.speed, &state.acceleration])
    };
    places(law).map(at).collect()
}

/// The same of postures at times that the job gives: by parabolas through five of them, so that a
/// shorter peak is told too low.
pub(super) fn of_times(job: &Job, stations: &[Station], times_s: &[f64]) -> Vec<Ride> {
    if job.cell.mode != Mode::BedOnFlange {
        return Vec::new();
    }
    let samples = times_s.iter().zip(stations).map(|(time_s, station)| (*time_s, station.q));
    differentiate(&samples.collect::<Vec<_>>(), 0.0)
        .iter()
        .map(|timed| ride(job, timed.t_s, [&timed.state.q, &timed.state.qd, &timed.state.qdd]))
        .collect()
}

fn ride(job: &Job, time_s: f64, moving: [&Posture; 3]) -> Ride {
    let tip_from_part = job.cell.bed.pose * job.bed_from_part;
    let carried = job.cell.robot.arm.chain.carried(moving.map(|of| &of[..]), &tip_from_part);
    Ride { leg: 0, time_s, carried }
}
