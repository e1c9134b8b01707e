//! What an arm carries against what it may carry (E501).

use std::f64::consts::TAU;

use super::body::Body;
use super::model::{JointVector, Model};
use crate::kinematics::{Chain, JointKind};
use crate::pose::{Pose, Vector};

/// A value and what it may be at most, in one unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Against {
    /// The value.
    pub measured: f64,
    /// The most it may be.
    pub limit: f64,
}

/// What a [`WristMoment`] is held against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// Holding torque of the arm and all it carries against the joint's torque limit.
    Torque,
    /// Mass times greatest lever against that of the rated payload at its rated centre.
    RatedPayload,
}

/// Static moment about one of the last three turning joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WristMoment {
    /// Entry of the joint vector.
    pub joint: usize,
    /// Moment and what is allowed, N m.
    pub moment: Against,
    /// What the limit is.
    pub basis: Basis,
}

/// All that hangs on the flange as one body. The parts are given in the same axes.
pub fn carried(parts: &[Body]) -> Body {
    parts.iter().fold(Body::none(), |whole, part| whole.with(part))
}

/// Mass on the flange against the rated payload, kg.
pub fn payload(load: &Body, rated_kg: f64) -> Against {
    Against { measured: load.mass_kg, limit: rated_kg }
}

/// Static moments about the last three turning joints, `load` in tip axes.
///
/// Where the masses of the arm and a joint's torque limit are known: the greatest torque that holds
/// arm and load in any of the `postures` ([`Basis::Torque`]). Else, where the maker says at which
/// centre (tip axes) the rated payload may sit: `m |g| l` with the greatest lever `l` that any
/// posture of the next two joints further out gives, against the same of the rated payload
/// ([`Basis::RatedPayload`]). Joints of which neither is known are left out, so are those that the
/// rated payload does not load.
pub fn wrist_moments(
    chain: &Chain,
    postures: &[JointVector],
    gravity: Vector,
    load: &Body,
    arm: Option<(&Model, &[Option<f64>])>,
    rated: Option<(f64, Vector)>,
) -> Vec<WristMoment> {
    let turning =
        |&axis: &usize| chain.joints()[chain.axes()[axis].joint].kind == JointKind::Revolute;
    let mut wrist: Vec<usize> = (0..chain.dof()).rev().filter(turning).take(3).collect();
    wrist.reverse();
    let holding =
        arm.map(|(model, limits)| (model.with_gravity(gravity).with_payload(load), limits));
    let moment = |joint: usize| {
        if let Some((model, limits)) = &holding
            && let Some(limit) = limits.get(joint).copied().flatten()
        {
            let torques = postures.iter().map(|q| model.holding_torques(q)[joint].abs());
            let moment = Against { measured: torques.fold(0.0, f64::max), limit };
            return Some(WristMoment { joint, moment, basis: Basis::Torque });
        }
        let (rated_kg, rated_centre) = rated?;
        let rated_lever = greatest_lever(chain, joint, rated_centre);
        let lever = greatest_lever(chain, joint, load.centre);
        let moment = Against {
            measured: load.mass_kg * gravity.norm() * lever,
            limit: rated_kg * gravity.norm() * rated_lever,
        };
        (rated_lever > NO_LEVER_M && moment.limit > 0.0).then_some(WristMoment {
            joint,
            moment,
            basis: Basis::RatedPayload,
        })
    };
    wrist.into_iter().filter_map(moment).collect()
}

/// A rated centre nearer to an axis than this says nothing of the moments allowed about it, m.
const NO_LEVER_M: f64 = 1e-4;

/// Steps per turn of the joints further out, before the best is refined.
const STEPS: f64 = 24.0;

/// Greatest distance from the axis of one turning entry of `q` to a point fixed to the tip (tip
/// axes), m, over all values within limits of the next two free joints; joints still further out
/// stand at zero or the limit nearest to it. By search: a grid of 15°, its best refined to 1e-4
/// rad, so that the lever is short by less than 1e-8 of itself unless two tops of nearly equal
/// height lie in one cell of the grid.
pub fn greatest_lever(chain: &Chain, joint: usize, point: Vector) -> f64 {
    let rest: Vec<f64> =
        chain.axes().iter().map(|axis| 0.0_f64.max(axis.lower).min(axis.upper)).collect();
    let outer: Vec<(usize, f64, f64)> = (joint + 1..chain.dof().min(joint + 3))
        .map(|axis| {
            let (low, high) = range(chain, axis);
            (axis, low, high)
        })
        .collect();
    let mut search = Search { chain, joint, point, poses: Vec::new() };
    let (mut best, mut q) = (rest.clone(), rest);
    let mut longest = search.lever(&q);
    let counts: Vec<usize> = outer.iter().map(|&(_, low, high)| cells(high - low)).collect();
    let cells: usize = counts.iter().map(|count| count + 1).product();
    for cell in 0..cells {
        let mut rest = cell;
        for (&(axis, low, high), count) in outer.iter().zip(&counts) {
            q[axis] = low + (high - low) * (rest % (count + 1)) as f64 / *count as f64;
            rest /= count + 1;
        }
        let lever = search.lever(&q);
        if lever > longest {
            (longest, best) = (lever, q.clone());
        }
    }
    let mut step = TAU / STEPS / 2.0;
    while step > 1e-4 {
        let before = longest;
        for &(axis, low, high) in &outer {
            for change in [-step, step] {
                q.clone_from(&best);
                q[axis] = (q[axis] + change).clamp(low, high);
                let lever = search.lever(&q);
                if lever > longest {
                    (longest, best) = (lever, q.clone());
                }
            }
        }
        if longest <= before {
            step /= 2.0;
        }
    }
    longest
}

struct Search<'a> {
    chain: &'a Chain,
    joint: usize,
    point: Vector,
    poses: Vec<Pose>,
}

impl Search<'_> {
    fn lever(&mut self, q: &[f64]) -> f64 {
        self.chain.link_poses(q, &mut self.poses);
        let index = self.chain.axes()[self.joint].joint;
        let Some(last) = self.poses.last() else { return 0.0 };
        let point = (last * self.chain.last_from_tip()).transform_point(&self.point.into());
        let own = &self.poses[index];
        let axis = own.rotation * self.chain.joints()[index].axis;
        (point.coords - own.translation.vector).cross(&axis).norm()
    }
}

/// Cells of the grid over a range.
fn cells(range: f64) -> usize {
    (range / TAU * STEPS).ceil().clamp(1.0, STEPS) as usize
}

/// What one entry of `q` may be, at most one turn; a slide without limits stays where it is.
fn range(chain: &Chain, axis: usize) -> (f64, f64) {
    let limits = &chain.axes()[axis];
    let (low, high) = (limits.lower, limits.upper);
    let slides = chain.joints()[limits.joint].kind == JointKind::Prismatic;
    match (low.is_finite() && high.is_finite(), slides) {
        (true, false) => (low, high.min(low + TAU)),
        (true, true) => (low, high),
        (false, true) => (0.0, 0.0),
        (false, false) => (0.0, TAU),
    }
}
