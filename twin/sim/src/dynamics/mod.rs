//! Masses and torques of one arm: what its drives must hold and turn, and how it follows a motion.
//!
//! A [`Model`] is a chain with a [`Body`] on every joint. Torques come from a recursive
//! Newton–Euler of our own in `f64` ([`Model::torques`]); [`drives`] lets rapier3d's multibody
//! follow a planned motion with springs in its joints. Rigid links, no friction in the joints;
//! inertia of rotors and gears only where it is given ([`Model::with_rotors`]). Neither is published
//! for the arms we know, so accelerations cost a real drive more than is said here.
//!
//! Joint vectors in rad or m, torques in N m or N, all axes those of the chain's base unless said.
//! Sources: Luh, Walker, Paul, "On-line computational scheme for mechanical manipulators", J. Dyn.
//! Sys. Meas. Control 102 (1980); Featherstone, "Rigid Body Dynamics Algorithms" (2008).

mod along;
mod body;
pub mod drives;
mod energy;
mod from_urdf;
mod model;
mod moving;
mod newton_euler;
mod payload;
mod peaks;
#[cfg(test)]
mod tests;

pub use along::Along;
pub use body::Body;
pub use from_urdf::{MassFault, bodies_from_urdf};
pub use model::{JointVector, MOST_JOINTS, Model, ModelFault, State};
pub use moving::{Timed, at_time, differentiate};
pub use newton_euler::Wrench;
pub use payload::{Against, Basis, WristMoment, carried, greatest_lever, payload, wrist_moments};
pub use peaks::{TorquePeak, torque_peaks, torque_shares};
