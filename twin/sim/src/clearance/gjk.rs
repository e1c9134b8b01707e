//! Distance of two convex sets by their support functions, in f64, with a certificate.
//!
//! ```text
//! w(v) = the point of A − B that is least along v
//! v·w(v)/|v|  ≤  distance of A and B  ≤  |v|      v: any point of A − B
//! ```
//!
//! The left side is the gap between the two planes across `v` that hold the sets apart: it is true
//! for every `v` whatever the search did before, so an answer is never too long however early the
//! search ends, but for the rounding of one product. Flat and doubled corners cost nothing but a
//! looser bound.
//!
//! # Source
//! Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation 4 (1988) 193; the nearest point of a
//! simplex by regions as in Ericson, Real-Time Collision Detection, 5.1, with the newest corner
//! always kept.

use crate::pose::Vector;

/// Two bounds nearer to each other than this are one answer, m.
pub(super) const TOLERANCE_M: f64 = 1e-9;

/// Sets nearer to each other than this overlap, m: what coordinates of some metres round to, with
/// room.
const TOUCH_M: f64 = 1e-12;

/// Polytopes need about six steps, round edges up to twenty.
const STEPS_MAX: usize = 64;

/// How far two sets are apart.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gap {
    /// They are at least this far apart, m; not positive where they overlap.
    pub(super) least_m: f64,
    /// They are at most this far apart, m; infinite where the search ended before it knew.
    pub(super) most_m: f64,
    /// The way from B to A across the planes of `least_m`; any length.
    pub(super) across: Vector,
    /// Where they overlap: corners of A − B about the origin.
    pub(super) simplex: Simplex,
}

impl Gap {
    /// Whether the sets were found to overlap.
    pub(super) fn overlaps(&self) -> bool {
        self.most_m <= TOUCH_M
    }
}

/// Distance of A and B within [`TOLERANCE_M`], or a lower bound of it beyond `beyond_m`.
///
/// `support` gives the point of A − B that is least along its argument, `start` is any guess of the
/// way from B to A, `most_m` its length if it is a point of A − B, else infinite.
/// O(steps · support), some six steps for polytopes, one for sets far apart.
pub(super) fn gap(
    support: impl Fn(&Vector) -> Vector,
    start: Vector,
    most_m: f64,
    beyond_m: f64,
) -> Gap {
    let mut gap = Gap {
        least_m: f64::NEG_INFINITY,
        most_m,
        across: start,
        simplex: Simplex { corners: [Vector::zeros(); 4], n: 0 },
    };
    let mut length_m = start.norm();
    let mut v = start;
    if !(length_m > TOUCH_M && length_m.is_finite()) {
        (v, length_m) = (Vector::x(), 1.0);
    }
    let mut simplex_m = f64::INFINITY;
    for _ in 0..STEPS_MAX {
        let w = support(&v);
        let least_m = v.dot(&w) / length_m;
        if least_m > gap.least_m {
            (gap.least_m, gap.across) = (least_m, v);
        }
        if gap.least_m > beyond_m || gap.most_m - gap.least_m <= TOLERANCE_M {
            return gap;
        }
        if !gap.simplex.add(w) {
            return gap;
        }
        let next = gap.simplex.nearest();
        let next_m = next.norm();
        // Rounding only: in exact numbers every step comes nearer.
        if next_m >= simplex_m {
            return gap;
        }
        simplex_m = next_m;
        gap.most_m = gap.most_m.min(next_m);
        if next_m <= TOUCH_M {
            gap.least_m = gap.least_m.min(0.0);
            return gap;
        }
        (v, length_m) = (next, next_m);
    }
    gap
}

/// Up to four points; the newest is the last.
#[derive(Debug, Clone, Copy)]
pub(super) struct Simplex {
    pub(super) corners: [Vector; 4],
    pub(super) n: usize,
}

/// Triangles and tetrahedra flatter than this (sine of the angle, squared) are left to their edges
/// and faces.
const FLAT: f64 = 1e-24;

impl Simplex {
    /// False where the point is one of the corners already, or no number.
    fn add(&mut self, w: Vector) -> bool {
        let known = self.corners[..self.n].contains(&w);
        if known || self.n == 4 || !w.x.is_finite() || !w.y.is_finite() || !w.z.is_finite() {
            return false;
        }
        self.corners[self.n] = w;
        self.n += 1;
        true
    }

    fn of<const N: usize>(corners: [Vector; N]) -> Self {
        let mut all = [Vector::zeros(); 4];
        all[..N].copy_from_slice(&corners);
        Self { corners: all, n: N }
    }

    /// The point nearest to the origin; corners that do not carry it are dropped.
    fn nearest(&mut self) -> Vector {
        let [a, b, c, d] = self.corners;
        let (nearest, kept) = match self.n {
            0 | 1 => return a,
            2 => on_edge(b, a),
            3 => on_face(c, b, a),
            _ => in_solid(d, c, b, a),
        };
        *self = kept;
        nearest
    }
}

/// Nearest point of the edge from the newest corner `a`.
fn on_edge(a: Vector, b: Vector) -> (Vector, Simplex) {
    let along = b - a;
    let (up, whole) = (-a.dot(&along), along.norm_squared());
    if up <= 0.0 {
        (a, Simplex::of([a]))
    } else if up >= whole {
        (b, Simplex::of([b]))
    } else {
        (a + along * (up / whole), Simplex::of([b, a]))
    }
}

fn nearer(one: (Vector, Simplex), two: (Vector, Simplex)) -> (Vector, Simplex) {
    if two.0.norm_squared() < one.0.norm_squared() { two } else { one }
}

/// Nearest point of the triangle with the newest corner `a`.
fn on_face(a: Vector, b: Vector, c: Vector) -> (Vector, Simplex) {
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(&ac);
    let area = normal.norm_squared();
    if area <= FLAT * ab.norm_squared() * ac.norm_squared() {
        return nearer(nearer(on_edge(a, b), on_edge(a, c)), on_edge(b, c));
    }
    // Which edges have the origin on their outer side; the nearest point is on one of those.
    let out_ab = normal.cross(&ab).dot(&a) > 0.0;
    let out_ac = ac.cross(&normal).dot(&a) > 0.0;
    let out_bc = normal.cross(&(c - b)).dot(&b) > 0.0;
    let edges = [(out_ab, a, b), (out_ac, a, c), (out_bc, b, c)];
    let outside = edges.into_iter().filter(|edge| edge.0).map(|(_, p, q)| on_edge(p, q));
    outside
        .reduce(nearer)
        .unwrap_or_else(|| (normal * (normal.dot(&a) / area), Simplex::of([c, b, a])))
}

/// Nearest point of the tetrahedron with the newest corner `a`; the origin where it is inside.
///
/// The face without `a` needs no look: the origin is on its inner side, or `a` were not nearer.
fn in_solid(a: Vector, b: Vector, c: Vector, d: Vector) -> (Vector, Simplex) {
    let outside = |p: Vector, q: Vector, opposite: Vector| {
        let normal = (p - a).cross(&(q - a));
        let (inner, origin) = (normal.dot(&(opposite - a)), -normal.dot(&a));
        let flat = inner * inner <= FLAT * normal.norm_squared() * (opposite - a).norm_squared();
        flat || inner * origin < 0.0
    };
    let faces = [(b, c, d), (c, d, b), (d, b, c)];
    let open = faces.into_iter().filter(|&(p, q, opposite)| outside(p, q, opposite));
    open.map(|(p, q, _)| on_face(a, p, q))
        .reduce(nearer)
        .unwrap_or((Vector::zeros(), Simplex::of([d, c, b, a])))
}
