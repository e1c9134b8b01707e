//! A finished law against its limits.

use crate::kinematics::{MAX_DOF, Posture};

use super::course::Course;
use super::limits::Bounds;
use super::profile::{Profile, Step};

/// What bounds the motion; joints count from zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// The asked speed.
    Ceiling,
    /// Acceleration along the path.
    Ramp,
    /// Jerk along the path.
    RampJerk,
    /// Speed of a joint.
    Speed(usize),
    /// Acceleration of a joint.
    Acceleration(usize),
    /// Jerk of a joint.
    Jerk(usize),
    /// Torque of a joint.
    Torque(usize),
}

/// Largest values over a law; rad or m per s, s², s³.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peaks {
    /// ds/dt.
    pub path_speed: f64,
    /// |d²s/dt²|.
    pub path_acceleration: f64,
    /// Joint speeds.
    pub speed: Posture,
    /// Joint accelerations.
    pub acceleration: Posture,
    /// |d³s/dt³| and joint jerks; `None` where no limit of jerk is known, for then accelerations jump.
    pub jerk: Option<(f64, Posture)>,
    /// Joint torques, as shares of the bound on that side, what standing still takes left out of
    /// both; `None` without bounds.
    pub torque_share: Option<Posture>,
}

/// Places in a step from which on its largest values are bounded and not only found.
pub(super) const CERTAIN: usize = 17;
/// Largest `|u (u² − 1)|/6` for `|u| ≤ 1`: what a parabola misses per third difference; twice, since
/// the difference itself changes from place to place (with 9 places and once, a random path was
/// found 1.3e-6 past its limit).
const MISSED: f64 = 2.0 * 0.064_150_029_909_958_4;

/// Path speed, acceleration and jerk, then as many per joint, then torques.
const N: usize = 3 + 4 * MAX_DOF;

/// Largest absolute values over a stretch, in the order of [`bound`].
#[derive(Clone, Copy)]
pub(super) struct Loads {
    values: [f64; N],
}

/// Which bound an entry belongs to, and the power of time in it.
fn bound(index: usize) -> (Bound, i32) {
    let joint = (index.max(3) - 3) % MAX_DOF;
    match (index, (index.max(3) - 3) / MAX_DOF) {
        (0, _) => (Bound::Ceiling, 1),
        (1, _) => (Bound::Ramp, 2),
        (2, _) => (Bound::RampJerk, 3),
        (_, 0) => (Bound::Speed(joint), 1),
        (_, 1) => (Bound::Acceleration(joint), 2),
        (_, 2) => (Bound::Jerk(joint), 3),
        _ => (Bound::Torque(joint), 2),
    }
}

impl Loads {
    pub(super) const NONE: Self = Self { values: [0.0; N] };

    pub(super) fn raise(&mut self, other: &Self) {
        for (own, value) in self.values.iter_mut().zip(&other.values) {
            *own = own.max(*value);
        }
    }

    /// Shares of the limits: the bound, its power of time, the share.
    pub(super) fn shares(
        &self,
        ceiling: f64,
        bounds: &Bounds,
    ) -> impl Iterator<Item = (Bound, i32, f64)> {
        let bounds = *bounds;
        self.values.into_iter().enumerate().map(move |(index, value)| {
            let (bound, power) = bound(index);
            let limit = match bound {
                Bound::Ceiling => ceiling,
                Bound::Ramp => bounds.ramp,
                Bound::RampJerk => bounds.ramp_jerk,
                Bound::Speed(j) => bounds.velocity[j],
                Bound::Acceleration(j) => bounds.acceleration[j],
                Bound::Jerk(j) => bounds.jerk[j],
                Bound::Torque(_) => 1.0,
            };
            (bound, power, value / limit)
        })
    }

    /// The bound that is nearest to its limit.
    pub(super) fn tightest(&self, ceiling: f64, bounds: &Bounds) -> (Bound, f64) {
        let mut most = (Bound::Ceiling, 0.0);
        for (bound, _, share) in self.shares(ceiling, bounds) {
            if share > most.1 {
                most = (bound, share);
            }
        }
        most
    }

    /// How many times longer the motion must take to be within all limits; at most 1: it is.
    pub(super) fn stretch(&self, ceiling: f64, bounds: &Bounds) -> f64 {
        let factor = |(_, power, share): (Bound, i32, f64)| match power {
            1 => share,
            2 => share.sqrt(),
            _ => share.cbrt(),
        };
        self.shares(ceiling, bounds).map(factor).fold(0.0, f64::max)
    }

    pub(super) fn peaks(&self, bounds: &Bounds) -> Peaks {
        let dof = bounds.dof;
        let block = |k: usize| Posture::new(&self.values[3 + k * MAX_DOF..][..dof]);
        Peaks {
            path_speed: self.values[0],
            path_acceleration: self.values[1],
            speed: block(0),
            acceleration: block(1),
            jerk: bounds.jerk_known().then(|| (self.values[2], block(2))),
            torque_share: bounds.torque.is_some().then(|| block(3)),
        }
    }
}

/// The steps of `profile` with their lengths.
pub(super) fn steps(profile: &Profile) -> impl Iterator<Item = (Step, f64)> {
    profile.steps.windows(2).map(|pair| (pair[0], pair[1].t - pair[0].t))
}

/// Largest values within a step: at `N_AT` places and, in between, of the parabolas through three.
/// [`CERTAIN`] places or more: and what parabolas may miss, from third differences.
pub(super) fn within<const N_AT: usize>(
    course: &Course,
    bounds: &Bounds,
    step: &Step,
    dt: f64,
) -> (Loads, f64) {
    let piece = &course.pieces[course.piece_at(step.later(dt / 2.0).s)];
    let mut rows = [[0.0; N]; N_AT];
    for (k, row) in rows.iter_mut().enumerate() {
        let state = step.later(dt * k as f64 / (N_AT - 1) as f64);
        let s = state.s.clamp(piece.from, piece.to);
        fill(row, &piece.at(s), &state, bounds);
    }
    let mut loads = Loads::NONE;
    for (index, most) in loads.values.iter_mut().enumerate() {
        let at = |k: usize| rows[k][index];
        *most = (0..N_AT).map(|k| at(k).abs()).fold(0.0, f64::max);
        for k in 1..N_AT - 1 {
            let (before, here, after) = (at(k - 1), at(k), at(k + 1));
            let (slope, bend) = ((after - before) / 2.0, after - 2.0 * here + before);
            let vertex = -slope / bend;
            if vertex.abs() < 1.0 {
                *most = most.max((here + slope * vertex / 2.0).abs());
            }
        }
        if N_AT >= CERTAIN {
            let third = |k: usize| (at(k + 3) - at(k) - 3.0 * (at(k + 2) - at(k + 1))).abs();
            *most += MISSED * (0..N_AT - 3).map(third).fold(0.0, f64::max);
        }
    }
    (loads, piece.ceiling)
}

fn fill(row: &mut [f64; N], jet: &super::course::Jet, state: &Step, bounds: &Bounds) {
    let Step { v, a, j, .. } = *state;
    row[..3].copy_from_slice(&[v, a, j]);
    let dof = bounds.dof;
    for joint in 0..dof {
        let (d1, d2, d3) = (jet.d1[joint], jet.d2[joint], jet.d3[joint]);
        row[3 + joint] = d1 * v;
        row[3 + MAX_DOF + joint] = d1 * a + d2 * v * v;
        row[3 + 2 * MAX_DOF + joint] = d1 * j + 3.0 * d2 * v * a + d3 * v * v * v;
    }
    if let Some(torque) = &bounds.torque {
        let form = (torque.law)(&jet.q[..dof], &jet.d1[..dof], &jet.d2[..dof]);
        let joints = form.acceleration.iter().zip(form.speed_squared.iter()).zip(form.rest.iter());
        for (joint, ((per_a, per_v2), rest)) in joints.enumerate().take(dof) {
            let extra = per_a * a + per_v2 * v * v;
            let bound = if extra > 0.0 { torque.upper[joint] } else { torque.lower[joint] };
            row[3 + 3 * MAX_DOF + joint] = extra.abs() / (bound - rest).abs();
        }
    }
}
