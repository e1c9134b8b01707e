//! How fast a body on the arm can move for the motion of each joint: bounds over whole ranges of
//! joint values, for proofs that something between two postures cannot have been hit.

use std::f64::consts::FRAC_PI_2;

use super::chain::{Chain, ChainJoint, JointKind};
use crate::pose::Vector;

/// A ball that holds what it stands for, m.
#[derive(Debug, Clone, Copy)]
struct Ball {
    centre: Vector,
    radius_m: f64,
}

/// The limits of every entry of `q` as `(lower, upper)`, rad or m: what [`levers`] takes for "anywhere".
pub fn ranges(chain: &Chain) -> Vec<(f64, f64)> {
    chain.axes().iter().map(|axis| (axis.lower, axis.upper)).collect()
}

/// Upper bound, per entry of `q`, on the path of any point of a body for that joint's motion: m per
/// rad for turning joints, m per m for sliding ones. The body rides with joint `carrier` (index in
/// [`Chain::joints`]; `None`: with the base) inside the ball about `centre` (in the axes of that joint's
/// child link, [`Chain::link_poses`]) of radius `radius_m`. It holds for all `q` with every entry
/// within its `(lower, upper)` of `ranges` ([`ranges`] for the joints' limits), so a motion inside them takes
/// no point of the body further than `Σ |Δq_i| lever_i`, and one of rates `q̇` moves it no faster than `Σ |q̇_i| lever_i`.
///
/// Law: a point moves with a turning joint at its distance from that axis, with a sliding one at 1. The
/// ball is carried from the body back towards the base; at each joint what it sweeps over the joint's range is
/// put in a ball again: about the middle of its arc while that is short, about the foot on the axis once
/// the joint may turn by half a turn or more, about the middle of the travel of a sliding joint. Joints
/// past the carrier get 0, those before a sliding joint without limits ∞. A follower adds to its master.
///
/// For ranges of one value each it is the distance of the ball from each axis plus its radius. Error:
/// rounding, some 1e-16 of the arm's length.
pub fn levers(
    chain: &Chain,
    ranges: &[(f64, f64)],
    carrier: Option<usize>,
    centre: &Vector,
    radius_m: f64,
) -> Vec<f64> {
    let mut levers = vec![0.0; chain.dof()];
    let mut ball = Ball { centre: *centre, radius_m };
    let moving = carrier.map_or(0, |last| (last + 1).min(chain.joints().len()));
    for (joint, drive) in chain.joints()[..moving].iter().zip(&chain.drives[..moving]).rev() {
        let lever = match joint.kind {
            JointKind::Revolute => across(joint, &ball.centre).norm() + ball.radius_m,
            JointKind::Prismatic => 1.0,
        };
        levers[drive.axis] += drive.multiplier.abs() * lever;
        let (lower, upper) =
            ranges.get(drive.axis).copied().unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let (one, other) =
            (drive.multiplier * lower + drive.offset, drive.multiplier * upper + drive.offset);
        let swept = sweep(joint, &ball, one.min(other), one.max(other));
        let centre = joint.parent_from_joint * nalgebra::Point3::from(swept.centre);
        ball = Ball { centre: centre.coords, radius_m: swept.radius_m };
    }
    levers
}

/// From the joint's axis straight to a point.
fn across(joint: &ChainJoint, point: &Vector) -> Vector {
    point - joint.axis * joint.axis.dot(point)
}

/// A ball, in the joint's axes at zero, round all that `ball` sweeps for joint values from `lower` to `upper`.
fn sweep(joint: &ChainJoint, ball: &Ball, lower: f64, upper: f64) -> Ball {
    let (middle, half) = (0.5 * (lower + upper), 0.5 * (upper - lower));
    let (centre, growth) = match joint.kind {
        // No limits: anywhere along the line.
        JointKind::Prismatic if !(half < f64::INFINITY) => (ball.centre, f64::INFINITY),
        JointKind::Prismatic => (ball.centre + joint.axis * middle, half),
        JointKind::Revolute => {
            let out = across(joint, &ball.centre);
            let foot = ball.centre - out;
            if half < FRAC_PI_2 {
                let turned = out * middle.cos() + joint.axis.cross(&out) * middle.sin();
                (foot + turned * half.cos(), out.norm() * half.sin())
            } else {
                (foot, out.norm())
            }
        }
    };
    Ball { centre, radius_m: ball.radius_m + growth }
}
