//! How the tip moves with each entry of `q`.

use nalgebra::{Matrix6xX, Vector6};

use super::chain::{Chain, JointKind, advance};
use crate::pose::{Pose, Vector};

impl Chain {
    /// Geometric Jacobian, 6×n; rows `vx vy vz wx wy wz` at the tip in base axes, m/rad and
    /// rad/rad (m/m for sliding joints). Followers add to their master's column.
    pub fn jacobian(&self, q: &[f64]) -> Matrix6xX<f64> {
        let mut columns = vec![Vector6::zeros(); self.dof()];
        self.jacobian_into(q, &mut columns);
        Matrix6xX::from_columns(&columns)
    }

    /// The same without allocation: column by column into `columns` (at least [`Chain::dof`] of
    /// them); returns the tip in base.
    ///
    /// Law: a joint with axis `w` through `o` adds `(w × (p − o), w)`, a sliding one `(w, 0)`.
    /// Columns are first written at the base's origin, as `(o × w, w)`, then moved to the tip `p`,
    /// so one walk along the chain is enough.
    pub fn jacobian_into(&self, q: &[f64], columns: &mut [Vector6<f64>]) -> Pose {
        let columns = &mut columns[..self.dof()];
        columns.fill(Vector6::zeros());
        let mut pose = Pose::identity();
        for (joint, drive) in self.joints().iter().zip(&self.drives) {
            pose *= joint.parent_from_joint;
            let axis = pose.rotation * joint.axis;
            let (linear, angular) = match joint.kind {
                JointKind::Revolute => (pose.translation.vector.cross(&axis), axis),
                JointKind::Prismatic => (axis, Vector::zeros()),
            };
            add(&mut columns[drive.axis], &linear, &angular, drive.multiplier);
            advance(&mut pose, joint, drive.value(q));
        }
        pose *= *self.last_from_tip();
        for column in columns {
            let angular = Vector::new(column[3], column[4], column[5]);
            add(column, &angular.cross(&pose.translation.vector), &Vector::zeros(), 1.0);
        }
        pose
    }
}

fn add(column: &mut Vector6<f64>, linear: &Vector, angular: &Vector, factor: f64) {
    for row in 0..3 {
        column[row] += factor * linear[row];
        column[row + 3] += factor * angular[row];
    }
}
