//! A chain with the solver that fits it, and the one entry to inverse kinematics.

use super::branch::Branch;
use super::cartesian::Cartesian;
use super::chain::{Chain, is_finite};
use super::numeric::Numeric;
use super::opw::Opw;
use super::parallel::Parallel;
use super::polish::{POSITION_TOLERANCE_M, ROTATION_TOLERANCE_RAD, polish, pose_error};
use super::posture::{Posture, wraps};
use super::srs::Srs;
use crate::pose::Pose;

/// How an arm's inverse kinematics is solved.
#[derive(Debug, Clone, PartialEq)]
pub enum Solver {
    /// Ortho-parallel base with spherical wrist, closed form.
    Opw(Opw),
    /// Three parallel axes with offset wrist, closed form.
    Parallel(Parallel),
    /// Seven joints, spherical shoulder and wrist, closed form at a given elbow angle.
    Srs(Srs),
    /// Three sliding joints, closed form; only the place of the tip is asked for.
    Cartesian(Cartesian),
    /// Anything else.
    Numeric(Numeric),
}

/// A chain and its solver; made by [`super::recognise`].
#[derive(Debug, Clone, PartialEq)]
pub struct Arm {
    /// The chain.
    pub chain: Chain,
    /// What solves it.
    pub solver: Solver,
}

/// What to ask of inverse kinematics beside the pose.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct IkOptions<'a> {
    /// Chooses among endless answers: joints that are free at a singular pose take their value from
    /// here, joints without limits the turn nearest to it, and a numeric search starts here. Joints at
    /// zero stand in for a missing one.
    pub seed: Option<&'a [f64]>,
    /// Elbow angle of seven-joint arms ([`Srs::elbow_angle`]), rad.
    pub elbow_rad: f64,
}

/// One posture that puts the tip on the target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solution {
    /// Joint vector, within limits.
    pub q: Posture,
    /// Which posture it is.
    pub branch: Branch,
    /// Distance of the tip from the target by forward kinematics, at most 1e-9 m.
    pub position_error_m: f64,
    /// Angle between tip and target by forward kinematics; at most 1e-9 rad, but for a
    /// [`Solver::Cartesian`], which cannot turn: there it says whether the orientation fits.
    pub rotation_error_rad: f64,
}

/// Whether a list of solutions is all there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coverage {
    /// All branches (of seven-joint arms: at the elbow angle asked for), all full-turn copies within
    /// limits. At a singular pose one posture stands for the endless ones of its branch.
    Complete,
    /// What a search found.
    Sampled,
}

/// Two solutions nearer than this in every joint are one, rad or m.
const SAME: f64 = 1e-7;
/// The same for searched solutions, which stop at different errors.
const SAME_SEARCHED: f64 = 1e-6;

impl Arm {
    /// All postures within limits that put the tip on `target` (tip in base), into `out`, which is
    /// emptied first. Nothing else is allocated. Each solution is checked by forward kinematics.
    pub fn inverse(&self, target: &Pose, options: &IkOptions, out: &mut Vec<Solution>) -> Coverage {
        out.clear();
        if !is_finite(target) {
            return self.coverage();
        }
        let mut keep = |q, branch| self.keep(target, options, q, branch, out);
        match &self.solver {
            Solver::Opw(arm) => arm.candidates(target, options.seed, &mut keep),
            Solver::Parallel(arm) => arm.candidates(target, options.seed, &mut keep),
            Solver::Srs(arm) => {
                arm.candidates(target, options.elbow_rad, options.seed, &mut keep);
            }
            Solver::Cartesian(printer) => printer.candidates(target, &mut keep),
            Solver::Numeric(search) => {
                let branch = Branch::default();
                search.candidates(&self.chain, target, options.seed, &mut |q| keep(q, branch));
            }
        }
        self.coverage()
    }

    /// Whether this arm's solutions are all there are.
    pub fn coverage(&self) -> Coverage {
        match self.solver {
            Solver::Numeric(_) => Coverage::Sampled,
            _ => Coverage::Complete,
        }
    }

    /// Branch of a posture; no bits for arms without named branches.
    pub fn branch(&self, q: &[f64]) -> Branch {
        match &self.solver {
            Solver::Opw(arm) => arm.branch(q),
            Solver::Parallel(arm) => arm.branch(q),
            Solver::Srs(arm) => arm.branch(q),
            Solver::Cartesian(_) | Solver::Numeric(_) => Branch::default(),
        }
    }

    /// Elbow angle of a posture of a seven-joint arm, rad.
    pub fn elbow_angle(&self, q: &[f64]) -> Option<f64> {
        match &self.solver {
            Solver::Srs(arm) => Some(arm.elbow_angle(q)),
            _ => None,
        }
    }

    /// Checks a candidate, and adds it and its full-turn copies.
    fn keep(
        &self,
        target: &Pose,
        options: &IkOptions,
        mut q: Posture,
        branch: Branch,
        out: &mut Vec<Solution>,
    ) {
        let turns = !matches!(self.solver, Solver::Cartesian(_));
        let (position_error_m, rotation_error_rad) = if turns {
            polish(&self.chain, target, &mut q)
        } else {
            let (offset, rotation) = pose_error(&self.chain.forward(&q), target);
            (offset.norm(), rotation.norm())
        };
        let rotation_fits = rotation_error_rad <= ROTATION_TOLERANCE_RAD;
        if !(position_error_m <= POSITION_TOLERANCE_M && (rotation_fits || !turns)) {
            return;
        }
        let searched = matches!(self.solver, Solver::Numeric(_));
        let same = if searched { SAME_SEARCHED } else { SAME };
        wraps(&self.chain, &q, options.seed, |q| {
            if out.iter().all(|known| known.q.distance(&q) > same) {
                out.push(Solution { q, branch, position_error_m, rotation_error_rad });
            }
        });
    }
}
