//! Rays through a scene: a parry3d tree over capsules and triangles.
//!
//! The tree is f32 about the scene's middle, with boxes a little too big; the hits themselves are
//! closed forms in f64. parry3d's own capsule would go through GJK, which is slower and rounder.

use super::solid::{Capsule, HitId, Solids, Triangle, solids};
use super::{Bounds, Scene};
use crate::pose::{Point, Vector};
use parry3d::bounding_volume::Aabb;
use parry3d::math::Vector as Vec32;
use parry3d::partitioning::{Bvh, BvhBuildStrategy};
use parry3d::query::Ray;

/// What the boxes of the tree are widened by, relative to the scene's extent, so that f32 loses no hit.
const LOOSE: f64 = 4e-7;

/// A scene made ready for rays.
pub struct Caster {
    solids: Solids,
    tree: Bvh,
    middle: Point,
}

/// Where a ray first meets something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Along the ray, m.
    pub distance_m: f64,
    /// Unit normal of the surface, turned towards where the ray came from.
    pub normal: Vector,
    /// What was met.
    pub what: HitId,
}

impl Caster {
    /// Everything in the scene.
    pub fn new(scene: &Scene) -> Caster {
        Caster::of(solids(scene, |_| true))
    }

    /// Given primitives only.
    pub fn of(solids: Solids) -> Caster {
        let boxes: Vec<Bounds> = solids
            .capsules
            .iter()
            .map(capsule_box)
            .chain(solids.triangles.iter().filter_map(|t| Bounds::of(t.points)))
            .collect();
        let all = Bounds::of(boxes.iter().flat_map(|b| [b.min, b.max]));
        let (middle, extent) =
            all.map_or((Point::origin(), 0.0), |b| (b.centre(), b.size().norm()));
        let loose = Vector::repeat(extent * LOOSE + f64::from(f32::MIN_POSITIVE));
        let leaves: Vec<Aabb> = boxes
            .iter()
            .map(|b| Aabb::new(narrow(b.min - middle - loose), narrow(b.max - middle + loose)))
            .collect();
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &leaves);
        Caster { solids, tree, middle }
    }

    /// First thing that the ray meets; `None` where there is none or the ray has no direction.
    ///
    /// A ray that starts inside a capsule does not see that capsule.
    pub fn cast(&self, origin: Point, direction: Vector) -> Option<Hit> {
        let direction = direction.try_normalize(0.0)?;
        if self.tree.is_empty() {
            return None;
        }
        let ray = Ray::new(narrow(origin - self.middle), narrow(direction));
        // the tree prunes by f32 distances: hand it a distance a little long, keep the exact one here
        let slack = 1.0 + 1e-5;
        let meet = |leaf: u32, _| {
            self.meet(leaf, origin, direction).map(|(t, _)| (t * slack) as f32 + 1e-6)
        };
        let (leaf, _) = self.tree.cast_ray(&ray, f32::MAX, meet)?;
        let (distance_m, normal) = self.meet(leaf, origin, direction)?;
        let normal = if normal.dot(&direction) > 0.0 { -normal } else { normal };
        Some(Hit { distance_m, normal, what: self.id(leaf) })
    }

    fn meet(&self, leaf: u32, origin: Point, direction: Vector) -> Option<(f64, Vector)> {
        let i = leaf as usize;
        match self.solids.capsules.get(i) {
            Some(capsule) => meet_capsule(capsule, origin, direction),
            None => meet_triangle(
                &self.solids.triangles[i - self.solids.capsules.len()],
                origin,
                direction,
            ),
        }
    }

    fn id(&self, leaf: u32) -> HitId {
        let i = leaf as usize;
        match self.solids.capsules.get(i) {
            Some(capsule) => capsule.id,
            None => self.solids.triangles[i - self.solids.capsules.len()].id,
        }
    }
}

fn narrow(v: impl Into<Vector>) -> Vec32 {
    let v: Vector = v.into();
    Vec32::new(v.x as f32, v.y as f32, v.z as f32)
}

fn capsule_box(c: &Capsule) -> Bounds {
    let r = Vector::repeat(c.radius_m);
    Bounds { min: c.a.inf(&c.b) - r, max: c.a.sup(&c.b) + r }
}

/// Distance and outward normal where a ray enters a capsule.
///
/// Nearest root of `|o + t d - axis|² = r²` on the bar between the ends, else on the ball at the end
/// it leaves by. `direction` is a unit vector.
fn meet_capsule(c: &Capsule, origin: Point, direction: Vector) -> Option<(f64, Vector)> {
    // from the foot of the capsule, so that a far ray origin costs no digits
    let ahead = (c.a - origin).dot(&direction);
    let o = origin + direction * ahead;
    let (axis, from_a) = (c.b - c.a, o - c.a);
    let (len2, along) = (axis.norm_squared(), axis.dot(&direction));
    let (along_a, r2) = (axis.dot(&from_a), c.radius_m * c.radius_m);
    let ball = |centre: Point| {
        let from = o - centre;
        let half = direction.dot(&from);
        let disc = half * half - from.norm_squared() + r2;
        (disc >= 0.0).then(|| -half - disc.sqrt())
    };
    let a = len2 - along * along;
    let t = if a > 1e-12 * len2 {
        let b = len2 * direction.dot(&from_a) - along_a * along;
        let k = len2 * from_a.norm_squared() - along_a * along_a - r2 * len2;
        let disc = b * b - a * k;
        if disc < 0.0 {
            return None;
        }
        let t = (-b - disc.sqrt()) / a;
        let y = along_a + t * along;
        if y <= 0.0 {
            ball(c.a)?
        } else if y >= len2 {
            ball(c.b)?
        } else {
            t
        }
    } else {
        ball(if along > 0.0 { c.a } else { c.b })?
    };
    let distance = t + ahead;
    if distance < 0.0 {
        return None;
    }
    let at = o + direction * t;
    let foot = if len2 > 0.0 { ((at - c.a).dot(&axis) / len2).clamp(0.0, 1.0) } else { 0.0 };
    Some((distance, (at - (c.a + axis * foot)) / c.radius_m))
}

/// Distance and smooth normal where a ray crosses a triangle, from either side (Möller and Trumbore 1997).
fn meet_triangle(t: &Triangle, origin: Point, direction: Vector) -> Option<(f64, Vector)> {
    let (e1, e2) = (t.points[1] - t.points[0], t.points[2] - t.points[0]);
    let p = direction.cross(&e2);
    let det = e1.dot(&p);
    if det == 0.0 {
        return None;
    }
    let s = origin - t.points[0];
    let u = s.dot(&p) / det;
    let q = s.cross(&e1);
    let v = direction.dot(&q) / det;
    let distance = e2.dot(&q) / det;
    // a hair over the edge, so that no ray slips between two triangles that share it
    let hair = 1e-9;
    if u < -hair || v < -hair || u + v > 1.0 + hair || distance < 0.0 || !distance.is_finite() {
        return None;
    }
    let normal = t.normals[0] * (1.0 - u - v) + t.normals[1] * u + t.normals[2] * v;
    Some((distance, normal.try_normalize(0.0)?))
}
