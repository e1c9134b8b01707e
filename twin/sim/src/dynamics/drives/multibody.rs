//! The only place where rapier3d's `f32` types meet ours.

use nalgebra::Matrix3;
use rapier3d::math::{
    Matrix as RapierMatrix, Pose as RapierPose, Rotation, Vector as RapierVector,
};
use rapier3d::prelude::{
    GenericJointBuilder, JointAxesMask, MassProperties, MultibodyJointHandle, PhysicsWorld,
    RigidBodyBuilder,
};

use super::super::body::Body;
use super::super::model::{JointVector, Model, ModelJoint, State};
use super::{DriveFault, Gains};
use crate::kinematics::JointKind;
use crate::pose::{Pose, Vector};

/// An arm in rapier's reduced coordinates, which count from the posture it was made in.
pub(in super::super) struct Multibody {
    world: PhysicsWorld,
    joints: Vec<MultibodyJointHandle>,
    kinds: Vec<JointKind>,
    start: JointVector,
}

impl Multibody {
    /// An arm with free joints at `q` with speeds `qd`, under the model's gravity.
    pub(in super::super) fn new(
        model: &Model,
        q: &[f64],
        qd: &[f64],
        step_s: f64,
    ) -> Result<Self, DriveFault> {
        let mut world = PhysicsWorld::new();
        world.gravity = vector(model.gravity);
        world.integration_parameters.dt = step_s as f32;
        world.integration_parameters.num_solver_iterations = 1;
        world.integration_parameters.max_ccd_substeps = 0;
        let mut parent = world.insert_body(RigidBodyBuilder::fixed());
        let (mut joints, mut kinds) = (Vec::new(), Vec::new());
        for (index, joint) in model.joints.iter().enumerate() {
            let own = joint.entry == index && joint.multiplier == 1.0 && joint.offset == 0.0;
            if !own || model.joints.len() != model.dof {
                return Err(DriveFault::Followers);
            }
            if !(joint.body.mass_kg > 0.0) {
                return Err(DriveFault::Massless { joint: index });
            }
            let link = RigidBodyBuilder::dynamic()
                .can_sleep(false)
                .additional_mass_properties(mass(&joint.body));
            let link = world.insert_body(link);
            world.bodies[link].recompute_mass_properties_from_colliders(&world.colliders);
            let made = world.insert_multibody_joint(parent, link, frames(joint, q[index]));
            joints.push(made.ok_or(DriveFault::Followers)?);
            kinds.push(joint.kind);
            parent = link;
        }
        let mut arm = Self { world, joints, kinds, start: JointVector::new(q) };
        arm.release(qd, &model.rotors);
        Ok(arm)
    }

    /// Takes rapier's damping out, puts the rotors in and sets the speeds.
    fn release(&mut self, qd: &[f64], rotors: &[f64]) {
        let Some(&first) = self.joints.first() else { return };
        let Some((arm, _)) = self.world.multibody_joints.get_mut(first) else { return };
        // The root turns from free to fixed here, before anything is set by its place in the
        // vectors.
        arm.forward_kinematics(&self.world.bodies, true);
        arm.damping_mut().fill(0.0);
        for (theirs, &ours) in arm.armature_mut().iter_mut().zip(rotors) {
            *theirs = ours as f32;
        }
        for (speed, &wanted) in arm.generalized_velocity_mut().iter_mut().zip(qd) {
            *speed = wanted as f32;
        }
    }

    /// Springs and dampers about the wanted state. Spring, damper and feed-forward are one implicit
    /// spring of rapier's with the rest position `q* + (d q̇* + τ_ff) / k`, and its damping `d`;
    /// exact to the first order of its step.
    pub(in super::super) fn set_drives(
        &mut self,
        gains: &Gains,
        wanted: &State,
        ahead: &JointVector,
    ) {
        for (index, &handle) in self.joints.iter().enumerate() {
            let (k, d) = (gains.stiffness[index], gains.damping[index]);
            let rest =
                wanted.q[index] - self.start[index] + (d * wanted.qd[index] + ahead[index]) / k;
            let Some((arm, id)) = self.world.multibody_joints.get_mut(handle) else { continue };
            let Some(link) = arm.link_mut(id) else { continue };
            link.joint.set_spring(coordinate(self.kinds[index]), k as f32, rest as f32);
            let entry = link.assembly_id();
            arm.damping_mut()[entry] = d as f32;
        }
    }

    /// One time step.
    pub(in super::super) fn step(&mut self) {
        self.world.step();
    }

    /// Joint values, rad or m.
    pub(in super::super) fn q(&self) -> JointVector {
        let mut q = self.start;
        for (index, &handle) in self.joints.iter().enumerate() {
            let link = self.world.multibody_joints.get(handle);
            if let Some(link) = link.and_then(|(arm, id)| arm.link(id)) {
                q[index] += f64::from(link.joint.coords()[coordinate(self.kinds[index])]);
            }
        }
        q
    }

    /// Joint speeds, rad/s or m/s.
    pub(in super::super) fn qd(&self) -> JointVector {
        let mut qd = JointVector::zeros(self.start.len());
        let arm = self.joints.first().and_then(|&first| self.world.multibody_joints.get(first));
        if let Some((arm, _)) = arm {
            for (speed, &theirs) in qd.iter_mut().zip(arm.generalized_velocity().iter()) {
                *speed = f64::from(theirs);
            }
        }
        qd
    }
}

/// Which of rapier's six joint coordinates moves: its x.
fn coordinate(kind: JointKind) -> usize {
    match kind {
        JointKind::Revolute => 3,
        JointKind::Prismatic => 0,
    }
}

/// The joint with its coordinate zero at the value `q`.
fn frames(joint: &ModelJoint, q: f64) -> GenericJointBuilder {
    let locked = match joint.kind {
        JointKind::Revolute => JointAxesMask::LOCKED_REVOLUTE_AXES,
        JointKind::Prismatic => JointAxesMask::LOCKED_PRISMATIC_AXES,
    };
    let link_from_rapier =
        crate::pose::from_z_axis(crate::pose::Point::origin(), joint.axis, Vector::x())
            * Pose::rotation(Vector::y() * -std::f64::consts::FRAC_PI_2);
    GenericJointBuilder::new(locked)
        .contacts_enabled(false)
        .local_frame1(pose(&(joint.pose(q) * link_from_rapier)))
        .local_frame2(pose(&link_from_rapier))
}

fn mass(body: &Body) -> MassProperties {
    let inertia: Matrix3<f32> = body.inertia.map(|x| x as f32);
    MassProperties::with_inertia_matrix(
        vector(body.centre),
        body.mass_kg as f32,
        RapierMatrix::from_cols_slice(inertia.as_slice()),
    )
}

fn vector(ours: Vector) -> RapierVector {
    RapierVector::new(ours.x as f32, ours.y as f32, ours.z as f32)
}

fn pose(ours: &Pose) -> RapierPose {
    let turn = ours.rotation.coords.map(|x| x as f32);
    let rotation = Rotation::from_xyzw(turn.x, turn.y, turn.z, turn.w).normalize();
    RapierPose::from_parts(vector(ours.translation.vector), rotation)
}
