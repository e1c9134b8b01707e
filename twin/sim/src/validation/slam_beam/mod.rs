//! The beam of stress lines of Tam & Mueller, and the Vierendeel grid beside it, built and loaded.
//!
//! Field of the plate, lines through it, bars between their crossings, sections of their beads, a
//! plane frame, its loads. What the paper prints is used; what it does not is chosen here, before
//! any load was looked at, and said in the note of the case.

mod case;
mod chosen;
mod field;
mod lines;
mod loaded;
mod net;
mod printed;
#[cfg(test)]
mod tests;

pub(super) use case::cases;
