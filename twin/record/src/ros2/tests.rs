//! CDR against bytes made by hand from the rules of alignment, and the texts of the messages.

use std::collections::BTreeSet;

use sim::film::Film;

use super::cdr::Cdr;
use super::{qos, schema};
use crate::Profile;
use crate::mcap::tests::{read, with_pictures};
use crate::sample;

/// Reads what [`Cdr`] writes.
struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    /// After the four bytes of the header, from which alignment counts.
    fn new(bytes: &'a [u8]) -> Self {
        Self { bytes: &bytes[4..], at: 0 }
    }

    fn raw(&mut self, size: usize, align: usize) -> &'a [u8] {
        self.at = self.at.next_multiple_of(align);
        self.at += size;
        &self.bytes[self.at - size..self.at]
    }

    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.raw(4, 4).try_into().expect("four"))
    }

    fn f64s(&mut self, many: usize) -> Vec<f64> {
        (0..many).map(|_| f64::from_le_bytes(self.raw(8, 8).try_into().expect("eight"))).collect()
    }

    fn text(&mut self) -> String {
        let size = self.u32() as usize;
        let bytes = self.raw(size, 1);
        String::from_utf8(bytes[..size - 1].to_vec()).expect("UTF-8")
    }

    /// Stamp and frame.
    fn header(&mut self) -> String {
        self.raw(8, 4);
        self.text()
    }
}

/// What a test asks of a marker.
struct Seen {
    frame: String,
    group: String,
    kind: u32,
    points: usize,
}

/// Field by field as RViz reads it; the last byte is read.
fn markers(bytes: &[u8]) -> Vec<Seen> {
    let mut from = Reader::new(bytes);
    let count = from.u32();
    let all = (0..count).map(|_| {
        let (frame, group) = (from.header(), from.text());
        let [_id, kind, _action] = std::array::from_fn(|_| from.u32());
        let place = from.f64s(10);
        assert!(place.iter().all(|x| x.is_finite()) && place[7] >= 0.0, "pose and size");
        let colour = from.raw(16, 4);
        assert_eq!(colour[12..], 1f32.to_le_bytes(), "not to be seen through");
        from.raw(8, 4);
        assert_eq!(from.raw(1, 1), [1], "locked to its frame");
        let points = from.u32() as usize;
        assert!(from.f64s(3 * points).iter().all(|x| x.is_finite()));
        assert_eq!((from.u32(), from.text().as_str()), (0, ""));
        assert_eq!(from.header(), "");
        assert_eq!((from.text().as_str(), from.u32(), from.u32()), ("", 0, 0));
        from.text();
        assert_eq!((from.text().as_str(), from.text().as_str(), from.u32()), ("", "", 0));
        from.raw(1, 1);
        Seen { frame, group, kind, points }
    });
    let all: Vec<Seen> = all.collect();
    assert_eq!(from.at, from.bytes.len(), "read to the end");
    all
}

#[test]
fn markers_are_whole_and_in_frames_that_are_told() {
    let checked = sample::tent();
    let film = Film::new(checked);
    let (bytes, _) = with_pictures(checked, &film, Profile::Ros2, &[]);
    let (messages, _) = read(&bytes);
    let mut frames: BTreeSet<String> = BTreeSet::from(["world".to_owned()]);
    for (_, _, _, bytes) in messages.iter().filter(|it| it.1 == "tf2_msgs/msg/TFMessage") {
        let mut from = Reader::new(bytes);
        for _ in 0..from.u32() {
            assert_eq!(from.header(), "world");
            frames.insert(from.text());
            from.f64s(7);
        }
    }
    let of = |topic: &str| -> Vec<Seen> {
        messages.iter().filter(|it| it.0 == topic).flat_map(|it| markers(&it.3)).collect()
    };
    let (cell, print, found) = (of("/scene/cell"), of("/scene/print"), of("/scene/findings"));
    assert_eq!(cell.len(), film.bodies.len() + 1, "all bodies and the bed");
    assert!(cell.iter().all(|it| it.kind == 11 && it.points > 0 && it.points % 3 == 0));
    assert!(print.iter().all(|it| it.kind == 4 && it.frame == "part" && it.points >= 2));
    assert!(print.iter().any(|it| it.group == "strand/1"));
    let placed = film.findings.iter().filter(|it| it.at.is_some()).count();
    assert_eq!(found.len(), 2 * placed);
    for marker in cell.iter().chain(&print).chain(&found) {
        assert!(frames.contains(&marker.frame), "{} of {frames:?}", marker.frame);
    }
}

#[test]
fn numbers_are_aligned_from_the_end_of_the_header() {
    let mut cdr = Cdr::new();
    cdr.u8(7).f64(1.0).u8(1).u32(2).bool(true).f32(0.5);
    let expected = [
        &[0, 1, 0, 0][..],
        &[7, 0, 0, 0, 0, 0, 0, 0],
        &[0, 0, 0, 0, 0, 0, 0xF0, 0x3F],
        &[1, 0, 0, 0],
        &[2, 0, 0, 0],
        &[1, 0, 0, 0],
        &[0, 0, 0, 0x3F],
    ];
    assert_eq!(cdr.into_bytes(), expected.concat());
}

#[test]
fn texts_end_with_a_zero_that_is_counted() {
    let mut cdr = Cdr::new();
    cdr.text("abc").text("").text("a\0b").i32(-1);
    let expected = [
        &[0, 1, 0, 0][..],
        &[4, 0, 0, 0, b'a', b'b', b'c', 0],
        &[1, 0, 0, 0, 0, 0, 0, 0],
        // the zero inside became U+FFFD, three bytes
        &[6, 0, 0, 0, b'a', 0xEF, 0xBF, 0xBD, b'b', 0, 0, 0],
        &[0xFF, 0xFF, 0xFF, 0xFF],
    ];
    assert_eq!(cdr.into_bytes(), expected.concat());
}

#[test]
fn a_header_and_doubles_are_laid_out_as_ros_does() {
    // sensor_msgs/msg/JointState of one joint "a", position 1.0
    let mut cdr = Cdr::new();
    super::header(&mut cdr, 3_000_000_004, "");
    cdr.count(1).text("a").count(1).f64s(&[1.0]).count(0).count(0);
    let expected = [
        &[0, 1, 0, 0][..],
        // stamp, empty frame_id, padding
        &[3, 0, 0, 0, 4, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0],
        // one name: length 2, "a\0", padding
        &[1, 0, 0, 0, 2, 0, 0, 0, b'a', 0, 0, 0],
        // one position: the count ends at 32, where a double may stand
        &[1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xF0, 0x3F],
        &[0, 0, 0, 0, 0, 0, 0, 0],
    ];
    assert_eq!(cdr.into_bytes(), expected.concat());
}

#[test]
fn each_text_holds_every_message_it_needs_once() {
    for name in [
        "tf2_msgs/msg/TFMessage",
        "sensor_msgs/msg/JointState",
        "visualization_msgs/msg/MarkerArray",
        "std_msgs/msg/String",
        "rcl_interfaces/msg/Log",
    ] {
        let text = schema(name);
        assert!(!text.is_empty(), "{name}");
        for line in text.lines().filter(|line| !line.starts_with("MSG: ")) {
            let kind = line.split([' ', '[']).next().unwrap_or_default();
            if kind.contains('/') {
                let many = text.matches(&format!("MSG: {kind}\n")).count();
                assert_eq!(many, 1, "{name} needs {kind}");
            }
        }
    }
    assert!(schema("std_msgs/msg/Nothing").is_empty());
}

#[test]
fn latched_topics_say_so() {
    assert!(qos(true).contains("durability: 1") && qos(false).contains("durability: 2"));
}
