//! The advice on speed does what it says.

use super::preflight;
use crate::finding::{Code, Severity};
use crate::test_job;

/// A bridge between two posts, printed at a speed; its sag behind the nozzle, m, the hint, and whether it is an error.
fn bridge(speed_mm_s: f64, flow: &str) -> Option<(f64, String, bool)> {
    let more = format!(r#", "speed_mm_s": {speed_mm_s} {flow}"#);
    let strands = [
        test_job::strand("one", &[[-15.0, 0.0, 0.0], [-15.0, 0.0, 10.0]], r#", "speed_mm_s": 3"#),
        test_job::strand("two", &[[15.0, 0.0, 0.0], [15.0, 0.0, 10.0]], r#", "speed_mm_s": 3"#),
        test_job::strand("bridge", &[[-15.0, 0.0, 10.0], [15.0, 0.0, 10.0]], &more),
    ];
    let text = test_job::text("printer-3axis", "", &strands.join(","));
    let checked = preflight(test_job::job(&text), |_| {}).expect("a small frame");
    let found = checked.findings().iter().find(|it| it.code == Code::P301);
    found.map(|it| (it.measured.nominal, it.hint.clone(), it.severity == Severity::Error))
}

#[test]
fn who_follows_the_hint_is_let_through() {
    for (asked_mm_s, flow) in
        [(11.2, ""), (14.0, ""), (20.0, r#", "flow": { "diameter_mm": 1.5 }"#)]
    {
        let (sag_m, hint, is_error) = bridge(asked_mm_s, flow).expect("it sags");
        assert!(is_error, "{sag_m} m at {asked_mm_s} mm/s");
        let told = hint.split_whitespace().nth(2).and_then(|word| word.parse::<f64>().ok());
        let told_mm_s = told.unwrap_or_else(|| panic!("no speed in {hint}"));
        assert!(told_mm_s < asked_mm_s && told_mm_s > 0.05 * asked_mm_s, "{hint}");
        let then = bridge(told_mm_s, flow);
        assert!(
            then.is_none_or(|(_, _, is_error)| !is_error),
            "still an error at {told_mm_s} mm/s"
        );
    }
}
