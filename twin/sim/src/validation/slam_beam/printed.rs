//! The two beams as a 3-axis printer lays them: from stress lines, and as a Vierendeel grid.
//!
//! Numbers of the paper are Tam & Mueller 2017, implementation 1; what it does not print is ours.

use crate::structure::{Bead, Bundle, bundle};

use super::field::{Field, Grid, plate};
use super::lines::{Family, Region, distance, trace};
use super::net::{Line, Net, Part, net};

/// Span, "the maximum printable span".
pub(super) const SPAN_M: f64 = 0.150;
/// Length and height of the bounding box (table 2).
const BOX_M: [f64; 2] = [0.1519, 0.0376];
/// Width, out of plane.
const WIDTH_M: f64 = 0.0305;
/// Mass of SLAM-XY (table 4).
pub(super) const MASS_KG: f64 = 0.0465;
/// Platform under the load and over each support: not printed; as in our reference's quick model.
pub(super) const PLATFORM_M: f64 = 0.012;
/// Layer of the printer with its usual tip (0.010 in; general knowledge, the paper has none).
const LAYER_M: f64 = 0.254e-3;
/// Roads across the enclosure: the box is longer than the span by its thickness, 1.9 mm, which is
/// four roads of the half millimetre this printer lays (general knowledge).
const ENCLOSURE_ROADS: usize = 4;
/// Cells of the plate over its height, and along it for every cell over the height.
const CELLS_HIGH: usize = 24;
const CELLS_LONG: usize = 4;
/// Step of a line over the cell it crosses; the reference asks for a third at most.
const STEP: f64 = 0.25;
/// Seeds per family, at most.
const SEEDS_MOST: usize = 64;

/// Thickness of the enclosure: by how much the box is longer than the span between its axes.
pub(super) fn enclosure_m() -> f64 {
    BOX_M[0] - SPAN_M
}

/// Width of one road.
pub(super) fn road_m() -> f64 {
    enclosure_m() / ENCLOSURE_ROADS as f64
}

/// Layers over the width of the beam.
pub(super) fn layers() -> usize {
    (WIDTH_M / LAYER_M).round() as usize
}

/// Axes of the enclosure: from the origin to span and depth.
pub(super) fn axes() -> Region {
    Region { low_m: [0.0; 2], high_m: [SPAN_M, BOX_M[1] - enclosure_m()] }
}

/// A wall of roads side by side and layers on each other, as one section: y across in the plane of
/// the beam, z through its layers. Roads bond as one ("solid" fill) or slip; `None` never for these
/// sizes.
pub(super) fn wall(roads: usize, layers: usize, road_m: f64, bond: f64) -> Option<Bundle> {
    let at = |k: usize, pitch: f64| k as f64 * pitch;
    let bead =
        |road, layer| Bead::flattened(road_m, LAYER_M, [at(road, road_m), at(layer, LAYER_M)]);
    let beads: Vec<Bead> =
        (0..roads).flat_map(|road| (0..layers).map(move |layer| bead(road, layer))).collect();
    bundle(&beads, bond).ok()
}

/// A beam ready to be loaded.
#[derive(Debug, Clone)]
pub(super) struct Printed {
    pub(super) net: Net,
    /// Bars of the two families: every second layer each.
    pub(super) inner: Bundle,
    /// Thickness of these in the plane, m.
    pub(super) inner_m: f64,
    pub(super) enclosure: Bundle,
    /// Seeds of a family, or cells over the height of a grid.
    pub(super) count: usize,
}

impl Printed {
    pub(super) fn bundle(&self, part: Part) -> &Bundle {
        if part == Part::Enclosure { &self.enclosure } else { &self.inner }
    }

    /// Volume of the beads, m³.
    pub(super) fn volume_m3(&self) -> f64 {
        let enclosure_m = self.net.total_m(|part| part == Part::Enclosure);
        let inner_m = self.net.total_m(|part| part != Part::Enclosure);
        enclosure_m * self.enclosure.section.area_m2 + inner_m * self.inner.section.area_m2
    }
}

/// Stress in the box, whole: carried at its lower corners, pushed in the middle of its top.
pub(super) fn stress(poisson: f64) -> Option<Field> {
    let size_m = axes().high_m;
    let along = (CELLS_LONG * CELLS_HIGH) as f64;
    let grid = Grid { size_m, cells: [along as usize, CELLS_HIGH] };
    let mut forces = vec![0.0; grid.freedoms()];
    let (half, middle) = (PLATFORM_M / 2.0, SPAN_M / 2.0);
    let patches = [
        (CELLS_HIGH, middle - half..middle + half, -1.0),
        // of a platform on the end post's axis, the half on the beam
        (0, 0.0..half, 0.5),
        (0, SPAN_M - half..SPAN_M, 0.5),
    ];
    for (row, over_m, total) in patches {
        for (node, load) in grid.spread(row, over_m) {
            forces[2 * node + 1] += total * load;
        }
    }
    // in balance by itself: held where nothing pulls
    let held = [2 * grid.node(0, 0), 2 * grid.node(0, 0) + 1, 2 * grid.node(grid.cells[0], 0) + 1];
    plate(grid, poisson, &forces, &held)
}

/// The beam of stress lines: bars of whole roads, and as many lines as come nearest to the mass.
pub(super) fn from_lines(
    stress: &Field,
    roads: usize,
    density_kg_m3: f64,
    bond: f64,
) -> Option<Printed> {
    let of = |count: usize| from_seeds(stress, roads, count, bond);
    let mass_kg = |printed: &Printed| printed.volume_m3() * density_kg_m3;
    let (mut few, mut many) = (of(2)?, of(4)?);
    while mass_kg(&many) <= MASS_KG && many.count < SEEDS_MOST {
        let more = of(2 * many.count)?;
        few = std::mem::replace(&mut many, more);
    }
    while many.count - few.count > 2 {
        let middle = of((few.count + many.count) / 4 * 2)?;
        if mass_kg(&middle) <= MASS_KG {
            few = middle;
        } else {
            many = middle;
        }
    }
    let off = |printed: &Printed| (mass_kg(printed) - MASS_KG).abs();
    Some(if off(&few) <= off(&many) { few } else { many })
}

/// A beam of stress lines from so many seeds of each family.
///
/// Lines of both families start at mid-depth, evenly along the span, an even number since the axis of
/// symmetry has a place without directions, and end where they touch the enclosure. A seed nearer
/// than a bar's thickness to a line of its family starts none: a line that dips through mid-depth
/// twice is met by two seeds.
pub(super) fn from_seeds(stress: &Field, roads: usize, count: usize, bond: f64) -> Option<Printed> {
    let inner_m = roads as f64 * road_m();
    Some(Printed {
        net: net_of_lines(&seeded(stress, count, inner_m), inner_m),
        inner: wall(roads, layers() / 2, road_m(), bond)?,
        inner_m,
        enclosure: wall(ENCLOSURE_ROADS, layers(), road_m(), bond)?,
        count,
    })
}

fn net_of_lines(lines: &[Line], inner_m: f64) -> Net {
    let Region { high_m: [length, depth], .. } = axes();
    let half = PLATFORM_M / 2.0;
    let middle = length / 2.0;
    let marks = [
        [0.0, 0.0],
        [length, 0.0],
        [0.0, depth],
        [length, depth],
        [middle - half, depth],
        [middle, depth],
        [middle + half, depth],
    ];
    net(lines, &axes(), &marks, touch_m(inner_m), inner_m)
}

/// From the axis of the enclosure to that of a bar that touches it.
fn touch_m(inner_m: f64) -> f64 {
    (enclosure_m() + inner_m) / 2.0
}

fn seeded(stress: &Field, count: usize, inner_m: f64) -> Vec<Line> {
    let axes = axes();
    let touch_m = touch_m(inner_m);
    let region = Region {
        low_m: axes.low_m.map(|low| low + touch_m),
        high_m: axes.high_m.map(|high| high - touch_m),
    };
    let step_m = STEP * axes.high_m[1] / CELLS_HIGH as f64;
    let tensor = |at: [f64; 2]| stress.stress(at);
    let mut lines: Vec<Line> = Vec::new();
    for family in [Family::Larger, Family::Smaller] {
        for seed in 0..count {
            let x = (seed as f64 + 0.5) / count as f64 * axes.high_m[0];
            let from = [x, axes.high_m[1] / 2.0];
            let near = |line: &&Line| line.family == family && passes(line, from, inner_m);
            if lines.iter().any(|line| near(&line)) {
                continue;
            }
            let points = trace(&tensor, &region, from, family, step_m);
            if points.len() > 1 {
                lines.push(Line { family, points });
            }
        }
    }
    lines
}

/// Whether a line comes nearer to a place than some distance.
fn passes(line: &Line, at: [f64; 2], within_m: f64) -> bool {
    line.points.iter().any(|to| distance(*to, at) < within_m)
}

/// The Vierendeel grid of the same mass: square openings as nearly as whole cells allow, the
/// number of them that needs bars nearest to `roads` roads, these then made as wide as the mass asks
/// (the paper's grid was calibrated in width and density to equal volume and weight too). Along in
/// every second layer, upright in the others.
pub(super) fn from_grid(volume_m3: f64, roads: usize, bond: f64) -> Option<Printed> {
    let enclosure = wall(ENCLOSURE_ROADS, layers(), road_m(), bond)?;
    let full = wall(roads, layers() / 2, road_m(), bond)?;
    let [length, depth] = axes().high_m;
    let enclosure_m3 = 2.0 * (length + depth) * enclosure.section.area_m2;
    let of = |rows: usize| {
        let inner_m = (rows - 1) as f64 * length + (columns(rows) - 1) as f64 * depth;
        let area_m2 = (volume_m3 - enclosure_m3) / inner_m;
        // the area of a bead grows by its height for every width
        let more_m2 = (area_m2 - full.section.area_m2) / (roads * (layers() / 2)) as f64;
        (rows, road_m() + more_m2 / LAYER_M)
    };
    let off = |road: f64| (road / road_m() - 1.0).abs();
    let candidates = (2..=SEEDS_MOST / 2).map(of);
    let (rows, road_m) = candidates.min_by(|a, b| off(a.1).total_cmp(&off(b.1)))?;
    let inner = wall(roads, layers() / 2, road_m, bond)?;
    let inner_m = roads as f64 * road_m;
    Some(Printed { net: net_of_grid(rows), inner, inner_m, enclosure, count: rows })
}

/// Cells along the span, nearly square; an even number, so that there is an upright under the load.
fn columns(rows: usize) -> usize {
    let [length, depth] = axes().high_m;
    2 * (rows as f64 * length / depth / 2.0).round() as usize
}

fn net_of_grid(rows: usize) -> Net {
    let [length, depth] = axes().high_m;
    let across = |k: usize, count: usize, size: f64| k as f64 / count as f64 * size;
    let along = |row| {
        let y = across(row, rows, depth);
        Line { family: Family::Larger, points: vec![[0.0, y], [length, y]] }
    };
    let upright = |column| {
        let x = across(column, columns(rows), length);
        Line { family: Family::Smaller, points: vec![[x, 0.0], [x, depth]] }
    };
    let lines: Vec<Line> = (1..rows).map(along).chain((1..columns(rows)).map(upright)).collect();
    // nothing is near anything else: joints are as small as rounding needs
    net_of_lines(&lines, 1e-6)
}
