//! Mechanics of the printed frame: linear 3-D beams, rigid nodes, grown member by member.
//!
//! A node has six freedoms in the order x, y, z, turn about x, y, z, in the axes of the part. Two
//! answers are given for every stage, and they differ: *one-shot* puts all gravity on the frame as
//! it is so far; *staged* lets each member be born free of stress on the frame as it then stands.
//! Displacements are small: nothing here sees buckling, contact or a member that slackens.

mod assembly;
mod balance;
mod beam;
mod frame;
mod ground;
mod section;
mod growing;
mod ldl;
mod solve;
mod stages;
mod standing;
mod strength;
#[cfg(test)]
mod tests;

pub use frame::{Frame, FrameFault, Member, NodeLoad, Support};
pub use section::{Elastic, Section};
pub use solve::{Load, Solution, SolveError, solve};
pub use stages::{Ask, Stage, StageRecord, StageState, solve_stages};
pub use strength::{Governs, Strength, Utilisation, first_yield_factor, utilisation};
