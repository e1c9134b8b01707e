//! Curves in a CSV file to a job of one strand per curve.

use std::collections::BTreeSet;

use slam::document::{Follow, Placement, Strand, Triple};
use slam::{Diagnostic, Source, Span, Spanned};

use crate::document::{document, strand};
use crate::{Input, LARGEST_MM, Options, Planned, Remark, SAME_POINT_MM, any_error, remarks};

const COLUMNS: [&str; 7] = ["strand", "x_mm", "y_mm", "z_mm", "dx", "dy", "dz"];

/// Names that `join` and `on` of a job keep for themselves.
const KEPT_NAMES: [&str; 3] = ["bed", "free", "air"];

/// A job from a CSV file with the header `strand,x_mm,y_mm,z_mm[,dx,dy,dz]` and one point per row.
///
/// Rows of a strand follow each other; the order of strands is the order of printing. Points are in
/// part axes, whose origin is the middle of the bed: the job has no placement. `dx, dy, dz` is the nozzle's axis
/// at the point, pointing out of the nozzle; without them the job leaves the orientation to the cell's defaults.
///
/// # Errors
///
/// Everything that is wrong with the file.
pub fn curves(csv: &Source, options: &Options) -> Result<Planned, Vec<Remark>> {
    let mut diagnostics = Vec::new();
    let mut lines = lines(&csv.text).peekable();
    let strands =
        match lines.next() {
            None => {
                diagnostics.push(Diagnostic::error(Span::default(), "the file is empty").hint(
                    "its first line is strand,x_mm,y_mm,z_mm or strand,x_mm,y_mm,z_mm,dx,dy,dz",
                ));
                Vec::new()
            }
            Some(header) => match width(&header) {
                Ok(width) => strands(lines, width, &mut diagnostics),
                Err(diagnostic) => {
                    diagnostics.push(diagnostic);
                    Vec::new()
                }
            },
        };
    if strands.is_empty() && diagnostics.is_empty() {
        diagnostics.push(Diagnostic::error(Span::default(), "no curve in this file"));
    }
    if any_error(&diagnostics) {
        return Err(remarks(Input::Design, diagnostics));
    }
    let directed = strands.iter().any(|strand| strand.directions.is_some());
    let follow = directed.then_some(Follow::Given);
    let document = document(options, Placement::default(), options.diameter_mm, follow, strands);
    Ok(Planned { document, remarks: remarks(Input::Design, diagnostics) })
}

/// One line: its cells without surrounding blanks, each with its place.
struct Line<'t> {
    cells: Vec<Spanned<&'t str>>,
    span: Span,
}

/// Lines that say something; a byte order mark and blank lines are passed over.
fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    let body = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut at = text.len() - body.len();
    body.split_inclusive('\n').filter_map(move |line| {
        let start = at;
        at += line.len();
        let line = line.trim_end();
        let span = Span { start, end: start + line.len() };
        (!line.trim().is_empty()).then(|| Line { cells: cells(line, start), span })
    })
}

fn cells(line: &str, mut at: usize) -> Vec<Spanned<&str>> {
    let mut cells = Vec::new();
    for raw in line.split(',') {
        let start = at + (raw.len() - raw.trim_start().len());
        let cell = raw.trim();
        cells.push(Spanned::new(cell, Span { start, end: start + cell.len() }));
        at += raw.len() + 1;
    }
    cells
}

/// Number of columns, 4 or 7.
fn width(header: &Line) -> Result<usize, Diagnostic> {
    let width = if header.cells.len() > 4 { 7 } else { 4 };
    for (column, expected) in COLUMNS[..width].iter().enumerate() {
        let Some(cell) = header.cells.get(column) else {
            return Err(Diagnostic::error(header.span, format!("column `{expected}` is missing"))
                .hint(hint_header()));
        };
        if cell.value != *expected {
            let message = format!("column {} is `{}`, not `{expected}`", column + 1, cell.value);
            let diagnostic = Diagnostic::error(cell.span, message);
            let axis = expected.strip_suffix("_mm");
            let other_unit =
                axis.is_some_and(|axis| cell.value.split(['_', ' ']).next() == Some(axis));
            return Err(if other_unit {
                diagnostic.hint(format!("turn the numbers to millimetres and call it `{expected}`"))
            } else {
                diagnostic.hint(hint_header())
            });
        }
    }
    if header.cells.len() > width {
        let cell = &header.cells[width];
        return Err(Diagnostic::error(cell.span, format!("unknown column `{}`", cell.value))
            .hint(hint_header()));
    }
    Ok(width)
}

fn hint_header() -> &'static str {
    "the first line is strand,x_mm,y_mm,z_mm or strand,x_mm,y_mm,z_mm,dx,dy,dz"
}

fn strands<'t>(
    lines: impl Iterator<Item = Line<'t>>,
    width: usize,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Strand> {
    let mut strands: Vec<Strand> = Vec::new();
    let mut seen = BTreeSet::new();
    for line in lines {
        let Some((id, point, direction)) = row(&line, width, diagnostics) else { continue };
        let current = strands.last().is_some_and(|last| last.id.value == id.value);
        if !current {
            if !seen.insert(id.value) {
                let message = format!("strand `{}` goes on here after another one", id.value);
                diagnostics.push(
                    Diagnostic::error(id.span, message).hint("rows of a strand follow each other"),
                );
            }
            let mut new = strand(id.value.to_owned(), Vec::new());
            new.span = id.span;
            new.directions = (width == 7).then(Vec::new);
            strands.push(new);
        }
        let Some(last) = strands.last_mut() else { continue };
        if last.points_mm.last().is_some_and(|before| same(before.value, point.value)) {
            diagnostics
                .push(Diagnostic::error(point.span, "this point is the one before it again"));
        }
        last.points_mm.push(point);
        last.directions.iter_mut().for_each(|all| all.extend(direction));
    }
    // Rows that could not be read may be the points that a strand lacks.
    let all_read = !any_error(diagnostics);
    for strand in &strands {
        if strand.points_mm.len() < 2 && all_read {
            let message = format!("strand `{}` has a single point", strand.id.value);
            diagnostics.push(
                Diagnostic::error(strand.span, message).hint("a strand has two points or more"),
            );
        }
    }
    strands.into_iter().map(without_places).collect()
}

/// Places refer to the job's own text, which does not exist yet.
fn without_places(mut strand: Strand) -> Strand {
    strand.span = Span::default();
    strand.points_mm.iter_mut().for_each(|point| point.span = Span::default());
    strand.directions.iter_mut().flatten().for_each(|direction| direction.span = Span::default());
    strand
}

fn same(a: [f64; 3], b: [f64; 3]) -> bool {
    let square: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    square.sqrt() < SAME_POINT_MM
}

type Row<'t> = (Spanned<&'t str>, Triple, Option<Triple>);

/// One row, or what is wrong with it listed.
fn row<'t>(line: &Line<'t>, width: usize, diagnostics: &mut Vec<Diagnostic>) -> Option<Row<'t>> {
    if line.cells.len() != width {
        let message = format!("{} columns here, {width} in the header", line.cells.len());
        diagnostics.push(Diagnostic::error(line.span, message));
        return None;
    }
    let id = line.cells[0];
    if let Some(message) = bad_name(id.value) {
        diagnostics.push(Diagnostic::error(id.span, message));
        return None;
    }
    let point = triple(&line.cells[1..4], diagnostics);
    let direction = (width == 7).then(|| triple(&line.cells[4..7], diagnostics));
    let (point, direction) = (
        point?,
        match direction {
            None => None,
            Some(direction) => Some(direction?),
        },
    );
    if let Some(direction) = direction
        && same(direction.value, [0.0; 3])
    {
        diagnostics.push(Diagnostic::error(direction.span, "a direction of no length"));
        return None;
    }
    Some((id, point, direction))
}

fn bad_name(id: &str) -> Option<String> {
    if id.is_empty() {
        return Some("a strand without a name".to_owned());
    }
    if id.contains('"') {
        return Some("names stand without quotes".to_owned());
    }
    KEPT_NAMES.contains(&id).then(|| format!("a strand cannot be called `{id}`: jobs use the word"))
}

fn triple(cells: &[Spanned<&str>], diagnostics: &mut Vec<Diagnostic>) -> Option<Triple> {
    let mut value = [0.0; 3];
    let mut fine = true;
    for (slot, cell) in value.iter_mut().zip(cells) {
        match cell.value.parse::<f64>() {
            Ok(number) if number.abs() <= LARGEST_MM => *slot = number,
            Ok(_) => {
                fine = false;
                let message = format!("`{}` is out of range", cell.value);
                diagnostics.push(
                    Diagnostic::error(cell.span, message).hint("at most a kilometre, 1e6 mm"),
                );
            }
            Err(_) => {
                fine = false;
                diagnostics.push(Diagnostic::error(
                    cell.span,
                    format!("`{}` is not a number", cell.value),
                ));
            }
        }
    }
    let span = Span { start: cells.first()?.span.start, end: cells.last()?.span.end };
    fine.then(|| Spanned::new(value, span))
}
