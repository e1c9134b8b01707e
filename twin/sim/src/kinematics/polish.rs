//! Measured error of a solution, and the Newton step that lowers it.

use nalgebra::{Matrix6, Vector6};

use super::chain::Chain;
use super::posture::{MAX_DOF, Posture};
use crate::pose::{Pose, Vector};

/// A solution's tip may miss the target by this much, m.
pub const POSITION_TOLERANCE_M: f64 = 1e-9;
/// A solution's tip may be turned against the target by this much, rad.
pub const ROTATION_TOLERANCE_RAD: f64 = 1e-9;

/// Below this no step is tried: it is rounding, m and rad.
const ROUNDING: f64 = 1e-13;

/// Offset and rotation vector, m and rad, in base axes, that take `from` to `to`.
pub fn pose_error(from: &Pose, to: &Pose) -> (Vector, Vector) {
    let offset = to.translation.vector - from.translation.vector;
    let turn = to.rotation * from.rotation.inverse();
    let (mut w, mut v) = (turn.w, Vector::new(turn.i, turn.j, turn.k));
    if w < 0.0 {
        (w, v) = (-w, -v);
    }
    let sine = v.norm();
    let scale = if sine < 1e-150 { 2.0 } else { 2.0 * sine.atan2(w) / sine };
    (offset, v * scale)
}

pub(super) fn twist(error: &(Vector, Vector)) -> Vector6<f64> {
    let (v, w) = error;
    Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z)
}

/// `Jᵀ (J Jᵀ + λ I)⁻¹ e`, the damped least-squares step; `None` where the matrix is singular.
pub(super) fn damped_step(
    columns: &[Vector6<f64>],
    error: &Vector6<f64>,
    damping: f64,
) -> Option<[f64; MAX_DOF]> {
    let mut gram = Matrix6::from_diagonal_element(damping);
    for column in columns {
        gram.ger(1.0, column, column, 1.0);
    }
    let weights = gram.cholesky()?.solve(error);
    let mut step = [0.0; MAX_DOF];
    for (entry, column) in step.iter_mut().zip(columns) {
        *entry = column.dot(&weights);
    }
    Some(step)
}

/// Newton steps at most; an exact URDF needs none, one that rounds its angles one or two, more only
/// near a singular posture.
const STEPS: usize = 40;

/// An error this large, m and rad, after a step: it led away.
const LOST: f64 = 1e-2;

/// Takes Newton steps and keeps the best posture met; returns its position and rotation error, m
/// and rad.
///
/// Near a singular posture a small error asks for a long step, whose square makes the error larger
/// before it falls; so a step is not refused for not helping at once.
pub(super) fn polish(chain: &Chain, target: &Pose, q: &mut Posture) -> (f64, f64) {
    let mut at = *q;
    let mut error = pose_error(&chain.forward(&at), target);
    let mut best = error;
    // A closed form that is this far off did not reach; a step would be a search.
    if !(size(&error) < 1e-4) {
        return (best.0.norm(), best.1.norm());
    }
    for _ in 0..STEPS {
        if !(ROUNDING..LOST).contains(&size(&error)) {
            break;
        }
        let mut columns = [Vector6::zeros(); MAX_DOF];
        chain.jacobian_into(&at, &mut columns);
        let columns = &columns[..chain.dof()];
        let trace: f64 = columns.iter().map(Vector6::norm_squared).sum();
        let Some(step) = damped_step(columns, &twist(&error), 1e-14 * trace) else { break };
        for (value, change) in at.iter_mut().zip(step) {
            *value += change;
        }
        error = pose_error(&chain.forward(&at), target);
        if size(&error) < size(&best) {
            (*q, best) = (at, error);
        }
    }
    (best.0.norm(), best.1.norm())
}

fn size(error: &(Vector, Vector)) -> f64 {
    error.0.norm().max(error.1.norm())
}
