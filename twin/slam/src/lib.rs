//! Texts of the twin's formats to documents with positions in the text, and back.
//!
//! | file            | type                          | module         |
//! |-----------------|-------------------------------|----------------|
//! | `job.slam`      | [`document::Document`]        | `job`          |
//! | cell, tool, robot, material `.toml` | [`cell_file`], [`tool_file`], [`robot_file`], [`material_file`] | same |
//! | `MEASURED.toml` | [`measured_file::MeasuredFile`] | `measured_file` |
//! | frame `.json`   | [`frame_file::FrameFile`]     | `frame_file`   |
//! | `.urdf`         | [`urdf::RobotDescription`]    | `urdf`         |
//! | `.stl`, `.obj`  | [`mesh::Mesh`]                | `mesh`         |
//!
//! Numbers stay in the units of the file (mm, °C, degrees); `sim` turns them to SI. Nothing here
//! opens a file: text comes in, values and [`diagnostic::Diagnostic`]s go out. No input panics.

pub mod cell_file;
mod date;
pub mod diagnostic;
pub mod document;
pub mod frame_file;
pub mod job;
pub mod material_file;
pub mod measured_file;
pub mod mesh;
pub mod robot_file;
pub mod schema;
pub mod tool_file;
pub mod urdf;

pub use date::is_date;
pub use diagnostic::{Diagnostic, Severity, Source, Span, Spanned};
pub use document::Document;
