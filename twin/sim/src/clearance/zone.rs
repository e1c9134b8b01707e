//! What is left of a bead outside the zones where it may be touched.

use crate::pose::Point;

/// A straight piece by its ends.
pub(crate) type Piece = [Point; 2];

/// The pieces of `whole` outside all spheres of radius `radius_m` about `centres`; at most one
/// more than there are spheres.
pub(crate) fn outside(whole: Piece, centres: &[Point], radius_m: f64, pieces: &mut Vec<Piece>) {
    pieces.clear();
    pieces.push(whole);
    for centre in centres {
        let mut k = 0;
        while k < pieces.len() {
            let [before, after] = cut(pieces[k], centre, radius_m);
            match (before, after) {
                (None, None) => {
                    pieces.swap_remove(k);
                    continue;
                }
                (Some(piece), None) | (None, Some(piece)) => pieces[k] = piece,
                (Some(piece), Some(other)) => {
                    pieces[k] = piece;
                    pieces.insert(k + 1, other);
                    k += 1;
                }
            }
            k += 1;
        }
    }
}

/// The parts of a piece before and after a sphere; an untouched piece is all before it.
fn cut(piece: Piece, centre: &Point, radius_m: f64) -> [Option<Piece>; 2] {
    let along = piece[1] - piece[0];
    let from = piece[0] - centre;
    // |from + s·along|² = radius²
    let (a, b, c) =
        (along.norm_squared(), from.dot(&along), from.norm_squared() - radius_m * radius_m);
    let discriminant = b * b - a * c;
    if a <= f64::MIN_POSITIVE || discriminant <= 0.0 {
        return [(c > 0.0).then_some(piece), None];
    }
    let root = discriminant.sqrt();
    let (enter, leave) = ((-b - root) / a, (-b + root) / a);
    if enter >= 1.0 || leave <= 0.0 {
        return [Some(piece), None];
    }
    let at = |share: f64| piece[0] + along * share;
    [(enter > 0.0).then(|| [piece[0], at(enter)]), (leave < 1.0).then(|| [at(leave), piece[1]])]
}
