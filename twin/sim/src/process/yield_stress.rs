//! Gels that flow past a yield stress and build it up again after the nozzle.

use super::gel::{cantilever_length_m, clamped_span_m, hanging_length_m};

/// Herschel–Bulkley fluid: `τ = τ_y + K γ̇ⁿ` past the yield stress, rigid below it.
///
/// 5 wt% fumed silica: `τ_y` 15–250 Pa, `K` 5–80 Pa sⁿ, `n` 0.3–0.7, all from memory (process-physics.md 1.3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HerschelBulkley {
    /// Yield stress in shear, Pa.
    pub yield_pa: f64,
    /// Consistency, Pa sⁿ.
    pub consistency_pa_sn: f64,
    /// Index; one is a Bingham fluid.
    pub index: f64,
}

impl HerschelBulkley {
    /// Shear stress at a shear rate, Pa; at rest the yield stress.
    pub fn stress_pa(&self, rate_per_s: f64) -> f64 {
        self.yield_pa + self.consistency_pa_sn * rate_per_s.abs().powf(self.index)
    }

    /// Shear rate under a shear stress, 1/s; zero up to the yield stress.
    pub fn rate_per_s(&self, stress_pa: f64) -> f64 {
        let over_pa = stress_pa.abs() - self.yield_pa;
        if over_pa <= 0.0 {
            return 0.0;
        }
        (over_pa / self.consistency_pa_sn).powf(1.0 / self.index) * stress_pa.signum()
    }

    /// The same gel with its structure built up to a level: `τ_y λ`.
    ///
    /// That the consistency does not change with structure is ours, unmeasured.
    #[must_use]
    pub fn at_structure(self, level: f64) -> Self {
        Self { yield_pa: self.yield_pa * level.clamp(0.0, 1.0), ..self }
    }
}

/// Structure of a gel, 0 (sheared apart) to 1 (rested): `dλ/dt = (1 − λ)/t_rec − β γ̇ λ`.
///
/// `t_rec` 1–60 s, from memory; `β` is nobody's and comes from a step-shear test. Source: process-physics.md 1.3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Structure {
    /// Time of recovery at rest, s.
    pub recovery_s: f64,
    /// Breakdown to a unit of shear.
    pub breakdown: f64,
}

impl Structure {
    /// Level after a time at rest, s: `1 − (1 − λ0) exp(−t/t_rec)`.
    pub fn rested(&self, start: f64, time_s: f64) -> f64 {
        1.0 - (1.0 - start) * (-time_s / self.recovery_s).exp()
    }

    /// Level that shear at a rate, 1/s, comes to: `1/(1 + β γ̇ t_rec)`.
    pub fn steady(&self, rate_per_s: f64) -> f64 {
        1.0 / (1.0 + self.breakdown * rate_per_s.abs() * self.recovery_s)
    }

    /// Level after a time of shear at a constant rate: `λ∞ + (λ0 − λ∞) exp[−(1/t_rec + β γ̇) t]`.
    pub fn sheared(&self, start: f64, rate_per_s: f64, time_s: f64) -> f64 {
        let steady = self.steady(rate_per_s);
        let speed_per_s = 1.0 / self.recovery_s + self.breakdown * rate_per_s.abs();
        steady + (start - steady) * (-speed_per_s * time_s).exp()
    }

    /// Age at which a level is reached at rest, s: `t_rec ln[(1 − λ0)/(1 − λ)]`; zero if it is there already,
    /// infinite from one on.
    pub fn age_to_s(&self, start: f64, level: f64) -> f64 {
        if level <= start {
            return 0.0;
        }
        if level >= 1.0 {
            return f64::INFINITY;
        }
        self.recovery_s * ((1.0 - start) / (1.0 - level)).ln()
    }
}

/// Yield stress at an age after the nozzle, Pa: `τ_y(a) = τ_y [1 − (1 − λ0) exp(−a/t_rec)]`.
///
/// `λ0` is what the shear in the nozzle left ([`Structure::sheared`]). A strand lit within a second has had
/// no time to recover where `t_rec` is seconds: it then hangs by about `λ0 τ_y`.
pub fn yield_at_age_pa(rested_pa: f64, structure: Structure, start: f64, age_s: f64) -> f64 {
    rested_pa * structure.rested(start, age_s).clamp(0.0, 1.0)
}

/// Longest lengths a gel carries itself over, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carried {
    /// Hanging straight down.
    pub hanging_m: f64,
    /// Level, held at one end.
    pub cantilever_m: f64,
    /// Level, held at both ends.
    pub clamped_m: f64,
}

/// Those lengths for a yield stress, weight `ρ g` N/m³ and diameter: [`super::gel`] at once.
///
/// Zero without yield stress; infinite or no number without weight.
pub fn carried(yield_pa: f64, weight_n_m3: f64, diameter_m: f64) -> Carried {
    Carried {
        hanging_m: hanging_length_m(yield_pa, weight_n_m3),
        cantilever_m: cantilever_length_m(yield_pa, weight_n_m3, diameter_m),
        clamped_m: clamped_span_m(yield_pa, weight_n_m3, diameter_m),
    }
}

/// Capillary pressure in a strand, Pa: `γ/R`. 22 Pa at 33 mN/m and a radius of 1.5 mm.
pub fn capillary_pa(surface_tension_n_m: f64, radius_m: f64) -> f64 {
    surface_tension_n_m / radius_m
}

/// Whether a gel holds its shape against its own surface: `τ_y ≥ γ/R`; below it corners round off and
/// strands bead up. An order of magnitude (process-physics.md 1.3).
pub fn holds_shape(yield_pa: f64, surface_tension_n_m: f64, radius_m: f64) -> bool {
    yield_pa >= capillary_pa(surface_tension_n_m, radius_m)
}
