//! Recordings that other programs open. The only crate that sees MCAP and Rerun.
//!
//! Everything here turns a checked job and its [`sim::film::Film`] into bytes for a writer that is given; nothing here
//! reads, judges or computes.

mod mcap;
mod ros2;
#[cfg(test)]
mod sample;

pub use self::mcap::{Attachments, McapRecording, Profile, RecordError, Recorded, write_mcap};
