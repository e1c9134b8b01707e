//! Inverse dynamics: the torques that a motion takes.

use nalgebra::Matrix3;

use super::model::{JointVector, MOST_JOINTS, Model, State};
use crate::kinematics::JointKind;
use crate::pose::Vector;

/// Force and moment on the tip from outside, base axes; the moment is about the tip's origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wrench {
    /// Force, N.
    pub force: Vector,
    /// Moment, N m.
    pub moment: Vector,
}

/// What the way out leaves behind for the way back, in link axes.
#[derive(Clone, Copy)]
struct Link {
    rotation: Matrix3<f64>,
    origin: Vector,
    force: Vector,
    moment: Vector,
}

impl Model {
    /// Torques (forces of sliding joints) that make the arm move as `state` says, N m or N.
    ///
    /// Law: recursive Newton–Euler (Luh, Walker, Paul 1980; Featherstone 2008, table 5.1).
    /// Outwards, in link axes, with `p` the link's origin in its parent and `R` its rotation there,
    /// `ω = Rᵀω_p + a q̇`, `ω̇ = Rᵀω̇_p + Rᵀω_p × a q̇ + a q̈`, `v̇ = Rᵀ(v̇_p + ω̇_p × p + ω_p ×
    /// (ω_p × p))`; a sliding joint adds `2 ω × a q̇ + a q̈` to `v̇` instead. Gravity is an
    /// acceleration `−g` of the base. Inwards `f = m v̇_c + Σ f_child`, `n = I ω̇ + ω × I ω + c × m
    /// v̇_c + Σ (n_child + p × f_child)`, `τ = a·n` or `a·f`. A joint that follows another adds its
    /// torque times its multiplier to its master's.
    pub fn torques(&self, state: &State) -> JointVector {
        self.recursion(&state.q, &state.qd, &state.qdd, self.gravity, None)
    }

    /// The same with a force on the tip.
    pub fn torques_against(&self, state: &State, tip: &Wrench) -> JointVector {
        self.recursion(&state.q, &state.qd, &state.qdd, self.gravity, Some(tip))
    }

    /// Torques that hold the arm still.
    pub fn holding_torques(&self, q: &[f64]) -> JointVector {
        let still = JointVector::zeros(self.dof);
        self.recursion(q, &still, &still, self.gravity, None)
    }

    pub(super) fn recursion(
        &self,
        q: &[f64],
        qd: &[f64],
        qdd: &[f64],
        gravity: Vector,
        tip: Option<&Wrench>,
    ) -> JointVector {
        let zero = Vector::zeros();
        let blank = Link { rotation: Matrix3::identity(), origin: zero, force: zero, moment: zero };
        let mut links = [blank; MOST_JOINTS];
        let (mut omega, mut alpha, mut accel) = (zero, zero, -gravity);
        for (joint, link) in self.joints.iter().zip(&mut links) {
            let (speed, rate) = (joint.rate(qd), joint.rate(qdd));
            let (rotation, origin) = joint.placed(joint.value(q));
            accel += alpha.cross(&origin) + omega.cross(&omega.cross(&origin));
            accel = rotation.tr_mul(&accel);
            omega = rotation.tr_mul(&omega);
            alpha = rotation.tr_mul(&alpha);
            match joint.kind {
                JointKind::Revolute => {
                    alpha += joint.axis * rate + omega.cross(&joint.axis) * speed;
                    omega += joint.axis * speed;
                }
                JointKind::Prismatic => {
                    accel += joint.axis * rate + omega.cross(&joint.axis) * (2.0 * speed);
                }
            }
            let body = &joint.body;
            let centre = &body.centre;
            let of_centre = accel + alpha.cross(centre) + omega.cross(&omega.cross(centre));
            let force = of_centre * body.mass_kg;
            let spin = body.inertia * alpha + omega.cross(&(body.inertia * omega));
            *link = Link { rotation, origin, force, moment: spin + centre.cross(&force) };
        }
        let links = &links[..self.joints.len()];
        let (force, moment) = tip.map_or((zero, zero), |tip| self.resisted(links, tip));
        let mut torques = self.inwards(links, force, moment);
        for (torque, (rotor, rate)) in torques.iter_mut().zip(self.rotors.iter().zip(qdd)) {
            *torque += rotor * rate;
        }
        torques
    }

    /// What the last link must hold against a force on the tip, about its origin and in its axes.
    fn resisted(&self, links: &[Link], tip: &Wrench) -> (Vector, Vector) {
        let base_from_last =
            links.iter().fold(Matrix3::identity(), |outer, link| outer * link.rotation);
        let force = -base_from_last.tr_mul(&tip.force);
        let lever = self.last_from_tip.translation.vector;
        (force, lever.cross(&force) - base_from_last.tr_mul(&tip.moment))
    }

    fn inwards(&self, links: &[Link], mut force: Vector, mut moment: Vector) -> JointVector {
        let mut torques = JointVector::zeros(self.dof);
        for (joint, link) in self.joints.iter().zip(links).rev() {
            force += link.force;
            moment += link.moment;
            let along = match joint.kind {
                JointKind::Revolute => joint.axis.dot(&moment),
                JointKind::Prismatic => joint.axis.dot(&force),
            };
            torques[joint.entry] += joint.multiplier * along;
            force = link.rotation * force;
            moment = link.rotation * moment + link.origin.cross(&force);
        }
        torques
    }
}
