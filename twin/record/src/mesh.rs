//! Triangles with a normal at each vertex.

use crate::tubes::{TubeLook, capsule};
use sim::film::FilmBody;
use sim::pose::{Point, Pose, Vector};
use sim::scene::solid::{self, Triangle};
use sim::shape::Shape;
use std::collections::BTreeMap;

/// Round parts of arms and tools.
const ROUND: TubeLook = TubeLook { sides: 24, end_rings: 6 };

/// Triangles, m.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Mesh {
    /// Vertices.
    pub(crate) points: Vec<Point>,
    /// Unit normal of the smooth surface at each.
    pub(crate) normals: Vec<Vector>,
    /// What each vertex belongs to: of a tube, the point of its polyline.
    pub(crate) of: Vec<usize>,
    /// Vertices of each triangle, counter-clockwise from outside.
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Mesh {
    pub(crate) fn add(&mut self, point: Point, normal: Vector, of: usize) {
        self.points.push(point);
        self.normals.push(normal);
        self.of.push(of);
    }

    /// Adds another mesh's triangles.
    fn join(&mut self, other: &Mesh) {
        let shift = self.points.len() as u32;
        self.points.extend(&other.points);
        self.normals.extend(&other.normals);
        self.of.extend(&other.of);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|vertex| vertex + shift)));
    }

    /// A mesh of triangles each with corners of its own; equal corners become one vertex.
    fn of_triangles(triangles: &[Triangle]) -> Mesh {
        let mut mesh = Mesh::default();
        let bits = |x: f64| (x as f32 + 0.0).to_bits();
        let mut known: BTreeMap<[u32; 6], u32> = BTreeMap::new();
        for triangle in triangles {
            let corners = std::array::from_fn(|k| {
                let (point, normal) = (triangle.points[k], triangle.normals[k]);
                let key = [point.x, point.y, point.z, normal.x, normal.y, normal.z].map(bits);
                *known.entry(key).or_insert_with(|| {
                    mesh.add(point, normal, 0);
                    mesh.points.len() as u32 - 1
                })
            });
            mesh.triangles.push(corners);
        }
        mesh
    }
}

/// A rigid thing in the axes of its mover; what is not finite is left out.
pub(crate) fn of_body(body: &FilmBody) -> Mesh {
    of_shapes(&body.shapes, &body.mover_from_body)
}

/// Shapes in the axes that a pose places theirs in; what is not finite is left out.
pub(crate) fn of_shapes(shapes: &[Shape], pose: &Pose) -> Mesh {
    let solids = solid::of_shapes(shapes, pose);
    let mut mesh = Mesh::of_triangles(&solids.triangles);
    for round in &solids.capsules {
        mesh.join(&capsule(round.a, round.b, round.radius_m, ROUND));
    }
    mesh
}
