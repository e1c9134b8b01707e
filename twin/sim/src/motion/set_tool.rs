//! Where a fixed nozzle goes in the part when the controller moves the part's next point to it.
//!
//! The Motoman cell's way: every point of the strand is a tool frame of its own on the flange; per point the
//! program sets that tool (`SETTOOL`) and moves it in a line (`MOVL`) to the one pose of the nozzle. The line is one
//! of the *next point* in the world, so where the part turns on the way the nozzle leaves the strand.

use crate::pose::{Pose, Vector};

/// Pose of the nozzle in bed axes at share `t` of the move from one point to the next.
///
/// ```text
/// B(t) = slerp(B₀, B₁, t)                    orientation of the nozzle in the bed
/// p(t) = b₁ + (1 − t) B(t) B₀ᵀ (b₀ − b₁)     place of the nozzle in the bed
/// ```
///
/// In the world the bed's point `b₁` runs straight to the nozzle while the bed turns evenly. Half way the nozzle
/// is off the chord by `L/2·sin(θ/2) ≈ L·θ/4` for a turn `θ` about an axis across a chord of length `L`; 50 mm
/// and 20° leave 4.3 mm. It does not depend on where the flange is.
///
/// # Units
/// Poses in m, `t` in [0, 1]
///
/// # Errors
/// Orientations half a turn apart have no shorter way; the first is kept.
///
/// # Source
/// Kirkman-DM/Motoman-SDA-10D-freeform-toolpath-code (per point `SETTOOL TL#(12) Pnnnn`, `MOVL Cnnnnn`); the closed
/// form is ours.
pub(super) fn nozzle_at(from: &Pose, to: &Pose, t: f64) -> Pose {
    let turned = from.rotation.try_slerp(&to.rotation, t, 1e-9).unwrap_or(from.rotation);
    let chord = from.translation.vector - to.translation.vector;
    let place: Vector =
        to.translation.vector + turned * (from.rotation.inverse() * chord) * (1.0 - t);
    Pose::from_parts(place.into(), turned)
}

/// Pose at share `t` of a line of the TCP, turning evenly.
pub(super) fn straight(from: &Pose, to: &Pose, t: f64) -> Pose {
    let turned = from.rotation.try_slerp(&to.rotation, t, 1e-9).unwrap_or(from.rotation);
    let place = from.translation.vector.lerp(&to.translation.vector, t);
    Pose::from_parts(place.into(), turned)
}
