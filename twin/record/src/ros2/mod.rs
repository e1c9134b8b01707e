//! The story as messages of ROS 2, for `ros2 bag play` and RViz: axes and units of REP 103, frames by name in `world`.

mod cdr;
mod markers;
mod schemas;
#[cfg(test)]
mod tests;

pub(crate) use schemas::schema;

use sim::finding::Severity;
use sim::pose::Pose;

use crate::mcap::frames::{NamedFrame, WORLD};
use crate::mcap::{Due, Encoding, Item, Story, Topic, text};
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

static CELL: Topic = topic("/scene/cell", "visualization_msgs/msg/MarkerArray", true);
static FINDINGS: Topic = topic("/scene/findings", "visualization_msgs/msg/MarkerArray", false);

/// The messages of one item; `at` turns a time of the film into nanoseconds of the recording.
pub(crate) fn tell(story: &Story<'_>, due: &Due, at: &dyn Fn(f64) -> u64) -> Messages {
    let ns = at(due.time_s);
    match due.item {
        Item::Cell => at_first(story, ns),
        Item::Pose => poses(story, due.time_s, ns),
        Item::Piece(strand, from, to) => {
            vec![(&PRINT, markers::array(&[markers::piece(story, strand, from, to)], ns))]
        }
        Item::Gone(_) => vec![(&CELL, markers::array(&markers::cell(story, due.time_s), ns))],
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

/// Frames at rest, the robot's URDF, and all rigid things, the arm's links too: a URDF may have no shapes.
fn at_first(story: &Story<'_>, ns: u64) -> Messages {
    let frame = story.player.frame_at(0.0);
    let still: Vec<_> = story.frames.poses(&frame).filter(|(named, _)| named.is_still()).collect();
    let mut all = vec![
        (&TF_STATIC, transforms(&still, ns)),
        (&LOG, log(story, ns, 20, "twin", &story.headline())),
        (&CELL, markers::array(&markers::cell(story, 0.0), ns)),
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

/// A finding as a line of the log, and where it has a place, as a ball there.
fn finding(story: &Story<'_>, index: usize, ns: u64) -> Messages {
    let Some((finding, words)) = story.finding(index) else { return Vec::new() };
    let level = match finding.severity {
        Severity::Warning => 30,
        Severity::Error => 40,
    };
    let name = format!("twin.{}", finding.code.as_str());
    let marks = markers::finding(story, index);
    let mut all = vec![(&LOG, log(story, ns, level, &name, &words))];
    if !marks.is_empty() {
        all.push((&FINDINGS, markers::array(&marks, ns)));
    }
    all
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
