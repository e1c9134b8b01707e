//! Geometric stiffness: what an axial force adds to the stiffness of a beam.

use super::beam::Matrix12;
use super::frame::Member;

/// Geometric stiffness of a straight part of a member under a unit tension, in its own axes, 1/m
/// and m (times N: N/m and N m). Compression makes it negative.
///
/// Bending: `N ∫ v'² dx` in both planes, with the shapes that the part itself takes (cubic, bent
/// and sheared). With `φ = 12 E I/(κ G A L²)` and `s = 1/(1+φ)²`:
/// `(6/5 + 2φ + φ²) s/L`, `s/10`, `(2/15 + φ/6 + φ²/12) s L`, `-(1/30 + φ/6 + φ²/12) s L`.
/// For φ = 0 the matrix in every textbook (Przemieniecki 15.2; McGuire, Gallagher, Ziemian 9.2).
/// The force works on the slope of the axis, as Engesser has it.
///
/// Twist (`with_twist`): `N (I_y + I_z)/A ∫ ϑ'² dx`, linear ϑ: fibres of a twisted bar lean and
/// carry N aside (Wagner). It matters for open or flat sections; the frame references leave it out.
///
/// Exact as far as the shape is: a load factor comes out too high by a part that falls as
/// `(L/λ)⁴` with λ the length of a half wave (one part per half wave 21.6 %, two 0.75 %, four
/// 0.05 %); a single part clamped at both ends does not see its own buckling at all. What shear adds
/// to the give falls as `(L/λ)²` only: a part that mostly shears has a straight axis.
///
/// Left out: `N ∫ u'²` along the axis (a part in E/σ), and bending moments, shear forces and
/// torque: no lateral-torsional buckling of a flat strand bent the stiff way, and no Greenhill
/// buckling of a twisted one.
pub(crate) fn under_tension(member: &Member, length_m: f64, with_twist: bool) -> Matrix12 {
    let (section, elastic, l) = (member.section, member.elastic, length_m);
    let mut k = Matrix12::zeros();
    let planes = [(1, 5, section.iz_m4, 1.0), (2, 4, section.iy_m4, -1.0)];
    for (shift, turn, second_moment_m4, sign) in planes {
        let phi = 12.0 * elastic.e_pa * second_moment_m4
            / (section.shear_kappa * elastic.g_pa * section.area_m2 * l * l);
        let s = (1.0 + phi).powi(-2);
        let sheared = phi / 6.0 + phi * phi / 12.0;
        let shift_shift = (1.2 + 2.0 * phi + phi * phi) * s / l;
        let cross = sign * s / 10.0;
        for (row, column, value) in [
            (shift, shift, shift_shift),
            (shift + 6, shift + 6, shift_shift),
            (shift, shift + 6, -shift_shift),
            (shift, turn, cross),
            (shift, turn + 6, cross),
            (turn, shift + 6, -cross),
            (shift + 6, turn + 6, -cross),
            (turn, turn, (2.0 / 15.0 + sheared) * s * l),
            (turn + 6, turn + 6, (2.0 / 15.0 + sheared) * s * l),
            (turn, turn + 6, -(1.0 / 30.0 + sheared) * s * l),
        ] {
            k[(row, column)] = value;
            k[(column, row)] = value;
        }
    }
    if with_twist {
        let polar = (section.iy_m4 + section.iz_m4) / (section.area_m2 * l);
        k[(3, 3)] = polar;
        k[(9, 9)] = polar;
        k[(3, 9)] = -polar;
        k[(9, 3)] = -polar;
    }
    k
}
