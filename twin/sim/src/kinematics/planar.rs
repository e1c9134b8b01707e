//! The two plane problems that every closed form here comes down to.

use std::f64::consts::PI;

/// A target this far beyond reach is still tried, m; the check by forward kinematics decides.
const SLACK_M: f64 = 1e-9;

/// Both turns `(angle, forward)` about z that bring the point `(forward, side)` onto `(x, y)`;
/// `forward ≥ 0` in the first. `None` where the point passes nearer to the axis than `side`.
///
/// On the axis itself the angle is free: then it is `free`, and `free + π` in the second.
pub(super) fn swing(x: f64, y: f64, side: f64, free: f64) -> Option<[(f64, f64); 2]> {
    let radius = x.hypot(y);
    if !(radius >= side.abs() - SLACK_M) {
        return None;
    }
    // Both lengths rounding, their angle would be noise.
    if radius < SLACK_M && side.abs() < SLACK_M {
        return Some([(free, 0.0), (free + PI, -0.0)]);
    }
    let forward = ((radius - side) * (radius + side)).max(0.0).sqrt();
    let bearing = y.atan2(x);
    Some([forward, -forward].map(|forward| (bearing - side.atan2(forward), forward)))
}

/// Both `(first, second)` angles of two links in a plane, measured from z towards x, that put the
/// end on `(x, z)`; the second is `≥ 0` in the first. `None` out of reach.
///
/// Law: cosine rule, its sine from Heron's product so that it stays sharp near the stretched arm.
pub(super) fn two_links(x: f64, z: f64, first: f64, second: f64) -> Option<[(f64, f64); 2]> {
    let reach = x.hypot(z);
    if !(reach <= first + second + SLACK_M && reach >= (first - second).abs() - SLACK_M) {
        return None;
    }
    let bend = bend(reach, first, second);
    let bearing = x.atan2(z);
    Some([bend, -bend].map(|bend| {
        let (sin, cos) = bend.sin_cos();
        (bearing - (second * sin).atan2(first + second * cos), bend)
    }))
}

/// Angle in [0, π] by which the second link is bent out of line with the first.
///
/// Where the reach differs from the stretched or folded one by rounding only, 2e-15 of the arm's
/// length, the bend would be noise of 1e-7: it is then exactly 0 or π.
pub(super) fn bend(reach: f64, first: f64, second: f64) -> f64 {
    let least = 2e-15 * (first + second);
    let root = |gap: f64, rest: f64| if gap < least { 0.0 } else { (gap * rest).sqrt() };
    let outer = root(first + second - reach, first + second + reach);
    let inner = root(reach - (first - second).abs(), reach + (first - second).abs());
    2.0 * outer.atan2(inner)
}
