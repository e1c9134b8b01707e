//! One instant of a film as a scene that can be drawn.

use super::{Film, FilmFinding, FilmStrand, Frame, Quantity};
use crate::pose::{Point, Pose};
use crate::scene::{BedShape, Body, Bounds, Mark, MarkSeverity, Scene, StrandShape};

/// Findings marked in a picture; more would hide the part.
const MARKS_MAX: usize = 6;
/// Radius of the rod from where a thing should be to where it is, against the thinnest strand's.
const MISS_SHARE: f64 = 0.5;
/// Radius of the line that stands for a strand not printed yet, against its bead.
const PLANNED_SHARE: f64 = 0.16;
/// Neighbouring segments whose values differ by less than this share of the scale are drawn as one.
const SAME_SHARE: f64 = 1.0 / 128.0;

/// What of a film a scene shows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Look {
    /// What the strands are coloured by; grey where absent or not known.
    pub colour: Option<Quantity>,
    /// Thin clear lines where strands are still to come.
    pub planned: bool,
    /// Marks at the worst findings, as far as they lie before the frame's time or have none.
    pub marks: bool,
    /// This finding alone is marked, with its numbers, and its bodies and strand stand out.
    pub finding: Option<usize>,
}

impl Film {
    /// What there is to see at a frame. O(n) in points.
    pub fn scene(&self, frame: &Frame, look: &Look) -> Scene {
        let painted = self.painted_by(look.colour);
        let world_from_part = frame.world_from_mover[self.part];
        let finding = look.finding.and_then(|index| self.findings.get(index));
        let mut strands = Vec::new();
        let mut planned = Vec::new();
        for (order, strand) in self.strands.iter().enumerate() {
            let highlighted = finding.is_some_and(|finding| {
                finding.strand == Some(order) || finding.bodies.contains(&strand.id)
            });
            let seen =
                SeenStrand { strand, order, time_s: frame.time_s, world_from_part, highlighted };
            seen.printed(painted.map(|p| (p.quantity, p.scale.high - p.scale.low)), &mut strands);
            if look.planned {
                planned.extend(seen.to_come());
            }
        }
        strands.extend(finding.and_then(|it| self.miss(it, &world_from_part)));
        let marks = match finding {
            Some(finding) => self.marks_of(finding, frame),
            None if look.marks => self.marks(frame),
            None => Vec::new(),
        };
        Scene {
            bodies: self.bodies_at(frame, finding.map_or(&[][..], |finding| &finding.bodies)),
            strands,
            planned,
            bed: Some(BedShape { pose: frame.world_from_mover[self.bed], size_m: self.bed_size_m }),
            title: format!("{} – {}", self.job, self.cell),
            marks,
            colour: painted.map(|painted| painted.scale.clone()),
            part_bounds: self.part_bounds(&world_from_part),
        }
    }

    fn bodies_at(&self, frame: &Frame, named: &[String]) -> Vec<Body> {
        let there = self
            .bodies
            .iter()
            .filter(|body| body.gone_s.is_none_or(|gone_s| frame.time_s < gone_s));
        let each = there.flat_map(|body| {
            let pose = frame.world_from_mover[body.mover] * body.mover_from_body;
            body.shapes.iter().map(move |shape| Body {
                name: body.name.clone(),
                kind: body.kind,
                pose,
                shape: shape.clone(),
                highlighted: named.contains(&body.name),
            })
        });
        each.collect()
    }

    /// Box about the part once all is printed, so that every frame is drawn at one scale.
    fn part_bounds(&self, world_from_part: &Pose) -> Option<Bounds> {
        let skin = self.strands.iter().map(|strand| strand.radius_m).fold(0.0, f64::max);
        let points = self.strands.iter().flat_map(|strand| &strand.points);
        let bounds = Bounds::of(points.map(|point| world_from_part * point))?;
        let skin = crate::pose::Vector::repeat(skin);
        Some(Bounds { min: bounds.min - skin, max: bounds.max + skin })
    }

    /// A rod from where something should be to where it is instead.
    fn miss(&self, finding: &FilmFinding, world_from_part: &Pose) -> Option<StrandShape> {
        let (at, found) = (finding.at?, finding.found?);
        let thinnest_m = self.strands.iter().map(|it| it.radius_m).fold(f64::INFINITY, f64::min);
        Some(StrandShape {
            points: [at, found].iter().map(|point| world_from_part * point).collect(),
            radius_m: MISS_SHARE * thinnest_m,
            value: None,
            highlighted: true,
        })
    }

    /// The place with its numbers, where what should be there is instead, and the name of an earlier strand where that is one
    /// of the two bodies.
    fn marks_of(&self, finding: &FilmFinding, frame: &Frame) -> Vec<Mark> {
        let Some(at) = finding.at else { return Vec::new() };
        let world_from_part = frame.world_from_mover[self.part];
        let label = format!("{} {}", finding.code, finding.words);
        let place = Mark { at: world_from_part * at, label, severity: finding.severity };
        let others = self.strands.iter().enumerate().filter(|(order, strand)| {
            finding.strand != Some(*order) && finding.bodies.contains(&strand.id)
        });
        let named = others.filter_map(|(_, strand)| {
            let off = |point: &&Point| (*point - at).norm();
            let near = strand.points.iter().min_by(|a, b| off(a).total_cmp(&off(b)))?;
            let (at, label) = (world_from_part * near, strand.id.clone());
            Some(Mark { at, label, severity: MarkSeverity::Note })
        });
        let found = finding.found.map(|found| {
            let at = world_from_part * found;
            Mark { at, label: "is here by then".to_owned(), severity: MarkSeverity::Note }
        });
        std::iter::once(place).chain(found).chain(named).collect()
    }

    /// The worst findings, as far as they are seen by now.
    fn marks(&self, frame: &Frame) -> Vec<Mark> {
        let done_s = self.strands.iter().filter_map(FilmStrand::done_s).fold(0.0, f64::max);
        let all_printed = frame.time_s >= done_s;
        let mut marks: Vec<Mark> = Vec::new();
        let seen = |it: &FilmFinding| {
            it.shown_on_part
                && (all_printed || it.time_s.is_none_or(|time_s| time_s <= frame.time_s))
        };
        for index in self.one_of_each_code_first(seen) {
            let finding = &self.findings[index];
            let Some(at) = finding.at.map(|at| frame.world_from_mover[self.part] * at) else {
                continue;
            };
            if marks.len() < MARKS_MAX && marks.iter().all(|mark| (mark.at - at).norm() > 1e-3) {
                marks.push(Mark { at, label: finding.code.to_owned(), severity: finding.severity });
            }
        }
        marks
    }
}

struct SeenStrand<'a> {
    strand: &'a FilmStrand,
    order: usize,
    time_s: f64,
    world_from_part: Pose,
    highlighted: bool,
}

impl SeenStrand<'_> {
    /// What lies there by now: runs of segments of one colour.
    fn printed(&self, colour: Option<(Quantity, f64)>, out: &mut Vec<StrandShape>) {
        let (laid, part) = self.strand.laid(self.time_s);
        let points = &self.strand.points;
        let segments = laid.saturating_sub(1) + usize::from(part.is_some());
        let mut run: Option<StrandShape> = None;
        for k in 0..segments {
            let to = match part {
                Some(share) if k + 1 == laid => points[k] + (points[k + 1] - points[k]) * share,
                _ => points[k + 1],
            };
            let value = colour.and_then(|(quantity, _)| {
                let value = self.strand.value(self.order, k, quantity, self.time_s)?;
                Some(quantity.on_screen(value))
            });
            let near = SAME_SHARE * colour.map_or(0.0, |(_, span)| span);
            let same = |run: &StrandShape| match (run.value, value) {
                (Some(a), Some(b)) => (a - b).abs() <= near,
                (a, b) => a.is_none() && b.is_none(),
            };
            match run.as_mut().filter(|run| same(run)) {
                Some(run) => run.points.push(self.world_from_part * to),
                None => {
                    out.extend(run.take());
                    run = Some(self.shape(vec![points[k], to], value));
                }
            }
        }
        out.extend(run);
    }

    fn shape(&self, points: Vec<Point>, value: Option<f64>) -> StrandShape {
        StrandShape {
            points: points.iter().map(|point| self.world_from_part * point).collect(),
            radius_m: self.strand.radius_m,
            value,
            highlighted: self.highlighted,
        }
    }

    /// What is still to come, as planned.
    fn to_come(&self) -> Option<StrandShape> {
        let (laid, part) = self.strand.laid(self.time_s);
        let planned = &self.strand.planned;
        if laid >= planned.len() {
            return None;
        }
        let first = match (laid.checked_sub(1), part) {
            (Some(k), Some(share)) => Some(planned[k] + (planned[k + 1] - planned[k]) * share),
            (Some(k), None) => Some(planned[k]),
            (None, _) => None,
        };
        let points = first.into_iter().chain(planned[laid..].iter().copied()).collect();
        let radius_m = self.strand.radius_m * PLANNED_SHARE;
        Some(StrandShape { radius_m, highlighted: false, ..self.shape(points, None) })
    }
}
