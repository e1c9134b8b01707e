//! Energy, mass matrix and forward dynamics.

use nalgebra::{DMatrix, DVector};

use super::model::{JointVector, Model};
use crate::kinematics::JointKind;
use crate::pose::{Pose, Vector};

impl Model {
    /// Kinetic energy, J: `Σ ½ m v_c² + ½ ωᵀ I ω`, in base axes, sharing nothing with
    /// [`Model::torques`] but the masses.
    pub fn kinetic_energy_j(&self, q: &[f64], qd: &[f64]) -> f64 {
        let mut pose = Pose::identity();
        let (mut velocity, mut omega) = (Vector::zeros(), Vector::zeros());
        let mut energy: f64 =
            self.rotors.iter().zip(qd).map(|(rotor, qd)| 0.5 * rotor * qd * qd).sum();
        for joint in &self.joints {
            let before = pose.translation.vector;
            pose *= joint.pose(joint.value(q));
            velocity += omega.cross(&(pose.translation.vector - before));
            let along = pose.rotation * joint.axis * joint.rate(qd);
            match joint.kind {
                JointKind::Revolute => omega += along,
                JointKind::Prismatic => velocity += along,
            }
            let of_centre = velocity + omega.cross(&(pose.rotation * joint.body.centre));
            let spin = pose.rotation.inverse_transform_vector(&omega);
            energy += 0.5 * joint.body.mass_kg * of_centre.norm_squared();
            energy += 0.5 * spin.dot(&(joint.body.inertia * spin));
        }
        energy
    }

    /// Energy of position, J: `−Σ m g·c`, zero where all mass is at the base's origin.
    pub fn potential_energy_j(&self, q: &[f64]) -> f64 {
        let mut pose = Pose::identity();
        let mut energy = 0.0;
        for joint in &self.joints {
            pose *= joint.pose(joint.value(q));
            let centre = pose.transform_point(&joint.body.centre.into()).coords;
            energy -= joint.body.mass_kg * self.gravity.dot(&centre);
        }
        energy
    }

    /// Mass matrix `M(q)`, n×n, kg m² (kg for sliding joints): column j is what it takes to
    /// accelerate joint j alone, at rest and without gravity. Symmetric and positive definite.
    pub fn mass_matrix(&self, q: &[f64]) -> DMatrix<f64> {
        let still = JointVector::zeros(self.dof);
        let mut matrix = DMatrix::zeros(self.dof, self.dof);
        for column in 0..self.dof {
            let mut unit = still;
            unit[column] = 1.0;
            let torques = self.recursion(q, &still, &unit, Vector::zeros(), None);
            matrix.set_column(column, &DVector::from_column_slice(&torques));
        }
        // Rounding leaves the two halves some 1e-17 apart.
        (&matrix + matrix.transpose()) * 0.5
    }

    /// Accelerations under given torques, rad/s² or m/s²: `q̈ = M⁻¹ (τ − C q̇ − τ_g)`; `None` where
    /// the mass matrix is singular (a joint that moves no mass).
    pub fn accelerations(&self, q: &[f64], qd: &[f64], torques: &[f64]) -> Option<JointVector> {
        let still = JointVector::zeros(self.dof);
        let bias = self.recursion(q, qd, &still, self.gravity, None);
        let surplus = DVector::from_iterator(
            self.dof,
            torques.iter().zip(bias.iter()).map(|(torque, bias)| torque - bias),
        );
        let factors = self.mass_matrix(q).cholesky()?;
        Some(JointVector::new(factors.solve(&surplus).as_slice()))
    }
}
