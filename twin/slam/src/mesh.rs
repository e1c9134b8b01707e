//! Triangle meshes: STL (binary and ASCII) and OBJ.

mod obj;
mod stl;
#[cfg(test)]
mod tests;

use std::collections::HashMap;

pub use obj::{parse_obj, parse_obj_lines};
pub use stl::parse_stl;

/// Largest number of triangles, or of points of lines, in one file.
pub const MAX_TRIANGLES: usize = 5_000_000;

/// Triangles over shared vertices, in the units of the file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Vertices, no two alike.
    pub vertices: Vec<[f64; 3]>,
    /// Vertex indices of each triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// Polylines over shared vertices, in the units of the file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lines {
    /// Vertices, no two alike.
    pub vertices: Vec<[f64; 3]>,
    /// Vertex indices along each polyline, two or more.
    pub polylines: Vec<Vec<u32>>,
}

/// Why a file is no mesh.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// Nothing in it.
    #[error("the file holds no {0}")]
    Empty(&'static str),
    /// A binary STL cut short or with bytes too many, or something else altogether.
    #[error(
        "neither ASCII STL nor binary STL: as binary its header promises {triangles} triangles, {expected} bytes; it has {found}"
    )]
    Length {
        /// Triangles the header promises.
        triangles: u32,
        /// Bytes they need.
        expected: u64,
        /// Bytes there are.
        found: usize,
    },
    /// A number that is none.
    #[error("triangle {triangle} has a coordinate that is not finite")]
    NotFinite {
        /// Which, counted from 1.
        triangle: usize,
    },
    /// A line that cannot be read.
    #[error("line {line}: {what}")]
    Syntax {
        /// Which, counted from 1.
        line: usize,
        /// What is wrong with it.
        what: String,
    },
    /// Too much for the twin.
    #[error("more than {MAX_TRIANGLES} {0}")]
    TooMany(&'static str),
}

/// Merges vertices that are exactly alike.
#[derive(Default)]
struct Vertices {
    list: Vec<[f64; 3]>,
    known: HashMap<[u64; 3], u32>,
}

impl Vertices {
    /// Index of a vertex; at most `3 × MAX_TRIANGLES` are ever added, so it fits.
    fn index(&mut self, vertex: [f64; 3]) -> u32 {
        let vertex = vertex.map(|coordinate| coordinate + 0.0); // −0 and 0 are one place
        let next = self.list.len() as u32;
        let index = *self.known.entry(vertex.map(f64::to_bits)).or_insert(next);
        if index == next {
            self.list.push(vertex);
        }
        index
    }
}

fn syntax<T>(line: usize, what: impl Into<String>) -> Result<T, MeshError> {
    Err(MeshError::Syntax { line, what: what.into() })
}

/// Three finite numbers from the words of a line.
fn coordinates<'a>(
    line: usize,
    words: &mut impl Iterator<Item = &'a str>,
) -> Result<[f64; 3], MeshError> {
    let mut point = [0.0; 3];
    for coordinate in &mut point {
        let word = words.next().unwrap_or_default();
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => *coordinate = value,
            Ok(_) => {
                return syntax(line, format!("{} is not finite", crate::diagnostic::quoted(word)));
            }
            Err(_) if word.is_empty() => return syntax(line, "three coordinates are needed"),
            Err(_) => {
                return syntax(
                    line,
                    format!("{} is not a number", crate::diagnostic::quoted(word)),
                );
            }
        }
    }
    Ok(point)
}
