//! What the drives need at the asked print speed: acceleration and torque as shares of their limits.

use crate::cell::Job;
use crate::dynamics::{Body, JointVector, Model, State};
use crate::kinematics::Posture;
use crate::timing::Law;

/// What is asked of a drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Load {
    /// Acceleration.
    Acceleration,
    /// Torque or force; `resting` is the share that gravity alone takes there, without sign.
    Torque {
        /// Share of the limit at rest.
        resting: f64,
    },
}

/// The most that a printed strand asks of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Need {
    /// Index of the leg.
    pub leg: usize,
    /// When, s.
    pub time_s: f64,
    /// Arc length, m.
    pub at_m: f64,
    /// Posture there.
    pub q: Posture,
    /// Index of the joint in the joint vector.
    pub joint: usize,
    /// What is asked.
    pub load: Load,
    /// As a share of the limit, without sign.
    pub share: f64,
}

/// What is known of the drives.
pub(super) struct Drives<'a> {
    job: &'a Job,
    pub(super) velocity: Posture,
    /// Limits that the controller uses.
    pub(super) acceleration: Vec<Option<f64>>,
    model: Option<Model>,
}

impl<'a> Drives<'a> {
    pub(super) fn new(job: &'a Job) -> Self {
        let robot = &job.cell.robot;
        let velocities: Vec<f64> =
            robot.arm.chain.axes().iter().map(|axis| axis.velocity).collect();
        let share = job.cell.controller.joint_acceleration_share;
        let load = job.cell.flange_load();
        let model = job.cell.dynamics();
        let loaded = |model: Model, load: Body| model.with_payload(&load);
        Self {
            job,
            velocity: Posture::new(&velocities),
            acceleration: robot.acceleration.iter().map(|limit| limit.map(|a| a * share)).collect(),
            model: match (model, load) {
                (Some(model), Some(load)) => Some(loaded(model, load)),
                (model, _) => model,
            },
        }
    }

    /// The largest share of each kind that the path takes at the speed of a law: at most one of
    /// acceleration and one of torque.
    ///
    /// Ramps are the controller's to choose and are left out: the acceleration is `q'' ṡ²`, what it
    /// is without `q' s̈`.
    pub(super) fn needs(&self, law: &Law) -> Vec<Need> {
        let robot = &self.job.cell.robot;
        let mut worst: [Option<Need>; 2] = [None, None];
        for time_s in places(law) {
            let state = law.at(time_s);
            let [at_m, speed, ramp, _] = state.path;
            let mut even = state.acceleration;
            for (value, joint_speed) in even.iter_mut().zip(state.speed.iter()) {
                *value -= if speed > 0.0 { joint_speed / speed * ramp } else { *value };
            }
            let mut note = |slot: usize, joint: usize, share: f64, load: Load| {
                if share.is_finite() && worst[slot].is_none_or(|need| share > need.share) {
                    worst[slot] =
                        Some(Need { leg: 0, time_s, at_m, q: state.q, joint, load, share });
                }
            };
            for (joint, limit) in robot.acceleration.iter().enumerate() {
                if let Some(limit) = limit {
                    let share = even[joint].abs() / limit;
                    note(0, joint, share, Load::Acceleration);
                }
            }
            let Some(model) = &self.model else { continue };
            let torques = model.torques(&State {
                q: JointVector::new(&state.q),
                qd: JointVector::new(&state.speed),
                qdd: JointVector::new(&even),
            });
            let held = model.holding_torques(&state.q);
            for (joint, limit) in robot.torque.iter().enumerate() {
                if let Some(limit) = limit {
                    let resting = held[joint].abs() / limit;
                    note(1, joint, torques[joint].abs() / limit, Load::Torque { resting });
                }
            }
        }
        worst.into_iter().flatten().collect()
    }
}

/// Instants at which a law is looked at: both sides of every change, and the middles.
pub(super) fn places(law: &Law) -> impl Iterator<Item = f64> {
    let mut instants: Vec<f64> = law.instants().chain([law.duration_s]).collect();
    let middles: Vec<f64> = instants.windows(2).map(|pair| (pair[0] + pair[1]) / 2.0).collect();
    instants.extend(middles);
    instants.sort_by(f64::total_cmp);
    instants.into_iter()
}
