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
mod balanced;
mod beads;
mod beam;
mod buckling;
mod complementary;
pub mod corotational;
mod divided;
mod euler;
mod first_yield;
mod frame;
mod geometric;
mod ground;
mod growing;
mod hold;
mod lanczos;
mod ldl;
mod model_factor;
mod one_sided;
mod plastic;
mod riding;
mod seat;
mod section;
mod solve;
mod stages;
mod standing;
mod strength;
#[cfg(test)]
mod tests;
mod trial;
mod weld;
mod yielding;

pub(crate) use beam::displacement_along;

pub use beads::{Bead, BeadsFault, Bundle, bundle, torsion_ceiling_m4};
pub use buckling::{Buckled, BucklingAsk, BucklingError, Mode, buckling};
pub use euler::{EULER_FLAG, Slender, slender};
pub use first_yield::{Criterion, FirstYield, first_yield};
pub use frame::{Frame, FrameFault, Member, NodeLoad, Support};
pub use hold::{Hold, Holding, Pull, solve_held};
pub use model_factor::model_factor;
pub use plastic::{Collapse, plastic_bound};
pub use riding::{Farthest, Ridden, Riding, ride_stages};
pub use section::{Elastic, Section};
pub use solve::{Held, Load, Solution, SolveError, solve};
pub use stages::{Ask, Stage, StageRecord, StageState, solve_held_stages, solve_stages};
pub use strength::{Governs, Strength, Utilisation, utilisation};
pub use trial::{Trial, TrialState};
pub use weld::{At, Weld, WeldUse};
