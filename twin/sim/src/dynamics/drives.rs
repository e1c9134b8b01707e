//! The arm following a planned motion: rapier3d's multibody with a spring and a damper in every
//! joint.
//!
//! Each drive pulls with `τ = k (q* − q) + d (q̇* − q̇) + τ_ff`, the starred values those of the
//! plan. Links are rigid, gears too: what compliance there is sits in `k`, which no maker
//! publishes. The result says how far a controller of the stated bandwidth lets the tip stray, not
//! how far one certain arm does.

mod multibody;

pub(super) use multibody::Multibody;

use thiserror::Error;

use super::model::{JointVector, Model, State};
use super::moving::{Timed, at_time};
use crate::pose::{Point, Pose, Vector};

/// Spring and damper of every joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gains {
    /// `k`, N m/rad or N/m.
    pub stiffness: JointVector,
    /// `d`, N m s/rad or N s/m.
    pub damping: JointVector,
}

impl Gains {
    /// Gains that give every joint alone, the others held, this natural frequency and damping ratio
    /// in posture `q`: `k = M_ii ω²`, `d = 2 ζ M_ii ω`, `M` the mass matrix, `ω = 2π f`.
    ///
    /// Without [`Model::with_rotors`] the light links of a wrist get soft springs: there a real
    /// drive, whose rotor weighs more than the link, yields less under a load.
    pub fn for_posture(model: &Model, q: &[f64], frequency_hz: f64, damping_ratio: f64) -> Self {
        let mass = model.mass_matrix(q);
        let omega = std::f64::consts::TAU * frequency_hz;
        let mut gains = Self {
            stiffness: JointVector::zeros(model.dof()),
            damping: JointVector::zeros(model.dof()),
        };
        for joint in 0..model.dof() {
            gains.stiffness[joint] = mass[(joint, joint)] * omega * omega;
            gains.damping[joint] = 2.0 * damping_ratio * mass[(joint, joint)] * omega;
        }
        gains
    }
}

/// What the drives add of their own accord.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FeedForward {
    /// Nothing: the arm sags by `τ_g / k`.
    None,
    /// The torque that holds the planned posture.
    Gravity,
    /// The torque of the planned motion, all of it.
    Motion,
}

/// How a motion is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drives {
    /// Springs and dampers.
    pub gains: Gains,
    /// What is added.
    pub feed_forward: FeedForward,
    /// Time step, s. First order in time: at natural frequency `ω` a step adds `ω dt / 2` to the
    /// damping ratio.
    pub step_s: f64,
}

/// The point whose error is told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Watched {
    /// A point that rides on the tip, in tip axes, m: the orifice of a tool on the flange.
    OnTip(Point),
    /// A point at rest in base axes, m: the orifice over a bed on the flange. The error is that of
    /// what the plan has there.
    AtRest(Point),
}

/// Where the watched point was against where it should have been.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tracked {
    /// Time, s.
    pub t_s: f64,
    /// The watched point minus its planned place, base axes, m.
    pub offset: Vector,
    /// Joint values.
    pub q: JointVector,
}

/// How a stretch of a motion was followed.
#[derive(Debug, Clone, PartialEq)]
pub struct Followed {
    /// One entry per step.
    pub steps: Vec<Tracked>,
    /// Greatest torque of every drive, N m or N; not held against a limit: the drives saturate
    /// nowhere.
    pub torque: JointVector,
}

impl Followed {
    /// Greatest distance of the watched point from the plan, m, and when, s.
    pub fn greatest(&self) -> (f64, f64) {
        let further = |best: (f64, f64), step: &Tracked| {
            let distance = step.offset.norm();
            if distance > best.0 { (distance, step.t_s) } else { best }
        };
        self.steps.iter().fold((0.0, self.steps.first().map_or(0.0, |step| step.t_s)), further)
    }

    /// Root mean square of that distance, m.
    pub fn rms_m(&self) -> f64 {
        let squares: f64 = self.steps.iter().map(|step| step.offset.norm_squared()).sum();
        (squares / self.steps.len().max(1) as f64).sqrt()
    }

    /// Time from `stop_s` until the point stays within `tolerance_m` of the plan to the end of the
    /// stretch, s; `None` where it does not, or where the stretch ends before the stop.
    pub fn settling_s(&self, stop_s: f64, tolerance_m: f64) -> Option<f64> {
        let last = self.steps.last().filter(|last| last.t_s >= stop_s)?;
        let outside = |step: &&Tracked| step.t_s >= stop_s && !(step.offset.norm() <= tolerance_m);
        match self.steps.iter().rev().find(outside) {
            None => Some(0.0),
            Some(step) if step.t_s >= last.t_s => None,
            Some(step) => Some(step.t_s - stop_s),
        }
    }
}

/// Why a motion cannot be followed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DriveFault {
    /// rapier's multibody joints follow no other.
    #[error("the arm has joints that follow others; these are not simulated")]
    Followers,
    /// A joint that carries no mass.
    #[error("joint {joint} carries no mass")]
    Massless {
        /// Its number in the chain.
        joint: usize,
    },
    /// No motion, or joint vectors of another length than the arm's.
    #[error("the motion is empty or of another arm")]
    NoMotion,
    /// Steps or gains that are none, or too many steps.
    #[error(
        "a stretch of {from_s} s to {to_s} s in steps of {step_s} s: at least 1, at most {MOST_STEPS}"
    )]
    Steps {
        /// Begin, s.
        from_s: f64,
        /// End, s.
        to_s: f64,
        /// Step, s.
        step_s: f64,
    },
    /// Stiffness that is not positive, or a negative damping.
    #[error("drive {joint} has no usable stiffness or damping")]
    Gains {
        /// Entry of the joint vector.
        joint: usize,
    },
    /// The arm flew apart.
    #[error("the simulation diverged at {t_s} s; take a smaller step")]
    Diverged {
        /// When, s.
        t_s: f64,
    },
}

/// Most steps of one stretch: some ten seconds of work.
pub const MOST_STEPS: usize = 400_000;

/// Follows `motion` from `window_s.0` to `window_s.1`. The arm starts at the plan's speed and off the
/// plan by what stretches its springs to the torque the plan asks there, so that the window does not
/// begin with a blow.
///
/// The plan stands still before its first and after its last moment, so a window past the end shows
/// how the arm settles. rapier computes in `f32`: joint values are kept relative to the start of
/// the window, which leaves about 1e-7 rad per radian moved. Deterministic: one thread, fixed step,
/// no contacts.
///
/// # Errors
/// [`DriveFault`].
pub fn follow(
    model: &Model,
    drives: &Drives,
    motion: &[Timed],
    window_s: (f64, f64),
    watched: &Watched,
) -> Result<Followed, DriveFault> {
    let n_steps = checked(model, drives, motion, window_s)?;
    let (from_s, step_s) = (window_s.0, drives.step_s);
    let plan = |t_s: f64| at_time(motion, t_s).ok_or(DriveFault::NoMotion);
    let start = plan(from_s)?;
    let begin = loaded(model, drives, &start);
    let mut arm = Multibody::new(model, &begin.q, &start.qd, step_s)?;
    let mut followed =
        Followed { steps: Vec::with_capacity(n_steps), torque: JointVector::zeros(model.dof()) };
    for step in 1..=n_steps {
        let t_s = from_s + step as f64 * step_s;
        let wanted = plan(t_s)?;
        let ahead = fed(model, drives.feed_forward, &wanted);
        arm.set_drives(&drives.gains, &wanted, &ahead);
        arm.step();
        let (q, qd) = (arm.q(), arm.qd());
        if !q.iter().chain(qd.iter()).all(|x| x.is_finite()) {
            return Err(DriveFault::Diverged { t_s });
        }
        for joint in 0..model.dof() {
            let torque = drives.gains.stiffness[joint] * (wanted.q[joint] - q[joint])
                + drives.gains.damping[joint] * (wanted.qd[joint] - qd[joint])
                + ahead[joint];
            followed.torque[joint] = followed.torque[joint].max(torque.abs());
        }
        let offset = offset(&model.tip(&q), &model.tip(&wanted.q), watched);
        followed.steps.push(Tracked { t_s, offset, q });
    }
    Ok(followed)
}

/// Where the watched point is minus where the plan has it.
fn offset(tip: &Pose, planned: &Pose, watched: &Watched) -> Vector {
    match watched {
        Watched::OnTip(point) => tip * point - planned * point,
        Watched::AtRest(point) => tip * planned.inverse_transform_point(point) - point,
    }
}

fn checked(
    model: &Model,
    drives: &Drives,
    motion: &[Timed],
    (from_s, to_s): (f64, f64),
) -> Result<usize, DriveFault> {
    let fits = |moment: &Timed| moment.state.q.len() == model.dof();
    if motion.is_empty() || !motion.iter().all(fits) {
        return Err(DriveFault::NoMotion);
    }
    let gains = &drives.gains;
    let usable = |joint: &usize| {
        let (k, d) = (gains.stiffness.get(*joint), gains.damping.get(*joint));
        k.is_some_and(|&k| k > 0.0 && k.is_finite())
            && d.is_some_and(|&d| d >= 0.0 && d.is_finite())
    };
    if let Some(joint) = (0..model.dof()).find(|joint| !usable(joint)) {
        return Err(DriveFault::Gains { joint });
    }
    let step_s = drives.step_s;
    let steps = ((to_s - from_s) / step_s).round();
    if !(step_s > 0.0 && (1.0..=MOST_STEPS as f64).contains(&steps)) {
        return Err(DriveFault::Steps { from_s, to_s, step_s });
    }
    Ok(steps as usize)
}

/// The feed-forward torque.
fn fed(model: &Model, feed_forward: FeedForward, wanted: &State) -> JointVector {
    match feed_forward {
        FeedForward::None => JointVector::zeros(model.dof()),
        FeedForward::Gravity => model.holding_torques(&wanted.q),
        FeedForward::Motion => model.torques(wanted),
    }
}

/// The plan's state with the springs already stretched by what they must give, so that the window
/// does not begin with the arm falling into them.
fn loaded(model: &Model, drives: &Drives, start: &State) -> State {
    let (needed, ahead) = (model.torques(start), fed(model, drives.feed_forward, start));
    let mut state = *start;
    for joint in 0..model.dof() {
        state.q[joint] -= (needed[joint] - ahead[joint]) / drives.gains.stiffness[joint];
    }
    state
}
