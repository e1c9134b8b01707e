//! Into which pieces a frame comes apart, and which of them are held.

use super::{Bit, Failing};
use crate::pose::{Point, Vector};
use crate::structure::Support;
use nalgebra::{Matrix6, Vector6};

/// Least eigenvalue of the supports' grip, as a share of the largest, that still holds: the root of
/// it is the ratio of lever arms, and 1e-10 stands for a lever of 1e-5 of the piece.
const HELD_SHARE: f64 = 1e-10;

/// A piece that is not held, with the supports that only guide it.
pub(super) struct Loose {
    pub(super) bits: Vec<Bit>,
    pub(super) guides: Vec<Support>,
}

/// What is left of a member between two breaks: its shares, and whether each end is still a node.
struct Part {
    member: usize,
    share: [f64; 2],
    at_node: [bool; 2],
}

/// Pieces that move, in the order of their first member, and everything that stays.
pub(super) fn pieces(failing: &Failing) -> (Vec<Loose>, Vec<Bit>) {
    let nodes = failing.frame.nodes();
    let parts = parts(failing);
    let mut parent: Vec<usize> = (0..nodes.len() + parts.len()).collect();
    for (at, part) in parts.iter().enumerate() {
        let ends = failing.frame.members()[part.member].ends;
        for (node, _) in ends.into_iter().zip(part.at_node).filter(|(_, joined)| *joined) {
            let (a, b) = (root(&mut parent, node), root(&mut parent, nodes.len() + at));
            parent[a.max(b)] = a.min(b);
        }
    }
    // by root: what it has and what grips it
    let mut bits: Vec<Vec<Bit>> = vec![Vec::new(); parent.len()];
    let mut order = Vec::new();
    for (at, part) in parts.iter().enumerate() {
        let top = root(&mut parent, nodes.len() + at);
        if let Some(bit) = bit(failing, part) {
            if bits[top].is_empty() {
                order.push(top);
            }
            bits[top].push(bit);
        }
    }
    let mut guides: Vec<Vec<Support>> = vec![Vec::new(); parent.len()];
    for support in failing.supports {
        let top = root(&mut parent, support.node);
        guides[top].push(*support);
    }
    let (mut loose, mut rest) = (Vec::new(), Vec::new());
    for top in order {
        let (bits, guides) = (std::mem::take(&mut bits[top]), std::mem::take(&mut guides[top]));
        if is_held(nodes, &bits, &guides) {
            rest.extend(bits);
        } else {
            loose.push(Loose { bits, guides });
        }
    }
    rest.sort_by_key(|bit| bit.member);
    (loose, rest)
}

/// The printed members, broken ones in several parts.
fn parts(failing: &Failing) -> Vec<Part> {
    let mut shares: Vec<Vec<f64>> = vec![Vec::new(); failing.born];
    for each in failing.breaks {
        shares[each.member].push(each.share);
    }
    let mut parts = Vec::with_capacity(failing.born + failing.breaks.len());
    for (member, mut at) in shares.into_iter().enumerate() {
        at.sort_by(f64::total_cmp);
        let from = [0.0].into_iter().chain(at.iter().copied());
        let to = at.iter().copied().chain([1.0]);
        let count = at.len();
        parts.extend(from.zip(to).enumerate().map(|(k, (from, to))| Part {
            member,
            share: [from, to],
            at_node: [k == 0, k == count],
        }));
    }
    parts
}

/// The body of a part; none of a link, and none where a stub is shorter than its radius.
fn bit(failing: &Failing, part: &Part) -> Option<Bit> {
    let member = &failing.frame.members()[part.member];
    let [a, b] = member.ends.map(|node| failing.frame.nodes()[node]);
    let radius_m = member.section.fibre_m;
    let back = radius_m / (b - a).norm();
    let from = part.share[0] + if part.at_node[0] { 0.0 } else { back };
    let to = part.share[1] - if part.at_node[1] { 0.0 } else { back };
    let at = |share: f64| a + (b - a) * share;
    (member.density_kg_m3 > 0.0 && from < to).then(|| Bit {
        member: part.member,
        ends: [at(from), at(to)],
        radius_m,
    })
}

/// Whether the supports leave a piece no motion as a rigid body.
///
/// Each fixed freedom is a row of six over velocity at the middle and turn times the piece's size;
/// held where their Gram matrix has full rank.
fn is_held(nodes: &[Point], bits: &[Bit], supports: &[Support]) -> bool {
    let points = || bits.iter().flat_map(|bit| bit.ends);
    let count = 2.0 * bits.len() as f64;
    let middle = points().fold(Vector::zeros(), |sum, p| sum + p.coords) / count;
    let size_m = points().map(|p| (p.coords - middle).norm()).fold(f64::MIN_POSITIVE, f64::max);
    let mut gram = Matrix6::zeros();
    for support in supports {
        let arm = (nodes[support.node].coords - middle) / size_m;
        for k in (0..6).filter(|&k| support.fixed[k]) {
            let axis = Vector::ith(k % 3, 1.0);
            let (along, about) =
                if k < 3 { (axis, arm.cross(&axis)) } else { (Vector::zeros(), axis) };
            let row = Vector6::new(along.x, along.y, along.z, about.x, about.y, about.z);
            gram += row * row.transpose();
        }
    }
    let values = gram.symmetric_eigenvalues();
    values.min() > HELD_SHARE * values.max()
}

fn root(parent: &mut [usize], mut at: usize) -> usize {
    while parent[at] != at {
        parent[at] = parent[parent[at]];
        at = parent[at];
    }
    at
}
