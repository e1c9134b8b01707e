//! Which members come near their own Euler load: a screen before the buckling of the whole.

use std::f64::consts::PI;

use super::beam::{Beam, beams};
use super::frame::{Frame, Member};
use super::solve::{Solution, SolveError};
use super::strength::{Cut, cuts};

/// Above this part of its Euler load a member asks for the buckling factor of the frame.
pub const EULER_FLAG: f64 = 0.2;

/// A compressed member and how near it is to buckling on its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slender {
    /// The member.
    pub member: usize,
    /// `P L²/(π² E I_min)`.
    pub ratio: f64,
    /// The greater compression of its two ends P, N.
    pub compression_n: f64,
}

/// Members whose compression is more than `flag` of the Euler load between pinned ends, the worst
/// first: `P L²/(π² E I_min) > flag`. A member in tension is never among them.
///
/// O(members). It sees members, not the frame: one that sways, or a strand cut into many members by
/// the nodes along it, buckles at a far smaller ratio (free standing in m members: `1/(4 m²)`). So
/// some stages must be solved whatever it says. `gravity` is the one the solution was made with.
///
/// # Errors
/// [`SolveError::BadMember`] where the solution is of another frame.
pub fn slender(
    frame: &Frame,
    solution: &Solution,
    gravity_m_s2: [f64; 3],
    flag: f64,
) -> Result<Vec<Slender>, SolveError> {
    let cuts = cuts(frame, solution, gravity_m_s2)?;
    let beams = beams(frame);
    let of_member = |(at, cut): (usize, &Cut)| {
        let (compression_n, ratio) = pressed(&frame.members()[at], &beams[at], cut);
        Slender { member: at, ratio, compression_n }
    };
    let mut found: Vec<Slender> =
        cuts.iter().enumerate().map(of_member).filter(|each| each.ratio > flag).collect();
    found.sort_by(|a, b| b.ratio.total_cmp(&a.ratio));
    Ok(found)
}

/// The greatest ratio among members with these forces.
pub(crate) fn most_slender(members: &[Member], beams: &[Beam], cuts: &[Cut]) -> f64 {
    let ratio = |((member, beam), cut)| pressed(member, beam, cut).1;
    members.iter().zip(beams).zip(cuts).map(ratio).fold(0.0, f64::max)
}

/// Compression, N, and its part of the Euler load.
fn pressed(member: &Member, beam: &Beam, cut: &Cut) -> (f64, f64) {
    let x = beam.axes.column(0).into_owned();
    let compression_n = -cut.axial_n(&x, 0.0).min(cut.axial_n(&x, beam.length_m));
    let euler_n = PI * PI * member.elastic.e_pa * member.section.iy_m4.min(member.section.iz_m4)
        / beam.length_m.powi(2);
    (compression_n, compression_n / euler_n)
}
