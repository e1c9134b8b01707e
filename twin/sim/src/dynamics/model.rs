//! A chain with masses.

use nalgebra::Matrix3;
use thiserror::Error;

use super::body::Body;
use crate::kinematics::{Chain, ChainJoint, JointKind, MAX_DOF, Posture};
use crate::pose::{Pose, Vector};

/// A value for every entry of `q`, without heap; reads as a slice.
pub type JointVector = Posture;

/// Most moving joints of a model, those that follow others included.
pub const MOST_JOINTS: usize = 16;

/// Where an arm is and how it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Joint values, rad or m.
    pub q: JointVector,
    /// Joint speeds, rad/s or m/s.
    pub qd: JointVector,
    /// Joint accelerations, rad/s² or m/s².
    pub qdd: JointVector,
}

impl State {
    /// Standing still.
    pub fn at_rest(q: &[f64]) -> Self {
        let still = JointVector::zeros(q.len());
        Self { q: JointVector::new(q), qd: still, qdd: still }
    }
}

/// Why there is no model.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ModelFault {
    /// One body per moving joint is needed.
    #[error("the chain has {joints} moving joints but {bodies} bodies are given")]
    Bodies {
        /// Moving joints.
        joints: usize,
        /// Bodies given.
        bodies: usize,
    },
    /// More than [`MOST_JOINTS`] joints or more than [`MAX_DOF`] free ones.
    #[error("{joints} moving joints, {dof} of them free; at most {MOST_JOINTS} and {MAX_DOF}")]
    TooManyJoints {
        /// Moving joints.
        joints: usize,
        /// Free ones.
        dof: usize,
    },
    /// A body with a mass that is none, or a number that is not finite.
    #[error("the body on joint `{joint}` has no usable mass")]
    BadBody {
        /// Name of the joint.
        joint: String,
    },
}

/// A chain with a body on every joint, in a field of gravity.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    pub(super) joints: Vec<ModelJoint>,
    pub(super) dof: usize,
    pub(super) gravity: Vector,
    pub(super) last_from_tip: Pose,
    /// Inertia of every drive's rotor and gear, seen at its joint.
    pub(super) rotors: JointVector,
}

/// One joint and what it carries.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ModelJoint {
    pub(super) kind: JointKind,
    pub(super) axis: Vector,
    /// Joint axes at value zero in the previous link.
    pub(super) parent_from_joint: Pose,
    /// In axes of the child link.
    pub(super) body: Body,
    /// Entry of `q` that moves it: `value = multiplier · q[entry] + offset`.
    pub(super) entry: usize,
    pub(super) multiplier: f64,
    pub(super) offset: f64,
    /// `F`, `F K`, `F K²` of Rodrigues' formula, with `F` the fixed rotation, `K` the axis as a
    /// cross product: the rotation is `F + sin q · F K + (1 − cos q) · F K²`.
    turns: [Matrix3<f64>; 3],
}

impl Model {
    /// A model of `chain` with one body per entry of [`Chain::joints`], in the axes of its child
    /// link, and gravity in base axes, m/s².
    ///
    /// # Errors
    /// Bodies that do not fit the chain or are none.
    pub fn new(chain: &Chain, bodies: &[Body], gravity: Vector) -> Result<Self, ModelFault> {
        let (n, dof) = (chain.joints().len(), chain.dof());
        if bodies.len() != n {
            return Err(ModelFault::Bodies { joints: n, bodies: bodies.len() });
        }
        if n > MOST_JOINTS || dof > MAX_DOF {
            return Err(ModelFault::TooManyJoints { joints: n, dof });
        }
        let mut joints = Vec::with_capacity(n);
        for (index, (joint, body)) in chain.joints().iter().zip(bodies).enumerate() {
            let finite = body.centre.iter().chain(body.inertia.iter()).all(|x| x.is_finite());
            if !(body.mass_kg >= 0.0 && body.mass_kg.is_finite() && finite) {
                return Err(ModelFault::BadBody { joint: joint.name.clone() });
            }
            joints.push(ModelJoint::new(chain, index, joint, *body));
        }
        let rotors = JointVector::zeros(dof);
        Ok(Self { joints, dof, gravity, last_from_tip: *chain.last_from_tip(), rotors })
    }

    /// The same arm carrying `payload`, given in tip axes.
    #[must_use]
    pub fn with_payload(&self, payload: &Body) -> Self {
        let mut loaded = self.clone();
        if let Some(last) = loaded.joints.last_mut() {
            last.body = last.body.with(&payload.seen_from(&self.last_from_tip));
        }
        loaded
    }

    /// The same arm under another gravity, base axes, m/s².
    #[must_use]
    pub fn with_gravity(&self, gravity: Vector) -> Self {
        Self { gravity, ..self.clone() }
    }

    /// The same arm with the inertia of rotors and gears seen at their joints (rotor inertia times gear
    /// ratio squared), kg m² or kg, one per entry of `q`; missing and unusable ones count as zero.
    ///
    /// Law: adds `J q̈` to the torque. Leaves out that a spinning rotor resists being tilted,
    /// as usual at high gear ratios (Featherstone 2008, 9.6).
    #[must_use]
    pub fn with_rotors(&self, inertia: &[f64]) -> Self {
        let mut geared = self.clone();
        for (rotor, &inertia) in geared.rotors.iter_mut().zip(inertia) {
            *rotor = if inertia > 0.0 && inertia.is_finite() { inertia } else { 0.0 };
        }
        geared
    }

    /// Entries of `q`.
    pub fn dof(&self) -> usize {
        self.dof
    }

    /// Gravity in base axes, m/s².
    pub fn gravity(&self) -> Vector {
        self.gravity
    }

    /// What moves, payload included, kg.
    pub fn mass_kg(&self) -> f64 {
        self.joints.iter().map(|joint| joint.body.mass_kg).sum()
    }

    /// Tip in base; the same as [`Chain::forward`].
    pub fn tip(&self, q: &[f64]) -> Pose {
        let mut pose = Pose::identity();
        for joint in &self.joints {
            pose *= joint.pose(joint.value(q));
        }
        pose * self.last_from_tip
    }
}

impl ModelJoint {
    fn new(chain: &Chain, index: usize, joint: &ChainJoint, body: Body) -> Self {
        let (entry, multiplier, offset) = drive(chain, index);
        let fixed = joint.parent_from_joint.rotation.to_rotation_matrix().into_inner();
        let cross = joint.axis.cross_matrix();
        let turns = [fixed, fixed * cross, fixed * cross * cross];
        let parent_from_joint = joint.parent_from_joint;
        let (kind, axis) = (joint.kind, joint.axis);
        Self { kind, axis, parent_from_joint, body, entry, multiplier, offset, turns }
    }

    /// Value of the joint.
    pub(super) fn value(&self, q: &[f64]) -> f64 {
        self.multiplier * q[self.entry] + self.offset
    }

    /// Its speed or acceleration.
    pub(super) fn rate(&self, qd: &[f64]) -> f64 {
        self.multiplier * qd[self.entry]
    }

    /// Child link in the parent link: rotation and origin.
    pub(super) fn placed(&self, value: f64) -> (Matrix3<f64>, Vector) {
        let [fixed, once, twice] = &self.turns;
        let origin = self.parent_from_joint.translation.vector;
        match self.kind {
            JointKind::Revolute => {
                let (sin, cos) = value.sin_cos();
                (fixed + once * sin + twice * (1.0 - cos), origin)
            }
            JointKind::Prismatic => (*fixed, origin + fixed * self.axis * value),
        }
    }

    /// The same as a pose.
    pub(super) fn pose(&self, value: f64) -> Pose {
        let motion = match self.kind {
            JointKind::Revolute => Pose::rotation(self.axis * value),
            JointKind::Prismatic => {
                let along = self.axis * value;
                Pose::translation(along.x, along.y, along.z)
            }
        };
        self.parent_from_joint * motion
    }
}

/// Entry of `q`, multiplier and offset of a joint. [`Chain::new`] has refused masters that are
/// none.
fn drive(chain: &Chain, index: usize) -> (usize, f64, f64) {
    let (mut at, mut multiplier, mut offset) = (index, 1.0, 0.0);
    while let Some(mimic) = chain.joints()[at].mimic {
        offset += multiplier * mimic.offset;
        multiplier *= mimic.multiplier;
        at = mimic.master;
    }
    let entry = chain.axes().iter().position(|axis| axis.joint == at);
    (entry.expect("a joint that moves by itself has an entry"), multiplier, offset)
}
