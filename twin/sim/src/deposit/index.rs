//! A uniform grid over segments.

use std::collections::HashMap;

use super::Segment;
use crate::pose::{Point, Vector};

/// Segments by the grid cells their boxes touch.
///
/// Building is O(n · c), a query O(c' + k): `c` cells a segment touches, `c'` cells a query
/// touches, `k` segments found. The edge is the mean box, so `c` stays small in a frame of
/// struts of like length.
#[derive(Debug, Clone)]
pub struct Index {
    edge_m: f64,
    cells: HashMap<[i32; 3], Vec<u32>>,
    /// Lowest and highest occupied cell along each axis; queries are cut to it.
    occupied: [[i32; 3]; 2],
    n_segments: u32,
}

/// Edges are kept in this range: a grid of beads alone, or one of a single cell, helps nobody.
const EDGE_M: std::ops::RangeInclusive<f64> = 2e-3..=0.1;

impl Index {
    /// Indexes `segments` by position in the slice.
    pub fn new(segments: &[Segment]) -> Self {
        let total_m: f64 =
            segments.iter().map(|s| (s.ends[1] - s.ends[0]).amax() + 2.0 * s.radius_m).sum();
        let mean_m = total_m / segments.len().max(1) as f64;
        let edge_m = mean_m.clamp(*EDGE_M.start(), *EDGE_M.end());
        let mut index = Self {
            edge_m,
            cells: HashMap::new(),
            occupied: [[i32::MAX; 3], [i32::MIN; 3]],
            n_segments: segments.len() as u32,
        };
        for (k, segment) in segments.iter().enumerate() {
            for (low, high) in pieces(segment, edge_m) {
                let range = index.range(low, high);
                index.add(k as u32, range);
            }
        }
        index
    }

    fn add(&mut self, segment: u32, range: [[i32; 3]; 2]) {
        let [lowest, highest] = self.occupied;
        self.occupied = [
            std::array::from_fn(|axis| lowest[axis].min(range[0][axis])),
            std::array::from_fn(|axis| highest[axis].max(range[1][axis])),
        ];
        for cell in cells(range) {
            let segments = self.cells.entry(cell).or_default();
            if segments.last() != Some(&segment) {
                segments.push(segment);
            }
        }
    }

    /// Segments that share a grid cell with the box, ascending, without repeats; all of them where
    /// the box covers most of the deposit.
    pub fn near(&self, low: Point, high: Point, found: &mut Vec<u32>) {
        found.clear();
        let [from, to] = self.range(low, high);
        let cut = [
            std::array::from_fn(|axis| from[axis].max(self.occupied[0][axis])),
            std::array::from_fn(|axis| to[axis].min(self.occupied[1][axis])),
        ];
        let n_cells: f64 =
            (0..3).map(|axis| f64::from((cut[1][axis] - cut[0][axis] + 1).max(0))).product();
        // A box that covers more cells than are occupied gets everything: the caller looks closer.
        if n_cells > self.cells.len() as f64 {
            found.extend(0..self.n_segments);
            return;
        }
        for cell in cells(cut) {
            if let Some(segments) = self.cells.get(&cell) {
                found.extend_from_slice(segments);
            }
        }
        found.sort_unstable();
        found.dedup();
    }

    fn range(&self, low: Point, high: Point) -> [[i32; 3]; 2] {
        let cell = |x: f64| (x / self.edge_m).floor() as i32;
        [[low.x, low.y, low.z].map(cell), [high.x, high.y, high.z].map(cell)]
    }
}

/// Boxes about pieces of a segment no longer than a cell's edge, bead included: a long strut across
/// a fine grid touches the cells along it, not all in its box.
fn pieces(segment: &Segment, edge_m: f64) -> impl Iterator<Item = (Point, Point)> {
    let [a, b] = segment.ends;
    let n_pieces = ((b - a).norm() / edge_m).ceil().max(1.0) as usize;
    let skin = Vector::repeat(segment.radius_m);
    (0..n_pieces).map(move |k| {
        let at = |k: usize| a + (b - a) * (k as f64 / n_pieces as f64);
        let (from, to) = (at(k), at(k + 1));
        (from.inf(&to) - skin, from.sup(&to) + skin)
    })
}

fn cells([l, h]: [[i32; 3]; 2]) -> impl Iterator<Item = [i32; 3]> {
    (l[0]..=h[0])
        .flat_map(move |x| (l[1]..=h[1]).flat_map(move |y| (l[2]..=h[2]).map(move |z| [x, y, z])))
}
