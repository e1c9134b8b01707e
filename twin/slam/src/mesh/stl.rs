//! STL. A file is binary if its length is what its header promises; many binary files begin with
//! the word "solid" that is meant to mark ASCII ones.

use super::{MAX_TRIANGLES, Mesh, MeshError, Vertices, coordinates, syntax};

const HEADER: usize = 84;
const RECORD: usize = 50;

/// Reads an STL file, binary or ASCII.
pub fn parse_stl(bytes: &[u8]) -> Result<Mesh, MeshError> {
    let count = bytes
        .get(80..HEADER)
        .map_or(0, |count| u32::from_le_bytes([count[0], count[1], count[2], count[3]]));
    let expected = HEADER as u64 + RECORD as u64 * u64::from(count);
    if bytes.len() as u64 == expected {
        return binary(&bytes[HEADER..]);
    }
    match std::str::from_utf8(bytes) {
        _ if bytes.is_empty() => Err(MeshError::Empty("triangle")),
        Ok(text)
            if text
                .trim_start()
                .get(..5)
                .is_some_and(|word| word.eq_ignore_ascii_case("solid")) =>
        {
            ascii(text)
        }
        _ => Err(MeshError::Length { triangles: count, expected, found: bytes.len() }),
    }
}

fn binary(records: &[u8]) -> Result<Mesh, MeshError> {
    let count = records.len() / RECORD;
    if count > MAX_TRIANGLES {
        return Err(MeshError::TooMany("triangles"));
    }
    let (mut vertices, mut triangles) = (Vertices::default(), Vec::with_capacity(count));
    for (index, record) in records.chunks_exact(RECORD).enumerate() {
        let number = |at: usize| {
            f64::from(f32::from_le_bytes([
                record[at],
                record[at + 1],
                record[at + 2],
                record[at + 3],
            ]))
        };
        // 12 bytes of normal come first
        let corners = [12, 24, 36].map(|at| [number(at), number(at + 4), number(at + 8)]);
        if !corners.as_flattened().iter().all(|value| value.is_finite()) {
            return Err(MeshError::NotFinite { triangle: index + 1 });
        }
        triangles.push(corners.map(|corner| vertices.index(corner)));
    }
    finish(vertices, triangles)
}

fn ascii(text: &str) -> Result<Mesh, MeshError> {
    let (mut vertices, mut triangles) = (Vertices::default(), Vec::new());
    let (mut corners, mut open_solid, mut open_loop) = (Vec::new(), false, false);
    let mut last = 0;
    for (index, text) in text.lines().enumerate() {
        let line = index + 1;
        let mut words = text.split_whitespace();
        let Some(first) = words.next() else { continue };
        last = line;
        match first.to_ascii_lowercase().as_str() {
            "solid" if !open_solid => open_solid = true,
            "endsolid" if open_solid && !open_loop => open_solid = false,
            "facet" | "endfacet" if open_solid && !open_loop => {}
            "outer" if open_solid && !open_loop => open_loop = true,
            "vertex" if open_loop => {
                let corner = coordinates(line, &mut words)?;
                corners.push(vertices.index(corner));
                if corners.len() > 3 {
                    return syntax(line, "a facet has three vertices, this one has more");
                }
            }
            "endloop" if open_loop => {
                let Ok(triangle) = <[u32; 3]>::try_from(corners.as_slice()) else {
                    return syntax(line, "a facet has three vertices, this one has fewer");
                };
                triangles.push(triangle);
                if triangles.len() > MAX_TRIANGLES {
                    return Err(MeshError::TooMany("triangles"));
                }
                corners.clear();
                open_loop = false;
            }
            _ => {
                return syntax(
                    line,
                    format!("{} is out of place", crate::diagnostic::quoted(first)),
                );
            }
        }
    }
    if open_solid {
        return syntax(last, "the file ends before \"endsolid\"");
    }
    finish(vertices, triangles)
}

fn finish(vertices: Vertices, triangles: Vec<[u32; 3]>) -> Result<Mesh, MeshError> {
    if triangles.is_empty() {
        return Err(MeshError::Empty("triangle"));
    }
    Ok(Mesh { vertices: vertices.list, triangles })
}
