//! Frames that move far: large displacements and turns, small strains.
//!
//! Each member is the linear beam in axes that go with it. Loads keep their direction (weight,
//! forces and moments at nodes) and grow together with initial strain by one factor. The path from
//! no load is followed by steps bounded in turn: along Riks' arc, and by Newton at the wanted
//! factor once it is in reach. It stops where the frame first loses stability: at a limit point, or
//! where the path branches. How a member sags between its nodes is what a cubic says, and that
//! shortens its chord: with [`subdivided`] into two, Euler's load of a clamped strut is 1.3 % high,
//! and the error falls with the fourth power of the parts' length.
//!
//! Moments fixed in space are not conservative in 3-D. Stability is then judged by the symmetric
//! half of the tangent: while that is positive no other equilibrium is near, so a critical factor
//! found is early rather than late; flutter is not looked for. A jump to another stable branch
//! within one step is caught by the angle the step then makes with the path: a guard, not a proof.

mod element;
mod lean;
mod local;
mod newton;
mod system;
#[cfg(test)]
mod tests;
mod turn;
mod used;
mod walk;

pub use used::utilisation;

use nalgebra::Matrix3;

use self::element::{Bar, Response, block_turned};
use self::newton::{Spot, Walk};
use self::system::System;
use super::beam::Vector12;
use super::frame::{Frame, Member, NodeLoad, Support};
use super::solve::{Load, SolveError, reactions};

/// How far and how fine.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Factor on the load at which to stop; positive.
    pub until: f64,
    /// Largest turn of a node or chord that the tangent may foretell for one step, rad.
    pub step_turn_rad: f64,
    /// Forces left out of balance relative to the forces that meet at nodes. Where those cancel (a
    /// flat arch carries P by N = P/slope), the factor is known as many times worse. What rounding
    /// explains is let pass on top; the path says what is left.
    pub tolerance: f64,
    /// Steps at most.
    pub steps: usize,
    /// Whether to go on past a critical point, until `until` or the steps are used up.
    pub past_critical: bool,
    /// Nodes whose displacement is kept at every point of the path.
    pub watch: Vec<usize>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            until: 1.0,
            step_turn_rad: 0.1,
            tolerance: 1e-9,
            steps: 400,
            past_critical: false,
            watch: Vec::new(),
        }
    }
}

/// How the walk ended. Factors are on the load as given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// In stable equilibrium at the wanted factor.
    Converged,
    /// The load can grow no further: the frame snaps. The first such factor.
    LimitPoint {
        /// Largest factor before it falls.
        factor: f64,
    },
    /// The path goes on rising but is no longer stable: a straight strut buckles, a frame sways.
    Branches {
        /// Factor up to which it is stable.
        factor: f64,
    },
    /// No equilibrium found beyond this factor, or the steps are used up.
    NotConverged {
        /// Factor of the last equilibrium.
        factor: f64,
    },
}

/// A point of the path.
#[derive(Debug, Clone, PartialEq)]
pub struct PathPoint {
    /// Factor on the load.
    pub factor: f64,
    /// Directions in which the frame would run away; 0 is stable.
    pub unstable: usize,
    /// Of the watched nodes: x, y, z, rotation vector.
    pub watched: Vec<[f64; 6]>,
}

/// The path, and how the frame stands at its last point.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// How it ended.
    pub outcome: Outcome,
    /// Factor at the last point.
    pub factor: f64,
    /// By node, from its place free of stress: x, y, z, rotation vector.
    pub displacement: Vec<[f64; 6]>,
    /// By member: force and moment on its first end, then on its second, axes of the part.
    pub end_forces: Vec<[f64; 12]>,
    /// The same in the member's own axes as they have turned: x along the chord.
    pub local_end_forces: Vec<[f64; 12]>,
    /// By member: weight per length, N/m, in the same own axes.
    pub local_line_n_per_m: Vec<[f64; 3]>,
    /// In the order of the supports: what the support does to the frame.
    pub reactions: Vec<[f64; 6]>,
    /// Forces left out of balance relative to the forces that meet at nodes.
    pub residual: f64,
    /// Newton iterations, all steps together.
    pub iterations: usize,
    /// From no load on.
    pub points: Vec<PathPoint>,
}

/// Every member cut into equal parts; nodes of the frame keep their numbers, new ones follow
/// member by member. Member m becomes members `m parts .. (m + 1) parts`. The frame as it is where
/// a part would have no length.
pub fn subdivided(frame: &Frame, parts: usize) -> Frame {
    let parts = parts.max(1);
    let mut nodes = frame.nodes().to_vec();
    let mut members = Vec::with_capacity(frame.members().len() * parts);
    for whole in frame.members() {
        let [from, to] = whole.ends.map(|node| frame.nodes()[node]);
        let mut last = whole.ends[0];
        for part in 1..parts {
            let node = nodes.len();
            nodes.push(from + (to - from) * (part as f64 / parts as f64));
            members.push(Member { ends: [last, node], ..*whole });
            last = node;
        }
        members.push(Member { ends: [last, whole.ends[1]], ..*whole });
    }
    Frame::new(nodes, members).unwrap_or_else(|_| frame.clone())
}

/// Follows a frame from no load to the wanted factor, or to where it loses stability.
///
/// `imperfection`: offset of each node from its planned place, m, free of stress (as printed, or a
/// buckling mode to scale); empty for none. Cost: two to four factorisations of the tangent where
/// displacements are small, and as many for every `step_turn_rad` that a node turns.
///
/// # Errors
/// As [`solve`](super::solve()); [`SolveError::BadNode`] also for an imperfection or watch that does not
/// fit the nodes, [`SolveError::BadMember`] for a member that the imperfection leaves no length.
pub fn nonlinear(
    frame: &Frame,
    supports: &[Support],
    load: &Load,
    imperfection: &[[f64; 3]],
    options: &Options,
) -> Result<Path, SolveError> {
    let count = frame.nodes().len();
    if let Some(&node) = options.watch.iter().find(|&&node| node >= count) {
        return Err(SolveError::BadNode { node });
    }
    let system = System::new(frame, supports, load, imperfection)?;
    let mut walk = Walk::new(&system, options);
    let Some(start) = walk.begin() else { return Err(SolveError::TooLarge) };
    let mut points = Vec::new();
    let (outcome, spot) = walk.follow(start, |spot| points.push(point(spot, &options.watch)));
    Ok(Path {
        points,
        iterations: walk.iterations,
        ..stands(&system, supports, load, outcome, &spot)
    })
}

fn six(spot: &Spot, node: usize) -> [f64; 6] {
    let (shift, turn) = (spot.state.shifts[node], spot.state.turns[node].scaled_axis());
    [shift.x, shift.y, shift.z, turn.x, turn.y, turn.z]
}

fn point(spot: &Spot, watch: &[usize]) -> PathPoint {
    PathPoint {
        factor: spot.state.factor,
        unstable: spot.negative(),
        watched: watch.iter().map(|&node| six(spot, node)).collect(),
    }
}

/// All but the history.
fn stands(
    system: &System,
    supports: &[Support],
    load: &Load,
    outcome: Outcome,
    spot: &Spot,
) -> Path {
    let factor = spot.state.factor;
    let of_member = |response: &Response| response.force - response.weight * factor;
    let end_forces: Vec<Vector12> = spot.balance.responses.iter().map(of_member).collect();
    let scaled = |load: &NodeLoad| NodeLoad { load: load.load.map(|x| x * factor), ..*load };
    let at_nodes: Vec<NodeLoad> = load.at_nodes.iter().map(scaled).collect();
    let back = || spot.balance.responses.iter().map(|response| response.axes.transpose());
    let local = |(forces, back): (&Vector12, Matrix3<f64>)| block_turned(forces, &back).into();
    let line = |(bar, back): (&Bar, Matrix3<f64>)| (back * bar.line_n_per_m * factor).into();
    Path {
        outcome,
        factor,
        displacement: (0..spot.state.shifts.len()).map(|node| six(spot, node)).collect(),
        local_end_forces: end_forces.iter().zip(back()).map(local).collect(),
        local_line_n_per_m: system.bars.iter().zip(back()).map(line).collect(),
        reactions: reactions(&system.frame, &end_forces, supports, &at_nodes),
        end_forces: end_forces.iter().map(|forces| (*forces).into()).collect(),
        residual: spot.balance.residual,
        iterations: 0,
        points: Vec::new(),
    }
}
