//! One moment of a film as binary glTF 2.0.
//!
//! Lengths are metres. A root node turns our upright z into glTF's upright y; beneath it all axes are the twin's own.

mod pack;
#[cfg(test)]
mod tests;

use crate::mesh::{self, Mesh};
use crate::paint;
use crate::tubes::{TubeLook, tube};
use pack::{Pack, Paint};
use serde_json::{Value, json};
use sim::film::{Film, FilmStrand, Frame, Painted, Quantity};
use sim::pose::{Point, Pose};
use sim::scene::BodyKind;

/// What a file shows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GlbOptions {
    /// Arm, tool, bed and all that stands about, too; the part is then where it is in the world, else in its own axes.
    pub cell: bool,
    /// What the strands are coloured by; plain where absent or not known.
    pub colour: Option<Quantity>,
}

/// Strands with nodes of their own; of more, neighbours in the printing order share one.
const NODES_MAX: usize = 2000;
/// Vertices of all strands together; sides are spared above, strands left out (and told so) far above.
const VERTICES_FINE: usize = 4_000_000;
const VERTICES_MAX: usize = 24_000_000;
/// Characters of a name.
const NAME_MAX: usize = 120;

/// Binary glTF of what is laid by the frame's time: strands as tubes with round ends, smooth normals and a colour per
/// vertex; each strand is a node that bears its id. Same input, same bytes. O(n).
pub fn glb(film: &Film, frame: &Frame, options: GlbOptions) -> Vec<u8> {
    let mut pack = Pack::default();
    let part = strands(film, frame, options.colour, &mut pack);
    let mut top = Vec::new();
    if options.cell {
        for (mover, name) in film.movers.iter().enumerate() {
            let mut children = if mover == film.part { part.clone() } else { Vec::new() };
            children.extend(bodies(film, frame, mover, &mut pack));
            let pose = frame.world_from_mover.get(mover);
            if let Some(pose) = pose.filter(|_| !children.is_empty()) {
                top.push(
                    pack.node(posed(json!({ "name": short(name), "children": children }), pose)),
                );
            }
        }
    } else if !part.is_empty() {
        top.push(pack.node(json!({ "name": "part", "children": part })));
    }
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let mut root = json!({ "name": short(&film.job), "rotation": [-half, 0.0, 0.0, half] });
    if !top.is_empty() {
        root["children"] = json!(top);
    }
    let root = pack.node(root);
    let painted = film.painted_by(options.colour);
    let extras = json!({
        "job": short(&film.job),
        "cell": short(&film.cell),
        "time_s": finite(frame.time_s),
        "colours": painted.map(paint::words),
    });
    pack.finish(root, extras)
}

/// Nodes of the strands, part axes.
fn strands(film: &Film, frame: &Frame, colour: Option<Quantity>, pack: &mut Pack) -> Vec<usize> {
    let painted = film.painted_by(colour);
    let points: usize = film.strands.iter().map(|strand| strand.points.len()).sum();
    let sides = if points.saturating_mul(8) <= VERTICES_FINE { 8 } else { 4 };
    let look = TubeLook { sides, end_rings: 2 };
    let each = film.strands.len().div_ceil(NODES_MAX).max(1);
    let mut nodes = Vec::new();
    for (group, strands) in film.strands.chunks(each).enumerate() {
        let first = group * each;
        let skin = pack.begin();
        for (order, strand) in (first..).zip(strands) {
            if pack.vertices() <= VERTICES_MAX {
                add_strand(film, painted, (order, strand), frame.time_s, look, pack);
            }
        }
        let name = match strands {
            [only] => short(&only.id),
            _ => format!("strands {} to {}", first + 1, first + strands.len()),
        };
        let Some(mesh) = pack.mesh(skin, &name, Paint::Vertices) else { continue };
        let mut node = json!({ "name": name, "mesh": mesh });
        if let [only] = strands {
            node["extras"] = extras(only, first, painted, frame.time_s);
        }
        nodes.push(pack.node(node));
    }
    nodes
}

fn add_strand(
    film: &Film,
    painted: Option<&Painted>,
    (order, strand): (usize, &FilmStrand),
    time_s: f64,
    look: TubeLook,
    pack: &mut Pack,
) {
    let points = laid(strand, time_s);
    let segment = |k: usize| paint::segment(film, painted, order, k, time_s);
    // a point counts where the colour changes
    let changes = |k: usize| k == 0 || segment(k - 1) != segment(k);
    let mesh = tube(&points, strand.radius_m, look, changes);
    let last = points.len().saturating_sub(2);
    pack.add(&mesh, |vertex| {
        let k = mesh.of[vertex];
        let sides = [k.saturating_sub(1).min(last), k.min(last)].map(segment);
        let channel = |c: usize| sides.map(|rgb| paint::linear(rgb[c])).iter().sum::<f64>() / 2.0;
        Some([channel(0), channel(1), channel(2)])
    });
}

/// The points laid by a time, the one that is being laid among them.
fn laid(strand: &FilmStrand, time_s: f64) -> Vec<Point> {
    let (laid, share) = strand.laid(time_s);
    let all = &strand.points;
    let last =
        share.and_then(|share| Some((all.get(laid.checked_sub(1)?)?, all.get(laid)?, share)));
    let mut points = all[..laid.min(all.len())].to_vec();
    points.extend(last.map(|(from, to, share)| from + (to - from) * share));
    points
}

/// What is known of a strand, for whoever clicks on it.
fn extras(strand: &FilmStrand, order: usize, painted: Option<&Painted>, time_s: f64) -> Value {
    let value = painted.and_then(|painted| {
        let value = strand.value(order, 0, painted.quantity, time_s)?;
        Some(painted.quantity.on_screen(value))
    });
    json!({
        "order": order + 1,
        "radius_mm": finite(strand.radius_m * 1e3),
        "from_s": strand.born_s().and_then(finite),
        "to_s": strand.done_s().and_then(finite),
        "value": value.and_then(finite),
    })
}

/// Nodes of the rigid things on a mover.
fn bodies(film: &Film, frame: &Frame, mover: usize, pack: &mut Pack) -> Vec<usize> {
    let there = film.bodies.iter().filter(|body| {
        body.mover == mover && body.gone_s.is_none_or(|gone_s| frame.time_s < gone_s)
    });
    let mut nodes: Vec<usize> = there
        .filter_map(|body| body_node(pack, &mesh::of_body(body), &body.name, body.kind))
        .collect();
    if mover == film.bed {
        let plate = film.plate();
        nodes.extend(plate.and_then(|bed| body_node(pack, &mesh::of_body(&bed), "bed", bed.kind)));
    }
    nodes
}

fn body_node(pack: &mut Pack, mesh: &Mesh, name: &str, kind: BodyKind) -> Option<usize> {
    let skin = pack.begin();
    pack.add(mesh, |_| None);
    let mesh = pack.mesh(skin, &short(name), Paint::Kind(kind))?;
    Some(pack.node(json!({ "name": short(name), "mesh": mesh })))
}

fn posed(mut node: Value, pose: &Pose) -> Value {
    let q = pose.rotation.coords;
    let t = pose.translation.vector;
    if q.iter().chain(t.iter()).all(|x| x.is_finite()) {
        node["rotation"] = json!([q.x, q.y, q.z, q.w]);
        node["translation"] = json!([t.x, t.y, t.z]);
    }
    node
}

/// A name that a hostile job cannot make huge.
fn short(name: &str) -> String {
    name.chars().take(NAME_MAX).collect()
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
