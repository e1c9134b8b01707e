//! The path as a curve: `q(s)` with continuous first and second derivative between rests.

use crate::kinematics::{MAX_DOF, Posture};

use super::{Fault, Station, spline};

/// Samples nearer than this share of the path's length count as one.
const MERGE_SHARE: f64 = 1e-6;
/// Joints may differ by this between samples that count as one, rad or m.
const MERGE_JOINT: f64 = 1e-5;

/// `q` and its derivatives by the path parameter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Jet {
    pub(super) q: [f64; MAX_DOF],
    pub(super) d1: [f64; MAX_DOF],
    pub(super) d2: [f64; MAX_DOF],
    pub(super) d3: [f64; MAX_DOF],
}

/// A corner that is rounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rounding {
    /// Index of the station.
    pub station: usize,
    /// The path is left this far before and met again this far after the corner, m.
    pub half_m: f64,
    /// Posture in the middle of the rounding less the posture at the corner, rad or m. With straight
    /// sides of slopes `t₁`, `t₂` it is `3/16 · half_m · (t₂ − t₁)`.
    pub deviation: Posture,
}

/// A polynomial piece; its polynomial is in `(s − origin)/width`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) ceiling: f64,
    origin: f64,
    width: f64,
    dof: usize,
    /// Of each joint, the constant first.
    coefficients: [[f64; 6]; MAX_DOF],
}

impl Piece {
    pub(super) fn at(&self, s: f64) -> Jet {
        let u = (s - self.origin) / self.width;
        let (one, two) = (1.0 / self.width, 1.0 / (self.width * self.width));
        let zero = [0.0; MAX_DOF];
        let mut jet = Jet { q: zero, d1: zero, d2: zero, d3: zero };
        for (j, &[c0, c1, c2, c3, c4, c5]) in self.coefficients[..self.dof].iter().enumerate() {
            jet.q[j] = c0 + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * c5))));
            jet.d1[j] =
                one * (c1 + u * (2.0 * c2 + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5))));
            jet.d2[j] = two * (2.0 * c2 + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5)));
            jet.d3[j] = two * one * (6.0 * c3 + u * (24.0 * c4 + u * 60.0 * c5));
        }
        jet
    }

    /// The cubic with these values and second derivatives at its ends.
    fn cubic(from: &Knot, to: &Knot, m_from: &[f64], m_to: &[f64]) -> Self {
        let width = to.s - from.s;
        let mut coefficients = [[0.0; 6]; MAX_DOF];
        for (j, (m_from, m_to)) in m_from.iter().zip(m_to).enumerate() {
            let (second, third) =
                (m_from * width * width / 2.0, (m_to - m_from) * width * width / 6.0);
            let first = to.q[j] - from.q[j] - second - third;
            coefficients[j] = [from.q[j], first, second, third, 0.0, 0.0];
        }
        let (origin, dof) = (from.s, from.q.len());
        Self { from: from.s, to: to.s, ceiling: from.ceiling, origin, width, dof, coefficients }
    }

    /// The quintic that meets `before` at `from` and `after` at `to` with two derivatives.
    fn quintic(before: &Self, from: f64, after: &Self, to: f64) -> Self {
        let width = to - from;
        let (a, b) = (before.at(from), after.at(to));
        let mut coefficients = [[0.0; 6]; MAX_DOF];
        for (j, row) in coefficients[..before.dof].iter_mut().enumerate() {
            let (v, w) = (a.d1[j] * width, a.d2[j] * width * width);
            let gap = b.q[j] - a.q[j] - v - w / 2.0;
            let (gap_v, gap_w) = (b.d1[j] * width - v - w, b.d2[j] * width * width - w);
            let third = 10.0 * gap - 4.0 * gap_v + gap_w / 2.0;
            let fourth = -15.0 * gap + 7.0 * gap_v - gap_w;
            let fifth = 6.0 * gap - 3.0 * gap_v + gap_w / 2.0;
            *row = [a.q[j], v, w / 2.0, third, fourth, fifth];
        }
        let ceiling = before.ceiling.min(after.ceiling);
        Self { from, to, ceiling, origin: from, width, dof: before.dof, coefficients }
    }
}

/// The path between two rests: pieces `first..end`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Section {
    pub(super) first: usize,
    pub(super) end: usize,
}

/// The whole path.
#[derive(Debug, Clone)]
pub(super) struct Course {
    pub(super) dof: usize,
    pub(super) pieces: Vec<Piece>,
    pub(super) sections: Vec<Section>,
    pub(super) roundings: Vec<Rounding>,
    /// Where it is when there are no pieces.
    home: Posture,
    start: f64,
}

#[derive(Clone, Copy)]
struct Knot {
    s: f64,
    q: Posture,
    ceiling: f64,
    stop: bool,
    corner: bool,
    station: usize,
}

impl Course {
    /// Curve through stations; corners are rounded by up to `blend_m`, but over less than half the
    /// way to the next corner, stop or end; where nothing is left of it the arm rests.
    pub(super) fn new(stations: &[Station], dof: usize, blend_m: f64) -> Result<Self, Fault> {
        let knots = knots(stations, dof)?;
        let last = knots.len() - 1;
        let runs = smooth_runs(&knots);
        let mut course = Self {
            dof,
            pieces: Vec::with_capacity(runs.len()),
            sections: Vec::new(),
            roundings: Vec::new(),
            home: knots[0].q,
            start: knots[0].s,
        };
        let is_mark = |k: &usize| *k == 0 || *k == last || knots[*k].stop || knots[*k].corner;
        let marks: Vec<usize> = (0..=last).filter(is_mark).collect();
        let mut from = course.start;
        let mut first = 0;
        for (index, &at) in marks.iter().enumerate().skip(1) {
            let run = runs[marks[index - 1]..at].iter().filter(|piece| piece.to > from);
            course.pieces.extend(run.map(|piece| Piece { from: piece.from.max(from), ..*piece }));
            let room = |mark: usize| ROOM_SHARE * (knots[mark].s - knots[at].s).abs();
            let half_m = match marks.get(index + 1) {
                Some(&next) if knots[at].corner && !knots[at].stop => {
                    blend_m.min(room(marks[index - 1])).min(room(next))
                }
                _ => 0.0,
            };
            from = knots[at].s;
            if half_m > MERGE_SHARE * (knots[last].s - course.start) {
                from = course.round(&knots, at, half_m, &runs);
            } else {
                course.sections.push(Section { first, end: course.pieces.len() });
                first = course.pieces.len();
            }
        }
        Ok(course)
    }

    /// Replaces the path about the corner `at`; returns where it is met again.
    fn round(&mut self, knots: &[Knot], at: usize, half_m: f64, runs: &[Piece]) -> f64 {
        let corner = knots[at];
        let (low, high) =
            (snap(knots, corner.s - half_m, half_m), snap(knots, corner.s + half_m, half_m));
        while self.pieces.last().is_some_and(|piece| piece.from >= low) {
            self.pieces.pop();
        }
        if let Some(piece) = self.pieces.last_mut() {
            piece.to = low;
        }
        let before = runs[..at].iter().rposition(|piece| piece.from < low).unwrap_or(at - 1);
        let after = at + runs[at..].iter().position(|piece| piece.to >= high).unwrap_or(0);
        let ceilings = runs[before..=after].iter().map(|piece| piece.ceiling);
        let mut piece = Piece::quintic(&runs[before], low, &runs[after], high);
        piece.ceiling = ceilings.fold(f64::INFINITY, f64::min);
        let mut deviation = Posture::new(&piece.at(corner.s).q[..self.dof]);
        deviation.iter_mut().zip(corner.q.iter()).for_each(|(value, q)| *value -= q);
        self.pieces.push(piece);
        self.roundings.push(Rounding { station: corner.station, half_m, deviation });
        high
    }

    /// Where the path begins and ends.
    pub(super) fn ends(&self) -> (f64, f64) {
        (self.start, self.pieces.last().map_or(self.start, |piece| piece.to))
    }

    /// Index of the piece at `s`; of two that meet there the later.
    pub(super) fn piece_at(&self, s: f64) -> usize {
        self.pieces.partition_point(|piece| piece.to <= s).min(self.pieces.len().max(1) - 1)
    }

    pub(super) fn at(&self, s: f64) -> Jet {
        let Some(piece) = self.pieces.get(self.piece_at(s)) else {
            let mut jet = Jet {
                q: [0.0; MAX_DOF],
                d1: [0.0; MAX_DOF],
                d2: [0.0; MAX_DOF],
                d3: [0.0; MAX_DOF],
            };
            jet.q[..self.dof].copy_from_slice(&self.home);
            return jet;
        };
        piece.at(s)
    }
}

/// A corner is rounded over at most this share of the way to its neighbours.
const ROOM_SHARE: f64 = 0.49;

/// `s`, or the knot that is so near that a sliver would be left.
fn snap(knots: &[Knot], s: f64, half_m: f64) -> f64 {
    let after = knots.partition_point(|knot| knot.s < s);
    let near = |knot: &&Knot| (knot.s - s).abs() < 1e-3 * half_m;
    knots[after.saturating_sub(1)..knots.len().min(after + 1)]
        .iter()
        .find(near)
        .map_or(s, |knot| knot.s)
}

/// Stations checked, with those that repeat another taken out.
fn knots(stations: &[Station], dof: usize) -> Result<Vec<Knot>, Fault> {
    let (Some(first), Some(last)) = (stations.first(), stations.last()) else {
        return Err(Fault::Empty);
    };
    let near = (MERGE_SHARE * (last.s - first.s)).max(f64::MIN_POSITIVE);
    let mut out: Vec<Knot> = Vec::with_capacity(stations.len());
    let mut highest = f64::NEG_INFINITY;
    for (station, &Station { s, q, ceiling, stop, corner }) in stations.iter().enumerate() {
        if !s.is_finite() || !q.iter().all(|value| value.is_finite()) {
            return Err(Fault::NotFinite { station });
        }
        if q.len() != dof {
            return Err(Fault::Joints { station });
        }
        if s < highest {
            return Err(Fault::Backwards { station });
        }
        if !(ceiling > 0.0) && station + 1 < stations.len() {
            return Err(Fault::Ceiling { station });
        }
        highest = s;
        let knot = Knot { s, q, ceiling, stop, corner, station };
        let is_first = out.len() == 1;
        match out.last_mut() {
            Some(before) if s - before.s <= near => {
                if before.q.distance(&q) > MERGE_JOINT {
                    return Err(Fault::Jump { station });
                }
                let (stop, corner) = (before.stop || stop, before.corner || corner);
                if station + 1 < stations.len() || is_first {
                    (before.stop, before.corner, before.ceiling) = (stop, corner, ceiling);
                } else {
                    *before = Knot { stop, corner, ..knot };
                }
            }
            _ => out.push(knot),
        }
    }
    Ok(out)
}

/// One cubic piece per interval, smooth from corner to corner.
fn smooth_runs(knots: &[Knot]) -> Vec<Piece> {
    let s: Vec<f64> = knots.iter().map(|knot| knot.s).collect();
    let q: Vec<Posture> = knots.iter().map(|knot| knot.q).collect();
    let mut pieces = Vec::with_capacity(knots.len());
    let mut from = 0;
    for to in 1..knots.len() {
        if to + 1 < knots.len() && !knots[to].corner {
            continue;
        }
        let second = spline::second_derivatives(&s[from..=to], &q[from..=to]);
        for k in from..to {
            let (m, m_next) = (&second[k - from], &second[k + 1 - from]);
            pieces.push(Piece::cubic(&knots[k], &knots[k + 1], m, m_next));
        }
        from = to;
    }
    pieces
}
