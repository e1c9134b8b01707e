//! The cell: robot, tool, bed and what stands around.

use crate::dynamics::{Body, Model};
use crate::interval::Interval;
use crate::kinematics::Arm;
use crate::pose::{Pose, Vector};
use crate::process::{Jet, LightRing};
use crate::shape::Shape;

use super::equipment::{AirNozzle, Calibration, Controller, Hose, Lamp};
use super::job::Limits;

/// A cell. World axes are those of the chain's base link.
#[derive(Debug, Clone)]
pub struct Cell {
    /// Its name in the library.
    pub name: String,
    /// The arm.
    pub robot: Robot,
    /// What rides on the flange.
    pub mode: Mode,
    /// The nozzle with all around it.
    pub tool: Tool,
    /// Tool axes in tip axes (tool on flange) or in world axes (bed on flange).
    pub tool_pose: Pose,
    /// The bed.
    pub bed: Bed,
    /// Bodies that stand around, world axes.
    pub obstacles: Vec<Obstacle>,
    /// Hoses from the arm to what rides on the flange.
    pub hoses: Vec<Hose>,
    /// Lamps that stand in the room, in world axes.
    pub lamps: Vec<Lamp>,
    /// How the controller moves.
    pub controller: Controller,
    /// How well tool, bed and forms were measured.
    pub calibration: Calibration,
    /// Posture between prints, rad or m, one per joint of the arm.
    pub home: Vec<f64>,
    /// Gravity in world axes, m/s².
    pub gravity_m_s2: Vector,
    /// The extruder.
    pub extruder: Extruder,
    /// Outputs that a job may switch.
    pub io: Vec<String>,
    /// Default limits.
    pub limits: Limits,
}

impl Cell {
    /// Pose of the tool in the world when the tip of the arm is at `world_from_tip`.
    pub fn world_from_tool(&self, world_from_tip: &Pose) -> Pose {
        match self.mode {
            Mode::ToolOnFlange => world_from_tip * self.tool_pose,
            Mode::BedOnFlange => self.tool_pose,
        }
    }

    /// Pose of the bed in the world when the tip of the arm is at `world_from_tip`.
    pub fn world_from_bed(&self, world_from_tip: &Pose) -> Pose {
        match self.mode {
            Mode::ToolOnFlange => self.bed.pose,
            Mode::BedOnFlange => world_from_tip * self.bed.pose,
        }
    }

    /// Pose of the tool in bed axes in a posture of the arm.
    pub fn bed_from_tool(&self, q: &[f64]) -> Pose {
        let world_from_tip = self.robot.arm.chain.forward(q);
        self.world_from_bed(&world_from_tip).inverse() * self.world_from_tool(&world_from_tip)
    }

    /// What rides on the flange before anything is printed, tip axes; `None` where its mass is
    /// unknown.
    pub fn flange_load(&self) -> Option<Body> {
        match self.mode {
            Mode::ToolOnFlange => Some(self.tool.body()?.seen_from(&self.tool_pose)),
            Mode::BedOnFlange => Some(self.bed.body()?.seen_from(&self.bed.pose)),
        }
    }

    /// The arm with its masses and the cell's gravity, nothing on its flange; `None` where the URDF
    /// has no masses.
    pub fn dynamics(&self) -> Option<Model> {
        let masses = self.robot.masses.as_ref()?;
        let bare = Model::new(&self.robot.arm.chain, masses, self.gravity_m_s2).ok()?;
        Some(bare.with_rotors(&self.robot.rotors))
    }

    /// Pose of the tip that brings the tool to `bed_from_tool`.
    pub fn world_from_tip(&self, bed_from_tool: &Pose) -> Pose {
        match self.mode {
            Mode::ToolOnFlange => self.bed.pose * bed_from_tool * self.tool_pose.inverse(),
            Mode::BedOnFlange => self.tool_pose * bed_from_tool.inverse() * self.bed.pose.inverse(),
        }
    }
}

/// What rides on the flange.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// The nozzle moves, the bed is fixed in the world.
    ToolOnFlange,
    /// The bed moves, the nozzle is fixed in the world.
    BedOnFlange,
}

/// An arm with its links.
#[derive(Debug, Clone)]
pub struct Robot {
    /// Maker and model.
    pub name: String,
    /// The chain from base to tip and how it is solved.
    pub arm: Arm,
    /// Every link of the URDF that has a shape, also those beside the chain, and after them the
    /// bodies the cell says ride on links.
    pub links: Vec<RobotLink>,
    /// Pairs of links (indices into `links`) that may touch: neighbours and stated pairs.
    pub touching: Vec<[usize; 2]>,
    /// Acceleration limits, rad/s² or m/s², where known.
    pub acceleration: Vec<Option<f64>>,
    /// Torque limits, N m or N, where known.
    pub torque: Vec<Option<f64>>,
    /// Inertia of rotors and gears seen at the joints, kg m² or kg; zero where unknown.
    pub rotors: Vec<f64>,
    /// What every joint of the chain carries, in axes of its child link; `None`: the URDF has no
    /// masses.
    pub masses: Option<Vec<Body>>,
    /// Rated payload, kg, where known.
    pub payload_kg: Option<f64>,
    /// Where the centre of the rated payload may sit, tip axes, m, where known.
    pub payload_centre: Option<Vector>,
    /// Absolute accuracy of a pose, m.
    pub accuracy_m: f64,
    /// Whether the link shapes are drawn by us without a mesh behind them.
    pub shapes_assumed: bool,
}

/// A rigid link with its shapes.
#[derive(Debug, Clone)]
pub struct RobotLink {
    /// URDF name.
    pub name: String,
    /// The chain joint it moves with; `None`: it stands with the base.
    pub carrier: Option<usize>,
    /// Link axes in the axes of the carrier (or the base).
    pub carrier_from_link: Pose,
    /// Shapes in link axes.
    pub shapes: Vec<Shape>,
}

/// A tool. Its axes: origin at the orifice, z along the strand as it leaves.
#[derive(Debug, Clone)]
pub struct Tool {
    /// Its name in the library.
    pub name: String,
    /// Diameter of the orifice, m.
    pub orifice_m: f64,
    /// Mass, kg, where known.
    pub mass_kg: Option<f64>,
    /// Centre of mass in tool axes, m, where known.
    pub centre: Option<Vector>,
    /// Named parts.
    pub parts: Vec<ToolPart>,
    /// All its air nozzles together, where they are not told one by one.
    pub air_jet: Option<Jet>,
    /// Its air nozzles one by one.
    pub air_nozzles: Vec<AirNozzle>,
    /// Light ring.
    pub light_ring: Option<LightRing>,
    /// Lamps besides the ring.
    pub lamps: Vec<Lamp>,
}

/// A named part of the tool, as convex shapes in tool axes.
#[derive(Debug, Clone)]
pub struct ToolPart {
    /// Its name.
    pub name: String,
    /// Whether it is the nozzle itself.
    pub nozzle: bool,
    /// Its shapes.
    pub shapes: Vec<Shape>,
}

/// The bed. Its axes: origin at the centre of the top face, z out of it.
#[derive(Debug, Clone)]
pub struct Bed {
    /// Bed axes in world axes (tool on flange) or in tip axes (bed on flange).
    pub pose: Pose,
    /// Width, depth, thickness, m.
    pub size_m: [f64; 3],
    /// Share of ultraviolet light that it throws back; `None`: nobody knows.
    pub albedo: Option<Interval>,
    /// Mass with all that holds it on the flange, kg, where known.
    pub mass_kg: Option<f64>,
    /// Hold of the deposit on it, Pa.
    pub adhesion_pa: Interval,
}

impl Bed {
    /// The bed as a box in bed axes.
    pub fn shape(&self) -> Shape {
        let half_m = Vector::from(self.size_m) / 2.0;
        Shape::Box { pose: Pose::translation(0.0, 0.0, -half_m.z), half_m }
    }
}

impl Tool {
    /// The tool as a body in tool axes; `None` where its mass is unknown. Where only its centre is
    /// unknown the origin stands for it: the orifice is as a rule farther from the flange than the
    /// centre, so that moments come out too large rather than too small.
    pub fn body(&self) -> Option<Body> {
        Some(Body::point(self.mass_kg?, self.centre.unwrap_or_else(Vector::zeros)))
    }
}

impl Bed {
    /// The bed as a body in bed axes, a plate of its size; `None` where its mass is unknown.
    pub fn body(&self) -> Option<Body> {
        let size = Vector::from(self.size_m);
        let centre = Pose::translation(0.0, 0.0, -size.z / 2.0);
        Some(Body::cuboid(self.mass_kg?, size, &centre))
    }
}

/// A body that stands around.
#[derive(Debug, Clone)]
pub struct Obstacle {
    /// Its name.
    pub name: String,
    /// Its shapes in world axes.
    pub shapes: Vec<Shape>,
}

/// The extruder.
#[derive(Debug, Clone)]
pub struct Extruder {
    /// Print speed for jobs that ask for none, m/s.
    pub speed_m_s: f64,
    /// Bead for jobs that ask for none, m.
    pub diameter_m: f64,
    /// Diameter of the strand over that of the orifice at matched speed.
    pub swell: Interval,
    /// Flows it can be switched to, m³/s; empty: any.
    pub levels_m3_s: Vec<f64>,
    /// Approach and retract for jobs that ask for none, m.
    pub approach_m: f64,
    /// Speed of moves without extrusion, m/s.
    pub travel_m_s: f64,
    /// Time in which the flow comes within 1/e of what is told, s; `None`: nobody knows.
    pub lag_s: Option<Interval>,
    /// Volume between the mixer of a two-part resin and the orifice, m³.
    pub mixer_m3: Option<f64>,
    /// Force of the nozzle on the node it lands on, N.
    pub nozzle_force_n: Interval,
}
