//! The jobs that the faults of the process are planted in.

use std::fs;

use super::Kind;
use crate::planting::Files;
use crate::tools;

/// The files of the job without the fault.
pub(super) fn sound(kind: Kind) -> Files {
    let [deep, none] = kind.range();
    match kind {
        Kind::WrongMaterial => vec![("job.slam", rod_of("pla", deep, ""))],
        _ => files(kind, none),
    }
}

/// The files of the job with the fault of this number.
pub(super) fn files(kind: Kind, x: f64) -> Files {
    let alone = |text: String| vec![("job.slam", text)];
    match kind {
        Kind::TooFast => alone(bridge("printer-3axis", 10.0, "", &format!(r#""speed_mm_s": {x}"#))),
        Kind::NoAir => {
            let [fan, weak] = ["[3, 1, 6]".to_owned(), format!("[{x}, {}, {}]", x / 3.0, 2.0 * x)];
            let [library, own] = ["\"printer-hot-end\"", "\"tool.toml\""];
            vec![
                ("tool.toml", with("robots/tools/printer-hot-end.toml", &fan, &weak)),
                ("cell.toml", with("robots/cells/printer-3axis.toml", library, own)),
                ("job.slam", bridge("cell.toml", 10.0, "", r#""speed_mm_s": 14"#)),
            ]
        }
        Kind::TooCold => {
            let hot = "value = 240.0\nlow = 220.0\nhigh = 260.0";
            let cold = format!("value = {x}\nlow = {}\nhigh = {}", x - 5.0, x + 5.0);
            let strands = r#"{"id": "first", "points_mm": [[-10, 0, 0.6], [10, 0, 0.6]], "on": "bed", "speed_mm_s": 5},
{"id": "second", "points_mm": [[0, 0, 1.2], [0, 0, 15]], "speed_mm_s": 5}"#;
            let wait = r#", "sequence": ["first", {"wait_s": 60}, "second"]"#;
            vec![
                ("material.toml", with("materials/abs.toml", hot, &cold)),
                ("job.slam", job("printer-3axis", "material.toml", "", strands, wait)),
            ]
        }
        Kind::TooHot => {
            let air = format!(r#""environment": {{"air_c": {x}}}, "#);
            alone(bridge("printer-3axis", 60.0, &air, r#""speed_mm_s": 2"#))
        }
        Kind::LightOff => {
            let off = format!(r#", "events": [{{"at_s": {x}, "set": "light", "to": "off"}}]"#);
            alone(lit("kirkman-sda10d", 0.2, OVERRUN_MM, &off))
        }
        Kind::LightLate => {
            let late = format!(r#", "lights_after_mm": {x}"#);
            alone(lit("kirkman-sda10d", 0.2, OVERRUN_MM, &late))
        }
        Kind::RingTurned => ring("angle_deg = 45\n", &format!("angle_deg = {x}\n")),
        Kind::RingAimed => ring("aim_mm = 2.5", &format!("aim_mm = {x}")),
        Kind::BrightBed => {
            let bright = format!("albedo = [{x}, {}, {}]", 0.8 * x, 1.2 * x);
            let dark = "albedo = [0.04, 0.02, 0.1]";
            vec![
                ("cell.toml", with("robots/cells/kirkman-sda10d.toml", dark, &bright)),
                ("job.slam", lit("cell.toml", 1.0, OVERRUN_MM, "")),
            ]
        }
        Kind::NoDwell => alone(rod_of("abs", 180.0, &format!(r#", "dwell_s": {x}"#))),
        Kind::NoOverrun => alone(lit("kirkman-sda10d", 0.2, x, "")),
        Kind::NoPrime => {
            let [direct, hose] = ["lag_s = [0.1, 0.05, 0.2]", "lag_s = [0.8, 0.6, 1.0]"];
            let strand = format!(
                r#"{{"id": "rod", "points_mm": [[0, 0, 0.2], [0, 0, 40]], "speed_mm_s": 8, "prime_s": {x}}}"#
            );
            vec![
                ("cell.toml", with("robots/cells/printer-3axis.toml", direct, hose)),
                ("job.slam", job("cell.toml", "pla", "", &strand, "")),
            ]
        }
        Kind::Thinned | Kind::Slack => {
            let fed = format!(r#""speed_mm_s": 3, "flow": {{"rate_mm3_s": {x}}}"#);
            alone(bridge("printer-3axis", 10.0, "", &fed))
        }
        Kind::NoLevel => {
            let told = format!(r#", "flow": {{"rate_mm3_s": {x}}}"#);
            alone(lit("kirkman-sda10d", 0.2, OVERRUN_MM, &told))
        }
        Kind::WrongMaterial => alone(rod_of("abs", x, "")),
        Kind::Jumped => {
            let (speed, flow) = (5.0 * x, 6.0 * x);
            let strand = format!(
                r#"{{"id": "rod", "points_mm": [[0, 0, 0.2], [0, 0, 30]], "speed_mm_s": 5, "flow": {{"rate_mm3_s": 6}},
"profile": [{{"at_mm": 15, "speed_mm_s": {speed}, "flow_mm3_s": {flow}}}]}}"#
            );
            alone(job("printer-3axis", "pla", "", &strand, ""))
        }
        Kind::Idle => {
            let life = "[setting.thermoplastic.melt_life_s]\nvalue = 300.0\nlow = 200.0\nhigh = 400.0\nstatus = \"memory\"\nsource = \"ours\"\n\n[setting.thermoplastic.viscosity]";
            let strands = r#"{"id": "first", "points_mm": [[-10, 0, 0.2], [-10, 0, 15]]},
{"id": "second", "points_mm": [[10, 0, 0.2], [10, 0, 15]]}"#;
            let wait = format!(r#", "sequence": ["first", {{"wait_s": {x}}}, "second"]"#);
            let material = with("materials/pla.toml", "[setting.thermoplastic.viscosity]", life);
            vec![
                ("material.toml", material),
                ("job.slam", job("printer-3axis", "material.toml", "", strands, &wait)),
            ]
        }
        Kind::Leaning => {
            let (sin, cos) = x.to_radians().sin_cos();
            let strand = format!(
                r#"{{"id": "rod", "points_mm": [[0, 0, 0.2], [{}, 0, {}]], "speed_mm_s": 3}}"#,
                20.0 * sin,
                0.2 + 20.0 * cos
            );
            let [free, bound] = ["\nclearance_mm", "\nnozzle_angle_deg = 50\nclearance_mm"];
            vec![
                ("cell.toml", with("robots/cells/printer-3axis.toml", free, bound)),
                ("job.slam", job("cell.toml", "pla", "", &strand, "")),
            ]
        }
    }
}

/// A file of the library with one thing in it changed.
fn with(name: &str, from: &str, to: &str) -> String {
    let text = fs::read_to_string(tools::root().join(name)).expect("a file of the library");
    assert!(text.contains(from), "{name} has no {from:?}");
    text.replacen(from, to, 1)
}

fn job(cell: &str, material: &str, before: &str, strands: &str, after: &str) -> String {
    format!(
        r#"{{"slam": 1, "name": "planted", "cell": "{cell}", "material": "{material}", {before}"strands": [
{strands}]{after}}}"#
    )
}

/// A bridge between two posts that stand this far from the middle.
fn bridge(cell: &str, half_mm: f64, before: &str, how: &str) -> String {
    let strands = format!(
        r#"{{"id": "post1", "points_mm": [[-{half_mm}, 0, 0], [-{half_mm}, 0, 10]], "speed_mm_s": 3}},
{{"id": "post2", "points_mm": [[{half_mm}, 0, 0], [{half_mm}, 0, 10]], "speed_mm_s": 3}},
{{"id": "bridge", "points_mm": [[-{half_mm}, 0, 10], [{half_mm}, 0, 10]], {how}}}"#
    );
    job(cell, "pla", before, &strands, "")
}

/// A melt's rod straight up, its end free.
fn rod_of(material: &str, length_mm: f64, how: &str) -> String {
    let strand = format!(
        r#"{{"id": "rod", "points_mm": [[0, 0, 0], [0, 0, {length_mm}]], "speed_mm_s": 12.8, "prime_s": 0.1{how}}}"#
    );
    job("kr6-hot-end", material, "", &strand, "")
}

/// Overrun that carries the end of a resin's rod past the lights.
const OVERRUN_MM: f64 = 2.5;

/// A resin's rod straight up, lit by the ring of the cell.
fn lit(cell: &str, from_mm: f64, overrun_mm: f64, how: &str) -> String {
    let strand = format!(
        r#"{{"id": "rod", "points_mm": [[0, 0, {from_mm}], [0, 0, 30]], "speed_mm_s": 2, "prime_s": 3, "overrun_mm": {overrun_mm}{how}}}"#
    );
    job(cell, "sla-resin-silica", "", &strand, "")
}

/// The same with another ring.
fn ring(from: &str, to: &str) -> Files {
    let [library, own] = ["\"kirkman-nozzle\"", "\"tool.toml\""];
    vec![
        ("tool.toml", with("robots/tools/kirkman-nozzle.toml", from, to)),
        ("cell.toml", with("robots/cells/kirkman-sda10d.toml", library, own)),
        ("job.slam", lit("cell.toml", 0.2, OVERRUN_MM, "")),
    ]
}
