use crate::parts::{Finding, Report, Severity, Site, Verdict};
use crate::{Baseline, diff, sample};

/// The sample with a strand renamed in its error, and the warning mended.
fn later() -> Report {
    let mut report = sample::report();
    report.findings[0].site.strand = Some("s9".to_owned());
    report.findings.pop();
    let mut worse = sample::near_stop();
    (worse.measured, worse.severity) = (Some(0.01), Severity::Error);
    report.findings.push(worse);
    report.score = Some(10.0);
    report.totals.time_s = Some(4095.74);
    report.loads.clear();
    report
}

#[test]
fn a_report_does_not_differ_from_itself() {
    let report = sample::report();
    let same = diff(&report, &report);
    assert!(same.added.is_empty() && same.gone.is_empty() && same.changed.is_empty());
    assert_eq!(same.n_same, 2);
    assert!(same.metrics.iter().all(|change| change.a == change.b));
    assert!(same.metrics.iter().all(|change| change.absolute.is_none_or(|by| by == 0.0)));
    assert_eq!(same.to_text(), "tower -> tower: infeasible as before\n\n2 findings as before\n");
}

#[test]
fn findings_come_go_and_change() {
    let (a, b) = (sample::report(), later());
    let diff = diff(&a, &b);
    let strands = |list: &[Finding]| -> Vec<Option<String>> {
        list.iter().map(|finding| finding.site.strand.clone()).collect()
    };
    assert_eq!(strands(&diff.added), [Some("s9".to_owned())]);
    assert_eq!(strands(&diff.gone), [Some("s7".to_owned())]);
    assert_eq!(diff.changed.len(), 1);
    assert_eq!(
        (diff.changed[0].a.severity, diff.changed[0].b.severity),
        (Severity::Warning, Severity::Error)
    );
    let time = diff.metrics.iter().find(|change| change.name == "time").expect("time");
    assert!((time.absolute.expect("both") - 372.34).abs() < 1e-9);
    assert!((time.relative.expect("both") - 0.1).abs() < 1e-4);
    let score = &diff.metrics[0];
    assert_eq!(
        (score.a, score.b, score.absolute, score.relative),
        (Some(0.0), Some(10.0), Some(10.0), None)
    );
    let load = diff.metrics.iter().find(|change| change.name.contains("seat")).expect("of A alone");
    assert_eq!((load.a, load.b, load.absolute), (Some(2.4e-3), None, None));
    insta::assert_snapshot!(diff.to_text(), @r"
    tower -> tower: infeasible as before
      score                                      0.00 ->         10.0  +10.0
      time                                    1:02:03 ->      1:08:16  +372 s (+10.0 %)
      load seat: deflection                   2.40 mm ->            –
      load seat: first yield at                  3.20 ->            –
      load seat: buckling at                     8.50 ->            –

    new: 1 error, 0 warnings
      error C201 nozzle comes within 0.31 mm of s3 in the print of strand `s7` (0.31 mm (-0.19 to 0.81), at least 1.00 mm; worst of 12)

    gone: 1 error, 0 warnings
      error C201 nozzle comes within 0.31 mm of s3 in the print of strand `s7` (0.31 mm (-0.19 to 0.81), at least 1.00 mm; worst of 12)

    changed: 1 finding
      warning became error: R102 joint a4 is 2.0° from its stop on strand `s7` at 4.0 mm (was 2.00°, is 0.57°)

    0 findings as before
    ");
}

#[test]
fn a_difference_is_json_and_fits_its_schema() {
    let text = diff(&sample::report(), &later()).to_json();
    let value: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let schema = serde_json::to_value(schemars::schema_for!(super::Diff)).expect("JSON");
    let validator = jsonschema::validator_for(&schema).expect("a sound schema");
    let errors: Vec<String> =
        validator.iter_errors(&value).map(|error| error.to_string()).collect();
    assert_eq!(errors, Vec::<String>::new());
    assert_eq!(value["schema"], "twin-diff/1");
    assert_eq!(value["metrics"][0].get("shown"), None);
}

#[test]
fn a_changed_verdict_is_said_first() {
    let mut b = sample::report();
    b.verdict = Verdict::Feasible;
    let text = diff(&sample::report(), &b).to_markdown();
    assert!(text.starts_with("## tower → tower: was infeasible, is feasible\n"), "{text}");
}

#[test]
fn differing_the_other_way_mirrors() {
    let (there, back) = (diff(&sample::report(), &later()), diff(&later(), &sample::report()));
    assert_eq!((&there.added, &there.gone), (&back.gone, &back.added));
    assert_eq!((there.changed.len(), there.n_same), (back.changed.len(), back.n_same));
}

#[test]
fn many_findings_are_cut_short() {
    let mut b = sample::report();
    b.findings = (0..500)
        .map(|n| Finding {
            site: Site { strand: Some(format!("x{n}")), ..Site::default() },
            ..sample::too_near()
        })
        .collect();
    let text = diff(&sample::report(), &b).to_text();
    assert!(
        text.contains("new: 500 errors, 0 warnings") && text.contains("and 450 more"),
        "{text}"
    );
    assert!(text.lines().count() < 80);
}

#[test]
fn a_baseline_knows_what_was_there_and_no_more() {
    let (old, new) = (sample::report(), later());
    let baseline = Baseline::of(&old);
    assert!(old.findings.iter().all(|finding| baseline.knows(finding)));
    // s9 was not there, and the warning has become an error
    assert_eq!(baseline.new_in(&new).len(), 2);
    let mut milder = sample::too_near();
    (milder.severity, milder.line, milder.measured) = (Severity::Warning, Some(900), Some(0.0009));
    assert!(baseline.knows(&milder), "an error that became a warning is known");
}
