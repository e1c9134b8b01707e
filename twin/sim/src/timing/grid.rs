//! The path between two rests cut into cells, with what bounds the speed at their ends.

use crate::kinematics::MAX_DOF;

use super::Fault;
use super::course::{Course, Jet, Piece, Section};
use super::limits::Bounds;

/// A cell turns the joint direction by no more than this, roughly, rad.
const CELL_TURN: f64 = 0.05;
/// Most cells of one piece for turning alone.
const TURN_CELLS: f64 = 128.0;
/// A section has at least this many cells.
const SECTION_CELLS: f64 = 96.0;
/// The first and the last cell of a section are halved this often towards the rest: from there the
/// arm speeds up within less than a cell.
const HALVINGS: i32 = 7;
/// Least share of the jerk kept for changing the acceleration where the path itself takes most.
const JERK_LEFT: f64 = 0.05;
/// Share of the jerk that the path itself may take at constant speed.
const JERK_OF_PATH: f64 = 0.95;

/// A linear bound `low ≤ a s̈ + b ṡ² ≤ high`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    pub(super) a: f64,
    pub(super) b: f64,
    pub(super) low: f64,
    pub(super) high: f64,
}

/// The end of a cell.
pub(super) struct Node {
    pub(super) s: f64,
    /// Bounds on acceleration and torque: the first `n_rows`.
    pub(super) rows: [Row; 2 * MAX_DOF],
    pub(super) n_rows: usize,
    /// Largest ds/dt for joint speed alone.
    pub(super) speed: f64,
}

/// A stretch between two nodes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    pub(super) width: f64,
    /// Asked speed.
    pub(super) ceiling: f64,
    /// Largest ds/dt for joint speed in the middle.
    pub(super) speed: f64,
    /// Largest ds/dt for joint jerk at constant speed.
    pub(super) jerk_speed: f64,
    /// Largest |q'|, |q''|, |q'''| over its two ends and middle.
    pub(super) d: [[f64; 3]; MAX_DOF],
}

/// Cells and their ends; one node more than cells.
pub(super) struct Grid {
    pub(super) nodes: Vec<Node>,
    pub(super) cells: Vec<Cell>,
    pub(super) dof: usize,
}

impl Grid {
    /// Cells of a section, divided at `cuts` too.
    pub(super) fn new(
        course: &Course,
        section: Section,
        bounds: &Bounds,
        cuts: &[f64],
    ) -> Result<Self, Fault> {
        let dof = course.dof;
        let mut grid = Self { nodes: Vec::new(), cells: Vec::new(), dof };
        let pieces = &course.pieces[section.first..section.end];
        let Some((first, last)) = pieces.first().zip(pieces.last()) else { return Ok(grid) };
        let width_max = (last.to - first.from) / SECTION_CELLS;
        grid.nodes.push(node(first.from, &first.at(first.from), dof, bounds)?);
        for (k, piece) in pieces.iter().enumerate() {
            let mut from = piece.from;
            let mut ends = ends(piece, bounds, width_max, cuts);
            if k == 0 {
                let width = ends[0] - piece.from;
                let halves = (1..=HALVINGS).rev().map(|k| piece.from + width * 0.5_f64.powi(k));
                ends.splice(0..0, halves);
            }
            if k + 1 == pieces.len() {
                let before = ends.iter().rev().nth(1).copied().unwrap_or(piece.from);
                let last = ends.len() - 1;
                let halves =
                    (1..=HALVINGS).map(|k| piece.to - (piece.to - before) * 0.5_f64.powi(k));
                ends.splice(last..last, halves);
            }
            for to in ends {
                let jets = [from, (from + to) / 2.0, to].map(|s| piece.at(s));
                grid.cells.push(cell(to - from, piece.ceiling, &jets, dof, bounds));
                grid.nodes.push(node(to, &jets[2], dof, bounds)?);
                from = to;
            }
        }
        Ok(grid)
    }
}

/// Where the cells of a piece end.
fn ends(piece: &Piece, bounds: &Bounds, width_max: f64, cuts: &[f64]) -> Vec<f64> {
    let width = piece.to - piece.from;
    let jets = [piece.from, (piece.from + piece.to) / 2.0, piece.to].map(|s| piece.at(s));
    let by_turn = (turn(&jets, bounds, width) / CELL_TURN).min(TURN_CELLS);
    let n_cells = by_turn.max(width / width_max).ceil().max(1.0);
    let mut ends: Vec<f64> =
        (1..n_cells as usize).map(|k| piece.from + width * (k as f64 / n_cells)).collect();
    let sliver = 1e-3 * width / n_cells;
    for &cut in cuts.iter().filter(|cut| **cut > piece.from + sliver && **cut < piece.to - sliver) {
        let at = ends.partition_point(|end| *end < cut);
        let near =
            ends[at.saturating_sub(1)..].iter().take(2).position(|end| (end - cut).abs() < sliver);
        match near {
            Some(offset) => ends[at.saturating_sub(1) + offset] = cut,
            None => ends.insert(at, cut),
        }
    }
    ends.push(piece.to);
    ends
}

/// How much the joints' direction changes over a piece: against the largest slope on it, each
/// measured by the speed of its joint.
fn turn(jets: &[Jet; 3], bounds: &Bounds, width: f64) -> f64 {
    let most = |row: fn(&Jet) -> &[f64; MAX_DOF]| {
        let own = |jet: &Jet| {
            let scaled = |j: usize| {
                let speed = bounds.velocity[j];
                row(jet)[j].abs() / if speed.is_finite() { speed } else { 1.0 }
            };
            (0..bounds.dof).map(scaled).fold(0.0, f64::max)
        };
        jets.iter().map(own).fold(0.0, f64::max)
    };
    let (slope, bend) = (most(|jet| &jet.d1), most(|jet| &jet.d2) * width);
    // Rounding bends straight lines by this much.
    if bend < 1e-9 * slope { 0.0 } else { bend / slope.max(f64::MIN_POSITIVE) }
}

fn speed(jet: &Jet, dof: usize, bounds: &Bounds) -> f64 {
    let ratio = |j: usize| bounds.velocity[j] / jet.d1[j].abs();
    (0..dof).map(ratio).fold(f64::INFINITY, f64::min)
}

fn node(s: f64, jet: &Jet, dof: usize, bounds: &Bounds) -> Result<Node, Fault> {
    let rows = [Row { a: 0.0, b: 0.0, low: 0.0, high: 0.0 }; 2 * MAX_DOF];
    let mut node = Node { s, rows, n_rows: 0, speed: speed(jet, dof, bounds) };
    for joint in 0..dof {
        let high = bounds.acceleration[joint];
        if high.is_finite() {
            let row = Row { a: jet.d1[joint], b: jet.d2[joint], low: -high, high };
            node.rows[node.n_rows] = row;
            node.n_rows += 1;
        }
    }
    if let Some(torque) = &bounds.torque {
        let form = (torque.law)(&jet.q[..dof], &jet.d1[..dof], &jet.d2[..dof]);
        for joint in 0..dof {
            let rest = form.rest.get(joint).copied().unwrap_or(0.0);
            let (low, high) = (torque.lower[joint] - rest, torque.upper[joint] - rest);
            if !(low < 0.0 && high > 0.0) {
                return Err(Fault::Weak { joint, s });
            }
            let entry = |row: &[f64]| row.get(joint).copied().unwrap_or(0.0);
            let (a, b) = (entry(&form.acceleration), entry(&form.speed_squared));
            node.rows[node.n_rows] = Row { a, b, low, high };
            node.n_rows += 1;
        }
    }
    Ok(node)
}

fn cell(width: f64, ceiling: f64, jets: &[Jet; 3], dof: usize, bounds: &Bounds) -> Cell {
    let mut d = [[0.0_f64; 3]; MAX_DOF];
    for jet in jets {
        for j in 0..dof {
            for (most, row) in d[j].iter_mut().zip([&jet.d1, &jet.d2, &jet.d3]) {
                *most = most.max(row[j].abs());
            }
        }
    }
    let own = |j: usize| (JERK_OF_PATH * bounds.jerk[j] / d[j][2]).cbrt();
    let jerk_speed = (0..dof).map(own).fold(f64::INFINITY, f64::min);
    Cell { width, ceiling, speed: speed(&jets[1], dof, bounds), jerk_speed, d }
}

impl Cell {
    /// Largest |d³s/dt³| at speed `v`, where accelerations reach `window_s` times it.
    ///
    /// ```text
    /// |q'| s⃛ + 3 |q''| v T s⃛ + |q'''| v³ ≤ j
    /// ```
    pub(super) fn jerk(&self, v: f64, window_s: f64, bounds: &Bounds) -> f64 {
        let own = |j: usize| {
            if bounds.jerk[j].is_infinite() {
                return f64::INFINITY;
            }
            let [d1, d2, d3] = self.d[j];
            let left = (bounds.jerk[j] - d3 * v * v * v).max(JERK_LEFT * bounds.jerk[j]);
            left / (d1 + 3.0 * d2 * v * window_s)
        };
        (0..bounds.dof).map(own).fold(bounds.ramp_jerk, f64::min)
    }
}
