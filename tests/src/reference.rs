//! The program against the shared reference data.

use std::fs;

use serde_json::Value;

use crate::tools::{scratch, shared, twin};

/// Row 5 of the issue: `twin inspect` against poses and Jacobians by Pinocchio, for the original
/// URDFs and for ours where we have the arm.
#[test]
fn inspect_agrees_with_the_reference() {
    let Some(path) = shared("data/robots/fk_reference.json") else { return };
    let reference: Value =
        serde_json::from_str(&fs::read_to_string(&path).expect("readable")).expect("JSON");
    let robots = path.parent().and_then(|folder| folder.parent()).expect("data/");
    let folder = scratch("inspect");
    let ours = [
        ("kroshu_kr6_r900_2", "kuka/kr6_r900_2"),
        ("kuka_kr10r1100sixx", "kuka/kr10_r1100_sixx"),
        ("kuka_kr6r900sixx", "kuka/kr6_r900_sixx"),
        ("motoman_sda10f:arm_left_link_tool0", "motoman/sda10d"),
        ("motoman_sda10f:arm_right_link_tool0", "motoman/sda10d"),
        ("ur10e", "ur/ur10e"),
    ];
    for (name, robot) in reference["robots"].as_object().expect("robots by name") {
        let cases = robot["cases"].as_array().expect("cases");
        let q_file = folder.join("q.json");
        let q: Vec<&Value> = cases.iter().map(|case| &case["q"]).collect();
        fs::write(&q_file, serde_json::to_string(&q).expect("JSON")).expect("written");
        let original = robots.join(robot["urdf"].as_str().expect("a path"));
        let mut urdfs = vec![original.display().to_string()];
        urdfs.extend(
            ours.iter().filter(|(theirs, _)| theirs == name).map(|(_, ours)| (*ours).to_owned()),
        );
        for urdf in urdfs {
            let tip = robot["tool"].as_str().expect("a link");
            let ran = twin([
                "inspect",
                &urdf,
                "--tip",
                tip,
                "--q",
                &q_file.display().to_string(),
                "--format",
                "json",
            ]);
            assert_eq!(ran.code, 0, "{urdf}: {}", ran.err);
            let answers: Value = serde_json::from_str(&ran.out).expect("JSON on standard output");
            for (case, answer) in cases.iter().zip(answers.as_array().expect("an array")) {
                compare(&urdf, case, answer);
            }
        }
    }
}

fn compare(urdf: &str, case: &Value, answer: &Value) {
    let number = |value: &Value| value.as_f64().expect("a number");
    for row in 0..3 {
        let off = number(&case["T"][row][3]) - number(&answer["position_m"][row]);
        assert!(off.abs() < 1e-9, "{urdf}: position off by {off}");
    }
    // Angle between two unit quaternions: 2 asin of the vector part of their quotient.
    let wxyz: Vec<f64> = (0..4).map(|k| number(&answer["quaternion_wxyz"][k])).collect();
    let rotation = rotation_of(&wxyz);
    let mut trace_error = 0.0f64;
    for (i, row) in rotation.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            trace_error = trace_error.max((entry - number(&case["T"][i][j])).abs());
        }
    }
    assert!(trace_error < 1e-9, "{urdf}: rotation off by {trace_error}");
    for (i, row) in case["J_world_aligned"].as_array().expect("a matrix").iter().enumerate() {
        for (j, entry) in row.as_array().expect("a row").iter().enumerate() {
            let off = number(entry) - number(&answer["jacobian"][i][j]);
            assert!(off.abs() < 1e-8, "{urdf}: Jacobian [{i}][{j}] off by {off}");
        }
    }
}

fn rotation_of(wxyz: &[f64]) -> [[f64; 3]; 3] {
    let [w, x, y, z] = [wxyz[0], wxyz[1], wxyz[2], wxyz[3]];
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// Row 4 of the issue on its small frames; with `TWIN_SLOW=1` on all of them.
#[test]
fn frames_of_the_literature_run_to_a_verdict() {
    let Some(frames) = shared("data/extrusion/frames") else { return };
    let Some(orders) = shared("data/extrusion/known_sequences.json") else { return };
    let slow = std::env::var_os("TWIN_SLOW").is_some();
    let folder = scratch("frames");
    let mut files: Vec<_> = fs::read_dir(frames)
        .expect("readable")
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "json"))
        .filter(|path| slow || fs::metadata(path).is_ok_and(|data| data.len() < 8_000))
        .collect();
    files.sort();
    for frame in files {
        let job = folder.join("job.slam");
        let ran = twin([
            "plan".as_ref(),
            frame.as_os_str(),
            "--order".as_ref(),
            orders.as_os_str(),
            "--cell".as_ref(),
            "kr6-hot-end".as_ref(),
            "--material".as_ref(),
            "pla".as_ref(),
            "-o".as_ref(),
            job.as_os_str(),
        ]);
        assert_eq!(ran.code, 0, "{}: {}", frame.display(), ran.err);
        let started = std::time::Instant::now();
        let (ran, report) = crate::tools::check(&job, &folder.join("out"));
        assert!(ran.code <= 1, "{}: {}", frame.display(), ran.err);
        let report = report.unwrap_or_else(|| panic!("{}: no report", frame.display()));
        assert!(report["score"].is_number(), "{}", frame.display());
        let name = frame.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        eprintln!("{name}: {} in {:.2} s", report["verdict"], started.elapsed().as_secs_f64());
    }
}
