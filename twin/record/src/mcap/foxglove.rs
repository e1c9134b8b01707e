//! The story as messages of Foxglove's schemas.

use sim::film::TraceOf;
use sim::finding::Severity;
use sim::pose::Pose;

use super::agenda::{Due, Item};
use super::frames::WORLD;
use super::output::{Encoding, Topic};
use super::story::Story;
use super::wire::Proto;
use super::{cell, parts, print, text};

/// Messages that are due together, each with its topic.
pub(super) type Messages = Vec<(&'static Topic, Vec<u8>)>;

const fn topic(name: &'static str, schema: &'static str) -> Topic {
    Topic { name, schema, encoding: Encoding::Protobuf, latched: false }
}

static TF: Topic = topic("/tf", "foxglove.FrameTransforms");
static JOINTS: Topic = topic("/joint_states", "foxglove.JointStates");
static CELL: Topic = topic("/scene/cell", "foxglove.SceneUpdate");
static PRINT: Topic = topic("/scene/print", "foxglove.SceneUpdate");
static PRINTED: Topic = topic("/scene/printed", "foxglove.SceneUpdate");
static FINDINGS: Topic = topic("/scene/findings", "foxglove.SceneUpdate");
static EVENTS: Topic = topic("/events", "foxglove.Event");
static LOG: Topic = topic("/log", "foxglove.Log");
static METRICS: Topic = topic("/metrics", "twin.Metrics");
static STATE: Topic = topic("/state", "twin.State");
static CAMERA: Topic = topic("/camera/overview", "foxglove.CompressedImage");

/// The messages of one item; `at` turns a time of the film into nanoseconds of the recording.
pub(super) fn tell(story: &Story<'_>, due: &Due, at: &dyn Fn(f64) -> u64) -> Messages {
    let ns = at(due.time_s);
    match due.item {
        Item::Cell => vec![
            (&CELL, cell::update(story, due.time_s, ns)),
            (&FINDINGS, parts::update(print::marks(story, ns))),
            (&LOG, log(story, ns, INFO, "twin", &story.headline())),
        ],
        Item::Pose => poses(story, due.time_s, ns),
        Item::Leg(_) | Item::Wait | Item::Done => state(story, due.item, ns),
        Item::Strand(index) => strand_event(story, index, at),
        Item::Piece(strand, from, to) => {
            vec![(&PRINT, parts::update([print::piece(story, ns, strand, from, to)]))]
        }
        Item::Printed => vec![(&PRINTED, parts::update(print::so_far(story, due.time_s, ns)))],
        Item::Gone(_) => vec![(&CELL, cell::update(story, due.time_s, ns))],
        Item::Finding(index) => finding(story, index, ns),
        Item::Picture(index) => picture(story, index, ns),
    }
}

fn poses(story: &Story<'_>, time_s: f64, ns: u64) -> Messages {
    let frame = story.player.frame_at(time_s);
    let transform = |(named, pose): (&super::frames::NamedFrame, Pose)| {
        Proto::default()
            .message(1, parts::stamp(ns))
            .text(2, WORLD)
            .text(3, &named.name)
            .message(4, parts::vector(&pose.translation.vector))
            .message(5, parts::turn(&pose))
    };
    let transforms = Proto::default().messages(1, story.frames.poses(&frame).map(transform));
    let joint =
        |(name, value): (&String, &f64)| Proto::default().text(1, name).known(2, Some(*value));
    let joints = story.joints.iter().zip(&frame.posture).map(joint);
    let joints = Proto::default().message(1, parts::stamp(ns)).messages(2, joints);
    vec![
        (&TF, transforms.into_bytes()),
        (&JOINTS, joints.into_bytes()),
        (&METRICS, metrics(story, time_s, ns)),
    ]
}

/// `twin.Metrics`.
fn metrics(story: &Story<'_>, time_s: f64, ns: u64) -> Vec<u8> {
    let told = [
        TraceOf::Speed,
        TraceOf::Clearance,
        TraceOf::Temperature,
        TraceOf::Cure,
        TraceOf::Sag,
        TraceOf::Displacement,
        TraceOf::Buckling,
    ];
    let stamped = Proto::default().message(1, parts::stamp(ns));
    let numbers = (2..)
        .zip(told)
        .fold(stamped, |proto, (number, of)| proto.known(number, story.traced(of, time_s)));
    let joints = story.joints.iter().enumerate().map(|(index, name)| {
        Proto::default().text(1, name).known(2, story.traced(TraceOf::Joint(index), time_s))
    });
    numbers.messages(9, joints).into_bytes()
}

/// `twin.State`.
fn state(story: &Story<'_>, item: Item, ns: u64) -> Messages {
    let Some((word, strand, order)) = story.state(item) else { return Vec::new() };
    let state = Proto::default()
        .message(1, parts::stamp(ns))
        .text(2, word)
        .text(3, &strand)
        .uint(4, order as u64);
    vec![(&STATE, state.into_bytes())]
}

/// `foxglove.Event` of a strand.
fn strand_event(story: &Story<'_>, index: usize, at: &dyn Fn(f64) -> u64) -> Messages {
    let Some(strand) = story.film.strands.get(index) else { return Vec::new() };
    let (Some(born_s), Some(done_s)) = (strand.born_s(), strand.done_s()) else {
        return Vec::new();
    };
    let facts = story.facts(index, 0, strand.segments());
    vec![(&EVENTS, event(at(born_s), at(done_s), "strand", &facts))]
}

fn event(from_ns: u64, to_ns: u64, kind: &str, facts: &[(&str, String)]) -> Vec<u8> {
    Proto::default()
        .message(1, parts::stamp(from_ns))
        .message(2, parts::stamp(to_ns))
        .message(3, parts::pair("kind", kind))
        .messages(3, facts.iter().map(|(key, value)| parts::pair(key, value)))
        .into_bytes()
}

/// A finding as a line of the log and an event.
fn finding(story: &Story<'_>, index: usize, ns: u64) -> Messages {
    let Some((finding, words)) = story.finding(index) else { return Vec::new() };
    let level = match finding.severity {
        Severity::Warning => WARNING,
        Severity::Error => ERROR,
    };
    let line = log(story, ns, level, finding.code.as_str(), &words);
    let facts = story.finding_facts(index);
    vec![(&LOG, line), (&EVENTS, event(ns, ns, "finding", &facts))]
}

// foxglove.Log.Level
const INFO: u64 = 2;
const WARNING: u64 = 3;
const ERROR: u64 = 4;

/// `foxglove.Log`.
fn log(story: &Story<'_>, ns: u64, level: u64, name: &str, words: &str) -> Vec<u8> {
    Proto::default()
        .message(1, parts::stamp(ns))
        .uint(2, level)
        .text(3, words)
        .text(4, name)
        .text(5, &text::name(&story.film.job))
        .fixed32(6, 0)
        .into_bytes()
}

/// `foxglove.CompressedImage`.
fn picture(story: &Story<'_>, index: usize, ns: u64) -> Messages {
    let Some((_, png)) = story.pictures.get(index) else { return Vec::new() };
    let image = Proto::default()
        .message(1, parts::stamp(ns))
        .bytes(2, png)
        .text(3, "png")
        .text(4, "camera");
    vec![(&CAMERA, image.into_bytes())]
}
