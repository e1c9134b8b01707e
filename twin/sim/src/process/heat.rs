//! How a strand of a millimetre loses its heat to the air.

use std::f64::consts::PI;

/// Stefan–Boltzmann constant, W/(m² K⁴).
const STEFAN_BOLTZMANN: f64 = 5.670_374e-8;
/// Standard gravity, m/s².
const GRAVITY_M_S2: f64 = 9.806_65;

/// Air at one bar.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AirProperties {
    /// Kinematic viscosity, m²/s.
    pub viscosity_m2_s: f64,
    /// Thermal conductivity, W/(m K).
    pub conductivity_w_mk: f64,
    /// Prandtl number.
    pub prandtl: f64,
}

/// Air at one atmosphere and a temperature, K.
///
/// Sutherland's laws for viscosity (1.716e-5 Pa s at 273.15 K, 110.4 K) and conductivity
/// (0.0241 W/(m K), 194 K), ideal gas, cp 1007 J/(kg K); within 2 % from 200 to 600 K.
pub fn air_properties(temperature_k: f64) -> AirProperties {
    let t = temperature_k.max(50.0);
    let ratio = (t / 273.15) * (t / 273.15).sqrt();
    let viscosity_pa_s = 1.716e-5 * ratio * (273.15 + 110.4) / (t + 110.4);
    let conductivity_w_mk = 0.0241 * ratio * (273.15 + 194.0) / (t + 194.0);
    let density_kg_m3 = 101_325.0 / (287.05 * t);
    AirProperties {
        viscosity_m2_s: viscosity_pa_s / density_kg_m3,
        conductivity_w_mk,
        prandtl: viscosity_pa_s * 1007.0 / conductivity_w_mk,
    }
}

/// Heat transfer by natural convection from a horizontal cylinder, W/(m² K).
///
/// Churchill–Chu 1975: `Nu = {0.60 + 0.387 Ra^(1/6) / [1 + (0.559/Pr)^(9/16)]^(8/27)}²`, properties at
/// the film temperature, diameter in m, temperatures in K; for `Ra < 1e12`. Case NUSSELT-THIN: ±20 %.
pub fn natural_h_w_m2k(diameter_m: f64, surface_k: f64, air_k: f64) -> f64 {
    let film_k = 0.5 * (surface_k + air_k);
    let air = air_properties(film_k);
    let diffusivity_m2_s = air.viscosity_m2_s / air.prandtl;
    let rayleigh = GRAVITY_M_S2 / film_k * (surface_k - air_k).abs() * diameter_m.powi(3)
        / (air.viscosity_m2_s * diffusivity_m2_s);
    let prandtl = (1.0 + (0.559 / air.prandtl).powf(9.0 / 16.0)).powf(8.0 / 27.0);
    let root = 0.60 + 0.387 * rayleigh.powf(1.0 / 6.0) / prandtl;
    root * root * air.conductivity_w_mk / diameter_m
}

/// Heat transfer from a cylinder in cross flow, W/(m² K).
///
/// Churchill–Bernstein 1977: `Nu = 0.3 + 0.62 Re^½ Pr^⅓ / [1 + (0.4/Pr)^⅔]^¼ · [1 + (Re/282000)^⅝]^⅘`,
/// properties at the film temperature, air speed in m/s; for `Re Pr > 0.2`. Case NUSSELT-THIN: ±20 %.
pub fn forced_h_w_m2k(diameter_m: f64, surface_k: f64, air_k: f64, air_m_s: f64) -> f64 {
    let air = air_properties(0.5 * (surface_k + air_k));
    let reynolds = air_m_s.abs() * diameter_m / air.viscosity_m2_s;
    let prandtl = air.prandtl.cbrt() / (1.0 + (0.4 / air.prandtl).powf(2.0 / 3.0)).powf(0.25);
    let turbulent = (1.0 + (reynolds / 282_000.0).powf(0.625)).powf(0.8);
    let nusselt = 0.3 + 0.62 * reynolds.sqrt() * prandtl * turbulent;
    nusselt * air.conductivity_w_mk / diameter_m
}

/// Heat transfer by radiation to surroundings at air temperature, W/(m² K).
///
/// `h = ε σ (Ts² + T∞²)(Ts + T∞)`; the surroundings are large and as warm as the air.
pub fn radiation_h_w_m2k(emissivity: f64, surface_k: f64, air_k: f64) -> f64 {
    emissivity * STEFAN_BOLTZMANN * (surface_k * surface_k + air_k * air_k) * (surface_k + air_k)
}

/// All of it, W/(m² K): the greater of natural and forced convection, plus radiation.
///
/// Taking the greater, rather than a blend, is within 20 % where the two are alike.
pub fn total_h_w_m2k(
    diameter_m: f64,
    surface_k: f64,
    air_k: f64,
    air_m_s: f64,
    emissivity: f64,
) -> f64 {
    let natural = natural_h_w_m2k(diameter_m, surface_k, air_k);
    let forced =
        if air_m_s > 0.0 { forced_h_w_m2k(diameter_m, surface_k, air_k, air_m_s) } else { 0.0 };
    natural.max(forced) + radiation_h_w_m2k(emissivity, surface_k, air_k)
}

/// Heat transfer seen by the mean temperature of the section, W/(m² K): `1/h_eff = 1/h + R/(4k)`.
///
/// `k` W/(m K), `R = D/2` m. Error of the time to a temperature at most 2 % for `Bi = hR/k ≤ 0.7`, 6 %
/// at 1.5, 15 % at 3. Source: case COOL-EFFH.
pub fn effective_h_w_m2k(h_w_m2k: f64, diameter_m: f64, conductivity_w_mk: f64) -> f64 {
    1.0 / (1.0 / h_w_m2k + diameter_m / (8.0 * conductivity_w_mk))
}

/// Rate at which a round strand comes to air temperature, 1/s: `r = 4 h / (ρ cp D)`.
///
/// Perimeter over heat capacity per length; `h_w_m2k` is the effective one. Case COOL-LUMP.
pub fn cooling_rate_per_s(h_w_m2k: f64, density_kg_m3: f64, cp_j_kgk: f64, diameter_m: f64) -> f64 {
    let perimeter_m = PI * diameter_m;
    let area_m2 = PI * diameter_m * diameter_m / 4.0;
    h_w_m2k * perimeter_m / (density_kg_m3 * cp_j_kgk * area_m2)
}

/// Mean temperature of a section against its age: exponential in the jet, then exponential in the room.
///
/// `T = T∞ + (T0 − T∞) exp(−∫r da)`, `r` the jet's rate up to `jet_until_s` and the room's after. The jet
/// travels with the nozzle, so a section leaves it at the age `reach / v`. Heat from the nozzle, along
/// the strand, and the warmth of neighbours are left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cooling {
    /// Temperature at the nozzle, K.
    pub start_k: f64,
    /// Temperature of the air, K.
    pub air_k: f64,
    /// Rate in the jet, 1/s.
    pub jet_rate_per_s: f64,
    /// Age at which a section leaves the jet, s; zero where there is none.
    pub jet_until_s: f64,
    /// Rate in the room, 1/s.
    pub room_rate_per_s: f64,
}

impl Cooling {
    /// Mean temperature of the section at an age, K.
    pub fn temperature_k(&self, age_s: f64) -> f64 {
        let age_s = age_s.max(0.0);
        let in_jet_s = age_s.min(self.jet_until_s);
        let decades =
            self.jet_rate_per_s * in_jet_s + self.room_rate_per_s * (age_s - in_jet_s).max(0.0);
        self.air_k + (self.start_k - self.air_k) * (-decades).exp()
    }

    /// Age at which the mean temperature reaches a target, s; infinite if it never does.
    pub fn time_to_s(&self, target_k: f64) -> f64 {
        if target_k >= self.start_k {
            return 0.0;
        }
        if target_k <= self.air_k {
            return f64::INFINITY;
        }
        let exponent = ((self.start_k - self.air_k) / (target_k - self.air_k)).ln();
        let in_jet = self.jet_rate_per_s * self.jet_until_s;
        if exponent <= in_jet {
            exponent / self.jet_rate_per_s
        } else {
            self.jet_until_s + (exponent - in_jet) / self.room_rate_per_s
        }
    }

    /// `∫ (T − T∞) da` between two ages, K s; closed form.
    pub fn excess_k_s(&self, from_s: f64, to_s: f64) -> f64 {
        self.excess_from_start_k_s(to_s) - self.excess_from_start_k_s(from_s)
    }

    fn excess_from_start_k_s(&self, age_s: f64) -> f64 {
        let excess_k = self.start_k - self.air_k;
        let in_jet_s = age_s.min(self.jet_until_s);
        let after_s = (age_s - in_jet_s).max(0.0);
        let at_exit = (-self.jet_rate_per_s * in_jet_s).exp();
        excess_k
            * (decay_integral_s(self.jet_rate_per_s, in_jet_s)
                + at_exit * decay_integral_s(self.room_rate_per_s, after_s))
    }
}

/// `∫₀ᵗ exp(−r s) ds`, also where the rate is zero.
fn decay_integral_s(rate_per_s: f64, time_s: f64) -> f64 {
    if rate_per_s > 0.0 { -(-rate_per_s * time_s).exp_m1() / rate_per_s } else { time_s }
}

/// Young's modulus through the glass transition, Pa.
///
/// `E = E_g / (1 + exp((T − Tg)/4 K)) + E_plateau`. The width of 4 K and the shape are an assumption of
/// the reference, unmeasured. Source: process-physics.md section 2.3.
pub fn modulus_through_glass_pa(
    glassy_pa: f64,
    plateau_pa: f64,
    temperature_k: f64,
    glass_k: f64,
) -> f64 {
    const WIDTH_K: f64 = 4.0;
    glassy_pa / (1.0 + ((temperature_k - glass_k) / WIDTH_K).exp()) + plateau_pa
}
