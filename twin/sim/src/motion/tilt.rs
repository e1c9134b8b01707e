//! How far the nozzle may lean off the axis it follows.

use crate::cell::{Orientation, Tilt};
use crate::pose::{Vector, from_z_axis};

/// Rounding must not refuse what lies on the bound, rad.
const SLACK_RAD: f64 = 1e-9;

/// The nozzle's axis leaned by `lean_rad`, in bed axes; `None` past a bound.
///
/// ```text
/// cone       R(a·e₁ + b·e₂) n       |(a, b)| ≤ free      ∠(n', −z) ≤ max
/// per axis   −(z + x·tan(α + a) + y·tan(β + b))          |a|, |b| ≤ free    |α + a|, |β + b| ≤ max
/// ```
///
/// `n` is the axis followed, `e₁`, `e₂` the axes of the unspun nozzle, `α`, `β` the tilts of `n` about the
/// bed's y and x. Where the axis followed lies past `max` already, it may not be leaned further out. *Per
/// axis* has no meaning for a nozzle that does not point down; the cone stands in there.
///
/// # Units
/// `axis`, result: unit, out of the nozzle, bed axes; `lean_rad`: rad
///
/// # Source
/// Cones of direction: users of spatial extrusion (descartes#200); the two bed axes apart: Kirkman et
/// al. 2019. The parameters are ours.
pub(super) fn leaned(
    axis: &Vector,
    lean_rad: [f64; 2],
    orientation: &Orientation,
) -> Option<Vector> {
    let [a, b] = lean_rad;
    if a == 0.0 && b == 0.0 {
        return Some(*axis);
    }
    let free_rad = orientation.tilt_free_rad + SLACK_RAD;
    if orientation.tilt == Tilt::PerAxis && axis.z < -1e-6 {
        let one = |followed_rad: f64, lean_rad: f64| {
            let tilt_rad = followed_rad + lean_rad;
            let most_rad = orientation.tilt_max_rad.max(followed_rad.abs()) + SLACK_RAD;
            let upright = std::f64::consts::FRAC_PI_2 - 1e-3;
            (lean_rad.abs() <= free_rad && tilt_rad.abs() <= most_rad.min(upright))
                .then(|| tilt_rad.tan())
        };
        let (x, y) = (one((axis.x / axis.z).atan(), a)?, one((axis.y / axis.z).atan(), b)?);
        return Some(-Vector::new(x, y, 1.0).normalize());
    }
    let angle = a.hypot(b);
    if angle > free_rad {
        return None;
    }
    let unspun = from_z_axis(crate::pose::Point::origin(), *axis, Vector::x());
    let side = unspun * Vector::new(a / angle, b / angle, 0.0);
    let leaned = axis * angle.cos() + side * angle.sin();
    let most_rad = orientation.tilt_max_rad.max(axis.angle(&-Vector::z())) + SLACK_RAD;
    (leaned.angle(&-Vector::z()) <= most_rad).then_some(leaned)
}

/// The leans tried at first: none, and six around.
pub(super) fn fan(orientation: &Orientation) -> Vec<[f64; 2]> {
    let mut leans = vec![[0.0; 2]];
    if orientation.tilt_free_rad > 0.0 {
        leans.extend((0..6).map(|k| {
            let turn = std::f64::consts::TAU * f64::from(k) / 6.0;
            [orientation.tilt_free_rad * turn.cos(), orientation.tilt_free_rad * turn.sin()]
        }));
    }
    leans
}
