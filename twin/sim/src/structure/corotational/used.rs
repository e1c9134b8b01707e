//! Strength used by members that have moved far.

use super::Path;
use super::element::block_turned;
use crate::pose::Vector;
use crate::structure::beam::{Vector12, beams};
use crate::structure::frame::Frame;
use crate::structure::solve::SolveError;
use crate::structure::strength::{Cut, Strength, Utilisation, check_strengths, spans};

/// The most used member where a path ended, by the laws of the linear solution: forces are turned
/// back with each part of a member. `frame` is the one the path was followed with, each member of
/// it cut into `parts` (1: as it is); `strengths`, and the member and station of the answer, go by
/// whole members. `None` without members.
///
/// # Errors
/// [`SolveError::BadMember`] where a strength or a force is missing or not positive.
pub fn utilisation(
    frame: &Frame,
    parts: usize,
    strengths: &[Strength],
    path: &Path,
) -> Result<Option<Utilisation>, SolveError> {
    let parts = parts.max(1);
    let count = frame.members().len();
    let given = path.local_end_forces.len().min(path.local_line_n_per_m.len());
    let wholes = count / parts;
    if given != count || !count.is_multiple_of(parts) {
        return Err(SolveError::BadMember { member: strengths.len().min(wholes) });
    }
    check_strengths(wholes, strengths)?;
    let beams = beams(frame);
    let mut worst: Option<Utilisation> = None;
    for (at, span) in spans(frame, &beams).iter().enumerate() {
        let (member, part) = (at / parts, at % parts);
        let axes = beams[at].axes;
        let forces = block_turned(&Vector12::from(path.local_end_forces[at]), &axes);
        let line = axes * Vector::from(path.local_line_n_per_m[at]);
        let cut = Cut::new(forces.as_slice(), line);
        let (value, station_m, governs) = span.utilisation(&cut, &strengths[member]);
        if worst.is_none_or(|worst| value > worst.value) {
            let station_m = part as f64 * span.length_m + station_m;
            worst = Some(Utilisation { value, member, station_m, governs });
        }
    }
    Ok(worst)
}
