//! What an operator would see when it goes wrong: an illustration, not a prediction.
//!
//! [`collapse`] lets the pieces of a frame that nothing holds fall as rigid bodies (rapier3d) on bed,
//! forms and the rest that stands; [`pushed_aside`] turns a struck strand about its held end. Nothing
//! here is judged and nothing goes back into the checks: no strand bends, warms, sticks or breaks on
//! landing, all are of one density, and friction is a guess. Where a piece comes to lie is one of
//! many places where it might.

mod fall;
mod pieces;
mod struck;
#[cfg(test)]
mod tests;

pub use struck::pushed_aside;

use crate::pose::{Point, Pose, Vector};
use crate::structure::{Frame, Support};
use thiserror::Error;

/// Most members that are let fall: 4900 in one piece took 10 s of one core, built for tests.
pub const MOST_MEMBERS: usize = 5_000;
/// Most triangles of all forms together.
pub const MOST_TRIANGLES: usize = 200_000;
/// Farthest coordinate that `f32` in millimetres still tells to 0.01 mm, m.
const FARTHEST_M: f64 = 100.0;
/// Strongest gravity that is let act, m/s²: what falls faster passes through what it should land on.
const STRONGEST_M_S2: f64 = 100.0;

/// A frame at the moment it fails, part axes.
#[derive(Debug, Clone, Copy)]
pub struct Failing<'a> {
    /// Nodes where they are, and members.
    pub frame: &'a Frame,
    /// Members `0..born` are printed.
    pub born: usize,
    /// What holds nodes.
    pub supports: &'a [Support],
    /// Where members break.
    pub breaks: &'a [Break],
    /// Gravity, m/s².
    pub gravity_m_s2: Vector,
}

/// Where a member breaks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Break {
    /// The member.
    pub member: usize,
    /// Share of its length from its first node, 0 to 1.
    pub share: f64,
}

/// What pieces fall on, part axes.
#[derive(Debug, Clone, Copy)]
pub struct Ground<'a> {
    /// Its x-y plane is the top of the bed, without end; z points out of it.
    pub part_from_bed: Pose,
    /// Forms that stand there.
    pub forms: &'a [Mesh<'a>],
}

/// A body of triangles.
#[derive(Debug, Clone, Copy)]
pub struct Mesh<'a> {
    /// Corners.
    pub vertices: &'a [Point],
    /// Three corners each.
    pub triangles: &'a [[u32; 3]],
}

/// A member, or what a break leaves of it, where it was printed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bit {
    /// The member.
    pub member: usize,
    /// Ends of its axis.
    pub ends: [Point; 2],
    /// Radius of the bead, m.
    pub radius_m: f64,
}

/// A rigid piece that nothing holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// Its members, where they were printed.
    pub bits: Vec<Bit>,
    /// `now_from_printed` at each of [`Collapse::times_s`], part axes.
    pub poses: Vec<Pose>,
}

/// What becomes of a frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Collapse {
    /// Moments from the failure on, s.
    pub times_s: Vec<f64>,
    /// What moves; empty where all is held.
    pub pieces: Vec<Piece>,
    /// What stays.
    pub rest: Vec<Bit>,
}

/// Why there is no illustration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum Refused {
    /// More than [`MOST_MEMBERS`] or [`MOST_TRIANGLES`].
    #[error("more than {MOST_MEMBERS} members or {MOST_TRIANGLES} triangles")]
    TooMany,
    /// A member, node or share that is not there.
    #[error("a support or break names what is not there")]
    NotThere,
    /// A coordinate or gravity that is not finite or too large.
    #[error("a coordinate or gravity is not finite or too large")]
    OutOfRange,
}

/// Cuts the frame at its breaks and lets fall what nothing holds.
///
/// A piece is held if its supports leave it no motion as a rigid body; supports that leave it some
/// become joints, so that a mechanism swings. Members without density are links: they join, but
/// have no body. At a break the two stubs end a radius before it. Before the first contact
/// the fall is `g t²/2` within `g t dt/2` (`dt` is rapier's step, 1 ms). Told from 0 to 1 s.
///
/// The same input gives the same bytes on one kind of machine; a piece that balances may fall to another side on
/// another kind.
///
/// # Errors
/// Too many members or triangles, or numbers that cannot be used.
pub fn collapse(failing: &Failing, ground: &Ground) -> Result<Collapse, Refused> {
    check(failing, ground)?;
    let (loose, rest) = pieces::pieces(failing);
    let poses = fall::fall(failing, ground, &loose, &rest);
    let pieces =
        loose.into_iter().zip(poses).map(|(loose, poses)| Piece { bits: loose.bits, poses });
    Ok(Collapse { times_s: fall::times_s(), pieces: pieces.collect(), rest })
}

fn check(failing: &Failing, ground: &Ground) -> Result<(), Refused> {
    let members = failing.frame.members().len();
    let nodes = failing.frame.nodes();
    let triangles: usize = ground.forms.iter().map(|form| form.triangles.len()).sum();
    if failing.born > MOST_MEMBERS || triangles > MOST_TRIANGLES {
        return Err(Refused::TooMany);
    }
    let there = |b: &Break| b.member < failing.born && (0.0..=1.0).contains(&b.share);
    let known = |support: &Support| support.node < nodes.len();
    let corners_there = |form: &Mesh| {
        form.triangles.iter().flatten().all(|&corner| (corner as usize) < form.vertices.len())
    };
    if failing.born > members
        || !failing.breaks.iter().all(there)
        || !failing.supports.iter().all(known)
        || !ground.forms.iter().all(corners_there)
    {
        return Err(Refused::NotThere);
    }
    let near = |point: &Point| point.coords.iter().all(|x| x.abs() <= FARTHEST_M);
    let corners = ground.forms.iter().flat_map(|form| form.vertices);
    let bed = Point::from(ground.part_from_bed.translation.vector);
    let turned = ground.part_from_bed.rotation.coords.iter().all(|x| x.is_finite());
    let fine = nodes.iter().chain(corners).chain([&bed]).all(near)
        && turned
        && failing.frame.members().iter().all(|member| member.section.fibre_m <= FARTHEST_M)
        && failing.gravity_m_s2.norm() <= STRONGEST_M_S2;
    if fine { Ok(()) } else { Err(Refused::OutOfRange) }
}
