//! One solid of a body: a convex core with a radius around it, or a mesh.

use parry3d::query;
use parry3d::shape::SharedShape;

use super::core::{Core, to_line};
use super::depth;
use super::gjk::{self, Gap};
use super::mesh::Mesh;
use super::tree::Node;
use crate::deposit::closest;
use crate::parry;
use crate::pose::{Point, Pose, Vector};
use crate::shape::Shape;

/// What coordinates of some metres lose in poses and products, m; taken off every clearance.
pub(super) const ROUNDING_M: f64 = 1e-12;

/// A shape in the axes of its body.
#[derive(Clone)]
pub(crate) struct Solid {
    form: Form,
    /// Radius around the core.
    skin_m: f64,
    /// Holds all of it, skin included.
    pub(super) reach: Reach,
    /// For the depth of an overlap.
    shape: SharedShape,
}

#[derive(Debug, Clone)]
enum Form {
    Convex(Core),
    Mesh(Mesh),
}

/// A ball and a rod that each hold something.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach {
    pub(super) centre: Point,
    pub(super) radius_m: f64,
    rod: [Point; 2],
    rod_m: f64,
}

impl Reach {
    /// Of a core with a radius around it.
    pub(super) fn of(core: &Core, skin_m: f64) -> Self {
        let (low, high) = core.bounds(&Pose::identity());
        let centre = nalgebra::center(&low, &high);
        let (rod, rod_m) = core.rod();
        let radius_m = core.furthest_from(&centre);
        Self { centre, radius_m: radius_m + skin_m, rod, rod_m: rod_m + skin_m }
    }

    pub(super) fn placed(&self, pose: &Pose) -> Self {
        Self { centre: pose * self.centre, rod: self.rod.map(|end| pose * end), ..*self }
    }

    /// Lower bound of the distance to all in a node, m.
    pub(super) fn to_node(self, node: &Node) -> f64 {
        let by_ball_m = node.to_point(&self.centre) - self.radius_m;
        let by_rod_m = to_line(&node.middle, &self.rod) - self.rod_m - node.radius_m;
        let bound_m = by_ball_m.max(by_rod_m);
        // Boxes that overlap do not bound how deep what is in them does.
        if bound_m > 0.0 { bound_m } else { f64::NEG_INFINITY }
    }

    /// Lower bound of the distance to a line, m.
    pub(super) fn to_line(self, ends: &[Point; 2]) -> f64 {
        (to_line(&self.centre, ends) - self.radius_m).max(lines_m(&self.rod, ends) - self.rod_m)
    }

    /// Lower bound of the distance to another, m.
    pub(super) fn to(&self, other: &Self) -> f64 {
        let by_ball_m = (self.centre - other.centre).norm() - self.radius_m - other.radius_m;
        by_ball_m.max(lines_m(&self.rod, &other.rod) - self.rod_m - other.rod_m)
    }
}

/// A lower bound of the distance of two lines, exact but for rounding where they are not alongside.
fn lines_m(first: &[Point; 2], second: &[Point; 2]) -> f64 {
    let across = across(first, second);
    let length_m = across.norm();
    // Lines that cross say nothing about how deep what is around them overlaps.
    if length_m <= 0.0 {
        return f64::NEG_INFINITY;
    }
    parted_m(first, second, &across, length_m)
}

/// From nearest point to nearest point.
fn across(first: &[Point; 2], second: &[Point; 2]) -> Vector {
    let [s, t] = closest(first, second);
    let at = |ends: &[Point; 2], share: f64| ends[0] + (ends[1] - ends[0]) * share;
    at(first, s) - at(second, t)
}

/// How far the planes across a direction part two lines, m.
fn parted_m(first: &[Point; 2], second: &[Point; 2], across: &Vector, length_m: f64) -> f64 {
    let along = |end: &Point| end.coords.dot(across);
    let near = along(&first[0]).min(along(&first[1]));
    (near - along(&second[0]).max(along(&second[1]))) / length_m
}

/// A − B along a direction, B in the axes of A by a pose.
fn difference<'a>(a: &'a Core, b: &'a Core, a_from_b: &Pose) -> impl Fn(&Vector) -> Vector + 'a {
    let turn = a_from_b.rotation.to_rotation_matrix();
    let offset = a_from_b.translation.vector;
    move |v| a.support(&-v) - (turn * b.support(&turn.inverse_transform_vector(v)) + offset)
}

/// Gap of two cores, the second in the axes of the first by a pose.
pub(super) fn apart(a: &Core, b: &Core, a_from_b: &Pose, start: Vector, beyond_m: f64) -> Gap {
    gjk::gap(difference(a, b, a_from_b), -start, f64::INFINITY, beyond_m)
}

/// How deep two overlapping cores are in each other, m, after the gap found them so.
pub(super) fn deep(a: &Core, b: &Core, a_from_b: &Pose, gap: &Gap) -> f64 {
    depth::depth(difference(a, b, a_from_b), &gap.simplex, -gap.least_m)
}

/// Gap of a core and a line in the same axes.
pub(super) fn from_line(core: &Core, line: &[Point; 2], start: Vector, beyond_m: f64) -> Gap {
    let [a, b] = line.map(|end| end.coords);
    let of_line = |v: &Vector| if a.dot(v) > b.dot(v) { a } else { b };
    let most_and_start = match core {
        Core::Line(ends) => {
            let across = across(ends, line);
            (across.norm(), across)
        }
        _ => (f64::INFINITY, start),
    };
    let (most_m, start) = most_and_start;
    gjk::gap(|v| core.support(&-v) - of_line(v), start, most_m, beyond_m)
}

impl Solid {
    pub(super) fn new(shape: &Shape) -> Self {
        let (form, skin_m, reach) = match (Core::of(shape), shape) {
            (None, Shape::Mesh { vertices, triangles }) if !triangles.is_empty() => {
                let mesh = Mesh::new(vertices, triangles);
                let reach = Reach::of(&mesh.hull(), 0.0);
                (Form::Mesh(mesh), 0.0, reach)
            }
            (core, _) => {
                let (core, skin_m) = core.unwrap_or((Core::Line([Point::origin(); 2]), 0.0));
                let reach = Reach::of(&core, skin_m);
                (Form::Convex(core), skin_m, reach)
            }
        };
        Self { form, skin_m, reach, shape: shape.to_parry() }
    }

    /// Clearance to a line with a radius around it in the same axes, m, or a lower bound of it
    /// beyond `beyond_m`. Where the line itself lies in the solid it is minus that radius.
    pub(super) fn to_line(&self, line: &[Point; 2], line_m: f64, beyond_m: f64) -> f64 {
        let skin_m = self.skin_m + line_m;
        let reach_m = beyond_m + skin_m + ROUNDING_M;
        let core_m = match &self.form {
            Form::Convex(core) => {
                let start = self.reach.centre - nalgebra::center(&line[0], &line[1]);
                from_line(core, line, start, reach_m).least_m.max(0.0)
            }
            Form::Mesh(mesh) => mesh.to_core(&Core::Line(*line), reach_m).max(0.0),
        };
        core_m - skin_m - ROUNDING_M
    }

    /// Clearance to another solid, m, or a lower bound of it beyond `beyond_m`. An overlap is
    /// measured by the least translation that parts the two.
    pub(super) fn to_solid(
        &self,
        pose: &Pose,
        other: &Self,
        other_pose: &Pose,
        beyond_m: f64,
    ) -> f64 {
        let skin_m = self.skin_m + other.skin_m;
        let reach_m = beyond_m + skin_m + ROUNDING_M;
        let relative = pose.inv_mul(other_pose);
        let core_m = match (&self.form, &other.form) {
            (Form::Convex(core), Form::Convex(second)) => {
                let start = relative * other.reach.centre - self.reach.centre;
                let gap = apart(core, second, &relative, start, reach_m);
                let overlap_m = || -deep(core, second, &relative, &gap);
                let core_m = if gap.overlaps() { overlap_m() } else { gap.least_m };
                return core_m - skin_m - ROUNDING_M;
            }
            (Form::Mesh(mesh), Form::Convex(core)) => {
                mesh.to_core(&core.placed(&relative), reach_m)
            }
            (Form::Convex(core), Form::Mesh(mesh)) => {
                mesh.to_core(&core.placed(&relative.inverse()), reach_m)
            }
            (Form::Mesh(mesh), Form::Mesh(other)) => mesh.to_mesh(other, &relative, reach_m),
        };
        if core_m > 0.0 {
            return core_m - skin_m - ROUNDING_M;
        }
        let (at, other_at) = (parry::pose(pose), parry::pose(other_pose));
        let depth_m = match query::contact(&at, &*self.shape, &other_at, &*other.shape, 0.0) {
            Ok(Some(contact)) => -parry::from_length(contact.dist) + parry::ROUNDING_M,
            _ => 0.0,
        };
        -depth_m.max(skin_m) - ROUNDING_M
    }
}
