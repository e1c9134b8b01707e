//! What must not change an answer does not.

use std::path::Path;

use serde_json::Value;
use sim::pose::{Vector, from_xyz_rpy};

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

/// Printing a far strand first changes nothing for the others but their stage and time. Their
/// clock starts elsewhere, so numbers made of times agree to rounding, not to the bit.
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
    let (without, with) = (strands("far-without", text("")), strands("far-with", text(far)));
    assert_eq!(without.len(), with.len());
    without.iter().zip(&with).for_each(|(a, b)| same(a, b));
}

/// The same but for rounding.
fn same(a: &Value, b: &Value) {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().expect("a number"), b.as_f64().expect("a number"));
            assert!((a - b).abs() <= 1e-9 * a.abs().max(1e-9), "{a} and {b}");
        }
        (Value::Array(a), Value::Array(b)) => {
            assert_eq!(a.len(), b.len());
            a.iter().zip(b).for_each(|(a, b)| same(a, b));
        }
        (Value::Object(a), Value::Object(b)) => {
            assert!(a.keys().eq(b.keys()));
            a.values().zip(b.values()).for_each(|(a, b)| same(a, b));
        }
        _ => assert_eq!(a, b),
    }
}

/// The cell of the KR 6 seen from axes elsewhere: every pose in it is written anew, gravity turns.
pub(crate) fn elsewhere(folder: &Path) {
    let library = |name: &str| {
        std::fs::read_to_string(root().join("robots").join(name)).expect("a file of the library")
    };
    let write = |name: &str, text: String| {
        std::fs::write(folder.join(name), text).expect("the temporary folder can be written");
    };
    let (xyz_m, rpy_rad) = ([0.3, -0.7, 0.25], [0.35, -0.6, 1.05]);
    let world_from_base = from_xyz_rpy(xyz_m, rpy_rad);
    let bed = world_from_base * from_xyz_rpy([0.640, 0.060, 0.025], [0.0; 3]);
    let (roll, pitch, yaw) = bed.rotation.euler_angles();
    let [x, y, z] = <[f64; 3]>::from(bed.translation.vector * 1e3);
    let [rx, ry, rz] = [roll, pitch, yaw].map(f64::to_degrees);
    let down = world_from_base * Vector::new(0.0, 0.0, -9.80665);
    let urdf = library("kuka/kr6_r900_sixx/robot.urdf").replacen(
        "<link name=\"base_link\">",
        &format!(
            "<link name=\"world\"/><joint name=\"stand\" type=\"fixed\"><parent link=\"world\"/><child link=\"base_link\"/><origin xyz=\"{} {} {}\" rpy=\"{} {} {}\"/></joint>\n  <link name=\"base_link\">",
            xyz_m[0], xyz_m[1], xyz_m[2], rpy_rad[0], rpy_rad[1], rpy_rad[2]
        ),
        1,
    );
    let cell = library("cells/kr6-hot-end.toml")
        .replace("\"kuka/kr6_r900_sixx\"", "\"robot.urdf\"")
        .replace("base = \"base_link\"", "base = \"world\"")
        .replace(
            "io = []",
            &format!("io = []\ngravity_m_s2 = [{:?}, {:?}, {:?}]", down.x, down.y, down.z),
        )
        .replace(
            "pose = { xyz_mm = [640, 60, 25] }",
            &format!(
                "pose = {{ xyz_mm = [{x:?}, {y:?}, {z:?}], rpy_deg = [{rx:?}, {ry:?}, {rz:?}] }}"
            ),
        );
    write("robot.urdf", urdf);
    write("robot.toml", library("kuka/kr6_r900_sixx/robot.toml"));
    write("cell.toml", cell);
}

/// Moved and turned with all that stands in it, the cell finds the same.
#[test]
fn moving_the_whole_cell_changes_no_finding() {
    let folder = scratch("moved-cell");
    elsewhere(&folder);
    for name in ["two-strands", "lattice", "near-miss-r105", "near-miss-c206"] {
        let file = if name.starts_with("near") { "past.slam" } else { "job.slam" };
        let text = std::fs::read_to_string(root().join("scenarios").join(name).join(file))
            .expect("a scenario")
            .replace("kr10-cone", "kr6-hot-end");
        let findings = |kind: &str, text: String| {
            let job = folder.join(format!("{name}-{kind}.slam"));
            std::fs::write(&job, text).expect("written");
            let (ran, report) = check(&job, &folder.join(kind));
            let report = report.unwrap_or_else(|| panic!("{name} {kind}: {}", ran.err));
            let told = report["findings"].as_array().cloned().expect("findings");
            let plain = |finding: &Value| {
                let of = |key: &str| finding[key].clone();
                Value::Array(["code", "severity", "site", "measured", "limit"].map(of).into())
            };
            Value::Array(told.iter().map(plain).collect())
        };
        let here = findings("here", text.clone());
        let there = findings("there", text.replace("\"kr6-hot-end\"", "\"cell.toml\""));
        close(&here, &there, name);
    }
}

/// Numbers within a micrometre or a millionth, all else alike.
fn close(a: &Value, b: &Value, name: &str) {
    match (a, b) {
        (Value::Number(x), Value::Number(y)) => {
            let (x, y) = (x.as_f64().expect("a number"), y.as_f64().expect("a number"));
            assert!((x - y).abs() <= 1e-6 + 1e-6 * x.abs(), "{name}: {x} and {y}");
        }
        (Value::Array(x), Value::Array(y)) => {
            assert_eq!(x.len(), y.len(), "{name}: {a} and {b}");
            x.iter().zip(y).for_each(|(x, y)| close(x, y, name));
        }
        (Value::Object(x), Value::Object(y)) => {
            x.values().zip(y.values()).for_each(|(x, y)| close(x, y, name));
        }
        _ => assert_eq!(a, b, "{name}"),
    }
}
