//! Plans of peers, replayed as given joint paths in their own cell: what they call safe, we look at
//! with beads at full width, into the nodes, and with the nozzle's tip on.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::tools;

/// Their plans, all of which they mark `safe` and `valid`.
const PLANS: [&str; 3] = ["four-frame", "extrusion_exp_L75.0", "simple_frame"];

/// Their robot with hot end and feeder; the bed is their floor. Their TCP stands 1 mm off the node.
fn cell(urdf: &Path) -> String {
    let library = fs::read_to_string(tools::root().join("robots/cells/kr6-hot-end.toml"));
    let limits = library.expect("a cell of the library");
    let from = limits.find("\n[extruder]").expect("an extruder");
    format!(
        r#"name = "peers"
source = "yijiangh/pychoreo kr6_cell; tip of the nozzle ours"
robot = "{}"
mode = "tool-on-flange"
base = "base_link"
tip = "eef_tcp_frame"
home_deg = [0, -45, 45, 0, 0, 0]
tool = "tip.toml"
[tool_pose]
xyz_mm = [0, 0, 1]
[bed]
pose = {{ xyz_mm = [700, 0, 0] }}
size_mm = [600, 600, 20]
adhesion_mpa = [0.5, 0.1, 2.0]
{}"#,
        urdf.display(),
        &limits[from..]
    )
}

/// Their collision mesh ends 6.9 mm before the TCP: this is the tip they left out.
const TIP: &str = r#"name = "tip"
source = "ours: a cone between their cut-off mesh and their TCP, and the 1 mm stand-off"
orifice_diameter_mm = 1.2
[[part]]
name = "nozzle"
nozzle = true
shape = { cone = { from_mm = [0, 0, -8], to_mm = [0, 0, -1], radius_from_mm = 3, radius_to_mm = 0.8 } }
"#;

#[test]
fn plans_that_peers_call_safe_are_looked_at() {
    let Some(cell_folder) = tools::shared("data/extrusion/kr6_cell/kuka_kr6_r900/urdf") else {
        return;
    };
    let Some(plans) = tools::shared("data/extrusion/plans") else { return };
    let folder = tools::scratch("peers");
    let urdf = cell_folder.join("kuka_kr6_r900_extrusion.urdf").canonicalize().expect("a file");
    fs::write(folder.join("cell.toml"), cell(&urdf)).expect("a temporary file");
    fs::write(folder.join("tip.toml"), TIP).expect("a temporary file");
    println!("| plan | motion | pair | smallest clearance, mm | finding |\n|---|---|---|---|---|");
    for name in PLANS {
        let plan = plans.join(format!("{name}_solution.json"));
        let job = folder.join(format!("{name}.slam"));
        let args = [
            "plan".as_ref(),
            plan.as_os_str(),
            "--cell".as_ref(),
            folder.join("cell.toml").as_os_str(),
            "--material".as_ref(),
            "pla".as_ref(),
            "--output".as_ref(),
            job.as_os_str(),
        ]
        .map(std::ffi::OsStr::to_owned);
        let ran = tools::twin(args);
        assert_eq!(ran.code, 0, "{name}: {}", ran.err);
        let (ran, report) = tools::check(&job, &folder.join(name));
        let report = report.unwrap_or_else(|| panic!("{name}: {}", ran.err));
        let strands = report["strands"].as_array().expect("strands");
        let text = fs::read_to_string(&plan).expect("a plan");
        // Python writes numbers that JSON has not.
        let text = text.replace("Infinity", "null");
        let their: Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(strands.len(), their["sequence"].as_array().expect("a sequence").len());
        assert_eq!(their["safe"], true);
        // Every motion has a verdict: what is not told is clear by more than the limit.
        for (motion, [pair, clearance, code]) in worst(&report) {
            println!("| {name} | {motion} | {pair} | {clearance} | {code} |");
        }
        // Their joint path keeps to their strands, but for the end: they go whole millimetres and stop
        // up to half a millimetre short of the node.
        for strand in strands {
            let off_m = strand["motion"]["deviation_linear_m"].as_f64().expect("a deviation");
            assert!(off_m < 5e-4, "{name} {}: {off_m} m off", strand["id"]);
        }
    }
}

/// The worst clearance finding of every motion: pair, clearance in mm, code.
fn worst(report: &Value) -> BTreeMap<String, [String; 3]> {
    let mut rows: BTreeMap<String, (f64, [String; 3])> = BTreeMap::new();
    for finding in report["findings"].as_array().expect("findings") {
        let code = finding["code"].as_str().unwrap_or_default();
        let Some(measured) = finding["measured"].as_f64().filter(|_| code.starts_with('C')) else {
            continue;
        };
        let text = |pointer: &str| {
            finding.pointer(pointer).and_then(Value::as_str).unwrap_or("-").to_owned()
        };
        let motion = format!("{} {}", text("/site/strand"), text("/site/phase"));
        let pair = format!("{} – {}", text("/site/bodies/0"), text("/site/bodies/1"));
        let row = [pair, format!("{:.2}", measured * 1e3), format!("{code} {}", text("/severity"))];
        let known = rows.entry(motion).or_insert((f64::INFINITY, row.clone()));
        if measured < known.0 {
            *known = (measured, row);
        }
    }
    rows.into_iter().map(|(motion, (_, row))| (motion, row)).collect()
}
