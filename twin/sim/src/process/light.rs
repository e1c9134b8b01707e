//! Light on a strand from a ring of lamps around the nozzle.

use std::f64::consts::PI;

use crate::interval::Interval;

/// Lamps around the nozzle, all aimed at one place on the strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LightRing {
    /// How many.
    pub leds: u32,
    /// From a lamp to the strand along its axis, m.
    pub distance_m: f64,
    /// Between a lamp's axis and the strand, rad; a right angle lights the side square on.
    pub angle_rad: f64,
    /// Peak intensity of one, W/sr.
    pub intensity_w_sr: Interval,
    /// Full angle between the directions of half intensity, rad.
    pub full_angle_rad: f64,
    /// Length behind the orifice that no light reaches, m.
    pub shadow_m: f64,
    /// Below the orifice, the point that all lamps aim at, m.
    pub aim_m: f64,
}

impl LightRing {
    /// Irradiance on the side of the strand, mean over its circumference, W/m².
    ///
    /// `I = (J/r²) (N/π) sin α`: each lamp lights half the circumference by the cosine, whose mean over the
    /// whole is `1/π`. `intensity_w_sr` is `J`. Strand thin against the spot. Source: process-physics.md 1.1.
    pub fn irradiance_w_m2(&self, intensity_w_sr: f64) -> f64 {
        intensity_w_sr / (self.distance_m * self.distance_m) * f64::from(self.leds) / PI
            * self.angle_rad.sin().abs()
    }

    /// Length of strand in the light, m: the spot's full width at half maximum laid along the strand,
    /// `2 r tan(φ/2) / sin α`. Uniform inside, dark outside.
    pub fn lit_length_m(&self) -> f64 {
        2.0 * self.distance_m * (0.5 * self.full_angle_rad).tan()
            / self.angle_rad.sin().abs().max(1e-3)
    }

    /// Dose of a section once the ring has passed, J/m²: `H = ∫ I dt = I ℓ_lit / v`.
    pub fn dose_j_m2(&self, intensity_w_sr: f64, speed_m_s: f64) -> f64 {
        self.irradiance_w_m2(intensity_w_sr) * self.lit_length_m() / speed_m_s
    }
}

/// Peak intensity of a lamp of Gaussian lobe, W/sr: `J = Φ / (2π σ²)`, `σ = φ/2 / sqrt(2 ln 2)`.
///
/// `flux_w` is the radiant flux; narrow lobes. Case LED-15DEG.
pub fn gaussian_peak_w_sr(flux_w: f64, full_angle_rad: f64) -> f64 {
    let sigma = 0.5 * full_angle_rad / (2.0 * std::f64::consts::LN_2).sqrt();
    flux_w / (2.0 * PI * sigma * sigma)
}
