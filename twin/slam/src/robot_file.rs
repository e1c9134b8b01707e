//! `robot.toml`: what a URDF cannot say about an arm, with sources.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::cell_file::checks::{Checks, Place, Rule, parse_checked};
use crate::{Diagnostic, Source};

/// What stands beside `robot.urdf`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotFile {
    /// Maker and exact model, as on the type plate.
    pub name: String,
    /// Where the joint chain and limits come from.
    pub source: String,
    /// What a reader must know before trusting it; empty: nothing.
    #[serde(default)]
    pub note: String,
    /// How its inverse kinematics is solved; checked against what the chain really is.
    pub branch_type: BranchType,
    /// Files whose link shapes no mesh backs say so here: `assumed`, made a little too big.
    pub link_shapes: LinkShapes,
    /// Rated payload at the flange, kg.
    pub payload_kg: Option<f64>,
    /// Where the centre of the rated payload may sit, in axes of the tip link, mm.
    pub payload_centre_mm: Option<[f64; 3]>,
    /// Repeatability as the maker states it, mm.
    pub repeatability_mm: Option<f64>,
    /// Absolute accuracy assumed for an arm that was not calibrated, mm.
    pub accuracy_mm: Option<f64>,
    /// Per joint, by URDF name.
    #[serde(default)]
    pub joints: BTreeMap<String, JointFile>,
    /// Where the numbers under `joints` come from.
    #[serde(default)]
    pub joints_source: String,
    /// Pairs of links that touch by design and are not checked against each other.
    #[serde(default)]
    pub touching_links: Vec<[String; 2]>,
    /// Whether the maker's third joint value moves with the second (Fanuc); +1, −1 or 0.
    #[serde(default)]
    pub coupling_j2_j3: i8,
}

/// How an arm's inverse kinematics is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BranchType {
    /// Six joints, ortho-parallel base, spherical wrist: eight branches in closed form.
    Opw,
    /// Seven joints, spherical shoulder, elbow, spherical wrist: closed form by elbow angle.
    Srs,
    /// Prismatic axes only: closed form, position alone.
    Cartesian,
    /// Anything else, by iteration.
    Numeric,
}

/// What the collision shapes of the links rest on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LinkShapes {
    /// Drawn by us from dimensions, a little too big; the report names it.
    Assumed,
    /// Enclose the maker's meshes (checked by a test where the meshes are at hand).
    EnclosesMesh,
}

/// Limits of one joint that URDF has no place for.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointFile {
    /// Largest acceleration, rad/s² or m/s².
    pub acceleration: Option<f64>,
    /// Largest torque, N m, where the URDF's `effort` is not it.
    pub torque_n_m: Option<f64>,
    /// Inertia of rotor and gear seen at the joint, kg m² (kg where it slides).
    pub rotor_inertia_kg_m2: Option<f64>,
    /// Maker's zero minus ours, degrees.
    #[serde(default)]
    pub maker_zero_deg: f64,
}

/// Reads `robot.toml`; refuses missing and impossible values, each with its place.
///
/// # Errors
/// Every problem found, in order of place.
pub fn parse(source: &Source) -> Result<RobotFile, Vec<Diagnostic>> {
    parse_checked(source, |robot, checks| {
        checks.text(robot.get("name"), "maker and exact model, as on the type plate");
        checks.text(robot.get("source"), "say where chain and limits come from");
        for key in ["payload_kg", "repeatability_mm", "accuracy_mm"] {
            checks.number(robot.get(key), Rule::Positive);
        }
        checks.numbers(robot.get("payload_centre_mm"), Rule::Finite);
        if let (Some(centre), None) = (robot.get("payload_centre_mm"), robot.get("payload_kg")) {
            checks.refuse(
                Diagnostic::error(centre.span(), "a centre of the payload, but no payload")
                    .hint("add a line `payload_kg = …`"),
            );
        }
        checks.number(robot.get("coupling_j2_j3"), Rule::FromTo(-1.0, 1.0));
        joints(robot, checks);
        let pairs = robot.get("touching_links").map(Place::items).unwrap_or_default();
        for pair in pairs {
            checks.distinct(&pair.items(), "links of a pair");
        }
    })
}

fn joints(robot: Place<'_>, checks: &mut Checks) {
    let Some(joints) = robot.get("joints") else { return };
    for joint in joints.entries() {
        checks.number(joint.get("acceleration"), Rule::Positive);
        checks.number(joint.get("torque_n_m"), Rule::Positive);
        checks.number(joint.get("rotor_inertia_kg_m2"), Rule::NotNegative);
        checks.number(joint.get("maker_zero_deg"), Rule::FromTo(-360.0, 360.0));
    }
    let said = robot.get("joints_source").and_then(Place::text);
    if !joints.entries().is_empty() && said.unwrap_or_default().trim().is_empty() {
        checks.refuse(
            Diagnostic::error(joints.span(), "the numbers under `joints` have no source")
                .hint("add a line `joints_source = \"…\"`"),
        );
    }
}
