//! How near a posture is to where the arm loses a direction of motion, and to its limits.

use std::f64::consts::PI;

use nalgebra::Vector6;

use super::arm::{Arm, Solver};
use super::chain::Chain;
use super::condition::{condition, ratio};
use super::posture::{MAX_DOF, Posture};

/// Measures of one posture. `None` where the arm has no such singularity, or is of no known type.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearness {
    /// Angle of the middle wrist joint from where its neighbours line up (0 or π), rad.
    pub wrist_rad: Option<f64>,
    /// Angle of the elbow from straight or folded, rad.
    pub elbow_rad: Option<f64>,
    /// Angle of the second joint of an S-R-S arm from where its neighbours line up, rad.
    pub shoulder_rad: Option<f64>,
    /// Distance of the wrist centre from axis 1, m. For an arm with three parallel axes: of the meeting
    /// point of axes 5 and 6 from the plane through axis 1 that is square to the arm's.
    pub shoulder_m: Option<f64>,
    /// Ratio of greatest to least singular value of the Jacobian, length scale 1 m; ∞ where singular.
    pub condition: f64,
}

/// Measures of a posture.
///
/// Singular where: axes 4 and 6 line up (wrist); the wrist centre lies in line with axes 2 and 3 (elbow); the
/// wrist centre lies on axis 1 (shoulder). An S-R-S arm loses a direction at the straight elbow, and
/// where joints 2 or 6 line up their neighbours while the elbow cannot make up for it: the condition
/// number tells.
pub fn nearness(arm: &Arm, q: &[f64]) -> Nearness {
    let condition = condition_number(&arm.chain, q);
    let none = Nearness {
        wrist_rad: None,
        elbow_rad: None,
        shoulder_rad: None,
        shoulder_m: None,
        condition,
    };
    let six = |(wrist, elbow, shoulder)| Nearness {
        wrist_rad: Some(wrist),
        elbow_rad: Some(elbow),
        shoulder_m: Some(shoulder),
        ..none
    };
    match &arm.solver {
        Solver::Opw(opw) => six(opw.distances(q)),
        Solver::Parallel(parallel) => six(parallel.distances(q)),
        Solver::Srs(srs) => {
            let (wrist, elbow, shoulder, from_axis) = srs.distances(q);
            Nearness { shoulder_rad: Some(shoulder), ..six((wrist, elbow, from_axis)) }
        }
        Solver::Cartesian(_) | Solver::Numeric(_) => none,
    }
}

/// σmax/σmin of the 6×n Jacobian, metres and radians counted alike (length scale 1 m), over the
/// min(6, n) singular values it can have; so for a printer, of its translation block. ∞ where singular, 1
/// for a chain without joints.
pub fn condition_number(chain: &Chain, q: &[f64]) -> f64 {
    let dof = chain.dof();
    if dof > MAX_DOF {
        let sigma = chain.jacobian(q).singular_values();
        return ratio(sigma.max(), sigma.min());
    }
    let mut columns = [Vector6::zeros(); MAX_DOF];
    chain.jacobian_into(q, &mut columns);
    condition(&columns[..dof])
}

/// Distance of every joint from the nearer of its limits, rad or m; negative outside, ∞ without limits.
pub fn limit_margins(chain: &Chain, q: &[f64]) -> Posture {
    let mut margins = Posture::zeros(chain.dof());
    for ((margin, axis), value) in margins.iter_mut().zip(chain.axes()).zip(q) {
        *margin = (value - axis.lower).min(axis.upper - value);
    }
    margins
}

/// Angle from the nearest multiple of π, in [0, π/2].
pub(super) fn from_line(angle: f64) -> f64 {
    let turned = angle.rem_euclid(PI);
    turned.min(PI - turned)
}
