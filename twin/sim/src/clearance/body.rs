//! A named body: solids that move as one.

use super::solid::Solid;
use crate::pose::{Point, Pose};
use crate::shape::Shape;

/// A named body.
#[derive(Clone)]
pub struct Body {
    pub(crate) name: String,
    pub(crate) solids: Vec<Solid>,
    /// Bounding sphere in body axes.
    pub(crate) centre: Point,
    pub(crate) radius_m: f64,
}

impl Body {
    pub(crate) fn new(name: &str, shapes: &[Shape]) -> Self {
        let solids: Vec<Solid> = shapes.iter().map(Solid::new).collect();
        let low =
            solids.iter().map(|s| s.reach.centre - nalgebra::Vector3::repeat(s.reach.radius_m));
        let high =
            solids.iter().map(|s| s.reach.centre + nalgebra::Vector3::repeat(s.reach.radius_m));
        let low = low.reduce(|a, b| a.inf(&b)).unwrap_or_else(Point::origin);
        let high = high.reduce(|a, b| a.sup(&b)).unwrap_or_else(Point::origin);
        let centre = nalgebra::center(&low, &high);
        let reach = |s: &Solid| (s.reach.centre - centre).norm() + s.reach.radius_m;
        let radius_m = solids.iter().map(reach).fold(0.0, f64::max);
        Self { name: name.to_owned(), solids, centre, radius_m }
    }

    /// What it is called.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Clearance to a bead whose axis is `piece`, with the body at `pose` in the same axes;
    /// infinite beyond `horizon_m`.
    ///
    /// Where the axis itself lies in the body the bead's radius is returned as overlap: it is at
    /// least that deep.
    pub fn to_bead(&self, pose: &Pose, piece: &[Point; 2], bead_m: f64, horizon_m: f64) -> f64 {
        let local = piece.map(|end| pose.inverse_transform_point(&end));
        let mut least_m = f64::INFINITY;
        for solid in &self.solids {
            let best_m = least_m.min(horizon_m);
            if solid.reach.to_line(&local) - bead_m <= best_m {
                let clearance_m = solid.to_line(&local, bead_m, best_m);
                if clearance_m <= best_m {
                    least_m = clearance_m;
                }
            }
        }
        least_m
    }

    /// Clearance to another body, or a lower bound of it where it is beyond `horizon_m`. Overlap is
    /// measured by the least translation that parts the two.
    ///
    /// The pair of solids whose bounds are nearest is measured first; others only where their
    /// bound is nearer than what was found.
    pub fn to_body(&self, pose: &Pose, other: &Self, other_pose: &Pose, horizon_m: f64) -> f64 {
        let relative = pose.inv_mul(other_pose);
        let apart_m = (relative * other.centre - self.centre).norm();
        let bound_m = apart_m - self.radius_m - other.radius_m;
        if bound_m > horizon_m {
            return bound_m;
        }
        let pairs = || {
            let seconds =
                other.solids.iter().map(|second| (second, second.reach.placed(&relative)));
            seconds.flat_map(|(second, reach)| {
                self.solids.iter().map(move |solid| (solid.reach.to(&reach), solid, second))
            })
        };
        let measure = |solid: &Solid, second: &Solid, best_m: f64| {
            solid.to_solid(pose, second, other_pose, best_m)
        };
        let Some((nearest_m, solid, second)) = pairs().min_by(|a, b| a.0.total_cmp(&b.0)) else {
            return f64::INFINITY;
        };
        let mut least_m = measure(solid, second, f64::INFINITY);
        for (bound_m, one, two) in pairs() {
            let measured = std::ptr::eq(one, solid) && std::ptr::eq(two, second);
            if bound_m < least_m && !measured {
                least_m = least_m.min(measure(one, two, least_m));
            }
        }
        debug_assert!(least_m < 0.0 || least_m >= nearest_m - 1e-9, "{least_m} under {nearest_m}");
        least_m
    }

    /// Bound on how far any point of the body moved between two poses, m.
    pub fn moved(&self, from: &Pose, to: &Pose) -> f64 {
        (to * self.centre - from * self.centre).norm()
            + from.rotation.angle_to(&to.rotation) * self.radius_m
    }
}
