//! The controller, hoses, lamps, air, and how well the cell was measured.

pub use slam::cell_file::LinearMove;

use crate::interval::Interval;
use crate::pose::{Point, Pose, Vector};

/// How the controller moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Controller {
    /// What a linear move between two points keeps on a line.
    pub linear: LinearMove,
    /// Acceleration of the TCP along a line, m/s².
    pub acceleration_m_s2: f64,
    /// Jerk of the TCP along a line, m/s³.
    pub jerk_m_s3: f64,
    /// Share of the joints' acceleration limits that is used.
    pub joint_acceleration_share: f64,
    /// Distance at which a corner is rounded off, m; 0: an exact stop.
    pub blend_m: f64,
    /// Share of the joints' speed limits used in moves between prints.
    pub joint_move_share: f64,
}

impl Controller {
    /// Time and length of the ramp from rest to `speed_m_s` along a line, s and m.
    ///
    /// Law: an S-curve of jerk `j` that reaches acceleration `a` if the speed leaves it time,
    ///
    /// ```text
    /// t = v/a + a/j   where v ≥ a²/j, else   t = 2 √(v/j);   s = v t / 2
    /// ```
    ///
    /// The mean speed of a symmetric ramp is half its end speed; `j → ∞` gives `s = v²/2a`.
    pub fn ramp(&self, speed_m_s: f64) -> (f64, f64) {
        let (a, j) = (self.acceleration_m_s2, self.jerk_m_s3);
        let full = speed_m_s >= a * a / j;
        let time_s = if full { speed_m_s / a + a / j } else { 2.0 * (speed_m_s / j).sqrt() };
        (time_s, speed_m_s * time_s / 2.0)
    }
}

/// A hose or cable from a link of the arm to what rides on the flange.
#[derive(Debug, Clone, PartialEq)]
pub struct Hose {
    /// Its name.
    pub name: String,
    /// URDF name of the link it is fixed to.
    pub link: String,
    /// The chain joint that link moves with; `None`: it stands with the base.
    pub carrier: Option<usize>,
    /// Link axes in the axes of the carrier (or the base).
    pub carrier_from_link: Pose,
    /// Where it leaves the link, link axes.
    pub from: Point,
    /// Where it arrives, tool axes (tool on flange) or bed axes (bed on flange).
    pub to: Point,
    /// Length between the two, m.
    pub length_m: f64,
    /// Radius, m.
    pub radius_m: f64,
    /// Largest twist of its ends against each other, from home, counted over full turns, rad.
    pub twist_rad: f64,
}

/// A lamp, in the axes of what carries it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lamp {
    /// Its place.
    pub at: Point,
    /// The way it shines, unit.
    pub along: Vector,
    /// Radiant intensity on its axis, W/sr.
    pub peak_w_sr: Interval,
    /// Full angle at half intensity, rad.
    pub full_angle_rad: f64,
}

/// An air nozzle on the tool, in tool axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AirNozzle {
    /// Middle of its mouth.
    pub at: Point,
    /// The way it blows, unit.
    pub along: Vector,
    /// Diameter of its bore, m.
    pub bore_m: f64,
    /// Air speed at its mouth, m/s.
    pub exit_m_s: Interval,
}

/// How far a place in the cell may be from where the files say it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseError {
    /// Offset in any direction, m.
    pub offset_m: f64,
    /// Turn about any axis, rad.
    pub turn_rad: f64,
}

/// How well tool, bed and forms were measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Calibration {
    /// Tool in flange axes, turned about the flange's centre; with the bed on the flange the tool
    /// in the world, turned about its orifice.
    pub tool: PoseError,
    /// Bed, turned about its origin.
    pub base: PoseError,
    /// Forms in part axes, turned about their middle.
    pub form: PoseError,
    /// Whether the cell's file states any of it; else a tenth of a millimetre and of a degree is
    /// assumed for each.
    pub stated: bool,
}
