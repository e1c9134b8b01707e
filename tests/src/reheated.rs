//! A hot nozzle that comes back warms what it touches: more the slower, nothing where light sets.

use serde_json::Value;

use crate::tools::{check, scratch};

/// Two posts, grown cold, and a strand laid over them, its axis 1 mm higher, at a speed and with a wait at its end; the
/// report.
fn over_posts(folder: &str, cell: &str, material: &str, speed_mm_s: f64, dwell_s: f64) -> Value {
    let folder = scratch(folder);
    let path = folder.join("job.slam");
    let job = format!(
        r#"{{"slam": 1, "name": "over", "cell": "{cell}", "material": "{material}", "strands": [
            {{"id": "left", "points_mm": [[0, 0, 0], [0, 0, 10]], "speed_mm_s": 3}},
            {{"id": "right", "points_mm": [[12, 0, 0], [12, 0, 10]], "speed_mm_s": 3, "dwell_s": 90}},
            {{"id": "over", "points_mm": [[0, 0, 11], [12, 0, 11]], "speed_mm_s": {speed_mm_s}, "dwell_s": {dwell_s}}}
        ]}}"#
    );
    std::fs::write(&path, job).expect("written");
    let (ran, report) = check(&path, &folder.join("out"));
    report.unwrap_or_else(|| panic!("{}", ran.err))
}

/// Low, nominal and high peak of a post, K; `None`: not told.
fn peak_k(report: &Value, id: &str) -> Option<[f64; 3]> {
    let strands = report["strands"].as_array().expect("strands");
    let strand = strands.iter().find(|strand| strand["id"] == id).expect("the strand");
    let peak = strand["reheated"].as_object()?.get("peak_k")?;
    let number = |key: &str| peak[key].as_f64().expect("a number");
    Some([number("low"), number("value"), number("high")])
}

#[test]
fn a_slow_nozzle_warms_the_post_more() {
    let peak = |name: &str, speed_mm_s, dwell_s| {
        let report = over_posts(name, "kr6-hot-end", "abs", speed_mm_s, dwell_s);
        assert_eq!(peak_k(&report, "over"), None, "nothing comes after it");
        peak_k(&report, "right").expect("the strand over it touches it")
    };
    let (fast, slow) = (peak("reheat-fast", 4.0, 0.0), peak("reheat-slow", 1.0, 0.0));
    let waiting = peak("reheat-waiting", 4.0, 5.0);
    for [low, nominal, high] in [fast, slow, waiting] {
        assert!(296.0 < low && low <= nominal && nominal <= high && high < 513.2, "{low} {high}");
    }
    assert!(slow[1] > fast[1] + 1.0, "{slow:?} {fast:?}");
    assert!(waiting[1] > fast[1] + 5.0, "{waiting:?} {fast:?}");
}

#[test]
fn a_nozzle_of_resin_warms_nothing() {
    let report = over_posts("reheat-resin", "kirkman-sda10d", "sla-resin-silica", 3.0, 0.0);
    assert_eq!(peak_k(&report, "left"), None);
}
