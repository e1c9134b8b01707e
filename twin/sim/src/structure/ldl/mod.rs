//! Sparse `L D Lᵀ` of a growing frame, in blocks of the six freedoms of a node.
//!
//! One order and one pattern of L serve the whole print ([`Symbolic`]). A node that is not there
//! yet has an empty column and takes no part; a node's first member fills its column exactly, with
//! nothing cancelled. A member is a change of rank six, carried up the elimination tree
//! ([`update`]); nothing is regularised.

mod block;
mod factor;
mod order;
mod solve;
mod symbolic;
#[cfg(test)]
mod tests;
mod update;

pub(crate) use factor::{Factor, Part, Stuck};
pub(crate) use solve::Pair;
pub(crate) use symbolic::Symbolic;
