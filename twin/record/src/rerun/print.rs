//! The part: what is laid and when, what was planned, and where the findings are.

use super::FindingWords;
use super::cell::colour;
use super::tape::{Tape, path};
use crate::RecordError;
use crate::paint::{self, Rgb};
use rerun::{Arrows3D, Color, LineStrip3D, LineStrips3D, Points3D, Radius};
use sim::film::{Film, FilmFinding, FilmStrand};
use sim::pose::{Point, is_finite_point};
use std::collections::BTreeMap;

/// Pieces that the strands are laid in; each is an entity, and a viewer asks every entity for every picture.
const PIECES: usize = 240;
/// Up to so many strands each has entities of its own, named by its id.
const NAMED_MAX: usize = 300;
/// Findings shown in space, and those among them that bear a label without being pointed at.
const PLACES_MAX: usize = 400;
const LABELS_MAX: usize = 6;
/// Characters of a label.
const LABEL_MAX: usize = 120;

/// A run of segments of one colour.
struct Strip {
    points: Vec<[f64; 3]>,
    rgb: Rgb,
    radius_m: f64,
    strand: usize,
}

/// The strands as they are laid, each piece told once. How many pieces.
pub(super) fn strands(tape: &Tape, film: &Film) -> Result<usize, RecordError> {
    let painted = film.painted.first();
    let way_m: f64 = film.strands.iter().map(length_m).sum();
    let step_m = (way_m / PIECES as f64).max(1e-9);
    let named = film.strands.len() <= NAMED_MAX;
    let mut pieces = 0;
    let mut strips: Vec<Strip> = Vec::new();
    let mut laid_m = 0.0;
    for (order, strand) in film.strands.iter().enumerate() {
        for k in 0..strand.segments() {
            let rgb = paint::segment(film, painted, order, k, film.total_s);
            lay(&mut strips, strand, order, k, rgb);
            laid_m += (strand.points[k + 1] - strand.points[k]).norm();
            let last = k + 1 == strand.segments();
            let all = last && order + 1 == film.strands.len();
            if laid_m >= step_m || (named && last) || all {
                let time_s = strand.time_s.get(k + 1).copied().unwrap_or(0.0);
                pieces += 1;
                piece(tape, film, &std::mem::take(&mut strips), named, pieces, time_s)?;
                laid_m = 0.0;
            }
        }
    }
    // what is left where the last strand has no segments
    if let Some(strip) = strips.last() {
        let time_s = film.strands[strip.strand].done_s().unwrap_or(0.0);
        pieces += 1;
        piece(tape, film, &strips, named, pieces, time_s)?;
    }
    Ok(pieces)
}

/// Adds a segment to the strip it continues, or begins one.
fn lay(strips: &mut Vec<Strip>, strand: &FilmStrand, order: usize, k: usize, rgb: Rgb) {
    let at = |k: usize| xyz(&strand.points[k]);
    match strips.last_mut().filter(|strip| strip.strand == order && strip.rgb == rgb) {
        Some(strip) => strip.points.push(at(k + 1)),
        None => strips.push(Strip {
            points: vec![at(k), at(k + 1)],
            rgb,
            radius_m: strand.radius_m,
            strand: order,
        }),
    }
}

fn piece(
    tape: &Tape,
    film: &Film,
    strips: &[Strip],
    named: bool,
    number: usize,
    time_s: f64,
) -> Result<(), RecordError> {
    let Some(first) = strips.first() else { return Ok(()) };
    let id = |strip: &Strip| short(&film.strands[strip.strand].id);
    let number = format!("{number:04}");
    let at = match named {
        // ids are unique in a job; the number holds pieces of one strand apart
        true => path(["world", "part", "strands", &id(first), &number]),
        false => path(["world", "part", "strands", &number]),
    };
    let lines = strips.iter().map(|strip| LineStrip3D::from_iter(strip.points.iter().copied()));
    let told = LineStrips3D::new(lines)
        .with_radii(strips.iter().map(|strip| Radius::new_scene_units(strip.radius_m as f32)))
        .with_colors(strips.iter().map(|strip| colour(strip.rgb)))
        .with_labels(strips.iter().map(id))
        .with_show_labels(false);
    tape.at(at, time_s, &told)
}

/// The plan, as lines of a width on the screen.
pub(super) fn planned(tape: &Tape, film: &Film) -> Result<(), RecordError> {
    if film.strands.is_empty() {
        return Ok(());
    }
    let line = |strand: &FilmStrand| LineStrip3D::from_iter(strand.planned.iter().map(xyz));
    let lines = LineStrips3D::new(film.strands.iter().map(line))
        .with_radii([Radius::new_ui_points(0.6)])
        .with_colors([Color::from_unmultiplied_rgba(0x6B, 0x75, 0x80, 0xA0)])
        .with_labels(film.strands.iter().map(|strand| short(&strand.id)))
        .with_show_labels(false);
    tape.still(path(["world", "part", "planned"]), &lines)
}

/// Places of findings from their time on. How many, and how many were left out.
pub(super) fn findings(
    tape: &Tape,
    film: &Film,
    words: &[FindingWords<'_>],
) -> Result<(usize, usize), RecordError> {
    let placed = film
        .findings
        .iter()
        .enumerate()
        .filter(|(_, f)| f.at.is_some_and(|at| is_finite_point(&at)));
    let (mut told, mut left_out) = (0, 0);
    let mut of_code: BTreeMap<&str, usize> = BTreeMap::new();
    let arrow_m = arrow_m(film);
    for (index, finding) in placed {
        if told == PLACES_MAX {
            left_out += 1;
            continue;
        }
        told += 1;
        let count = of_code.entry(finding.code).or_default();
        *count += 1;
        let is_labelled = *count == 1 && of_code.len() <= LABELS_MAX;
        let at = path(["world", "part", "findings", finding.code, &format!("{index:04}")]);
        place(tape, at, finding, words.get(index), arrow_m, is_labelled)?;
    }
    Ok((told, left_out))
}

fn place(
    tape: &Tape,
    path: rerun::EntityPath,
    finding: &FilmFinding,
    words: Option<&FindingWords<'_>>,
    arrow_m: f64,
    is_labelled: bool,
) -> Result<(), RecordError> {
    let Some(at) = finding.at.as_ref().map(xyz) else { return Ok(()) };
    let time_s = finding.time_s.unwrap_or(0.0);
    let rgb = paint::severity(finding.severity);
    // the label in the picture is short; the whole message shows where one points
    let label = match (is_labelled, words) {
        (false, Some(words)) => format!("{} {}", words.code, words.message),
        _ => format!("{} {}", finding.code, finding.words),
    };
    let point = Points3D::new([at])
        .with_radii([Radius::new_ui_points(5.0)])
        .with_colors([colour(rgb)])
        .with_labels([short(&label)])
        .with_show_labels(is_labelled);
    tape.at(path.clone(), time_s, &point)?;
    let arrow = Arrows3D::from_vectors([[0.0, 0.0, -arrow_m]])
        .with_origins([[at[0], at[1], at[2] + arrow_m]])
        .with_radii([Radius::new_ui_points(1.5)])
        .with_colors([colour(rgb)]);
    let arrow_path = path.join(&super::tape::path(["arrow"]));
    tape.at(arrow_path, time_s, &arrow)
}

/// Length of the arrows, by the size of the part.
fn arrow_m(film: &Film) -> f64 {
    let points = film.strands.iter().flat_map(|strand| &strand.points).copied();
    sim::scene::Bounds::of(points).map_or(0.01, |bounds| 0.08 * bounds.size().norm().max(0.01))
}

fn length_m(strand: &FilmStrand) -> f64 {
    strand.points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

fn xyz(point: &Point) -> [f64; 3] {
    [point.x, point.y, point.z]
}

fn short(text: &str) -> String {
    text.chars().take(LABEL_MAX).collect()
}
