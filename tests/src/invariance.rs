//! What must not change an answer does not.

use serde_json::Value;

use crate::tools::{check, root, scratch, twin};

/// The report without what may differ between runs.
fn comparable(mut report: Value) -> String {
    let fields = report.as_object_mut().expect("a report is an object");
    fields.remove("timing");
    fields.remove("provenance");
    serde_json::to_string_pretty(&report).expect("JSON")
}

/// One thread or two, the same bytes.
#[test]
fn threads_do_not_change_the_report() {
    let job = root().join("scenarios/lattice/job.slam");
    let mut reports = Vec::new();
    for threads in ["1", "2"] {
        let folder = scratch(&format!("threads-{threads}"));
        let (job, out) = (job.display().to_string(), folder.display().to_string());
        twin(["check", &job, "--no-render", "--out", &out, "--jobs", threads]);
        let text = std::fs::read_to_string(folder.join("report.json")).expect("a report");
        reports.push(comparable(serde_json::from_str(&text).expect("JSON")));
    }
    assert_eq!(reports[0], reports[1]);
}

/// Printing a far strand first changes nothing for the others but their stage and time.
#[test]
fn a_far_strand_does_not_disturb_the_others() {
    let text = |far: &str| {
        format!(
            r#"{{ "slam": 1, "name": "far", "cell": "kr6-hot-end", "material": "pla",
            "process": {{ "speed_mm_s": 2, "flow": {{ "diameter_mm": 1.2 }} }},
            "strands": [{far}
              {{ "id": "a", "points_mm": [[0, 0, 0.6], [40, 0, 0.6]], "on": "bed" }},
              {{ "id": "b", "points_mm": [[0, 0, 1.2], [20, 0, 20]] }} ] }}"#
        )
    };
    let far = r#"{ "id": "far", "points_mm": [[0, 200, 0.6], [20, 200, 0.6]], "on": "bed" },"#;
    let strands = |name: &str, text: String| {
        let folder = scratch(name);
        let job = folder.join("job.slam");
        std::fs::write(&job, text).expect("written");
        let (ran, report) = check(&job, &folder);
        let report = report.unwrap_or_else(|| panic!("{}", ran.err));
        let mut strands = report["strands"].as_array().cloned().expect("strands");
        strands.retain(|strand| strand["id"] != "far");
        for strand in &mut strands {
            let fields = strand.as_object_mut().expect("a strand is an object");
            for changed in ["start_s", "end_s", "line", "motion"] {
                fields.remove(changed);
            }
        }
        strands
    };
    assert_eq!(strands("far-without", text("")), strands("far-with", text(far)));
}
