use serde_json::Value;
use sim::interval::Interval;

use crate::sample;
use crate::{Report, schema, to_json};

fn value(report: &Report) -> Value {
    serde_json::from_str(&to_json(report)).expect("what was written can be read")
}

#[test]
fn a_report_fits_its_schema() {
    let schema = schema();
    let validator = jsonschema::validator_for(&schema).expect("a sound schema");
    let report = value(&sample::report());
    let errors: Vec<String> =
        validator.iter_errors(&report).map(|error| error.to_string()).collect();
    assert_eq!(errors, Vec::<String>::new());
}

#[test]
fn the_schema_refuses_what_is_no_report() {
    let schema = schema();
    let validator = jsonschema::validator_for(&schema).expect("a sound schema");
    let whole = value(&sample::report());
    let parts: Vec<String> = whole.as_object().expect("an object").keys().cloned().collect();
    for part in &parts {
        let mut less = whole.clone();
        less.as_object_mut().expect("an object").remove(part);
        assert!(!validator.is_valid(&less), "without {part}");
    }
    for (pointer, wrong) in [
        ("/verdict", "perhaps"),
        ("/findings/0/severity", "fatal"),
        ("/findings/0/code", "X1"),
        ("/findings/0/site/phase", "printing"),
        ("/strands/0/ends", "BothHeld"),
        ("/motion/ik_coverage", "some"),
    ] {
        let mut other = whole.clone();
        *other.pointer_mut(pointer).expect(pointer) = wrong.into();
        assert!(!validator.is_valid(&other), "{pointer}");
    }
    let mut site = whole.clone();
    site.pointer_mut("/findings/0/site")
        .and_then(Value::as_object_mut)
        .expect("a site")
        .remove("node");
    assert!(!validator.is_valid(&site), "a null is written, not left out");
}

#[test]
fn parts_come_in_the_order_of_the_design() {
    let text = to_json(&sample::report());
    let parts = [
        "schema",
        "name",
        "verdict",
        "score",
        "scores",
        "findings",
        "strands",
        "stages",
        "landings",
        "motion",
        "loads",
        "totals",
        "assumptions",
        "provenance",
        "timing",
    ];
    let places: Vec<usize> =
        parts.iter().map(|part| text.find(&format!("\n  \"{part}\":")).expect(part)).collect();
    assert!(places.is_sorted(), "{places:?}");
    assert!(text.ends_with("}\n"));
}

#[test]
fn a_family_without_checks_scores_null() {
    let report = value(&sample::report());
    assert_eq!(report["scores"]["E"], Value::Null);
    assert_eq!(report["scores"]["C"], 0.0);
}

#[test]
fn numbers_that_are_not_finite_are_null() {
    let range =
        crate::fill::range(Interval { nominal: 1.0, low: f64::NEG_INFINITY, high: f64::NAN });
    assert_eq!((range.value, range.low, range.high), (Some(1.0), None, None));
}

#[test]
fn a_report_survives_writing_and_reading() {
    let report = sample::report();
    let back: Report = serde_json::from_str(&to_json(&report)).expect("our own text");
    assert_eq!(back, report);
    assert_eq!(to_json(&back), to_json(&report));
}
