//! The joints between a base link and a tip link, with every fixed transform folded in.

use nalgebra::{Quaternion, UnitQuaternion};
use thiserror::Error;

use crate::pose::{Pose, Vector, is_finite};

/// How a joint moves along or about its axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// Turns about its axis, rad.
    Revolute,
    /// Slides along its axis, m.
    Prismatic,
}

/// A joint that follows another: `value = multiplier * master + offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mimic {
    /// Index of the joint it follows in the same chain; that one may itself follow another.
    pub master: usize,
    /// Factor on the master's value.
    pub multiplier: f64,
    /// Added to it, rad or m.
    pub offset: f64,
}

/// One moving joint of a chain.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainJoint {
    /// Name as in the URDF.
    pub name: String,
    /// Turning or sliding.
    pub kind: JointKind,
    /// The joint's axes at value zero, in those of the previous moving joint's child link (of the
    /// base for the first).
    pub parent_from_joint: Pose,
    /// Axis in the joint's own axes; [`Chain::new`] makes it a unit vector.
    pub axis: Vector,
    /// Lower limit, rad or m; −∞ for a continuous joint.
    pub lower: f64,
    /// Upper limit, rad or m; +∞ for a continuous joint.
    pub upper: f64,
    /// Greatest speed, rad/s or m/s.
    pub velocity: f64,
    /// Greatest torque or force, N·m or N, where known.
    pub effort: Option<f64>,
    /// Set where the joint follows another and so has no entry in `q`.
    pub mimic: Option<Mimic>,
}

/// One entry of the joint vector `q`, with what its own joint and all that follow it allow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChainAxis {
    /// Index of its joint in [`Chain::joints`].
    pub joint: usize,
    /// Lower limit, rad or m.
    pub lower: f64,
    /// Upper limit, rad or m.
    pub upper: f64,
    /// Greatest speed, rad/s or m/s.
    pub velocity: f64,
    /// Whether a full turn leaves the arm's pose as it was.
    pub periodic: bool,
}

/// Why no chain can be made.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ChainFault {
    /// A link that the robot does not have.
    #[error("the robot has no link `{link}`")]
    UnknownLink {
        /// The name asked for.
        link: String,
    },
    /// A joint that the robot does not have.
    #[error("there is no moving joint `{joint}`")]
    UnknownJoint {
        /// The name asked for.
        joint: String,
    },
    /// Base and tip do not hang on one tree.
    #[error("no path of joints leads from `{base}` to `{tip}`")]
    NotConnected {
        /// Base link.
        base: String,
        /// Tip link.
        tip: String,
    },
    /// Mimic joints that follow each other, or nothing.
    #[error("mimic joint `{joint}` follows no joint that moves by itself")]
    MimicLoop {
        /// The joint at fault.
        joint: String,
    },
    /// A value was given for a joint that follows another.
    #[error("joint `{joint}` follows `{master}`; give a value for that one")]
    MimicHeld {
        /// The joint named.
        joint: String,
        /// The joint it follows.
        master: String,
    },
    /// Not a number, or an axis of length zero.
    #[error("joint `{joint}` has an origin or axis that is no direction or not a finite number")]
    BadGeometry {
        /// The joint at fault.
        joint: String,
    },
    /// More joints than inverse kinematics takes.
    #[error("the chain has {dof} free joints, inverse kinematics takes at most {most}; hold some")]
    TooManyJoints {
        /// Free joints.
        dof: usize,
        /// The most it takes.
        most: usize,
    },
}

/// Which entry of `q` drives a joint, and how.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Drive {
    pub(super) axis: usize,
    pub(super) multiplier: f64,
    pub(super) offset: f64,
}

impl Drive {
    pub(super) fn value(&self, q: &[f64]) -> f64 {
        self.multiplier * q[self.axis] + self.offset
    }
}

/// Moving joints from base to tip.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    joints: Vec<ChainJoint>,
    last_from_tip: Pose,
    pub(super) drives: Vec<Drive>,
    axes: Vec<ChainAxis>,
}

impl Chain {
    /// Chain of joints in order from base to tip; `last_from_tip` is the tip in the last moving link.
    pub fn new(mut joints: Vec<ChainJoint>, last_from_tip: Pose) -> Result<Self, ChainFault> {
        for joint in &mut joints {
            let length = joint.axis.norm();
            if !(length > 1e-9 && length.is_finite() && is_finite(&joint.parent_from_joint)) {
                return Err(ChainFault::BadGeometry { joint: joint.name.clone() });
            }
            joint.axis /= length;
        }
        if !is_finite(&last_from_tip) {
            return Err(ChainFault::BadGeometry { joint: "tip".to_owned() });
        }
        let (drives, axes) = drives_and_axes(&joints)?;
        Ok(Self { joints, last_from_tip, drives, axes })
    }

    /// Number of entries of `q`.
    pub fn dof(&self) -> usize {
        self.axes.len()
    }

    /// All moving joints, those that follow others included.
    pub fn joints(&self) -> &[ChainJoint] {
        &self.joints
    }

    /// The entries of `q` with their limits.
    pub fn axes(&self) -> &[ChainAxis] {
        &self.axes
    }

    /// Name of the joint of one entry of `q`.
    pub fn axis_name(&self, axis: usize) -> &str {
        &self.joints[self.axes[axis].joint].name
    }

    /// Tip in the last moving link.
    pub fn last_from_tip(&self) -> &Pose {
        &self.last_from_tip
    }

    /// The same chain with another tip, `tip_from_new` in axes of the old.
    #[must_use]
    pub fn with_tip(&self, tip_from_new: &Pose) -> Self {
        Self { last_from_tip: self.last_from_tip * tip_from_new, ..self.clone() }
    }

    /// The same chain seen from another base: `new_from_base` is the old base in the new.
    #[must_use]
    pub fn with_base(&self, new_from_base: &Pose) -> Self {
        let mut moved = self.clone();
        match moved.joints.first_mut() {
            Some(first) => first.parent_from_joint = new_from_base * first.parent_from_joint,
            None => moved.last_from_tip = new_from_base * moved.last_from_tip,
        }
        moved
    }

    /// The same chain whose turning joints have no stops.
    #[must_use]
    pub fn without_stops(&self) -> Self {
        let mut open = self.clone();
        for axis in open.axes.iter_mut().filter(|axis| axis.periodic) {
            (axis.lower, axis.upper) = (f64::NEG_INFINITY, f64::INFINITY);
        }
        open
    }

    /// Tip in base. Law: product of `parent_from_joint · motion(q)` along the chain; error of a few
    /// 1e-16 m per metre of arm. `q` has [`Chain::dof`] entries, rad or m.
    pub fn forward(&self, q: &[f64]) -> Pose {
        let mut pose = Pose::identity();
        for (joint, drive) in self.joints.iter().zip(&self.drives) {
            pose *= joint.parent_from_joint;
            advance(&mut pose, joint, drive.value(q));
        }
        pose * self.last_from_tip
    }

    /// Pose in base of the child link of every entry of [`Chain::joints`], into `out`.
    pub fn link_poses(&self, q: &[f64], out: &mut Vec<Pose>) {
        out.clear();
        let mut pose = Pose::identity();
        for (joint, drive) in self.joints.iter().zip(&self.drives) {
            pose *= joint.parent_from_joint;
            advance(&mut pose, joint, drive.value(q));
            out.push(pose);
        }
    }
}

/// Moves `pose` from the joint's axes at zero to its child link.
pub(super) fn advance(pose: &mut Pose, joint: &ChainJoint, value: f64) {
    match joint.kind {
        JointKind::Revolute => {
            let (sin, cos) = (0.5 * value).sin_cos();
            pose.rotation *=
                UnitQuaternion::new_unchecked(Quaternion::from_parts(cos, joint.axis * sin));
        }
        JointKind::Prismatic => {
            pose.translation.vector += pose.rotation * (joint.axis * value);
        }
    }
}

fn drives_and_axes(joints: &[ChainJoint]) -> Result<(Vec<Drive>, Vec<ChainAxis>), ChainFault> {
    let mut axes = Vec::new();
    let mut axis_of = vec![usize::MAX; joints.len()];
    for (index, joint) in joints.iter().enumerate() {
        if joint.mimic.is_none() {
            axis_of[index] = axes.len();
            axes.push(ChainAxis {
                joint: index,
                lower: joint.lower,
                upper: joint.upper,
                velocity: joint.velocity,
                periodic: joint.kind == JointKind::Revolute,
            });
        }
    }
    let mut drives = Vec::with_capacity(joints.len());
    for (index, joint) in joints.iter().enumerate() {
        let fault = || ChainFault::MimicLoop { joint: joint.name.clone() };
        let (mut at, mut multiplier, mut offset) = (index, 1.0, 0.0);
        for _ in 0..joints.len() {
            let Some(mimic) = joints[at].mimic else { break };
            offset += multiplier * mimic.offset;
            multiplier *= mimic.multiplier;
            at = mimic.master;
            if at >= joints.len() {
                return Err(fault());
            }
        }
        if axis_of[at] == usize::MAX {
            return Err(fault());
        }
        let drive = Drive { axis: axis_of[at], multiplier, offset };
        if joint.mimic.is_some() {
            narrow(&mut axes[drive.axis], joint, &drive);
        }
        drives.push(drive);
    }
    Ok((drives, axes))
}

/// What a follower allows, seen from its master.
fn narrow(axis: &mut ChainAxis, joint: &ChainJoint, drive: &Drive) {
    if drive.multiplier == 0.0 {
        return;
    }
    let one = (joint.lower - drive.offset) / drive.multiplier;
    let other = (joint.upper - drive.offset) / drive.multiplier;
    axis.lower = axis.lower.max(one.min(other));
    axis.upper = axis.upper.min(one.max(other));
    axis.velocity = axis.velocity.min(joint.velocity / drive.multiplier.abs());
    axis.periodic &= joint.kind == JointKind::Revolute && drive.multiplier.fract() == 0.0;
}
