//! Viscosity of a melt and how fast it ages.

use crate::interval::Interval;

/// Coefficients of a Cross-WLF fit; they share one factor of uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossWlf {
    /// D1, Pa s.
    pub d1_pa_s: f64,
    /// T*, K.
    pub t_star_k: f64,
    /// A1.
    pub a1: f64,
    /// A2, K.
    pub a2_k: f64,
    /// True viscosity over the fit.
    pub factor: Interval,
}

impl CrossWlf {
    /// Zero-shear viscosity of the fit (factor one), Pa s.
    ///
    /// `η0 = D1 exp(−A1 (T − T*) / (A2 + T − T*))`. The shear rate in a sagging strand is far below
    /// 1/s, so the Cross part plays no role. At and below `T* − A2`, where the fit has its pole, the
    /// strand is taken as rigid: infinite. Source: process-physics.md section 2.3.
    pub fn zero_shear_pa_s(&self, temperature_k: f64) -> f64 {
        let above_pole_k = self.a2_k + temperature_k - self.t_star_k;
        if above_pole_k <= 0.0 {
            return f64::INFINITY;
        }
        self.d1_pa_s * (-self.a1 * (temperature_k - self.t_star_k) / above_pole_k).exp()
    }

    /// Temperature at which the fit reaches a viscosity, K.
    ///
    /// Inverse of [`Self::zero_shear_pa_s`]: `T = T* − A2 l / (A1 + l)`, `l = ln(η/D1)`; for
    /// viscosities above `D1 exp(−A1)`, the limit of a hot melt.
    pub fn temperature_k(&self, viscosity_pa_s: f64) -> f64 {
        let log = (viscosity_pa_s / self.d1_pa_s).ln();
        self.t_star_k - self.a2_k * log / (self.a1 + log)
    }

    /// Time in which the viscosity of a cooling strand grows by e, s.
    ///
    /// `τ = (A2 + T − T*)² / (A1 A2 r (T − T∞))`, from `dT/da = −r (T − T∞)`; `rate_per_s` is `r`.
    /// Infinite where the strand does not cool.
    pub fn e_folding_s(&self, temperature_k: f64, air_k: f64, rate_per_s: f64) -> f64 {
        let above_pole_k = (self.a2_k + temperature_k - self.t_star_k).max(0.0);
        let cooling = self.a1 * self.a2_k * rate_per_s * (temperature_k - air_k);
        if cooling <= 0.0 { f64::INFINITY } else { above_pole_k * above_pole_k / cooling }
    }
}
