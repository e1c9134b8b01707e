//! Sag of a single strand: behind the nozzle (A), by slack (B), once set (C).

use std::f64::consts::PI;

use super::elastica::heavy_elastica;

/// Moments of the fluidity `f = 1/(3 η)` over age: `G_n = ∫ aⁿ f(a) da`, n = 0..4, sⁿ/Pa.
///
/// `G_0` is the compliance frozen into a section, `1/E_eff` (case EEFF-FROZEN). In distance behind a
/// nozzle of speed `v` the moments are `F_n = vⁿ⁺¹ G_n`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fluidity {
    /// G_0 to G_4.
    pub moments: [f64; 5],
}

/// Nodes and weights of five-point Gauss–Legendre quadrature on −1..1.
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

impl Fluidity {
    /// Integrates a fluidity, 1/(Pa s) of age s, piece by piece between `breaks` (ascending ages, s).
    ///
    /// Composite Gauss–Legendre, five points to each of `panels`, in `u` where `a = a0 + (a1 − a0) u²`, so
    /// points crowd where the strand is hot. Tenth order where the fluidity is smooth inside each piece,
    /// exact for a constant one. The last break must lie where the fluidity is below 1e-14 of its start:
    /// at 1e-6 the tail of `a⁴ f` still holds a percent of the sag.
    pub fn integrate(fluidity: impl Fn(f64) -> f64, breaks: &[f64], panels: u32) -> Self {
        let count = panels.max(1);
        let mut moments = [0.0; 5];
        for piece in breaks.windows(2) {
            let (from_s, length_s) = (piece[0], piece[1] - piece[0]);
            for panel in 0..count {
                for (node, weight) in GAUSS {
                    let u = (f64::from(panel) + 0.5 + 0.5 * node) / f64::from(count);
                    let age_s = from_s + length_s * u * u;
                    let mut term = fluidity(age_s) * weight * u * length_s / f64::from(count);
                    for moment in &mut moments {
                        *moment += term;
                        term *= age_s;
                    }
                }
            }
        }
        Self { moments }
    }

    /// Moments of a fluid that is constant up to an age and rigid after: `G_n = tⁿ⁺¹ / (3 η (n+1))`.
    pub fn constant(viscosity_pa_s: f64, until_s: f64) -> Self {
        let moment =
            |n: usize| until_s.powi(n as i32 + 1) / (3.0 * viscosity_pa_s * (n + 1) as f64);
        Self { moments: std::array::from_fn(moment) }
    }

    /// The same for a viscosity higher by a factor; sag is inverse to it.
    #[must_use]
    pub fn thicker(self, factor: f64) -> Self {
        Self { moments: self.moments.map(|moment| moment / factor) }
    }

    fn in_distance(self, speed_m_s: f64) -> [f64; 5] {
        let mut power = 1.0;
        self.moments.map(|moment| {
            power *= speed_m_s;
            moment * power
        })
    }
}

/// A strand as the beam behind the nozzle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SoftBeam {
    /// Diameter while soft, m.
    pub diameter_m: f64,
    /// Density while soft, kg/m³.
    pub density_kg_m3: f64,
    /// Gravity across the strand, m/s².
    pub across_m_s2: f64,
    /// Speed of the nozzle, m/s.
    pub speed_m_s: f64,
    /// Length that hangs free between its last hold and the nozzle at the end, m.
    pub span_m: f64,
}

impl SoftBeam {
    /// Load over bending inertia, `w/I = 16 ρ g / D²`, Pa/m².
    pub fn load_over_inertia(&self) -> f64 {
        16.0 * self.density_kg_m3 * self.across_m_s2.abs() / (self.diameter_m * self.diameter_m)
    }

    /// Sag below the nozzle path where the nozzle clamps the slope, m; small slopes.
    ///
    /// `[F0 F1; F1 F2][M0; V0] = −(w/2)[F2; F3]`, `δ = (M0 F2 + V0 F3 + w F4/2) / (2 I v)` once the span is
    /// at least twice the soft zone. Where the span is shorter the strand never becomes that beam: the
    /// result is bounded by a beam clamped at both ends with its whole compliance, `w L⁴ G0 / (384 I)`.
    /// Wants soft zone ≥ 3 D (no shear). Source: process-physics.md 3.2, cases VISC-SS-CLAMPED, -EXP.
    pub fn clamped_sag_m(&self, fluidity: Fluidity) -> f64 {
        let f = fluidity.in_distance(self.speed_m_s);
        let determinant = f[0] * f[2] - f[1] * f[1];
        if determinant <= 0.0 {
            return 0.0;
        }
        let moment = -0.5 * (f[2] * f[2] - f[1] * f[3]) / determinant;
        let shear = -0.5 * (f[0] * f[3] - f[1] * f[2]) / determinant;
        let long = (moment * f[2] + shear * f[3] + 0.5 * f[4]) / (2.0 * self.speed_m_s);
        self.bounded(long, fluidity, 1.0 / 384.0)
    }

    /// Sag below the nozzle path where the nozzle is a hinge, m; small slopes.
    ///
    /// `M0 = 0`, `V0 = −w F2/(2 F1)`, `δ = (V0 F3 + w F4/2)/(2 I v)`; short spans are bounded by a beam with one
    /// end clamped and one hinged, `w L⁴ G0 / (184.6 I)`. Cases VISC-SS-HINGED, VISC-SS-EXP-HINGED.
    pub fn hinged_sag_m(&self, fluidity: Fluidity) -> f64 {
        let f = fluidity.in_distance(self.speed_m_s);
        if f[1] <= 0.0 {
            return 0.0;
        }
        let long = (0.5 * f[4] - 0.5 * f[2] * f[3] / f[1]) / (2.0 * self.speed_m_s);
        self.bounded(long, fluidity, 1.0 / 184.6)
    }

    /// Drop of a free end after the nozzle has left it soft, m; small slopes.
    ///
    /// `δ = (w/2I) ∫ ξ³ ∫_{ξ/v}^∞ f da dξ = w F4 / (8 I v)`; short spans are bounded by a cantilever with its
    /// whole compliance, `w L⁴ G0 / (8 I)`. For constant viscosity it equals case VISC-FREE-EXTRUSION.
    pub fn tip_drop_m(&self, fluidity: Fluidity) -> f64 {
        let f = fluidity.in_distance(self.speed_m_s);
        self.bounded(f[4] / (8.0 * self.speed_m_s), fluidity, 1.0 / 8.0)
    }

    /// Sag by shear of a zone of constant viscosity held at both ends, m: `ρ g ℓ² t / (7.2 η)`.
    ///
    /// Matters where the zone is shorter than three diameters. Source: process-physics.md section 1.3.
    pub fn shear_sag_m(&self, viscosity_pa_s: f64, until_s: f64) -> f64 {
        let length_m = (self.speed_m_s * until_s).min(self.span_m);
        self.density_kg_m3 * self.across_m_s2.abs() * length_m * length_m * until_s
            / (7.2 * viscosity_pa_s)
    }

    fn bounded(&self, long: f64, fluidity: Fluidity, beam: f64) -> f64 {
        let short = self.span_m.powi(4) * fluidity.moments[0] * beam;
        self.load_over_inertia() * long.min(short).max(0.0)
    }
}

/// Sag where linear theory ends, over diameter: `sqrt(27/16) = 1.299`, case VISC-CATENARY-XOVER.
pub const LINEAR_LIMIT: f64 = 1.299_038_105_676_658;

/// Sag with the strand's stretching taken in, m, and whether linear theory holds.
///
/// Bending gives `δ = ρ g L⁴ t / (72 η D²)`, stretching `(3 ρ g L⁴ t / (128 η))^⅓`; with the length taken out,
/// stretching gives `(27/16 D² δ)^⅓`, the lower one from `δ = 1.299 D` on. Beyond it the number is an
/// order of magnitude. Source: process-physics.md 3.1, 3.2, cases VISC-CATENARY-*.
pub fn stretched_sag_m(linear_m: f64, diameter_m: f64) -> (f64, bool) {
    if linear_m <= LINEAR_LIMIT * diameter_m {
        return (linear_m, true);
    }
    ((27.0 / 16.0 * diameter_m * diameter_m * linear_m).cbrt(), false)
}

/// Sag of a strand longer than its chord, m: `L sqrt(3 e / 8)`, `e` the strain by which it is longer.
///
/// A flat parabola of that length; zero for a strand as long as its chord or shorter (it is then taut
/// and pulls on its ends). Source: process-physics.md section 0, case BRIDGE-BANDS.
pub fn slack_sag_m(chord_m: f64, strain: f64) -> f64 {
    chord_m * (0.375 * strain.max(0.0)).sqrt()
}

/// A set strand under its own weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SetBeam {
    /// Diameter, m.
    pub diameter_m: f64,
    /// Density, kg/m³.
    pub density_kg_m3: f64,
    /// Gravity across the strand, m/s².
    pub across_m_s2: f64,
    /// Young's modulus, Pa, of the whole section (times the stiffness left, where it is a shell).
    pub youngs_modulus_pa: f64,
}

impl SetBeam {
    /// Deflection at the tip of a cantilever, m: `2 ρ g L⁴ / (E D²)`; case EB-CANT-SELFWEIGHT.
    ///
    /// Small slopes; from a tenth of the length on see [`Self::heavy_cantilever_m`].
    pub fn cantilever_m(&self, length_m: f64) -> f64 {
        2.0 * self.scale_m(length_m)
    }

    /// Drop of the tip of a cantilever at any slope, m; clamped level. Cases ELASTICA-*.
    ///
    /// Linear up to a tenth of the length (there 0.7 % too large), a heavy elastica past it.
    pub fn heavy_cantilever_m(&self, length_m: f64) -> f64 {
        let linear_m = self.cantilever_m(length_m);
        if linear_m <= 0.1 * length_m {
            return linear_m;
        }
        length_m * heavy_elastica(8.0 * linear_m / length_m, 100).drop
    }

    /// Deflection at the middle, both ends clamped, m: `ρ g L⁴ / (24 E D²)`; case EB-CC-SELFWEIGHT.
    pub fn clamped_m(&self, length_m: f64) -> f64 {
        self.scale_m(length_m) / 24.0
    }

    /// Deflection at the middle, ends free to turn, m: `5 ρ g L⁴ / (24 E D²)`; case EB-CLOSED-FORMS.
    pub fn simply_supported_m(&self, length_m: f64) -> f64 {
        5.0 / 24.0 * self.scale_m(length_m)
    }

    fn scale_m(&self, length_m: f64) -> f64 {
        let load = self.density_kg_m3 * self.across_m_s2.abs() * length_m.powi(4);
        if load == 0.0 {
            return 0.0; // also where nothing is set and the stiffness is zero
        }
        load / (self.youngs_modulus_pa * self.diameter_m * self.diameter_m)
    }
}

/// Sag of a hot strand held at both ends and not ageing, bending, m: `ρ g L⁴ t / (72 η D²)`.
///
/// Teichman & Mahadevan 2003; until the sag is 1.3 D. Case VISC-CATENARY-EARLY. `weight` is `ρ g`, N/m³.
pub fn viscous_bridge_m(
    weight: f64,
    span_m: f64,
    time_s: f64,
    viscosity_pa_s: f64,
    diameter_m: f64,
) -> f64 {
    weight * span_m.powi(4) * time_s / (72.0 * viscosity_pa_s * diameter_m * diameter_m)
}

/// Bending inertia of a round section, m⁴: `π D⁴ / 64`.
pub fn inertia_m4(diameter_m: f64) -> f64 {
    PI * diameter_m.powi(4) / 64.0
}
