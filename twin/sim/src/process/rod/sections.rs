//! A strand cut into sections, and the load on them.

use super::{Strand, dot};

/// A piece of an element; two sections to each.
pub(super) struct Piece {
    pub(super) element: usize,
    pub(super) from_m: f64,
    pub(super) to_m: f64,
    pub(super) from_s: f64,
    pub(super) to_s: f64,
}

/// A section: a Gauss point of a piece, with what it has been through.
#[derive(Clone, Copy)]
pub(super) struct Section {
    pub(super) element: usize,
    pub(super) at_m: f64,
    pub(super) weight_m: f64,
    pub(super) birth_s: f64,
    pub(super) per_inertia: f64,
    pub(super) per_area: f64,
    /// Compliance flowed through so far.
    pub(super) compliance: f64,
    /// Curvature that stays when the moment goes.
    pub(super) set: [f64; 2],
    /// Curvature at the end of the last step, the springy part in.
    pub(super) curvature: [f64; 2],
    /// The same along: strain.
    pub(super) set_strain: f64,
    pub(super) strain: f64,
    /// Moment and pull at the end of the last step; none before the first.
    pub(super) last: Option<([f64; 2], f64)>,
}

/// What the weight beyond a section does to it.
#[derive(Clone, Copy, Default)]
pub(super) struct Load {
    pub(super) moment: [f64; 2],
    pub(super) shear: [f64; 2],
    pub(super) pull: f64,
}

/// Half of 1 − 1/√3: the first of two Gauss points on 0..1.
const FIRST: f64 = 0.211_324_865_405_187_1;

pub(super) fn cut(strand: &Strand) -> (Vec<Piece>, Vec<Section>) {
    let cuts = strand.fineness.cuts.clamp(1, 64);
    let share = 1.0 / f64::from(cuts);
    let count = strand.elements.len() * cuts as usize;
    let (mut pieces, mut sections) = (Vec::with_capacity(count), Vec::with_capacity(2 * count));
    let (mut at_m, mut at_s) = (0.0, 0.0);
    for (element, e) in strand.elements.iter().enumerate() {
        let (length_m, time_s) = (e.length_m * share, e.printing_s * share);
        for _ in 0..cuts {
            pieces.push(Piece {
                element,
                from_m: at_m,
                to_m: at_m + length_m,
                from_s: at_s,
                to_s: at_s + time_s,
            });
            for x in [FIRST, 1.0 - FIRST] {
                let birth_s = at_s + x * time_s;
                sections.push(Section {
                    element,
                    at_m: at_m + x * length_m,
                    weight_m: 0.5 * length_m,
                    birth_s,
                    per_inertia: 1.0 / e.inertia_m4,
                    per_area: 1.0 / e.area_m2,
                    compliance: (strand.ageing.compliance_per_pa)(element, 0.0),
                    set: [0.0; 2],
                    curvature: [0.0; 2],
                    set_strain: 0.0,
                    strain: 0.0,
                    last: None,
                });
            }
            at_m += length_m;
            at_s += time_s;
        }
    }
    (pieces, sections)
}

/// Weight per length across and along, N/m.
pub(super) fn weight(strand: &Strand, element: usize, gravity: [f64; 3]) -> [f64; 3] {
    let e = &strand.elements[element];
    let [u, v] = e.axes.across;
    [u, v, e.axes.along].map(|axis| e.line_mass_kg_m * dot(axis, gravity))
}

/// Load on every section of the first `count` pieces, the strand ending at `end_m`, summed from there; returns
/// the load on the far end. A section beyond the end gets the polynomial continued.
pub(super) fn loads(
    strand: &Strand,
    pieces: &[Piece],
    sections: &[Section],
    end_m: f64,
    gravity: [f64; 3],
    out: &mut Vec<Load>,
) -> Load {
    out.resize(sections.len(), Load::default());
    let mut sum = Load::default();
    let mut near_m = end_m;
    for (i, piece) in pieces.iter().enumerate().rev() {
        let w = weight(strand, piece.element, gravity);
        for g in [2 * i, 2 * i + 1] {
            out[g] = further(&sum, w, near_m - sections[g].at_m);
        }
        sum = further(&sum, w, near_m - piece.from_m);
        near_m = piece.from_m;
    }
    sum
}

/// Load a distance farther from the nozzle.
fn further(load: &Load, w: [f64; 3], by_m: f64) -> Load {
    let moment = |i: usize| load.moment[i] + by_m * (load.shear[i] + 0.5 * w[i] * by_m);
    Load {
        moment: [moment(0), moment(1)],
        shear: [load.shear[0] + w[0] * by_m, load.shear[1] + w[1] * by_m],
        pull: load.pull + w[2] * by_m,
    }
}
