//! The deposit as beads in a tree: what of it is nearest to a body, a posture, a place.

use super::body::Body;
use super::solid::Solid;
use super::tree::{Node, Tree};
use crate::deposit::Deposit;
use crate::pose::{Point, Pose};

/// Every segment of a deposit as a bead: the line between its ends and its radius.
///
/// Segments are numbered in printing order, and every question is asked of those before a number:
/// what stands when so much is printed. Building is O(n log n). A question is O(log n) where one
/// bead is clearly nearest; it costs a comparison where all are far. The tree is built once over
/// all that will be printed, and a part of it without anything printed yet costs one comparison.
#[derive(Debug, Clone)]
pub struct Beads {
    tree: Tree,
    /// In the order of the tree.
    beads: Vec<Bead>,
    /// Number of the first segment of each strand by printing order, and of all at the end.
    starts: Vec<u32>,
}

#[derive(Debug, Clone, Copy)]
struct Bead {
    ends: [Point; 2],
    radius_m: f64,
}

/// The bead nearest to some bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// Clearance, m: never more than it is, and less by 1e-9 m at most; negative: overlap.
    pub clearance_m: f64,
    /// Which of the bodies.
    pub body: usize,
    /// Which segment of the deposit.
    pub segment: usize,
}

impl Beads {
    /// Indexes all segments of a deposit.
    pub fn new(deposit: &Deposit) -> Self {
        let boxes: Vec<(Point, Point)> = deposit.segments.iter().map(|s| s.bounds()).collect();
        let tree = Tree::new(&boxes);
        let bead = |&k: &u32| {
            let segment = &deposit.segments[k as usize];
            Bead { ends: segment.ends, radius_m: segment.radius_m }
        };
        let beads = tree.order.iter().map(bead).collect();
        let mut starts = Vec::with_capacity(deposit.strands.len() + 1);
        for (k, segment) in deposit.segments.iter().enumerate() {
            while starts.len() <= segment.order {
                starts.push(k as u32);
            }
        }
        while starts.len() <= deposit.strands.len() {
            starts.push(deposit.segments.len() as u32);
        }
        Self { tree, beads, starts }
    }

    /// Number of segments of the first `n_strands` strands in printing order.
    pub fn segments_of(&self, n_strands: usize) -> usize {
        let last = self.starts.len() - 1;
        self.starts[n_strands.min(last)] as usize
    }

    /// The nearest of the first `n_segments` beads to a body at `pose` in part axes; `None` where
    /// none is nearer than `beyond_m`.
    pub fn nearest(
        &self,
        body: &Body,
        pose: &Pose,
        n_segments: usize,
        beyond_m: f64,
    ) -> Option<Nearest> {
        self.nearest_of(&[(body, *pose)], n_segments, beyond_m)
    }

    /// The nearest of the first `n_segments` beads to any of these bodies at their poses in part
    /// axes; `None` where none is nearer than `beyond_m`.
    ///
    /// The body nearest to the box about the deposit is asked first, and what it finds bounds the
    /// search of all others: most are ruled out by that box alone.
    pub fn nearest_of(
        &self,
        bodies: &[(&Body, Pose)],
        n_segments: usize,
        beyond_m: f64,
    ) -> Option<Nearest> {
        let root = self.tree.root()?;
        let mut found = None;
        let to_root_m =
            |body: &Body, pose: &Pose| root.to_point(&(pose * body.centre)) - body.radius_m;
        let mut first = (f64::INFINITY, 0);
        for (index, (body, pose)) in bodies.iter().enumerate() {
            // Of those that reach into the box the one named first: a tool before its arm.
            let bound_m = to_root_m(body, pose).max(0.0);
            if bound_m < first.0 {
                first = (bound_m, index);
            }
        }
        let rest = (0..bodies.len()).filter(|&index| index != first.1);
        let mut best_m = beyond_m;
        for index in std::iter::once(first.1).chain(rest) {
            let (body, pose) = bodies.get(index)?;
            let bound_m = to_root_m(body, pose);
            if bound_m > 0.0 && bound_m >= best_m {
                continue;
            }
            for solid in &body.solids {
                let nearest = self.nearest_to_solid(solid, pose, n_segments, best_m);
                if let Some((clearance_m, segment)) = nearest {
                    best_m = clearance_m;
                    found = Some(Nearest { clearance_m, body: index, segment });
                }
            }
        }
        found
    }

    fn nearest_to_solid(
        &self,
        solid: &Solid,
        pose: &Pose,
        n_segments: usize,
        beyond_m: f64,
    ) -> Option<(f64, usize)> {
        let root = self.tree.root()?;
        let centre_m = root.to_point(&(pose * solid.reach.centre)) - solid.reach.radius_m;
        if centre_m > 0.0 && centre_m >= beyond_m {
            return None;
        }
        let reach = solid.reach.placed(pose);
        let mut segment = None;
        let measure = |place: usize, best_m: f64| {
            let Bead { ends, radius_m } = &self.beads[place];
            let bound_m = reach.to_line(ends) - radius_m;
            if bound_m >= best_m {
                return bound_m;
            }
            let local = ends.map(|end| pose.inverse_transform_point(&end));
            let clearance_m = solid.to_line(&local, *radius_m, best_m);
            if clearance_m < best_m {
                segment = Some(self.tree.order[place] as usize);
            }
            clearance_m
        };
        let below = u32::try_from(n_segments).unwrap_or(u32::MAX);
        let bound_m = |node: &Node| reach.to_node(node);
        let least_m = self.tree.least(below, beyond_m, bound_m, measure);
        segment.map(|segment| (least_m, segment))
    }

    /// Numbers of the segments before `n_segments` whose beads may be within `horizon_m` of a body
    /// at `pose`, ascending, without repeats.
    pub fn within(
        &self,
        body: &Body,
        pose: &Pose,
        n_segments: usize,
        horizon_m: f64,
        found: &mut Vec<u32>,
    ) {
        found.clear();
        let below = u32::try_from(n_segments).unwrap_or(u32::MAX);
        for solid in &body.solids {
            let reach = solid.reach.placed(pose);
            let near = |node: &Node| reach.to_node(node) <= horizon_m;
            self.tree.visit(below, near, |place| {
                let Bead { ends, radius_m } = &self.beads[place];
                if reach.to_line(ends) - radius_m <= horizon_m {
                    found.push(self.tree.order[place]);
                }
            });
        }
        found.sort_unstable();
        found.dedup();
    }
}
