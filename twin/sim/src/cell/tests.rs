use super::*;
use slam::cell_file::{CalibrationFile, CarriedFile, CellFile, HoseFile};
use slam::tool_file::ShapeFile;

use crate::kinematics::JointKind;
use crate::pose::{Point, Vector};
use crate::test_job::{CELLS, job, strand, text, try_job, try_job_in};

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
fn only_codes_can_be_allowed() {
    let allow = |code: &str| {
        format!(
            "\"allow\": [{{ \"code\": \"{code}\", \"reason\": \"r\", \"until\": \"2027-01-31\" }}],"
        )
    };
    assert!(try_job(&text("kr10-cone", &allow("P301"), &strand("a", &FLAT, "")), &[]).is_ok());
    for (code, hint) in [
        ("C210", "did you mean `C201`?"),
        ("p301", "did you mean `P301`?"),
        ("collision", "`twin explain` lists"),
    ] {
        let (message, at) = refusal("kr10-cone", &allow(code), "");
        assert_eq!(message, format!("there is no code \"{code}\""));
        assert_eq!(at, format!("\"{code}\""));
        let text = text("kr10-cone", &allow(code), &strand("a", &FLAT, ""));
        let problems = try_job(&text, &[]).expect_err("no code");
        assert!(problems[0].hints[0].contains(hint), "{problems:?}");
    }
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

/// Masses go with the arms that publish them; the others say so.
#[test]
fn a_cell_knows_what_its_arm_weighs_and_carries() {
    let cell = |name: &str| job(&text(name, "", &strand("a", &FLAT, ""))).cell;
    let kr6 = cell("kr6-2-hot-end");
    let moving_kg: f64 = kr6.robot.masses.as_ref().unwrap().iter().map(|body| body.mass_kg).sum();
    assert!((moving_kg - 38.243_552_62).abs() < 1e-9, "{moving_kg}");
    assert_eq!(kr6.robot.torque[5], Some(23.2939212));
    assert_eq!((kr6.robot.payload_kg, kr6.robot.payload_centre), (Some(6.0), None));
    let tool = kr6.tool.body().unwrap();
    assert_eq!((tool.mass_kg, tool.centre.z), (0.9, -0.09));
    // 140 mm from flange to orifice, the centre 90 mm back from there, in line with the flange.
    assert!((kr6.flange_load().unwrap().centre - Vector::new(0.0, 0.0, 0.05)).norm() < 1e-12);
    let held = kr6.dynamics().unwrap().holding_torques(&kr6.home);
    assert!(held.iter().zip(&kr6.robot.torque).all(|(held, limit)| held.abs() < limit.unwrap()));
    assert!(cell("kr10-cone").robot.masses.is_none() && cell("kr10-cone").dynamics().is_none());
    let bed = cell("kirkman-sda10d").bed.body().unwrap();
    assert_eq!((bed.mass_kg, bed.centre.z), (1.0, -0.005));
}

/// A job in the cell of the KR 6 with its file changed.
fn in_cell(change: impl FnOnce(&mut CellFile)) -> Result<Job, String> {
    let problems = |problems: Vec<slam::Diagnostic>| problems[0].message.clone();
    try_job_in(&text("kr6-hot-end", "", &strand("a", &FLAT, "")), &[], change).map_err(problems)
}

fn feeder(name: &str, link: &str) -> CarriedFile {
    let shape = ShapeFile::Box { size_mm: [80.0; 3], xyz_mm: [0.0, 0.0, 150.0], rpy_deg: [0.0; 3] };
    CarriedFile { name: name.to_owned(), link: link.to_owned(), shape }
}

fn hose(link: &str) -> HoseFile {
    HoseFile {
        name: "guide".to_owned(),
        link: link.to_owned(),
        at_mm: [0.0, 0.0, 150.0],
        tool_at_mm: [0.0, 25.0, -100.0],
        length_mm: 800.0,
        radius_mm: 4.0,
        twist_deg: None,
    }
}

/// A body on a link rides with it and is measured against what the link is measured against.
#[test]
fn carried_bodies_are_links_of_the_arm() {
    let plain = in_cell(|_| {}).expect("the cell of the library").cell.robot;
    let place = |name: &str| plain.links.iter().position(|link| link.name == name);
    for host in ["base_link", "link_1", "link_2", "link_3", "link_4", "flange"] {
        let carry = |cell: &mut CellFile| cell.carried = vec![feeder("feeder", host)];
        let robot = in_cell(carry).expect(host).cell.robot;
        let feeder = plain.links.len();
        assert_eq!(robot.links.len(), feeder + 1);
        assert_eq!(robot.links[feeder].name, "feeder");
        let of_links = |pair: &&[usize; 2]| pair[1] < feeder;
        let pairs: Vec<_> = robot.touching.iter().filter(of_links).copied().collect();
        assert_eq!(pairs, plain.touching, "{host}: other pairs stay");
        let neighbours = |robot: &Robot, k: usize| -> Vec<String> {
            let others = robot.touching.iter().filter(|pair| pair.contains(&k));
            let other = |pair: &[usize; 2]| pair[0] + pair[1] - k;
            let mut names: Vec<String> =
                others.map(|pair| robot.links[other(pair)].name.clone()).collect();
            names.sort();
            names
        };
        let Some(at) = place(host) else {
            assert_eq!(neighbours(&robot, feeder), ["link_6"], "{host} has no shape");
            continue;
        };
        assert_eq!(robot.links[feeder].carrier, robot.links[at].carrier);
        let mut wanted = neighbours(&plain, at);
        wanted.push(host.to_owned());
        wanted.sort();
        assert_eq!(neighbours(&robot, feeder), wanted, "{host}");
    }
    let unknown = in_cell(|cell| cell.carried = vec![feeder("feeder", "link_9")]);
    let message = unknown.expect_err("no such link");
    assert!(message.contains("lacks") && message.contains("link_6"), "{message}");
    let named = in_cell(|cell| cell.carried = vec![feeder("link_2", "link_3")]);
    assert!(named.expect_err("two of a name").contains("name of a link"));
}

#[test]
fn hoses_controller_and_calibration_are_in_si() {
    let job = in_cell(|cell| {
        cell.hose = vec![hose("link_3")];
        cell.controller.acceleration_mm_s2 = 2000.0;
        cell.controller.jerk_mm_s3 = None;
        cell.controller.blend_mm = 0.5;
        cell.controller.joint_move_percent = 40.0;
        cell.calibration = Some(CalibrationFile { base_deg: 0.3, ..CalibrationFile::default() });
        cell.limits.torque_percent = 80.0;
    });
    let cell = job.expect("a cell with a hose").cell;
    let link = cell.robot.links.iter().find(|link| link.name == "link_3").expect("link_3");
    let hose = &cell.hoses[0];
    assert_eq!((hose.carrier, hose.length_m), (link.carrier, 0.8));
    assert!((hose.twist_rad - 0.8 * std::f64::consts::PI).abs() < 1e-12, "180° per metre");
    assert!((hose.to - Point::new(0.0, 0.025, -0.1)).norm() < 1e-12);
    let controller = cell.controller;
    assert_eq!((controller.acceleration_m_s2, controller.blend_m), (2.0, 0.5e-3));
    assert!((controller.jerk_m_s3 - 80.0).abs() < 1e-9 && controller.joint_move_share == 0.4);
    let calibration = cell.calibration;
    assert!(calibration.stated && (calibration.tool.offset_m - 1e-4).abs() < 1e-18);
    assert!((calibration.base.turn_rad - 0.3_f64.to_radians()).abs() < 1e-15);
    assert_eq!(cell.limits.torque_share, 0.8);
    assert!(!in_cell(|_| {}).expect("a plain cell").cell.calibration.stated);
    let message = in_cell(|cell| cell.hose = vec![self::hose("elbow")]).expect_err("no such link");
    assert!(message.contains("hose `guide` is fixed to link `elbow`"), "{message}");
}
