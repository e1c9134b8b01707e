//! The picture's contents: cell, arm and deposit at one moment.

use super::Preflight;
use crate::cell::Mode;
use crate::finding::{Phase, Severity};
use crate::pose::Pose;
use crate::scene::{BedShape, Body, BodyKind, ColourScale, Mark, MarkSeverity, Scene, StrandShape};
use crate::shape::Shape;

/// Findings marked in the picture; more would hide the part.
const MARKS_MAX: usize = 6;

/// The cell with all that is printed at the end of the last strand, strands coloured by the sag
/// behind the nozzle.
pub fn scene(preflight: &Preflight) -> Scene {
    let job = &preflight.job;
    let cell = &job.cell;
    let chain = &cell.robot.arm.chain;
    let printing = preflight
        .motion
        .legs
        .iter()
        .rfind(|leg| leg.phase == Phase::Print && !leg.moments.is_empty());
    let q = printing.and_then(|leg| leg.moments.last()).map(|moment| moment.q.to_vec());
    let q = q.unwrap_or_else(|| cell.home.clone());
    let world_from_tip = chain.forward(&q);
    let world_from_bed = cell.world_from_bed(&world_from_tip);
    let world_from_part = world_from_bed * job.bed_from_part;
    let mut bodies = links(preflight, &q);
    let world_from_tool = cell.world_from_tool(&world_from_tip);
    for part in &cell.tool.parts {
        let kind = if part.nozzle { BodyKind::Nozzle } else { BodyKind::Tool };
        add(&mut bodies, &part.name, kind, world_from_tool, &part.shapes);
    }
    for obstacle in &cell.obstacles {
        add(&mut bodies, &obstacle.name, BodyKind::Obstacle, Pose::identity(), &obstacle.shapes);
    }
    for form in &job.forms {
        let mesh =
            Shape::Mesh { vertices: form.vertices.clone(), triangles: form.triangles.clone() };
        add(&mut bodies, &form.id, BodyKind::Form, world_from_part, &[mesh]);
    }
    let (strands, colour) = strands(preflight, &world_from_part);
    Scene {
        bodies,
        strands,
        bed: Some(BedShape {
            pose: world_from_bed,
            size_m: [cell.bed.size_m[0], cell.bed.size_m[1]],
        }),
        title: format!("{} – {}", job.name, cell.name),
        marks: marks(preflight, &world_from_part),
        colour: Some(colour),
        part_bounds: None,
    }
}

fn links(preflight: &Preflight, q: &[f64]) -> Vec<Body> {
    let robot = &preflight.job.cell.robot;
    let mut carriers = Vec::new();
    robot.arm.chain.link_poses(q, &mut carriers);
    let mut bodies = Vec::new();
    for link in &robot.links {
        let world_from_carrier = link.carrier.map_or_else(Pose::identity, |joint| carriers[joint]);
        let kind = if link.carrier.is_some() || preflight.job.cell.mode == Mode::ToolOnFlange {
            BodyKind::Arm
        } else {
            BodyKind::OtherArm
        };
        add(
            &mut bodies,
            &link.name,
            kind,
            world_from_carrier * link.carrier_from_link,
            &link.shapes,
        );
    }
    bodies
}

fn add(bodies: &mut Vec<Body>, name: &str, kind: BodyKind, pose: Pose, shapes: &[Shape]) {
    bodies.extend(shapes.iter().map(|shape| Body {
        name: name.to_owned(),
        kind,
        pose,
        shape: shape.clone(),
    }));
}

fn strands(preflight: &Preflight, world_from_part: &Pose) -> (Vec<StrandShape>, ColourScale) {
    let limit_m = preflight.job.limits.sag_m;
    let mut high_mm = 0.0f64;
    let shapes = preflight
        .deposit
        .strands
        .iter()
        .zip(&preflight.strands)
        .map(|(printed, result)| {
            let sag_mm = result.outcome.sag_nozzle_m.nominal * 1e3;
            let value = sag_mm.is_finite().then_some(sag_mm);
            high_mm = high_mm.max(value.unwrap_or(0.0));
            StrandShape {
                points: printed.as_printed.iter().map(|point| world_from_part * point).collect(),
                radius_m: printed.radius_m,
                value,
                highlighted: false,
            }
        })
        .collect();
    let colour = ColourScale {
        title: "sag behind the nozzle".to_owned(),
        unit: "mm".to_owned(),
        low: 0.0,
        high: high_mm.clamp(limit_m * 1e2, limit_m * 2e3),
        limit: Some(limit_m * 1e3),
    };
    (shapes, colour)
}

fn marks(preflight: &Preflight, world_from_part: &Pose) -> Vec<Mark> {
    let mut marks: Vec<Mark> = Vec::new();
    let mut codes = Vec::new();
    // One of each code says more than six of the first.
    let (first, more): (Vec<_>, Vec<_>) = preflight.findings.iter().partition(|finding| {
        let is_new = !codes.contains(&finding.code);
        codes.push(finding.code);
        is_new
    });
    for finding in first.into_iter().chain(more) {
        // In transit the place is the nozzle's, far from what the picture shows.
        let shown = finding.site.point.filter(|_| finding.site.phase != Some(Phase::Transit));
        let Some(point) = shown else { continue };
        let at = world_from_part * point;
        if marks.len() < MARKS_MAX && marks.iter().all(|mark| (mark.at - at).norm() > 1e-3) {
            let severity = match finding.severity {
                Severity::Error => MarkSeverity::Error,
                Severity::Warning => MarkSeverity::Warning,
            };
            marks.push(Mark { at, label: finding.code.as_str().to_owned(), severity });
        }
    }
    marks
}
