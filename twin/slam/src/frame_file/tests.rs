use proptest::prelude::*;

use super::*;

const POST: &str = r#"{
  "nodes": [[0, 0, 0], [0, 0, 100]],
  "members": [[0, 1]],
  "radius": [1.5],
  "fixed": [0],
  "E": 2400, "G": 880, "density": 1.1e-6
}"#;

fn wrong(text: &str) -> (usize, String) {
    let source = Source::new("frame.json", text);
    let problem = parse(&source).expect_err("something is wrong");
    (source.line_column(problem.span.start).0, problem.message)
}

#[test]
fn what_is_not_told_has_its_default() {
    let file = parse(&Source::new("frame.json", POST)).expect("a frame");
    assert_eq!(file.gravity_m_s2, [0.0, 0.0, -9.80665]);
    assert!(!file.shear && file.sequence.is_empty() && file.buckling.modes.is_none());
}

#[test]
fn every_fault_names_its_line() {
    for (was, is, line, words) in [
        ("[[0, 1]]", "[[0, 2]]", 3, "no node 2"),
        ("[1.5]", "[1.5, 2]", 4, "2 numbers for 1 members"),
        ("[1.5]", "[-1.5]", 4, "more than zero"),
        ("[0],", "[7],", 5, "no node 7"),
        ("\"E\": 2400", "\"E\": 0", 6, "more than zero"),
        ("1.1e-6", "-1", 6, "zero or more"),
        ("1.1e-6", "1, \"sequence\": [0, 0]", 6, "comes twice"),
        ("1.1e-6", "1, \"sequence\": [1]", 6, "no member 1"),
        ("1.1e-6", "1, \"buckling\": {\"modes\": 0}", 6, "from 1 to 100"),
        ("1.1e-6", "1, \"buckling\": {\"elements_per_member\": 65}", 6, "from 1 to 64"),
        ("[0, 0, 100]", "[0, 0]", 2, "invalid length 2"),
        ("\"fixed\": [0],", "\"fixed\": [0", 6, "expected"),
    ] {
        let (at, message) = wrong(&POST.replacen(was, is, 1));
        assert!(at == line && message.contains(words), "{is}: line {at}, {message}");
    }
}

proptest! {
    #[test]
    fn no_text_panics(cut in 0..POST.len(), put in "\\PC{0,8}") {
        let text = format!("{}{put}{}", &POST[..cut], &POST[cut..]);
        let _ = parse(&Source::new("frame.json", text));
    }
}
