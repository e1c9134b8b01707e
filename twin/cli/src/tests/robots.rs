//! `twin inspect`.

use std::f64::consts::FRAC_PI_2;

use serde_json::Value;

use super::{Done, assert_refused, folder, twin, write};
use crate::FEASIBLE;

fn json(done: &Done) -> Value {
    assert_eq!(done.code, FEASIBLE, "{}", done.err);
    serde_json::from_str(&done.out).expect("JSON")
}

fn vector(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|each| each.as_f64().expect("a number")).collect()
}

#[test]
fn table_names_joints_limits_and_sources() {
    let done = twin(["inspect", "kuka/kr6_r900_2"]);
    assert_eq!(done.code, FEASIBLE, "{}", done.err);
    for word in ["KR 6 R900-2", "base_link to tool0", "joint_1", "OPW", "Spez KR AGILUS-2"] {
        assert!(done.out.contains(word), "{word} in {}", done.out);
    }
    assert!(done.err.is_empty(), "{}", done.err);
}

#[test]
fn forward_then_inverse_finds_the_posture_again() {
    let dir = folder("fk");
    let q = [0.1, -1.2, 1.3, 0.4, 0.5, -0.6];
    let file = write(&dir, "q.json", format!("[{q:?}]"));
    let forward = json(&twin(["inspect", "kuka/kr6_r900_sixx", "--q", &file, "--format", "json"]));
    let jacobian = forward[0]["jacobian"].as_array().expect("rows");
    assert_eq!((jacobian.len(), vector(&jacobian[0]).len()), (6, 6));
    let pose = serde_json::json!([{ "position_m": forward[0]["position_m"], "quaternion_wxyz": forward[0]["quaternion_wxyz"] }]);
    let file = write(&dir, "poses.json", pose.to_string());
    let inverse = json(&twin(["inspect", "kuka/kr6_r900_sixx", "--ik", &file]));
    assert_eq!(inverse[0]["complete"], true);
    let found = inverse[0]["solutions"].as_array().expect("solutions");
    let near = |found: &Value| vector(found).iter().zip(q).all(|(a, b)| (a - b).abs() < 1e-8);
    assert!(found.iter().any(near), "{found:?}");
}

#[test]
fn torso_is_held_at_the_seed() {
    let dir = folder("torso");
    let q = [0.3, 0.4, 0.5, -0.3, 0.9, 0.2, 0.6, -0.4];
    let seed = q.map(|q: f64| q.to_string()).join(",");
    let file = write(&dir, "q.json", format!("[{q:?}]"));
    let robot = ["inspect", "motoman/sda10d", "--tip", "arm_left_link_tool0"];
    let forward = json(&twin(robot.into_iter().chain(["--q", &file])));
    let pose = serde_json::json!([{ "position_m": forward[0]["position_m"], "quaternion_wxyz": forward[0]["quaternion_wxyz"] }]);
    let file = write(&dir, "poses.json", pose.to_string());
    let inverse = json(&twin(robot.into_iter().chain(["--ik", &file, "--seed", &seed])));
    assert_eq!(inverse[0]["complete"], true);
    for solution in inverse[0]["solutions"].as_array().expect("solutions") {
        let solution = vector(solution);
        assert_eq!((solution.len(), solution[0]), (8, 0.3));
    }
}

#[test]
fn several_leaves_ask_for_a_tip() {
    let done = twin(["inspect", "motoman/sda10d"]);
    assert_refused(
        &done,
        "<library>/robots/motoman/sda10d/robot.urdf:1:1",
        &["--tip", "arm_left_link_tool0", "arm_right_link_tool0"],
    );
}

#[test]
fn unknown_names_are_told_with_the_nearest() {
    assert_refused(
        &twin(["inspect", "kuka/kr6_r900_six"]),
        "kuka/kr6_r900_six:1:1",
        &["did you mean `kuka/kr6_r900_sixx`?"],
    );
    let done = twin(["inspect", "kuka/kr6_r900_sixx", "--tip", "tool1"]);
    assert_refused(&done, "--tip:1:1", &["did you mean `tool0`?"]);
}

#[test]
fn bad_files_are_refused_at_their_place() {
    let dir = folder("badq");
    let cases = [
        ("short.json", "[[0, 0, 0, 0, 0, 0],\n [1, 2]]", "2:2"),
        ("nan.json", "[[0, 0,\nNaN, 0, 0, 0]]", "2:1"),
        ("large.json", "[[0, 0, 0,\n1e999, 0, 0]]", "2:1"),
        ("empty.json", "", "1:1"),
        ("word.json", "[\n\"x\"]", "2:1"),
    ];
    for (name, text, place) in cases {
        let file = write(&dir, name, text);
        let done = twin(["inspect", "kuka/kr6_r900_sixx", "--q", &file]);
        assert_refused(&done, &format!("{file}:{place}"), &[]);
    }
    let file = write(
        &dir,
        "pose.json",
        "[{\"position_m\": [0, 0, 0], \"quaternion_wxyz\": [2, 0, 0, 0]}]",
    );
    assert_refused(
        &twin(["inspect", "kuka/kr6_r900_sixx", "--ik", &file]),
        &format!("{file}:1:2"),
        &["rotation"],
    );
    let done = twin(["inspect", "kuka/kr6_r900_sixx", "--ik", &file, "--seed", "1,2"]);
    assert_refused(&done, "--seed:1:1", &["6 moving joints"]);
}

#[test]
fn own_urdf_with_missing_meshes_works_with_a_warning() {
    let dir = folder("urdf");
    let text = r#"<robot name="one"><link name="a"><collision><geometry>
<mesh filename="package://far/away.stl"/></geometry></collision></link><link name="b"/>
<joint name="turn" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 0 1"/>
<axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="1" effort="0"/></joint></robot>"#;
    let robot = write(&dir, "one.urdf", text);
    let q = write(&dir, "q.json", format!("[[{FRAC_PI_2}]]"));
    let done = twin(["inspect", &robot, "--q", &q]);
    assert!(done.err.contains(&format!("{robot}:2:17: warning: ")), "{}", done.err);
    assert!(done.err.contains("--package far=DIR"), "{}", done.err);
    let answer = json(&done);
    assert_eq!(vector(&answer[0]["position_m"]), [0.0, 0.0, 1.0]);
    let half = 0.5_f64.sqrt();
    for (found, expected) in
        vector(&answer[0]["quaternion_wxyz"]).iter().zip([half, 0.0, 0.0, half])
    {
        assert!((found - expected).abs() < 1e-15);
    }
}
