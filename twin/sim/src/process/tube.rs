//! Flow of a yield-stress fluid through a nozzle or hose.

use std::f64::consts::PI;

use super::yield_stress::HerschelBulkley;

/// Shear rate at the wall of a tube, 1/s: `8 v/D (3n + 1)/(4n)`, mean speed m/s.
///
/// Rabinowitsch for a power law; of a yield-stress fluid a lower bound, since the plug takes less shear
/// ([`wall_stress_pa`] has it exactly).
pub fn wall_rate_per_s(speed_m_s: f64, diameter_m: f64, index: f64) -> f64 {
    8.0 * speed_m_s / diameter_m * (3.0 * index + 1.0) / (4.0 * index)
}

/// Flow through a tube for a wall shear stress, m³/s; Herschel–Bulkley, laminar, no slip.
///
/// `Q = π R³ n (τ_w/K)^(1/n) (1 − φ)^(1 + 1/n) [(1 − φ)²/(3n + 1) + 2 φ (1 − φ)/(2n + 1) + φ²/(n + 1)]`, `φ = τ_y/τ_w`;
/// zero up to the yield stress. Becomes Poiseuille without yield stress at `n = 1`, Buckingham–Reiner with.
/// Gels slip at smooth walls, which makes the pressure less: not known here.
pub fn tube_flow_m3_s(fluid: &HerschelBulkley, wall_stress_pa: f64, diameter_m: f64) -> f64 {
    if wall_stress_pa <= fluid.yield_pa {
        return 0.0;
    }
    let n = fluid.index;
    let plug = fluid.yield_pa / wall_stress_pa;
    let sheared = 1.0 - plug;
    let shape = sheared * sheared / (3.0 * n + 1.0)
        + 2.0 * plug * sheared / (2.0 * n + 1.0)
        + plug * plug / (n + 1.0);
    let rate_per_s = (wall_stress_pa / fluid.consistency_pa_sn).powf(1.0 / n);
    PI * (0.5 * diameter_m).powi(3) * n * rate_per_s * sheared.powf(1.0 + 1.0 / n) * shape
}

/// Shear stress at the wall for a flow, Pa: the law above turned round by halving, to 1e-14.
///
/// The yield stress at no flow, which is what it takes to start; no number where the fluid's consistency or
/// index, the diameter or the flow make no sense.
pub fn wall_stress_pa(fluid: &HerschelBulkley, flow_m3_s: f64, diameter_m: f64) -> f64 {
    let sound = [fluid.consistency_pa_sn, fluid.index, diameter_m].iter().all(|&v| v > 0.0)
        && fluid.yield_pa >= 0.0
        && flow_m3_s >= 0.0;
    if !sound {
        return f64::NAN;
    }
    let n = fluid.index;
    // the power law's stress, an upper bound of what is added to the yield stress but for the plug's factor
    let rate_per_s = flow_m3_s * (3.0 * n + 1.0) / (n * PI * (0.5 * diameter_m).powi(3));
    let mut extra_pa = fluid.consistency_pa_sn * rate_per_s.powf(n);
    let flow = |extra: f64| tube_flow_m3_s(fluid, fluid.yield_pa + extra, diameter_m);
    for _ in 0..200 {
        if !(flow(extra_pa) < flow_m3_s) {
            break;
        }
        extra_pa *= 2.0;
    }
    let (mut low, mut high) = (0.0, extra_pa);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if flow(middle) < flow_m3_s {
            low = middle
        } else {
            high = middle
        }
        if high - low <= 1e-14 * high {
            break;
        }
    }
    fluid.yield_pa + high
}

/// Pressure over a tube, Pa: `Δp = 4 L τ_w / D`; entry and exit losses left out. 10 µs.
pub fn pressure_drop_pa(
    fluid: &HerschelBulkley,
    flow_m3_s: f64,
    diameter_m: f64,
    length_m: f64,
) -> f64 {
    4.0 * length_m / diameter_m * wall_stress_pa(fluid, flow_m3_s, diameter_m)
}
