//! Joint-space plans of peers (pb-construction and its family) to jobs that bring their joint path.
//!
//! Nothing is replanned: every waypoint of a print becomes a row of its strand, every waypoint of a
//! transit a row of a `move` step, so `twin check` says what it thinks of the plan as it stands.

use std::collections::BTreeMap;

use jsonc_parser::ast::Value;
use nalgebra::Vector3;
use slam::document::{Follow, Interpolation, Placement, Process, Step, Strand};
use slam::{Diagnostic, Source, Span};

use crate::document::{document, unplaced};
use crate::frame::{Frame, frame_of};
use crate::json::{array, integer, need, number, object, parse, span, text};
use crate::order::{Directed, elements_by_nodes, sorted};
use crate::placement::place;
use crate::wireframe::{diameter_mm, strands};
use crate::{Input, Options, Planned, Remark, any_error, remarks};

/// Where a joint vector, rad, puts the orifice: place in bed axes, mm. `None`: it is not of this arm.
pub type OrificeOf<'a> = &'a dyn Fn(&[f64]) -> Option<[f64; 3]>;

/// Rows that advance less than this along their element would make a segment of no length, mm.
const LEAST_STEP_MM: f64 = 1e-3;

/// Whether a design is a peer's plan rather than a frame.
pub fn is_peer_plan(source: &Source) -> bool {
    parse(source)
        .is_ok_and(|root| root.as_object().is_some_and(|root| root.get("assembly").is_some()))
}

/// A job from a plan file: `assembly` is a frame, `plan` a list of `print` and `transit` moves with
/// their `waypoints` in rad.
///
/// A row's point is the foot of the orifice on its element: peers print straight lines, and thin
/// their waypoints out in joint space.
///
/// # Errors
///
/// Everything that is wrong with the frame, or with the plan if the frame is sound.
pub fn peer_plan(
    source: &Source,
    options: &Options,
    orifice_of: OrificeOf<'_>,
) -> Result<Planned, Vec<Remark>> {
    let mut diagnostics = Vec::new();
    let planned = read(source, options, orifice_of, &mut diagnostics);
    match planned {
        Ok(document) if !any_error(&diagnostics) => {
            Ok(Planned { document, remarks: remarks(Input::Design, diagnostics) })
        }
        Ok(_) => Err(remarks(Input::Design, diagnostics)),
        Err(fatal) => {
            diagnostics.push(fatal);
            Err(remarks(Input::Design, diagnostics))
        }
    }
}

fn read(
    source: &Source,
    options: &Options,
    orifice_of: OrificeOf<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<slam::Document, Diagnostic> {
    let root = parse(source)?;
    let root = object(&root, "a plan file")?;
    let frame = frame_of(need(root, "assembly")?, diagnostics)?;
    let moves = array(need(root, "plan")?, "`plan`")?;
    let placed = place(&frame, options.bed);
    let mut prints: Vec<(Directed, Vec<Vec<f64>>, Span)> = Vec::new();
    let element_of = elements_by_nodes(&frame);
    let mut sequence = Vec::new();
    for value in moves {
        let rows = waypoints(value)?;
        match text(need(object(value, "a move")?, "mode")?, "`mode`")? {
            "print" => {
                let directed = printed(value, &frame, &element_of)?;
                sequence.push(Step::Strand(format!("e{}", directed.element)));
                prints.push((directed, rows, span(need(object(value, "a move")?, "mode")?)));
            }
            _ => add_move(&mut sequence, rows),
        }
    }
    let order: Vec<Directed> = prints.iter().map(|(directed, ..)| *directed).collect();
    let bead_mm = diameter_mm(&frame, options, diagnostics);
    let plain = strands(&frame, &order, &placed.heights_mm, bead_mm);
    let strands = plain
        .into_iter()
        .zip(prints)
        .map(|(strand, (_, rows, at))| with_rows(strand, rows, at, &placed.placement, orifice_of))
        .collect::<Result<Vec<_>, _>>()?;
    let mut document =
        document(options, placed.placement, bead_mm, Some(Follow::Vertical), strands);
    // Approach and retract are among the peer's own moves.
    document.process = Process {
        approach_mm: Some(unplaced(0.0)),
        retract_mm: Some(unplaced(0.0)),
        interpolation: Some(unplaced(Interpolation::Linear)),
        ..document.process
    };
    document.sequence = Some(sequence.into_iter().map(unplaced).collect());
    Ok(document)
}

/// Joint rows of a move, rad.
fn waypoints(value: &Value) -> Result<Vec<Vec<f64>>, Diagnostic> {
    let list = array(need(object(value, "a move")?, "waypoints")?, "`waypoints`")?;
    list.iter()
        .map(|row| array(row, "a waypoint")?.iter().map(|q| number(q, "a joint value")).collect())
        .collect()
}

/// The element a print move prints, and which way.
fn printed(
    value: &Value,
    frame: &Frame,
    element_of: &BTreeMap<[usize; 2], usize>,
) -> Result<Directed, Diagnostic> {
    let place = object(value, "a move")?;
    let mut ends = [0; 2];
    for (end, key) in ends.iter_mut().zip(["node1", "node2"]) {
        let id = integer(need(place, key)?, "a node")?;
        *end = *frame.node_of_id.get(&id).ok_or_else(|| {
            Diagnostic::error(span(value), format!("node {id} is not in the frame"))
        })?;
    }
    let element = *element_of.get(&sorted(ends)).ok_or_else(|| {
        Diagnostic::error(span(value), "no element of the frame joins these nodes")
    })?;
    Ok(Directed { element, from: ends[0], to: ends[1] })
}

/// Transits that follow each other are one move; a row that repeats the one before is left out.
fn add_move(sequence: &mut Vec<Step>, rows: Vec<Vec<f64>>) {
    let degrees = rows.into_iter().map(|row| row.into_iter().map(f64::to_degrees).collect());
    if let Some(Step::Move(before)) = sequence.last_mut() {
        for row in degrees {
            if before.last() != Some(&row) {
                before.push(row);
            }
        }
    } else {
        sequence.push(Step::Move(degrees.collect()));
    }
}

/// The strand with its joint rows, each with its own point on the element.
fn with_rows(
    strand: Strand,
    rows: Vec<Vec<f64>>,
    at: Span,
    placement: &Placement,
    orifice_of: OrificeOf<'_>,
) -> Result<Strand, Diagnostic> {
    let ends = [&strand.points_mm[0], &strand.points_mm[1]].map(|p| Vector3::from(p.value));
    let along = ends[1] - ends[0];
    let length_mm = along.norm();
    let fault =
        |message: &str| Diagnostic::error(at, format!("strand `{}`: {message}", strand.id.value));
    let mut points = Vec::with_capacity(rows.len());
    for (k, row) in rows.iter().enumerate() {
        let orifice_mm =
            orifice_of(row).ok_or_else(|| fault("a waypoint has not the cell's joints"))?;
        let share = match k {
            0 => 0.0,
            _ if k + 1 == rows.len() => 1.0,
            _ => (part_mm(placement, orifice_mm) - ends[0]).dot(&along) / (length_mm * length_mm),
        };
        points.push(share);
    }
    if points.len() < 2 {
        return Err(fault("a print needs two waypoints"));
    }
    if points.windows(2).any(|pair| !((pair[1] - pair[0]) * length_mm >= LEAST_STEP_MM)) {
        return Err(fault("its waypoints do not advance along the element")
            .hint("is this the cell the plan was made for?"));
    }
    let place = |share: &f64| unplaced((ends[0] + along * *share).into());
    Ok(Strand {
        points_mm: points.iter().map(place).collect(),
        joints: Some(unplaced(
            rows.into_iter().map(|row| row.into_iter().map(f64::to_degrees).collect()).collect(),
        )),
        ..strand
    })
}

/// A place in bed axes as seen in part axes, mm.
fn part_mm(placement: &Placement, bed_mm: [f64; 3]) -> Vector3<f64> {
    let xyz = placement.xyz_mm.as_ref().map_or([0.0; 3], |xyz| xyz.value);
    let [roll, pitch, yaw] =
        placement.rpy_deg.as_ref().map_or([0.0; 3], |rpy| rpy.value).map(f64::to_radians);
    let turn = nalgebra::Rotation3::from_euler_angles(roll, pitch, yaw);
    turn.inverse() * (Vector3::from(bed_mm) - Vector3::from(xyz))
}
