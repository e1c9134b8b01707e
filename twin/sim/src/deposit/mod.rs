//! What has been printed: as planned and as printed, with age. The one owner of that geometry;
//! collision, structure and pictures read it here.

mod contact;
mod index;
#[cfg(test)]
mod tests;

pub use contact::{ALONGSIDE_DIAMETERS, Contact, closest, contacts};
pub use index::Index;

use crate::pose::{Point, Vector};

/// One printed strand.
#[derive(Debug, Clone, PartialEq)]
pub struct Printed {
    /// Index of the strand in the job.
    pub strand: usize,
    /// Polyline as planned, part axes.
    pub as_planned: Vec<Point>,
    /// The same points as printed, part axes.
    pub as_printed: Vec<Point>,
    /// Arc length as planned at each point, m.
    pub at_m: Vec<f64>,
    /// Radius of the set bead, m.
    pub radius_m: f64,
    /// When its extrusion began, s from the start of the program.
    pub born_s: f64,
    /// When it ended.
    pub done_s: f64,
}

impl Printed {
    /// The planned point at an arc length.
    pub fn planned_at(&self, at_m: f64) -> Point {
        self.between(&self.as_planned, at_m)
    }

    /// The point as printed that was planned at an arc length.
    pub fn printed_at(&self, at_m: f64) -> Point {
        self.between(&self.as_printed, at_m)
    }

    fn between(&self, points: &[Point], at_m: f64) -> Point {
        let k = self.at_m.partition_point(|&x| x < at_m).clamp(1, self.at_m.len() - 1);
        let share = (at_m - self.at_m[k - 1]) / (self.at_m[k] - self.at_m[k - 1]);
        points[k - 1] + (points[k] - points[k - 1]) * share
    }

    /// Direction of its axis as printed at an arc length, unit.
    pub fn direction_at(&self, at_m: f64) -> Vector {
        let k = self.at_m.partition_point(|&x| x < at_m).clamp(1, self.at_m.len() - 1);
        (self.as_printed[k] - self.as_printed[k - 1]).normalize()
    }

    /// Length of the strand, m.
    pub fn length_m(&self) -> f64 {
        self.at_m.last().copied().unwrap_or(0.0)
    }

    /// When an arc length is laid if the nozzle goes evenly from birth to end, s.
    pub fn even_time_s(&self, at_m: f64) -> f64 {
        let length_m = self.length_m();
        let share = if length_m > 0.0 { at_m / length_m } else { 0.0 };
        self.born_s + (self.done_s - self.born_s) * share
    }
}

/// A straight piece of a printed strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Position of its strand in the printing order.
    pub order: usize,
    /// Its ends as printed, part axes.
    pub ends: [Point; 2],
    /// Arc length at its ends, m.
    pub at_m: [f64; 2],
    /// Radius of the bead, m.
    pub radius_m: f64,
}

/// All printed strands, in printing order, with a spatial index over their segments.
#[derive(Debug, Clone)]
pub struct Deposit {
    /// The strands.
    pub strands: Vec<Printed>,
    /// Their segments, strand by strand.
    pub segments: Vec<Segment>,
    index: Index,
    bounds: Option<(Point, Point)>,
}

impl Deposit {
    /// Indexes strands given in printing order. O(n) in segments.
    pub fn new(strands: Vec<Printed>) -> Self {
        let mut segments = Vec::new();
        for (order, printed) in strands.iter().enumerate() {
            for k in 1..printed.as_printed.len() {
                segments.push(Segment {
                    order,
                    ends: [printed.as_printed[k - 1], printed.as_printed[k]],
                    at_m: [printed.at_m[k - 1], printed.at_m[k]],
                    radius_m: printed.radius_m,
                });
            }
        }
        let index = Index::new(&segments);
        let boxes = segments.iter().map(Segment::bounds);
        let bounds = boxes.reduce(|(low, high), (l, h)| (low.inf(&l), high.sup(&h)));
        Self { strands, segments, index, bounds }
    }

    /// Place in the printing order of each strand of a job with so many; `None`: not printed.
    pub fn order_of(&self, strands: usize) -> Vec<Option<usize>> {
        let mut order_of = vec![None; strands];
        for (order, printed) in self.strands.iter().enumerate() {
            order_of[printed.strand] = Some(order);
        }
        order_of
    }

    /// Indices of segments whose boxes touch the box `low..high`, ascending, without repeats.
    pub fn near(&self, low: Point, high: Point, found: &mut Vec<u32>) {
        self.index.near(low, high, found);
    }

    /// Lowest and highest corner of all beads; `None` before anything is printed.
    pub fn bounds(&self) -> Option<(Point, Point)> {
        self.bounds
    }
}

impl Segment {
    /// Its box, bead included.
    pub fn bounds(&self) -> (Point, Point) {
        let skin = Vector::repeat(self.radius_m);
        (self.ends[0].inf(&self.ends[1]) - skin, self.ends[0].sup(&self.ends[1]) + skin)
    }
}

/// Shape of a strand that sagged between its ends.
///
/// ```text
/// u(s) = sag · 4 x (1 − x) · ĝ      x = s / L
/// ```
///
/// The parabola of a loaded string, `ĝ` the unit direction of gravity in part axes. Both ends stay:
/// the nozzle holds the far one until it is set, and what happens to it then is a finding (P301,
/// P304), not a shape.
pub fn sagged(points: &[Point], at_m: &[f64], sag_m: f64, down: Vector) -> Vec<Point> {
    let length_m = at_m.last().copied().unwrap_or(0.0).max(f64::MIN_POSITIVE);
    points
        .iter()
        .zip(at_m)
        .map(|(point, at_m)| {
            let x = at_m / length_m;
            point + down * (sag_m * 4.0 * x * (1.0 - x))
        })
        .collect()
}
