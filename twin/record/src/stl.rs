//! The part as printed, as binary STL.

#[cfg(test)]
mod tests;

use crate::tubes::{TubeLook, tube};
use sim::film::Film;

/// Sides of a strand's tube, as large in area as its circle.
const TUBE: TubeLook = TubeLook { sides: 12, end_rings: 0 };
/// Bytes before the first triangle.
const HEAD: usize = 84;

/// Binary STL of all strands as printed: mm, part axes, each strand a closed tube with flat ends whose volume is that of the
/// round bead. Strands overlap where they touch; the file says nothing of welds.
///
/// A film without strands is a file without triangles. Same film, same bytes. O(n).
pub fn stl(film: &Film) -> Vec<u8> {
    let mut out = header(&film.job);
    let mut facets: u32 = 0;
    for strand in &film.strands {
        let mesh = tube(&strand.points, strand.radius_m, TUBE, |_| false);
        for triangle in &mesh.triangles {
            let corners = triangle.map(|vertex| mesh.points[vertex as usize]);
            let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
            let normal = normal.try_normalize(0.0).unwrap_or_default();
            let corners_mm = corners.map(|corner| corner.coords * 1e3);
            for x in normal.iter().chain(corners_mm.iter().flatten()) {
                out.extend_from_slice(&(*x as f32).to_le_bytes());
            }
            out.extend_from_slice(&[0; 2]);
            facets += 1;
        }
    }
    out[HEAD - 4..HEAD].copy_from_slice(&facets.to_le_bytes());
    out
}

/// 80 bytes that do not begin with "solid" (that would be taken for the text format), and room for the count.
fn header(job: &str) -> Vec<u8> {
    let plain = |c: char| if c.is_ascii_graphic() || c == ' ' { c as u8 } else { b'?' };
    let text = b"twin: as printed, mm, part axes; ".iter().copied().chain(job.chars().map(plain));
    let mut out: Vec<u8> = text.take(HEAD - 4).collect();
    out.resize(HEAD, 0);
    out
}
