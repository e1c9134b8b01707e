//! A chain with the solver that fits it, and the one entry to inverse kinematics.

use super::branch::Branch;
use super::cartesian::Cartesian;
use super::chain::Chain;
use super::gate::Gate;
use super::numeric::Numeric;
use super::opw::Opw;
use super::parallel::Parallel;
use super::planar::Play;
use super::posture::Posture;
use super::srs::Srs;
use crate::pose::{Pose, is_finite};

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
    /// The tip is no further from the target than this, at most 1e-9 m. Measured by forward kinematics:
    /// of the chain, or where the closed form is the chain to rounding (and leaves less than 1e-12), of
    /// the closed form, with the greatest difference there can be between the two added.
    pub position_error_m: f64,
    /// The tip is turned against the target by no more than this, measured likewise; at most 1e-9 rad,
    /// but for a [`Solver::Cartesian`], which cannot turn: there it says whether the orientation fits.
    pub rotation_error_rad: f64,
}

/// Whether a list of solutions is all there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coverage {
    /// All branches (of seven-joint arms: at the elbow angle asked for), all full-turn copies within
    /// limits. At a singular pose one posture stands for the endless ones of its branch. An arm whose
    /// URDF rounds its angles is solved by polishing a closed form: it may miss a posture where two
    /// singularities meet (condition number above 1e7).
    Complete,
    /// What a search found.
    Sampled,
}

impl Arm {
    /// All postures within limits that put the tip on `target` (tip in base), into `out`, which is
    /// emptied first. Nothing else is allocated. Each solution is checked by forward kinematics.
    pub fn inverse(&self, target: &Pose, options: &IkOptions, out: &mut Vec<Solution>) -> Coverage {
        out.clear();
        if !is_finite(target) {
            return self.coverage();
        }
        let exact = match &self.solver {
            Solver::Opw(arm) => arm.exact(),
            Solver::Parallel(arm) => arm.exact(),
            Solver::Srs(arm) => arm.exact(),
            Solver::Cartesian(_) | Solver::Numeric(_) => false,
        };
        let play = if exact { Play::EXACT } else { Play::ROUNDED };
        // What a search finds may always be one of those it found before.
        let close = matches!(self.solver, Solver::Numeric(_));
        let mut gate = Gate { chain: &self.chain, target, options, exact, play, close, out };
        self.candidates(&mut gate);
        if gate.close && !exact && !close {
            gate.play = Play::SPREAD;
            self.candidates(&mut gate);
            // Polishing may have taken a candidate across to the root next to it.
            out.iter_mut().for_each(|found| found.branch = self.branch(&found.q));
        }
        self.coverage()
    }

    /// The same arm whose turning joints have no stops: tells out of reach from past a stop.
    #[must_use]
    pub fn without_limits(&self) -> Self {
        Self { chain: self.chain.without_stops(), solver: self.solver.clone() }
    }

    fn candidates(&self, gate: &mut Gate) {
        match &self.solver {
            Solver::Opw(arm) => arm.candidates(gate),
            Solver::Parallel(arm) => arm.candidates(gate),
            Solver::Srs(arm) => arm.candidates(gate),
            Solver::Cartesian(printer) => gate.keep_place(printer.solve(gate.target)),
            Solver::Numeric(search) => search.candidates(gate),
        }
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
}
