//! Where linear buckling is near: the frame followed with large displacements and an imperfection.

use crate::structure::corotational::{Options, Outcome, nonlinear, subdivided};
use crate::structure::{BucklingAsk, Frame, Load, Support, buckling};

/// From this buckling factor on linear answers are trusted (structures.md section 7).
pub(super) const TRUSTED: f64 = 4.0;
/// The imperfection over the length of the member that moves most, in the shape of the mode (structures.md
/// section 7: `L/200` or the measured sag).
const IMPERFECTION: f64 = 1.0 / 200.0;
/// Frames above this many members are not followed: each step factors the tangent of all halves anew.
const MEMBERS_MAX: usize = 2000;
/// Steps of a walk.
const STEPS: usize = 120;

/// The factor up to which an imperfect frame is stable, at most that of its linear buckling; `None` where it cannot be
/// found or is not asked (the factor is [`TRUSTED`], the frame too large).
///
/// The perfect frame's lowest mode, two parts to a member, scaled to `L/200` of the member that moves most, is put on free of
/// stress, and load and locked-in strain grow together until the frame loses stability or reaches the linear factor.
pub(super) fn followed(frame: &Frame, supports: &[Support], load: &Load) -> Option<f64> {
    let modes = buckling(frame, supports, load, BucklingAsk::default()).ok()?;
    let mode = modes.first().filter(|mode| mode.factor < TRUSTED)?;
    if frame.members().len() > MEMBERS_MAX {
        return None;
    }
    let [a, b] = frame.members()[mode.member].ends.map(|node| frame.nodes()[node]);
    let size_m = IMPERFECTION * (b - a).norm();
    let shape = mode.displacement.iter().chain(mode.inner.iter().flatten());
    let offsets: Vec<[f64; 3]> =
        shape.map(|six| [six[0] * size_m, six[1] * size_m, six[2] * size_m]).collect();
    let halves = subdivided(frame, 2);
    let options = Options { until: mode.factor, steps: STEPS, ..Options::default() };
    let path = nonlinear(&halves, supports, load, &offsets, &options).ok()?;
    let reached = match path.outcome {
        Outcome::Converged => mode.factor,
        Outcome::LimitPoint { factor }
        | Outcome::Branches { factor }
        | Outcome::NotConverged { factor } => factor,
    };
    Some(reached.min(mode.factor))
}
