//! Which blocks of the factor can ever be filled: known from the members alone.

use super::order::order;
use crate::pose::Point;

/// No node: the parent of a root, and the place of a node that never moves.
pub(super) const NONE: usize = usize::MAX;

/// Order of elimination and pattern of L, by nodes.
#[derive(Debug, Clone)]
pub(crate) struct Symbolic {
    /// Node of the frame at each place.
    pub(crate) node: Vec<usize>,
    /// Place of each node of the frame; [`NONE`] where it is left out.
    pub(super) place: Vec<usize>,
    /// `rows[start[j]..start[j + 1]]`: places below j that column j reaches, ascending.
    pub(super) start: Vec<usize>,
    pub(super) rows: Vec<usize>,
}

impl Symbolic {
    /// Pattern for all `pairs` of nodes that members join; nodes not kept are left out.
    ///
    /// O(blocks of L) beside the ordering.
    pub(crate) fn new(points: &[Point], keep: &[bool], pairs: &[[usize; 2]]) -> Self {
        let kept: Vec<usize> = (0..keep.len()).filter(|&node| keep[node]).collect();
        let mut rank = vec![NONE; keep.len()];
        for (at, &node) in kept.iter().enumerate() {
            rank[node] = at;
        }
        let mut neighbours = vec![Vec::new(); kept.len()];
        for [a, b] in pairs.iter().map(|pair| pair.map(|node| rank[node])) {
            if a != NONE && b != NONE && a != b {
                neighbours[a].push(b);
                neighbours[b].push(a);
            }
        }
        for list in &mut neighbours {
            list.sort_unstable();
            list.dedup();
        }
        let points: Vec<Point> = kept.iter().map(|&node| points[node]).collect();
        let order = order(&points, &neighbours);
        let node: Vec<usize> = order.iter().map(|&at| kept[at]).collect();
        let mut place = vec![NONE; keep.len()];
        let mut place_of_rank = vec![NONE; kept.len()];
        for (j, &at) in order.iter().enumerate() {
            place[kept[at]] = j;
            place_of_rank[at] = j;
        }
        let mut columns: Vec<Vec<usize>> = order
            .iter()
            .enumerate()
            .map(|(j, &at)| {
                neighbours[at].iter().map(|&b| place_of_rank[b]).filter(|&b| b > j).collect()
            })
            .collect();
        fill(&mut columns);
        let (mut start, mut rows) = (vec![0], Vec::new());
        for column in &columns {
            rows.extend_from_slice(column);
            start.push(rows.len());
        }
        Self { node, place, start, rows }
    }

    /// Places of the system.
    pub(crate) fn len(&self) -> usize {
        self.node.len()
    }

    /// Blocks of L below the diagonal.
    pub(crate) fn blocks(&self) -> usize {
        self.rows.len()
    }

    /// Places that column j reaches.
    pub(super) fn below(&self, j: usize) -> &[usize] {
        &self.rows[self.start[j]..self.start[j + 1]]
    }

    /// Next place up the elimination tree.
    pub(super) fn parent(&self, j: usize) -> usize {
        if self.start[j] < self.start[j + 1] { self.rows[self.start[j]] } else { NONE }
    }

    /// Where block (b, j) of L lies.
    pub(super) fn at(&self, b: usize, j: usize) -> Option<usize> {
        let span = self.start[j]..self.start[j + 1];
        self.rows[span].binary_search(&b).ok().map(|at| self.start[j] + at)
    }

    /// Block products of a whole factorisation of the columns for which `alive` holds.
    pub(super) fn products(&self, alive: impl Fn(usize) -> bool) -> usize {
        let of_column = |j: usize| {
            let height = self.below(j).iter().filter(|&&b| alive(b)).count();
            8 + 4 * height + height * (height + 1) / 2
        };
        (0..self.len()).filter(|&j| alive(j)).map(of_column).sum()
    }
}

/// Adds to every column what its children in the elimination tree bring.
fn fill(columns: &mut [Vec<usize>]) {
    for j in 0..columns.len() {
        columns[j].sort_unstable();
        columns[j].dedup();
        if let Some((&parent, rest)) = columns[j].split_first() {
            let rest = rest.to_vec();
            columns[parent].extend(rest);
        }
    }
}
