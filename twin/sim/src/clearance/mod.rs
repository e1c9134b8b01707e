//! How far rigid bodies of a cell are apart, in one posture and along a motion. Knows nothing of findings.
//!
//! Distances are our own, in f64, and certified: the search for the nearest points (`gjk`) may end
//! where it likes, what is reported is the gap between two planes that part the bodies. An answer is
//! short of the distance by 1e-9 m at most, and never more than it but for the rounding of the
//! poses, which is taken off. The depth of an overlap (`depth`) is never too shallow, and too deep by
//! 1e-4 of it as a rule; only how deep something is in a mesh is from parry3d (f32, millimetres, its
//! bound on rounding added). Where parry3d and this module disagree about a distance, this
//! module is right: parry3d stops within a share of 1.1e-3 of it, and about once in a thousand
//! short beads near a nozzle it is centimetres off.
//!
//! Motions are covered, not sampled: [`Space`] knows what is measured against what, [`Touch`] what may
//! touch and when, `track` bounds how far bodies move, `sweep` halves stretches until found and
//! guaranteed clearance are within [`RESOLUTION_M`].

mod beads;
mod bodies;
mod body;
mod core;
mod depth;
mod gjk;
mod measure;
mod mesh;
#[allow(dead_code, reason = "asked by the planners of `motion`")]
mod query;
mod solid;
mod space;
mod sweep;
#[cfg(test)]
mod tests;
mod touch;
mod track;
mod tree;
mod zone;

pub use beads::{Beads, Nearest};
pub use bodies::Bodies;
#[cfg(test)]
pub(crate) use bodies::LinkBody;
pub use body::Body;
pub(crate) use measure::Measure;
#[allow(unused_imports, reason = "named by the planners of `motion`")]
pub(crate) use query::{Blocked, Closest};
pub(crate) use space::{Kind, Named, Space};
pub use sweep::RESOLUTION_M;
pub(crate) use sweep::{Asked, Covered};
pub(crate) use touch::Touch;
pub(crate) use track::Track;
pub(crate) use zone::{Piece, outside};
