//! How far a gel carries itself before it flows.

/// Longest length that hangs straight down, m: `√3 τ_y / (ρ g)`, von Mises.
///
/// `yield_pa` in shear, `weight_n_m3 = ρ g`. Case YIELD-HANG; capillary forces left out.
pub fn hanging_length_m(yield_pa: f64, weight_n_m3: f64) -> f64 {
    3.0_f64.sqrt() * yield_pa / weight_n_m3
}

/// Longest cantilever, m: full plastic section `M_p = √3 τ_y D³/6` at the root, `w L²/2 = M_p`.
///
/// Case YIELD-CANT. Shear is left out, so short stubby lengths are a little optimistic.
pub fn cantilever_length_m(yield_pa: f64, weight_n_m3: f64, diameter_m: f64) -> f64 {
    (2.0 * plastic_length2(yield_pa, weight_n_m3, diameter_m)).sqrt()
}

/// Longest span held at both ends, m: three hinges, `w L²/16 = M_p`. Case YIELD-CC.
pub fn clamped_span_m(yield_pa: f64, weight_n_m3: f64, diameter_m: f64) -> f64 {
    (16.0 * plastic_length2(yield_pa, weight_n_m3, diameter_m)).sqrt()
}

/// `M_p / w`, m².
fn plastic_length2(yield_pa: f64, weight_n_m3: f64, diameter_m: f64) -> f64 {
    2.0 * yield_pa * diameter_m / (3.0_f64.sqrt() * std::f64::consts::PI * weight_n_m3)
}
