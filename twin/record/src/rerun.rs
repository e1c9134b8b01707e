//! A whole program as a Rerun recording (`.rrd`), with a layout of its own.
//!
//! | entity | what |
//! | --- | --- |
//! | `/world/<mover>/<body>` | meshes, still; the movers carry them over `sim_time` |
//! | `/world/part/strands/…` | what is laid, each piece once, when it is done |
//! | `/world/part/planned` | the plan as thin lines |
//! | `/world/part/findings/<code>/…` | places of findings, from when they happen |
//! | `/plots/…` | speeds, clearance, temperature, sag, displacement … with their limits |
//! | `/state/process` | what the arm is doing |
//! | `/log/…` | findings and strands as lines |
//! | `/report`, `/camera/overview` | the report's text; pictures |
//!
//! Nothing here opens a connection or a viewer. A file of the same job differs in bytes from run to run: Rerun numbers rows by
//! the clock. Its only time line is `sim_time`.

mod cell;
mod layout;
mod plots;
mod print;
mod tape;
#[cfg(test)]
mod tests;
mod words;

use crate::RecordError;
use sim::film::{Film, traces};
use sim::preflight::Preflight;
use sim::scene::MarkSeverity;
use std::path::Path;
use tape::Tape;

/// A finding in the words of the report.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FindingWords<'a> {
    /// Its code.
    pub code: &'a str,
    /// How bad it is.
    pub severity: MarkSeverity,
    /// What is wrong.
    pub message: &'a str,
    /// What to do.
    pub hint: &'a str,
}

/// What went into a recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Summary {
    /// Size of the file.
    pub bytes: u64,
    /// Poses of movers.
    pub poses: usize,
    /// Pieces that the strands came in.
    pub pieces: usize,
    /// Findings that have a place in the recording.
    pub places: usize,
    /// Findings with a place that were left out, being too many; the log has them all up to its own bound.
    pub places_left_out: usize,
}

/// Writes the recording. `findings` are in the order of [`Film::findings`]; `pictures` are PNG files and their times, s.
///
/// The file grows while it is written; give it a name of its own and rename it when this returns. O(n) in points, moments
/// and legs; poses are thinned to 200 000.
///
/// # Errors
/// A path that cannot be written, a file cut short, or data that the library refuses.
pub fn write_rrd(
    preflight: &Preflight,
    film: &Film,
    findings: &[FindingWords<'_>],
    report_markdown: &str,
    pictures: &[(f64, Vec<u8>)],
    path: &Path,
) -> Result<Summary, RecordError> {
    let all = traces(preflight, film);
    let layout = layout::layout(film, &all, !pictures.is_empty());
    let tape = Tape::open(path, &film.job, &layout)?;
    let mut summary = Summary::default();
    cell::bodies(&tape, film)?;
    summary.poses = cell::poses(&tape, preflight, film)?;
    print::planned(&tape, film)?;
    summary.pieces = print::strands(&tape, film)?;
    (summary.places, summary.places_left_out) = print::findings(&tape, film, findings)?;
    plots::plots(&tape, film, &all)?;
    words::state(&tape, film)?;
    words::log(&tape, film, findings)?;
    words::report(&tape, report_markdown)?;
    words::pictures(&tape, pictures)?;
    summary.bytes = tape.close()?;
    Ok(summary)
}
