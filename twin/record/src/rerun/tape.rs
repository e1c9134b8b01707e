//! The stream into the file, and the few ways in which we write to it.

use super::layout::Layout;
use crate::RecordError;
use rerun::blueprint::BlueprintActivation;
use rerun::log::{Chunk, LogMsg};
use rerun::sink::FileSinkError;
use rerun::{
    AsComponents, EntityPath, EntityPathPart, RecordingStream, RecordingStreamBuilder,
    RecordingStreamError, SerializedComponentColumn, TimeCell, TimeColumn, TimePoint,
};
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The only time line: seconds of the program.
pub(super) const TIMELINE: &str = "sim_time";
/// Characters of a name in a path.
const NAME_MAX: usize = 80;
/// Bytes of the footer that a whole file ends with, and its two marks at their start.
const FOOTER: usize = 32;
const FOOTER_MARK: &[u8] = b"RRF2FOOT";
/// A disk that takes longer than this for what is left counts as one that refuses.
const FLUSH: Duration = Duration::from_secs(120);

/// A recording in the making.
pub(super) struct Tape {
    stream: RecordingStream,
    path: PathBuf,
}

impl Tape {
    /// Makes the file.
    pub(super) fn open(path: &Path, job: &str, layout: &Layout) -> Result<Tape, RecordError> {
        let stream = builder().save(path).map_err(|error| told(path, error))?;
        stream.set_log_time_enabled(false);
        stream.set_log_tick_enabled(false);
        let tape = Tape { stream, path: path.to_owned() };
        tape.lay_out(layout)?;
        let name: String = job.chars().take(NAME_MAX).collect();
        tape.stream.send_recording_name(name).map_err(packing)?;
        Ok(tape)
    }

    /// The layout, to be shown at once. As a mere default it would lose to what the viewer makes up from the first data that
    /// it sees, and to the layout of the job before.
    fn lay_out(&self, layout: &Layout) -> Result<(), RecordError> {
        let (draft, stored) = builder().memory().map_err(packing)?;
        let activation = BlueprintActivation { make_active: true, make_default: true };
        layout.blueprint.send(&draft, activation).map_err(packing)?;
        for message in stored.take().into_iter().filter(|message| message.store_id().is_blueprint())
        {
            // the last one says that all is there
            if matches!(message, LogMsg::BlueprintActivationCommand(_)) {
                for (path, what) in &layout.more {
                    let time = TimePoint::from_iter([("blueprint", TimeCell::from_sequence(0))]);
                    let chunk = Chunk::builder(path.clone())
                        .with_archetype_auto_row(time, what.as_ref())
                        .build()
                        .map_err(packing)?;
                    let packed = chunk.to_arrow_msg().map_err(packing)?;
                    self.stream.record_msg(LogMsg::ArrowMsg(message.store_id().clone(), packed));
                }
            }
            self.stream.record_msg(message);
        }
        Ok(())
    }

    /// What holds at all times.
    pub(super) fn still(
        &self,
        path: EntityPath,
        what: &impl AsComponents,
    ) -> Result<(), RecordError> {
        self.stream.log_static(path, what).map_err(packing)
    }

    /// What holds from a time on.
    pub(super) fn at(
        &self,
        path: EntityPath,
        time_s: f64,
        what: &impl AsComponents,
    ) -> Result<(), RecordError> {
        self.stream.set_duration_secs(TIMELINE, sound(time_s));
        self.stream.log(path, what).map_err(packing)
    }

    /// A row for each time.
    pub(super) fn rows(
        &self,
        path: EntityPath,
        times_s: &[f64],
        columns: impl Iterator<Item = SerializedComponentColumn>,
    ) -> Result<(), RecordError> {
        if times_s.is_empty() {
            return Ok(());
        }
        let times = TimeColumn::new_duration_secs(TIMELINE, times_s.iter().map(|t| sound(*t)));
        self.stream.send_columns(path, [times], columns).map_err(packing)
    }

    /// Ends the file and looks whether all of it is there; its size.
    pub(super) fn close(self) -> Result<u64, RecordError> {
        let Tape { stream, path } = self;
        let flushed = stream.flush_with_timeout(FLUSH);
        // the last holder: its end writes the footer
        drop(stream);
        let file = |error| RecordError::File { path: path.clone(), error };
        let mut written = File::open(&path).map_err(file)?;
        let bytes = written.metadata().map_err(file)?.len();
        let mut footer = [0; FOOTER];
        let whole = bytes > FOOTER as u64 && flushed.is_ok() && {
            written.seek(SeekFrom::End(-(FOOTER as i64))).map_err(file)?;
            written.read_exact(&mut footer).map_err(file)?;
            footer.windows(FOOTER_MARK.len()).any(|window| window == FOOTER_MARK)
        };
        if whole { Ok(bytes) } else { Err(RecordError::CutShort { path }) }
    }
}

/// Properties of a recording hold when it was begun, by the clock: none are sent.
fn builder() -> RecordingStreamBuilder {
    RecordingStreamBuilder::new("twin").enabled(true).send_properties(false)
}

/// A path of names, each taken as it is whatever is in it.
pub(super) fn path<'a>(names: impl IntoIterator<Item = &'a str>) -> EntityPath {
    let part = |name: &str| {
        let name: String = name.chars().take(NAME_MAX).collect();
        EntityPathPart::new(if name.is_empty() { "unnamed".to_owned() } else { name })
    };
    names.into_iter().map(part).collect()
}

/// What the library says of our data.
pub(super) fn packing(error: impl std::fmt::Display) -> RecordError {
    RecordError::Packing(error.to_string())
}

fn told(path: &Path, error: RecordingStreamError) -> RecordError {
    match error {
        RecordingStreamError::FileSink(FileSinkError::CreateFile { source, .. }) => {
            RecordError::File { path: path.to_owned(), error: source }
        }
        // the file is there, but not even its first bytes
        RecordingStreamError::FileSink(FileSinkError::LogMsgEncode(_)) => {
            RecordError::CutShort { path: path.to_owned() }
        }
        other => packing(other),
    }
}

/// A time that the library takes without complaint.
fn sound(time_s: f64) -> f64 {
    if time_s.is_finite() { time_s.clamp(-1e8, 1e8) } else { 0.0 }
}
