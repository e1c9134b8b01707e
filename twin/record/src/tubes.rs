//! Strands as closed tubes of triangles.
//!
//! A tube is a regular polygon swept along the strand's axis without twist (parallel transport). Corners are mitred: the
//! ring at a corner lies in the plane that halves it, so every side stays flat and what one half loses the other gains.
//! With the polygon as large in area as the circle and flat ends, the volume is therefore π r² L to rounding.

#[cfg(test)]
mod tests;

use crate::mesh::Mesh;
use sim::pose::{Point, Vector};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Points nearer than this are one, m.
const SAME_M: f64 = 1e-8;
/// A point this near the line between its neighbours' ends is left out where nothing hangs on it, m.
const STRAIGHT_M: f64 = 1e-7;
/// Cosine of the sharpest turn that is mitred; at a sharper one (near a reversal) the tube ends and another begins.
const MITRE_COS: f64 = -0.5;

/// How a tube is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TubeLook {
    /// Sides of the polygon, at least 3.
    pub(crate) sides: u32,
    /// Rings of the half ball at each end, the tip among them; 0: a flat end.
    pub(crate) end_rings: u32,
}

/// The tube about a polyline; each vertex knows the point of the polyline it stands for ([`Mesh::of`]).
///
/// Points that are not finite or double are passed over; what has no length or no radius is no tube. Points on a straight
/// stretch are left out but where `keep` wants them. O(n).
pub(crate) fn tube(
    points: &[Point],
    radius_m: f64,
    look: TubeLook,
    keep: impl Fn(usize) -> bool,
) -> Mesh {
    let mut mesh = Mesh::default();
    if !(radius_m > 0.0 && radius_m.is_finite()) || look.sides < 3 {
        return mesh;
    }
    let kept = kept(points, keep);
    let mut from = 0;
    for k in 1..kept.len() {
        let ends = k + 1 == kept.len() || {
            let [a, b, c] = [k - 1, k, k + 1].map(|k| points[kept[k]]);
            (b - a).normalize().dot(&(c - b).normalize()) < MITRE_COS
        };
        if ends {
            piece(points, &kept[from..=k], radius_m, look, &mut mesh);
            from = k;
        }
    }
    mesh
}

/// A ball about the middle, or a capsule about a line.
pub(crate) fn capsule(a: Point, b: Point, radius_m: f64, look: TubeLook) -> Mesh {
    let nudge = Vector::z() * (1e-3 * radius_m);
    let line = if (b - a).norm() > SAME_M { [a, b] } else { [a - nudge, a + nudge] };
    tube(&line, radius_m, look, |_| true)
}

/// Points that shape the line, by index: finite, apart, and none in the middle of a straight stretch unless wanted.
fn kept(points: &[Point], keep: impl Fn(usize) -> bool) -> Vec<usize> {
    let finite = |k: &usize| points[*k].coords.iter().all(|x| x.abs() < 1e6);
    let mut apart: Vec<usize> = Vec::new();
    for k in (0..points.len()).filter(finite) {
        let same = apart.last().is_some_and(|&last| (points[k] - points[last]).norm() <= SAME_M);
        if !same {
            apart.push(k);
        }
    }
    let mut kept: Vec<usize> = Vec::with_capacity(apart.len());
    for (place, &k) in apart.iter().enumerate() {
        let line = kept.last().zip(apart.get(place + 1)).map(|(&last, &next)| {
            let (a, b) = (points[last], points[next]);
            let (along, gone) = (b - a, points[k] - a);
            let length_m = along.norm();
            let forward = gone.dot(&along) > 0.0 && gone.norm() < length_m;
            forward && along.cross(&gone).norm() <= STRAIGHT_M * length_m
        });
        // a long shallow arc is no line: what is left out is bounded by what its neighbours alone say
        let far = kept.last().is_some_and(|&last| k - last > 64);
        if line != Some(true) || far || keep(k) {
            kept.push(k);
        }
    }
    kept
}

/// One closed tube through points that are apart and turn mildly.
fn piece(points: &[Point], kept: &[usize], radius_m: f64, look: TubeLook, mesh: &mut Mesh) {
    let at = |k: usize| points[kept[k]];
    let along: Vec<Vector> = (1..kept.len()).map(|k| (at(k) - at(k - 1)).normalize()).collect();
    let (Some(first), Some(last)) = (along.first().copied(), along.last().copied()) else { return };
    let ring = Ring { sides: look.sides, radius_m: radius_m * equal_area(look.sides) };
    let rings = look.end_rings;
    let mut across = any_across(&first);
    let first_vertex = mesh.points.len() as u32;
    // the near half ball from its tip to the ring at the first point
    for k in 0..rings {
        let up = first.cross(&across);
        ring.cap(mesh, at(0), [-first, across, up], [rings - k, rings], kept[0]);
    }
    for k in 0..kept.len() {
        let (before, after) = match k {
            0 => (first, first),
            _ if k == along.len() => (last, last),
            _ => (along[k - 1], along[k]),
        };
        ring.mitred(mesh, at(k), before, after, across, kept[k]);
        across = transported(across, &before, &after);
    }
    for k in 1..=rings {
        let end = kept.len() - 1;
        ring.cap(mesh, at(end), [last, across, last.cross(&across)], [k, rings], kept[end]);
    }
    if rings == 0 {
        mesh.add(at(0), -first, kept[0]);
        mesh.add(at(kept.len() - 1), last, kept[kept.len() - 1]);
    }
    close(mesh, first_vertex, look, kept.len() as u32);
}

/// Sides between the rings, and a fan at each end.
fn close(mesh: &mut Mesh, first: u32, look: TubeLook, stations: u32) {
    let n = look.sides;
    // a tip is one vertex, where there are half balls the first of all and the last of all
    let (rings, bottom, top, ring_0) = match look.end_rings {
        0 => (stations, first + stations * n, first + stations * n + 1, first),
        caps => {
            let rings = stations + 2 * (caps - 1);
            (rings, first, first + 1 + rings * n, first + 1)
        }
    };
    for side in 0..n {
        let next = (side + 1) % n;
        let at = |ring: u32, side: u32| ring_0 + ring * n + side;
        mesh.triangles.push([bottom, at(0, next), at(0, side)]);
        for ring in 0..rings - 1 {
            let [a, b] = [at(ring, side), at(ring, next)];
            let [c, d] = [at(ring + 1, side), at(ring + 1, next)];
            mesh.triangles.extend([[a, b, d], [a, d, c]]);
        }
        mesh.triangles.push([top, at(rings - 1, side), at(rings - 1, next)]);
    }
}

/// The polygon that is swept.
struct Ring {
    sides: u32,
    radius_m: f64,
}

impl Ring {
    /// A ring in the plane that halves the corner.
    fn mitred(
        &self,
        mesh: &mut Mesh,
        at: Point,
        before: Vector,
        after: Vector,
        across: Vector,
        of: usize,
    ) {
        let half = (before + after).normalize();
        let up = before.cross(&across);
        for side in 0..self.sides {
            let (sin, cos) = (TAU * f64::from(side) / f64::from(self.sides)).sin_cos();
            let out = across * cos + up * sin;
            // slid along the side's edge until it meets the plane
            let slid = out - before * (out.dot(&half) / before.dot(&half));
            let normal = (out - half * out.dot(&half)).normalize();
            mesh.add(at + slid * self.radius_m, normal, of);
        }
    }

    /// A ring of a half ball about `out`, number `k` of those from the equator to the tip, or the tip itself.
    fn cap(
        &self,
        mesh: &mut Mesh,
        at: Point,
        [out, across, up]: [Vector; 3],
        [k, rings]: [u32; 2],
        of: usize,
    ) {
        if k == rings {
            mesh.add(at + out * self.radius_m, out, of);
            return;
        }
        let (high, wide) = (FRAC_PI_2 * f64::from(k) / f64::from(rings)).sin_cos();
        for side in 0..self.sides {
            let (sin, cos) = (TAU * f64::from(side) / f64::from(self.sides)).sin_cos();
            let normal = (across * cos + up * sin) * wide + out * high;
            mesh.add(at + normal * self.radius_m, normal, of);
        }
    }
}

/// Radius of the polygon that is as large as a circle of radius 1.
fn equal_area(sides: u32) -> f64 {
    let step = TAU / f64::from(sides);
    (step / step.sin()).sqrt()
}

/// A unit vector across another.
fn any_across(along: &Vector) -> Vector {
    let hint = if along.z.abs() < 0.9 { Vector::z() } else { Vector::x() };
    (hint - along * hint.dot(along)).normalize()
}

/// A vector across one direction turned with it to the next, by the smallest turn.
fn transported(across: Vector, before: &Vector, after: &Vector) -> Vector {
    let axis = before.cross(after);
    let cos = before.dot(after);
    let turned = across * cos + axis.cross(&across) + axis * (axis.dot(&across) / (1.0 + cos));
    // rounding never adds up
    (turned - after * turned.dot(after)).try_normalize(1e-12).unwrap_or_else(|| any_across(after))
}
