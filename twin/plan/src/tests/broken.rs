//! Designs and orders that cannot be used: each names what is wrong, at its place.

use proptest::prelude::*;
use slam::Source;

use super::{frame_text, options, plan, portal};
use crate::{Input, Options};

/// The message and line of the only remark.
fn only(text: &str, order: Option<&str>) -> (Input, String, usize) {
    let remarks = plan(text, order, &options()).expect_err("unusable");
    assert_eq!(remarks.len(), 1, "{remarks:?}");
    let read = if remarks[0].input == Input::Order { order.unwrap_or("") } else { text };
    let (line, _) = Source::new("f", read).line_column(remarks[0].diagnostic.span.start);
    (remarks[0].input, remarks[0].diagnostic.message.clone(), line)
}

#[test]
fn broken_frames_name_the_place() {
    let portal = portal();
    let cases = [
        (String::new(), "empty", 1),
        ("[".to_owned(), "not JSON", 1),
        ("[]".to_owned(), "a frame file must be an object", 1),
        ("[".repeat(100_000), "not JSON", 1),
        (portal.replace("\"unit\"", "\"units\""), "`unit` is missing", 1),
        (portal.replace("millimeter", "furlong"), "unknown unit `furlong`", 1),
        (portal.replace("node_list", "nodes"), "`node_list` is missing", 1),
        (portal.replace("\"XAxis\": {\"X\": 0,", "\"XAxis\": {\"X\": 1,"), "right angles", 2),
        (
            portal
                .replace("\"X\": -1", "\"X\": 1")
                .replace("}},\n\"node", "}, \"ZAxis\": {\"X\": 0, \"Y\": 0, \"Z\": 1}},\n\"node"),
            "right-handed",
            2,
        ),
        (portal.replace("\"OriginY\": 0, ", ""), "`OriginY` is missing", 2),
        (portal.replacen("\"Z\": 20", "\"Z\": 1e999", 1), "Z must be a finite number", 4),
        (portal.replacen("\"Z\": 20", "\"Z\": 1e300", 1), "kilometre", 4),
        (portal.replacen("\"Z\": 20", "\"Z\": \"20\"", 1), "Z must be a finite number", 4),
        (portal.replacen("\"Z\": 20", "\"W\": 20", 1), "`Z` is missing", 4),
        (portal.replacen("\"is_grounded\": 1", "\"is_grounded\": 2", 1), "must be 0 or 1", 4),
        (portal.replace("\"is_grounded\": 1", "\"is_grounded\": 0"), "no node is grounded", 4),
        (portal.replace("[1, 2]", "[1, 7]"), "element 0 ends at node 7, which is not there", 5),
        (portal.replace("[1, 2]", "[1]"), "two end nodes", 5),
        (portal.replace("[1, 2]", "[1, 1.5]"), "whole number", 5),
        (portal.replace("[1, 2]", "[1, 1]"), "element 0 has no length", 5),
        (portal.replace("[1, 2]", "[0, 1]"), "element 1 joins the same nodes as element 0", 5),
        (portal.replace("{\"point\"", "{\"node_id\": 4, \"point\""), "", 4),
        (frame_text(&[[0.0, 0.0, 0.0, 1.0]], &[]), "no element", 5),
    ];
    for (text, expected, line) in cases {
        if expected.is_empty() {
            // One remark per node after the first.
            assert_eq!(plan(&text, None, &options()).expect_err("unusable").len(), 3);
            continue;
        }
        let (input, message, found) = only(&text, None);
        assert_eq!(input, Input::Design);
        assert!(message.contains(expected), "{message} for {expected}");
        assert_eq!(found, line, "{message}");
    }
}

#[test]
fn broken_orders_name_the_element() {
    let cases = [
        ("", "the file is empty"),
        ("{}", "no order in this file"),
        ("3", "must be an object"),
        ("[[0, 1], [1, 2], [2, 3], 7]", "an entry of the order must be an array"),
        ("[[0, 1], [1, 2], [2, 3], [2, 3, 4]]", "a pair [from, to]"),
        ("[[0, 1], [1, 2]]", "element 2 [2, 3] is missing from the order"),
        ("[[0, 1], [1, 2], [2, 3], [3, 2]]", "element 2 [3, 2] is listed twice"),
        ("[[0, 1], [1, 2], [2, 3], [0, 2]]", "no element joins nodes 0 and 2"),
        ("[[0, 1], [1, 2], [2, 3], [0, 99]]", "no element joins nodes 0 and 99"),
        (r#"{"instances": {"test": {}}}"#, "`directed_elements` is missing"),
        (r#"{"instances": {"test": 1}}"#, "must be an object"),
    ];
    for (order, expected) in cases {
        let (input, message, _) = only(&portal(), Some(order));
        assert_eq!(input, Input::Order);
        assert!(message.contains(expected), "{message} for {expected}");
    }
}

#[test]
fn many_mistakes_are_counted_not_listed() {
    let elements: Vec<[usize; 2]> = (0..1000).map(|k| [0, 10 + k]).collect();
    let text = frame_text(&[[0.0, 0.0, 0.0, 1.0]], &elements);
    let remarks = plan(&text, None, &options()).expect_err("unusable");
    assert_eq!(remarks.len(), 50);
    assert_eq!(remarks[49].diagnostic.hints, ["950 more of these are not shown"]);
}

/// The text with some bytes replaced, cut out or doubled.
fn mutated(text: &str, edits: &[(usize, u8, u8)]) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for &(at, kind, byte) in edits {
        let at = at % bytes.len().max(1);
        match kind % 3 {
            0 if at < bytes.len() => bytes[at] = byte,
            1 if at < bytes.len() => bytes.truncate(at.max(bytes.len() / 2)),
            _ => bytes.insert(at.min(bytes.len()), byte),
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_text_panics(
        edits in prop::collection::vec((any::<usize>(), any::<u8>(), prop::sample::select(b"0123456789-.e{}[],:\"tn \n".to_vec())), 0..6),
        order_edits in prop::collection::vec((any::<usize>(), any::<u8>(), any::<u8>()), 0..3),
    ) {
        let text = mutated(&portal(), &edits);
        let order = mutated("[[0, 1], [1, 2], [2, 3]]", &order_edits);
        for order in [None, Some(order.as_str())] {
            match plan(&text, order, &options()) {
                Ok(planned) => {
                    let numbers = planned.document.placement.xyz_mm.expect("a place").value;
                    prop_assert!(numbers.iter().all(|number| number.is_finite()));
                }
                Err(remarks) => prop_assert!(!remarks.is_empty()),
            }
        }
    }

    #[test]
    fn no_csv_panics(edits in prop::collection::vec((any::<usize>(), any::<u8>(), any::<u8>()), 0..6)) {
        let text = mutated("strand,x_mm,y_mm,z_mm\na,0,0,0\na,1,0,0\nb,0,1,0\nb,1,1,0\n", &edits);
        let options = Options { file_stem: String::new(), ..options() };
        if let Err(remarks) = crate::curves(&Source::new("c.csv", text), &options) {
            prop_assert!(!remarks.is_empty());
        }
    }
}
