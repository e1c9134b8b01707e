//! How far into a round strand the light has cured it.

use std::f64::consts::{PI, TAU};

use super::cure::cure_depth_m;

/// Azimuths and radii of the quadrature through a section.
const SPOKES: usize = 24;
const RINGS: usize = 16;

/// How light goes on inside the strand: two limits, the truth between them. Ours; refraction is left out of
/// the reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Inside {
    /// Straight on, as if strand and air refracted alike: beams cross the axis.
    Straight,
    /// Bent square to the surface, as if the strand refracted strongly: each azimuth cures its own depth.
    Radial,
}

/// A section of a strand and the light on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section<'a> {
    /// Radius, m.
    pub radius_m: f64,
    /// Penetration depth, m.
    pub penetration_m: f64,
    /// Critical exposure, J/m².
    pub critical_j_m2: f64,
    /// Dose from evenly spaced azimuths, J/m²: beams ([`Inside::Straight`]) or on the surface
    /// ([`Inside::Radial`]); see [`SegmentDose`](super::dose::SegmentDose).
    pub doses_j_m2: &'a [f64],
    /// How it goes on inside.
    pub inside: Inside,
}

/// How much of a section is cured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cured {
    /// Share of the area above the critical exposure that carries, 0 to 1.
    pub area_fraction: f64,
    /// Share of the bending stiffness, about the softest axis through the cured part's own middle, 0 to 1.
    pub stiffness_fraction: f64,
    /// Least depth from the surface over the azimuths, m; the radius where it is cured through.
    pub least_depth_m: f64,
    /// Depth of the even shell of the same area, m.
    pub mean_depth_m: f64,
    /// Dose on the axis, J/m².
    pub axis_j_m2: f64,
}

impl Section<'_> {
    /// Dose at a radius and azimuth, J/m².
    ///
    /// Straight: `Σ H_i exp(−path_i/Dp)`, each beam parallel and in the plane of the section,
    /// `path = −r cos δ + sqrt(R² − r² sin² δ)`; on the axis `Σ H_i exp(−R/Dp)`. A lamp that lights the strand at
    /// a slant goes a longer way than this unless the strand refracts it. Radial:
    /// `H(ψ) exp(−(R − r)/Dp)`, the dose between azimuths by straight line. Bleaching is left out: it deepens
    /// long exposures. Source: process-physics.md section 1.1.
    pub fn dose_j_m2(&self, radius_m: f64, azimuth_rad: f64) -> f64 {
        let count = self.doses_j_m2.len() as f64;
        match self.inside {
            Inside::Straight => {
                let beams = self.doses_j_m2.iter().enumerate();
                beams
                    .map(|(i, dose)| {
                        let (sin, cos) = (azimuth_rad - TAU * i as f64 / count).sin_cos();
                        let chord2 = self.radius_m.powi(2) - (radius_m * sin).powi(2);
                        let path_m = (chord2.max(0.0).sqrt() - radius_m * cos).max(0.0);
                        dose * (-path_m / self.penetration_m).exp()
                    })
                    .sum()
            }
            Inside::Radial => {
                if self.doses_j_m2.is_empty() {
                    return 0.0;
                }
                let place = (azimuth_rad / TAU).rem_euclid(1.0) * count;
                let (index, share) = (place.floor(), place.fract());
                let at = |i: f64| self.doses_j_m2[(i as usize) % self.doses_j_m2.len()];
                let surface = at(index) + (at(index + 1.0) - at(index)) * share;
                surface * ((radius_m - self.radius_m) / self.penetration_m).exp()
            }
        }
    }

    /// Dose on the axis, J/m²: `Σ H_i exp(−R/Dp)` of beams; bent square, the mean of what arrives.
    pub fn axis_j_m2(&self) -> f64 {
        let sum: f64 = self.doses_j_m2.iter().sum();
        let at_axis = (-self.radius_m / self.penetration_m).exp();
        match self.inside {
            Inside::Straight => sum * at_axis,
            Inside::Radial => sum / self.doses_j_m2.len().max(1) as f64 * at_axis,
        }
    }

    /// What is above the critical exposure, by spokes and rings.
    ///
    /// On each spoke the logarithm of the dose is taken as straight between rings, which it nearly is, and the
    /// moments of the cured pieces are exact. Beside SHELL-EI for even light; 0.5 % of area and stiffness.
    /// 24 × 17 doses each a sum over the azimuths: about 4000 exponentials. Nothing is cured where an input
    /// is not a positive number.
    pub fn cured(&self) -> Cured {
        self.cured_under(0.0)
    }

    /// The same where air keeps a skin tacky, m: it counts in the depths and carries nothing.
    ///
    /// Source: process-physics.md 1.1 (10–50 µm).
    pub fn cured_under(&self, skin_m: f64) -> Cured {
        let carrying = (1.0 - (skin_m / self.radius_m).max(0.0)).max(0.0);
        let good = [self.radius_m, self.penetration_m, self.critical_j_m2];
        if !good.iter().all(|v| *v > 0.0 && v.is_finite()) {
            let nothing = (0.0, 0.0);
            return Cured {
                area_fraction: nothing.0,
                stiffness_fraction: nothing.1,
                least_depth_m: 0.0,
                mean_depth_m: 0.0,
                axis_j_m2: 0.0,
            };
        }
        // In radii: area, first moments, second moments of what is cured.
        let (mut whole, mut area, mut first, mut second) = (0.0, 0.0, [0.0; 2], [0.0; 3]);
        let mut least = 1.0_f64;
        let width = TAU / SPOKES as f64;
        for spoke in 0..SPOKES {
            let angle = width * (spoke as f64 + 0.5);
            let (pieces, whole_piece, depth) = self.spoke(angle, carrying);
            least = least.min(depth);
            let (sin, cos) = angle.sin_cos();
            whole += whole_piece * width;
            area += pieces[0] * width;
            first[0] += pieces[1] * cos * width;
            first[1] += pieces[1] * sin * width;
            second[0] += pieces[2] * cos * cos * width;
            second[1] += pieces[2] * sin * sin * width;
            second[2] += pieces[2] * sin * cos * width;
        }
        let area_fraction = (area / PI).clamp(0.0, 1.0);
        let whole_fraction = (whole / PI).clamp(0.0, 1.0);
        Cured {
            area_fraction,
            stiffness_fraction: (softest(area, first, second) / (PI / 4.0)).clamp(0.0, 1.0),
            least_depth_m: least * self.radius_m,
            mean_depth_m: (1.0 - (1.0 - whole_fraction).sqrt()) * self.radius_m,
            axis_j_m2: self.axis_j_m2(),
        }
    }

    /// The cured pieces of a spoke up to a share of the radius: `∫ r dr`, `∫ r² dr`, `∫ r³ dr` in radii; the first of
    /// these up to the surface, and the depth from there to the first that is not cured.
    fn spoke(&self, angle_rad: f64, carrying: f64) -> ([f64; 3], f64, f64) {
        let excess = |ring: usize| {
            let radius_m = self.radius_m * ring as f64 / RINGS as f64;
            (self.dose_j_m2(radius_m, angle_rad) / self.critical_j_m2).ln()
        };
        let (mut pieces, mut whole) = ([0.0; 3], 0.0);
        let (mut depth, mut open) = (1.0, true);
        let mut outer = excess(RINGS);
        for ring in (0..RINGS).rev() {
            let inner = excess(ring);
            let (low, high) = (ring as f64 / RINGS as f64, (ring + 1) as f64 / RINGS as f64);
            // Share of the piece, from outside, at which the dose crosses.
            let cross = high - (high - low) * (outer / (outer - inner)).clamp(0.0, 1.0);
            let cured = match (outer >= 0.0, inner >= 0.0) {
                (true, true) => Some((low, high)),
                (true, false) => Some((if cross.is_finite() { cross } else { high }, high)),
                (false, true) => Some((low, cross)),
                (false, false) => None,
            };
            if open && !(outer >= 0.0 && inner >= 0.0) {
                (open, depth) = (false, 1.0 - cured.map_or(high, |piece| piece.0.max(cross)));
                if outer < 0.0 {
                    depth = 1.0 - high;
                }
            }
            if let Some((from, to)) = cured {
                whole += (to.powi(2) - from.powi(2)) / 2.0;
                let (from, to) = (from.min(carrying), to.min(carrying));
                for (power, sum) in pieces.iter_mut().enumerate() {
                    let n = power as i32 + 2;
                    *sum += (to.powi(n) - from.powi(n)) / f64::from(n);
                }
            }
            outer = inner;
        }
        (pieces, whole, depth)
    }
}

/// Least second moment about an axis through the middle of a figure.
fn softest(area: f64, first: [f64; 2], second: [f64; 3]) -> f64 {
    if !(area > 0.0) {
        return 0.0;
    }
    let xx = second[0] - first[0] * first[0] / area;
    let yy = second[1] - first[1] * first[1] / area;
    let xy = second[2] - first[0] * first[1] / area;
    0.5 * (xx + yy) - (0.5 * (xx - yy)).hypot(xy)
}

/// Speed at which a strand lit from several sides is just cured to the axis, m/s.
///
/// `v = N I ℓ exp(−R/Dp) / Ec`: N beams of irradiance `I` W/m² over a lit length `ℓ` m. Case COCOONER gives a
/// speed but no irradiance: read backwards.
pub fn through_cure_speed_m_s(
    beams: f64,
    irradiance_w_m2: f64,
    lit_m: f64,
    radius_m: f64,
    penetration_m: f64,
    critical_j_m2: f64,
) -> f64 {
    beams * irradiance_w_m2 * lit_m * (-radius_m / penetration_m).exp() / critical_j_m2
}

/// Irradiance that gels a surface within a length, W/m²: `Ec v / x`. Case MASSIVIT-SPEED.
pub fn irradiance_to_set_w_m2(critical_j_m2: f64, speed_m_s: f64, within_m: f64) -> f64 {
    critical_j_m2 * speed_m_s / within_m
}

/// Least depth over evenly spaced surface doses by the working curve, m: `Dp ln(H_least/Ec)`.
pub fn least_shell_m(penetration_m: f64, surface_j_m2: &[f64], critical_j_m2: f64) -> f64 {
    let least = surface_j_m2.iter().copied().fold(f64::INFINITY, f64::min);
    cure_depth_m(penetration_m, least, critical_j_m2)
}
