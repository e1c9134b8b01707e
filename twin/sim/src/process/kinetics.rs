//! How fast light cures a resin: intensity, temperature, calibration by the critical exposure.

use super::kamal::Kamal;

/// Gas constant, J/(mol K).
pub(super) const GAS_J_MOL_K: f64 = 8.314_462_6;

/// Speed of a reaction over that at the reference temperature: `exp[−Ea/R (1/T − 1/T_ref)]`.
///
/// Activation J/mol, temperatures K. Zero where a temperature is not positive or anything is no number.
pub fn arrhenius(activation_j_mol: f64, reference_k: f64, temperature_k: f64) -> f64 {
    if !(temperature_k > 0.0 && reference_k > 0.0) {
        return 0.0;
    }
    let speed = (-activation_j_mol / GAS_J_MOL_K * (1.0 / temperature_k - 1.0 / reference_k)).exp();
    if speed.is_nan() { 0.0 } else { speed.min(1e300) }
}

/// Cure by light: `dα/dt = (k1 + k2 αᵐ)(α_max − α)ⁿ`, `k_i = A_i (I/I0)ᵇ exp(−Ea/RT)`.
///
/// The reference's law (process-physics.md 1.2). `kamal` holds `k1`, `k2` at reference light and temperature,
/// so `A_i = k_i exp(Ea/R T_ref)`. Both rates scale alike, so light and heat only stretch time: after any
/// history `α` is the reference curve at the reduced time `∫ (I/I0)ᵇ exp[−Ea/R (1/T − 1/T_ref)] dt`, exactly. Reduced
/// times add, which makes splitting a step, second passes and rings at other intensities free of error.
/// `b` is 1 (dose alone counts) to 0.5 (termination in pairs; then the dose to gel grows as `I¹⁻ᵇ`), from
/// memory. No light, no cure: what radicals do after the light is left out. Oxygen is inside the critical
/// exposure ([`super::oxygen`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kinetics {
    /// The law at reference light and temperature.
    pub kamal: Kamal,
    /// Exponent of the intensity.
    pub b: f64,
    /// Activation energy, J/mol.
    pub activation_j_mol: f64,
    /// Reference irradiance, W/m²: that at which the critical exposure was measured.
    pub reference_w_m2: f64,
    /// Reference temperature, K.
    pub reference_k: f64,
}

impl Kinetics {
    /// The same law so that the critical exposure at reference light and temperature just gels: `α(Ec) = α_gel`.
    ///
    /// Nobody has published `A`; a working curve gives `Ec`, J/m², and with it the gel time `Ec/I0`. Of the
    /// rates given only `k2/k1` is kept, and is not established. It decides how fast cure goes on after the
    /// gel point: nine tenths of it take 20, 6, 4 gel times at ratios of 0, 20, 1000 (reference's orders).
    #[must_use]
    pub fn calibrated(self, critical_exposure_j_m2: f64) -> Self {
        let gel_s = critical_exposure_j_m2 / self.reference_w_m2;
        Self { kamal: self.kamal.gelling_in(gel_s), ..self }
    }

    /// Seconds of reference cure in a second: `(I/I0)ᵇ exp[−Ea/R (1/T − 1/T_ref)]`.
    ///
    /// Irradiance W/m², temperature K. Zero in the dark and where anything is no number.
    pub fn drive(&self, irradiance_w_m2: f64, temperature_k: f64) -> f64 {
        if !(irradiance_w_m2 > 0.0 && self.reference_w_m2 > 0.0 && self.b >= 0.0) {
            return 0.0;
        }
        let light = (irradiance_w_m2 / self.reference_w_m2).powf(self.b);
        let drive = light * arrhenius(self.activation_j_mol, self.reference_k, temperature_k);
        if drive.is_nan() { 0.0 } else { drive.min(1e300) }
    }

    /// `dα/dt`, 1/s.
    pub fn rate_per_s(&self, degree: f64, irradiance_w_m2: f64, temperature_k: f64) -> f64 {
        self.kamal.rate_per_s(degree) * self.drive(irradiance_w_m2, temperature_k)
    }

    /// Time to gel at constant light and temperature, s; infinite in the dark.
    pub fn gel_time_s(&self, irradiance_w_m2: f64, temperature_k: f64) -> f64 {
        self.kamal.time_to_s(self.kamal.gel) / self.drive(irradiance_w_m2, temperature_k)
    }
}
