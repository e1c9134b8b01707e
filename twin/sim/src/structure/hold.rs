//! What a support holds, and what became of it.

use super::frame::{Frame, Member, Support};
use super::solve::{Load, SolveError};
use super::stages::{Ask, Stage, StageRecord, solve_held_stages};
use crate::pose::Vector;

/// Adhesion of a node to what it rests on, in some stages of a print.
///
/// Several for one node in one stage add up; on surfaces that face different ways the node cannot lift.
/// Without effect where no support holds the node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hold {
    /// The node.
    pub node: usize,
    /// Unit vector out of the surface to the bead, axes of the part.
    pub normal: Vector,
    /// Greatest pull along the normal, N; infinite: cannot lift.
    pub pull_n: f64,
    /// First stage (index) it counts in.
    pub from: usize,
    /// First stage it no longer counts in.
    pub until: usize,
}

/// A support, how hard it is pulled, and how hard it may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pull {
    /// Its node.
    pub node: usize,
    /// Pull along the normal, N; negative where it is pressed.
    pub pull_n: f64,
    /// Greatest pull it holds, N.
    pub held_n: f64,
}

impl Pull {
    /// Pull over what is held; nothing where it is pressed.
    pub fn share(&self) -> f64 {
        if self.pull_n > 0.0 { self.pull_n / self.held_n } else { 0.0 }
    }
}

/// What became of supports with adhesion at a stage.
#[derive(Debug, Clone, PartialEq)]
pub struct Holding {
    /// The support with the largest share before any lets go at this stage: adhesion larger by this share
    /// would hold here.
    pub worst: Option<Pull>,
    /// Nodes that let go at this stage, in the order in which they do.
    pub let_go: Vec<usize>,
    /// Nodes that have let go, now or before, and rest on the surface (staged), ascending.
    pub resting: Vec<usize>,
    /// Rounds of letting go.
    pub rounds: usize,
    /// Whether the rounds ended with nothing pulled too hard and no node in the surface.
    pub is_settled: bool,
}

/// One frame, one load, on supports that may let go: as a print of one stage, whose staged answer is
/// that of the load growing evenly from nothing.
///
/// # Errors
/// As [`solve_held_stages`]. What floats or is a mechanism is in the record.
pub fn solve_held(
    frame: &Frame,
    supports: &[Support],
    holds: &[Hold],
    load: &Load,
) -> Result<StageRecord, SolveError> {
    let strained = |member: &Member| {
        let strain = if load.with_initial_strain { member.initial_strain } else { 0.0 };
        Member { initial_strain: strain, ..*member }
    };
    let members: Vec<Member> = frame.members().iter().map(strained).collect();
    let stage = Stage {
        born: members.len(),
        supports: supports.to_vec(),
        gravity_m_s2: load.gravity_m_s2,
        at_nodes: load.at_nodes.clone(),
        ..Stage::default()
    };
    let frame = Frame::new(frame.nodes().to_vec(), members)
        .expect("a frame that was sound, with less strain");
    let ask = Ask { staged: true, keep: &[0], ..Ask::default() };
    let records = solve_held_stages(&frame, &[stage], holds, ask)?;
    Ok(records.into_iter().next().expect("one stage, one record"))
}
