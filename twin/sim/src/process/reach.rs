//! Boxes over the segments of a strand, to find those that light can reach without looking at all.

use crate::pose::Point;

use super::dose::Segment;

/// Segments in a leaf of the tree.
const LEAF: usize = 4;

/// Boxes over runs of segments, each level over pairs of the one below.
pub(super) struct Tree {
    levels: Vec<Vec<Node>>,
    segments: usize,
}

#[derive(Clone, Copy)]
struct Node {
    low: Point,
    high: Point,
    /// Earliest birth below, s.
    born_s: f64,
}

impl Node {
    fn with(self, other: Self) -> Self {
        Self {
            low: self.low.inf(&other.low),
            high: self.high.sup(&other.high),
            born_s: self.born_s.min(other.born_s),
        }
    }
}

impl Tree {
    pub(super) fn over(segments: &[Segment]) -> Self {
        let node = |s: &Segment| Node { low: s.middle, high: s.middle, born_s: s.born_s };
        let join = |nodes: &[Node]| nodes[1..].iter().fold(nodes[0], |sum, n| sum.with(*n));
        let all: Vec<Node> = segments.iter().map(node).collect();
        let mut levels = vec![all.chunks(LEAF).map(join).collect::<Vec<_>>()];
        while let Some(last) = levels.last().filter(|last| last.len() > 1) {
            let above = last.chunks(2).map(join).collect();
            levels.push(above);
        }
        Self { levels, segments: segments.len() }
    }

    /// Collects the segments of the leaves whose ball (centre, radius m) and earliest birth are wanted.
    pub(super) fn walk(&self, wanted: &impl Fn(Point, f64, f64) -> bool, out: &mut Vec<usize>) {
        let mut open = vec![(self.levels.len() - 1, 0)];
        while let Some((level, index)) = open.pop() {
            let Some(node) = self.levels[level].get(index) else { continue };
            let centre = nalgebra::center(&node.low, &node.high);
            if !wanted(centre, 0.5 * (node.high - node.low).norm(), node.born_s) {
                continue;
            }
            if level == 0 {
                out.extend(index * LEAF..self.segments.min((index + 1) * LEAF));
            } else {
                open.extend([(level - 1, 2 * index + 1), (level - 1, 2 * index)]);
            }
        }
    }
}
