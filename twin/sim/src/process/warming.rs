//! A round strand that warms by its own heat of cure, ring by ring, which makes it cure faster.

use super::cured::Exposed;
use super::kamal::CureCurve;
use super::kinetics::{Kinetics, arrhenius};
use super::solid::adiabatic_rise_k;
use conduction::Rings;

mod conduction;
#[cfg(test)]
mod tests;

/// Rings of equal area.
pub const RINGS: usize = 8;
/// Steps to a stretch of light or darkness.
pub const STEPS: usize = 32;

/// A strand as its heat of cure sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Radius, m.
    pub radius_m: f64,
    /// Density, kg/m³.
    pub density_kg_m3: f64,
    /// Specific heat, J/(kg K).
    pub cp_j_kgk: f64,
    /// Conductivity, W/(m K).
    pub conductivity_w_mk: f64,
    /// Heat of a degree of cure of one, J/kg.
    pub enthalpy_j_kg: f64,
    /// Penetration depth of the light, m.
    pub penetration_m: f64,
}

/// A stretch of steady light on the surface, or of darkness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Age at which it begins, s.
    pub from_s: f64,
    /// Age at which it ends, s.
    pub to_s: f64,
    /// Irradiance on the surface, W/m².
    pub irradiance_w_m2: f64,
}

/// The air round the strand.
#[derive(Clone, Copy)]
pub struct Around<'a> {
    /// Its temperature, K; the strand leaves the nozzle as warm.
    pub air_k: f64,
    /// Heat transfer, W/(m² K), at a surface temperature, K, and an age, s; below zero counts as zero.
    pub h_w_m2k: &'a dyn Fn(f64, f64) -> f64,
}

/// What a run makes of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Warmed {
    /// Light and temperature of the surface against age, as [`super::cured::cure`] takes them.
    pub surface: Vec<Exposed>,
    /// Greatest temperature anywhere in the section, K.
    pub warmest_k: f64,
    /// Greatest mean temperature of the section, K.
    pub warmest_mean_k: f64,
    /// Degree of cure of the section at the end, mean by area.
    pub mean_degree: f64,
    /// Degree of cure of the surface at the end.
    pub surface_degree: f64,
}

/// Runs a strand through its light.
///
/// `ρ cp ∂T/∂t = ∇(k ∇T) + ρ ΔH ∂α/∂t`, `−k ∂T/∂r = h (T − T∞)` at the surface, `α` by [`Kinetics`] at the
/// ring's own temperature. Light is even from all sides and goes in square to the surface (what `through` calls
/// radial); at a depth cure goes by `exp[−(R − r)/Dp]` as fast. That is of the rate, not of the light: `Dp` is that of a
/// working curve, whose exposures differ in time, so it holds the exponent of the intensity already, and without heat
/// the front of gel is Jacobs' (ours; light alone would go by the power `b` and cure deeper than the working curve). Rings of equal area; each step conducts for a half, cures for the whole without
/// loss, conducts for a half; second order in the step (tested), stable at any `h`. The heat adds up: with `h = 0`
/// the mean temperature is `T0 + ΔH ᾱ/cp` to the rounding. A step is short at the start of a stretch, where cure is fast
/// (steps grow evenly). In 8 rings and 32 steps, at 3 mm and cured through, the mean rise is 0.5 % below that of a fine
/// run and the greatest, on the axis, 3.5 % above (tested to 1 and 5 %). The axis may get warmer than
/// `T0 + ΔH α_max/cp`: it is warmed before it cures.
///
/// Left out: heat of the light itself (dose·4/(D ρ cp), 1 K for 1.5 kJ/m² on 3 mm), heat along the strand, cure in
/// the dark, oxygen, a density or conductivity that changes with cure. `None` where a number is not
/// finite or not positive (the heat may be zero). Stretches that go back in age or have no length are passed over; at most
/// the first 16 are run. Cost: two looks into the cure table for each ring and step, 512 a lit stretch.
/// Source: process-physics.md 1.2 (exotherm, heat source in the radial model).
pub fn warm(
    kinetics: &Kinetics,
    curve: &CureCurve,
    body: &Body,
    stretches: &[Stretch],
    around: &Around,
) -> Option<Warmed> {
    warm_with(kinetics, curve, body, stretches, around, [RINGS, STEPS])
}

/// The same with numbers of rings (1 to 64) and of steps to a stretch (1 to 4096).
pub fn warm_with(
    kinetics: &Kinetics,
    curve: &CureCurve,
    body: &Body,
    stretches: &[Stretch],
    around: &Around,
    [rings, steps]: [usize; 2],
) -> Option<Warmed> {
    const MOST_STRETCHES: usize = 16;
    let mut run = Run::new(kinetics, curve, body, around, rings.clamp(1, 64))?;
    let mut age_s = f64::NEG_INFINITY;
    for stretch in stretches.iter().take(MOST_STRETCHES) {
        let length_s = stretch.to_s - stretch.from_s;
        if !(stretch.from_s >= age_s && length_s > 0.0 && length_s.is_finite()) {
            continue;
        }
        age_s = stretch.to_s;
        run.stretch(stretch, steps.clamp(1, 4096));
    }
    Some(run.done())
}

/// A run on its way.
struct Run<'a> {
    kinetics: &'a Kinetics,
    curve: &'a CureCurve,
    around: &'a Around<'a>,
    rings: Rings,
    /// Kelvins to a degree of cure of one.
    rise_k: f64,
    /// How fast each ring cures over the surface; the last is the surface itself, which holds no heat.
    share: Vec<f64>,
    kelvin: Vec<f64>,
    reduced_s: Vec<f64>,
    degree: Vec<f64>,
    out: Warmed,
}

impl<'a> Run<'a> {
    fn new(
        kinetics: &'a Kinetics,
        curve: &'a CureCurve,
        body: &Body,
        around: &'a Around<'a>,
        count: usize,
    ) -> Option<Self> {
        let Body { radius_m, density_kg_m3, cp_j_kgk, conductivity_w_mk, .. } = *body;
        let positive = [
            radius_m,
            density_kg_m3,
            cp_j_kgk,
            conductivity_w_mk,
            body.penetration_m,
            around.air_k,
        ];
        let rise_k = adiabatic_rise_k(body.enthalpy_j_kg, 1.0, cp_j_kgk);
        if !(positive.iter().all(|v| *v > 0.0 && v.is_finite()) && (0.0..1e6).contains(&rise_k)) {
            return None;
        }
        let rings = Rings::new(radius_m, conductivity_w_mk, density_kg_m3 * cp_j_kgk, count)?;
        let share = |r: f64| ((r - radius_m) / body.penetration_m).exp();
        let mut shares: Vec<f64> = rings.middles_m().iter().map(|&r| share(r)).collect();
        shares.push(1.0);
        Some(Self {
            kinetics,
            curve,
            around,
            rise_k,
            kelvin: vec![around.air_k; count + 1],
            reduced_s: vec![0.0; count + 1],
            degree: vec![0.0; count + 1],
            share: shares,
            rings,
            out: Warmed {
                surface: Vec::new(),
                warmest_k: around.air_k,
                warmest_mean_k: around.air_k,
                mean_degree: 0.0,
                surface_degree: 0.0,
            },
        })
    }

    fn stretch(&mut self, stretch: &Stretch, steps: usize) {
        let light = stretch.irradiance_w_m2;
        // What the light does at the reference temperature, ring by ring.
        let speed = self.kinetics.drive(light, self.kinetics.reference_k);
        let speeds: Vec<f64> = self.share.iter().map(|share| share * speed).collect();
        let length_s = stretch.to_s - stretch.from_s;
        let age = |k: usize| stretch.from_s + length_s * (k as f64 / steps as f64).powi(2);
        self.note(stretch.from_s, light);
        for k in 0..steps {
            let (from_s, to_s) = (age(k), age(k + 1));
            self.step(from_s, to_s - from_s, &speeds);
            self.note(to_s, light);
        }
    }

    fn step(&mut self, age_s: f64, step_s: f64, speeds: &[f64]) {
        let last = self.share.len() - 1;
        let before_k = self.kelvin[last];
        self.conduct(age_s, 0.5 * step_s);
        for (i, &speed) in speeds.iter().enumerate().take(last) {
            if speed > 0.0 {
                self.cure(i, step_s * speed);
            }
        }
        self.conduct(age_s + step_s, 0.5 * step_s);
        // The surface has no heat of its own: it cures at the mean of its temperatures.
        let middle_k = 0.5 * (before_k + self.kelvin[last]);
        self.reduced_s[last] += step_s * speeds[last] * self.heated(middle_k);
        self.degree[last] = self.curve.degree(self.reduced_s[last]);
    }

    /// Cure of a ring that keeps its heat, by the middle of the step.
    fn cure(&mut self, i: usize, cold_s: f64) {
        let [from_k, from_s, from] = [self.kelvin[i], self.reduced_s[i], self.degree[i]];
        let half = self.curve.degree(from_s + 0.5 * cold_s * self.heated(from_k));
        let middle_k = from_k + self.rise_k * (half - from);
        self.reduced_s[i] = from_s + cold_s * self.heated(middle_k);
        self.degree[i] = self.curve.degree(self.reduced_s[i]);
        self.kelvin[i] = from_k + self.rise_k * (self.degree[i] - from);
    }

    fn conduct(&mut self, age_s: f64, step_s: f64) {
        let last = self.share.len() - 1;
        let (rings_k, surface_k) = self.kelvin.split_at_mut(last);
        let h = (self.around.h_w_m2k)(surface_k[0], age_s);
        surface_k[0] = self.rings.conduct(rings_k, self.around.air_k, h, step_s);
    }

    fn heated(&self, kelvin: f64) -> f64 {
        arrhenius(self.kinetics.activation_j_mol, self.kinetics.reference_k, kelvin)
    }

    fn note(&mut self, age_s: f64, irradiance_w_m2: f64) {
        let last = self.share.len() - 1;
        let temperature_k = self.kelvin[last];
        self.out.surface.push(Exposed { age_s, irradiance_w_m2, temperature_k });
        let rings = &self.kelvin[..last];
        let mean_k = rings.iter().sum::<f64>() / last as f64;
        self.out.warmest_k = self.kelvin.iter().copied().fold(self.out.warmest_k, f64::max);
        self.out.warmest_mean_k = self.out.warmest_mean_k.max(mean_k);
    }

    fn done(mut self) -> Warmed {
        let last = self.share.len() - 1;
        self.out.mean_degree = self.degree[..last].iter().sum::<f64>() / last as f64;
        self.out.surface_degree = self.degree[last];
        self.out
    }
}
