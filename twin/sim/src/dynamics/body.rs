//! A rigid body as dynamics sees it: mass, centre, inertia.

use nalgebra::Matrix3;

use crate::pose::{Pose, Vector};

/// Mass of a rigid body. In which axes is said where one is used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Centre of mass, m.
    pub centre: Vector,
    /// Inertia about the centre of mass, kg m²: `I = Σ m (r·r 1 − r rᵀ)`, so products of inertia
    /// stand in it with a minus sign, as in URDF.
    pub inertia: Matrix3<f64>,
}

impl Body {
    /// Nothing.
    pub fn none() -> Self {
        Self::point(0.0, Vector::zeros())
    }

    /// A point.
    pub fn point(mass_kg: f64, centre: Vector) -> Self {
        Self { mass_kg, centre, inertia: Matrix3::zeros() }
    }

    /// A full box of edge lengths `size_m` about the origin of `pose`.
    pub fn cuboid(mass_kg: f64, size_m: Vector, pose: &Pose) -> Self {
        let squared = size_m.component_mul(&size_m);
        let principal = Vector::repeat(squared.sum()) - squared;
        let inertia = Matrix3::from_diagonal(&(principal * (mass_kg / 12.0)));
        Self { mass_kg, centre: Vector::zeros(), inertia }.seen_from(pose)
    }

    /// A thin rod, such as a segment of a strand.
    pub fn rod(mass_kg: f64, from: Vector, to: Vector) -> Self {
        let along = to - from;
        let inertia = spread(along) * (mass_kg / 12.0);
        Self { mass_kg, centre: (from + to) / 2.0, inertia }
    }

    /// The same body in other axes; `new_from_own` is the pose of its axes in the new ones.
    #[must_use]
    pub fn seen_from(&self, new_from_own: &Pose) -> Self {
        let rotation = new_from_own.rotation.to_rotation_matrix().into_inner();
        Self {
            mass_kg: self.mass_kg,
            centre: new_from_own.transform_point(&self.centre.into()).coords,
            inertia: rotation * self.inertia * rotation.transpose(),
        }
    }

    /// Both bodies joined rigidly, in the axes they share.
    ///
    /// Law: `I = I₁ + I₂ + μ (d·d 1 − d dᵀ)` with `d` between the centres, `μ = m₁ m₂/(m₁ + m₂)`.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        let mass_kg = self.mass_kg + other.mass_kg;
        if !(mass_kg > 0.0) {
            return Self { inertia: self.inertia + other.inertia, ..*self };
        }
        let between = other.centre - self.centre;
        let reduced_kg = self.mass_kg * other.mass_kg / mass_kg;
        Self {
            mass_kg,
            centre: self.centre + between * (other.mass_kg / mass_kg),
            inertia: self.inertia + other.inertia + spread(between) * reduced_kg,
        }
    }
}

/// `r·r 1 − r rᵀ`.
fn spread(r: Vector) -> Matrix3<f64> {
    Matrix3::from_diagonal_element(r.norm_squared()) - r * r.transpose()
}
