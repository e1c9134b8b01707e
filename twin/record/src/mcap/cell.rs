//! The rigid things of a cell as primitives: robot, tool, bed, fixtures and forms.

use sim::film::FilmBody;
use sim::pose::{Point, Pose, Vector, from_z_axis, is_finite_point};
use sim::scene::colours::of_kind;
use sim::scene::solid::{Triangle, of_shapes};
use sim::shape::Shape;

use super::parts;
use super::story::Story;
use super::wire::Proto;

// fields of foxglove.SceneEntity
const CUBES: u32 = 8;
const SPHERES: u32 = 9;
const CYLINDERS: u32 = 10;
const TRIANGLES: u32 = 12;

/// `foxglove.SceneUpdate` of everything rigid that is there at a time, each in its frame; what was taken away is deleted.
///
/// Always the whole cell: a viewer that jumps in time is given the last message only.
pub(super) fn update(story: &Story<'_>, time_s: f64, ns: u64) -> Vec<u8> {
    let (mut deletions, mut entities) = (Vec::new(), Vec::new());
    for (index, body) in story.film.bodies.iter().enumerate() {
        let id = format!("body/{index}");
        if body.gone_s.is_some_and(|gone_s| gone_s <= time_s) {
            deletions.push(Proto::default().message(1, parts::stamp(ns)).uint(2, 0).text(3, &id));
            continue;
        }
        let (frame, frame_from_body) = story.frames.of_body(index);
        let named = parts::entity(ns, frame, &id)
            .message(6, parts::pair("name", &super::text::name(&body.name)))
            .message(6, parts::pair("kind", &super::text::kind(body.kind)));
        entities.push(with_shapes(named, body, &frame_from_body));
    }
    entities.extend(
        story
            .film
            .plate()
            .map(|bed| with_shapes(parts::entity(ns, "bed", "bed"), &bed, &Pose::identity())),
    );
    Proto::default().messages(1, deletions).messages(2, entities).into_bytes()
}

fn with_shapes(entity: Proto, body: &FilmBody, frame_from_body: &Pose) -> Proto {
    let colour = parts::colour(of_kind(body.kind), 1.0);
    let add = |entity, shape| with_shape(entity, shape, frame_from_body, &colour);
    body.shapes.iter().fold(entity, add)
}

fn with_shape(entity: Proto, shape: &Shape, at: &Pose, colour: &Proto) -> Proto {
    match shape {
        Shape::Capsule { a, b, radius_m } => {
            let ball = |p: &Point| {
                let size = parts::vector(&Vector::repeat(2.0 * radius_m));
                let centre = at * Pose::translation(p.x, p.y, p.z);
                cube_like(&centre, size, colour)
            };
            let entity = entity.message(SPHERES, ball(a));
            match cylinder((*a, *b), (*radius_m, *radius_m), at, colour) {
                Some(bar) => entity.message(SPHERES, ball(b)).message(CYLINDERS, bar),
                None => entity,
            }
        }
        Shape::Cone { from, to, radius_from_m, radius_to_m } => {
            let bar = cylinder((*from, *to), (*radius_from_m, *radius_to_m), at, colour);
            entity.messages(CYLINDERS, bar)
        }
        Shape::Box { pose, half_m } => {
            let size = parts::vector(&(half_m * 2.0));
            entity.message(CUBES, cube_like(&(at * pose), size, colour))
        }
        Shape::Hull { .. } => entity.messages(TRIANGLES, hull(shape, at, colour)),
        Shape::Mesh { vertices, triangles } => {
            entity.messages(TRIANGLES, mesh(vertices, triangles, at, colour))
        }
    }
}

/// `foxglove.CubePrimitive` or `SpherePrimitive`.
fn cube_like(pose: &Pose, size: Proto, colour: &Proto) -> Proto {
    Proto::default().message(1, parts::pose(pose)).message(2, size).message(3, colour.clone())
}

/// `foxglove.CylinderPrimitive`, z from the first end to the second; `None` without length or thickness.
fn cylinder(ends: (Point, Point), radii: (f64, f64), at: &Pose, colour: &Proto) -> Option<Proto> {
    let axis = ends.1 - ends.0;
    let (length_m, radius_m) = (axis.norm(), radii.0.max(radii.1));
    if !(length_m > 0.0 && radius_m > 0.0 && length_m.is_finite() && radius_m.is_finite()) {
        return None;
    }
    let pose = at * from_z_axis(ends.0 + axis / 2.0, axis, Vector::x());
    let size = Vector::new(2.0 * radius_m, 2.0 * radius_m, length_m);
    Some(
        Proto::default()
            .message(1, parts::pose(&pose))
            .message(2, parts::vector(&size))
            .double(3, radii.0 / radius_m)
            .double(4, radii.1 / radius_m)
            .message(5, colour.clone()),
    )
}

/// `foxglove.TriangleListPrimitive` of a mesh; triangles that name no vertex are left out.
fn mesh(vertices: &[Point], faces: &[[u32; 3]], at: &Pose, colour: &Proto) -> Option<Proto> {
    if !vertices.iter().all(is_finite_point) {
        return None;
    }
    let whole = |face: &&[u32; 3]| face.iter().all(|&corner| (corner as usize) < vertices.len());
    let indices: Vec<u32> = faces.iter().filter(whole).flatten().copied().collect();
    triangle_list(vertices, &indices, at, colour)
}

/// The convex hull as triangles.
fn hull(shape: &Shape, at: &Pose, colour: &Proto) -> Option<Proto> {
    let solids = of_shapes(std::slice::from_ref(shape), &Pose::identity());
    let corners: Vec<Point> =
        solids.triangles.iter().flat_map(|triangle: &Triangle| triangle.points).collect();
    let indices: Vec<u32> = (0u32..).take(corners.len()).collect();
    triangle_list(&corners, &indices, at, colour)
}

fn triangle_list(points: &[Point], indices: &[u32], at: &Pose, colour: &Proto) -> Option<Proto> {
    let list = Proto::default()
        .message(1, parts::pose(at))
        .messages(2, points.iter().map(parts::point))
        .message(3, colour.clone())
        .fixed32s(5, indices);
    (!indices.is_empty()).then_some(list)
}
