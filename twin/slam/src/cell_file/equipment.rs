//! What a cell says beyond its shapes: the controller, hoses, bodies that ride on links, and how
//! well tool, bed and forms were measured. All of it may be left out.

use serde::Deserialize;

use super::checks::{Checks, Place, Rule, shapes};
use crate::Diagnostic;
use crate::tool_file::ShapeFile;

/// How the controller moves. Every key has a default.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ControllerFile {
    /// Acceleration of the TCP along a line, mm/s².
    pub acceleration_mm_s2: f64,
    /// Jerk of the TCP along a line, mm/s³; not given: full acceleration within 25 ms.
    pub jerk_mm_s3: Option<f64>,
    /// Share of the joints' acceleration limits that is used, percent.
    pub joint_acceleration_percent: f64,
    /// Distance at which a corner is rounded off, mm; 0: an exact stop at every corner.
    pub blend_mm: f64,
    /// Share of the joints' speed limits used in moves between prints, percent.
    pub joint_move_percent: f64,
    /// What a linear move between two points keeps on a line.
    pub linear: LinearMove,
}

/// What a linear move between two points keeps on a line.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LinearMove {
    /// The TCP, seen from the part.
    #[default]
    Tcp,
    /// The point of the part that is to come under a fixed nozzle: each point is a tool frame of
    /// its own, set before the move, and the nozzle leaves the line where the part turns.
    SetTool,
}

impl Default for ControllerFile {
    /// 1000 mm/s²: a little below UR's own default for `movel` (1.2 m/s²) and KUKA's 2.3 m/s²;
    /// the rest ours: what stops at corners and is slowed by nothing else.
    fn default() -> Self {
        Self {
            acceleration_mm_s2: 1000.0,
            jerk_mm_s3: None,
            joint_acceleration_percent: 100.0,
            blend_mm: 0.0,
            joint_move_percent: 100.0,
            linear: LinearMove::Tcp,
        }
    }
}

/// A hose or cable from a link of the arm to what rides on the flange.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HoseFile {
    /// Name used in findings.
    pub name: String,
    /// URDF link it is fixed to.
    pub link: String,
    /// Where it leaves that link, mm in the link's axes.
    pub at_mm: [f64; 3],
    /// Where it arrives, mm in tool axes (tool on flange) or bed axes (bed on flange).
    pub tool_at_mm: [f64; 3],
    /// Length between the two, mm.
    pub length_mm: f64,
    /// Radius, mm.
    pub radius_mm: f64,
    /// Largest twist of its ends against each other, from home, counted over full turns, degrees;
    /// not given: 180° per metre.
    pub twist_deg: Option<f64>,
}

/// A body that rides on a link of the arm: a feeder, a hose bundle, a camera.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CarriedFile {
    /// Name used in findings.
    pub name: String,
    /// URDF link it is fixed to.
    pub link: String,
    /// Its shape in that link's axes.
    pub shape: ShapeFile,
}

/// How far off the calibrated places may be. A table that is there counts as measured.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CalibrationFile {
    /// Place of the tool in flange axes (bed on flange: in the world), mm.
    pub tool_mm: f64,
    /// Its turn about the flange's centre (bed on flange: about the orifice), degrees.
    pub tool_deg: f64,
    /// Place of the bed's origin, mm.
    pub base_mm: f64,
    /// Turn of the bed about its origin, degrees.
    pub base_deg: f64,
    /// Place of a form's middle, mm.
    pub form_mm: f64,
    /// Turn of a form about its middle, degrees.
    pub form_deg: f64,
}

impl Default for CalibrationFile {
    /// A tenth of a millimetre and of a degree each.
    fn default() -> Self {
        Self {
            tool_mm: 0.1,
            tool_deg: 0.1,
            base_mm: 0.1,
            base_deg: 0.1,
            form_mm: 0.1,
            form_deg: 0.1,
        }
    }
}

/// Checks all of them.
pub(super) fn check(cell: Place<'_>, checks: &mut Checks) {
    controller(cell.get("controller"), checks);
    let items = |key: &str| cell.get(key).map(Place::items).unwrap_or_default();
    let (hoses, carried) = (items("hose"), items("carried"));
    distinct(&hoses, "hoses", checks);
    distinct(&carried, "carried bodies", checks);
    for hose in hoses {
        self::hose(hose, checks);
    }
    for body in carried {
        checks.text(body.get("link"), "name the link of the URDF that carries it");
        shapes::shape(body.get("shape"), checks);
    }
    if let Some(calibration) = cell.get("calibration") {
        for error in calibration.entries() {
            let degrees = error.name().ends_with("_deg");
            let rule = if degrees { Rule::FromTo(0.0, 10.0) } else { Rule::FromTo(0.0, 100.0) };
            checks.number(Some(error), rule);
        }
    }
}

fn distinct(places: &[Place<'_>], what: &str, checks: &mut Checks) {
    let names: Vec<_> = places.iter().filter_map(|place| place.get("name")).collect();
    checks.distinct(&names, what);
}

fn controller(controller: Option<Place<'_>>, checks: &mut Checks) {
    let Some(controller) = controller else { return };
    for key in ["acceleration_mm_s2", "jerk_mm_s3"] {
        checks.number(controller.get(key), Rule::Positive);
    }
    for key in ["joint_acceleration_percent", "joint_move_percent"] {
        checks.number(controller.get(key), Rule::AboveUpTo(0.0, 100.0));
    }
    checks.number(controller.get("blend_mm"), Rule::NotNegative);
}

fn hose(hose: Place<'_>, checks: &mut Checks) {
    checks.text(hose.get("link"), "name the link of the URDF it is fixed to");
    for key in ["at_mm", "tool_at_mm"] {
        checks.numbers(hose.get(key), Rule::Finite);
    }
    for key in ["length_mm", "radius_mm", "twist_deg"] {
        checks.number(hose.get(key), Rule::Positive);
    }
    let [Some(length), Some(radius)] = ["length_mm", "radius_mm"].map(|key| hose.get(key)) else {
        return;
    };
    if let (Some(length_mm), Some(radius_mm)) = (length.number(), radius.number())
        && length_mm > 0.0
        && radius_mm >= length_mm
    {
        let says = format!("a hose of radius {radius_mm} is wider than its length of {length_mm}");
        checks.refuse(
            Diagnostic::error(radius.span(), says)
                .hint("both are in mm; the radius is half the diameter"),
        );
    }
}
