//! Recordings and shapes that other programs open. The only crate that sees MCAP and Rerun.
//!
//! | module | what it writes |
//! | --- | --- |
//! | `mcap`, `ros2` | the whole job with its findings, for Foxglove, Lichtblick, PlotJuggler, `ros2 bag` and RViz |
//! | [`rerun`] | the same for the Rerun viewer (`.rrd`), with a layout of its own |
//! | `glb` | one moment as binary glTF, for anything that shows 3-D |
//! | `stl` | the part as printed, for CAD and slicers |
//!
//! Everything here turns a checked job and its [`sim::film::Film`] into bytes for a writer or a file that is given; nothing here
//! reads, judges or computes.

mod glb;
mod mcap;
mod mesh;
mod paint;
pub mod rerun;
mod ros2;
#[cfg(test)]
mod sample;
mod stl;
#[cfg(test)]
mod test_film;
mod tubes;

pub use self::mcap::{Attachments, McapRecording, Profile, Recorded, write_mcap};
pub use glb::{GlbOptions, glb};
pub use rerun::{FindingWords, Summary, write_rrd};
pub use stl::stl;

/// Why a recording was not written.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The place it is written to refused.
    #[error("cannot write the recording: {0}")]
    Io(#[from] std::io::Error),
    /// MCAP refused.
    #[error("cannot write the recording: {0}")]
    Mcap(::mcap::McapError),
    /// The file cannot be made.
    #[error("cannot write {path}: {error}")]
    File {
        /// Its path.
        path: std::path::PathBuf,
        /// What the system said.
        error: std::io::Error,
    },
    /// The file ends early, as when the disk is full.
    #[error("{path} was cut short while it was written; is the disk full?")]
    CutShort {
        /// Its path.
        path: std::path::PathBuf,
    },
    /// The library that packs the recording refused something.
    #[error("the recording could not be packed: {0}")]
    Packing(String),
}

impl From<::mcap::McapError> for RecordError {
    fn from(error: ::mcap::McapError) -> Self {
        match error {
            ::mcap::McapError::Io(error) => Self::Io(error),
            other => Self::Mcap(other),
        }
    }
}
