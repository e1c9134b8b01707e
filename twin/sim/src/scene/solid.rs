//! A scene as primitives that can be drawn or hit: capsules, and triangles with smooth normals.
//!
//! The picture's rasteriser and the ray caster both start here, so they see the same surfaces.
//! Triangles of round shapes stand on a 64-sided outline, 0.12 % of the radius inside the circle.

use super::{Scene, Shape};
use crate::pose::{Point, Pose, Vector, from_z_axis, is_finite_point};
use parry3d::transformation::try_convex_hull;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Sides of the polygon that stands for a circle.
const SIDES: usize = 64;
/// Facets that meet at less than this angle are shaded as one smooth surface.
const CREASE_COS: f64 = 0.87;

/// What a ray met or a pixel shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum HitId {
    /// The plate that is printed on.
    Bed,
    /// Index in [`Scene::bodies`].
    Body(usize),
    /// Index in [`Scene::strands`].
    Strand(usize),
}

/// A capsule in world axes.
#[derive(Debug, Clone, Copy)]
pub struct Capsule {
    /// One end of the axis.
    pub a: Point,
    /// The other end.
    pub b: Point,
    /// Radius about the axis.
    pub radius_m: f64,
    /// What it belongs to.
    pub id: HitId,
}

/// A triangle in world axes with a unit normal at each corner.
#[derive(Debug, Clone, Copy)]
pub struct Triangle {
    /// Corners.
    pub points: [Point; 3],
    /// Normal of the smooth surface at each corner.
    pub normals: [Vector; 3],
    /// What it belongs to.
    pub id: HitId,
}

/// All primitives of a scene.
#[derive(Debug, Clone, Default)]
pub struct Solids {
    /// Strands, and the round parts of bodies.
    pub capsules: Vec<Capsule>,
    /// Everything else.
    pub triangles: Vec<Triangle>,
}

/// The primitives of those parts of the scene that `keep` wants.
///
/// Parts with a coordinate or radius that is not finite are left out.
pub fn solids(scene: &Scene, keep: impl Fn(HitId) -> bool) -> Solids {
    let mut out = Solids::default();
    if let Some(bed) = scene.bed.as_ref().filter(|_| keep(HitId::Bed)) {
        let plate = bed.body();
        add_shape(&mut out, &plate.shape, &plate.pose, HitId::Bed);
    }
    for (i, body) in scene.bodies.iter().enumerate().filter(|(i, _)| keep(HitId::Body(*i))) {
        add_shape(&mut out, &body.shape, &body.pose, HitId::Body(i));
    }
    for (i, strand) in scene.strands.iter().enumerate().filter(|(i, _)| keep(HitId::Strand(*i))) {
        let id = HitId::Strand(i);
        let radius_m = strand.radius_m;
        let segment = |w: &[Point]| Capsule { a: w[0], b: w[1], radius_m, id };
        out.capsules.extend(strand.points.windows(2).map(segment));
        if let [only] = strand.points[..] {
            out.capsules.push(Capsule { a: only, b: only, radius_m, id });
        }
    }
    out.keep_finite();
    out
}

/// The primitives of shapes in the axes of a body, placed by its pose; what is not finite is left out.
pub fn of_shapes(shapes: &[Shape], pose: &Pose) -> Solids {
    let mut out = Solids::default();
    shapes.iter().for_each(|shape| add_shape(&mut out, shape, pose, HitId::Body(0)));
    out.keep_finite();
    out
}

impl Solids {
    fn keep_finite(&mut self) {
        let whole = |c: &Capsule| is_finite_point(&c.a) && is_finite_point(&c.b);
        self.capsules.retain(|c| whole(c) && c.radius_m > 0.0 && c.radius_m.is_finite());
        self.triangles.retain(|t| {
            t.points.iter().all(is_finite_point)
                && t.normals.iter().all(|n| n.iter().all(|x| x.is_finite()))
        });
    }
}

fn add_shape(out: &mut Solids, shape: &Shape, pose: &Pose, id: HitId) {
    let capsule =
        |a: &Point, b: &Point, radius_m: f64| Capsule { a: pose * a, b: pose * b, radius_m, id };
    match shape {
        Shape::Capsule { a, b, radius_m } => out.capsules.push(capsule(a, b, *radius_m)),
        Shape::Cone { from, to, radius_from_m, radius_to_m } => {
            frustum(out, pose, (*from, *to), (*radius_from_m, *radius_to_m), id);
        }
        Shape::Box { half_m, pose: own } => {
            let corners = super::Bounds { min: (-half_m).into(), max: (*half_m).into() }.corners();
            hull(out, &(pose * own), &corners, id);
        }
        Shape::Hull { points } => hull(out, pose, points, id),
        Shape::Mesh { vertices, triangles } => mesh(out, pose, vertices, triangles, id),
    }
}

/// Side and both ends of a frustum.
fn frustum(out: &mut Solids, pose: &Pose, ends: (Point, Point), radii: (f64, f64), id: HitId) {
    let axis = ends.1 - ends.0;
    let length = axis.norm();
    if length.is_nan() || length <= 0.0 {
        return;
    }
    let about = pose * from_z_axis(ends.0, axis, Vector::x());
    let slope = (radii.0 - radii.1) / length;
    let out_at = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / SIDES as f64).sin_cos();
        Vector::new(cos, sin, 0.0)
    };
    let at = |r: f64, z: f64, k: usize| about * Point::from(out_at(k) * r + Vector::z() * z);
    let side_normal = |k: usize| about * (out_at(k) + Vector::z() * slope).normalize();
    for k in 0..SIDES {
        let (p, q) = (at(radii.0, 0.0, k), at(radii.0, 0.0, k + 1));
        let (s, t) = (at(radii.1, length, k), at(radii.1, length, k + 1));
        let (np, nq) = (side_normal(k), side_normal(k + 1));
        let (down, up) = (about * -Vector::z(), about * Vector::z());
        let (bottom, top) = (about * Point::origin(), about * Point::new(0.0, 0.0, length));
        for (points, normals) in [
            ([p, q, t], [np, nq, nq]),
            ([p, t, s], [np, nq, np]),
            ([bottom, q, p], [down; 3]),
            ([top, s, t], [up; 3]),
        ] {
            out.triangles.push(Triangle { points, normals, id });
        }
    }
}

/// The convex hull with flat faces; nothing where the points span no volume.
fn hull(out: &mut Solids, pose: &Pose, points: &[Point], id: HitId) {
    // about the first point: parry works in f32
    let Some(first) = points.first().copied() else { return };
    let near: Vec<parry3d::math::Vector> = points
        .iter()
        .map(|p| p - first)
        .map(|d| parry3d::math::Vector::new(d.x as f32, d.y as f32, d.z as f32))
        .collect();
    if near.len() < 4 || near.iter().any(|p| !p.is_finite()) {
        return;
    }
    let Ok((corners, faces)) = try_convex_hull(&near) else { return };
    let back = |p: &parry3d::math::Vector| {
        first + Vector::new(f64::from(p.x), f64::from(p.y), f64::from(p.z))
    };
    let corners: Vec<Point> = corners.iter().map(back).collect();
    mesh(out, pose, &corners, &faces, id);
}

/// A mesh whose corners are smoothed where facets meet at a small angle.
fn mesh(out: &mut Solids, pose: &Pose, vertices: &[Point], faces: &[[u32; 3]], id: HitId) {
    let corner = |i: u32| vertices.get(i as usize).copied();
    let facets: Vec<([Point; 3], Vector)> = faces
        .iter()
        .filter_map(|&[i, j, k]| Some([corner(i)?, corner(j)?, corner(k)?]))
        .map(|p| (p, (p[1] - p[0]).cross(&(p[2] - p[0]))))
        .filter(|(_, n)| n.norm() > 0.0)
        .collect();
    // by place and not by index: STL files share no corners. Adding 0.0 makes one zero of two.
    let key = |p: &Point| [p.x, p.y, p.z].map(|x| ((x + 0.0) as f32).to_bits());
    let mut around: BTreeMap<[u32; 3], Vec<usize>> = BTreeMap::new();
    for (f, (points, _)) in facets.iter().enumerate() {
        for p in points {
            around.entry(key(p)).or_default().push(f);
        }
    }
    for (points, normal) in &facets {
        let unit = normal.normalize();
        let smooth = |p: &Point| {
            let near = around.get(&key(p)).into_iter().flatten().map(|&f| facets[f].1);
            let sum: Vector = near.filter(|n| n.normalize().dot(&unit) > CREASE_COS).sum();
            pose * sum.try_normalize(0.0).unwrap_or(unit)
        };
        let normals = [smooth(&points[0]), smooth(&points[1]), smooth(&points[2])];
        out.triangles.push(Triangle { points: points.map(|p| pose * p), normals, id });
    }
}
