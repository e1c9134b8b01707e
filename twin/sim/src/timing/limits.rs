//! What the arm can do.

use crate::kinematics::{MAX_DOF, Posture};

use super::Fault;

/// Limits of the arm and of the path parameter.
#[derive(Clone, Copy)]
pub struct Limits<'a> {
    /// Joint speed, rad/s or m/s; infinite: none.
    pub velocity: Posture,
    /// Joint acceleration, rad/s² or m/s²; `None` or missing: not known.
    pub acceleration: &'a [Option<f64>],
    /// Joint jerk, rad/s³ or m/s³; `None` or missing: not known.
    pub jerk: &'a [Option<f64>],
    /// Largest d²s/dt², the controller's own ramp, m/s². Needed where a joint's is not known.
    pub path_acceleration: Option<f64>,
    /// Largest d³s/dt³, m/s³.
    pub path_jerk: Option<f64>,
    /// How far before and after a corner the controller may leave the path, m; 0: stop at corners.
    pub blend_m: f64,
    /// Joint torques.
    pub torque: Option<Torque<'a>>,
}

/// Bounds on joint torque and what moves them.
#[derive(Clone, Copy)]
pub struct Torque<'a> {
    /// Lowest torque or force, Nm or N.
    pub lower: Posture,
    /// Highest torque or force, Nm or N.
    pub upper: Posture,
    /// From `q`, `q'`, `q''` to the torque as a linear form.
    pub law: &'a TorqueLaw<'a>,
}

/// See [`Torque::law`].
pub type TorqueLaw<'a> = dyn Fn(&[f64], &[f64], &[f64]) -> TorqueRow + Sync + 'a;

/// Joint torque `a s̈ + b ṡ² + c` at one place of a path, Nm or N.
///
/// ```text
/// a = M(q) q'        b = M(q) q'' + C(q, q') q'        c = g(q)
/// ```
///
/// Friction that grows with speed is not of this form; the caller takes it off the bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorqueRow {
    /// `a`, per unit of d²s/dt².
    pub acceleration: Posture,
    /// `b`, per unit of (ds/dt)².
    pub speed_squared: Posture,
    /// `c`, what standing still takes.
    pub rest: Posture,
}

/// [`Limits`] checked, with infinity for what is not known.
#[derive(Clone, Copy)]
pub(super) struct Bounds<'a> {
    pub(super) dof: usize,
    pub(super) velocity: [f64; MAX_DOF],
    pub(super) acceleration: [f64; MAX_DOF],
    pub(super) jerk: [f64; MAX_DOF],
    pub(super) ramp: f64,
    pub(super) ramp_jerk: f64,
    pub(super) torque: Option<Torque<'a>>,
}

impl<'a> Bounds<'a> {
    /// Checks limits; without `accelerates` nothing needs to bound the acceleration.
    pub(super) fn new(limits: &Limits<'a>, accelerates: bool) -> Result<Self, Fault> {
        let dof = limits.velocity.len();
        let mut bounds = Self {
            dof,
            velocity: [f64::INFINITY; MAX_DOF],
            acceleration: [f64::INFINITY; MAX_DOF],
            jerk: [f64::INFINITY; MAX_DOF],
            ramp: limits.path_acceleration.unwrap_or(f64::INFINITY),
            ramp_jerk: limits.path_jerk.unwrap_or(f64::INFINITY),
            torque: limits.torque,
        };
        for joint in 0..dof {
            let known = |row: &[Option<f64>]| row.get(joint).copied().flatten();
            bounds.velocity[joint] = limits.velocity[joint];
            bounds.acceleration[joint] = known(limits.acceleration).unwrap_or(f64::INFINITY);
            bounds.jerk[joint] = known(limits.jerk).unwrap_or(f64::INFINITY);
            let all = [bounds.velocity[joint], bounds.acceleration[joint], bounds.jerk[joint]];
            if !all.iter().all(|limit| *limit > 0.0) {
                return Err(Fault::Limit { joint });
            }
            let open = |limit: f64| limit.is_infinite();
            if accelerates && open(bounds.ramp) && open(bounds.acceleration[joint]) {
                return Err(Fault::NoAcceleration { joint });
            }
            if let Some(torque) = &limits.torque {
                let ends = (torque.lower.get(joint), torque.upper.get(joint));
                if !matches!(ends, (Some(low), Some(high)) if low < high) {
                    return Err(Fault::Limit { joint });
                }
            }
        }
        if !(bounds.ramp > 0.0 && bounds.ramp_jerk > 0.0 && limits.blend_m >= 0.0) {
            return Err(Fault::PathLimit);
        }
        Ok(bounds)
    }

    /// Whether anything bounds jerk.
    pub(super) fn jerk_known(&self) -> bool {
        self.ramp_jerk.is_finite() || self.jerk.iter().any(|limit| limit.is_finite())
    }
}
