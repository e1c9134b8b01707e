//! Wavefront OBJ: vertices, faces and lines; everything else is passed over.

use super::{Lines, MAX_TRIANGLES, Mesh, MeshError, Vertices, coordinates, syntax};

/// Reads the faces of an OBJ file; polygons become fans of triangles.
pub fn parse_obj(text: &str) -> Result<Mesh, MeshError> {
    let (mut vertices, mut triangles) = (Vertices::default(), Vec::new());
    elements(text, "f", 3, |points| {
        if triangles.len() + points.len() > MAX_TRIANGLES + 2 {
            return Err(MeshError::TooMany("triangles"));
        }
        let corners: Vec<_> = points.iter().map(|&point| vertices.index(point)).collect();
        triangles.extend(corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]));
        Ok(())
    })?;
    if triangles.is_empty() {
        return Err(MeshError::Empty("face"));
    }
    Ok(Mesh { vertices: vertices.list, triangles })
}

/// Reads the lines of an OBJ file.
pub fn parse_obj_lines(text: &str) -> Result<Lines, MeshError> {
    let (mut vertices, mut polylines, mut count) = (Vertices::default(), Vec::new(), 0);
    elements(text, "l", 2, |points| {
        count += points.len();
        if count > MAX_TRIANGLES {
            return Err(MeshError::TooMany("points"));
        }
        polylines.push(points.iter().map(|&point| vertices.index(point)).collect());
        Ok(())
    })?;
    if polylines.is_empty() {
        return Err(MeshError::Empty("line"));
    }
    Ok(Lines { vertices: vertices.list, polylines })
}

/// Calls `take` with the corners of each element of one kind; `least`: corners it must have.
fn elements(
    text: &str,
    kind: &str,
    least: usize,
    mut take: impl FnMut(&[[f64; 3]]) -> Result<(), MeshError>,
) -> Result<(), MeshError> {
    let mut points: Vec<[f64; 3]> = Vec::new();
    let mut corners = Vec::new();
    let mut joined = String::new();
    for (index, text) in text.lines().enumerate() {
        let line = index + 1;
        let content = text.split('#').next().unwrap_or_default();
        if let Some(part) = content.trim_end().strip_suffix('\\') {
            joined.push_str(part);
            joined.push(' ');
            continue;
        }
        joined.push_str(content);
        let whole = std::mem::take(&mut joined);
        let mut words = whole.split_whitespace();
        match words.next() {
            Some("v") if points.len() >= 3 * MAX_TRIANGLES => {
                return Err(MeshError::TooMany("vertices"));
            }
            Some("v") => points.push(coordinates(line, &mut words)?),
            Some(first) if first == kind => {
                corners.clear();
                for word in words {
                    corners.push(corner(word, &points, line)?);
                }
                if corners.len() < least {
                    return syntax(line, format!("{kind} needs {least} vertices or more"));
                }
                take(&corners)?;
            }
            _ => {}
        }
    }
    Ok(())
}

/// The vertex of `7`, `7/1`, `7//3` or `-1` (the last one so far).
fn corner(word: &str, points: &[[f64; 3]], line: usize) -> Result<[f64; 3], MeshError> {
    let number = word.split('/').next().unwrap_or_default();
    let Ok(number) = number.parse::<i64>() else {
        return syntax(line, format!("{} is not a vertex", crate::diagnostic::quoted(word)));
    };
    let index = match number {
        1.. => usize::try_from(number - 1).ok(),
        _ => usize::try_from(number.unsigned_abs())
            .ok()
            .and_then(|back| points.len().checked_sub(back)),
    };
    match index.and_then(|index| points.get(index)) {
        Some(point) => Ok(*point),
        None => syntax(
            line,
            format!("vertex {number} does not exist; there are {} so far", points.len()),
        ),
    }
}
