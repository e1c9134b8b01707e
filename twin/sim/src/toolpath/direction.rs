//! Where the nozzle points along a strand.

use parry3d::query::PointQuery;
use parry3d::shape::TriMesh;

use crate::cell::{Follow, Form, On, Orientation, Strand, Tilt};
use crate::parry;
use crate::pose::{Point, Vector};

/// What decides the nozzle's axis besides the strand: up and x of the bed, the forms' surfaces.
pub(super) struct Surroundings<'a> {
    pub(super) up: Vector,
    pub(super) bed_x: Vector,
    pub(super) forms: &'a Forms,
}

impl Surroundings<'_> {
    /// Nozzle axis at one place of a strand.
    pub(super) fn nozzle_axis(&self, strand: &Strand, point: Point, tangent: Vector) -> Vector {
        let orientation = &strand.settings.orientation;
        match (orientation.follow, strand.on) {
            (Follow::Tangent, _) => tilted(tangent, self.up, self.bed_x, orientation),
            (Follow::SurfaceNormal, On::Form(form)) => -self.forms.normal(form, point),
            _ => -self.up,
        }
    }
}

/// Nozzle axis that trails a strand of direction `tangent` as far as the tilt allows.
///
/// ```text
/// tilt(ψ) = min(max(ψ − from, 0), max)        ψ: angle between strand and up
/// ```
///
/// The nozzle stays vertical up to `from`, then follows with that lag until `max`. *Cone* applies
/// the law to the one angle; *per axis* to the angles about the bed's x and y apart.
///
/// # Units
/// `tangent`, `up`, `bed_x`: unit vectors; result: unit, out of the nozzle
///
/// # Source
/// Kirkman et al. 2019, inclination control active from 20°, 40° at most; the law between is ours.
pub fn tilted(tangent: Vector, up: Vector, bed_x: Vector, orientation: &Orientation) -> Vector {
    let law = |psi: f64| (psi - orientation.tilt_from_rad).clamp(0.0, orientation.tilt_max_rad);
    match orientation.tilt {
        Tilt::Cone => {
            let across = tangent - up * tangent.dot(&up);
            if across.norm() < 1e-9 {
                return -up;
            }
            let tilt = law(tangent.angle(&up));
            -(up * tilt.cos() + across.normalize() * tilt.sin())
        }
        Tilt::PerAxis => {
            let bed_y = up.cross(&bed_x);
            let part = |axis: Vector| {
                let angle = tangent.dot(&axis).atan2(tangent.dot(&up).max(0.0));
                axis * (law(angle.abs()).tan() * angle.signum())
            };
            -(up + part(bed_x) + part(bed_y)).normalize()
        }
    }
}

/// The surfaces of the forms.
pub struct Forms {
    meshes: Vec<Option<TriMesh>>,
    up: Vector,
}

impl Forms {
    /// `up`: unit, out of the bed.
    pub fn new(forms: &[Form], up: Vector) -> Self {
        let mesh = |form: &Form| {
            TriMesh::new(form.vertices.iter().map(parry::point).collect(), form.triangles.clone())
                .ok()
        };
        Self { meshes: forms.iter().map(mesh).collect(), up }
    }

    /// Normal of the facet nearest to `point`, turned to the upper side; up where there is none.
    fn normal(&self, form: usize, point: Point) -> Vector {
        self.nearest(form, point).map_or(self.up, |(normal, _)| normal)
    }

    /// Normal of the facet nearest to `point`, turned to the upper side, and how far the point is from it, m
    /// (f32 of parry: a micrometre); `None` where there is no surface.
    pub fn nearest(&self, form: usize, point: Point) -> Option<(Vector, f64)> {
        let mesh = self.meshes.get(form).and_then(Option::as_ref)?;
        let projected = mesh.project_local_point(parry::point(&point), false);
        let triangle = mesh.triangle(projected.subshape);
        let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(parry::from_point);
        let normal = (b - a).cross(&(c - a));
        let far_m = (parry::from_point(projected.point) - point).norm();
        let normal = if normal.norm() < 1e-15 { self.up } else { normal.normalize() };
        Some((normal * if normal.dot(&self.up) < 0.0 { -1.0 } else { 1.0 }, far_m))
    }
}
