//! Meshes: triangles in a tree of boxes.

use super::core::Core;
use super::solid::{Reach, apart};
use super::tree::{Node, Tree};
use crate::pose::{Point, Pose, Vector};

#[derive(Debug, Clone)]
pub(super) struct Mesh {
    /// In the order of the tree; never empty.
    triangles: Vec<[Point; 3]>,
    tree: Tree,
    /// Whether it parts an inside from an outside.
    closed: bool,
}

impl Mesh {
    /// Triangles that name a vertex that is not there are left out; of none there is left the
    /// hull of the vertices.
    pub(super) fn new(vertices: &[Point], indices: &[[u32; 3]]) -> Self {
        let corner = |index: u32| vertices.get(index as usize).copied();
        let triangles: Vec<[Point; 3]> = indices
            .iter()
            .filter_map(|&[a, b, c]| Some([corner(a)?, corner(b)?, corner(c)?]))
            .collect();
        let boxes: Vec<(Point, Point)> =
            triangles.iter().map(|[a, b, c]| (a.inf(b).inf(c), a.sup(b).sup(c))).collect();
        let tree = Tree::new(&boxes);
        let closed = is_closed(&triangles);
        let triangles = tree.order.iter().map(|&k| triangles[k as usize]).collect();
        Self { triangles, tree, closed }
    }

    /// Whether a place lies inside; never in a mesh with open edges. O(log n) as a rule.
    ///
    /// A ray along z crosses the surface an odd number of times. A triangle is crossed where the
    /// place is in its shadow by the crossings of its edges, and an edge is decided alike for both
    /// its triangles, so that a ray through an edge or a corner is counted right.
    pub(super) fn holds(&self, place: &Point) -> bool {
        if !self.closed {
            return false;
        }
        let mut crossings = 0;
        let under = |node: &Node| {
            let out = (place - node.middle).abs() - node.half;
            out.x <= 0.0 && out.y <= 0.0 && place.z <= node.middle.z + node.half.z
        };
        self.tree.visit(u32::MAX, under, |at| {
            crossings += usize::from(crosses(&self.triangles[at], place));
        });
        crossings % 2 == 1
    }

    /// All corners; a point for a mesh of nothing.
    pub(super) fn hull(&self) -> Core {
        if self.triangles.is_empty() {
            return Core::Line([Point::origin(); 2]);
        }
        Core::Hull(self.triangles.as_flattened().to_vec())
    }

    /// Distance of its surface from a core in the same axes, m, or a lower bound beyond `beyond_m`;
    /// not positive where they cross or the core is inside.
    pub(super) fn to_core(&self, core: &Core, beyond_m: f64) -> f64 {
        if self.holds(&Point::from(core.support(&Vector::z()))) {
            return 0.0;
        }
        let reach = Reach::of(core, 0.0);
        self.to_reach(core, &reach, beyond_m)
    }

    fn to_reach(&self, core: &Core, reach: &Reach, beyond_m: f64) -> f64 {
        let measure = |place: usize, best_m: f64| {
            let triangle = self.triangles[place];
            let middle = (triangle[0].coords + triangle[1].coords + triangle[2].coords) / 3.0;
            let start: Vector = middle - reach.centre.coords;
            apart(core, &Core::Triangle(triangle), &Pose::identity(), start, best_m).least_m
        };
        self.tree.least(u32::MAX, beyond_m, |node| reach.to_node(node), measure)
    }

    /// Distance of two surfaces, the other placed by a pose; not positive where one is in the
    /// other. O(n log m).
    pub(super) fn to_mesh(&self, other: &Self, pose: &Pose, beyond_m: f64) -> f64 {
        let corner = |mesh: &Self| mesh.triangles.first().map(|triangle| triangle[0]);
        if corner(self).is_some_and(|place| other.holds(&pose.inverse_transform_point(&place))) {
            return 0.0;
        }
        other.triangles.iter().fold(beyond_m, |best_m, triangle| {
            let core = Core::Triangle(triangle.map(|corner| pose * corner));
            self.to_core(&core, best_m)
        })
    }
}

/// Whether the ray from `place` along z goes through a triangle.
fn crosses([a, b, c]: &[Point; 3], place: &Point) -> bool {
    let edges = [(a, b), (b, c), (c, a)];
    if edges.into_iter().filter(|(from, to)| passes(from, to, place)).count() % 2 == 0 {
        return false;
    }
    let normal = (b - a).cross(&(c - a));
    // In the shadow, so the triangle is not upright but for rounding.
    let above = normal.dot(&(a - place)) * normal.z;
    above > 0.0
}

/// Whether an edge crosses the ray from `place` along x, all seen along z; alike in both
/// directions of the edge.
fn passes(from: &Point, to: &Point, place: &Point) -> bool {
    if (from.y > place.y) == (to.y > place.y) {
        return false;
    }
    let (low, high) = if from.y < to.y { (from, to) } else { (to, from) };
    (place.x - low.x) * (high.y - low.y) < (high.x - low.x) * (place.y - low.y)
}

/// Whether every edge belongs to an even number of triangles; corners are the same where their
/// coordinates are.
fn is_closed(triangles: &[[Point; 3]]) -> bool {
    let key = |point: &Point| [point.x, point.y, point.z].map(|x| (x + 0.0).to_bits());
    let edge = |a: &Point, b: &Point| {
        let (a, b) = (key(a), key(b));
        if a < b { [a, b] } else { [b, a] }
    };
    let mut edges: Vec<_> = triangles
        .iter()
        .flat_map(|[a, b, c]| [edge(a, b), edge(b, c), edge(c, a)])
        .filter(|[a, b]| a != b)
        .collect();
    edges.sort_unstable();
    edges.chunk_by(|a, b| a == b).all(|same| same.len() % 2 == 0)
}
