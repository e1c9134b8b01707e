//! Recordings read back by the reader of the crate `mcap`, and by the descriptors they carry.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{Cursor, Seek, SeekFrom, Write};

use mcap::MessageStream;
use mcap::read::Options;
use proptest::prelude::{Just, any, prop_assert, prop_oneof, proptest};
use sim::film::Film;
use sim::preflight::Preflight;

use super::frames::Frames;
use super::tests_schemas::fits;
use super::{Attachments, McapRecording, Profile, RecordError, Recorded, text, write_mcap};
use crate::sample;

const EPOCH_NS: u64 = 1_700_000_000_000_000_000;
const PROFILES: [Profile; 2] = [Profile::Foxglove, Profile::Ros2];

/// The recording of a film.
fn record(preflight: &Preflight, film: &Film, profile: Profile) -> (Vec<u8>, Recorded) {
    with_pictures(preflight, film, profile, &[])
}

pub(crate) fn with_pictures(
    preflight: &Preflight,
    film: &Film,
    profile: Profile,
    pictures: &[(f64, Vec<u8>)],
) -> (Vec<u8>, Recorded) {
    let mut out = Cursor::new(Vec::new());
    let recorded = write_to(preflight, film, profile, pictures, &mut out).expect("memory");
    (out.into_inner(), recorded)
}

fn write_to(
    preflight: &Preflight,
    film: &Film,
    profile: Profile,
    pictures: &[(f64, Vec<u8>)],
    out: impl Write + Seek,
) -> Result<Recorded, RecordError> {
    let run = BTreeMap::from([("version".to_owned(), "1".to_owned())]);
    let attachments = Attachments {
        job: ("../a/job.slam", b"{}"),
        report_json: b"{\"report\": 1}",
        urdf: Some(("robot.urdf", b"<robot name='r'/>")),
        more: vec![("note.txt", "text/plain", b"note")],
    };
    let (epoch_ns, run) = (EPOCH_NS, &run);
    let recording =
        McapRecording { preflight, film, run, attachments, pictures, profile, epoch_ns };
    write_mcap(&recording, out)
}

/// Bytes that do not compress, as of a picture.
pub(super) fn noise(len: usize) -> Vec<u8> {
    let mut state = 1u32;
    let next = |_| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 24) as u8
    };
    (0..len).map(next).collect()
}

/// Topic, schema, time and bytes of a message.
type Read = (String, String, u64, Vec<u8>);

/// Every message that can be read, and whether all could.
pub(crate) fn read(bytes: &[u8]) -> (Vec<Read>, bool) {
    let options = Options::IgnoreEndMagic | Options::ValidateChunkCrcs;
    let Ok(stream) = MessageStream::new_with_options(bytes, options) else {
        return (Vec::new(), false);
    };
    let mut all = Vec::new();
    for message in stream {
        let Ok(message) = message else { return (all, false) };
        let schema = message.channel.schema.as_ref().map_or(String::new(), |s| s.name.clone());
        all.push((message.channel.topic.clone(), schema, message.log_time, message.data.to_vec()));
    }
    (all, true)
}

#[test]
fn what_was_written_is_read_in_order_of_time() {
    let checked = sample::tent();
    let film = Film::new(checked);
    for profile in PROFILES {
        let (bytes, recorded) = record(checked, &film, profile);
        let (messages, whole) = read(&bytes);
        assert!(whole);
        assert!(messages.windows(2).all(|pair| pair[0].2 <= pair[1].2), "{profile:?}");
        assert_eq!(messages[0].2, EPOCH_NS);
        let end_ns = EPOCH_NS + (film.total_s * 1e9).round() as u64;
        assert_eq!(messages.last().map(|message| message.2), Some(end_ns));
        let mut topics: BTreeMap<&str, u64> = BTreeMap::new();
        for (topic, ..) in &messages {
            *topics.entry(topic).or_default() += 1;
        }
        assert_eq!(topics, recorded.topics);
        let summary = mcap::Summary::read(&bytes).expect("a summary").expect("a summary");
        let stats = summary.stats.expect("statistics");
        assert_eq!(stats.message_count, recorded.messages);
        assert_eq!(u64::from(stats.chunk_count), recorded.chunks);
        assert_eq!((stats.attachment_count, stats.metadata_count), (4, 2));
        for wanted in ["/tf", "/joint_states", "/scene/print"] {
            assert!(topics.contains_key(wanted), "{wanted} of {topics:?}");
        }
    }
}

#[test]
fn the_files_inside_are_the_files_given() {
    let checked = sample::tent();
    let (bytes, _) = record(checked, &Film::new(checked), Profile::Foxglove);
    let summary = mcap::Summary::read(&bytes).expect("a summary").expect("a summary");
    let files = summary.attachment_indexes.iter().map(|index| {
        let file = mcap::read::attachment(&bytes, index).expect("CRC");
        (file.name.clone(), file.data.to_vec())
    });
    let files: BTreeMap<String, Vec<u8>> = files.collect();
    assert_eq!(files["job.slam"], b"{}", "without its folder");
    assert_eq!(files["report.json"], b"{\"report\": 1}");
    assert_eq!(files["robot.urdf"], b"<robot name='r'/>");
    assert_eq!(files["note.txt"], b"note");
    let notes = summary.metadata_indexes.iter().map(|index| {
        let note = mcap::read::metadata(&bytes, index).expect("a record");
        (note.name, note.metadata)
    });
    let notes: BTreeMap<String, BTreeMap<String, String>> = notes.collect();
    assert_eq!(notes["twin.run"]["version"], "1");
    let feasible = checked.verdict() == sim::finding::Verdict::Feasible;
    assert_eq!(notes["twin.verdict"]["verdict"] == "feasible", feasible);
}

#[test]
fn the_same_job_gives_the_same_bytes() {
    let checked = sample::tent();
    let film = Film::new(checked);
    for profile in PROFILES {
        assert_eq!(record(checked, &film, profile), record(checked, &film, profile));
    }
}

#[test]
fn whole_chunks_survive_a_cut() {
    let checked = sample::tent();
    let film = Film::new(checked);
    let pictures: Vec<(f64, Vec<u8>)> =
        (0..8).map(|k| (film.total_s * f64::from(k) / 8.0, noise(700_000))).collect();
    let (bytes, recorded) = with_pictures(checked, &film, Profile::Foxglove, &pictures);
    assert!(recorded.chunks >= 4, "{}", recorded.chunks);
    let (all, _) = read(&bytes);
    let summary = mcap::Summary::read(&bytes).expect("a summary").expect("a summary");
    for percent in [10, 35, 60, 85, 99] {
        let cut = bytes.len() * percent / 100;
        let (some, _) = read(&bytes[..cut]);
        assert_eq!(some[..], all[..some.len()]);
        let mut whole = 0;
        for index in &summary.chunk_indexes {
            if index.chunk_start_offset + index.chunk_length <= cut as u64 {
                whole += summary.stream_chunk(&bytes, index).expect("a chunk").count();
            }
        }
        assert!(some.len() >= whole, "{} of {whole} at {percent} %", some.len());
        assert!(percent < 60 || whole > all.len() / 3, "{whole} of {}", all.len());
    }
}

#[test]
fn hostile_names_stay_inside_their_fields() {
    let checked = sample::tent();
    let mut film = Film::new(checked);
    let names = ["world", "tool", "", "\0\u{1b}[31mred", "a\nb", "tool", &"x".repeat(100_000)];
    for (body, name) in film.bodies.iter_mut().zip(names) {
        body.name = name.to_owned();
    }
    film.strands[0].id = "\u{1b}]0;title\u{7}\u{0}".repeat(1000);
    film.joints[0].name = "\r\n".to_owned();
    film.job = "job\0".to_owned();
    let frames = Frames::new(&film);
    let distinct: BTreeSet<&str> = frames.all.iter().map(|frame| frame.name.as_str()).collect();
    assert_eq!(distinct.len(), frames.all.len());
    assert!(!distinct.contains("world") && !distinct.contains(""));
    for profile in PROFILES {
        let (bytes, _) = record(checked, &film, profile);
        let (messages, whole) = read(&bytes);
        assert!(whole);
        for (topic, schema, _, data) in messages {
            let copied = data.windows(10_000).any(|run| run.iter().all(|&byte| byte == b'x'));
            assert!(!copied, "{topic} has a name of any length");
            assert!(!data.contains(&0x1b) || topic != "/state", "{topic}");
            if profile == Profile::Foxglove {
                fits(&schema, &data, &mut BTreeSet::new())
                    .unwrap_or_else(|e| panic!("{topic}: {e}"));
            }
        }
    }
}

#[test]
fn numbers_that_are_not_finite_are_left_out() {
    let checked = sample::tent();
    let mut film = Film::new(checked);
    film.strands[0].points[1].x = f64::NAN;
    film.strands[0].bead_m.fill(f64::INFINITY);
    film.strands[1].time_s.fill(f64::NAN);
    film.bodies[0].mover_from_body.translation.x = f64::INFINITY;
    film.legs[0].from_s = f64::NAN;
    let (bytes, _) = record(checked, &film, Profile::Foxglove);
    let (messages, whole) = read(&bytes);
    assert!(whole && messages.windows(2).all(|pair| pair[0].2 <= pair[1].2));
}

#[test]
fn nothing_printed_is_a_recording_all_the_same() {
    let checked = sample::far();
    let mut film = Film::new(checked);
    film.strands.clear();
    film.legs.clear();
    film.total_s = 0.0;
    for profile in PROFILES {
        let (bytes, recorded) = record(checked, &film, profile);
        let (messages, whole) = read(&bytes);
        assert!(whole && messages.len() as u64 == recorded.messages);
        // the headline, and that the strand is out of reach
        assert!(recorded.topics["/log"] >= 2, "{recorded:?}");
        assert!(!recorded.topics.contains_key("/scene/print"));
    }
}

/// A disk with room for so many bytes.
struct Full {
    inner: Cursor<Vec<u8>>,
    room: u64,
}

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        match self.inner.position() + bytes.len() as u64 <= self.room {
            true => self.inner.write(bytes),
            false => Err(std::io::ErrorKind::StorageFull.into()),
        }
    }
    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

impl Seek for Full {
    fn seek(&mut self, to: SeekFrom) -> std::io::Result<u64> {
        self.inner.seek(to)
    }
}

#[test]
fn a_full_disk_is_an_error_wherever_it_fills() {
    let checked = sample::tent();
    let film = Film::new(checked);
    let (bytes, _) = record(checked, &film, Profile::Foxglove);
    let len = bytes.len() as u64;
    for room in (0..16).map(|k| len * k / 16).chain([0, 1, 7, 8, len - 1]) {
        let mut disk = Full { inner: Cursor::new(Vec::new()), room };
        let written = write_to(checked, &film, Profile::Foxglove, &[], &mut disk);
        let Err(RecordError::Io(error)) = written else { panic!("{room}: {written:?}") };
        // the library that compresses tells some of them again in words of its own
        let wanted: std::io::Error = std::io::ErrorKind::StorageFull.into();
        assert!(error.to_string().contains(&wanted.to_string()), "{room}: {error}");
    }
}

proptest! {
    #[test]
    fn any_name_is_made_safe(
        name in prop_oneof![any::<String>(), ".*[/\\\\:]", Just("..".to_owned()), ".{300,400}"],
        taken in proptest::collection::vec(any::<String>(), 0..4),
    ) {
        let file = text::file_name(&name);
        prop_assert!(!file.is_empty() && file != ".." && file != ".");
        prop_assert!(!file.contains(['/', '\\', ':', '\0', '\n']));
        prop_assert!(file.chars().count() <= text::NAME_MAX + 1);
        let distinct = text::distinct(&name, |other| taken.iter().any(|taken| taken == other));
        prop_assert!(!distinct.is_empty() && !taken.contains(&distinct));
        let shown = text::shown(&name, 50);
        prop_assert!(!shown.contains('\x1b'));
    }
}
