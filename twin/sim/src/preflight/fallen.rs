//! The picture of what falls when a stage fails: an illustration.

use super::Preflight;
use super::deformed::{Unit, bed, caption, forms, standing};
use crate::aftermath::{Bit, Break, Collapse, Failing, Ground, Mesh, collapse};
use crate::finding::counted;
use crate::growth::{Cause, Fails};
use crate::pose::{Point, Pose, Vector};
use crate::scene::{Bounds, ColourScale, Mark, MarkSeverity, Row, Scene, StrandShape};

/// Pieces are followed this many sizes of the part away from it; what rolls farther leaves the picture.
const FOLLOWED_SIZES: f64 = 0.4;

/// The first stage that floats, is a mechanism or breaks, and what falls then at three moments.
///
/// rapier3d on rigid pieces: marked as an illustration. `None` where nothing fails or nothing
/// comes loose, and where the frame is too large for it.
pub fn fallen(preflight: &Preflight) -> Option<Row> {
    let fails = preflight.growth.shown.fails.as_ref()?;
    let collapse = collapsed(preflight, fails)?;
    let moments = moments(&collapse)?;
    let most_m = moments.iter().map(|&at| most_moved_m(&collapse, at)).fold(0.0, f64::max);
    let scenes: Vec<Scene> =
        moments.iter().map(|&at| scene(preflight, fails, &collapse, at, most_m)).collect();
    let n_pieces = collapse.pieces.len();
    Some(Row {
        title: format!(
            "{} – illustration of what falls {}",
            preflight.job.name,
            caption(preflight, fails.stage)
        ),
        scenes,
        notes: vec![
            why(preflight, fails),
            format!("{} held by nothing", counted(n_pieces, "piece")),
            "grey: what stays".to_owned(),
            "rigid pieces, no scale factor: nothing bends or sticks here, and where they come to lie is one of many places"
                .to_owned(),
        ],
        stamp: Some("illustration".to_owned()),
    })
}

/// Lets the failing stage fall.
fn collapsed(preflight: &Preflight, fails: &Fails) -> Option<Collapse> {
    let broken: Vec<Break> = match fails.cause {
        Cause::Breaks { member, share } => vec![Break { member, share }],
        Cause::Floats { .. } | Cause::Mechanism { .. } => Vec::new(),
    };
    let meshes: Vec<Mesh> = standing(preflight, fails.stage)
        .map(|form| Mesh { vertices: &form.vertices, triangles: &form.triangles })
        .collect();
    let failing = Failing {
        frame: &preflight.growth.built.frame,
        born: fails.born,
        supports: &fails.supports,
        breaks: &broken,
        gravity_m_s2: fails.gravity_m_s2,
    };
    let ground = Ground { part_from_bed: preflight.job.bed_from_part.inverse(), forms: &meshes };
    collapse(&failing, &ground).ok().filter(|collapse| !collapse.pieces.is_empty())
}

/// The start, the moment when half of the way is gone, and the end.
fn moments(collapse: &Collapse) -> Option<[usize; 3]> {
    let last = collapse.times_s.len().checked_sub(1).filter(|&last| last >= 2)?;
    let way_m = |at: usize| -> f64 {
        bits(collapse, at).map(|(bit, pose)| (pose * middle(bit) - middle(bit)).norm()).sum()
    };
    let half_m = 0.5 * way_m(last);
    let half = (1..last).find(|&at| way_m(at) >= half_m).unwrap_or(last / 2);
    Some([0, half, last])
}

/// The bits of all pieces with their pose at a moment.
fn bits(collapse: &Collapse, at: usize) -> impl Iterator<Item = (&Bit, &Pose)> {
    collapse
        .pieces
        .iter()
        .flat_map(move |piece| piece.bits.iter().map(move |bit| (bit, &piece.poses[at])))
}

fn middle(bit: &Bit) -> Point {
    nalgebra::center(&bit.ends[0], &bit.ends[1])
}

fn most_moved_m(collapse: &Collapse, at: usize) -> f64 {
    let moved_m = |(bit, pose): (&Bit, &Pose)| (pose * middle(bit) - middle(bit)).norm();
    bits(collapse, at).map(moved_m).fold(0.0, f64::max)
}

fn scene(
    preflight: &Preflight,
    fails: &Fails,
    collapse: &Collapse,
    at: usize,
    most_m: f64,
) -> Scene {
    let bed_from_part = preflight.job.bed_from_part;
    let unit = Unit::of(most_m);
    let shape = |bit: &Bit, pose: &Pose, value: Option<f64>| StrandShape {
        points: bit.ends.iter().map(|end| bed_from_part * (pose * end)).collect(),
        radius_m: bit.radius_m,
        value,
        highlighted: false,
    };
    let stays = collapse.rest.iter().map(|bit| shape(bit, &Pose::identity(), None));
    let moving = bits(collapse, at).map(|(bit, pose)| {
        let moved_m = (pose * middle(bit) - middle(bit)).norm();
        shape(bit, pose, Some(moved_m * unit.per_m))
    });
    let mut scene = Scene {
        bodies: forms(preflight, fails.stage),
        strands: stays.chain(moving).collect(),
        planned: Vec::new(),
        bed: bed(preflight),
        title: format!("{:.2} s after it fails", collapse.times_s[at]),
        marks: Vec::new(),
        colour: Some(ColourScale {
            title: "moved".to_owned(),
            unit: unit.name.to_owned(),
            low: 0.0,
            high: most_m * unit.per_m,
            limit: None,
        }),
        part_bounds: None,
    };
    scene.part_bounds = around(preflight, collapse).zip(scene.part()).map(|(start, now)| Bounds {
        min: now.min.sup(&(start.min - follow(&start))),
        max: now.max.inf(&(start.max + follow(&start))),
    });
    if at == 0 {
        let node = match fails.cause {
            Cause::Floats { node } | Cause::Mechanism { node } => Some(node),
            Cause::Breaks { member, .. } => {
                preflight.growth.built.frame.members().get(member).map(|member| member.ends[0])
            }
        };
        let place =
            node.map(|node| (node, bed_from_part * preflight.growth.built.frame.nodes()[node]));
        scene.marks.extend(place.map(|(node, at)| Mark {
            at,
            label: format!("node {node}"),
            severity: MarkSeverity::Error,
        }));
    }
    scene
}

/// The box about everything before it falls, in bed axes.
fn around(preflight: &Preflight, collapse: &Collapse) -> Option<Bounds> {
    let start = bits(collapse, 0).map(|(bit, _)| bit).chain(&collapse.rest);
    let reach = |bit: &Bit| {
        let r = Vector::repeat(bit.radius_m);
        let ends = bit.ends.map(|end| preflight.job.bed_from_part * end);
        [ends[0] - r, ends[0] + r, ends[1] - r, ends[1] + r]
    };
    Bounds::of(start.flat_map(reach))
}

fn follow(start: &Bounds) -> Vector {
    Vector::repeat(start.size().max() * FOLLOWED_SIZES)
}

/// What failed, in words.
fn why(preflight: &Preflight, fails: &Fails) -> String {
    let built = &preflight.growth.built;
    let name = |order: usize| {
        let strand = preflight.deposit.strands.get(order).map_or(0, |printed| printed.strand);
        preflight.job.strands.get(strand).map_or("", |strand| strand.id.as_str()).to_owned()
    };
    match fails.cause {
        Cause::Floats { node } => match built.strand_at(node) {
            Some(order) => format!("strand `{}` hangs on nothing", name(order)),
            None => format!("node {node} hangs on nothing"),
        },
        Cause::Mechanism { node } => format!("node {node} moves without stiffness"),
        Cause::Breaks { member, .. } => {
            let used =
                preflight.growth.stages[fails.stage].member.map_or(0.0, |used| used.share.nominal);
            format!(
                "strand `{}` breaks: {used:.1} of its strength",
                name(built.member_order[member])
            )
        }
    }
}
