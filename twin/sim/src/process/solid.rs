//! What a degree of cure is worth: modulus, shrinkage, heat, and the section made of rings.

/// Young's modulus against degree of cure.
///
/// `E = E_gel (E_full/E_gel)^[(α − α_gel)/(α_full − α_gel)]` from the gel point on, nothing below it, where the
/// strand is a fluid of modulus `3η/t`. Log-linear (process-physics.md 1.2); `E_gel` about 1 MPa is from memory.
/// Goes on past `α_full` (post-cure).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stiffening {
    /// Modulus at the gel point, Pa.
    pub gel_pa: f64,
    /// Modulus at the full degree of cure (green: where cure at room temperature stops), Pa.
    pub full_pa: f64,
    /// Degree of cure at the gel point.
    pub gel: f64,
    /// The full degree of cure.
    pub full: f64,
}

impl Stiffening {
    /// Young's modulus, Pa.
    pub fn modulus_pa(&self, degree: f64) -> f64 {
        if !(degree >= self.gel) {
            return 0.0;
        }
        let share = (degree - self.gel) / (self.full - self.gel);
        self.gel_pa * (self.full_pa / self.gel_pa).powf(share)
    }

    /// Degree of cure at which the modulus is so many Pa: the law turned round.
    pub fn degree_at(&self, modulus_pa: f64) -> f64 {
        let share = (modulus_pa / self.gel_pa).ln() / (self.full_pa / self.gel_pa).ln();
        self.gel + share * (self.full - self.gel)
    }
}

/// Linear strain shrunk since the gel point: `ε = ε_post (α − α_gel)/(α_full − α_gel)`, zero below, `ε_post` above.
///
/// Straight in the degree of cure because each bond takes the same volume away. Source: process-physics.md 1.2.
pub fn shrunk_strain(post_gel_strain: f64, gel: f64, full: f64, degree: f64) -> f64 {
    if !(degree > gel) {
        return 0.0;
    }
    post_gel_strain * ((degree - gel) / (full - gel)).clamp(0.0, 1.0)
}

/// Heat of cure, W/m³: `q = ρ ΔH dα/dt`; `ΔH` J/kg for a degree of one, rate 1/s.
///
/// Over a step take `(α₁ − α₀)/Δt` as rate: the heat then adds up to `ρ ΔH α` whatever the steps.
pub fn cure_heat_w_m3(density_kg_m3: f64, enthalpy_j_kg: f64, rate_per_s: f64) -> f64 {
    density_kg_m3 * enthalpy_j_kg * rate_per_s
}

/// Rise where no heat leaves, K: `ΔH α/cp`. About 130 K at 330 kJ/kg, 0.7, 1800 J/(kg K).
pub fn adiabatic_rise_k(enthalpy_j_kg: f64, degree: f64, cp_j_kgk: f64) -> f64 {
    enthalpy_j_kg * degree / cp_j_kgk
}

/// A round section cured ring by ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// Axial stiffness over that of the whole section fully cured: `Σ E_j (r²) / (E_full R²)`.
    pub axial: f64,
    /// Bending stiffness likewise, with `r⁴`.
    pub bending: f64,
    /// Mean degree of cure by area; the skin counts here.
    pub mean_degree: f64,
    /// Radius from the axis on that has not gelled, m: to the outer edge of the last such ring.
    pub core_m: f64,
    /// Whether the axis has gelled.
    pub core_gelled: bool,
}

/// A section from the degree of cure of its rings.
///
/// `edges_m` ascend from 0 to the radius, one more than `degrees`, which go from the axis out; missing ones
/// are left out, a ring whose edges do not ascend counts nothing. `skin_m` at the outside stays tacky and
/// carries nothing. The core is known to a ring. Cost: one power to a ring.
pub fn section(edges_m: &[f64], degrees: &[f64], stiffening: &Stiffening, skin_m: f64) -> Section {
    let radius_m = edges_m.last().copied().unwrap_or(0.0);
    let solid_m = (radius_m - skin_m.max(0.0)).max(0.0);
    let mut out = Section {
        axial: 0.0,
        bending: 0.0,
        mean_degree: 0.0,
        core_m: 0.0,
        core_gelled: degrees.first().is_some_and(|&degree| degree >= stiffening.gel),
    };
    let mut inside_core = true;
    for (edges, &degree) in edges_m.windows(2).zip(degrees) {
        let gelled = degree >= stiffening.gel;
        inside_core &= !gelled;
        if inside_core {
            out.core_m = edges[1];
        }
        let [inner, outer] = [edges[0] / radius_m, edges[1] / radius_m];
        if !(outer > inner && inner >= 0.0) {
            continue;
        }
        out.mean_degree += degree * (outer.powi(2) - inner.powi(2));
        let (inner, outer) = (inner.min(solid_m / radius_m), outer.min(solid_m / radius_m));
        let stiff = stiffening.modulus_pa(degree) / stiffening.full_pa;
        out.axial += stiff * (outer.powi(2) - inner.powi(2));
        out.bending += stiff * (outer.powi(4) - inner.powi(4));
    }
    out
}
