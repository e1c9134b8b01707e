//! The two plane problems that every closed form here comes down to.

use std::f64::consts::PI;

use super::angle::{Angle, unit};
use super::arctangent::arctangent;

/// What a closed form allows for where its two roots meet or just miss each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Play {
    /// A target this far beyond reach is still tried, m; the check by forward kinematics decides.
    slack_m: f64,
    /// Two roots are put at least this far to either side of where they meet, m or rad.
    spread: f64,
}

/// Two roots this near to where they meet are close, m or rad.
const CLOSE: f64 = 1e-3;

impl Play {
    /// For an arm that is its closed form.
    pub(super) const EXACT: Self = Self { slack_m: 1e-9, spread: 0.0 };
    /// For one that is nearly, its URDF having rounded an angle: the closed form is a start only.
    pub(super) const ROUNDED: Self = Self { slack_m: 3e-5, spread: 0.0 };
    /// The same, further from a double root than it is: from there Newton's method nears the root of
    /// its side step by step, where a start at the root would throw it anywhere.
    pub(super) const SPREAD: Self = Self { slack_m: 3e-5, spread: CLOSE };

    /// Whether a triangle with these sides closes.
    pub(super) fn reaches(&self, reach: f64, first: f64, second: f64) -> bool {
        reach <= first + second + self.slack_m && reach >= (first - second).abs() - self.slack_m
    }
}

/// Whether the two roots of a swing, `forward` and `-forward`, are close.
pub(super) fn swings_meet(forward: f64) -> bool {
    forward.abs() < CLOSE
}

/// Whether the two roots of two links, `bend` and `-bend`, are close.
pub(super) fn links_meet(bend: &Angle) -> bool {
    bend.sin.abs() < CLOSE
}

/// Both turns `(angle, forward)` about z that bring the point `(forward, side)` onto `(x, y)`;
/// `forward ≥ 0` in the first. `None` where the point passes nearer to the axis than `side`.
///
/// On the axis itself the angle is free: then it is `free`, and `free + π` in the second.
pub(super) fn swing(x: f64, y: f64, side: f64, free: f64, play: Play) -> Option<[(Angle, f64); 2]> {
    let radius = (x * x + y * y).sqrt();
    if !(radius >= side.abs() - play.slack_m) {
        return None;
    }
    // Both lengths rounding, their angle would be noise.
    if radius < Play::EXACT.slack_m && side.abs() < Play::EXACT.slack_m {
        return Some([(Angle::of(free), 0.0), (Angle::of(free + PI), -0.0)]);
    }
    let forward = ((radius - side) * (radius + side)).max(0.0).sqrt().max(play.spread);
    let length = radius * (forward * forward + side * side).sqrt();
    Some([forward, -forward].map(|forward| {
        let (sin, cos) = (y * forward - x * side, x * forward + y * side);
        (Angle::along(sin, cos, length), forward)
    }))
}

/// Both `(first, second)` angles of two links in a plane, measured from z towards x, that put the
/// end on `(x, z)`; the second is `≥ 0` in the first. `None` out of reach.
pub(super) fn two_links(
    x: f64,
    z: f64,
    first: f64,
    second: f64,
    play: Play,
) -> Option<[(Angle, Angle); 2]> {
    let reach = (x * x + z * z).sqrt();
    if !play.reaches(reach, first, second) {
        return None;
    }
    let bend = bend(reach, first, second, play);
    let (along, across) = (first + second * bend.cos, second * bend.sin);
    let length = reach * (along * along + across * across).sqrt();
    let lean = |across: f64| Angle::along(x * along - z * across, z * along + x * across, length);
    Some([(lean(across), bend), (lean(-across), bend.opposite())])
}

/// Angle in [0, π] by which the second link is bent out of line with the first.
///
/// Law: cosine rule in half angles, `tan²(bend/2) = ((a + b)² − r²) / (r² − (a − b)²)`, its differences
/// as Heron's products so that it stays sharp near the stretched arm.
///
/// Where the reach differs from the stretched or folded one by rounding only, 2e-15 of the arm's
/// length, the bend would be noise of 1e-7: it is then exactly 0 or π.
pub(super) fn bend(reach: f64, first: f64, second: f64, play: Play) -> Angle {
    let (sum, difference) = (first + second, (first - second).abs());
    let least = 2e-15 * sum;
    // The two squares add up to 4ab, so these are sine and cosine already.
    let scale = 0.25 / (first * second);
    let root = |gap: f64, rest: f64| (gap * rest * scale).max(0.0).sqrt();
    let mut outer = root(sum - reach, sum + reach);
    let mut inner = root(reach - difference, reach + difference);
    if sum - reach < least {
        (outer, inner) = (0.0, 1.0);
    } else if reach - difference < least {
        (outer, inner) = (1.0, 0.0);
    }
    if play.spread > 0.0 {
        (outer, inner) = unit(outer.max(0.5 * play.spread), inner.max(0.5 * play.spread));
    }
    Angle {
        rad: 2.0 * arctangent(outer, inner),
        sin: 2.0 * outer * inner,
        cos: (inner - outer) * (inner + outer),
    }
}
