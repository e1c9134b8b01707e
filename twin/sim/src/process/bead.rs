//! Cross-section of a strand from flow and speed.

use std::f64::consts::PI;

/// Diameter of a round strand as it is drawn from the nozzle, m.
///
/// `D = sqrt(4 Q / (π v))`, flow `Q` in m³/s, speed `v` in m/s. Mass conservation; holds for draw
/// ratios near and above one (an over-fed strand meanders instead, and this is the diameter of the
/// same volume per length of path). Not a number or infinite where the speed is not positive.
/// Source: process-physics.md section 4, case MASS-BALANCE.
pub fn drawn_diameter_m(flow_m3_s: f64, speed_m_s: f64) -> f64 {
    (4.0 * flow_m3_s / (PI * speed_m_s)).sqrt()
}

/// Flow that gives a drawn strand of this diameter at this speed, m³/s: `Q = π D² v / 4`.
///
/// Inverse of [`drawn_diameter_m`].
pub fn flow_m3_s(diameter_m: f64, speed_m_s: f64) -> f64 {
    PI * diameter_m * diameter_m * speed_m_s / 4.0
}

/// Diameter once set, m: `D_cold = D_hot (ρ_hot / ρ_cold)^½`.
///
/// The volume lost is taken up across the strand, its length being held between nozzle and node;
/// what is lost along it is shrinkage. Source: process-physics.md section 2.6.
pub fn cold_diameter_m(hot_m: f64, hot_density_kg_m3: f64, cold_density_kg_m3: f64) -> f64 {
    hot_m * (hot_density_kg_m3 / cold_density_kg_m3).sqrt()
}

/// Speed at which a strand leaves the nozzle when nothing draws it, m/s.
///
/// `v_free = 4 Q / (π B² D_n²)`, swell `B` = free strand diameter over nozzle diameter `D_n` (m).
/// Source: process-physics.md section 4.
pub fn free_speed_m_s(flow_m3_s: f64, nozzle_diameter_m: f64, swell: f64) -> f64 {
    drawn_speed(flow_m3_s, swell * nozzle_diameter_m)
}

/// Draw ratio `v / v_free`: below one the strand is over-fed (slack, meander, coil), above about
/// three it thins and may break. Source: process-physics.md section 4, case SEWING-ONSET.
pub fn draw_ratio(flow_m3_s: f64, speed_m_s: f64, nozzle_diameter_m: f64, swell: f64) -> f64 {
    speed_m_s / free_speed_m_s(flow_m3_s, nozzle_diameter_m, swell)
}

/// Strain by which an over-fed strand is longer than its path: `1/DR − 1`, zero where `DR ≥ 1`.
pub fn overfeed_strain(draw_ratio: f64) -> f64 {
    (1.0 / draw_ratio - 1.0).max(0.0)
}

/// Width of a bead pressed flat to a height on bed or form, m: `Q / (v h)`.
///
/// A rectangle of the same area; rounded sides make the true bead wider by `h (1 − π/4)`.
pub fn flattened_width_m(flow_m3_s: f64, speed_m_s: f64, height_m: f64) -> f64 {
    flow_m3_s / (speed_m_s * height_m)
}

fn drawn_speed(flow_m3_s: f64, diameter_m: f64) -> f64 {
    4.0 * flow_m3_s / (PI * diameter_m * diameter_m)
}
