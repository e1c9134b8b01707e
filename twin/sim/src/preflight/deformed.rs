//! The picture of the frame as it sags while it grows: three stages, displacements enlarged.

use super::Preflight;
use crate::finding::counted;
use crate::growth::{Growth, ShownStage};
use crate::pose::{Pose, Vector};
use crate::scene::{
    BedShape, Body, BodyKind, Bounds, ColourScale, Mark, MarkSeverity, Row, Scene, StrandShape,
};
use crate::shape::Shape;
use crate::structure::displacement_along;

/// The largest displacement is drawn at most this share of the part's longest edge.
const DRAWN_SHARE: f64 = 0.05;
/// Pieces of members in a picture: beyond it each member is drawn straight, in one colour.
const PIECES_MAX: usize = 24_000;
/// Pieces of one member: a cubic in eight pieces is off by a thousandth of its height.
const PIECES_OF_MEMBER: usize = 8;
/// Members are drawn at least this thick against the part's longest edge, so that colours show.
const THINNEST_SHARE: f64 = 0.0035;
/// A planned axis is drawn this thin against its bead.
const LINE_SHARE: f64 = 0.14;
/// Below this the colours are told in micrometres, m.
const FINE_M: f64 = 5e-5;

/// Unit that the colours are told in.
#[derive(Clone, Copy)]
pub(super) struct Unit {
    pub(super) name: &'static str,
    pub(super) per_m: f64,
}

impl Unit {
    /// Millimetres, or micrometres where the most is little.
    pub(super) fn of(most_m: f64) -> Self {
        if most_m < FINE_M {
            Self { name: "µm", per_m: 1e6 }
        } else {
            Self { name: "mm", per_m: 1e3 }
        }
    }

    /// Three digits.
    pub(super) fn text(self, length_m: f64) -> String {
        let value = length_m * self.per_m;
        let digits = if value > 0.0 { (2.0 - value.log10().floor()).clamp(0.0, 6.0) } else { 0.0 };
        format!("{value:.*} {}", digits as usize, self.name)
    }
}

/// Up to three stages of the growing frame: planned axes as thin lines, members where gravity and the order of printing
/// bring them, displacement times a round factor, coloured by displacement.
///
/// `None` where nothing moves or nothing was solved.
pub fn deformed(preflight: &Preflight) -> Option<Row> {
    let growth = &preflight.growth;
    let shown = &growth.shown.stages;
    let nodes_m = shown.iter().map(|stage| largest(stage).1);
    let most_m =
        shown.iter().map(|stage| between_m(growth, stage)).chain(nodes_m).fold(0.0, f64::max);
    let size_m = Bounds::of(growth.built.frame.nodes().iter().copied())?.size().max();
    if !(most_m > 0.0 && most_m.is_finite()) {
        return None;
    }
    let factor = round_factor(DRAWN_SHARE * size_m / most_m);
    let unit = Unit::of(most_m);
    let limit_m = preflight.job.limits.node_miss_m;
    let thinnest_m = THINNEST_SHARE * size_m;
    let drawing = Drawing { preflight, factor, unit, most_m, thinnest_m };
    let mut scenes: Vec<Scene> = shown.iter().map(|stage| drawing.scene(stage)).collect();
    share_bounds(&mut scenes);
    let mut notes = vec![
        format!("shape: displacement\u{a0}×\u{a0}{}", grouped(factor)),
        "thin lines: as planned".to_owned(),
        "weight alone, each strand born free of stress on the frame as it then stands (staged)"
            .to_owned(),
        "between nodes: as the ends of a member turn, without its own sag".to_owned(),
    ];
    if growth.built.frame.members().iter().any(|member| member.section.fibre_m < thinnest_m) {
        notes.push("strands are drawn thicker than they are".to_owned());
    }
    if limit_m > most_m {
        let limit = Unit::of(limit_m).text(limit_m);
        notes.insert(0, format!("limit of a node's miss {limit}, beyond the scale"));
    }
    Some(Row {
        title: format!(
            "{} – frame under its weight, staged, displacement × {}",
            preflight.job.name,
            grouped(factor)
        ),
        scenes,
        notes,
        stamp: None,
    })
}

/// Node and length of the largest translation of a stage.
fn largest(stage: &ShownStage) -> (usize, f64) {
    let length = |u: &[f64; 6]| Vector::new(u[0], u[1], u[2]).norm();
    let all = stage.staged.iter().map(length).enumerate().filter(|(_, length)| length.is_finite());
    all.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
}

/// Largest displacement along the members of a stage, as they are drawn.
fn between_m(growth: &Growth, stage: &ShownStage) -> f64 {
    let nodes = growth.built.frame.nodes();
    let members = growth.built.frame.members().iter().take(stage.born);
    let curve = |ends: [usize; 2]| {
        let (places, moved) = (ends.map(|node| nodes[node]), ends.map(|node| stage.staged[node]));
        (1..2 * PIECES_OF_MEMBER).map(move |k| {
            displacement_along(places, moved, k as f64 / (2 * PIECES_OF_MEMBER) as f64).norm()
        })
    };
    members
        .filter(|member| member.density_kg_m3 > 0.0)
        .flat_map(|member| curve(member.ends))
        .filter(|length| length.is_finite())
        .fold(0.0, f64::max)
}

/// Digits in groups of three, with spaces that no line breaks at.
fn grouped(factor: u64) -> String {
    let digits = factor.to_string();
    let mut text = String::with_capacity(2 * digits.len());
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push('\u{a0}');
        }
        text.push(digit);
    }
    text
}

/// The largest of 1, 2, 5, 10 … that is not above; 1 at the least.
pub(super) fn round_factor(most: f64) -> u64 {
    let decades = (0..15).flat_map(|k| [1, 2, 5].map(|digit| digit * 10u64.pow(k)));
    decades.take_while(|&factor| factor as f64 <= most).last().unwrap_or(1)
}

struct Drawing<'a> {
    preflight: &'a Preflight,
    factor: u64,
    unit: Unit,
    most_m: f64,
    thinnest_m: f64,
}

impl Drawing<'_> {
    fn scene(&self, stage: &ShownStage) -> Scene {
        let Self { preflight, unit, .. } = *self;
        let growth = &preflight.growth;
        let bed_from_part = preflight.job.bed_from_part;
        let told = &growth.stages[stage.stage];
        let (node, largest_m) = largest(stage);
        let mut strands = planned(preflight, told.printed);
        strands.extend(self.members(stage));
        let at = growth.built.frame.nodes()[node] + self.drawn(&stage.staged[node]);
        let label = format!("node {node}: {}", unit.text(largest_m));
        let mark = Mark { at: bed_from_part * at, label, severity: MarkSeverity::Note };
        let one_shot = told.one_shot_m.map_or_else(String::new, |m| unit.text(m));
        let used = told.member.map_or_else(String::new, |used| share_text(used.share.nominal));
        Scene {
            bodies: forms(preflight, stage.stage),
            strands,
            planned: Vec::new(),
            bed: bed(preflight),
            title: format!(
                "{}\nnodes {}, between them {}\none-shot {one_shot}{used}",
                caption(preflight, stage.stage),
                unit.text(largest_m),
                unit.text(between_m(growth, stage))
            ),
            marks: if largest_m > 0.0 { vec![mark] } else { Vec::new() },
            colour: Some(ColourScale {
                title: "displacement, staged".to_owned(),
                unit: unit.name.to_owned(),
                low: 0.0,
                high: self.most_m * unit.per_m,
                limit: Some(preflight.job.limits.node_miss_m * unit.per_m),
            }),
            part_bounds: None,
        }
    }

    fn drawn(&self, u: &[f64; 6]) -> Vector {
        Vector::new(u[0], u[1], u[2]) * self.factor as f64
    }

    /// Members in pieces, each in the colour of its middle.
    fn members(&self, stage: &ShownStage) -> Vec<StrandShape> {
        let Growth { built, .. } = &self.preflight.growth;
        let bed_from_part = self.preflight.job.bed_from_part;
        let pieces = (PIECES_MAX / stage.born.max(1)).clamp(1, PIECES_OF_MEMBER);
        let nodes = built.frame.nodes();
        let mut shapes = Vec::with_capacity(stage.born * pieces);
        for member in built.frame.members().iter().take(stage.born) {
            if member.density_kg_m3 <= 0.0 {
                continue; // a link has no bead
            }
            let ends = member.ends.map(|node| nodes[node]);
            let moved = member.ends.map(|node| stage.staged[node]);
            let place = |k: usize| {
                let share = k as f64 / pieces as f64;
                let u = displacement_along(ends, moved, share);
                bed_from_part * (ends[0] + (ends[1] - ends[0]) * share + u * self.factor as f64)
            };
            shapes.extend((0..pieces).map(|k| {
                let middle = displacement_along(ends, moved, (k as f64 + 0.5) / pieces as f64);
                StrandShape {
                    points: vec![place(k), place(k + 1)],
                    radius_m: member.section.fibre_m.max(self.thinnest_m),
                    value: Some(middle.norm() * self.unit.per_m),
                    highlighted: false,
                }
            }));
        }
        shapes
    }
}

/// Axes as planned of the first strands, as thin lines in bed axes.
fn planned(preflight: &Preflight, printed: usize) -> Vec<StrandShape> {
    let strands = preflight.deposit.strands.iter().take(printed);
    let line = |strand: &crate::deposit::Printed| StrandShape {
        points: strand.as_planned.iter().map(|p| preflight.job.bed_from_part * p).collect(),
        radius_m: strand.radius_m * LINE_SHARE,
        value: None,
        highlighted: false,
    };
    strands.map(line).collect()
}

/// ", 3.2 % of strength used"
fn share_text(used: f64) -> String {
    match used * 100.0 {
        percent if percent < 0.01 => ", under 0.01 % of strength used".to_owned(),
        percent if percent < 10.0 => format!(", {percent:.2} % of strength used"),
        percent => format!(", {percent:.0} % of strength used"),
    }
}

/// "after 3 of 12 strands", and what was released.
pub(super) fn caption(preflight: &Preflight, stage: usize) -> String {
    let told = &preflight.growth.stages[stage];
    let of = preflight.job.strands.len();
    let released = told.released.and_then(|form| preflight.job.forms.get(form));
    let released = released.map_or_else(String::new, |form| format!(", `{}` released", form.id));
    format!("after {} of {}{released}", told.printed, counted(of, "strand"))
}

/// Forms that still hold at a stage, in bed axes.
pub(super) fn forms(preflight: &Preflight, stage: usize) -> Vec<Body> {
    standing(preflight, stage)
        .map(|form| Body {
            name: form.id.clone(),
            kind: BodyKind::Form,
            pose: preflight.job.bed_from_part,
            shape: Shape::Mesh {
                vertices: form.vertices.clone(),
                triangles: form.triangles.clone(),
            },
            highlighted: false,
        })
        .collect()
}

/// The same, as the job has them.
pub(super) fn standing(
    preflight: &Preflight,
    stage: usize,
) -> impl Iterator<Item = &crate::cell::Form> {
    let stages = &preflight.growth.stages[..=stage];
    let gone = move |form: &usize| stages.iter().any(|stage| stage.released == Some(*form));
    preflight.job.forms.iter().enumerate().filter(move |(form, _)| !gone(form)).map(|(_, f)| f)
}

/// The plate, in its own axes.
pub(super) fn bed(preflight: &Preflight) -> Option<BedShape> {
    let [x, y, ..] = preflight.job.cell.bed.size_m;
    Some(BedShape { pose: Pose::identity(), size_m: [x, y] })
}

/// Shows the same box in every scene.
fn share_bounds(scenes: &mut [Scene]) {
    let parts: Vec<Bounds> = scenes.iter().filter_map(Scene::part).collect();
    let all = Bounds::of(parts.iter().flat_map(|part| [part.min, part.max]));
    scenes.iter_mut().for_each(|scene| scene.part_bounds = all);
}
