//! The parts of a document that every planner fills in alike.

use slam::document::{
    Document, End, Environment, Flow, Follow, Limits, Orientation, Placement, Process, Strand,
    Triple,
};
use slam::{Span, Spanned};

use crate::Options;

/// A value that stands in no text.
pub(crate) fn unplaced<T>(value: T) -> Spanned<T> {
    Spanned::new(value, Span::default())
}

/// A job of these strands in this order, everything the options do not say left to the cell.
pub(crate) fn document(
    options: &Options,
    placement: Placement,
    diameter_mm: Option<f64>,
    follow: Option<Follow>,
    strands: Vec<Strand>,
) -> Document {
    Document {
        name: unplaced(options.name.clone()),
        cell: unplaced(options.cell.clone()),
        material: unplaced(options.material.clone()),
        placement,
        environment: Environment::default(),
        forms: Vec::new(),
        process: Process {
            speed_mm_s: Some(unplaced(options.speed_mm_s)),
            flow: diameter_mm.map(|diameter| unplaced(Flow::DiameterMm(diameter))),
            orientation: Orientation { follow: follow.map(unplaced), ..Orientation::default() },
            ..Process::default()
        },
        strands,
        sequence: None,
        loads: Vec::new(),
        limits: Limits::default(),
        allow: Vec::new(),
    }
}

/// A strand that says nothing but its points.
pub(crate) fn strand(id: String, points_mm: Vec<Triple>) -> Strand {
    Strand {
        id: unplaced(id),
        span: Span::default(),
        points_mm,
        directions: None,
        joints: None,
        times_s: None,
        on: None,
        start: End::default(),
        end: End::default(),
        profile: Vec::new(),
        events: Vec::new(),
        process: Process::default(),
    }
}
