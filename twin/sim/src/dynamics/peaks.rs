//! Torque against its limit along a motion in time.

use super::model::{JointVector, Model};
use super::moving::{Timed, differentiate};

/// The greatest torque of one joint along a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorquePeak {
    /// Entry of the joint vector.
    pub joint: usize,
    /// When, s.
    pub t_s: f64,
    /// The torque with its sign, N m or N.
    pub torque: f64,
    /// The most the joint has, where known.
    pub limit: Option<f64>,
}

impl TorquePeak {
    /// Share of the limit; `None` where there is none.
    pub fn share(&self) -> Option<f64> {
        self.limit.map(|limit| self.torque.abs() / limit)
    }
}

/// Peak of every joint along a motion, the first of equals; none for a motion without moments.
/// `limits` has one entry per joint, N m or N.
pub fn torque_peaks(model: &Model, limits: &[Option<f64>], motion: &[Timed]) -> Vec<TorquePeak> {
    let mut peaks: Vec<TorquePeak> = Vec::new();
    for moment in motion {
        let torques = model.torques(&moment.state);
        let peak = |joint: usize| TorquePeak {
            joint,
            t_s: moment.t_s,
            torque: torques[joint],
            limit: limits.get(joint).copied().flatten(),
        };
        if peaks.is_empty() {
            peaks = (0..torques.len()).map(peak).collect();
        }
        for (joint, known) in peaks.iter_mut().enumerate() {
            if torques[joint].abs() > known.torque.abs() {
                *known = peak(joint);
            }
        }
    }
    peaks
}

/// The same for samples `(t, q)`, speeds and accelerations by [`differentiate`].
pub fn torque_shares(
    model: &Model,
    limits: &[Option<f64>],
    samples: &[(f64, JointVector)],
    half_window_s: f64,
) -> Vec<TorquePeak> {
    torque_peaks(model, limits, &differentiate(samples, half_window_s))
}
