//! Controller, hoses, carried bodies and calibration of a cell file in SI.

use slam::cell_file::{CalibrationFile, CarriedFile, CellFile, ControllerFile, HoseFile};

use super::equipment::{Calibration, Controller, Hose, PoseError};
use super::machine::RobotLink;
use super::machine_from_files::shapes;
use crate::kinematics::Attachment;
use crate::pose::Point;

/// Time in which full acceleration is reached where the cell names no jerk, s: two interpolation
/// cycles of 12 ms of a KUKA controller; ours, assumed.
const JERK_TIME_S: f64 = 0.025;

/// Twist that a hose takes per metre where the cell names none, rad/m. Makers of torsion-rated
/// robot cables state ±180° per metre (general knowledge, to be checked against the data sheet).
const TWIST_RAD_PER_M: f64 = std::f64::consts::PI;

pub(super) fn controller(file: &ControllerFile) -> Controller {
    let acceleration_m_s2 = file.acceleration_mm_s2 / 1e3;
    Controller {
        linear: file.linear,
        acceleration_m_s2,
        jerk_m_s3: file.jerk_mm_s3.map_or(acceleration_m_s2 / JERK_TIME_S, |jerk| jerk / 1e3),
        joint_acceleration_share: file.joint_acceleration_percent / 100.0,
        blend_m: file.blend_mm / 1e3,
        joint_move_share: file.joint_move_percent / 100.0,
    }
}

pub(super) fn calibration(file: Option<&CalibrationFile>) -> Calibration {
    let stated = file.is_some();
    let file = file.cloned().unwrap_or_default();
    let error = |mm: f64, deg: f64| PoseError { offset_m: mm / 1e3, turn_rad: deg.to_radians() };
    Calibration {
        tool: error(file.tool_mm, file.tool_deg),
        base: error(file.base_mm, file.base_deg),
        form: error(file.form_mm, file.form_deg),
        stated,
    }
}

/// The hoses of a cell on the links of its robot.
///
/// # Errors
/// One sentence for the author of the cell.
pub(super) fn hoses(file: &CellFile, links: &[Attachment]) -> Result<Vec<Hose>, String> {
    file.hose.iter().map(|file| hose(file, links)).collect()
}

fn hose(file: &HoseFile, links: &[Attachment]) -> Result<Hose, String> {
    let at = link(&file.link, &format!("hose `{}` is fixed to", file.name), links)?;
    let point = |mm: [f64; 3]| Point::from(mm.map(|value| value / 1e3));
    let length_m = file.length_mm / 1e3;
    Ok(Hose {
        name: file.name.clone(),
        link: file.link.clone(),
        carrier: at.carrier,
        carrier_from_link: at.carrier_from_link,
        from: point(file.at_mm),
        to: point(file.tool_at_mm),
        length_m,
        radius_m: file.radius_mm / 1e3,
        twist_rad: file.twist_deg.map_or(length_m * TWIST_RAD_PER_M, f64::to_radians),
    })
}

/// The bodies that ride on links, as links of their own.
///
/// # Errors
/// One sentence for the author of the cell.
pub(super) fn carried(file: &CellFile, links: &[Attachment]) -> Result<Vec<RobotLink>, String> {
    file.carried.iter().map(|file| body(file, links)).collect()
}

fn body(file: &CarriedFile, links: &[Attachment]) -> Result<RobotLink, String> {
    let at = link(&file.link, &format!("`{}` is carried by", file.name), links)?;
    if links.iter().any(|link| link.link == file.name) {
        return Err(format!("carried body `{}` has the name of a link", file.name));
    }
    Ok(RobotLink {
        name: file.name.clone(),
        carrier: at.carrier,
        carrier_from_link: at.carrier_from_link,
        shapes: shapes(&file.shape),
    })
}

fn link<'a>(name: &str, who: &str, links: &'a [Attachment]) -> Result<&'a Attachment, String> {
    links.iter().find(|known| known.link == name).ok_or_else(|| {
        let names: Vec<&str> = links.iter().map(|link| link.link.as_str()).collect();
        format!("{who} link `{name}`, which the robot lacks; it has {}", names.join(", "))
    })
}
