//! How far rigid bodies of a cell are apart, in one posture and along a motion. Knows nothing of findings.

mod bodies;
mod exact;

pub(crate) use bodies::{Bodies, Body, LinkBody};
