//! Distance of two solids, in f64, by their triangles.
//!
//! The GJK of parry3d in f32 stops early now and then: about once in a thousand short beads near a
//! nozzle it answers centimetres for tenths of a millimetre. Its answer is therefore held against
//! the separating plane it implies, and where that does not bear it out the distance is computed
//! here, from every pair of triangles. O(m · n), but rarely.

use crate::clearance::core::Core;
use crate::deposit::closest;
use crate::pose::{Point, Vector};

/// A triangle by its corners; a line has two of them alike.
pub(super) type Triangle = [Point; 3];

/// Least distance of two surfaces; zero where they cross.
pub(super) fn distance(first: &[Triangle], second: &[Triangle]) -> f64 {
    let mut least = f64::INFINITY;
    for a in first {
        for b in second {
            for [one, other] in [[a, b], [b, a]] {
                for corner in one {
                    least = least.min(to_face(corner, other).unwrap_or(f64::INFINITY));
                }
                if edges(one).iter().any(|edge| pierces(edge, other)) {
                    return 0.0;
                }
            }
            for edge in edges(a) {
                for other in edges(b) {
                    let [s, t] = closest(&edge, &other);
                    let at = |edge: &[Point; 2], share: f64| edge[0] + (edge[1] - edge[0]) * share;
                    least = least.min((at(&edge, s) - at(&other, t)).norm());
                }
            }
        }
    }
    least
}

fn edges([a, b, c]: &Triangle) -> [[Point; 2]; 3] {
    [[*a, *b], [*b, *c], [*c, *a]]
}

/// Distance from a face where the foot lies in it; elsewhere an edge is nearer.
fn to_face(point: &Point, face: &Triangle) -> Option<f64> {
    let normal = normal(face)?;
    let foot_m = normal.dot(&(point - face[0]));
    inside(&(point - normal * foot_m), face, &normal).then_some(foot_m.abs())
}

fn pierces(edge: &[Point; 2], face: &Triangle) -> bool {
    let Some(normal) = normal(face) else { return false };
    let [from, to] = edge.map(|end| normal.dot(&(end - face[0])));
    from * to < 0.0
        && inside(&(edge[0] + (edge[1] - edge[0]) * (from / (from - to))), face, &normal)
}

fn normal([a, b, c]: &Triangle) -> Option<Vector> {
    (b - a).cross(&(c - a)).try_normalize(1e-18)
}

fn inside(point: &Point, face: &Triangle, normal: &Vector) -> bool {
    edges(face).iter().all(|[a, b]| (b - a).cross(&(point - a)).dot(normal) >= 0.0)
}

/// Whether a place is in a core, by the planes of a box or a tetrahedron, with room for rounding.
pub(super) fn holds(core: &Core, place: &Point) -> bool {
    match core {
        Core::Box { middle, half } => half
            .iter()
            .all(|edge| (place - middle).dot(edge).abs() <= edge.norm_squared() * (1.0 + 1e-9)),
        Core::Hull(corners) => (0..4).all(|k| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|j| corners[(j + k) % 4]);
            let normal = (b - a).cross(&(c - a));
            let (inner, side) = (normal.dot(&(d - a)), normal.dot(&(place - a)));
            side * inner >= -1e-9 * inner * inner
        }),
        _ => false,
    }
}
