//! A way through joint space by two trees that grow towards each other.
//!
//! RRT-Connect (Kuffner, LaValle 2000): a posture is drawn, one tree grows towards it, the other
//! towards what was reached. Every edge is a move that the asker has found clear over its whole
//! length, so steps are as long as they can be. Where a move is blocked the tree grows up to shortly
//! before the obstacle, and some joints go on along it. Probabilistically complete; ends after a given number of questions. The
//! nearest node is found by looking at all of them: O(n) of a few additions, against a question that
//! costs thousands.

use super::ask::{Ask, Tally};
use super::metric::{Metric, Room};
use super::random::Random;
use crate::kinematics::Posture;

/// Longest edge, m of the metric.
const STEP_M: f64 = 1.5;
/// Shortest edge worth keeping, m of the metric.
const LEAST_M: f64 = 0.01;
/// Share of the clear part of a blocked move that is kept.
const KEPT: f64 = 0.8;

/// A posture and the node it was reached from; a root is its own.
struct Node {
    q: Posture,
    parent: usize,
}

/// Postures that can be reached from the root, and what kept it from reaching more.
pub(super) struct Tree {
    nodes: Vec<Node>,
    pub(super) blocked: Tally,
    /// Nodes that it began with.
    n_given: usize,
}

impl Tree {
    /// The tree of clear ways that all begin at `root`, each without it.
    pub(super) fn new(root: Posture, ways: &[Vec<Posture>]) -> Self {
        let mut nodes = vec![Node { q: root, parent: 0 }];
        for way in ways {
            let mut parent = 0;
            for &q in way {
                nodes.push(Node { q, parent });
                parent = nodes.len() - 1;
            }
        }
        let n_given = nodes.len();
        Self { nodes, blocked: Tally::default(), n_given }
    }

    /// Nodes that the search has added.
    pub(super) fn n_grown(&self) -> usize {
        self.nodes.len() - self.n_given
    }

    pub(super) fn root(&self) -> Posture {
        self.nodes[0].q
    }

    fn nearest(&self, metric: &Metric, q: &Posture) -> usize {
        let mut nearest = (0, f64::INFINITY);
        for (index, node) in self.nodes.iter().enumerate() {
            let length_m = metric.length(&node.q, q);
            if length_m < nearest.1 {
                nearest = (index, length_m);
            }
        }
        nearest.0
    }

    fn push(&mut self, q: Posture, parent: usize) -> usize {
        self.nodes.push(Node { q, parent });
        self.nodes.len() - 1
    }

    /// From the root to a node.
    fn way_to(&self, mut node: usize) -> Vec<Posture> {
        let mut way = vec![self.nodes[node].q];
        while self.nodes[node].parent != node {
            node = self.nodes[node].parent;
            way.push(self.nodes[node].q);
        }
        way.reverse();
        way
    }
}

/// What came of growing towards a posture.
enum Grown {
    /// It was reached.
    There(usize),
    /// A step towards it was made, and nothing is in the way yet.
    Nearer(usize),
    /// Something is in the way; the node stands before it.
    Before(usize),
    /// Not worth a node.
    Stuck,
}

/// One search.
pub(super) struct Search<'a, 'b> {
    pub(super) ask: &'b mut Ask<'a>,
    pub(super) metric: &'b Metric,
    pub(super) room: Room,
    pub(super) random: Random,
    /// Questions after which the search gives up (the last step may take three more).
    pub(super) checks_max: usize,
}

impl Search<'_, '_> {
    /// A clear way from the root of `here` to that of `there`.
    pub(super) fn connect(&mut self, here: &mut Tree, there: &mut Tree) -> Option<Vec<Posture>> {
        let ends = [here.root(), there.root()];
        let stop = self.ask.n_checks + self.checks_max;
        for round in 0_usize.. {
            if self.ask.n_checks >= stop {
                break;
            }
            let from_here = round.is_multiple_of(2);
            let target = self.draw(&ends, if from_here { here } else { there });
            let (grows, follows) =
                if from_here { (&mut *here, &mut *there) } else { (&mut *there, &mut *here) };
            if let Some((one, other)) = self.round(grows, follows, &target, stop) {
                let (one, other) = (grows.way_to(one), follows.way_to(other));
                let (mut way, rest) = if from_here { (one, other) } else { (other, one) };
                // Both end in the posture where the trees met.
                way.extend(rest.into_iter().rev().skip(1));
                return Some(way);
            }
        }
        None
    }

    /// One tree grows towards `target`, the other towards what that reached.
    fn round(
        &mut self,
        grows: &mut Tree,
        follows: &mut Tree,
        target: &Posture,
        stop: usize,
    ) -> Option<(usize, usize)> {
        let near = grows.nearest(self.metric, target);
        let tip = match self.grow(grows, near, target) {
            Grown::There(node) | Grown::Nearer(node) => node,
            Grown::Before(node) => self.slide(grows, node, target).unwrap_or(node),
            Grown::Stuck => self.slide(grows, near, target)?,
        };
        let meet = grows.nodes[tip].q;
        let mut near = follows.nearest(self.metric, &meet);
        while self.ask.n_checks < stop {
            match self.grow(follows, near, &meet) {
                Grown::There(node) => return Some((tip, node)),
                Grown::Nearer(node) => near = node,
                Grown::Before(_) | Grown::Stuck => return None,
            }
        }
        None
    }

    /// Where a move is blocked, one by some of the joints may go on along the obstacle: half of them,
    /// drawn anew each time.
    fn slide(&mut self, tree: &mut Tree, near: usize, target: &Posture) -> Option<usize> {
        let mut aside = tree.nodes[near].q;
        for (value, &wanted) in aside.iter_mut().zip(target.iter()) {
            if self.random.share() < 0.5 {
                *value = wanted;
            }
        }
        match self.grow(tree, near, &aside) {
            Grown::There(node) | Grown::Nearer(node) | Grown::Before(node) => Some(node),
            Grown::Stuck => None,
        }
    }

    fn grow(&mut self, tree: &mut Tree, near: usize, target: &Posture) -> Grown {
        let from = tree.nodes[near].q;
        let length_m = self.metric.length(&from, target);
        if length_m < 1e-9 {
            return Grown::There(near);
        }
        let share = (STEP_M / length_m).min(1.0);
        let arrives = share >= 1.0;
        let to = if arrives { *target } else { from.toward(target, share) };
        let Err(blocked) = self.ask.clear(&from, &to) else {
            let node = tree.push(to, near);
            return if arrives { Grown::There(node) } else { Grown::Nearer(node) };
        };
        let kept = share * KEPT * blocked.share.clamp(0.0, 1.0);
        let at = from.toward(&to, blocked.share);
        let away_m = self.metric.length(&tree.root(), &at);
        tree.blocked.note(blocked, at, away_m);
        if kept * length_m < LEAST_M {
            return Grown::Stuck;
        }
        // What lies before the first obstacle found need not be clear: it is asked again.
        let before = from.toward(target, kept);
        match self.ask.clear(&from, &before) {
            Ok(()) => Grown::Before(tree.push(before, near)),
            Err(_) => Grown::Stuck,
        }
    }

    /// A third of the postures from the whole room; a third about the straight move and its ends,
    /// near and far in equal parts: a tool leaves a tight place by a small motion that the whole room
    /// hardly ever yields; a third about what was reached, a few joints at a time: past an obstacle
    /// leads a motion along it, not one against it.
    fn draw(&mut self, ends: &[Posture; 2], tree: &Tree) -> Posture {
        let (low, high) = (self.room.low, self.room.high);
        let mut q = low;
        let kind = self.random.share();
        if kind < 1.0 / 3.0 {
            for (index, value) in q.iter_mut().enumerate() {
                *value = self.random.within(low[index], high[index]);
            }
            return q;
        }
        // Logarithmic, from a hundredth of the room to half of it.
        let spread = 0.5 * 0.02_f64.powf(self.random.share());
        let (middle, moves) = if kind < 2.0 / 3.0 {
            let along = self.random.within(-0.3, 1.3).clamp(0.0, 1.0);
            (ends[0].toward(&ends[1], along), 1.0)
        } else {
            let node = (self.random.share() * tree.nodes.len() as f64) as usize;
            (tree.nodes[node.min(tree.nodes.len() - 1)].q, self.random.within(0.1, 0.6))
        };
        for (index, value) in q.iter_mut().enumerate() {
            let half = if self.random.share() < moves { spread } else { 0.0 };
            let half = half * (high[index] - low[index]);
            let drawn = middle[index] + self.random.within(-half, half);
            *value = drawn.max(low[index]).min(high[index]);
        }
        q
    }
}
