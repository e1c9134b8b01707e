//! Which nodes are tied to the ground by the members born so far.

use super::frame::{Member, Support};

/// What a node is at some stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Tie {
    /// No member there yet.
    Unborn,
    /// Part of a piece that touches a support.
    Held,
    /// Part of a piece that touches none.
    Floating,
}

/// Pieces of the frame at one stage.
#[derive(Debug, Clone)]
pub(crate) struct Ground {
    /// By node.
    pub(crate) tie: Vec<Tie>,
    /// Lowest node of each floating piece, ascending.
    pub(crate) floats: Vec<usize>,
}

/// Union-find over the born members; O(members α).
pub(crate) fn ground(node_count: usize, born: &[Member], supports: &[Support]) -> Ground {
    let mut parent: Vec<usize> = (0..node_count).collect();
    let mut tie = vec![Tie::Unborn; node_count];
    for member in born {
        let [a, b] = member.ends.map(|node| root(&mut parent, node));
        // the lower node is the root, so that a piece is named by its lowest node
        parent[a.max(b)] = a.min(b);
        for node in member.ends {
            tie[node] = Tie::Floating;
        }
    }
    let mut held = vec![false; node_count];
    for support in supports {
        if support.fixed.contains(&true) && support.node < node_count {
            let top = root(&mut parent, support.node);
            held[top] = true;
        }
    }
    let mut floats = Vec::new();
    for (node, tie) in tie.iter_mut().enumerate().filter(|(_, tie)| **tie == Tie::Floating) {
        let top = root(&mut parent, node);
        if held[top] {
            *tie = Tie::Held;
        } else if top == node {
            floats.push(node);
        }
    }
    Ground { tie, floats }
}

fn root(parent: &mut [usize], mut node: usize) -> usize {
    while parent[node] != node {
        parent[node] = parent[parent[node]];
        node = parent[node];
    }
    node
}
