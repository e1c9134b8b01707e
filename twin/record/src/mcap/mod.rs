//! MCAP: one file with everything that moves, is printed, found and measured, for Foxglove, Lichtblick, PlotJuggler, Rerun
//! and `ros2 bag`.
//!
//! [`write_mcap`] lists what there is to tell ([`agenda`](agenda::agenda)), sorts it by time, and writes the messages of each
//! item as it comes up, so that no more than a chunk is held and messages are in order of time over all topics.

mod agenda;
mod cell;
mod descriptor;
mod foxglove;
pub(crate) mod frames;
mod output;
mod parts;
mod print;
mod schemas;
mod story;
#[cfg(test)]
pub(crate) mod tests;
#[cfg(test)]
mod tests_schemas;
pub(crate) mod text;
mod wire;

pub(crate) use agenda::{Due, Item};
pub(crate) use output::{Encoding, Topic};
pub(crate) use story::{STRAND_COLOUR, Story, rgb};

use std::collections::BTreeMap;
use std::io::{Seek, Write};

use crate::RecordError;
use sim::film::Film;
use sim::preflight::Preflight;

use output::Output;

/// Which programs a recording is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Profile {
    /// Foxglove's protobuf schemas: Foxglove, Lichtblick, PlotJuggler, Rerun.
    Foxglove,
    /// Messages of ROS 2 in CDR: `ros2 bag`, RViz.
    Ros2,
}

/// Files that travel inside a recording.
#[derive(Debug, Clone, Default)]
pub struct Attachments<'a> {
    /// Name and bytes of the job.
    pub job: (&'a str, &'a [u8]),
    /// `report.json`.
    pub report_json: &'a [u8],
    /// Name and bytes of the robot's URDF.
    pub urdf: Option<(&'a str, &'a [u8])>,
    /// Further files: name, media type, bytes.
    pub more: Vec<(&'a str, &'a str, &'a [u8])>,
}

/// What a recording is made of.
#[derive(Debug, Clone)]
pub struct McapRecording<'a> {
    /// The checked job.
    pub preflight: &'a Preflight,
    /// Its film.
    pub film: &'a Film,
    /// Facts of the run, written as the metadata record `twin.run`.
    pub run: &'a BTreeMap<String, String>,
    /// Files to attach.
    pub attachments: Attachments<'a>,
    /// PNG pictures of the job with their times, s.
    pub pictures: &'a [(f64, Vec<u8>)],
    /// Who it is for.
    pub profile: Profile,
    /// Time of the start of the program, ns since 1970; 0 is well.
    pub epoch_ns: u64,
}

/// What was written.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Recorded {
    /// Number of messages.
    pub messages: u64,
    /// Number of chunks.
    pub chunks: u64,
    /// Number of messages of each topic.
    pub topics: BTreeMap<&'static str, u64>,
}

/// Writes a recording, chunk by chunk: whatever part of it is there after a crash holds its whole chunks, job and report
/// first. The same values give the same bytes.
///
/// # Errors
/// The writer's; what was written by then has no summary.
pub fn write_mcap(
    recording: &McapRecording<'_>,
    out: impl Write + Seek,
) -> Result<Recorded, RecordError> {
    let at =
        |time_s: f64| recording.epoch_ns.saturating_add((time_s.max(0.0) * 1e9).round() as u64);
    let profile = match recording.profile {
        Profile::Foxglove => "",
        Profile::Ros2 => "ros2",
    };
    let attached = &recording.attachments;
    let story = Story::new(
        recording.preflight,
        recording.film,
        recording.pictures,
        attached.urdf.map(|(_, bytes)| bytes),
    );
    let mut out = Output::new(out, profile)?;
    for (name, media_type, bytes) in files(attached) {
        out.attach(recording.epoch_ns, name, media_type, bytes)?;
    }
    out.note("twin.run", recording.run.clone())?;
    out.note("twin.verdict", story.verdict())?;
    for due in story.agenda() {
        let messages = match recording.profile {
            Profile::Foxglove => foxglove::tell(&story, &due, &at),
            Profile::Ros2 => crate::ros2::tell(&story, &due, &at),
        };
        for (topic, bytes) in messages {
            out.put(topic, at(due.time_s), &bytes)?;
        }
    }
    out.finish()
}

fn files<'a>(attached: &Attachments<'a>) -> Vec<(&'a str, &'a str, &'a [u8])> {
    let mut all = vec![
        (attached.job.0, "text/plain", attached.job.1),
        ("report.json", "application/json", attached.report_json),
    ];
    all.extend(attached.urdf.map(|(name, bytes)| (name, "application/xml", bytes)));
    all.extend(attached.more.iter().copied());
    all
}
