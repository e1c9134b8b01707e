//! Lamps as geometry: place, axis, lobe; a ring of them around the nozzle and what keeps light off the orifice.

use std::f64::consts::{LN_2, TAU};

use crate::pose::{Point, Pose, Vector};

use super::light::LightRing;
use super::shade::{Shade, is_blocked};

/// How the intensity of a lamp falls off with the angle from its axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lobe {
    /// `J = J0 exp(−θ²/2σ²)`, `σ = φ/2 / sqrt(2 ln 2)`: half at half the full angle `φ`.
    Gaussian,
    /// `J = J0 cosᵖ θ`; the power stands here, the full angle is not used. A flat diffuse source has one.
    Lambert(f64),
}

/// A lamp small against its distance, in the axes of what carries it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lamp {
    /// Where it is, m.
    pub at: Point,
    /// Where it points, of unit length.
    pub along: Vector,
    /// Intensity on the axis, W/sr.
    pub peak_w_sr: f64,
    /// Full angle between the directions of half intensity, rad.
    pub full_angle_rad: f64,
    /// How the intensity falls off.
    pub lobe: Lobe,
}

impl Lamp {
    /// Intensity in the direction whose angle from the axis has this cosine, W/sr.
    ///
    /// Nothing behind the lamp. Case LED-15DEG for the peak of a Gaussian lobe
    /// ([`gaussian_peak_w_sr`](super::light::gaussian_peak_w_sr)).
    pub fn intensity_w_sr(&self, cosine: f64) -> f64 {
        if cosine <= 0.0 {
            return 0.0;
        }
        match self.lobe {
            Lobe::Gaussian => {
                let width = 4.0 * LN_2 / (self.full_angle_rad * self.full_angle_rad);
                self.peak_w_sr * (-width * square_of_angle(cosine)).exp()
            }
            Lobe::Lambert(1.0) => self.peak_w_sr * cosine,
            Lobe::Lambert(power) => self.peak_w_sr * cosine.powf(power),
        }
    }

    /// Irradiance of a surface square to the ray, as a vector the way the light goes, W/m².
    ///
    /// `E = J(θ)/r²` along the ray. A surface of unit normal `n` receives `max(0, −E·n)`. Point source: good
    /// to a per cent from five times the lamp's own width on. Zero at the lamp itself.
    /// Source: process-physics.md section 1.1.
    pub fn irradiance_w_m2(&self, point: Point) -> Vector {
        let ray = point - self.at;
        let distance2 = ray.norm_squared();
        if distance2 == 0.0 {
            return Vector::zeros();
        }
        let distance_m = distance2.sqrt();
        let intensity = self.intensity_w_sr(self.along.dot(&ray) / distance_m);
        ray * (intensity / (distance2 * distance_m))
    }

    /// Cosine of the angle from the axis beyond which the intensity is below a share of the peak.
    pub fn cosine_at_share(&self, share: f64) -> f64 {
        let fall = -share.clamp(1e-300, 1.0).ln();
        match self.lobe {
            Lobe::Gaussian => {
                let angle = self.full_angle_rad.abs() * (fall / (4.0 * LN_2)).sqrt();
                angle.min(std::f64::consts::FRAC_PI_2).cos()
            }
            Lobe::Lambert(power) if power > 0.0 => (-fall / power).exp(),
            Lobe::Lambert(_) => 0.0,
        }
    }

    /// The same lamp seen from other axes.
    pub fn moved(&self, pose: &Pose) -> Self {
        Self { at: pose * self.at, along: pose * self.along, ..*self }
    }
}

/// Irradiance of a surface with a unit normal by lamps that shades may hide, W/m².
///
/// Lamps times shades in cost.
pub fn surface_irradiance_w_m2(
    lamps: &[Lamp],
    shades: &[Shade],
    point: Point,
    normal: Vector,
) -> f64 {
    lamps
        .iter()
        .map(|lamp| {
            let received = -lamp.irradiance_w_m2(point).dot(&normal);
            if received > 0.0 && !is_blocked(shades, lamp.at, point) { received } else { 0.0 }
        })
        .sum()
}

/// Power of the cosine lobe that is down to half at half a full angle: `p = ln ½ / ln cos(φ/2)`.
pub fn lambert_power(full_angle_rad: f64) -> f64 {
    -LN_2 / (0.5 * full_angle_rad).cos().ln()
}

/// Where the lamps of a ring stand, in tool axes (origin in the orifice, z the way the strand leaves).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingPlace {
    /// How many lamps.
    pub count: u32,
    /// From the nozzle's axis to a lamp, m.
    pub radius_m: f64,
    /// Lamps above the orifice, m.
    pub height_m: f64,
    /// Below the orifice, the point of the axis that all of them aim at, m.
    pub aim_m: f64,
}

impl RingPlace {
    /// Where the ring of a tool file stands: `distance_m` from the point aimed at, `angle_rad` from the axis.
    ///
    /// The tool file does not say what it aims at; `aim_m` below the orifice comes from elsewhere
    /// (kirkman-nozzle.toml: 2 mm, in a comment).
    pub fn of(ring: &LightRing, aim_m: f64) -> Self {
        Self {
            count: ring.leds,
            radius_m: ring.distance_m * ring.angle_rad.sin().abs(),
            height_m: ring.distance_m * ring.angle_rad.cos() - aim_m,
            aim_m,
        }
    }

    /// The lamps, the first on the x axis; at most 4096.
    pub fn lamps(&self, peak_w_sr: f64, full_angle_rad: f64, lobe: Lobe) -> Vec<Lamp> {
        let count = self.count.min(4096);
        (0..count)
            .map(|i| {
                let (sin, cos) = (TAU * f64::from(i) / f64::from(count)).sin_cos();
                let at = Point::new(self.radius_m * cos, self.radius_m * sin, -self.height_m);
                let ray = Point::new(0.0, 0.0, self.aim_m) - at;
                Lamp { at, along: ray / ray.norm(), peak_w_sr, full_angle_rad, lobe }
            })
            .collect()
    }

    /// The disc above the orifice that keeps the light off the first `shadow_m` of a straight strand.
    ///
    /// Its edge is where the line from a lamp to the strand's near side at `shadow_m` passes `above_m` above
    /// the orifice: `ρ = R + (r − R)(x + a)/(x + h)` for strand radius `R`, ring radius `r`, height `h`.
    /// The nozzle passes through the middle, so it has no hole. The flanks of the strand stay dark a little
    /// longer, and the edge is sharp: lamps are points. `above_m` at most the lamps' height.
    pub fn shadow(&self, shadow_m: f64, strand_radius_m: f64, above_m: f64) -> Shade {
        let share = (shadow_m + above_m) / (shadow_m + self.height_m);
        Shade::Disc {
            centre: Point::new(0.0, 0.0, -above_m),
            normal: Vector::z(),
            radius_m: strand_radius_m + share * (self.radius_m - strand_radius_m),
        }
    }
}

/// Square of the angle with a cosine, rad²: the series of arcsin², below 45° good to 1e-6.
///
/// Three times faster than the arccosine, and lamps are asked a hundred thousand times per strand.
fn square_of_angle(cosine: f64) -> f64 {
    let versine = 1.0 - cosine;
    if !(versine < 0.3) {
        let angle = cosine.clamp(-1.0, 1.0).acos();
        return angle * angle;
    }
    let series = [1.0 / 6.0, 2.0 / 45.0, 1.0 / 70.0, 8.0 / 1575.0, 4.0 / 2079.0, 0.000_761_1];
    let sum = series.iter().rev().fold(0.0, |sum, c| (sum + c) * versine);
    2.0 * versine.max(0.0) * (1.0 + sum)
}
