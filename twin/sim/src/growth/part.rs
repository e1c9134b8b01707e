//! A part of the frame by itself: only nodes that have a member, numbered anew.

use crate::pose::Point;
use crate::structure::{Frame, Member, NodeLoad, Support};

/// Some members and their nodes.
pub(super) struct Part {
    pub(super) frame: Frame,
    place: Vec<Option<usize>>,
}

impl Part {
    /// `None` without members.
    pub(super) fn new(nodes: &[Point], members: impl Iterator<Item = Member>) -> Option<Self> {
        let mut place: Vec<Option<usize>> = vec![None; nodes.len()];
        let mut kept = Vec::new();
        let renumbered: Vec<Member> = members
            .map(|member| {
                let ends = member.ends.map(|end| {
                    *place[end].get_or_insert_with(|| {
                        kept.push(nodes[end]);
                        kept.len() - 1
                    })
                });
                Member { ends, ..member }
            })
            .collect();
        let frame = Frame::new(kept, renumbered).ok().filter(|frame| !frame.members().is_empty());
        Some(Self { frame: frame?, place })
    }

    /// Where a node is.
    pub(super) fn node(&self, node: usize) -> Option<usize> {
        self.place[node]
    }

    /// The supports of nodes that are there.
    pub(super) fn supports(&self, supports: &[Support]) -> Vec<Support> {
        let held = |support: &Support| {
            Some(Support { node: self.node(support.node)?, fixed: support.fixed })
        };
        supports.iter().filter_map(held).collect()
    }

    /// The loads; `None` where a node is not there.
    pub(super) fn loads(&self, loads: &[NodeLoad]) -> Option<Vec<NodeLoad>> {
        let load =
            |load: &NodeLoad| Some(NodeLoad { node: self.node(load.node)?, load: load.load });
        loads.iter().map(load).collect()
    }
}
