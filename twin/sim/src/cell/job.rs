//! The job: what is to be printed, resolved against the cell, in SI and part axes.

use slam::Span;
pub use slam::document::{Follow, Interpolation, Tilt};

use super::machine::Cell;
use crate::interval::Interval;
use crate::pose::{Point, Pose, Vector};
use crate::process::Material;

/// A job ready to be simulated.
#[derive(Debug, Clone)]
pub struct Job {
    /// What its author calls it.
    pub name: String,
    /// The cell it is printed in.
    pub cell: Cell,
    /// The material.
    pub material: Material,
    /// Part axes in bed axes.
    pub bed_from_part: Pose,
    /// The air around the print.
    pub air: Air,
    /// Bodies the print is laid on.
    pub forms: Vec<Form>,
    /// What is extruded.
    pub strands: Vec<Strand>,
    /// The order of events; every strand once.
    pub steps: Vec<Step>,
    /// Loads of the finished part.
    pub loads: Vec<LoadCase>,
    /// Limits of acceptance.
    pub limits: Limits,
}

impl Job {
    /// Strand indices in printing order.
    pub fn print_order(&self) -> impl Iterator<Item = usize> + '_ {
        self.steps.iter().filter_map(|step| match step {
            Step::Print(strand) => Some(*strand),
            _ => None,
        })
    }

    /// Pose of the tool in part axes in a posture of the arm.
    pub fn part_from_tool(&self, q: &[f64]) -> Pose {
        self.bed_from_part.inverse() * self.cell.bed_from_tool(q)
    }

    /// Gravity in part axes when the tip of the arm is at `world_from_tip`, m/s².
    pub fn gravity_in_part(&self, world_from_tip: &Pose) -> Vector {
        let world_from_part = self.cell.world_from_bed(world_from_tip) * self.bed_from_part;
        world_from_part.inverse() * self.cell.gravity_m_s2
    }
}

/// The air around the print.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Air {
    /// Its temperature, K.
    pub temperature_k: f64,
    /// Its speed away from the tool's own jets, m/s.
    pub speed_m_s: f64,
}

/// A body the print is laid on and released from.
#[derive(Debug, Clone)]
pub struct Form {
    /// Its name.
    pub id: String,
    /// Vertices in part axes.
    pub vertices: Vec<Point>,
    /// Triangles.
    pub triangles: Vec<[u32; 3]>,
    /// Hold of the deposit on it, Pa: as told, or that of the bed.
    pub adhesion_pa: Interval,
}

/// What a strand rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum On {
    /// Nothing but its ends.
    Air,
    /// The bed.
    Bed,
    /// The form of this index.
    Form(usize),
}

/// What an end is joined to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Join {
    /// The bed.
    Bed,
    /// Nothing.
    Free,
    /// The form of this index.
    Form(usize),
    /// The strand of this index.
    Strand(usize),
}

/// One end of a strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct End {
    /// What it is joined to; `None`: found from the geometry.
    pub join: Option<Join>,
    /// Rest at this end, s.
    pub dwell_s: f64,
}

/// What the extruder is told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Flow {
    /// The bead of this diameter at the asked speed, m.
    Diameter(f64),
    /// A volume flow, m³/s.
    Rate(f64),
}

impl Flow {
    /// Volume flow told to the extruder, m³/s, at the asked speed.
    pub fn rate_m3_s(self, speed_m_s: f64) -> f64 {
        match self {
            Self::Diameter(d) => std::f64::consts::FRAC_PI_4 * d * d * speed_m_s,
            Self::Rate(rate) => rate,
        }
    }
}

/// Rotation about the nozzle's own axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spin {
    /// Chosen by the twin.
    Free,
    /// Held at this angle from the bed's x axis, rad.
    Held(f64),
}

/// How the nozzle is oriented.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orientation {
    /// What its axis follows.
    pub follow: Follow,
    /// Shape of the tilt bound.
    pub tilt: Tilt,
    /// Inclination of the strand up to which the nozzle stays vertical, rad.
    pub tilt_from_rad: f64,
    /// Largest tilt, rad.
    pub tilt_max_rad: f64,
    /// How far the nozzle may be leaned off the axis it follows, rad.
    pub tilt_free_rad: f64,
    /// Rotation about its axis.
    pub spin: Spin,
}

/// Thin threads that leave a strand and come back to it in knots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Threads {
    /// How many.
    pub count: u32,
    /// Diameter of one, m.
    pub diameter_m: f64,
    /// From one knot to the next, m.
    pub pitch_m: f64,
    /// Farthest from the strand's axis to theirs, m.
    pub sweep_m: f64,
}

/// Process values of one strand.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Asked TCP speed, m/s.
    pub speed_m_s: f64,
    /// What the extruder is told.
    pub flow: Flow,
    /// Extrusion at rest before the start, s.
    pub prime_s: f64,
    /// Length printed before the lights go on, m.
    pub lights_after_m: f64,
    /// Length travelled past the end, m.
    pub overrun_m: f64,
    /// Rest at the end, s.
    pub dwell_s: f64,
    /// Speed of a second pass with the lights on and no extrusion, m/s.
    pub second_pass_m_s: Option<f64>,
    /// Dose of a post-cure from all around, once all is printed, J/m².
    pub post_cure_j_m2: Option<f64>,
    /// Thin threads knotted to the strand.
    pub threads: Option<Threads>,
    /// Straight approach, m.
    pub approach_m: f64,
    /// Straight retract, m.
    pub retract_m: f64,
    /// Nozzle orientation.
    pub orientation: Orientation,
    /// Motion between points.
    pub interpolation: Interpolation,
}

/// A change along the strand, valid from `at_m` on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfilePoint {
    /// Arc length, m.
    pub at_m: f64,
    /// TCP speed from here on, m/s.
    pub speed_m_s: Option<f64>,
    /// Volume flow from here on, m³/s.
    pub flow_m3_s: Option<f64>,
}

/// Where along a strand an event happens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum At {
    /// Arc length, m.
    Length(f64),
    /// Time, s.
    Time(f64),
}

/// A switch during a strand.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// Counted from the end rather than the start.
    pub from_end: bool,
    /// Where.
    pub at: At,
    /// What is switched.
    pub set: String,
    /// To what.
    pub on: bool,
}

/// One continuous extrusion.
#[derive(Debug, Clone, PartialEq)]
pub struct Strand {
    /// Its name.
    pub id: String,
    /// Its place in the job's text.
    pub span: Span,
    /// Polyline in part axes, m.
    pub points: Vec<Point>,
    /// Nozzle axis at each point, unit, out of the nozzle.
    pub directions: Option<Vec<Vector>>,
    /// Joint path to check as it stands, rad or m.
    pub joints: Option<Vec<Vec<f64>>>,
    /// Given time law, s.
    pub times_s: Option<Vec<f64>>,
    /// What it rests on.
    pub on: On,
    /// First end.
    pub start: End,
    /// Last end.
    pub end: End,
    /// Changes along it.
    pub profile: Vec<ProfilePoint>,
    /// Switches along it.
    pub events: Vec<Event>,
    /// Its process values.
    pub settings: Settings,
}

impl Strand {
    /// Asked speed, m/s, and flow told, m³/s, from `at_m` on; before the first profile point, and
    /// for −∞, those of its settings.
    pub fn asked(&self, at_m: f64) -> (f64, f64) {
        let mut speed_m_s = self.settings.speed_m_s;
        let mut flow_m3_s = self.settings.flow.rate_m3_s(speed_m_s);
        for point in self.profile.iter().take_while(|point| point.at_m <= at_m) {
            speed_m_s = point.speed_m_s.unwrap_or(speed_m_s);
            flow_m3_s = point.flow_m3_s.unwrap_or(flow_m3_s);
        }
        (speed_m_s, flow_m3_s)
    }
}

/// One step of the program.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// Print the strand of this index.
    Print(usize),
    /// Follow a joint path, rad or m.
    Move(Vec<Vec<f64>>),
    /// Wait, s.
    Wait(f64),
    /// Take the part off the form of this index.
    Release(usize),
    /// A place where the print may be resumed.
    Checkpoint(String),
}

/// A held point of the finished part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// Place in part axes.
    pub at: Point,
    /// Held freedoms: three translations, three rotations.
    pub fixed: [bool; 6],
}

/// A point force on the finished part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointForce {
    /// Place in part axes.
    pub at: Point,
    /// Force in part axes, N.
    pub force_n: Vector,
}

/// A load case of the finished part.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadCase {
    /// Its name.
    pub name: String,
    /// Held points.
    pub supports: Vec<Support>,
    /// Forces.
    pub forces: Vec<PointForce>,
}

/// Limits of acceptance, SI, all positive.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// Least clearance of bodies that may not touch, m.
    pub clearance_m: f64,
    /// Nozzle and deposit may touch within this distance of a node they share, m.
    pub touch_zone_m: f64,
    /// Largest miss of a node at landing, m.
    pub node_miss_m: f64,
    /// Largest sag of a strand, m.
    pub sag_m: f64,
    /// Least distance of a revolute joint to its stop, rad.
    pub joint_margin_rad: f64,
    /// Largest share of a joint's speed limit.
    pub joint_speed_share: f64,
    /// Condition number of the Jacobian (length scale 1 m) that warns, and that stops.
    pub condition_number: [f64; 2],
    /// Least wrist angle from its singularity, rad.
    pub wrist_rad: f64,
    /// Largest distance from the orifice at which the strand must be set, m.
    pub set_distance_m: f64,
    /// Largest deflection of the finished part under its loads, m.
    pub deflection_m: f64,
    /// Largest share of the strength of a member or node while printing.
    pub strength_share: f64,
    /// Least factor on what the growing frame carries at which it buckles.
    pub buckling_factor: f64,
    /// Least factor on the loads at which the finished part yields or collapses.
    pub load_factor: f64,
    /// Share of a strand's radius left uncured that warns, and that stops.
    pub uncured_share: [f64; 2],
    /// Largest difference of the TCP's speed from the asked one, as a share of it.
    pub speed_band: f64,
    /// Largest share of a joint's torque limit.
    pub torque_share: f64,
    /// Largest share of a joint's acceleration limit.
    pub acceleration_share: f64,
    /// Largest difference of the bead's diameter from the asked one, as a share of it.
    pub bead_band: f64,
    /// Least and largest speed of the nozzle over that of a free strand.
    pub draw_ratio: [f64; 2],
    /// Largest dose at the nozzle's tip while one bead passes, as a share of the critical exposure.
    pub tip_dose_share: f64,
    /// Largest angle between the nozzle's axis and the strand, rad.
    pub nozzle_angle_rad: Option<f64>,
    /// Longest the program may take, s.
    pub cycle_time_s: Option<f64>,
}
