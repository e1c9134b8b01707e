//! The parts of a report that tell results: strands, stages, landings, motion, loads.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::parts::Phase;
use crate::program::{Budget, Cycle, Hose, Payload, TcpSpeed, Tracking};

/// A number that is not known exactly; null where it is not finite (never sets, sags without end).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Range {
    /// What is expected.
    pub value: Option<f64>,
    /// Low end.
    pub low: Option<f64>,
    /// High end.
    pub high: Option<f64>,
}

/// What became of one strand.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Strand {
    /// Its name in the job.
    pub id: String,
    /// Its line in the job's text, from 1.
    pub line: Option<usize>,
    /// Start of its extrusion, s.
    pub start_s: Option<f64>,
    /// End of its extrusion, s.
    pub end_s: Option<f64>,
    /// Its length, m.
    pub length_m: Option<f64>,
    /// Mean asked speed of the nozzle, m/s.
    pub speed_m_s: Option<f64>,
    /// Mean flow the extruder is told, m³/s.
    pub flow_m3_s: Option<f64>,
    /// What holds it while it is printed.
    pub ends: Ends,
    /// Longest unsupported span, m.
    pub span_m: Option<f64>,
    /// Diameter once set, m.
    pub bead_m: Range,
    /// Nozzle speed over the speed of a free strand.
    pub draw_ratio: Range,
    /// Age at which it is set, s; null: never.
    pub set_time_s: Range,
    /// How far behind the nozzle that is, m; null: never.
    pub set_distance_m: Range,
    /// Sag behind the nozzle, m.
    pub sag_nozzle_m: Range,
    /// Whether that is inside linear theory at its nominal value; else an order of magnitude.
    pub sag_linear: bool,
    /// Sag of a strand longer than its chord, m.
    pub sag_slack_m: Range,
    /// Sag of the set strand under its own weight, m.
    pub sag_set_m: Range,
    /// How far its end is pulled back after the nozzle has left it, m.
    pub end_miss_m: Range,
    /// Shortening still to come when the nozzle leaves, were the end free, m: locked in as strain where it is joined.
    pub shortening_m: Range,
    /// Depth cured from the surface at the least lit place, m; null: not a photopolymer.
    pub cured_depth_m: Option<Range>,
    /// Weakest bond to an earlier strand; null: it touches none.
    pub bond: Option<Bond>,
    /// Where later strands warm it most; null: none touches it, or it is no thermoplastic.
    pub reheated: Option<Reheated>,
    /// Beads along it, as drawn: thinnest and widest over what was asked, away from the ends; null: too short.
    pub bead_share: Option<[f64; 2]>,
    /// Balls of what comes out at rest, diameters, m: before the start, at the end, after leaving.
    pub blobs_m: [Option<f64>; 3],
    /// What a section is at ages after the nozzle.
    pub ageing: Ageing,
    /// As printed, part axes, m; every point or an even choice of them.
    pub centreline_m: Vec<[f64; 3]>,
    /// Radius left uncured, m; null: not a photopolymer.
    pub uncured_core_m: Option<Range>,
    /// Warmest it gets by its own heat of cure, K; null: no photopolymer, or that heat is not known.
    pub warmest_k: Option<Range>,
    /// Share of the area that is solid.
    pub area_fraction: Range,
    /// Share of the bending stiffness that is solid.
    pub stiffness_fraction: Range,
    /// Linear strain it still wants to lose once set; positive is shorter.
    pub free_strain: Range,
    /// Laws used.
    pub laws: Vec<String>,
    /// What the arm does along it; null: nothing of it is reached.
    pub motion: Option<StrandMotion>,
    /// True speed of the TCP along it; null: nothing of it is reached.
    pub tcp_speed: Option<TcpSpeed>,
    /// What errors of calibration do to where it lies.
    pub error_budget: Option<Budget>,
}

/// How well a strand holds to an earlier one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bond {
    /// How far it has healed, 0 to 1; low and high with it.
    pub value: Option<f64>,
    /// Low end.
    pub low: Option<f64>,
    /// High end.
    pub high: Option<f64>,
    /// What it bears, N.
    pub strength_n: Range,
    /// The earlier strand.
    pub to: String,
    /// Where on the strand, m.
    pub at_m: f64,
    /// By the law of healing; else the material's bond fraction, measured on other prints.
    pub by_law: bool,
}

/// How a later strand's nozzle warms an earlier one as it crosses it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reheated {
    /// Mean temperature of the section, K.
    pub peak_k: Range,
    /// Time it is above the glass transition, s.
    pub above_glass_s: Range,
    /// Length above it, m.
    pub softened_m: Range,
    /// The later strand.
    pub by: String,
    /// Where on the strand, m.
    pub at_m: f64,
}

/// A section against its age, nominal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ageing {
    /// Ages, s.
    pub age_s: Vec<f64>,
    /// Mean temperature, K.
    pub temperature_k: Vec<Option<f64>>,
    /// Temperature on the axis, K; empty but for thermoplastics.
    pub core_k: Vec<Option<f64>>,
    /// Degree of cure at the surface; empty where its kinetics are not known.
    pub cure: Vec<Option<f64>>,
    /// Young's modulus, Pa.
    pub modulus_pa: Vec<Option<f64>>,
}

/// What holds a strand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Ends {
    /// Joined at both ends.
    BothHeld,
    /// Joined where it begins; the far end is free when the nozzle leaves.
    StartHeld,
    /// Lies on bed or form.
    Resting,
}

/// What the arm does along a strand, at its worst.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StrandMotion {
    /// Largest share of a joint's speed limit at the asked print speed.
    pub joint_speed_share: Option<f64>,
    /// Least distance of a revolute joint to its stop, rad; null: no stops.
    pub joint_margin_rad: Option<f64>,
    /// Largest condition number, length scale 1 m; null: singular.
    pub condition_number: Option<f64>,
    /// Largest distance of the TCP from the strand as the job moves it, m.
    pub deviation_m: Option<f64>,
    /// The same if the controller moves in lines, m.
    pub deviation_linear_m: Option<f64>,
    /// The same if the joints turn evenly between points, m.
    pub deviation_joint_m: Option<f64>,
    /// Least angle of the wrist from its singularity, rad; null: no such wrist.
    pub wrist_rad: Option<f64>,
    /// Least angle of the elbow from straight or folded, rad; null: no such elbow.
    pub elbow_rad: Option<f64>,
    /// Least distance of the wrist's centre from axis 1, m; null: not of a known type.
    pub shoulder_m: Option<f64>,
    /// Where along the strand each of these is worst.
    pub worst_at: WorstAt,
}

/// Arc lengths at which a strand's motion is worst, m, and the joints concerned.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WorstAt {
    /// Of the joint speed.
    pub joint_speed_m: f64,
    /// The joint that is fastest for what it can.
    pub joint_speed: Option<String>,
    /// Of the margin to a stop.
    pub joint_margin_m: f64,
    /// The joint that is nearest to its stop.
    pub joint_margin: Option<String>,
    /// Of the condition number.
    pub condition_m: f64,
    /// Of the wrist.
    pub wrist_m: f64,
    /// Of the elbow.
    pub elbow_m: f64,
    /// Of the shoulder.
    pub shoulder_m: f64,
}

/// The frame at one moment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stage {
    /// Number of strands printed.
    pub printed: usize,
    /// The form just released, if this stage is a release.
    pub released: Option<String>,
    /// Largest displacement, gravity on the frame as it stands so far, m; null: nothing solved.
    pub one_shot_m: Option<f64>,
    /// Largest displacement when each strand is born stress-free on the frame as it then stands, m.
    pub staged_m: Option<f64>,
    /// Node of the largest one-shot displacement.
    pub node: Option<usize>,
    /// Largest share of strength used, one-shot.
    pub utilisation: Option<f64>,
    /// Forces left out of balance relative to the loads, one-shot.
    pub residual: Option<f64>,
    /// Largest pull on what bed or form holds over what it holds; null: nothing there may lift.
    pub hold: Option<f64>,
    /// Largest displacement by this release with the shrinkage locked in, staged, m; null: no
    /// release, or a piece of which nothing is held any more.
    pub released_m: Option<f64>,
}

/// What moves a node that a strand begins or ends on, each part by itself, in part axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Landing {
    /// The strand that lands.
    pub strand: String,
    /// Whether it is its end rather than its start.
    pub at_end: bool,
    /// The node.
    pub node: usize,
    /// Displacement by gravity, m.
    pub frame_m: Option<[f64; 3]>,
    /// Displacement by shrinkage, m.
    pub shrinkage_m: Option<[f64; 3]>,
    /// Displacement by the nozzle's push, m.
    pub push_m: Option<[f64; 3]>,
    /// Length of the push, m.
    pub push_length_m: Range,
    /// Length of the sum of the three, m.
    pub sum_m: Option<f64>,
    /// Accuracy of the arm, m; of unknown direction.
    pub accuracy_m: Option<f64>,
}

/// The motion as a whole.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// Length of the program, s.
    pub total_s: Option<f64>,
    /// Smallest clearance measured; null: nothing came near anything.
    pub smallest_clearance: Option<Nearest>,
    /// Whether every posture was looked at or a search's.
    pub ik_coverage: Coverage,
    /// Where the time goes.
    pub cycle: Cycle,
    /// What hangs on the flange; null: its mass is not known.
    pub payload: Option<Payload>,
    /// Use of every hose of the cell.
    pub hoses: Vec<Hose>,
    /// How the drives follow the hardest stop of the program, by simulation; null: no masses known.
    pub tracking: Option<Tracking>,
}

/// Two bodies at their nearest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Nearest {
    /// Clearance, m; negative: overlap.
    pub clearance_m: Option<f64>,
    /// No clearance of this pair on this motion is less than that by more than this, m.
    pub resolution_m: Option<f64>,
    /// Stated accuracy of the arm, m; comes on top.
    pub accuracy_m: Option<f64>,
    /// The two bodies.
    pub bodies: [String; 2],
    /// What the arm is doing.
    pub phase: Phase,
    /// The strand it belongs to; null: none.
    pub strand: Option<String>,
    /// Arc length on it, m.
    pub at_m: Option<f64>,
    /// The orifice then, m in part axes.
    pub point_m: [Option<f64>; 3],
    /// When, s.
    pub time_s: Option<f64>,
}

/// Whether inverse kinematics finds every posture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Coverage {
    /// All branches, in closed form.
    Complete,
    /// What a numerical search found.
    Sampled,
}

/// What a load case came to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadCase {
    /// Its name.
    pub name: String,
    /// Largest displacement of a node under weight and forces, m; null: not solved.
    pub deflection_m: Option<f64>,
    /// Factor on the forces at which the first member yields; null: not found.
    pub first_yield: Option<f64>,
    /// Factor on weight and forces together at which the frame, were it perfect, would buckle; null: at none, or not
    /// found. Held against nothing yet.
    pub buckling_factor: Option<f64>,
    /// Why the case could not be solved, if it could not.
    pub fault: Option<String>,
}
