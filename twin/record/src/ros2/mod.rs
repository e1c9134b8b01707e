//! The story as messages of ROS 2, for `ros2 bag play` and RViz: axes and units of REP 103, frames by name in `world`.

mod cdr;
mod schemas;
#[cfg(test)]
mod tests;

pub(crate) use schemas::schema;

use sim::finding::Severity;
use sim::pose::{Point, Pose, Vector, is_finite_point};

use crate::mcap::frames::{NamedFrame, WORLD};
use crate::mcap::{Due, Encoding, Item, STRAND_COLOUR, Story, Topic, rgb, text};
use cdr::Cdr;

type Messages = Vec<(&'static Topic, Vec<u8>)>;

const fn topic(name: &'static str, schema: &'static str, latched: bool) -> Topic {
    Topic { name, schema, encoding: Encoding::Cdr, latched }
}

static TF: Topic = topic("/tf", "tf2_msgs/msg/TFMessage", false);
static TF_STATIC: Topic = topic("/tf_static", "tf2_msgs/msg/TFMessage", true);
static JOINTS: Topic = topic("/joint_states", "sensor_msgs/msg/JointState", false);
static PRINT: Topic = topic("/scene/print", "visualization_msgs/msg/MarkerArray", false);
static LOG: Topic = topic("/log", "rcl_interfaces/msg/Log", false);
static ROBOT: Topic = topic("/robot_description", "std_msgs/msg/String", true);

// visualization_msgs/msg/Marker
const LINE_STRIP: i32 = 4;
const ADD: i32 = 0;

/// The messages of one item; `at` turns a time of the film into nanoseconds of the recording.
pub(crate) fn tell(story: &Story<'_>, due: &Due, at: &dyn Fn(f64) -> u64) -> Messages {
    let ns = at(due.time_s);
    match due.item {
        Item::Cell => at_first(story, ns),
        Item::Pose => poses(story, due.time_s, ns),
        Item::Piece(strand, from, to) => vec![(&PRINT, piece(story, ns, strand, from, to))],
        Item::Finding(index) => finding(story, index, ns),
        _ => Vec::new(),
    }
}

/// Quality of service as rosbag2 keeps it: reliable, volatile, or kept for whoever comes late.
pub(crate) fn qos(latched: bool) -> String {
    let durability = if latched { 1 } else { 2 };
    let forever = "{sec: 9223372036, nsec: 854775807}";
    format!(
        "- {{history: 1, depth: 1, reliability: 1, durability: {durability}, deadline: {forever}, lifespan: {forever}, \
         liveliness: 1, liveliness_lease_duration: {forever}, avoid_ros_namespace_conventions: false}}\n"
    )
}

/// Frames at rest and the robot's URDF.
fn at_first(story: &Story<'_>, ns: u64) -> Messages {
    let frame = story.player.frame_at(0.0);
    let still: Vec<_> = story.frames.poses(&frame).filter(|(named, _)| named.is_still()).collect();
    let mut all = vec![
        (&TF_STATIC, transforms(&still, ns)),
        (&LOG, log(story, ns, 20, "twin", &story.headline())),
    ];
    if let Some(urdf) = story.urdf {
        let mut description = Cdr::new();
        description.text(&String::from_utf8_lossy(urdf));
        all.push((&ROBOT, description.into_bytes()));
    }
    all
}

fn poses(story: &Story<'_>, time_s: f64, ns: u64) -> Messages {
    let frame = story.player.frame_at(time_s);
    let moving: Vec<_> =
        story.frames.poses(&frame).filter(|(named, _)| !named.is_still()).collect();
    let mut joints = Cdr::new();
    header(&mut joints, ns, "");
    joints.count(story.joints.len());
    story.joints.iter().for_each(|name| {
        joints.text(name);
    });
    joints.count(frame.posture.len()).f64s(&frame.posture);
    // speeds and torques are not told
    joints.count(0).count(0);
    vec![(&TF, transforms(&moving, ns)), (&JOINTS, joints.into_bytes())]
}

/// `tf2_msgs/msg/TFMessage`.
fn transforms(poses: &[(&NamedFrame, Pose)], ns: u64) -> Vec<u8> {
    let mut cdr = Cdr::new();
    cdr.count(poses.len());
    for (named, pose) in poses {
        header(&mut cdr, ns, WORLD);
        cdr.text(&named.name);
        place(&mut cdr, pose);
    }
    cdr.into_bytes()
}

/// A piece of a strand as `visualization_msgs/msg/MarkerArray`.
fn piece(story: &Story<'_>, ns: u64, order: usize, from: usize, to: usize) -> Vec<u8> {
    let points = story.film.strands.get(order).and_then(|strand| strand.points.get(from..=to));
    let points: Vec<&Point> =
        points.unwrap_or_default().iter().filter(|p| is_finite_point(p)).collect();
    let mut cdr = Cdr::new();
    cdr.count(1);
    header(&mut cdr, ns, "part");
    let small = |number: usize| i32::try_from(number).unwrap_or(i32::MAX);
    cdr.text(&format!("strand/{order}")).i32(small(from)).i32(LINE_STRIP).i32(ADD);
    place(&mut cdr, &Pose::identity());
    cdr.f64s(Vector::new(story.bead_m(order, from, to), 0.0, 0.0).as_slice());
    let [r, g, b] = rgb(STRAND_COLOUR);
    [r, g, b, 1.0].iter().for_each(|share| {
        cdr.f32(*share as f32);
    });
    // stays for ever, and with the part
    cdr.i32(0).u32(0).bool(true).count(points.len());
    points.iter().for_each(|p| {
        cdr.f64s(p.coords.as_slice());
    });
    // one colour for all points, no texture, no words, no mesh
    cdr.count(0).text("");
    header(&mut cdr, 0, "");
    cdr.text("").count(0).count(0);
    let facts = story.facts(order, from, to);
    let facts: Vec<String> = facts.iter().map(|(key, value)| format!("{key}: {value}")).collect();
    cdr.text(&facts.join("\n")).text("").text("").count(0).bool(false);
    cdr.into_bytes()
}

/// A finding as a line of the log.
fn finding(story: &Story<'_>, index: usize, ns: u64) -> Messages {
    let Some((finding, words)) = story.finding(index) else { return Vec::new() };
    let level = match finding.severity {
        Severity::Warning => 30,
        Severity::Error => 40,
    };
    let name = format!("twin.{}", finding.code.as_str());
    vec![(&LOG, log(story, ns, level, &name, &words))]
}

/// `rcl_interfaces/msg/Log`.
fn log(story: &Story<'_>, ns: u64, level: u8, name: &str, words: &str) -> Vec<u8> {
    let mut cdr = Cdr::new();
    time(&mut cdr, ns);
    cdr.u8(level).text(name).text(words).text(&text::name(&story.film.job)).text("").u32(0);
    cdr.into_bytes()
}

/// `std_msgs/msg/Header`.
fn header(cdr: &mut Cdr, ns: u64, frame: &str) {
    time(cdr, ns);
    cdr.text(frame);
}

/// `builtin_interfaces/msg/Time`, which ends in 2038.
fn time(cdr: &mut Cdr, ns: u64) {
    let sec = i32::try_from(ns / 1_000_000_000).unwrap_or(i32::MAX);
    cdr.i32(sec).u32((ns % 1_000_000_000) as u32);
}

/// `geometry_msgs/msg/Pose` or `Transform`.
fn place(cdr: &mut Cdr, pose: &Pose) {
    let q = pose.rotation.coords;
    cdr.f64s(pose.translation.vector.as_slice()).f64s(&[q.x, q.y, q.z, q.w]);
}
