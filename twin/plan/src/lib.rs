//! Curves and wireframes to jobs.
//!
//! A planner's answer is a [`slam::Document`] like any other job's: it goes through the same
//! checks as one written by hand. Text comes in, a document and [`Remark`]s go out; nothing here
//! opens a file, and no input panics.
//!
//! | design                                    | function      |
//! |-------------------------------------------|---------------|
//! | frame JSON of the `assembly_instances` family | [`wireframe()`] |
//! | joint-space plan of pb-construction, as it stands | [`peer_plan()`] |
//! | CSV `strand,x_mm,y_mm,z_mm[,dx,dy,dz]`    | [`curves()`]  |

mod curves;
mod document;
mod frame;
mod json;
mod order;
mod peer;
mod placement;
#[cfg(test)]
mod tests;
mod wireframe;

pub use curves::curves;
pub use peer::{OrificeOf, is_peer_plan, peer_plan};
pub use wireframe::wireframe;

use slam::{Diagnostic, Document};

/// What the design does not say and the job needs.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// What to call the job.
    pub name: String,
    /// Cell, by name or path.
    pub cell: String,
    /// Material, by name or path.
    pub material: String,
    /// Where the cell's bed is.
    pub bed: Bed,
    /// Bead for designs that name no cross-section, mm; `None` leaves it to the cell.
    pub diameter_mm: Option<f64>,
    /// Print speed, mm/s.
    pub speed_mm_s: f64,
    /// Name of the design's file without folder and extension, looked up under `instances` of an
    /// order file that holds many.
    pub file_stem: String,
}

/// Where the cell's bed is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bed {
    /// It stands still: bed axes in the robot's base, fixed-axes rotation as in URDF.
    InRobotBase {
        /// Offset, mm.
        xyz_mm: [f64; 3],
        /// Rotation, degrees.
        rpy_deg: [f64; 3],
    },
    /// It rides on the flange, so a place in the robot's base means nothing: the grounded nodes
    /// are centred on it.
    OnFlange,
}

/// A job and what its author should know about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Planned {
    /// The job.
    pub document: Document,
    /// Warnings.
    pub remarks: Vec<Remark>,
}

/// Which of the two inputs a remark is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Input {
    /// The frame or the curves.
    Design,
    /// The order of elements.
    Order,
}

/// A diagnostic and the input that its place refers to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// Whose text the place is in.
    pub input: Input,
    /// What, where, what to do.
    pub diagnostic: Diagnostic,
}

/// No design is larger than this in any direction, mm.
const LARGEST_MM: f64 = 1e6;

/// Points nearer than this are one, mm.
const SAME_POINT_MM: f64 = 1e-3;

/// Most remarks handed back; the rest are counted.
const MOST_REMARKS: usize = 50;

/// Diagnostics of one input as remarks, the tail counted rather than listed.
fn remarks(input: Input, mut diagnostics: Vec<Diagnostic>) -> Vec<Remark> {
    let left_out = diagnostics.len().saturating_sub(MOST_REMARKS);
    if left_out > 0 {
        // Errors first, so that none is cut off behind warnings.
        diagnostics.sort_by_key(|d| (std::cmp::Reverse(d.severity), d.span.start));
        diagnostics.truncate(MOST_REMARKS);
        if let Some(last) = diagnostics.last_mut() {
            last.hints.push(format!("{left_out} more of these are not shown"));
        }
    }
    diagnostics.into_iter().map(|diagnostic| Remark { input, diagnostic }).collect()
}

/// Whether any of these makes the input unusable.
fn any_error(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|d| d.severity == slam::Severity::Error)
}
