//! What must not change what becomes of a strand does not: its name, a point more along it, a cut
//! through it, where the axes stand, and the side that gravity leans to about its own axis.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::invariance::elsewhere;
use crate::tools::{check, root, scratch};

fn library(name: &str) -> String {
    fs::read_to_string(root().join(name)).expect("a file of the library")
}

/// A cell of the library whose extruder answers at once: then a second start costs nothing.
fn prompt(name: &str) -> String {
    let text = library(&format!("robots/cells/{name}.toml"));
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with("lag_s")).collect();
    assert!(lines.len() < text.lines().count(), "{name} tells a lag");
    lines.join("\n")
}

fn job(cell: &str, material: &str, strands: &[String]) -> String {
    let strands = strands.join(",\n");
    format!(
        r#"{{"slam": 1, "name": "same", "cell": "{cell}", "material": "{material}", "strands": [{strands}]}}"#
    )
}

/// A strand through these points.
fn strand(id: &str, points_mm: &[[f64; 3]], how: &str) -> String {
    format!(r#"{{"id": "{id}", "points_mm": {points_mm:?}, {how}}}"#)
}

/// Posts of 10 mm at these places, and what is laid over them.
fn over_posts(posts_mm: &[f64], laid: &[String]) -> Vec<String> {
    let post = |x: &f64| {
        strand(&format!("post {x}"), &[[*x, 0.0, 0.0], [*x, 0.0, 10.0]], r#""speed_mm_s": 3"#)
    };
    posts_mm.iter().map(post).chain(laid.iter().cloned()).collect()
}

fn report(folder: &Path, cell: &str, job: &str) -> Value {
    fs::write(folder.join("cell.toml"), cell).expect("written");
    let path = folder.join("job.slam");
    fs::write(&path, job).expect("written");
    let (ran, report) = check(&path, &folder.join("out"));
    report.unwrap_or_else(|| panic!("{}", ran.err))
}

/// Numbers by the place they stand at: `sag_set_m/high`.
type Numbers = BTreeMap<String, Option<f64>>;

fn collect(value: &Value, place: &str, numbers: &mut Numbers) {
    match value {
        Value::Object(fields) => {
            for (key, value) in fields {
                let place = if place.is_empty() { key.clone() } else { format!("{place}/{key}") };
                collect(value, &place, numbers);
            }
        }
        Value::Number(_) | Value::Null => {
            numbers.insert(place.to_owned(), value.as_f64());
        }
        _ => {}
    }
}

/// What the process says of each strand; not when it was printed, nor how the arm stood.
fn strands(report: &Value) -> Vec<Numbers> {
    let strand = |strand: &Value| {
        let mut numbers = Numbers::new();
        collect(strand, "", &mut numbers);
        let of_the_arm = ["line", "start_s", "end_s", "motion", "tcp_speed", "error_budget"];
        numbers.retain(|place, _| !of_the_arm.iter().any(|key| place.starts_with(key)));
        assert!(numbers.len() > 30, "{numbers:?}");
        numbers
    };
    report["strands"].as_array().expect("strands").iter().map(strand).collect()
}

/// What goes with where a strand begins and how long it is, or with what it touches.
const OF_THE_CUT: [&str; 7] =
    ["shortening_m", "bond", "reheated", "centreline_m", "bead_share", "blobs_m", "ageing"];

/// The same within a share, but for what begins with one of `but`. Below 1e-12 all is rounding: the
/// least that is told is a length in metres, and flows stand beside draw ratios and beads.
fn same(a: &Numbers, b: &Numbers, within: f64, but: &[&str]) {
    let told = |place: &&String| !but.iter().any(|key| place.starts_with(key));
    let keys = |numbers: &Numbers| numbers.keys().filter(told).cloned().collect::<Vec<_>>();
    assert_eq!(keys(a), keys(b));
    for (place, x) in a.iter().filter(|(place, _)| told(place)) {
        let near = |x: f64, y: f64| (x - y).abs() <= within * x.abs() + 1e-12;
        let y = b[place];
        assert!(*x == y || x.zip(y).is_some_and(|(x, y)| near(x, y)), "{place}: {x:?} and {y:?}");
    }
}

fn total(report: &Value, key: &str) -> f64 {
    report["totals"][key].as_f64().unwrap_or_else(|| panic!("{key}: {}", report["totals"]))
}

fn totals_are_same(a: &Value, b: &Value) {
    for key in ["length_m", "mass_kg"] {
        let (x, y) = (total(a, key), total(b, key));
        assert!((x - y).abs() <= 1e-9 * x, "{key}: {x} and {y}");
    }
}

/// Strands are told apart by their place in the list; a name is only shown.
#[test]
fn names_of_strands_change_no_number() {
    let folder = scratch("process-names");
    let named = |names: [&str; 3]| {
        let at = |k: usize, points: &[[f64; 3]], how: &str| strand(names[k], points, how);
        let strands = [
            at(0, &[[-10.0, 0.0, 0.0], [-10.0, 0.0, 10.0]], r#""speed_mm_s": 3"#),
            at(1, &[[10.0, 0.0, 0.0], [10.0, 0.0, 10.0]], r#""speed_mm_s": 3"#),
            at(2, &[[-10.0, 0.0, 10.0], [10.0, 0.0, 10.0]], r#""speed_mm_s": 20"#),
        ];
        report(&folder, "", &job("printer-3axis", "pla", &strands))
    };
    let (a, b) = (named(["a", "b", "c"]), named(["zoe", "Ω", "b"]));
    assert_eq!(strands(&a), strands(&b));
    totals_are_same(&a, &b);
    let numbers = |report: &Value| -> Vec<[Value; 5]> {
        let plain = |finding: &Value| {
            ["code", "measured", "low", "high", "limit"].map(|key| finding[key].clone())
        };
        report["findings"].as_array().expect("findings").iter().map(plain).collect()
    };
    assert!(!numbers(&a).is_empty());
    assert_eq!(numbers(&a), numbers(&b));
}

/// A point on a straight line adds no corner: the arm does not stop there, nothing ages otherwise.
#[test]
fn a_point_more_on_a_straight_strand_changes_nothing() {
    let folder = scratch("process-points");
    let run = |cell: &str, material: &str, made: &[String]| {
        strands(&report(&folder, "", &job(cell, material, made)))
    };
    let bridge = |points: &[[f64; 3]]| {
        let bridge = strand("bridge", points, r#""speed_mm_s": 16"#);
        run("printer-3axis", "pla", &over_posts(&[-10.0, 10.0], &[bridge]))
    };
    let rod = |points: &[[f64; 3]]| {
        let how = r#""speed_mm_s": 2, "prime_s": 3, "overrun_mm": 2.5"#;
        run("kirkman-sda10d", "sla-resin-silica", &[strand("rod", points, how)])
    };
    let ends = [[-10.0, 0.0, 10.0], [10.0, 0.0, 10.0]];
    let (plain, more) = (bridge(&ends), bridge(&[ends[0], [-4.0, 0.0, 10.0], ends[1]]));
    assert!(plain[2]["sag_nozzle_m/value"] > Some(1e-4), "the rod was asked");
    plain.iter().zip(&more).for_each(|(a, b)| same(a, b, 1e-9, &[]));
    let ends = [[0.0, 0.0, 0.2], [0.0, 0.0, 30.0]];
    let (plain, more) = (rod(&ends), rod(&[ends[0], [0.0, 0.0, 11.0], ends[1]]));
    same(&plain[0], &more[0], 1e-9, &[]);
}

/// A strand on the bed, or straight up, ages alike wherever it is cut: the same mass, bead, draw,
/// setting and strain. A free end's miss adds up over the length and is each part's own, as are
/// length and span.
#[test]
fn a_cut_changes_neither_mass_nor_bead_nor_setting() {
    let folder = scratch("process-cut");
    let cell = prompt("printer-3axis");
    let on_bed = |k: f64| [k, 0.0, 0.6];
    let upright = |k: f64| [0.0, 0.0, k + 20.0];
    let cut = |at: &dyn Fn(f64) -> [f64; 3], how: &str| {
        let one = [strand("one", &[at(-20.0), at(20.0)], how)];
        let two = [strand("a", &[at(-20.0), at(4.0)], how), strand("b", &[at(4.0), at(20.0)], how)];
        let [one, two] =
            [&one[..], &two[..]].map(|it| report(&folder, &cell, &job("cell.toml", "pla", it)));
        totals_are_same(&one, &two);
        let (one, two) = (strands(&one), strands(&two));
        assert_eq!(two.len(), 2);
        for part in &two {
            same(
                &one[0],
                part,
                1e-9,
                &[&["length_m", "span_m", "end_miss_m"], &OF_THE_CUT[..]].concat(),
            );
        }
        let miss_m = |it: &Numbers| it["end_miss_m/high"].expect("a number");
        let sum_m: f64 = two.iter().map(miss_m).sum();
        assert!((sum_m - miss_m(&one[0])).abs() < 1e-9, "far from set, the miss is the length's");
    };
    cut(&on_bed, r#""on": "bed", "speed_mm_s": 5"#);
    cut(&upright, r#""speed_mm_s": 5"#);
}

/// Where the extruder lags, the second start lacks what flows in one lag, and no more.
#[test]
fn a_cut_costs_one_lag_of_flow() {
    let folder = scratch("process-lag");
    let how = r#""on": "bed", "speed_mm_s": 5, "flow": {"rate_mm3_s": 6}"#;
    let parts = |ends_mm: &[f64]| {
        let part = |pair: &[f64]| {
            strand(&format!("to {}", pair[1]), &[[pair[0], 0.0, 0.6], [pair[1], 0.0, 0.6]], how)
        };
        let strands: Vec<String> = ends_mm.windows(2).map(part).collect();
        total(&report(&folder, "", &job("printer-3axis", "pla", &strands)), "mass_kg")
    };
    let whole_kg = parts(&[-20.0, 20.0]);
    // 6 mm³/s of melt at 1090 kg/m³ for a lag of 0.1 s.
    let lag_kg = 6e-9 * 1090.0 * 0.1;
    for (cuts, ends_mm) in [(1.0, &[-20.0, 4.0, 20.0][..]), (2.0, &[-20.0, -5.0, 4.0, 20.0])] {
        let lost_kg = whole_kg - parts(ends_mm);
        assert!((lost_kg / (cuts * lag_kg) - 1.0).abs() < 0.01, "{cuts}: {lost_kg} and {lag_kg}");
    }
}

/// A bridge over three posts hangs in two spans, each held as a bridge of its own. Set, it is the
/// same beam; behind the nozzle the arm passes the middle post or stops there: within a hundredth.
#[test]
fn a_bridge_cut_at_a_post_sags_alike() {
    let folder = scratch("process-bridge");
    let cell = prompt("printer-3axis");
    let how = r#""speed_mm_s": 14"#;
    let span =
        |id: &str, from: f64, to: f64| strand(id, &[[from, 0.0, 10.0], [to, 0.0, 10.0]], how);
    let posts = [-16.0, 0.0, 16.0];
    let run = |laid: &[String]| {
        strands(&report(&folder, &cell, &job("cell.toml", "pla", &over_posts(&posts, laid))))
    };
    let one = run(&[span("one", -16.0, 16.0)]);
    let two = run(&[span("a", -16.0, 0.0), span("b", 0.0, 16.0)]);
    assert!(one[3]["sag_nozzle_m/value"] > Some(1e-4), "the rod was asked");
    for part in &two[3..] {
        same(
            &one[3],
            part,
            1e-9,
            &[&["length_m", "end_miss_m", "sag_nozzle_m"], &OF_THE_CUT[..]].concat(),
        );
        same(&one[3], part, 1e-2, &[&["length_m", "end_miss_m"], &OF_THE_CUT[..]].concat());
    }
}

/// Light reaches every place of a rod alike if the lamps travel on past both of its ends: so a cut
/// leaves dose and depth as they were. The distance goes with the mean speed, which the arm's ramps
/// lower by less than a thousandth, the shares of the section are means along the strand, whose
/// ends are a little brighter (at the bad end 0.7 %: little of the shell is left under its tacky
/// skin), and how much the heat of cure hastens it is told of its middle, which
/// the cut moves (1e-7).
#[test]
fn a_cut_changes_no_cure() {
    let folder = scratch("process-cure");
    let cell = prompt("kirkman-sda10d");
    let how = r#""speed_mm_s": 2, "overrun_mm": 8"#;
    let part = |id: &str, from: f64, to: f64| strand(id, &[[0.0, 0.0, from], [0.0, 0.0, to]], how);
    let run = |rods: &[String]| report(&folder, &cell, &job("cell.toml", "sla-resin-silica", rods));
    let one = run(&[part("one", 0.2, 40.2)]);
    let two = run(&[part("a", 0.2, 24.2), part("b", 24.2, 40.2)]);
    totals_are_same(&one, &two);
    let (one, two) = (strands(&one), strands(&two));
    assert!(one[0]["uncured_core_m/value"] > Some(1e-4));
    let means =
        ["set_distance_m", "set_time_s", "warmest_k", "area_fraction", "stiffness_fraction"];
    for part in &two {
        same(
            &one[0],
            part,
            1e-9,
            &[&["length_m", "span_m", "sag_set_m"], &means[..], &OF_THE_CUT[..]].concat(),
        );
        same(
            &one[0],
            part,
            1e-2,
            &[&["length_m", "span_m", "sag_set_m"], &OF_THE_CUT[..]].concat(),
        );
    }
}

/// About the axis of a straight strand nothing has a side, not the nozzle's air nor its ring of
/// lamps: gravity that leans off the axis may lean anywhere.
#[test]
fn gravity_turned_about_a_strand_changes_nothing() {
    let folder = scratch("process-gravity");
    let run = |name: &str, material: &str, how: &str, turned_deg: f64| {
        let (off, about) = (20f64.to_radians().sin_cos(), turned_deg.to_radians().sin_cos());
        let [x, y, z] = [off.0 * about.1, off.0 * about.0, -off.1].map(|share| 9.80665 * share);
        let gravity = format!("gravity_m_s2 = [{x:?}, {y:?}, {z:?}]\nio = [");
        let cell = library(&format!("robots/cells/{name}.toml")).replacen("io = [", &gravity, 1);
        let rod = strand("rod", &[[0.0, 0.0, 0.2], [0.0, 0.0, 40.2]], how);
        strands(&report(&folder, &cell, &job("cell.toml", material, &[rod]))).remove(0)
    };
    for (name, material, how) in [
        ("printer-3axis", "abs", r#""speed_mm_s": 9"#),
        ("kirkman-sda10d", "sla-resin-silica", r#""speed_mm_s": 2, "overrun_mm": 2.5"#),
    ] {
        let plain = run(name, material, how, 0.0);
        assert!(plain["sag_set_m/value"] > Some(1e-9), "it does lean");
        for turned_deg in [90.0, 137.0] {
            same(&plain, &run(name, material, how, turned_deg), 1e-9, &[]);
        }
    }
}

/// Moved and turned with gravity and all that stands in it, the cell makes the same strands.
#[test]
fn moving_the_whole_cell_changes_no_strand() {
    let folder = scratch("process-moved");
    elsewhere(&folder);
    let crossed = fs::read_to_string(root().join("scenarios/two-strands/job.slam")).expect("a job");
    let bridge = strand("bridge", &[[-10.0, 0.0, 10.0], [10.0, 0.0, 10.0]], r#""speed_mm_s": 14"#);
    let bridged = job("kr6-hot-end", "pla", &over_posts(&[-10.0, 10.0], &[bridge]));
    for (k, text) in [crossed, bridged].into_iter().enumerate() {
        let made = |name: &str, text: &str| {
            let path = folder.join(format!("{k}-{name}.slam"));
            fs::write(&path, text).expect("written");
            let (ran, report) = check(&path, &folder.join(name));
            strands(&report.unwrap_or_else(|| panic!("{}", ran.err)))
        };
        let here = made("here", &text);
        let there = made("there", &text.replace("\"kr6-hot-end\"", "\"cell.toml\""));
        assert_eq!(here.len(), there.len());
        here.iter().zip(&there).for_each(|(a, b)| same(a, b, 1e-6, &[]));
    }
}
