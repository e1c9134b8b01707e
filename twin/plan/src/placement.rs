//! Where the part stands on the cell's bed.

use nalgebra::{Rotation3, Vector3};
use slam::document::Placement;

use crate::Bed;
use crate::document::unplaced;
use crate::frame::Frame;

/// A frame on its bed.
pub(crate) struct Placed {
    /// Part axes in bed axes.
    pub(crate) placement: Placement,
    /// Height of each node over the bed's plane, mm.
    pub(crate) heights_mm: Vec<f64>,
}

/// Part axes in bed axes: `R = R_bedᵀ R_part`, `t = R_bedᵀ (o_part − o_bed)` with the robot's base as
/// common axes, then `t` moved along the bed's normal until the lowest grounded node lies on the bed.
///
/// Where the bed rides on the flange the base is no common axes: the axes of the file are taken as
/// the bed's and the mean of the grounded nodes is put on its middle.
pub(crate) fn place(frame: &Frame, bed: Bed) -> Placed {
    let part = &frame.base_from_part;
    let (rotation, mut offset_mm) = match bed {
        Bed::InRobotBase { xyz_mm, rpy_deg } => {
            let [roll, pitch, yaw] = rpy_deg.map(f64::to_radians);
            let bed_from_base = Rotation3::from_euler_angles(roll, pitch, yaw).inverse();
            (
                bed_from_base * part.rotation,
                bed_from_base * (part.origin_mm - Vector3::from(xyz_mm)),
            )
        }
        Bed::OnFlange => {
            let mut grounded =
                frame.nodes.iter().filter(|node| node.grounded).map(|node| node.point_mm);
            let count = grounded.clone().count().max(1) as f64;
            let mean = grounded.by_ref().sum::<Vector3<f64>>() / count;
            (part.rotation, -(part.rotation * mean))
        }
    };
    let mut heights_mm: Vec<f64> =
        frame.nodes.iter().map(|node| (rotation * node.point_mm + offset_mm).z).collect();
    let grounded = frame.nodes.iter().zip(&heights_mm).filter(|(node, _)| node.grounded);
    let lowest_mm = grounded.map(|(_, &height)| height).fold(f64::INFINITY, f64::min);
    if lowest_mm.is_finite() {
        offset_mm.z -= lowest_mm;
        heights_mm.iter_mut().for_each(|height| *height -= lowest_mm);
    }
    let (roll, pitch, yaw) = rotation.euler_angles();
    let rpy_deg = [roll, pitch, yaw].map(|angle| tidy(angle.to_degrees()));
    let placement = Placement {
        xyz_mm: Some(unplaced([offset_mm.x, offset_mm.y, offset_mm.z].map(tidy))),
        rpy_deg: Some(unplaced(rpy_deg)),
    };
    Placed { placement, heights_mm }
}

/// Rounded to 1e-9 (a picometre, 2e-11 rad): 0 and 90 should read so after a product of rotations.
fn tidy(value: f64) -> f64 {
    (value * 1e9).round() / 1e9 + 0.0
}
