//! Whether a shape of a tool or an obstacle encloses anything.

use super::{Checks, Place, Rule};
use crate::Diagnostic;

/// Shapes thinner than this have no inside, mm.
const THINNEST_MM: f64 = 1e-6;

/// Checks one `shape = { cone = { … } }`.
pub(crate) fn shape(shape: Option<Place<'_>>, checks: &mut Checks) {
    for kind in shape.map(Place::entries).unwrap_or_default() {
        match kind.name() {
            "cone" => cone(kind, checks),
            "capsule" => {
                ends(kind, checks);
                checks.number(kind.get("radius_mm"), Rule::Positive);
            }
            "box" => {
                checks.numbers(kind.get("size_mm"), Rule::Positive);
                checks.numbers(kind.get("xyz_mm"), Rule::Finite);
                checks.numbers(kind.get("rpy_deg"), Rule::Finite);
            }
            "hull" => hull(kind, checks),
            "ring" => ring(kind, checks),
            _ => {}
        }
    }
}

fn ends(kind: Place<'_>, checks: &mut Checks) {
    checks.numbers(kind.get("from_mm"), Rule::Finite);
    checks.numbers(kind.get("to_mm"), Rule::Finite);
}

fn cone(kind: Place<'_>, checks: &mut Checks) {
    ends(kind, checks);
    let radii = ["radius_from_mm", "radius_to_mm"].map(|key| kind.get(key));
    for radius in radii {
        checks.number(radius, Rule::NotNegative);
    }
    if let [Some(from), Some(to)] = radii
        && from.number() == Some(0.0)
        && to.number() == Some(0.0)
    {
        checks.error(from, "both radii of the cone are 0: it is a line".to_owned());
    }
    let [Some(from), Some(to)] = ["from_mm", "to_mm"].map(|key| kind.get(key)) else { return };
    if from.numbers().is_some() && from.numbers() == to.numbers() {
        checks.refuse(
            Diagnostic::error(to.span(), "both faces of the cone are at the same place")
                .hint("`from_mm` and `to_mm` are the centres of its two faces"),
        );
    }
}

fn ring(kind: Place<'_>, checks: &mut Checks) {
    for key in ["radius_mm", "tube_radius_mm"] {
        checks.number(kind.get(key), Rule::Positive);
    }
    checks.number(kind.get("z_mm"), Rule::Finite);
    let [Some(radius), Some(tube)] = ["radius_mm", "tube_radius_mm"].map(|key| kind.get(key))
    else {
        return;
    };
    if let (Some(radius), Some(wide)) = (radius.number(), tube.number())
        && wide >= radius
    {
        checks.error(tube, format!("a tube of radius {wide} closes a ring of radius {radius}"));
    }
}

fn hull(kind: Place<'_>, checks: &mut Checks) {
    let Some(points) = kind.get("points_mm") else { return };
    checks.numbers(Some(points), Rule::Finite);
    let rows: Option<Vec<Vec<f64>>> = points.items().into_iter().map(Place::numbers).collect();
    let Some(rows) = rows else { return };
    if rows.iter().all(|row| row.len() == 3) && !has_inside(&rows) {
        checks.refuse(
            Diagnostic::error(points.span(), "the points of the hull lie in one plane")
                .hint("a hull needs four points or more that are not in one plane"),
        );
    }
}

/// Whether points, each of three numbers, span space: the farthest from the first, from that line,
/// from that plane, in turn.
fn has_inside(points: &[Vec<f64>]) -> bool {
    let Some(origin) = points.first() else { return false };
    let arms: Vec<[f64; 3]> =
        points.iter().map(|point| std::array::from_fn(|axis| point[axis] - origin[axis])).collect();
    let farthest = |measure: &dyn Fn(&[f64; 3]) -> f64| {
        arms.iter().map(|arm| (measure(arm), *arm)).max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let Some((length, along)) = farthest(&|arm| norm(arm)) else { return false };
    let Some((area, across)) = farthest(&|arm| norm(&cross(&along, arm))) else { return false };
    let normal = cross(&along, &across);
    let volume = farthest(&|arm| dot(&normal, arm).abs()).map_or(0.0, |(volume, _)| volume);
    length > THINNEST_MM && area > THINNEST_MM * length && volume > THINNEST_MM * area
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64; 3]) -> f64 {
    dot(a, a).sqrt()
}
