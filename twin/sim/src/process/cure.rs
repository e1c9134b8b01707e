//! Setting by light and by the clock.

/// Depth to which a dose cures, m: `Cd = Dp ln(H/Ec)`, zero below the critical exposure.
///
/// Jacobs' working curve: penetration depth `Dp` m, dose `H` and critical exposure `Ec` J/m². The oxygen
/// at the surface is inside `Ec`; bleaching, which deepens long exposures, is left out. Case JACOBS-NUM.
pub fn cure_depth_m(penetration_m: f64, dose_j_m2: f64, critical_j_m2: f64) -> f64 {
    if dose_j_m2 <= critical_j_m2 {
        return 0.0;
    }
    penetration_m * (dose_j_m2 / critical_j_m2).ln()
}

/// Time to gel at an irradiance, s: `Ec / I`; infinite in the dark.
pub fn gel_time_s(critical_j_m2: f64, irradiance_w_m2: f64) -> f64 {
    critical_j_m2 / irradiance_w_m2
}

/// Where a strand is set behind the nozzle, m: `x = x_shadow + v t`. Infinite times stay so.
pub fn set_distance_m(shadow_m: f64, speed_m_s: f64, set_time_s: f64) -> f64 {
    shadow_m + speed_m_s * set_time_s
}

/// Share of the area that is cured, shell of depth `d` on radius `R`: `1 − (1 − d/R)²`. Case SHELL-EI.
pub fn shell_area_fraction(depth_m: f64, radius_m: f64) -> f64 {
    1.0 - core_ratio(depth_m, radius_m).powi(2)
}

/// Share of the bending stiffness that is cured: `1 − (1 − d/R)⁴`. Case SHELL-EI.
pub fn shell_stiffness_fraction(depth_m: f64, radius_m: f64) -> f64 {
    1.0 - core_ratio(depth_m, radius_m).powi(4)
}

/// Radius that stays uncured, m: `R − Cd`, at least zero.
pub fn uncured_core_m(depth_m: f64, radius_m: f64) -> f64 {
    (radius_m - depth_m).max(0.0)
}

/// Critical exposure at another temperature: `Ec(T) = Ec exp[Ea/R (1/T − 1/Tref)]`.
///
/// `activation_j_mol` about 30 kJ/mol (15 to 50), temperatures in K. Case ECT-NUM.
pub fn critical_exposure_at(
    reference_j_m2: f64,
    activation_j_mol: f64,
    reference_k: f64,
    temperature_k: f64,
) -> f64 {
    const GAS_J_MOL_K: f64 = 8.314_462_6;
    reference_j_m2
        * (activation_j_mol / GAS_J_MOL_K * (1.0 / temperature_k - 1.0 / reference_k)).exp()
}

/// Modulus between gel point and full dose, Pa: log-linear in the log of the dose.
///
/// `E = E_gel (E_set/E_gel)^x`, `x = ln(H/Ec) / ln(H_full/Ec)` held to 0..1; zero below `Ec`. The reference is
/// log-linear in the degree of cure; that the degree goes with the log of the dose is ours, unmeasured.
pub fn modulus_at_dose_pa(
    gel_pa: f64,
    set_pa: f64,
    dose_j_m2: f64,
    critical_j_m2: f64,
    full_j_m2: f64,
) -> f64 {
    if dose_j_m2 < critical_j_m2 {
        return 0.0;
    }
    if full_j_m2 <= critical_j_m2 {
        return gel_pa;
    }
    let x = ((dose_j_m2 / critical_j_m2).ln() / (full_j_m2 / critical_j_m2).ln()).clamp(0.0, 1.0);
    gel_pa * (set_pa / gel_pa).powf(x)
}

fn core_ratio(depth_m: f64, radius_m: f64) -> f64 {
    (1.0 - depth_m / radius_m).clamp(0.0, 1.0)
}
