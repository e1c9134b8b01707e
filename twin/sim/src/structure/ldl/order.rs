//! Order of elimination: nested dissection of the graph of nodes, minimum degree inside the pieces.
//!
//! A piece is sorted along x, y, z and by steps from a far node, and cut in the middle of each; the
//! fewest nodes that touch every cut edge (König: a largest matching) separate the halves. The
//! smallest separator of the four is taken. Plain minimum degree is tried beside and taken where it
//! leaves less to do.

use std::collections::VecDeque;

use super::symbolic::NONE;
use crate::pose::Point;

/// Pieces no larger are not cut.
const LEAF: usize = 24;
/// Where minimum degree over everything is not tried: it looks at all nodes for each.
const MANY: usize = 8000;

/// Nodes in the order of elimination.
///
/// `neighbours` ascending, symmetric. O(n log n) cuts; minimum degree keeps the elimination graph
/// itself and costs about the number of blocks of L times their height.
pub(super) fn order(points: &[Point], neighbours: &[Vec<usize>]) -> Vec<usize> {
    let mut groups = Vec::new();
    let all: Vec<usize> = (0..neighbours.len()).collect();
    Dissection { points, neighbours, side: vec![Side::Outside; neighbours.len()] }
        .cut(all.clone(), &mut groups);
    let (dissected, cost) = eliminate(neighbours, &groups);
    if neighbours.len() > MANY {
        return dissected;
    }
    let (plain, plain_cost) = eliminate(neighbours, &[all]);
    if plain_cost < cost { plain } else { dissected }
}

/// Takes each group in turn by least degree, the lowest node among equals; the order, and what an
/// update of every column and a solve per column would cost.
fn eliminate(neighbours: &[Vec<usize>], groups: &[Vec<usize>]) -> (Vec<usize>, usize) {
    let mut graph = neighbours.to_vec();
    let mut order = Vec::with_capacity(graph.len());
    let mut above: Vec<Vec<usize>> = vec![Vec::new(); graph.len()];
    for group in groups {
        let mut left = group.clone();
        while let Some(at) = (0..left.len()).min_by_key(|&at| (graph[left[at]].len(), left[at])) {
            let node = left.swap_remove(at);
            order.push(node);
            let clique = std::mem::take(&mut graph[node]);
            for &other in &clique {
                graph[other] = joined(&graph[other], &clique, [node, other]);
            }
            above[node] = clique;
        }
    }
    let mut place = vec![NONE; graph.len()];
    for (at, &node) in order.iter().enumerate() {
        place[node] = at;
    }
    let (mut path, mut cost, mut blocks) = (vec![0usize; graph.len()], 0, 0);
    for &node in order.iter().rev() {
        let parent = above[node].iter().min_by_key(|&&other| place[other]);
        path[node] = 1 + above[node].len() + parent.map_or(0, |&parent| path[parent]);
        // a node brings three members in a usual frame
        cost += 3 * path[node];
        blocks += 1 + above[node].len();
    }
    (order, cost + blocks * graph.len())
}

/// Sorted union of two sorted lists without two of their entries.
fn joined(a: &[usize], b: &[usize], without: [usize; 2]) -> Vec<usize> {
    let mut union = Vec::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() || j < b.len() {
        let next = match (a.get(i), b.get(j)) {
            (Some(&x), Some(&y)) => x.min(y),
            (Some(&x), None) | (None, Some(&x)) => x,
            (None, None) => break,
        };
        i += usize::from(a.get(i) == Some(&next));
        j += usize::from(b.get(j) == Some(&next));
        if !without.contains(&next) {
            union.push(next);
        }
    }
    union
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Outside,
    Inside,
    Low,
    High,
}

struct Dissection<'a> {
    points: &'a [Point],
    neighbours: &'a [Vec<usize>],
    side: Vec<Side>,
}

impl Dissection<'_> {
    /// Pushes the groups of a piece: its halves, cut further, then what lies between them.
    fn cut(&mut self, piece: Vec<usize>, groups: &mut Vec<Vec<usize>>) {
        if piece.len() <= LEAF {
            groups.push(piece);
            return;
        }
        let mut best: Option<(usize, Vec<usize>, Vec<usize>)> = None;
        for way in 0..4 {
            let sorted = self.sorted(&piece, way);
            let between = self.separator(&sorted);
            if best.as_ref().is_none_or(|(least, ..)| between.len() < *least) {
                best = Some((between.len(), sorted, between));
            }
        }
        let Some((_, sorted, between)) = best else { return };
        let (mut low, mut high) = (Vec::new(), Vec::new());
        for (at, &node) in sorted.iter().enumerate() {
            if !between.contains(&node) {
                if at < sorted.len() / 2 { low.push(node) } else { high.push(node) }
            }
        }
        if low.is_empty() || high.is_empty() {
            groups.push(piece);
            return;
        }
        self.cut(low, groups);
        self.cut(high, groups);
        if !between.is_empty() {
            groups.push(between);
        }
    }

    fn sorted(&mut self, piece: &[usize], way: usize) -> Vec<usize> {
        let mut sorted = piece.to_vec();
        if way < 3 {
            let along = |node: usize| self.points[node][way];
            sorted.sort_by(|&a, &b| along(a).total_cmp(&along(b)).then(a.cmp(&b)));
            return sorted;
        }
        // twice: the last node reached is far from anywhere
        for _ in 0..2 {
            let first = sorted.last().copied().unwrap_or(piece[0]);
            sorted = self.steps_from(first, piece);
        }
        sorted
    }

    /// The piece by number of steps from a node, then what cannot be reached.
    fn steps_from(&mut self, first: usize, piece: &[usize]) -> Vec<usize> {
        for &node in piece {
            self.side[node] = Side::Inside;
        }
        let mut sorted = Vec::with_capacity(piece.len());
        let mut queue = VecDeque::new();
        for &seed in std::iter::once(&first).chain(piece) {
            if self.side[seed] == Side::Inside {
                self.side[seed] = Side::Outside;
                queue.push_back(seed);
            }
            while let Some(node) = queue.pop_front() {
                sorted.push(node);
                for &other in &self.neighbours[node] {
                    if self.side[other] == Side::Inside {
                        self.side[other] = Side::Outside;
                        queue.push_back(other);
                    }
                }
            }
        }
        sorted
    }

    /// Fewest nodes without which the lower and the upper half of a sorted piece do not touch.
    fn separator(&mut self, sorted: &[usize]) -> Vec<usize> {
        let middle = sorted.len() / 2;
        for (at, &node) in sorted.iter().enumerate() {
            self.side[node] = if at < middle { Side::Low } else { Side::High };
        }
        let mut partner = vec![NONE; self.neighbours.len()];
        let mut seen = vec![NONE; self.neighbours.len()];
        for &node in &sorted[..middle] {
            self.augment(node, node, &mut seen, &mut partner);
        }
        // König: low nodes not reached and high nodes reached from unmatched low ones
        let mut reached = vec![false; self.neighbours.len()];
        let mut stack: Vec<usize> =
            sorted[..middle].iter().copied().filter(|&node| partner[node] == NONE).collect();
        while let Some(node) = stack.pop() {
            reached[node] = true;
            for &other in &self.neighbours[node] {
                if self.side[other] == Side::High && !reached[other] {
                    reached[other] = true;
                    let back = partner[other];
                    if back != NONE && !reached[back] {
                        stack.push(back);
                    }
                }
            }
        }
        let (low, high) = sorted.split_at(middle);
        let mut between: Vec<usize> =
            low.iter().copied().filter(|&n| partner[n] != NONE && !reached[n]).collect();
        between.extend(high.iter().filter(|&&n| reached[n]));
        for &node in sorted {
            self.side[node] = Side::Outside;
        }
        between
    }

    /// One augmenting path from a low node, by a stack of its own (paths may be long).
    fn augment(&self, root: usize, mark: usize, seen: &mut [usize], partner: &mut [usize]) -> bool {
        let mut stack = vec![(root, 0)];
        let mut taken: Vec<usize> = Vec::new();
        while let Some((node, from)) = stack.pop() {
            let next = self.neighbours[node][from..]
                .iter()
                .enumerate()
                .find(|(_, other)| self.side[**other] == Side::High && seen[**other] != mark);
            let Some((offset, &other)) = next else {
                taken.pop();
                continue;
            };
            seen[other] = mark;
            stack.push((node, from + offset + 1));
            taken.push(other);
            if partner[other] == NONE {
                for (&(low, _), &high) in stack.iter().zip(&taken) {
                    partner[low] = high;
                    partner[high] = low;
                }
                return true;
            }
            stack.push((partner[other], 0));
        }
        false
    }
}
