use slam::document::Allowance;
use slam::{Span, Spanned};

use crate::parts::{Allowed, Severity, Verdict};
use crate::{Baseline, ReadError, apply_allowances, fails, from_json, human, sample, to_json};

fn allowance(code: &str, strand: Option<&str>, until: &str) -> Allowance {
    let placed = |text: &str| Spanned::new(text.to_owned(), Span::default());
    Allowance {
        code: placed(code),
        strand: strand.map(placed),
        reason: placed("seen on the machine"),
        until: placed(until),
    }
}

#[test]
fn an_allowance_holds_through_its_last_day() {
    for (today, holds) in [("2027-01-30", true), ("2027-01-31", true), ("2027-02-01", false)] {
        let mut report = sample::report();
        let said =
            apply_allowances(&mut report, &[allowance("C201", Some("s7"), "2027-01-31")], today);
        assert_eq!(report.findings[0].allowed.is_some(), holds, "{today}");
        assert_eq!(report.findings[1].allowed, None);
        assert_eq!(fails(&report, Severity::Error, None), !holds);
        assert!(fails(&report, Severity::Warning, None), "the warning is not let pass");
        assert_eq!((report.verdict, report.score), (Verdict::Infeasible, Some(0.0)));
        match holds {
            true => assert_eq!(said, Vec::<String>::new()),
            false => assert_eq!(
                said,
                ["C201 on strand `s7` was allowed until 2027-01-31; it counts again"]
            ),
        }
    }
}

#[test]
fn an_allowance_nobody_needs_is_told() {
    let mut report = sample::report();
    let list = [allowance("C201", Some("s3"), "2027-01-31"), allowance("P301", None, "2027-01-31")];
    let said = apply_allowances(&mut report, &list, "2026-11-22");
    assert_eq!(said.len(), 2);
    assert_eq!(
        said[0],
        "C201 on strand `s3` is allowed until 2027-01-31, but not found: take the entry out"
    );
    assert!(report.findings.iter().all(|finding| finding.allowed.is_none()));
    let said = apply_allowances(&mut report, &[allowance("C201", None, "2027-01-31")], "today");
    assert_eq!(said, ["`today` is no day, so no finding is let pass"]);
    assert!(fails(&report, Severity::Error, None));
}

#[test]
fn what_was_there_before_does_not_fail() {
    let old = sample::report();
    let mut new = sample::report();
    let baseline = Baseline::of(&old);
    assert!(!fails(&new, Severity::Warning, Some(&baseline)));
    new.findings[0].site.strand = Some("s9".to_owned());
    assert!(fails(&new, Severity::Error, Some(&baseline)));
    new.findings.remove(0);
    new.findings[0].severity = Severity::Error;
    assert!(fails(&new, Severity::Error, Some(&baseline)), "a warning became an error");
}

#[test]
fn the_terminal_says_why() {
    let mut report = sample::report();
    report.findings[0].allowed =
        Some(Allowed { reason: "seen on the machine".to_owned(), until: "2027-01-31".to_owned() });
    let text = human(&report, false, 80);
    assert!(
        text.contains("         allowed until 2027-01-31 because: seen on the machine\n"),
        "{text}"
    );
}

#[test]
fn a_report_is_read_back() {
    let mut report = sample::report();
    report.findings[0].allowed =
        Some(Allowed { reason: "r".to_owned(), until: "2027-01-31".to_owned() });
    let text = to_json(&report);
    assert_eq!(from_json(&text).as_ref(), Ok(&report));
    let older = to_json(&sample::report()).replace(",\n      \"allowed\": null", "");
    assert!(!older.contains("allowed"));
    assert_eq!(from_json(&older), Ok(sample::report()));
}

#[test]
fn what_is_no_report_is_refused_in_words() {
    let text = to_json(&sample::report());
    let said = |text: &str| from_json(text).expect_err("no report").to_string();
    assert!(said("").starts_with("this is no report: EOF"), "{}", said(""));
    assert!(said("[1]").starts_with("this is no report: "), "{}", said("[1]"));
    assert!(said("{}").contains("missing field `schema`"));
    let other = text.replace("twin-report/1", "twin-report/2");
    assert_eq!(
        said(&other),
        "the report's schema is \"twin-report/2\"; this twin reads \"twin-report/1\""
    );
    let lacking = text.replacen("\"verdict\": \"infeasible\",", "", 1);
    assert!(said(&lacking).contains("not whole: missing field `verdict`"), "{}", said(&lacking));
    assert!(said(&text[..text.len() / 2]).starts_with("this is no report: EOF"));
    assert!(matches!(from_json(&"[".repeat(100_000)), Err(ReadError::NotJson(_))));
    assert_eq!(
        ReadError::TooBig(7).to_string(),
        "the report has 7 bytes; at most 536870912 are read"
    );
}
