//! A strand that the nozzle runs into.

use crate::pose::{Point, Pose, Vector};
use nalgebra::{Translation3, UnitQuaternion};

/// `pushed_from_printed` of a strand that is held at one end and struck at a point which the nozzle
/// carries along by `by`; part axes, m.
///
/// ```text
/// R (struck - held) ∥ struck + by - held      least turn about the held end
/// ```
///
/// The strand stays straight and slides along the nozzle without friction. An illustration: a real
/// strand bends, and holds or breaks at its end. A push straight through the held end turns it half
/// about, to either side; no push, no lever or numbers that are not finite leave it where it is.
pub fn pushed_aside(held: Point, struck: Point, by: Vector) -> Pose {
    let (lever, wanted) = (struck - held, struck + by - held);
    let turn = match (lever.try_normalize(0.0), wanted.try_normalize(0.0)) {
        (Some(from), Some(to)) => turn(&from, &to),
        _ => UnitQuaternion::identity(),
    };
    let pose = Pose::from_parts(Translation3::from(held.coords - turn * held.coords), turn);
    if pose.to_homogeneous().iter().all(|x| x.is_finite()) { pose } else { Pose::identity() }
}

/// The least turn between two unit vectors; half a turn where they are opposite.
fn turn(from: &Vector, to: &Vector) -> UnitQuaternion<f64> {
    UnitQuaternion::rotation_between(from, to).unwrap_or_else(|| {
        let aside = if from.x.abs() < 0.9 { Vector::x() } else { Vector::y() };
        let axis = nalgebra::Unit::new_normalize(from.cross(&aside));
        UnitQuaternion::from_axis_angle(&axis, std::f64::consts::PI)
    })
}
