//! The two-node beam: stiffness, weight and initial strain in the axes of the part.

use nalgebra::{Matrix3, SMatrix, SVector};

use super::frame::{Frame, Member};
use crate::pose::{Point, Vector};

/// Stiffness of a member; rows and columns are the freedoms of its first, then its second node.
pub(crate) type Matrix12 = SMatrix<f64, 12, 12>;
/// Freedoms or forces of a member, in the same order.
pub(crate) type Vector12 = SVector<f64, 12>;

/// A member made ready: nothing in it depends on the stage.
#[derive(Debug, Clone)]
pub(crate) struct Beam {
    pub(crate) length_m: f64,
    /// Columns are x, y, z of the member.
    pub(crate) axes: Matrix3<f64>,
    /// Mass per length, kg/m.
    pub(crate) line_kg_per_m: f64,
    /// `φ = 12 E I/(κ G A L²)` of bending towards y, and towards z; 0 without shear.
    pub(crate) shear_share: [f64; 2],
    /// Stiffness in the axes of the part, N/m, N, N m.
    pub(crate) stiffness: Matrix12,
    /// Loads at the nodes that do what the initial strain does: `E A ε₀ (-x, 0, +x, 0)`.
    pub(crate) strain_load: Vector12,
}

/// All members of a frame, made ready.
pub(crate) fn beams(frame: &Frame) -> Vec<Beam> {
    frame.members().iter().map(|member| Beam::new(frame, member)).collect()
}

impl Beam {
    fn new(frame: &Frame, member: &Member) -> Self {
        let [from, to] = member.ends.map(|node| frame.nodes()[node]);
        let along = to - from;
        let length_m = along.norm();
        let axes = member_axes(along / length_m, member.side);
        let pull_n = member.elastic.e_pa * member.section.area_m2 * member.initial_strain;
        let mut strain_load = Vector12::zeros();
        for axis in 0..3 {
            strain_load[axis] = -pull_n * axes[(axis, 0)];
            strain_load[6 + axis] = pull_n * axes[(axis, 0)];
        }
        Self {
            length_m,
            axes,
            line_kg_per_m: member.density_kg_m3 * member.section.area_m2,
            shear_share: [member.section.iz_m4, member.section.iy_m4]
                .map(|second_moment_m4| shear_share(member, second_moment_m4, length_m)),
            stiffness: turned(&local_stiffness(member, length_m), &axes),
            strain_load,
        }
    }

    /// Weight per length, N/m.
    pub(crate) fn line_load(&self, gravity_m_s2: [f64; 3]) -> Vector {
        Vector::from(gravity_m_s2) * self.line_kg_per_m
    }

    /// Consistent loads of the uniform weight w: `(w L/2, x × w L²/12, w L/2, -x × w L²/12)`.
    ///
    /// Exact at the nodes, with or without shear (the fixed-end moments are symmetric), and free of
    /// the member's own y and z.
    pub(crate) fn weight_load(&self, gravity_m_s2: [f64; 3]) -> Vector12 {
        self.line_ends(self.line_load(gravity_m_s2))
    }

    /// The same of any uniform line load, N/m.
    pub(crate) fn line_ends(&self, line: Vector) -> Vector12 {
        let force = line * (self.length_m / 2.0);
        let moment = self.axes.column(0).cross(&line) * (self.length_m.powi(2) / 12.0);
        let mut load = Vector12::zeros();
        load.fixed_rows_mut::<3>(0).copy_from(&force);
        load.fixed_rows_mut::<3>(3).copy_from(&moment);
        load.fixed_rows_mut::<3>(6).copy_from(&force);
        load.fixed_rows_mut::<3>(9).copy_from(&-moment);
        load
    }
}

/// Right-handed axes as columns. Where `side` gives no direction across, the coordinate axis most
/// across the member takes its place: no direction of a member is special.
fn member_axes(x: Vector, side: Vector) -> Matrix3<f64> {
    let across = side - x * x.dot(&side);
    let y = if across.norm() > 1e-9 * side.norm() {
        across.normalize()
    } else {
        let mut axis = Vector::zeros();
        axis[x.iamin()] = 1.0;
        (axis - x * x.dot(&axis)).normalize()
    };
    Matrix3::from_columns(&[x, y, x.cross(&y)])
}

/// Stiffness in the member's own axes (Przemieniecki, Theory of Matrix Structural Analysis, 5.6).
///
/// With `φ = 12 E I/(κ G A L²)`: `12 E I/((1+φ) L³)`, `6 E I/((1+φ) L²)`, `(4+φ) E I/((1+φ) L)`,
/// `(2-φ) E I/((1+φ) L)`; axial `E A/L`, torsion `G J/L`. Exact for uniform straight beams loaded at
/// their nodes.
pub(crate) fn local_stiffness(member: &Member, length_m: f64) -> Matrix12 {
    let (section, elastic, l) = (member.section, member.elastic, length_m);
    let mut k = Matrix12::zeros();
    couple(&mut k, 0, elastic.e_pa * section.area_m2 / l);
    couple(&mut k, 3, elastic.g_pa * section.j_m4 / l);
    // in x-y a positive turn about z lifts the far end along y; in x-z a turn about y lowers z
    let planes = [(1, 5, section.iz_m4, 1.0), (2, 4, section.iy_m4, -1.0)];
    for (shift, turn, second_moment_m4, sign) in planes {
        let ei = elastic.e_pa * second_moment_m4;
        let phi = shear_share(member, second_moment_m4, l);
        let b = ei / ((1.0 + phi) * l);
        couple(&mut k, shift, 12.0 * b / (l * l));
        let cross = sign * 6.0 * b / l;
        for (row, column, value) in [
            (shift, turn, cross),
            (shift, turn + 6, cross),
            (shift + 6, turn, -cross),
            (shift + 6, turn + 6, -cross),
            (turn, turn + 6, (2.0 - phi) * b),
        ] {
            k[(row, column)] = value;
            k[(column, row)] = value;
        }
        k[(turn, turn)] = (4.0 + phi) * b;
        k[(turn + 6, turn + 6)] = (4.0 + phi) * b;
    }
    k
}

/// `φ = 12 E I/(κ G A L²)`: what shear adds to bending.
fn shear_share(member: &Member, second_moment_m4: f64, length_m: f64) -> f64 {
    let Member { section, elastic, .. } = member;
    let bending = 12.0 * (elastic.e_pa * second_moment_m4);
    bending / (section.shear_kappa * elastic.g_pa * section.area_m2 * length_m * length_m)
}

/// A spring between the same freedom of both nodes.
fn couple(k: &mut Matrix12, freedom: usize, stiffness: f64) {
    k[(freedom, freedom)] = stiffness;
    k[(freedom + 6, freedom + 6)] = stiffness;
    k[(freedom, freedom + 6)] = -stiffness;
    k[(freedom + 6, freedom)] = -stiffness;
}

/// `T k Tᵀ` with T four times the axes on the diagonal, made exactly symmetric.
pub(crate) fn turned(local: &Matrix12, axes: &Matrix3<f64>) -> Matrix12 {
    let mut k = Matrix12::zeros();
    for row in (0..12).step_by(3) {
        for column in (0..12).step_by(3) {
            let block = axes * local.fixed_view::<3, 3>(row, column) * axes.transpose();
            k.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
        }
    }
    (k + k.transpose()) * 0.5
}

/// Displacement at a share of a member's length, m, by translations and turns of its ends: straight along its axis, across it
/// the cubic of an unloaded beam.
pub(crate) fn displacement_along(ends: [Point; 2], moved: [[f64; 6]; 2], share: f64) -> Vector {
    let axis = ends[1] - ends[0];
    let x = axis.normalize();
    let u = moved.map(|six| Vector::new(six[0], six[1], six[2]));
    let slope = moved.map(|six| Vector::new(six[3], six[4], six[5]).cross(&axis));
    let s = share;
    let far = s * s * (3.0 - 2.0 * s);
    let across = u[0] * (1.0 - far)
        + u[1] * far
        + slope[0] * (s * (1.0 - s).powi(2))
        + slope[1] * (s * s * (s - 1.0));
    let straight = u[0] * (1.0 - s) + u[1] * s;
    across + x * (straight - across).dot(&x)
}
