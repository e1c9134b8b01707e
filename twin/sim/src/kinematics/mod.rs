//! Kinematics of one arm: forward, Jacobian, all inverse branches, nearness to singularities.
//!
//! A [`Chain`] is what moves between a base link and a tip link. [`recognise`] looks at the chain's
//! axes (never at names) and finds the closed form that fits; [`Arm::inverse`] then lists every
//! posture that puts the tip where it is asked. Angles in rad, lengths in m, Jacobian rows
//! `vx vy vz wx wy wz` at the tip in base axes.

mod angle;
mod arctangent;
mod arm;
mod branch;
mod canonical;
mod carried;
mod cartesian;
mod chain;
mod condition;
mod from_urdf;
mod gate;
mod hold;
mod jacobian;
mod lines;
mod mount;
mod numeric;
mod opw;
mod parallel;
mod planar;
mod polish;
mod posture;
mod reach;
mod recognise;
mod singularity;
mod srs;
#[cfg(test)]
mod tests;
mod turns;
mod wrist;

pub use arm::{Arm, Coverage, IkOptions, Solution, Solver};
pub use branch::Branch;
pub use canonical::JointMap;
pub use carried::Carried;
pub use cartesian::Cartesian;
pub use chain::{Chain, ChainAxis, ChainFault, ChainJoint, JointKind, Mimic};
pub use from_urdf::{Attachment, RobotTree, from_urdf};
pub use numeric::Numeric;
pub use opw::{Opw, OpwParameters};
pub use parallel::{Parallel, ParallelParameters};
pub use polish::{POSITION_TOLERANCE_M, ROTATION_TOLERANCE_RAD, pose_error};
pub use posture::{MAX_DOF, Posture};
pub use reach::{levers, ranges};
pub use recognise::recognise;
pub use singularity::{Nearness, condition_number, limit_margins, nearness};
pub use srs::{Srs, SrsParameters};
