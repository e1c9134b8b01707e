//! CDR against bytes made by hand from the rules of alignment, and the texts of the messages.

use super::cdr::Cdr;
use super::{qos, schema};

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
