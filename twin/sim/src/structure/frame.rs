//! The abstract frame: nodes, members in the order of birth, supports, loads at nodes.

use thiserror::Error;

use super::section::{Elastic, Section};
use crate::pose::{Point, Vector, is_finite_point};

/// A straight beam between two nodes, rigidly joined to both.
///
/// A link between two crossing strands is a member without density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Member {
    /// Its nodes; x of the member runs from the first to the second.
    pub ends: [usize; 2],
    /// Cross-section.
    pub section: Section,
    /// Elastic constants.
    pub elastic: Elastic,
    /// Density, kg/m³.
    pub density_kg_m3: f64,
    /// Strain the member would have if free (shrinkage is negative).
    pub initial_strain: f64,
    /// Direction near y of the section; zero, or along the member: any (a circle does not care).
    pub side: Vector,
    /// The strand it is part of.
    pub strand: usize,
}

/// A node held in some of its freedoms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Support {
    /// The node.
    pub node: usize,
    /// Held: x, y, z, turns about x, y, z.
    pub fixed: [bool; 6],
}

impl Support {
    /// Held in all six freedoms.
    pub const fn clamped(node: usize) -> Self {
        Self { node, fixed: [true; 6] }
    }

    /// Held in place, free to turn.
    pub const fn pinned(node: usize) -> Self {
        Self { node, fixed: [true, true, true, false, false, false] }
    }
}

/// Force (N) and moment (N m) at a node, in the axes of the part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NodeLoad {
    /// The node.
    pub node: usize,
    /// Fx, Fy, Fz, Mx, My, Mz.
    pub load: [f64; 6],
}

/// What makes a frame unusable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum FrameFault {
    /// A member names a node that is not there.
    #[error("member {member} names node {node}, which does not exist")]
    NoSuchNode {
        /// The member.
        member: usize,
        /// The node it names.
        node: usize,
    },
    /// A coordinate is not a finite number.
    #[error("node {node} has a coordinate that is not finite")]
    NotFinite {
        /// The node.
        node: usize,
    },
    /// A member without length.
    #[error("member {member} has no length")]
    NoLength {
        /// The member.
        member: usize,
    },
    /// A section, modulus, density or strain out of its range.
    #[error("member {member}: section and moduli must be positive, density and strain finite")]
    Constants {
        /// The member.
        member: usize,
    },
    /// A split that is not inside the member, or of a member that is not there.
    #[error("member {member} cannot be split there")]
    Split {
        /// The member.
        member: usize,
    },
}

/// Nodes and members, checked once: every member has length and usable constants.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    nodes: Vec<Point>,
    members: Vec<Member>,
}

impl Frame {
    /// A frame from its nodes and its members in the order in which they are printed.
    ///
    /// # Errors
    /// The first node or member that cannot be used.
    pub fn new(nodes: Vec<Point>, members: Vec<Member>) -> Result<Self, FrameFault> {
        if let Some(node) = nodes.iter().position(|point| !is_finite_point(point)) {
            return Err(FrameFault::NotFinite { node });
        }
        for (member, each) in members.iter().enumerate() {
            if let Some(&node) = each.ends.iter().find(|&&node| node >= nodes.len()) {
                return Err(FrameFault::NoSuchNode { member, node });
            }
            let length_m = (nodes[each.ends[1]] - nodes[each.ends[0]]).norm();
            if !(length_m.is_finite() && length_m > 0.0) {
                return Err(FrameFault::NoLength { member });
            }
            let density_ok = each.density_kg_m3.is_finite() && each.density_kg_m3 >= 0.0;
            let rest_ok =
                each.initial_strain.is_finite() && each.side.iter().all(|x| x.is_finite());
            let constants_ok = each.section.is_usable() && each.elastic.is_usable();
            if !(density_ok && rest_ok && constants_ok) {
                return Err(FrameFault::Constants { member });
            }
        }
        Ok(Self { nodes, members })
    }

    /// Nodes, where they were planned.
    pub fn nodes(&self) -> &[Point] {
        &self.nodes
    }

    /// Mass of all members, kg.
    pub fn mass_kg(&self) -> f64 {
        let of = |member: &Member| {
            let [a, b] = member.ends.map(|node| self.nodes[node]);
            member.density_kg_m3 * member.section.area_m2 * (b - a).norm()
        };
        self.members.iter().map(of).sum()
    }

    /// Members in the order of birth.
    pub fn members(&self) -> &[Member] {
        &self.members
    }

    /// The frame with one member cut in two at a fraction of its length, and the new node, so that
    /// a load or support can sit there. The halves stand at `member` and `member + 1`.
    ///
    /// # Errors
    /// No such member, or a fraction not inside (0, 1).
    pub fn split(&self, member: usize, fraction: f64) -> Result<(Self, usize), FrameFault> {
        let inside = fraction > 0.0 && fraction < 1.0;
        let Some(&whole) = self.members.get(member).filter(|_| inside) else {
            return Err(FrameFault::Split { member });
        };
        let [from, to] = whole.ends.map(|node| self.nodes[node]);
        let node = self.nodes.len();
        let (mut nodes, mut members) = (self.nodes.clone(), self.members.clone());
        nodes.push(from + (to - from) * fraction);
        members[member].ends[1] = node;
        members.insert(member + 1, Member { ends: [node, whole.ends[1]], ..whole });
        Ok((Self::new(nodes, members)?, node))
    }
}
