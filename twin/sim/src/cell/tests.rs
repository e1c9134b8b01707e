use super::*;
use crate::kinematics::JointKind;
use crate::pose::{Point, Vector};
use crate::test_job::{CELLS, job, strand, text, try_job};

const FLAT: [[f64; 3]; 2] = [[0.0, 0.0, 1.0], [30.0, 0.0, 1.0]];

/// What `resolve` says against a job with this strand, and the text it points at.
#[track_caller]
fn refusal(cell: &str, more: &str, more_of_strand: &str) -> (String, String) {
    let text = text(cell, more, &strand("a", &FLAT, more_of_strand));
    let problems = try_job(&text, &[]).expect_err("a job that cannot be used");
    assert_eq!(problems.len(), 1, "{problems:?}");
    assert!(!problems[0].hints.is_empty(), "{problems:?}");
    let at = problems[0].span;
    (problems[0].message.clone(), text[at.start..at.end].to_owned())
}

#[test]
fn joint_rows_of_another_length_are_refused() {
    let (message, at) = refusal("kr10-cone", "", ", \"joints\": [[1, 2, 3], [4, 5, 6]]");
    assert!(message.contains("3 joint values, the arm has 6"), "{message}");
    assert_eq!(at, "[[1, 2, 3], [4, 5, 6]]");
    let sequence = r#""sequence": [{ "move": { "joints": [[0, 0, 0, 0, 0, 0]] } }, "a"],"#;
    let (message, _) = refusal("kirkman-sda10d", sequence, "");
    assert!(message.contains("6 joint values, the arm has 7"), "{message}");
}

#[test]
fn outputs_and_flow_levels_that_the_cell_lacks_are_refused() {
    let event = |set: &str| {
        format!(", \"events\": [{{ \"at_mm\": 1, \"set\": \"{set}\", \"to\": \"on\" }}]")
    };
    let (message, at) = refusal("kirkman-sda10d", "", &event("uv-bix"));
    assert!(message.contains("no output `uv-bix`"), "{message}");
    assert_eq!(at, "\"uv-bix\"");
    for set in ["uv-box", "flow", "light", "air", "heater"] {
        let job = job(&text("kirkman-sda10d", "", &strand("a", &FLAT, &event(set))));
        assert_eq!(job.strands[0].events[0].set, set);
    }
    for level in ["0", "8"] {
        let flow = format!("{{ \"level\": {level} }}");
        let wanted =
            text("kirkman-sda10d", "", &strand("a", &FLAT, &format!(", \"flow\": {flow}")));
        let document = slam::job::parse(&slam::Source::new("job", wanted.as_str()));
        if level == "0" && document.is_err() {
            continue;
        }
        let (message, at) = refusal("kirkman-sda10d", "", &format!(", \"flow\": {flow}"));
        assert!(message.contains(&format!("no flow level {level}; it has 7")), "{message}");
        assert_eq!(at, flow);
    }
    let third =
        job(&text("kirkman-sda10d", "", &strand("a", &FLAT, ", \"flow\": { \"level\": 3 }")));
    assert_eq!(third.strands[0].settings.flow, Flow::Rate(13.19 / 1e9));
    let (message, _) = refusal("kr10-cone", "\"process\": { \"flow\": { \"level\": 1 } },", "");
    assert!(message.contains("no flow level 1; it has 0"), "{message}");
}

#[test]
fn a_surface_normal_needs_a_form() {
    let (message, at) =
        refusal("kr10-cone", "", ", \"orientation\": { \"follow\": \"surface_normal\" }");
    assert!(message.contains("lies on no form"), "{message}");
    assert_eq!(at, "\"surface_normal\"");
}

/// Files speak mm, degrees and MPa; a job is in SI.
#[test]
fn everything_is_in_si() {
    let more = r#""placement": { "xyz_mm": [10, 20, 3], "rpy_deg": [0, 0, 90] },
        "environment": { "air_c": 30, "air_m_s": 0.2 },
        "loads": [{ "name": "l", "supports": [{ "at_mm": [0, 0, 1], "fix": "xzr" }],
                    "forces": [{ "at_mm": [30, 0, 1], "force_n": [0, 0, -5] }] }],
        "sequence": ["a", { "wait_s": 3 }, { "move": { "joints": [[0, -90, 90, 0, 45, 0]] } }],
        "limits": { "clearance_mm": 2, "sag_mm": 0.25 },"#;
    let of_strand = r#", "speed_mm_s": 5, "flow": { "rate_mm3_s": 7 }, "directions": [[0, 0, -2], [0, 1, -1]],
        "start": { "join": "bed", "dwell_s": 1 }, "overrun_mm": 3, "dwell_s": 2, "times_s": [0, 8]"#;
    let job = job(&text("kr10-cone", more, &strand("a", &FLAT, of_strand)));
    assert!(
        (job.bed_from_part * Point::new(0.1, 0.0, 0.0) - Point::new(0.01, 0.12, 0.003)).norm()
            < 1e-15
    );
    assert_eq!(job.air, Air { temperature_k: 303.15, speed_m_s: 0.2 });
    let a = &job.strands[0];
    assert_eq!(a.points, [Point::new(0.0, 0.0, 1e-3), Point::new(0.03, 0.0, 1e-3)]);
    assert_eq!((a.settings.speed_m_s, a.settings.flow.rate_m3_s(1.0)), (5e-3, 7.0 / 1e9));
    assert_eq!(a.settings.orientation.follow, Follow::Given);
    let directions = a.directions.as_ref().expect("given");
    assert!((directions[1] - Vector::new(0.0, 0.5f64.sqrt(), -(0.5f64.sqrt()))).norm() < 1e-15);
    assert_eq!(
        (a.start, a.end),
        (End { join: Some(Join::Bed), dwell_s: 1.0 }, End { join: None, dwell_s: 2.0 },)
    );
    assert_eq!((a.settings.overrun_m, a.settings.approach_m), (3e-3, 20e-3));
    assert_eq!(job.loads[0].supports[0].fixed, [true, false, true, true, true, true]);
    assert_eq!(job.loads[0].forces[0].force_n, Vector::new(0.0, 0.0, -5.0));
    assert_eq!(
        (job.limits.clearance_m, job.limits.sag_m, job.limits.node_miss_m),
        (2e-3, 0.25e-3, 1e-3)
    );
    let Step::Move(rows) = &job.steps[2] else { panic!("{:?}", job.steps) };
    assert!((rows[0][4] - 45f64.to_radians()).abs() < 1e-15);
    assert_eq!(job.print_order().collect::<Vec<_>>(), [0]);
}

/// A disc is drawn from the flow told at the asked speed: `Q = π d²/4 · v`.
#[test]
fn a_flow_by_diameter_is_a_rate_at_the_asked_speed() {
    let rate = Flow::Diameter(2e-3).rate_m3_s(4e-3);
    assert!((rate - std::f64::consts::PI * 4e-9).abs() < 1e-20);
}

#[test]
fn every_cell_of_the_library_stands_at_home_within_limits() {
    for name in CELLS {
        let job = job(&text(name, "", &strand("a", &FLAT, "")));
        let (cell, chain) = (&job.cell, &job.cell.robot.arm.chain);
        assert_eq!(cell.home.len(), chain.dof(), "{name}");
        let world_from_tip = chain.forward(&cell.home);
        let bed_from_tool =
            cell.world_from_bed(&world_from_tip).inverse() * cell.world_from_tool(&world_from_tip);
        // There and back: the tip that brings the tool there is the tip we started from.
        let again = cell.world_from_tip(&bed_from_tool);
        assert!(
            (again.translation.vector - world_from_tip.translation.vector).norm() < 1e-12,
            "{name}"
        );
        assert!(again.rotation.angle_to(&world_from_tip.rotation) < 1e-7, "{name}");
        // The nozzle points at the bed and is over it; gravity pulls into it.
        let nozzle = bed_from_tool * Vector::z();
        assert!(nozzle.z < -0.99, "{name}: {nozzle}");
        let [width, depth, _] = cell.bed.size_m;
        let tip = bed_from_tool.translation.vector;
        assert!(
            tip.z > 0.0 && tip.x.abs() <= width / 2.0 && tip.y.abs() <= depth / 2.0,
            "{name}: {tip}"
        );
        assert!(job.gravity_in_part(&world_from_tip).z < -9.7, "{name}");
        assert!(cell.tool.parts.iter().any(|part| part.nozzle), "{name}");
        let revolute = chain.joints().iter().any(|joint| joint.kind == JointKind::Revolute);
        assert_eq!(revolute, name != "printer-3axis");
    }
}
