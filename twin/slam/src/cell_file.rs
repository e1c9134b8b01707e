//! `cells/<name>.toml`: which robot, which tool, what is fixed and what moves.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::tool_file::{LampFile, ShapeFile, lamps};
use crate::{Diagnostic, Source};

pub(crate) mod checks;
mod equipment;
mod limits;
#[cfg(test)]
mod tests;

pub use equipment::{CalibrationFile, CarriedFile, ControllerFile, HoseFile, LinearMove};
pub use limits::LimitsFile;

use checks::{Checks, Place, Rule, parse_checked};

/// Stronger gravity than this is a slip of units.
const STRONGEST_GRAVITY_M_S2: f64 = 100.0;

/// A cell as written.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellFile {
    /// Its name.
    pub name: String,
    /// Where its dimensions come from.
    pub source: String,
    /// Robot of the library (`kuka/kr6_r900_sixx`), or a path to a `.urdf` relative to this file.
    pub robot: String,
    /// `package://NAME` to folders relative to this file.
    #[serde(default)]
    pub packages: BTreeMap<String, String>,
    /// What rides on the flange.
    pub mode: Mode,
    /// First link of the chain; world axes are this link's.
    pub base: String,
    /// Last link of the chain.
    pub tip: String,
    /// Joints that stay put, degrees or mm.
    #[serde(default)]
    pub held_deg: BTreeMap<String, f64>,
    /// Posture between prints, degrees or mm, base → tip without held joints.
    pub home_deg: Vec<f64>,
    /// Gravity in world axes, m/s².
    #[serde(default = "standard_gravity")]
    pub gravity_m_s2: [f64; 3],
    /// Tool of the library by name.
    pub tool: String,
    /// Tool axes in tip axes (tool on flange) or in world axes (bed on flange).
    pub tool_pose: PoseFile,
    /// The bed.
    pub bed: BedFile,
    /// Bodies that stand around, in world axes.
    #[serde(default)]
    pub obstacle: Vec<ObstacleFile>,
    /// Hoses and cables from the arm to what rides on the flange.
    #[serde(default)]
    pub hose: Vec<HoseFile>,
    /// Bodies that ride on links of the arm.
    #[serde(default)]
    pub carried: Vec<CarriedFile>,
    /// How the controller moves.
    #[serde(default)]
    pub controller: ControllerFile,
    /// How well tool, bed and forms were measured; `None`: nobody said.
    pub calibration: Option<CalibrationFile>,
    /// The extruder.
    pub extruder: ExtruderFile,
    /// Default limits.
    pub limits: LimitsFile,
    /// Lamps that stand in the room, in world axes.
    #[serde(default)]
    pub lamp: Vec<LampFile>,
    /// Names of outputs that a job may switch.
    #[serde(default)]
    pub io: Vec<String>,
}

fn standard_gravity() -> [f64; 3] {
    [0.0, 0.0, -9.80665]
}

/// What rides on the flange.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mode {
    /// The nozzle moves, the bed is fixed in the world.
    ToolOnFlange,
    /// The bed moves, the nozzle is fixed in the world.
    BedOnFlange,
}

/// A pose: offset in mm, fixed-axes rotation in degrees.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PoseFile {
    /// Offset, mm.
    pub xyz_mm: [f64; 3],
    /// Rotation, degrees.
    #[serde(default)]
    pub rpy_deg: [f64; 3],
}

/// The bed. Its axes: origin at the centre of the top face, z out of it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BedFile {
    /// Bed axes in world axes (tool on flange) or in tip axes (bed on flange).
    pub pose: PoseFile,
    /// Width, depth, thickness, mm.
    pub size_mm: [f64; 3],
    /// Share of ultraviolet light that it throws back: nominal, low, high.
    pub albedo: Option<[f64; 3]>,
    /// Hold of the deposit on the bed, MPa: nominal, low, high.
    pub adhesion_mpa: [f64; 3],
    /// Mass of the bed and all that holds it on the flange, kg; asked for where it rides there.
    pub mass_kg: Option<f64>,
}

/// A body that stands around.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObstacleFile {
    /// Name used in findings.
    pub name: String,
    /// Its shape in world axes.
    pub shape: ShapeFile,
}

/// The extruder.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExtruderFile {
    /// Print speed for jobs that ask for none, mm/s.
    pub speed_mm_s: f64,
    /// Bead for jobs that ask for none, mm.
    pub diameter_mm: f64,
    /// Diameter of the strand over that of the orifice at matched speed: nominal, low, high.
    pub swell: [f64; 3],
    /// Volume flows that the extruder can be switched to, mm³/s; empty: any.
    #[serde(default)]
    pub levels_mm3_s: Vec<f64>,
    /// Time in which the flow comes within 1/e of what is told, s: nominal, low, high; not given:
    /// nobody knows, and it is taken as at once.
    pub lag_s: Option<[f64; 3]>,
    /// Volume between the mixer of a two-part resin and the orifice, mm³.
    pub mixer_mm3: Option<f64>,
    /// Approach and retract for jobs that ask for none, mm.
    pub approach_mm: f64,
    /// Speed of moves without extrusion, mm/s.
    pub travel_mm_s: f64,
    /// Force of the nozzle on the node it lands on, N: nominal, low, high.
    pub nozzle_force_n: [f64; 3],
}

/// Reads a cell; refuses missing and impossible values, each with its place.
///
/// # Errors
/// Every problem found, in order of place.
pub fn parse(source: &Source) -> Result<CellFile, Vec<Diagnostic>> {
    parse_checked(source, |cell, checks| {
        for key in ["name", "robot", "base", "tip", "tool"] {
            checks.text(cell.get(key), "name what is meant");
        }
        checks.text(cell.get("source"), "say where the dimensions come from, or \"ours\"");
        chain(cell, checks);
        gravity(cell, checks);
        pose(cell.get("tool_pose"), checks);
        if let Some(bed) = cell.get("bed") {
            pose(bed.get("pose"), checks);
            checks.numbers(bed.get("size_mm"), Rule::Positive);
            checks.interval(bed.get("adhesion_mpa"), Rule::NotNegative);
            checks.interval(bed.get("albedo"), Rule::FromTo(0.0, 1.0));
            checks.number(bed.get("mass_kg"), Rule::Positive);
        }
        let obstacles = cell.get("obstacle").map(Place::items).unwrap_or_default();
        let names: Vec<_> = obstacles.iter().filter_map(|place| place.get("name")).collect();
        checks.distinct(&names, "obstacles");
        for obstacle in obstacles {
            checks::shapes::shape(obstacle.get("shape"), checks);
        }
        checks.distinct(&cell.get("io").map(Place::items).unwrap_or_default(), "outputs");
        equipment::check(cell, checks);
        let linear = cell.get("controller").and_then(|controller| controller.get("linear"));
        if let Some(linear) = linear.filter(|linear| linear.text() == Some("set-tool"))
            && cell.get("mode").is_some_and(|mode| mode.text() == Some("tool-on-flange"))
        {
            let says =
                "`set-tool` moves a part under a fixed nozzle; here the tool is on the flange";
            checks.error(linear, says.to_owned());
        }
        extruder(cell.get("extruder"), checks);
        lamps(cell, checks);
        limits::check(cell.get("limits"), checks);
    })
}

fn chain(cell: Place<'_>, checks: &mut Checks) {
    if let (Some(base), Some(tip)) = (cell.get("base"), cell.get("tip"))
        && base.text().is_some_and(|base| !base.is_empty() && tip.text() == Some(base))
    {
        checks.error(tip, "`base` and `tip` are the same link: nothing moves".to_owned());
    }
    for held in cell.get("held_deg").map(Place::entries).unwrap_or_default() {
        checks.number(Some(held), Rule::Finite);
    }
    let Some(home) = cell.get("home_deg") else { return };
    checks.numbers(Some(home), Rule::Finite);
    if home.numbers().is_some_and(|home| home.is_empty()) {
        checks.refuse(
            Diagnostic::error(home.span(), "`home_deg` is empty")
                .hint("one number per moving joint, base to tip, without held joints"),
        );
    }
}

fn gravity(cell: Place<'_>, checks: &mut Checks) {
    let Some(gravity) = cell.get("gravity_m_s2") else { return };
    checks.numbers(Some(gravity), Rule::Finite);
    let strength = gravity.numbers().map(|g| g.iter().map(|g| g * g).sum::<f64>().sqrt());
    if let Some(strength) = strength
        && strength > STRONGEST_GRAVITY_M_S2
    {
        let says = format!("gravity of {strength} m/s² is ten times the Earth's and more");
        checks.refuse(Diagnostic::error(gravity.span(), says).hint("the unit is m/s², not mm/s²"));
    }
}

fn pose(pose: Option<Place<'_>>, checks: &mut Checks) {
    let Some(pose) = pose else { return };
    checks.numbers(pose.get("xyz_mm"), Rule::Finite);
    checks.numbers(pose.get("rpy_deg"), Rule::FromTo(-360.0, 360.0));
}

fn extruder(extruder: Option<Place<'_>>, checks: &mut Checks) {
    let Some(extruder) = extruder else { return };
    for key in ["speed_mm_s", "diameter_mm", "travel_mm_s"] {
        checks.number(extruder.get(key), Rule::Positive);
    }
    checks.number(extruder.get("approach_mm"), Rule::NotNegative);
    checks.interval(extruder.get("swell"), Rule::Positive);
    checks.interval(extruder.get("nozzle_force_n"), Rule::NotNegative);
    checks.numbers(extruder.get("levels_mm3_s"), Rule::Positive);
    checks.interval(extruder.get("lag_s"), Rule::NotNegative);
    checks.number(extruder.get("mixer_mm3"), Rule::Positive);
}
