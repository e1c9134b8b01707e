//! Rigid things as triangles in the axes of their movers, with round ones as capsules.

use super::blob::Blob;
use super::grid::Grid;
use serde_json::{Value, json};
use sim::film::{Film, FilmBody};
use sim::pose::{Point, Pose};
use sim::scene::solid::{Capsule, Triangle, of_shapes};
use sim::scene::{BodyKind, Shape};
use std::collections::BTreeMap;

/// Corners of one body at most: its triangles count them with 16 bits.
const CORNERS_MAX: usize = 65_535;
/// Edges of the cells that corners are drawn together in, of the body's longest edge, finest first.
const COARSE: [f64; 6] =
    [1.0 / 400.0, 1.0 / 200.0, 1.0 / 100.0, 1.0 / 50.0, 1.0 / 25.0, 1.0 / 12.0];

/// One body as the viewer draws it.
#[derive(Debug, Clone)]
pub(super) struct Packed {
    name: String,
    kind: BodyKind,
    mover: usize,
    gone_s: Option<f64>,
    grid: Grid,
    /// Place and normal of each corner.
    corners: Vec<([u16; 3], [i8; 3])>,
    triangles: Vec<[u16; 3]>,
    capsules: Vec<Capsule>,
}

impl Packed {
    fn bytes(&self) -> usize {
        9 * self.corners.len() + 6 * self.triangles.len() + 28 * self.capsules.len()
    }
}

/// All bodies and the bed within `room` bytes, and how many of them are drawn coarser than they are.
///
/// The largest are made coarser first; one that even then does not fit is left out.
pub(super) fn pack(film: &Film, room: usize) -> (Vec<Packed>, usize) {
    let bed = film.plate();
    let there = bed.iter().chain(&film.bodies);
    let mut coarse = 0;
    let mut left = room;
    let mut waiting: Vec<(usize, Vec<Triangle>, Packed)> = Vec::new();
    for (index, body) in there.enumerate() {
        let all = of_shapes(&body.shapes, &body.mover_from_body);
        let packed = packed(body, &all.triangles, all.capsules);
        waiting.push((index, all.triangles, packed));
    }
    waiting.sort_by_key(|(index, _, packed)| (packed.bytes(), *index));
    let mut done: Vec<(usize, Packed)> = Vec::new();
    let many = waiting.len();
    for (place, (index, triangles, full)) in waiting.into_iter().enumerate() {
        // what the larger ones do not need of their shares is not known yet: the small go first
        let share = left / (many - place);
        let fits = |p: &Packed| p.bytes() <= share && p.corners.len() <= CORNERS_MAX;
        let chosen = if fits(&full) {
            full
        } else {
            coarse += 1;
            let body = |k: f64| coarser(&full, &triangles, k);
            match COARSE.iter().map(|&k| body(k)).find(&fits) {
                Some(found) => found,
                None => continue,
            }
        };
        left -= chosen.bytes();
        done.push((index, chosen));
    }
    done.sort_by_key(|(index, _)| *index);
    (done.into_iter().map(|(_, packed)| packed).collect(), coarse)
}

fn packed(body: &FilmBody, triangles: &[Triangle], capsules: Vec<Capsule>) -> Packed {
    let empty = Packed {
        name: body.name.clone(),
        kind: body.kind,
        mover: body.mover,
        gone_s: body.gone_s,
        grid: Grid { min: [0.0; 3], size: [0.0; 3] },
        corners: Vec::new(),
        triangles: Vec::new(),
        capsules,
    };
    with(empty, triangles)
}

/// The body with these triangles; corners that are alike are told once.
fn with(body: Packed, triangles: &[Triangle]) -> Packed {
    let grid = Grid::about(triangles.iter().flat_map(|t| t.points));
    let mut known: BTreeMap<([u16; 3], [i8; 3]), usize> = BTreeMap::new();
    let mut corners = Vec::new();
    let mut faces = Vec::with_capacity(triangles.len());
    for triangle in triangles {
        let face: [usize; 3] = std::array::from_fn(|k| {
            let normal = triangle.normals[k];
            let normal = [normal.x, normal.y, normal.z].map(|x| (x * 127.0).round() as i8);
            let corner = (grid.code(&triangle.points[k]), normal);
            *known.entry(corner).or_insert_with(|| {
                corners.push(corner);
                corners.len() - 1
            })
        });
        if face[0] != face[1] && face[1] != face[2] && face[2] != face[0] {
            faces.push(face.map(|k| k as u16));
        }
    }
    Packed { grid, corners, triangles: faces, ..body }
}

/// Corners in one cell become their middle.
fn coarser(body: &Packed, triangles: &[Triangle], share: f64) -> Packed {
    let cell = body.grid.size.into_iter().fold(0.0, f64::max) * share;
    let key = |p: &Point| -> [i64; 3] { std::array::from_fn(|i| (p[i] / cell).floor() as i64) };
    let mut cells: BTreeMap<[i64; 3], (u32, Point, f64)> = BTreeMap::new();
    for p in triangles.iter().flat_map(|t| &t.points) {
        let next = cells.len() as u32;
        let (_, sum, many) = cells.entry(key(p)).or_insert((next, Point::origin(), 0.0));
        *sum += p.coords;
        *many += 1.0;
    }
    let mut vertices = vec![Point::origin(); cells.len()];
    for (index, sum, many) in cells.values() {
        vertices[*index as usize] = sum / *many;
    }
    let corner = |p: &Point| cells.get(&key(p)).map_or(0, |(index, ..)| *index);
    let faces = triangles.iter().map(|t| t.points.map(|p| corner(&p)));
    let faces: Vec<[u32; 3]> = faces.filter(|[a, b, c]| a != b && b != c && c != a).collect();
    let shape = Shape::Mesh { vertices, triangles: faces };
    let all = of_shapes(&[shape], &Pose::identity());
    with(body.clone(), &all.triangles)
}

/// Writes the bodies one after the other.
pub(super) fn write(bodies: &[Packed], blob: &mut Blob) -> Value {
    let corners = || bodies.iter().flat_map(|body| &body.corners);
    blob.u16s("corner_at", corners().flat_map(|corner| corner.0));
    blob.i8s("corner_normal", corners().flat_map(|corner| corner.1));
    blob.u16s("triangle", bodies.iter().flat_map(|body| body.triangles.iter().flatten().copied()));
    let capsule = |c: &Capsule| [c.a.x, c.a.y, c.a.z, c.b.x, c.b.y, c.b.z, c.radius_m];
    blob.f32s("capsule", bodies.iter().flat_map(|body| body.capsules.iter().flat_map(capsule)));
    let told = bodies.iter().map(|body| {
        json!({
            "name": super::cut(&body.name),
            "kind": kind(body.kind),
            "mover": body.mover,
            "gone_s": body.gone_s,
            "box": body.grid.told(),
            "corners": body.corners.len(),
            "triangles": body.triangles.len(),
            "capsules": body.capsules.len(),
        })
    });
    Value::Array(told.collect())
}

/// A word for the viewer's table of colours.
fn kind(kind: BodyKind) -> &'static str {
    match kind {
        BodyKind::Arm => "arm",
        BodyKind::Tool => "tool",
        BodyKind::Nozzle => "nozzle",
        BodyKind::Bed => "bed",
        BodyKind::Obstacle => "obstacle",
        BodyKind::Form => "form",
        BodyKind::OtherArm => "other",
    }
}
