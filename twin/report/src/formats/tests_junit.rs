use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use super::junit;
use super::tests::crowd;
use crate::parts::{Allowed, Report};
use crate::sample;

/// A case as another reader sees it.
#[derive(Debug, Default)]
pub(super) struct Case {
    pub(super) name: String,
    file: String,
    line: Option<String>,
    failure: Option<String>,
    skipped: Option<String>,
    text: String,
}

fn attribute(tag: &BytesStart<'_>, name: &str) -> Option<String> {
    let attribute = tag.try_get_attribute(name).expect("sound attributes")?;
    Some(attribute.unescape_value().expect("sound entities").into_owned())
}

/// Reads the file; the counts of each suite and of the whole must be those of the cases.
pub(super) fn cases(xml: &str) -> Vec<Case> {
    let mut reader = Reader::from_str(xml);
    reader.config_mut().check_end_names = true;
    let (mut all, mut depth): (Vec<Case>, i32) = (Vec::new(), 0);
    let mut promised = (0, 0);
    loop {
        let event = reader.read_event().expect("well-formed");
        match &event {
            Event::Start(tag) | Event::Empty(tag) => {
                depth += i32::from(matches!(event, Event::Start(_)));
                for each in tag.attributes() {
                    each.expect("sound").unescape_value().expect("sound");
                }
                let count = |name| {
                    attribute(tag, name).map_or(0, |n| n.parse::<usize>().expect("a number"))
                };
                match tag.name().as_ref() {
                    b"testsuites" => promised = (count("tests"), count("failures")),
                    b"testcase" => all.push(Case {
                        name: attribute(tag, "name").expect("a name"),
                        file: attribute(tag, "file").expect("a file"),
                        line: attribute(tag, "line"),
                        ..Case::default()
                    }),
                    b"failure" => {
                        all.last_mut().expect("a case").failure = attribute(tag, "message")
                    }
                    b"skipped" => {
                        all.last_mut().expect("a case").skipped = attribute(tag, "message")
                    }
                    _ => {}
                }
            }
            Event::End(_) => depth -= 1,
            Event::Text(text) => {
                let text = text.decode().expect("UTF-8").into_owned();
                if let Some(case) = all.last_mut() {
                    case.text.push_str(&text);
                }
            }
            Event::GeneralRef(_) | Event::Decl(_) => {}
            Event::Eof => break,
            other => panic!("no such thing is written: {other:?}"),
        }
    }
    assert_eq!(depth, 0);
    let failed = all.iter().filter(|case| case.failure.is_some()).count();
    assert_eq!(promised, (all.len(), failed));
    all
}

fn case(report: &Report, code: &str) -> Case {
    let all = cases(&junit(report, ""));
    all.into_iter().find(|case| case.name.starts_with(code)).expect("a case per code")
}

#[test]
fn there_is_a_case_per_code() {
    let all = cases(&junit(&sample::report(), ""));
    assert_eq!(all.len(), sim::finding::Code::ALL.len());
    for (case, code) in all.iter().zip(sim::finding::Code::ALL) {
        assert_eq!(case.name, format!("{} {}", code.as_str(), code.title()));
        assert_eq!(case.file, "job.slam");
        assert_eq!(case.failure.is_some(), code.as_str() == "C201");
        // nothing of family E was checked in the sample
        assert_eq!(case.skipped.is_some(), code.as_str().starts_with('E'), "{case:?}");
    }
}

#[test]
fn errors_fail_warnings_are_told_and_what_is_allowed_is_skipped() {
    let mut report = sample::report();
    let failed = case(&report, "C201");
    assert_eq!(failed.failure.as_deref(), Some(report.findings[0].message.as_str()));
    assert_eq!(failed.line.as_deref(), Some("12"));
    assert!(failed.text.contains("hint: print `s3` after this strand"), "{failed:?}");
    let warned = case(&report, "R102");
    assert!(warned.failure.is_none() && warned.skipped.is_none());
    assert!(warned.text.contains("warning: joint a4"), "{warned:?}");
    report.findings[0].allowed =
        Some(Allowed { reason: "r".to_owned(), until: "2027-01-31".to_owned() });
    let skipped = case(&report, "C201");
    assert_eq!(skipped.failure, None);
    assert_eq!(skipped.skipped.as_deref(), Some("allowed until 2027-01-31 because: r"));
    report.findings.push(sample::too_near());
    assert!(case(&report, "C201").failure.is_some(), "the other one still fails");
}

#[test]
fn a_code_of_a_newer_twin_is_told_too() {
    let mut report = crowd(3);
    report.findings[0].code = "X901".to_owned();
    let all = cases(&junit(&report, ""));
    assert_eq!(all.len(), sim::finding::Code::ALL.len() + 1);
    assert!(all.last().is_some_and(|case| case.name.starts_with("X901")));
}
