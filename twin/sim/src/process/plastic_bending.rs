//! A strand of yield-stress fluid that bends past its plastic moment.
//!
//! A thin strand that bends is stretched and squeezed along its length, `ε̇ = κ̇ y`. Von Mises makes of
//! `τ = τ_y + K γ̇ⁿ` a stress `σ = √3 [τ_y + K (√3 ε̇)ⁿ]`, so as soon as it bends at all the whole section yields
//! and `M = M_p + √3 K (√3 κ̇)ⁿ J_n`, closed for every `n`: no plug to look for. Elastic give below `M_p` is
//! left out. [`super::gel_sag`] draws these beams out behind a nozzle.

use std::f64::consts::PI;

use super::kamal::GAUSS_UNIT;
use super::yield_stress::HerschelBulkley;

/// Quadrature panels to a stretch that flows.
const PANELS: u32 = 5;

/// Moment from which a round section flows, N m: `M_p = √3 τ_y D³/6`.
pub fn plastic_moment_n_m(yield_pa: f64, diameter_m: f64) -> f64 {
    3.0_f64.sqrt() * yield_pa * diameter_m.powi(3) / 6.0
}

/// `J_n = ∫ |y|^(1+n) dA` of a round section, m^(3+n): `2 R^(3+n) B(1 + n/2, 3/2)`.
///
/// `D³/6` at `n = 0`, the moment of inertia at `n = 1`.
pub fn section_moment(diameter_m: f64, index: f64) -> f64 {
    let half = 0.5 * index;
    let beta = 0.5 * PI.sqrt() * (ln_gamma(1.0 + half) - ln_gamma(2.5 + half)).exp();
    2.0 * (0.5 * diameter_m).powf(3.0 + index) * beta
}

/// Rate of curvature under a moment, 1/(m s): `κ̇ = [(M − M_p)/(√3 K J_n)]^(1/n) / √3`, zero up to `M_p`.
///
/// Odd in the moment. Newtonian: `M/(3 η I)`. Rigid up to yield, von Mises, thin strand (longer than three
/// diameters, no shear); `n` positive, else no number.
pub fn curvature_rate(moment_n_m: f64, diameter_m: f64, fluid: &HerschelBulkley) -> f64 {
    let over_n_m = moment_n_m.abs() - plastic_moment_n_m(fluid.yield_pa, diameter_m);
    if over_n_m <= 0.0 {
        return 0.0;
    }
    let scale = 3.0_f64.sqrt() * fluid.consistency_pa_sn * section_moment(diameter_m, fluid.index);
    let root3 = 3.0_f64.sqrt();
    (over_n_m / scale).powf(1.0 / fluid.index) / root3 * moment_n_m.signum()
}

/// A level strand of gel under its weight, all of one age.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GelBeam {
    /// The gel at that age.
    pub fluid: HerschelBulkley,
    /// Diameter, m.
    pub diameter_m: f64,
    /// Weight across the strand, `ρ g`, N/m³.
    pub weight_n_m3: f64,
}

impl GelBeam {
    /// Speed at which the free end sinks, held level at the other, m/s: `∫ κ̇(w x²/2) x dx`; small slopes.
    ///
    /// Zero up to the length of case YIELD-CANT, `w L⁴/(8·3 η I)` for a Newtonian.
    pub fn cantilever_m_s(&self, length_m: f64) -> f64 {
        let (line_n_m, plastic_n_m) = self.loads();
        let from_m = (2.0 * plastic_n_m / line_n_m).sqrt();
        if !(from_m < length_m) {
            return 0.0;
        }
        let bend = Bend::new(self);
        integral(from_m, length_m, |x| bend.rate(0.5 * line_n_m * x * x, plastic_n_m) * x)
    }

    /// Speed at which the middle sinks, clamped at both ends, m/s; small slopes.
    ///
    /// Moment `w x²/2 − M_m` from the middle, `M_m` so that the ends stay level. Zero up to the
    /// span of case YIELD-CC, `w L⁴/(384·3 η I)` for a Newtonian. 0.1 ms at most.
    pub fn clamped_m_s(&self, span_m: f64) -> f64 {
        self.clamped(span_m, &|x| x - 0.5 * span_m)
    }

    /// Sag of a strand drawn out at a speed, times that speed, m²/s: `∫ ξ² κ̇ dξ / 2` over a soft zone that is
    /// clamped at both ends, by the nozzle and where it is set.
    ///
    /// What a section has gone through when it sets, `δ v` of [`super::sag::SoftBeam::clamped_sag_m`]: one fluid all along
    /// makes the zone even about its middle. `w ℓ⁵/(720·3 η I)` for a Newtonian (case VISC-SS-CLAMPED).
    pub fn clamped_zone_m2_s(&self, length_m: f64) -> f64 {
        self.clamped(length_m, &|x| x * x)
    }

    /// `∫ κ̇ g(x) dx` over half a beam clamped at both ends, `x` from the middle.
    fn clamped(&self, span_m: f64, weight: &dyn Fn(f64) -> f64) -> f64 {
        let (line_n_m, plastic_n_m) = self.loads();
        let half_m = 0.5 * span_m;
        let whole_n_m = 0.5 * line_n_m * half_m * half_m;
        if !(whole_n_m > 2.0 * plastic_n_m && whole_n_m.is_finite()) {
            return 0.0;
        }
        let bend = Bend::new(self);
        // integrals over the stretches that flow, about the middle and out to the end, for a moment at the middle
        let over = |middle_n_m: f64, weight: &dyn Fn(f64) -> f64| {
            let at = |moment: f64| (2.0 * moment.max(0.0) / line_n_m).sqrt().min(half_m);
            let moment = |x: f64| 0.5 * line_n_m * x * x - middle_n_m;
            let rate = |x: f64| bend.rate(moment(x), plastic_n_m) * weight(x);
            [
                integral(0.0, at(middle_n_m - plastic_n_m), rate),
                integral(at(middle_n_m + plastic_n_m), half_m, rate),
            ]
        };
        let turn = |middle_n_m: f64| {
            let [back, forth] = over(middle_n_m, &|_| 1.0);
            bend.even(forth, -back)
        };
        let middle_n_m = falling_root(plastic_n_m, whole_n_m - plastic_n_m, 1e-10, turn);
        let [middle, end] = over(middle_n_m, weight);
        middle + end
    }

    /// Weight to a length, N/m, and plastic moment, N m.
    pub(super) fn loads(&self) -> (f64, f64) {
        let area_m2 = 0.25 * PI * self.diameter_m * self.diameter_m;
        let plastic_n_m = plastic_moment_n_m(self.fluid.yield_pa, self.diameter_m);
        (self.weight_n_m3.abs() * area_m2, plastic_n_m)
    }
}

/// [`curvature_rate`] with what is the same along a strand worked out once.
pub(super) struct Bend {
    scale: f64,
    power: f64,
}

impl Bend {
    pub(super) fn new(beam: &GelBeam) -> Self {
        let GelBeam { fluid, diameter_m, .. } = beam;
        Self {
            scale: 3.0_f64.sqrt()
                * fluid.consistency_pa_sn
                * section_moment(*diameter_m, fluid.index),
            power: 1.0 / fluid.index,
        }
    }

    /// Two turns against each other, each to the power of the index: zero where they are the same and nearly straight in
    /// the moment, which a root is then found of in a few steps.
    pub(super) fn even(&self, forth: f64, back: f64) -> f64 {
        let index = 1.0 / self.power;
        forth.powf(index) - back.powf(index)
    }

    pub(super) fn rate(&self, moment_n_m: f64, plastic_n_m: f64) -> f64 {
        let over_n_m = moment_n_m.abs() - plastic_n_m;
        if over_n_m <= 0.0 {
            return 0.0;
        }
        (over_n_m / self.scale).powf(self.power) / 3.0_f64.sqrt() * moment_n_m.signum()
    }
}

/// Root of a falling function between two ends: false position, the end that stays weighed less each time, until a
/// step is small over the root; sixty at most. An end where it is zero already is the root.
pub(super) fn falling_root(
    mut low: f64,
    mut high: f64,
    relative: f64,
    value: impl Fn(f64) -> f64,
) -> f64 {
    let (mut above, mut below) = (value(low), value(high));
    if above == 0.0 || below == 0.0 {
        return if above == 0.0 { low } else { high };
    }
    let (mut root, mut kept) = (f64::INFINITY, 0);
    for _ in 0..60 {
        let secant = (low * below - high * above) / (below - above);
        let next = if secant > low && secant < high { secant } else { 0.5 * (low + high) };
        let settled = (next - root).abs() <= relative * next.abs();
        root = next;
        let at = value(root);
        if settled || at == 0.0 || at.is_nan() {
            break;
        }
        if at > 0.0 {
            (low, above) = (root, at);
            if kept == 1 {
                below *= 0.5;
            }
            kept = 1;
        } else {
            (high, below) = (root, at);
            if kept == -1 {
                above *= 0.5;
            }
            kept = -1;
        }
    }
    root
}

/// Composite Gauss–Legendre of five points a panel; zero where it does not ascend.
pub(super) fn integral(from: f64, to: f64, value: impl Fn(f64) -> f64) -> f64 {
    if !(to > from) {
        return 0.0;
    }
    let step = (to - from) / f64::from(PANELS);
    let panels = (0..PANELS).map(|i| panel(from + f64::from(i) * step, step, &value));
    step * panels.sum::<f64>()
}

/// One panel of five points, of length one.
fn panel(start: f64, step: f64, value: impl Fn(f64) -> f64) -> f64 {
    GAUSS_UNIT.iter().map(|&(x, weight)| weight * value(start + x * step)).sum()
}

/// Gauss–Legendre of five points; zero where it does not ascend.
pub(super) fn gauss(from: f64, to: f64, value: impl Fn(f64) -> f64) -> f64 {
    if to > from { (to - from) * panel(from, to - from, value) } else { 0.0 }
}

/// Logarithm of the gamma function of a number above zero, to 1e-13: Stirling from ten on, stepped down.
fn ln_gamma(x: f64) -> f64 {
    let (mut shifted, mut product) = (x, 1.0);
    for _ in 0..10 {
        if shifted >= 10.0 {
            break;
        }
        product *= shifted;
        shifted += 1.0;
    }
    let inverse = 1.0 / shifted;
    let square = inverse * inverse;
    let series =
        inverse * (1.0 / 12.0 - square * (1.0 / 360.0 - square * (1.0 / 1260.0 - square / 1680.0)));
    (shifted - 0.5) * shifted.ln() - shifted + 0.5 * (2.0 * PI).ln() + series - product.ln()
}
