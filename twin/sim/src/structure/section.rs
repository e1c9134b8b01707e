//! Cross-sections and elastic constants of members.

use std::f64::consts::PI;

/// Cross-section of a member about its own axes: x along it, y and z across.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// Area A, m².
    pub area_m2: f64,
    /// Second moment about y (bending in the x-z plane), m⁴.
    pub iy_m4: f64,
    /// Second moment about z (bending in the x-y plane), m⁴.
    pub iz_m4: f64,
    /// Torsion constant J, m⁴.
    pub j_m4: f64,
    /// Shear coefficient κ of `κ G A`; infinite is Euler-Bernoulli, without shear.
    pub shear_kappa: f64,
    /// Distance of the outermost fibre from the axis, m.
    pub fibre_m: f64,
}

impl Section {
    /// Solid circle, without shear: `A = π d²/4`, `I = π d⁴/64`, `J = 2 I`.
    pub fn circle(diameter_m: f64) -> Self {
        Self::ellipse(diameter_m, diameter_m)
    }

    /// Solid ellipse of full width along y and full height along z, without shear.
    ///
    /// With half axes a, b: `A = π a b`, `Iy = π a b³/4`, `Iz = π a³ b/4`, Saint-Venant's
    /// `J = π a³ b³/(a² + b²)` (exact for an ellipse).
    pub fn ellipse(width_m: f64, height_m: f64) -> Self {
        let (a, b) = (width_m / 2.0, height_m / 2.0);
        Self {
            area_m2: PI * a * b,
            iy_m4: PI * a * b.powi(3) / 4.0,
            iz_m4: PI * a.powi(3) * b / 4.0,
            j_m4: PI * (a * b).powi(3) / (a * a + b * b),
            shear_kappa: f64::INFINITY,
            fibre_m: a.max(b),
        }
    }

    /// The same section with a shear coefficient (Timoshenko). A stocky member, such as the link
    /// between two crossing strands, needs it: without it it is stiff as its length cubed.
    #[must_use]
    pub fn sheared(self, kappa: f64) -> Self {
        Self { shear_kappa: kappa, ..self }
    }

    /// Cowper's coefficient of a solid circle, `κ = 6 (1 + ν)/(7 + 6 ν)` (Cowper 1966).
    pub fn cowper_circle(poisson: f64) -> f64 {
        6.0 * (1.0 + poisson) / (7.0 + 6.0 * poisson)
    }

    /// Whether every number is usable: positive, and finite except κ.
    pub(crate) fn is_usable(&self) -> bool {
        [self.area_m2, self.iy_m4, self.iz_m4, self.j_m4, self.fibre_m]
            .iter()
            .all(|number| number.is_finite() && *number > 0.0)
            && self.shear_kappa > 0.0
    }
}

/// Elastic constants. G is a number of its own: printed strands need not be isotropic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// Young's modulus E along the member, Pa.
    pub e_pa: f64,
    /// Shear modulus G, Pa.
    pub g_pa: f64,
}

impl Elastic {
    /// Isotropic: `G = E/(2 (1 + ν))`.
    pub fn isotropic(e_pa: f64, poisson: f64) -> Self {
        Self { e_pa, g_pa: e_pa / (2.0 * (1.0 + poisson)) }
    }

    /// Poisson's number the pair would imply if isotropic, `ν = E/(2 G) - 1`, where no printing
    /// material has it (outside 0 to 0.5). The pair is used as given all the same.
    pub fn impossible_pair(&self) -> Option<f64> {
        let poisson = self.e_pa / (2.0 * self.g_pa) - 1.0;
        (!(-1e-12..=0.5 + 1e-12).contains(&poisson)).then_some(poisson)
    }

    /// Whether both are positive and finite.
    pub(crate) fn is_usable(&self) -> bool {
        [self.e_pa, self.g_pa].iter().all(|number| number.is_finite() && *number > 0.0)
    }
}
