//! Light that the bed throws back, what reaches the nozzle's tip, and when the lamps may go on.

use std::f64::consts::TAU;

use crate::pose::{Point, Vector, from_z_axis};

use super::lamp::{Lamp, surface_irradiance_w_m2};
use super::shade::{Shade, is_blocked};

/// Rays from a place over its half-space, in square of the sine and in azimuth.
const RINGS: u32 = 12;
const SPOKES: u32 = 24;
/// Places round the rim that are looked at.
const RIM: u32 = 8;

/// A flat bed that throws light back evenly, in the axes of the lamps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bed {
    /// A point of it, m.
    pub point: Point,
    /// Away from it, of unit length.
    pub normal: Vector,
    /// Share of the light that it throws back, 0 to 1.
    pub albedo: f64,
}

impl Bed {
    /// Irradiance by the bed's own glow on a surface with a unit normal, W/m².
    ///
    /// First bounce of a Lambert bed: `E = ∫ ρ E_bed/π cos θ dω` over the half-space of the surface, so
    /// `E = ρ` times the mean of `E_bed` where rays spread by the cosine law meet the bed. No singularity at
    /// the bed itself, where it is `ρ E_bed`. 288 rays by lamps by shades; 2 % while the bright patch is seen
    /// under more than about 15° (see tests). Later bounces and gloss are left out.
    pub fn reflected_w_m2(
        &self,
        lamps: &[Lamp],
        shades: &[Shade],
        place: Point,
        facing: Vector,
    ) -> f64 {
        let height_m = (place - self.point).dot(&self.normal);
        let axes = from_z_axis(place, facing, Vector::x());
        let mut sum = 0.0;
        for ring in 0..RINGS {
            let sine2 = (f64::from(ring) + 0.5) / f64::from(RINGS);
            let (sine, cosine) = (sine2.sqrt(), (1.0 - sine2).sqrt());
            for spoke in 0..SPOKES {
                let (y, x) = (TAU * (f64::from(spoke) + 0.5) / f64::from(SPOKES)).sin_cos();
                let ray = axes * Vector::new(sine * x, sine * y, cosine);
                let sinking = -ray.dot(&self.normal);
                if height_m > 0.0 && sinking > 1e-6 {
                    let lit = place + ray * (height_m / sinking);
                    if !is_blocked(shades, place, lit) {
                        sum += surface_irradiance_w_m2(lamps, shades, lit, self.normal);
                    }
                }
            }
        }
        self.albedo * sum / f64::from(RINGS * SPOKES)
    }
}

/// The end of the nozzle, in tool axes (origin in the orifice, z the way the strand leaves).
#[derive(Debug, Clone, Copy)]
pub struct Tip<'a> {
    /// Radius of the rim that resin wets, m.
    pub rim_m: f64,
    /// Lamps on the tool.
    pub lamps: &'a [Lamp],
    /// What shades them; the nozzle itself must end a hair above the orifice.
    pub shades: &'a [Shade],
}

/// Light on the tip, W/m².
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipLight {
    /// Straight from the lamps on the outside of the rim, greatest round it.
    pub direct_w_m2: f64,
    /// From the bed on the face of the rim, greatest round it.
    pub reflected_w_m2: f64,
}

impl Tip<'_> {
    /// Light on the rim at a distance above a level bed of some albedo.
    ///
    /// The strand between tip and bed, which hides some of the bed, is left out: on the safe side.
    pub fn light(&self, bed_m: f64, albedo: f64) -> TipLight {
        let bed = Bed { point: Point::new(0.0, 0.0, bed_m), normal: -Vector::z(), albedo };
        let mut light = TipLight { direct_w_m2: 0.0, reflected_w_m2: 0.0 };
        for i in 0..RIM {
            let (y, x) = (TAU * f64::from(i) / f64::from(RIM)).sin_cos();
            let out = Vector::new(x, y, 0.0);
            let place = Point::origin() + out * self.rim_m;
            let direct = surface_irradiance_w_m2(self.lamps, self.shades, place, out);
            let reflected = bed.reflected_w_m2(self.lamps, self.shades, place, Vector::z());
            light.direct_w_m2 = light.direct_w_m2.max(direct);
            light.reflected_w_m2 = light.reflected_w_m2.max(reflected);
        }
        light
    }

    /// Distance from the bed beyond which its light on the tip stays below a limit, m.
    ///
    /// Looks from `farthest_m` inwards at 48 distances that shrink by a constant factor to a hundredth of it, then
    /// bisects; infinite where even the farthest is too bright, zero where no distance is. `limit_w_m2` from
    /// [`tip_limit_w_m2`]. About 70 × 8 × 288 rays by lamps: tens of milliseconds, once for a tool.
    pub fn clear_m(&self, limit_w_m2: f64, albedo: f64, farthest_m: f64) -> f64 {
        const LOOKS: i32 = 48;
        let bright = |m: f64| self.light(m, albedo).reflected_w_m2 > limit_w_m2;
        if !(farthest_m > 0.0) || bright(farthest_m) {
            return f64::INFINITY;
        }
        let ratio = 0.01_f64.powf(1.0 / f64::from(LOOKS));
        let (mut dark_m, mut found) = (farthest_m, None);
        for _ in 0..LOOKS {
            let next_m = dark_m * ratio;
            if bright(next_m) {
                found = Some(next_m);
                break;
            }
            dark_m = next_m;
        }
        let Some(mut bright_m) = found else { return 0.0 };
        for _ in 0..20 {
            let middle_m = 0.5 * (bright_m + dark_m);
            if bright(middle_m) { bright_m = middle_m } else { dark_m = middle_m }
        }
        dark_m
    }
}

/// Irradiance on the tip that is still allowed, W/m²: a share of `Ec` in the time resin stays there.
///
/// `s Ec / t`. How long resin stays on the rim is nowhere measured; a caller takes the strand's own
/// passage `D/v` or longer.
pub fn tip_limit_w_m2(share: f64, critical_j_m2: f64, residence_s: f64) -> f64 {
    share * critical_j_m2 / residence_s
}

/// Length to print in the dark before the lamps may go on, m.
///
/// `(clear − h) / rise`: the bed is `h` below the orifice at the start and each metre of path lifts the
/// orifice by `rise` from it. Falls with the distance of the bed, zero beyond `clear`; infinite where the path does not rise.
/// Kirkman prints 3 mm without lights (KIRKMAN-SET).
pub fn lights_on_after_m(clear_m: f64, bed_m: f64, rise: f64) -> f64 {
    if bed_m >= clear_m {
        0.0
    } else if rise > 0.0 {
        (clear_m - bed_m) / rise
    } else {
        f64::INFINITY
    }
}

/// Where a strand may set behind the nozzle: nearer cures the nozzle, farther sags.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SetBand {
    /// Nearest place, m.
    pub near_m: f64,
    /// Farthest place, m: what the gel carries unset, see [`gel`](super::gel).
    pub far_m: f64,
}

/// Where a set distance falls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SetPlace {
    /// The nozzle cures.
    TooNear,
    /// Inside the band.
    Inside,
    /// The strand sags, or never sets.
    TooFar,
}

impl SetBand {
    /// Where a set distance falls; not a number counts as too far.
    pub fn place(&self, set_m: f64) -> SetPlace {
        if set_m < self.near_m {
            SetPlace::TooNear
        } else if set_m <= self.far_m {
            SetPlace::Inside
        } else {
            SetPlace::TooFar
        }
    }

    /// Least and greatest speed that set inside the band, m/s: `v = (x − x_shadow)/t_gel`, at least zero.
    ///
    /// From `x = x_shadow + v t_gel` ([`set_distance_m`](super::cure::set_distance_m)).
    pub fn speeds_m_s(&self, shadow_m: f64, gel_s: f64) -> [f64; 2] {
        [self.near_m, self.far_m].map(|set_m| ((set_m - shadow_m) / gel_s).max(0.0))
    }
}
