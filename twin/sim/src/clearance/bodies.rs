//! The rigid bodies of a cell with their parry3d shapes and bounding spheres.

use parry3d::query::{self, ClosestPoints};
use parry3d::shape::{Segment, SharedShape};

use super::exact::{self, Triangle};
use crate::cell::Job;
use crate::parry;
use crate::pose::{Point, Pose, Vector};
use crate::shape::Shape;

/// A convex shape (or mesh) in the axes of its body.
pub(crate) struct Solid {
    shape: SharedShape,
    /// Its surface without the skin; empty for a mesh, which is not convex.
    triangles: Vec<Triangle>,
    /// Radius around that surface.
    skin_m: f64,
    /// Bounding sphere in body axes.
    centre: Point,
    radius_m: f64,
}

/// A named body.
pub(crate) struct Body {
    pub(crate) name: String,
    pub(crate) solids: Vec<Solid>,
    /// Bounding sphere in body axes.
    pub(crate) centre: Point,
    pub(crate) radius_m: f64,
}

/// A part of the tool.
pub(crate) struct ToolBody {
    pub(crate) nozzle: bool,
    pub(crate) body: Body,
}

/// A link of the arm.
pub(crate) struct LinkBody {
    pub(crate) carrier: Option<usize>,
    pub(crate) carrier_from_link: Pose,
    pub(crate) body: Body,
}

/// All bodies of a cell.
pub(crate) struct Bodies {
    pub(crate) tool: Vec<ToolBody>,
    pub(crate) links: Vec<LinkBody>,
    /// Pairs of links that are measured against each other.
    pub(crate) link_pairs: Vec<[usize; 2]>,
    /// Links the tool (or the bed, if that rides) is measured against: all but those that carry it.
    pub(crate) links_off_flange: Vec<usize>,
    pub(crate) bed: Body,
    /// World axes.
    pub(crate) obstacles: Vec<Body>,
    /// Part axes.
    pub(crate) forms: Vec<Body>,
}

impl Bodies {
    pub(crate) fn new(job: &Job) -> Self {
        let cell = &job.cell;
        let tool = cell
            .tool
            .parts
            .iter()
            .map(|part| ToolBody { nozzle: part.nozzle, body: Body::new(&part.name, &part.shapes) })
            .collect();
        let links: Vec<LinkBody> = cell
            .robot
            .links
            .iter()
            .map(|link| LinkBody {
                carrier: link.carrier,
                carrier_from_link: link.carrier_from_link,
                body: Body::new(&link.name, &link.shapes),
            })
            .collect();
        let n_joints = cell.robot.arm.chain.joints().len();
        // The tool is bolted to the last link and may touch it and the one before.
        let carries_tool =
            |link: &LinkBody| link.carrier.is_some_and(|joint| joint + 2 >= n_joints);
        Self {
            link_pairs: pairs(links.len(), &cell.robot.touching),
            links_off_flange: (0..links.len()).filter(|&k| !carries_tool(&links[k])).collect(),
            tool,
            links,
            bed: Body::new("bed", &[cell.bed.shape()]),
            obstacles: cell.obstacles.iter().map(|o| Body::new(&o.name, &o.shapes)).collect(),
            forms: job
                .forms
                .iter()
                .map(|form| {
                    let mesh = Shape::Mesh {
                        vertices: form.vertices.clone(),
                        triangles: form.triangles.clone(),
                    };
                    Body::new(&form.id, &[mesh])
                })
                .collect(),
        }
    }
}

fn pairs(n_links: usize, touching: &[[usize; 2]]) -> Vec<[usize; 2]> {
    (0..n_links)
        .flat_map(|i| (i + 1..n_links).map(move |j| [i, j]))
        .filter(|pair| touching.binary_search(pair).is_err())
        .collect()
}

impl Body {
    fn new(name: &str, shapes: &[Shape]) -> Self {
        let solids: Vec<Solid> = shapes.iter().map(Solid::new).collect();
        let corners: Vec<Point> = shapes.iter().flat_map(Shape::corners).collect();
        let skin_m = shapes.iter().map(Shape::skin_m).fold(0.0, f64::max);
        let (centre, radius_m) = sphere(&corners);
        Self { name: name.to_owned(), solids, centre, radius_m: radius_m + skin_m }
    }

    /// Clearance to a bead whose axis is `piece`, with the body at `pose` in the same axes;
    /// infinite beyond `horizon_m`.
    ///
    /// Where the axis itself lies in the body the bead's radius is returned as overlap: it is at
    /// least that deep.
    pub(crate) fn to_bead(
        &self,
        pose: &Pose,
        piece: &[Point; 2],
        bead_m: f64,
        horizon_m: f64,
    ) -> f64 {
        let reach_m = horizon_m + bead_m;
        let mut least = f64::INFINITY;
        let bead = Solid::line(piece);
        for solid in &self.solids {
            if to_piece(&(pose * solid.centre), piece) > reach_m + solid.radius_m {
                continue;
            }
            let distance_m = solid.distance_m(pose, &bead, &Pose::identity());
            least = least.min(distance_m.unwrap_or(f64::INFINITY) - bead_m);
        }
        least - parry::ROUNDING_M
    }

    /// Clearance to another body, or a lower bound of it where it is beyond `horizon_m`. Overlap is
    /// measured by the least translation that parts the two.
    ///
    /// Pairs of solids are taken by the gap of their bounding spheres, nearest first, until that
    /// gap alone is beyond what was found.
    pub(crate) fn to_body(
        &self,
        pose: &Pose,
        other: &Self,
        other_pose: &Pose,
        horizon_m: f64,
    ) -> f64 {
        let bound_m =
            gap(self.centre, self.radius_m, pose, other.centre, other.radius_m, other_pose);
        if bound_m > horizon_m {
            return bound_m;
        }
        let mut pairs: Vec<(f64, &Solid, &Solid)> = Vec::new();
        for solid in &self.solids {
            for second in &other.solids {
                let bound_m = gap(
                    solid.centre,
                    solid.radius_m,
                    pose,
                    second.centre,
                    second.radius_m,
                    other_pose,
                );
                pairs.push((bound_m, solid, second));
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (at, other_at) = (parry::pose(pose), parry::pose(other_pose));
        let mut least = f64::INFINITY;
        for (bound_m, solid, second) in pairs {
            if bound_m >= least {
                break;
            }
            let distance_m = solid.distance_m(pose, second, other_pose);
            let mut clearance_m = distance_m.unwrap_or(bound_m);
            if clearance_m <= 0.0
                && let Ok(Some(contact)) =
                    query::contact(&at, &*solid.shape, &other_at, &*second.shape, 0.0)
            {
                clearance_m = parry::from_length(contact.dist).min(0.0);
            }
            least = least.min(clearance_m);
        }
        least - parry::ROUNDING_M
    }

    /// Bound on how far any point of the body moved between two poses, m.
    pub(crate) fn moved(&self, from: &Pose, to: &Pose) -> f64 {
        (to * self.centre - from * self.centre).norm()
            + from.rotation.angle_to(&to.rotation) * self.radius_m
    }
}

impl Solid {
    fn new(shape: &Shape) -> Self {
        let (centre, radius_m) = sphere(&shape.corners());
        let (solid, skin_m) = (shape.to_parry(), shape.skin_m());
        let triangles = match (shape, solid.as_convex_polyhedron()) {
            (Shape::Capsule { a, b, .. }, _) => vec![[*a, *b, *b]],
            (_, Some(hull)) => {
                let (vertices, triangles) = hull.to_trimesh();
                let corner = |index: u32| parry::from_point(vertices[index as usize]);
                triangles.into_iter().map(|triangle| triangle.map(corner)).collect()
            }
            _ => Vec::new(),
        };
        Self { shape: solid, triangles, skin_m, centre, radius_m: radius_m + skin_m }
    }

    fn line(ends: &[Point; 2]) -> Self {
        let [a, b] = *ends;
        let shape = SharedShape::new(Segment::new(parry::point(&a), parry::point(&b)));
        let (centre, radius_m) = sphere(ends);
        Self { shape, triangles: vec![[a, b, b]], skin_m: 0.0, centre, radius_m }
    }

    /// Distance of two solids, never too long; zero where they overlap, `None` where parry3d
    /// cannot say. Its answer counts if the plane across it parts the two as far as it says.
    fn distance_m(&self, pose: &Pose, other: &Self, other_pose: &Pose) -> Option<f64> {
        let (at, other_at) = (parry::pose(pose), parry::pose(other_pose));
        let found =
            query::closest_points(&at, &*self.shape, &other_at, &*other.shape, f32::MAX).ok()?;
        let (from, to) = match found {
            ClosestPoints::Intersecting => return Some(0.0),
            ClosestPoints::Disjoint => return None,
            ClosestPoints::WithinMargin(from, to) => (from, to),
        };
        let distance_m = parry::at_least((to - from).length());
        if self.triangles.is_empty() || other.triangles.is_empty() {
            return Some(distance_m);
        }
        let direction = (parry::from_point(to) - parry::from_point(from)).try_normalize(1e-9);
        let parted_m = direction.map_or(0.0, |direction| {
            -self.furthest(pose, &direction) - other.furthest(other_pose, &-direction)
        });
        if parted_m + parry::ROUNDING_M >= distance_m {
            return Some(distance_m);
        }
        let apart_m = exact::distance(&self.placed(pose), &other.placed(other_pose));
        Some((apart_m - self.skin_m - other.skin_m).max(0.0))
    }

    /// How far the solid reaches along a unit direction, m.
    fn furthest(&self, pose: &Pose, direction: &Vector) -> f64 {
        let local = pose.inverse_transform_vector(direction);
        let corners = self.triangles.as_flattened().iter();
        let reach_m =
            corners.map(|corner| corner.coords.dot(&local)).fold(f64::NEG_INFINITY, f64::max);
        reach_m + pose.translation.vector.dot(direction) + self.skin_m
    }

    fn placed(&self, pose: &Pose) -> Vec<Triangle> {
        self.triangles.iter().map(|triangle| triangle.map(|corner| pose * corner)).collect()
    }
}

/// A sphere about the middle of the box of `points`.
fn sphere(points: &[Point]) -> (Point, f64) {
    let first = points.first().copied().unwrap_or_else(Point::origin);
    let (low, high) =
        points.iter().fold((first, first), |(low, high), p| (low.inf(p), high.sup(p)));
    let centre = nalgebra::center(&low, &high);
    (centre, points.iter().map(|p| (p - centre).norm()).fold(0.0, f64::max))
}

fn gap(a: Point, a_m: f64, a_pose: &Pose, b: Point, b_m: f64, b_pose: &Pose) -> f64 {
    (a_pose * a - b_pose * b).norm() - a_m - b_m
}

fn to_piece(point: &Point, piece: &[Point; 2]) -> f64 {
    let along = piece[1] - piece[0];
    let share = ((point - piece[0]).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE))
        .clamp(0.0, 1.0);
    (point - (piece[0] + along * share)).norm()
}
