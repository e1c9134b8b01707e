//! Cooling of a round strand through its radius.
//!
//! Rings of equal area, so that heat runs between them as it does in `x = r²`, where the profile of a
//! cooling strand is smooth and nearly straight. Each ring's unknown is its heat content, so nothing is
//! lost whatever `cp(T)`. Reference: process-physics.md 2.2 ("full model: radial FV with ~12 cells").

use run::Run;

use super::cooled::Cooled;

mod run;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_cases;

/// 0 °C, K.
const ZERO_C_K: f64 = 273.15;
/// No run takes more steps than this; from half of it on they are made long enough to arrive.
const MAX_STEPS: usize = 2000;

/// A property that is straight in temperature: `a + b T`, `T` in °C.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Linear {
    /// Value at 0 °C.
    pub at_0c: f64,
    /// Change per kelvin.
    pub per_k: f64,
}

impl Linear {
    /// A property that does not change.
    pub const fn constant(value: f64) -> Self {
        Self { at_0c: value, per_k: 0.0 }
    }

    /// Value at a temperature, K.
    pub fn at(self, temperature_k: f64) -> f64 {
        self.at_0c + self.per_k * (temperature_k - ZERO_C_K)
    }
}

/// A round strand as heat sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoundStrand {
    /// Diameter, m.
    pub diameter_m: f64,
    /// Density, kg/m³; one value, since the mass of a section does not change.
    pub density_kg_m3: f64,
    /// Conductivity, W/(m K).
    pub conductivity_w_mk: Linear,
    /// Specific heat, J/(kg K); positive at 0 °C.
    pub cp_j_kgk: Linear,
}

/// What a section meets as it ages.
#[derive(Clone, Copy)]
pub struct Surroundings<'a> {
    /// Temperature of air and surroundings, K.
    pub air_k: f64,
    /// Heat transfer, W/(m² K), at a surface temperature, K, and an age, s; see [`super::air_side`]. Below
    /// zero counts as zero.
    pub h_w_m2k: &'a dyn Fn(f64, f64) -> f64,
    /// Heat made in the strand at an age, s, W/m³: the heat of cure, taken alike over the section (ours).
    pub source_w_m3: &'a dyn Fn(f64) -> f64,
}

/// From when, until when and how finely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Age at the start, s.
    pub from_s: f64,
    /// Age at the end, s.
    pub until_s: f64,
    /// The run ends sooner once every ring is this cold, K; zero for never.
    pub stop_k: f64,
    /// Error of a step by the estimate of its first-order part, K; 0.3 keeps times to a temperature within
    /// 0.06 %, 0.1 within 0.02 %.
    pub tolerance_k: f64,
    /// Longest step, s; shorter than what is not to be missed (a jet met late), else infinite.
    pub longest_step_s: f64,
}

/// A start profile of one temperature: `cells` rings of equal area, from axis to surface.
pub fn uniform_profile_k(start_k: f64, cells: usize) -> Vec<f64> {
    vec![start_k; cells]
}

/// Temperatures of a round strand against its age.
///
/// `ρ cp(T) ∂T/∂a = (1/r) ∂/∂r (r k(T) ∂T/∂r) + q(a)`, `−k ∂T/∂r = h (Ts − T∞)` at `R = D/2`; heat along
/// the strand is left out. `start_k` holds the mean temperatures of `N` rings of equal area from the axis
/// outward; twelve will do. Between rings `i` and `i + 1` passes `4π k i (T_i − T_{i+1})` W/m and from
/// the last to the surface `8π k N (T_N − Ts)`: exact where the profile is a parabola, of second order in
/// `1/N` else. In age: Rosenbrock–W of second order, L-stable, two tridiagonal solves a step, the step by
/// its error. The surface temperature that `h` sees is drawn straight in `r²` through the last two rings.
///
/// Range: `R`, `ρ`, `k` and `cp` positive over the temperatures met. Input that is not finite or not
/// positive gives one age and temperatures that are not a number. Error: second order in `1/N` and the
/// step; with `N = 12` and a tolerance of 0.1 K COOL-RADIAL-* to 0.009 s of the series. Cost O(N) a step:
/// from 240 °C to 57 °C at 0.3 K 32 steps and 22 µs with a constant `h`, 58 to 90 steps and 54 to 90 µs
/// with [`super::air_side`] and a jet (release, a busy 2.4 GHz core).
pub fn cool(strand: &RoundStrand, start_k: &[f64], around: &Surroundings, span: &Span) -> Cooled {
    if !is_sound(strand, start_k, around, span) {
        return Cooled::unknown(around.air_k, span.from_s);
    }
    let mut run = Run::new(strand, around, start_k, span.from_s);
    let mut nodes = Vec::with_capacity(128);
    nodes.push(run.node());
    let mut step_s = run.first_step_s();
    for attempt in 0..MAX_STEPS {
        let left_s = span.until_s - run.age_s;
        if !(left_s > 0.0) || run.now.temperature_k.iter().all(|&t| t <= span.stop_k) {
            break;
        }
        let late = attempt >= MAX_STEPS / 2;
        let floor_s = if late { left_s / (MAX_STEPS - attempt) as f64 } else { 0.0 };
        let tried_s = step_s.min(span.longest_step_s).max(floor_s).min(left_s);
        let error_k = run.try_step(tried_s);
        step_s = tried_s * (0.9 * (span.tolerance_k / error_k).sqrt()).clamp(0.3, 2.5);
        if error_k > span.tolerance_k && tried_s > floor_s {
            continue;
        }
        run.accept(if tried_s < left_s { run.age_s + tried_s } else { span.until_s });
        nodes.push(run.node());
        if !error_k.is_finite() {
            break;
        }
    }
    Cooled::new(around.air_k, &nodes, run.now.temperature_k, run.balance)
}

fn is_sound(strand: &RoundStrand, start_k: &[f64], around: &Surroundings, span: &Span) -> bool {
    let positive = |x: f64| x > 0.0 && x.is_finite();
    let holds_at = |t: f64| {
        positive(t) && positive(strand.conductivity_w_mk.at(t)) && positive(strand.cp_j_kgk.at(t))
    };
    let sizes = [strand.diameter_m, strand.density_kg_m3, strand.cp_j_kgk.at_0c, span.tolerance_k];
    !start_k.is_empty()
        && sizes.into_iter().all(positive)
        && start_k.iter().copied().chain([around.air_k]).all(holds_at)
        && span.longest_step_s > 0.0
        && span.from_s.is_finite()
        && span.until_s.is_finite()
}
