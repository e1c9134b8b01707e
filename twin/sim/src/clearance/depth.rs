//! How deep two convex sets overlap, in f64, never too shallow.
//!
//! ```text
//! depth = min over unit n of h(n),   h(n) = the furthest that A − B reaches along n
//! ```
//!
//! `h(n)` of any direction is a translation that parts the sets, so that the least of all that were
//! tried is never less than the depth. A polytope in A − B about the origin is grown towards its
//! nearest face until that face and the set are as far out as each other.
//!
//! # Source
//! van den Bergen, Proximity queries and penetration depth computation on 3D game objects, GDC 2001.

use super::gjk::{Simplex, TOLERANCE_M};
use crate::pose::Vector;

/// A depth may be stated deeper than it is by this share: round edges are cut into faces.
pub(super) const SHARE: f64 = 1e-4;

const STEPS_MAX: usize = 96;

struct Face {
    corners: [usize; 3],
    /// Outward, of unit length.
    normal: Vector,
    distance_m: f64,
}

impl Face {
    /// `None` of a face without area.
    fn new(points: &[Vector], corners: [usize; 3]) -> Option<Self> {
        let [a, b, c] = corners.map(|k| points[k]);
        let normal = (b - a).cross(&(c - a)).try_normalize(1e-24)?;
        Some(Self { corners, normal, distance_m: normal.dot(&a) })
    }
}

/// Depth of the overlap, m, at most [`SHARE`] too deep as a rule and never too shallow.
///
/// `support` gives the point of A − B that is least along its argument, `simplex` are corners of
/// A − B about the origin, `known_m` is a depth that was found already.
pub(super) fn depth(support: impl Fn(&Vector) -> Vector, simplex: &Simplex, known_m: f64) -> f64 {
    let mut least_m = known_m;
    let Some((mut points, mut faces)) = start(&support, simplex) else { return least_m };
    for _ in 0..STEPS_MAX {
        let nearest = faces.iter().min_by(|a, b| a.distance_m.total_cmp(&b.distance_m));
        let Some(&Face { normal, distance_m, .. }) = nearest else { return least_m };
        let w = support(&-normal);
        let reach_m = w.dot(&normal);
        if !reach_m.is_finite() {
            return least_m;
        }
        least_m = least_m.min(reach_m.max(0.0));
        if least_m - distance_m <= TOLERANCE_M.max(SHARE * least_m)
            || !grow(&mut points, &mut faces, w)
        {
            return least_m;
        }
    }
    least_m
}

/// A tetrahedron in A − B: the simplex, or where that is flat one from corners about it.
fn start(
    support: &impl Fn(&Vector) -> Vector,
    simplex: &Simplex,
) -> Option<(Vec<Vector>, Vec<Face>)> {
    let mut points = simplex.corners[..simplex.n].to_vec();
    if points.is_empty() {
        points.push(support(&Vector::x()));
    }
    // The corner furthest out of what the corners so far span, both ways along what is across it.
    while points.len() < 4 {
        let a = points[0];
        let ways: Vec<Vector> = match points[..] {
            [_] => vec![Vector::x(), Vector::y(), Vector::z()],
            [_, b] => {
                let along = (b - a).try_normalize(1e-18)?;
                [0, 1, 2].map(|k| along.cross(&Vector::ith(k, 1.0))).to_vec()
            }
            [_, b, c] | [_, b, c, ..] => vec![(b - a).cross(&(c - a))],
            [] => return None,
        };
        let ways = ways.into_iter().filter_map(|way| way.try_normalize(1e-24));
        let corners = ways.flat_map(|way| {
            [support(&way), support(&-way)].map(|corner| (way.dot(&(corner - a)).abs(), corner))
        });
        let (out_m, corner) = corners.max_by(|one, two| one.0.total_cmp(&two.0))?;
        // A set without volume in this direction has no depth beyond what is known.
        if out_m <= 1e-12 {
            return None;
        }
        points.push(corner);
    }
    let [a, b, c, d] = [points[0], points[1], points[2], points[3]];
    if (b - a).cross(&(c - a)).dot(&(d - a)) > 0.0 {
        points.swap(1, 2);
    }
    let faces = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
    let faces: Option<Vec<Face>> = faces.into_iter().map(|face| Face::new(&points, face)).collect();
    faces.map(|faces| (points, faces))
}

/// Takes in a corner: the faces that see it go, new ones join their outline to it. False where
/// nothing grows.
fn grow(points: &mut Vec<Vector>, faces: &mut Vec<Face>, w: Vector) -> bool {
    let sees = |face: &Face| face.normal.dot(&w) - face.distance_m > 1e-13;
    let seen: Vec<[usize; 3]> = faces.iter().filter(|f| sees(f)).map(|f| f.corners).collect();
    let edges = |[a, b, c]: &[usize; 3]| [[*a, *b], [*b, *c], [*c, *a]];
    let all: Vec<[usize; 2]> = seen.iter().flat_map(edges).collect();
    let outline = all.iter().filter(|[from, to]| !all.contains(&[*to, *from]));
    let tip = points.len();
    points.push(w);
    let new: Option<Vec<Face>> =
        outline.map(|&[from, to]| Face::new(points, [from, to, tip])).collect();
    let Some(new) = new.filter(|new| !new.is_empty()) else { return false };
    faces.retain(|face| !sees(face));
    faces.extend(new);
    true
}
