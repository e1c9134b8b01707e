//! Shared helpers; the tests stand in the files below.

use std::f64::consts::{PI, TAU};
use std::path::PathBuf;

use nalgebra::Vector6;
use serde_json::Value;

use super::numeric::Xorshift;
use super::*;
use crate::pose::{Pose, from_xyz_rpy};

mod carried;
mod degenerate;
mod forward;
mod inverse;
mod measures;
mod published;
mod reach;
mod recognition;
mod tree;

/// A row of [`ARMS`].
type ArmRow = (&'static str, &'static str, &'static [(&'static str, f64)]);

/// Closed-form arms with a URDF in the shared data: file, tip, joints held.
const ARMS: [ArmRow; 7] = [
    ("kuka_kr6r900sixx", "tool0", &[]),
    ("kuka_kr10r1100sixx", "tool0", &[]),
    ("kroshu_kr6_r900_2", "tool0", &[]),
    ("abb_irb120_3_58", "tool0", &[]),
    ("motoman_sda10f", "arm_left_link_tool0", &[("torso_joint_b1", 0.0)]),
    ("motoman_sda10f", "arm_right_link_tool0", &[("torso_joint_b1", 0.3)]),
    ("ur10e", "tool0", &[]),
];

fn shared() -> PathBuf {
    std::env::var_os("TWIN_SHARED").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared")),
        PathBuf::from,
    )
}

/// Text of a shared file; `None`, said aloud, where there is none.
#[allow(clippy::print_stderr)]
fn shared_text(path: &str) -> Option<String> {
    let path = shared().join(path);
    match std::fs::read_to_string(&path) {
        Ok(text) => Some(text),
        Err(error) => {
            eprintln!("skipped: {}: {error}", path.display());
            None
        }
    }
}

fn shared_json(path: &str) -> Option<Value> {
    shared_text(path).map(|text| serde_json::from_str(&text).unwrap())
}

fn robot(file: &str) -> Option<slam::urdf::RobotDescription> {
    let text = shared_text(&format!("data/robots/urdf/{file}.urdf"))?;
    Some(slam::urdf::parse(&slam::Source::new(file, text)).unwrap())
}

fn arm(file: &str, tip: &str, held: &[(&str, f64)]) -> Option<Arm> {
    let tree = from_urdf(&robot(file)?, "base_link", tip, held).unwrap();
    Some(recognise(&tree.chain).unwrap())
}

fn closed_form_arms() -> Vec<(String, Arm)> {
    let arms = ARMS
        .iter()
        .filter_map(|(file, tip, held)| Some((format!("{file}:{tip}"), arm(file, tip, held)?)));
    arms.collect()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// A joint vector within limits; open ends count as ±π.
fn random_q(chain: &Chain, random: &mut Xorshift) -> Vec<f64> {
    let draw = |axis: &ChainAxis| {
        let (lower, upper) = (axis.lower.max(-TAU), axis.upper.min(TAU));
        lower + (upper - lower) * random.unit()
    };
    chain.axes().iter().map(draw).collect()
}

fn options<'a>(arm: &Arm, q: &[f64], seed: Option<&'a [f64]>) -> IkOptions<'a> {
    IkOptions { seed, elbow_rad: arm.elbow_angle(q).unwrap_or(0.0) }
}

/// Every solution by forward kinematics and limits, independently of what it says of itself.
fn check_solutions(arm: &Arm, target: &Pose, solutions: &[Solution]) {
    for solution in solutions {
        let (offset, turn) = pose_error(&arm.chain.forward(&solution.q), target);
        assert!(offset.norm() <= 1e-9 && turn.norm() <= 1e-9, "{offset} {turn} {solution:?}");
        for (value, axis) in solution.q.iter().zip(arm.chain.axes()) {
            assert!(*value >= axis.lower && *value <= axis.upper, "{solution:?}");
        }
    }
}
