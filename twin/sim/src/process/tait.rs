//! Density of a polymer from melt to solid by Tait's two branches.

#[cfg(test)]
mod tests;

/// Tait's universal constant.
const TAIT_C: f64 = 0.0894;

/// Coefficients of a two-branch Tait fit, as printed in moulding data sheets.
///
/// `m` is the melt, `s` the solid. No term for crystals (`b7` to `b9`): for amorphous polymers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tait {
    /// Transition temperature at no pressure, K.
    pub b5_k: f64,
    /// Its rise with pressure, K/Pa.
    pub b6_k_pa: f64,
    /// Branch of the melt.
    pub melt: TaitBranch,
    /// Branch of the solid.
    pub solid: TaitBranch,
}

/// One branch of the fit; `T̄ = T − b5`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaitBranch {
    /// Specific volume at the transition, m³/kg.
    pub b1_m3_kg: f64,
    /// Its rise with temperature, m³/(kg K).
    pub b2_m3_kgk: f64,
    /// Stiffness against pressure at the transition, Pa.
    pub b3_pa: f64,
    /// How it falls with temperature, 1/K.
    pub b4_per_k: f64,
}

impl TaitBranch {
    /// Volume and its slope over temperature at `T̄` and a pressure.
    fn volume_and_slope(&self, over_k: f64, pressure_pa: f64) -> (f64, f64) {
        let stiffness = self.b3_pa * (-self.b4_per_k * over_k).exp();
        let free = self.b1_m3_kg + self.b2_m3_kgk * over_k;
        let squeeze = 1.0 - TAIT_C * (pressure_pa / stiffness).ln_1p();
        let squeeze_slope = -TAIT_C * self.b4_per_k * pressure_pa / (stiffness + pressure_pa);
        (free * squeeze, self.b2_m3_kgk * squeeze + free * squeeze_slope)
    }
}

impl Tait {
    /// Temperature at which melt turns to solid, K: `b5 + b6 P`.
    pub fn transition_k(&self, pressure_pa: f64) -> f64 {
        self.b5_k + self.b6_k_pa * pressure_pa
    }

    /// Specific volume, m³/kg.
    ///
    /// `v = (b1 + b2 T̄) [1 − C ln(1 + P/B)]`, `B = b3 exp(−b4 T̄)`, `T̄ = T − b5`, `C = 0.0894`; melt above
    /// `b5 + b6 P`, solid at and below. Temperature in K, pressure over the atmosphere in Pa. Fits hold to
    /// 0.2 % between 20 °C and the melt's usual temperatures, slow cooling (from memory). Where the branches
    /// meet under pressure a fit may jump: that of ABS in the reference makes the solid 1.1 % lighter than
    /// the melt at 100 MPa, though even at none; a strand in air knows no pressure. Not a number where
    /// the pressure pulls apart. Case ABS-TAIT within 0.002; process-physics.md section 2.6.
    pub fn specific_volume_m3_kg(&self, temperature_k: f64, pressure_pa: f64) -> f64 {
        self.volume_and_slope(temperature_k, pressure_pa).0
    }

    /// Density, kg/m³.
    pub fn density_kg_m3(&self, temperature_k: f64, pressure_pa: f64) -> f64 {
        1.0 / self.specific_volume_m3_kg(temperature_k, pressure_pa)
    }

    /// Local coefficient of linear expansion, 1/K: `(1/3v) ∂v/∂T`.
    pub fn linear_expansion_per_k(&self, temperature_k: f64, pressure_pa: f64) -> f64 {
        let (volume, slope) = self.volume_and_slope(temperature_k, pressure_pa);
        slope / (3.0 * volume)
    }

    /// Linear strain of free, even contraction between two temperatures, at no pressure.
    ///
    /// `(v_to/v_from)^⅓ − 1`, negative where it shrinks.
    pub fn linear_strain(&self, from_k: f64, to_k: f64) -> f64 {
        self.volume_ratio(from_k, to_k).cbrt() - 1.0
    }

    /// Volume at one temperature over that at another, at no pressure: `v_to/v_from`.
    ///
    /// Of a strand held in length while it is melt, all of it goes into the section:
    /// `D_to/D_from = √(v_to/v_from)`.
    pub fn volume_ratio(&self, from_k: f64, to_k: f64) -> f64 {
        self.specific_volume_m3_kg(to_k, 0.0) / self.specific_volume_m3_kg(from_k, 0.0)
    }

    fn volume_and_slope(&self, temperature_k: f64, pressure_pa: f64) -> (f64, f64) {
        let melt = temperature_k > self.transition_k(pressure_pa);
        let branch = if melt { &self.melt } else { &self.solid };
        branch.volume_and_slope(temperature_k - self.b5_k, pressure_pa)
    }
}
