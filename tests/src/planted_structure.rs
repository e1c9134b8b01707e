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
    let (left, right) = ([0.0, 0.0, 10.0], [length_mm, 0.0, 10.0]);
    let strands = [
        strand("post1", &[[0.0; 3], left], ""),
        strand("post2", &[[length_mm, 0.0, 0.0], right], ""),
        strand("bridge", &[left, right], ""),
        strand("next", &[right, [length_mm + 4.0, 0.0, 18.0]], ""),
    ];
    let there: Vec<String> = strands
        .into_iter()
        .filter(|text| order.iter().any(|id| text.contains(&format!("\"{id}\""))))
        .collect();
    job("", &there.join(",\n"), &format!(r#", "sequence": {order:?}"#))
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
            r#", "loads": [{{"name": "pull", "supports": [{{"at_mm": [0, -30, 0.6], "fix": "xyzr"}}, {{"at_mm": [0, 30, 0.6], "fix": "xyzr"}}], "forces": [{{"at_mm": [{lean_mm:?}, 0, 12], "force_n": [0, 0, {pull_n:?}]}}]}}]"#
        )
    });
    let count = if pull_n.is_some() { 2 } else { 3 };
    job(limits, &strands[..count].join(",\n"), &loads)
}

const WIDE: &str = r#""node_miss_mm": 20, "clearance_mm": 0.5"#;
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
    let mut list = vec![
        fault("Pushed", [8.0, 4.0], |x| leaning("", x, ""), ("S401", "next", "nozzle push")),
        fault(
            "ThinStrut",
            [0.75, 1.2],
            |d| leaning("", 4.0, &bead(d)),
            ("S401", "next", "nozzle push"),
        ),
        fault(
            "Strained",
            [16.0, 5.0],
            |x| leaning(WIDE, x, ""),
            ("S403", "strut", "while the nozzle presses"),
        ),
        fault(
            "ThinStrained",
            [0.7, 1.2],
            |d| leaning(WIDE, 5.0, &bead(d)),
            ("S403", "strut", "while the nozzle presses"),
        ),
        fault("TallRod", [140.0, 80.0], |h| rod(HIGH, h, None, ""), ("S404", "rod", "buckles")),
        fault(
            "ThinRod",
            [0.8, 1.2],
            |d| rod(HIGH, 80.0, None, &bead(d)),
            ("S404", "rod", "buckles"),
        ),
        fault(
            "LeaningLeaf",
            [8.0, 0.5],
            |x| leaf(WIDE, 0.9, x, None),
            ("S405", "leaf", "`leaf` holds to the frame"),
        ),
        fault(
            "WeakNode",
            [1.25, 0.7],
            |z| leaf(WIDE, z, 1.5, None),
            ("S405", "leaf", "`leaf` holds to the frame"),
        ),
        fault("Load", [9.0, 3.0], |n| pressed("", n, 2, ""), ("S406", "", "bends the part")),
        fault(
            "LoadYields",
            [16.0, 4.0],
            |n| pressed(BENDS, n, 2, ""),
            ("S407", "bridge", "is used up"),
        ),
        fault(
            "ThinYields",
            [0.7, 1.2],
            |d| pressed(BENDS, 3.0, 2, &bead(d)),
            ("S407", "bridge", "is used up"),
        ),
        fault(
            "ThinBends",
            [0.7, 1.2],
            |d| pressed("", 2.0, 2, &bead(d)),
            ("S406", "", "bends the part"),
        ),
        fault(
            "LoadOnColumn",
            [1.5, 0.2],
            |n| rod(BENDS, 40.0, Some(n), ""),
            ("S408", "", "buckles the part"),
        ),
        fault(
            "WeakNodeLoaded",
            [1.25, 0.7],
            |z| leaf(BENDS, z, 0.5, Some(1.0)),
            ("S407", "leaf", "holds to the frame"),
        ),
        fault(
            "PullOnLeaf",
            [80.0, 0.5],
            |n| leaf(BENDS, 0.9, 0.5, Some(n)),
            ("S407", "leaf", "holds to the frame"),
        ),
    ];
    let missing = ["post1", "bridge", "next"];
    let swapped = ["post1", "bridge", "next", "post2"];
    for (name, order) in [("MissingPost", &missing[..]), ("SwappedOrder", &swapped[..])] {
        let order = order.to_vec();
        let bridge =
            fault(name, [18.0, 6.0], move |l| portal(l, &order), ("S401", "next", "nozzle push"));
        list.push(Fault { sound: portal(18.0, &all), ..bridge });
    }
    let sum =
        fault("OnlyTheSum", [8.0, 4.0], |x| leaning("", x, ""), ("S401", "next", "nozzle push"));
    let of = |_: f64| Expected {
        code: "S401",
        strand: "next",
        says: "nozzle push",
        at_mm: None,
        also: Some(no_part_alone),
    };
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
