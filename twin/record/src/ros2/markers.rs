//! `visualization_msgs/msg/MarkerArray`: rigid things as triangles, strands as lines, findings as balls with their codes.

use sim::pose::{Point, Pose, Vector, is_finite_point};
use sim::scene::colours::{of_kind, of_severity};

use super::cdr::Cdr;
use super::{header, place};
use crate::mcap::{STRAND_COLOUR, Story, rgb, text};
use crate::mesh;

/// What a marker is, as RViz counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Sphere = 2,
    LineStrip = 4,
    Words = 9,
    Triangles = 11,
}

/// Radius of the ball at a finding, m, and height of its letters.
const BALL_M: f64 = 0.002;
const LETTER_M: f64 = 0.008;

/// One thing to draw, which stays for ever and with its frame, or to take away.
#[derive(Debug, Clone)]
pub(super) struct Marker {
    frame: String,
    group: String,
    id: i32,
    kind: Kind,
    is_gone: bool,
    frame_from_marker: Pose,
    size_m: Vector,
    colour: u32,
    points: Vec<Point>,
    words: String,
}

/// All rigid things, each in its frame; what is taken away by a time is deleted.
///
/// Always the whole cell: who comes late is given the last message only.
pub(super) fn cell(story: &Story<'_>, time_s: f64) -> Vec<Marker> {
    let bodies = 0..story.film.bodies.len();
    let mut all: Vec<Marker> = bodies.map(|body| rigid(story, body, time_s)).collect();
    all.extend(story.film.plate().map(|bed| Marker {
        frame: "bed".to_owned(),
        group: text::kind(bed.kind),
        id: number(story.film.bodies.len()),
        points: corners(&mesh::of_body(&bed)),
        colour: of_kind(bed.kind),
        ..triangles()
    }));
    all.retain(|marker| !marker.points.is_empty());
    all
}

fn rigid(story: &Story<'_>, index: usize, time_s: f64) -> Marker {
    let body = &story.film.bodies[index];
    let (frame, frame_from_body) = story.frames.of_body(index);
    Marker {
        frame: frame.to_owned(),
        group: text::kind(body.kind),
        id: number(index),
        frame_from_marker: frame_from_body,
        is_gone: body.gone_s.is_some_and(|gone_s| gone_s <= time_s),
        points: corners(&mesh::of_shapes(&body.shapes, &Pose::identity())),
        colour: of_kind(body.kind),
        words: text::name(&body.name),
        ..triangles()
    }
}

/// A piece of a strand.
pub(super) fn piece(story: &Story<'_>, order: usize, from: usize, to: usize) -> Marker {
    let points = story.film.strands.get(order).and_then(|strand| strand.points.get(from..=to));
    let facts = story.facts(order, from, to);
    let facts: Vec<String> = facts.iter().map(|(key, value)| format!("{key}: {value}")).collect();
    Marker {
        group: format!("strand/{order}"),
        id: number(from),
        kind: Kind::LineStrip,
        size_m: Vector::new(story.bead_m(order, from, to), 0.0, 0.0),
        colour: STRAND_COLOUR,
        points: points.unwrap_or_default().iter().copied().filter(is_finite_point).collect(),
        words: facts.join("\n"),
        ..triangles()
    }
}

/// A ball and the code at the place of a finding, if it has one.
pub(super) fn finding(story: &Story<'_>, index: usize) -> Vec<Marker> {
    let Some(found) = story.film.findings.get(index) else { return Vec::new() };
    let Some(at) = found.at.filter(is_finite_point) else { return Vec::new() };
    let mark = |kind: Kind, group: &str, above_m: f64, size_m: f64| Marker {
        group: group.to_owned(),
        id: number(index),
        kind,
        frame_from_marker: Pose::translation(at.x, at.y, at.z + above_m),
        size_m: Vector::repeat(size_m),
        colour: of_severity(found.severity),
        words: found.code.to_owned(),
        ..triangles()
    };
    vec![
        mark(Kind::Sphere, "findings", 0.0, 2.0 * BALL_M),
        mark(Kind::Words, "codes", LETTER_M, LETTER_M),
    ]
}

/// Triangles of the part, where nothing else is said.
fn triangles() -> Marker {
    Marker {
        frame: "part".to_owned(),
        group: String::new(),
        id: 0,
        kind: Kind::Triangles,
        is_gone: false,
        frame_from_marker: Pose::identity(),
        size_m: Vector::repeat(1.0),
        colour: STRAND_COLOUR,
        points: Vec::new(),
        words: String::new(),
    }
}

fn number(index: usize) -> i32 {
    i32::try_from(index).unwrap_or(i32::MAX)
}

/// Three points for each triangle.
fn corners(mesh: &mesh::Mesh) -> Vec<Point> {
    let all = mesh.triangles.iter().flatten();
    all.map(|&corner| mesh.points[corner as usize]).collect()
}

/// The message of markers.
pub(super) fn array(markers: &[Marker], ns: u64) -> Vec<u8> {
    let mut cdr = Cdr::new();
    cdr.count(markers.len());
    markers.iter().for_each(|marker| write(&mut cdr, marker, ns));
    cdr.into_bytes()
}

fn write(cdr: &mut Cdr, marker: &Marker, ns: u64) {
    header(cdr, ns, &marker.frame);
    let action = if marker.is_gone { 2 } else { 0 };
    cdr.text(&marker.group).i32(marker.id).i32(marker.kind as i32).i32(action);
    place(cdr, &marker.frame_from_marker);
    cdr.f64s(marker.size_m.as_slice());
    let [r, g, b] = rgb(marker.colour);
    [r, g, b, 1.0].iter().for_each(|share| {
        cdr.f32(*share as f32);
    });
    // stays for ever, and with its frame
    cdr.i32(0).u32(0).bool(true).count(marker.points.len());
    marker.points.iter().for_each(|p| {
        cdr.f64s(p.coords.as_slice());
    });
    // one colour for all points, no texture
    cdr.count(0).text("");
    header(cdr, 0, "");
    cdr.text("").count(0).count(0);
    cdr.text(&marker.words).text("").text("").count(0).bool(false);
}
