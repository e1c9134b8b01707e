use super::{Diagnostic, Source, Span, quoted};

#[test]
fn lines_and_columns_count_characters_from_one() {
    let source = Source::new("f", "aé\nb");
    for (offset, place) in
        [(0, (1, 1)), (1, (1, 2)), (2, (1, 2)), (3, (1, 3)), (4, (2, 1)), (99, (2, 2))]
    {
        assert_eq!(source.line_column(offset), place, "{offset}");
    }
}

#[test]
fn fancy_shows_line_caret_place_and_hints() {
    let source = Source::new("dir/job.slam", "{\n\t\"é\": 1, \"sped\": 2\n}\n");
    let start = source.text.find("\"sped").unwrap();
    let problem = Diagnostic::error(Span { start, end: start + 6 }, "unknown key")
        .hint("did you mean \"speed\"?");
    let text = source.fancy(&[problem.clone(), problem], false);
    assert!(text.contains("error: unknown key\n"), "{text}");
    assert!(text.contains("dir/job.slam:2:10\n"), "{text}");
    assert!(text.contains("^^^^^^\n"), "{text}");
    assert!(text.contains("help: did you mean \"speed\"?"), "{text}");
    let lines: Vec<_> = text.lines().collect();
    let source_line = lines.iter().position(|line| line.contains("\"sped\": 2")).unwrap();
    let column = |line: &str, what: char| line.chars().position(|letter| letter == what);
    let quote = lines[source_line].chars().collect::<Vec<_>>();
    let caret = column(lines[source_line + 1], '^').unwrap();
    assert_eq!((quote[caret], quote[caret + 1]), ('"', 's'), "{text}");
    assert!(!text.contains('\u{1b}'));
    assert!(source.fancy(&[Diagnostic::warning(Span::default(), "w")], true).contains('\u{1b}'));
}

#[test]
fn long_lines_are_clipped_and_places_kept() {
    let source = Source::new("f", format!("{}bad{}", "é".repeat(1_000_000), "x".repeat(5_000_000)));
    let start = source.text.find("bad").unwrap();
    let problem = Diagnostic::error(Span { start, end: source.text.len() }, "wrong");
    let text = source.fancy(&[problem], false);
    assert!(text.len() < 2000, "{}", text.len());
    assert!(text.contains("f:1:1000001") && text.contains("ébad") && text.contains('…'), "{text}");
}

#[test]
fn places_at_the_edges_do_not_panic() {
    for text in ["", "\n", "é", "a\r\n\tb\r\n"] {
        let source = Source::new("f", text);
        for start in 0..text.len() + 3 {
            for end in 0..text.len() + 3 {
                let fancy = source.fancy(&[Diagnostic::error(Span { start, end }, "m")], false);
                let (line, column) = source.line_column(start);
                assert!(
                    fancy.contains(&format!("f:{line}:{column}")),
                    "{text:?} {start} {end}: {fancy}"
                );
            }
        }
    }
}

#[test]
fn quotes_are_clipped_and_harmless() {
    assert_eq!(quoted("a\u{1b}\"é'"), "\"a\\u{1b}\\\"é'\"");
    assert_eq!(quoted(&"x".repeat(100)).chars().count(), 63);
}
