//! Mechanics of the printed frame: linear 3-D beams, rigid nodes, grown member by member.
//!
//! A node has six freedoms in the order x, y, z, turn about x, y, z, in the axes of the part. Two
//! answers are given for every stage, and they differ: *one-shot* puts all gravity on the frame as
//! it is so far; *staged* lets each member be born free of stress on the frame as it then stands.
//! Displacements are small: nothing here sees a member that slackens, nor contact but that of nodes with
//! what they rest on ([`Hold`]), and [`buckling`] only says by what factor the loads may grow before that is
//! wrong.

mod assembly;
mod balance;
mod beam;
mod buckling;
mod complementary;
pub mod corotational;
mod divided;
mod euler;
mod frame;
mod geometric;
mod ground;
mod growing;
mod hold;
mod lanczos;
mod ldl;
mod one_sided;
mod seat;
mod section;
mod solve;
mod stages;
mod standing;
mod strength;
#[cfg(test)]
mod tests;

pub use buckling::{BucklingAsk, BucklingError, Mode, buckling};
pub use euler::{EULER_FLAG, Slender, slender};
pub use frame::{Frame, FrameFault, Member, NodeLoad, Support};
pub use hold::{Hold, Holding, Pull, solve_held};
pub use section::{Elastic, Section};
pub use solve::{Load, Solution, SolveError, solve};
pub use stages::{Ask, Stage, StageRecord, StageState, solve_held_stages, solve_stages};
pub use strength::{Governs, Strength, Utilisation, first_yield_factor, utilisation};
