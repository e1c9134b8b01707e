//! A hundred faults of the structure planted into jobs, more than half of them within ten percent of a limit: missing
//! supports, floating strands, halved radii, swapped orders, doubled loads, weak nodes, landings that fail only by
//! their sum. Each must be found, on the right strand, with the right cause; and the job without it must be free of errors.

use serde_json::Value;

use crate::planting::{self, Expected, Fault, Files};

/// A job on the three-axis printer, in PLA.
fn job(limits: &str, strands: &str, more: &str) -> Files {
    let text = format!(
        r#"{{"slam": 1, "name": "planted", "cell": "printer-3axis", "material": "pla", "limits": {{{limits}}},
"strands": [{strands}]{more}}}"#
    );
    vec![("job.slam", text)]
}

fn strand(id: &str, points: &[[f64; 3]], more: &str) -> String {
    format!(r#"{{"id": "{id}", "points_mm": {points:?}, "speed_mm_s": 1.5{more}}}"#)
}

fn bead(diameter_mm: f64) -> String {
    format!(r#", "flow": {{"diameter_mm": {diameter_mm}}}"#)
}

/// A strut from the bed that leans out, and a strand that begins on its free end, where the nozzle pushes.
fn leaning(limits: &str, lean_mm: f64, more: &str) -> Files {
    let top = [lean_mm, 0.0, 12.0];
    let strut = strand("strut", &[[0.0; 3], top], more);
    let next = strand("next", &[top, [lean_mm + 6.0, 0.0, 20.0]], "");
    job(limits, &[strut, next].join(",\n"), "")
}

/// A bridge from one post to another, or to nothing, and a strand that begins on its far end.
fn portal(length_mm: f64, order: &[&str]) -> Files {
    let (left, right) = ([0.0, 0.0, 6.0], [length_mm, 0.0, 6.0]);
    // each is cold when the next comes
    let cools = r#", "dwell_s": 30"#;
    let strands = [
        strand("post1", &[[0.0; 3], left], cools),
        strand("post2", &[[length_mm, 0.0, 0.0], right], cools),
        strand("bridge", &[left, right], cools),
        strand("next", &[right, [length_mm + 4.0, 0.0, 14.0]], ""),
    ];
    let there: Vec<String> = strands
        .into_iter()
        .filter(|text| order.iter().any(|id| text.contains(&format!("\"{id}\""))))
        .collect();
    job("", &there.join(",\n"), &format!(r#", "sequence": {order:?}"#))
}

/// A bridge of ABS from a post to one that leans in, which its shrinkage and the nozzle bend the same way.
fn shrunk(lean_mm: f64) -> Files {
    let (left, right) = ([0.0, 0.0, 10.0], [60.0, 0.0, 10.0]);
    let strands = [
        strand("post1", &[[0.0; 3], left], ""),
        strand("post2", &[[60.0 + lean_mm, 0.0, 0.0], right], ""),
        strand("bridge", &[left, right], "").replace("1.5", "6"),
        strand("next", &[right, [60.0, 6.0, 18.0]], ""),
    ];
    let mut files = job(r#""node_miss_mm": 0.4"#, &strands.join(",\n"), "");
    files[0].1 = files[0].1.replace("\"pla\"", "\"abs\"");
    files
}

/// Two posts and a bridge, clamped at its feet, pushed down in the middle.
fn pressed(limits: &str, force_n: f64, feet: usize, more: &str) -> Files {
    let [left, right] = [-10.0, 10.0];
    let strands = [
        strand("post1", &[[left, 0.0, 0.0], [left, 0.0, 10.0]], more),
        strand("post2", &[[right, 0.0, 0.0], [right, 0.0, 10.0]], more),
        strand("bridge", &[[left, 0.0, 10.0], [right, 0.0, 10.0]], more),
    ];
    let foot = |x: f64| format!(r#"{{"at_mm": [{x:?}, 0, 0], "fix": "xyzr"}}"#);
    let feet: Vec<String> = [left, right].into_iter().take(feet).map(foot).collect();
    let loads = format!(
        r#", "loads": [{{"name": "push", "supports": [{}], "forces": [{{"at_mm": [0, 0, 10], "force_n": [0, 0, -{force_n:?}]}}]}}]"#,
        feet.join(", ")
    );
    job(limits, &strands.join(",\n"), &loads)
}

/// A rod from the bed straight up, pressed on its top or not.
fn rod(limits: &str, height_mm: f64, force_n: Option<f64>, more: &str) -> Files {
    let rod = strand("rod", &[[0.0; 3], [0.0, 0.0, height_mm]], more);
    let loads = force_n.map_or_else(String::new, |force_n| {
        format!(
            r#", "loads": [{{"name": "press", "supports": [{{"at_mm": [0, 0, 0], "fix": "xyzr"}}], "forces": [{{"at_mm": [0, 0, {height_mm:?}], "force_n": [0, 0, -{force_n:?}]}}]}}]"#
        )
    });
    job(limits, &rod, &loads)
}

/// A bar on the bed, a leaf that stands on it and leans out, and a strand that begins on the leaf.
fn leaf(limits: &str, gap_mm: f64, lean_mm: f64, pull_n: Option<f64>) -> Files {
    let top = [lean_mm, 0.0, 12.0];
    let strands = [
        strand("bar", &[[0.0, -30.0, 0.6], [0.0, 30.0, 0.6]], r#", "on": "bed""#),
        strand("leaf", &[[0.0, 0.0, 0.6 + gap_mm], top], ""),
        strand("next", &[top, [lean_mm + 6.0, 0.0, 20.0]], ""),
    ];
    let loads = pull_n.map_or_else(String::new, |pull_n| {
        format!(
            r#", "loads": [{{"name": "pull", "supports": [{{"at_mm": [0, -30, 0.6], "fix": "xyzr"}}, {{"at_mm": [0, 30, 0.6], "fix": "xyzr"}}], "forces": [{{"at_mm": [{lean_mm:?}, 0, 12], "force_n": [{pull_n:?}, 0, 0]}}]}}]"#
        )
    });
    let count = if pull_n.is_some() { 2 } else { 3 };
    job(limits, &strands[..count].join(",\n"), &loads)
}

const WIDE: &str = r#""node_miss_mm": 20, "clearance_mm": 0.5"#;
const STRONG: &str = r#""load_factor": 0.01"#;
const CLOSE: &str = r#""deflection_mm": 500, "node_miss_mm": 20, "clearance_mm": 0.5"#;
const BENDS: &str = r#""deflection_mm": 500, "node_miss_mm": 20"#;
const HIGH: &str = r#""buckling_factor": 200"#;

/// A fault: its number deep and none, the job, what is found where and why.
fn fault(
    name: &str,
    range: [f64; 2],
    files: impl Fn(f64) -> Files + Sync + 'static,
    (code, strand, says): (&'static str, &'static str, &'static str),
) -> Fault {
    let of = move |_: f64| Expected { code, strand, says, at_mm: None, also: None };
    Fault {
        name: name.to_owned(),
        range,
        sound: files(range[1]),
        files: Box::new(files),
        expected: Box::new(of),
    }
}

fn faults() -> Vec<Fault> {
    let all = ["post1", "post2", "bridge", "next"];
    let next = ("S401", "next", "nozzle push");
    let strut = ("S403", "strut", "while the nozzle presses");
    let rod_buckles = ("S404", "rod", "buckles");
    let leaf_tears = ("S405", "leaf", "`leaf` holds to the frame");
    let bends = ("S406", "", "bends the part");
    let bridge_yields = ("S407", "bridge", "is used up");
    let node_yields = ("S407", "leaf", "holds to the frame");
    let mut list = vec![
        fault("Pushed", [8.0, 4.0], |x| leaning("", x, ""), next),
        fault("ThinStrut", [0.75, 1.2], |d| leaning("", 4.0, &bead(d)), next),
        fault("Strained", [16.0, 5.0], |x| leaning(WIDE, x, ""), strut),
        fault("ThinStrained", [0.7, 1.2], |d| leaning(WIDE, 5.0, &bead(d)), strut),
        fault("TallRod", [140.0, 80.0], |h| rod(HIGH, h, None, ""), rod_buckles),
        fault("ThinRod", [0.8, 1.2], |d| rod(HIGH, 80.0, None, &bead(d)), rod_buckles),
        fault("LeaningLeaf", [8.0, 0.5], |x| leaf(WIDE, 0.9, x, None), leaf_tears),
        fault("WeakNode", [1.25, 0.7], |z| leaf(WIDE, z, 1.5, None), leaf_tears),
        fault("Load", [9.0, 3.0], |n| pressed(STRONG, n, 2, ""), bends),
        fault("ThinBends", [0.7, 1.2], |d| pressed(STRONG, 2.0, 2, &bead(d)), bends),
        fault("LoadYields", [16.0, 1.0], |n| pressed(BENDS, n, 2, ""), bridge_yields),
        fault("ThinYields", [0.7, 1.2], |d| pressed(BENDS, 1.0, 2, &bead(d)), bridge_yields),
        fault("WeakNodeLoaded", [1.15, 0.7], |z| leaf(CLOSE, z, 0.5, Some(0.2)), node_yields),
        fault("PushOnLeaf", [2.0, 0.1], |n| leaf(CLOSE, 1.0, 0.5, Some(n)), node_yields),
        fault(
            "LoadOnColumn",
            [1.5, 0.2],
            |n| rod(BENDS, 40.0, Some(n), ""),
            ("S408", "", "buckles the part"),
        ),
    ];
    let missing = ["post1", "bridge", "next"];
    let swapped = ["post1", "bridge", "next", "post2"];
    for (name, order) in [("MissingPost", &missing[..]), ("SwappedOrder", &swapped[..])] {
        let order = order.to_vec();
        let bridge = fault(name, [18.0, 3.0], move |l| portal(l, &order), next);
        list.push(Fault { sound: portal(18.0, &all), ..bridge });
    }
    let of = |_: f64| Expected {
        code: "S401",
        strand: "next",
        says: "nozzle push",
        at_mm: None,
        also: Some(no_part_alone),
    };
    let sum = fault("OnlyTheSum", [6.0, 1.0], shrunk, next);
    list.push(Fault { expected: Box::new(of), ..sum });
    list
}

/// No part of the landing is past the limit by itself.
fn no_part_alone(report: &Value, finding: &Value) -> Result<(), String> {
    let limit = finding["limit"].as_f64().unwrap_or(0.0);
    let landing = report["landings"]
        .as_array()
        .and_then(|all| all.iter().find(|it| it["strand"] == finding["site"]["strand"]));
    let Some(landing) = landing else { return Err("no landing in the report".to_owned()) };
    for part in ["frame_m", "shrinkage_m", "sag_m", "weight_m", "push_m"] {
        let length = landing[part].as_array().map_or(0.0, |xyz| {
            xyz.iter().filter_map(Value::as_f64).map(|x| x * x).sum::<f64>().sqrt()
        });
        if length > limit {
            return Err(format!("{part} alone is {length}, limit {limit}"));
        }
    }
    Ok(())
}

#[test]
fn a_hundred_planted_faults_of_the_structure_are_found() {
    planting::all_are_found("planted-structure", &faults());
}
