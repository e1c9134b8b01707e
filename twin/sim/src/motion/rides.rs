//! How a bed that rides on the arm moves, at both sides of every change of the law and between.

use super::drives::places;
use crate::cell::{Job, Mode};
use crate::kinematics::Carried;
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
/// is taken to follow, ramps and all; rounding of corners is as the law has it.
pub(super) fn of_law(job: &Job, law: &Law) -> Vec<Ride> {
    if job.cell.mode != Mode::BedOnFlange {
        return Vec::new();
    }
    let tip_from_part = job.cell.bed.pose * job.bed_from_part;
    let ride = |time_s: f64| {
        let state = law.at(time_s);
        let moving = [&state.q[..], &state.speed[..], &state.acceleration[..]];
        let carried = job.cell.robot.arm.chain.carried(moving, &tip_from_part);
        Ride { leg: 0, time_s, carried }
    };
    places(law).map(ride).collect()
}
