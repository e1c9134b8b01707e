//! What a section carries when it yields through: a domain of axial force, bending and torque.

use std::f64::consts::PI;

use super::section::Section;
use super::strength::Strength;
use crate::pose::Vector;

/// Chords of the circle's curve; its chords lie at most 4e-6 inside it.
const CHORDS: usize = 256;
/// How near a section must be to an ellipse or rectangle to be taken for one.
const SAME_SHAPE: f64 = 1e-9;
/// Halvings that find the angle of a chord's end: to the last digit.
const HALVINGS: usize = 60;

/// Axial force (tension positive), bending moment across and torque of a section.
#[derive(Debug, Clone, Copy)]
pub(super) struct Forces {
    pub(super) axial_n: f64,
    pub(super) bending_n_m: Vector,
    pub(super) torque_n_m: f64,
}

/// Bending a solid ellipse takes beside an axial force, both over their full plastic values:
/// `n = (2/π)(θ + sin θ cos θ)`, `m = cos³ θ` (stress ± yield either side of a line at `r sin θ`).
#[derive(Debug, Clone)]
pub(super) struct EllipseCurve {
    bending: Vec<f64>,
}

impl EllipseCurve {
    pub(super) fn new() -> Self {
        let bending_beside = |axial: f64| {
            let (mut low, mut high) = (0.0, PI / 2.0);
            for _ in 0..HALVINGS {
                let theta: f64 = 0.5 * (low + high);
                let n = 2.0 / PI * (theta + theta.sin() * theta.cos());
                if n < axial { low = theta } else { high = theta }
            }
            f64::cos(high).powi(3).max(0.0)
        };
        Self { bending: (0..=CHORDS).map(|k| bending_beside(k as f64 / CHORDS as f64)).collect() }
    }

    /// By a chord, so never more than the curve (which bulges outwards); 0 past the full axial force.
    pub(super) fn bending(&self, axial: f64) -> f64 {
        let along = axial.abs() * CHORDS as f64;
        let at = along.floor() as usize;
        if at >= CHORDS {
            return 0.0;
        }
        let part = along - at as f64;
        self.bending[at] * (1.0 - part) + self.bending[at + 1] * part
    }
}

/// How the stress of a yielding section is spread.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    Ellipse,
    Rectangle,
    /// Anything else yields no further than at its outermost fibre.
    Fibre,
}

/// A section, with its strengths, ready to be asked.
///
/// A field of stress that is in balance with the forces and nowhere past yield, so what it allows
/// the section carries:
/// - ellipse: `n` and `m` above with `Np = f A`, `Mp = 4/3 a b² f` (a circle's `d³ f/6`), m the two
///   bendings as a vector (the ellipse is a stretched circle); exact;
/// - rectangle: `|m_y| + |m_z| <= 1 - n²`, `Mp = A h f/4`; exact for bending in one plane;
/// - other: elastic, `|N|/A + c |(M_y/I_y, M_z/I_z)| <= f`;
/// - torque: shear τ even over the section (heap of sand: `T = 2/3 π a b² τ`, `b² (3 h - b) τ/6`,
///   else elastic `T = τ J/c`), which leaves `√(f² - 3 τ²)` for the rest;
/// - tension and compression apart: half their difference is an even stress that bends nothing, so
///   N counts from `A (ft - fc)/2` and f is their mean.
///
/// Shear by bending is left out, as in [`super::strength`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Yielding {
    shape: Shape,
    area_m2: f64,
    /// Bending moments about y and z over f, m³.
    bending_m3: [f64; 2],
    /// Torque over τ, m³.
    torque_m3: f64,
    strength: Strength,
}

impl Yielding {
    pub(super) fn new(section: &Section, strength: Strength) -> Self {
        let area_m2 = section.area_m2;
        // half widths the two moments imply, if it is that shape
        let [a, b] = [section.iz_m4, section.iy_m4].map(|second| 2.0 * (second / area_m2).sqrt());
        let [width, height] = [a, b].map(|half| 3f64.sqrt() * half);
        let is = |area: f64, fibre: &[f64]| {
            let same = |one: f64, other: f64| (one / other - 1.0).abs() < SAME_SHAPE;
            same(area, area_m2) && fibre.iter().any(|fibre| same(*fibre, section.fibre_m))
        };
        let (thin, wide) = (width.min(height), width.max(height));
        // a rectangle's fibre is its corner, or half a side where it is bent in one plane only
        let fibres = [width.hypot(height) / 2.0, wide / 2.0, thin / 2.0];
        if is(PI * a * b, &[a.max(b)]) {
            let third = 4.0 / 3.0 * a * b;
            let torque_m3 = 2.0 / 3.0 * PI * a * b * a.min(b);
            let bending_m3 = [third * b, third * a];
            Self { shape: Shape::Ellipse, area_m2, bending_m3, torque_m3, strength }
        } else if is(width * height, &fibres) {
            let bending_m3 = [area_m2 * height / 4.0, area_m2 * width / 4.0];
            let torque_m3 = thin * thin * (3.0 * wide - thin) / 6.0;
            Self { shape: Shape::Rectangle, area_m2, bending_m3, torque_m3, strength }
        } else {
            let bending_m3 = [section.iy_m4, section.iz_m4].map(|second| second / section.fibre_m);
            let torque_m3 = section.j_m4 / section.fibre_m;
            Self { shape: Shape::Fibre, area_m2, bending_m3, torque_m3, strength }
        }
    }

    /// Whether forces are inside the convex domain.
    pub(super) fn carries(&self, curve: &EllipseCurve, at: &Forces, axes: [&Vector; 2]) -> bool {
        let shear_pa = at.torque_n_m.abs() / self.torque_m3;
        let left = |full_pa: f64| full_pa * full_pa - 3.0 * shear_pa * shear_pa;
        let [tension, compression] =
            [self.strength.tension_pa, self.strength.compression_pa].map(left);
        if !(tension > 0.0 && compression > 0.0) {
            return false;
        }
        let (tension_pa, compression_pa) = (tension.sqrt(), compression.sqrt());
        let mean_pa = 0.5 * (tension_pa + compression_pa);
        let even_pa = 0.5 * (tension_pa - compression_pa);
        let n = ((at.axial_n / self.area_m2 - even_pa) / mean_pa).abs();
        let [y, z] = [0, 1].map(|k| at.bending_n_m.dot(axes[k]) / (self.bending_m3[k] * mean_pa));
        match self.shape {
            Shape::Ellipse => n <= 1.0 && y.hypot(z) <= curve.bending(n),
            Shape::Rectangle => y.abs() + z.abs() <= 1.0 - n * n,
            Shape::Fibre => y.hypot(z) <= 1.0 - n,
        }
    }
}
