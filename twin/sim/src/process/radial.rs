//! Cooling of a round strand through its radius.
//!
//! Rings of equal area, so that heat runs between them as it does in `x = r²`, where the profile of a
//! cooling strand is smooth and nearly straight. Each ring's unknown is its heat content, so nothing is
//! lost whatever `cp(T)`. Reference: process-physics.md 2.2 ("full model: radial FV with ~12 cells").

use std::f64::consts::PI;

use super::cooled::{Cooled, HeatBalance, Node};

#[cfg(test)]
mod tests;

/// 0 °C, K.
const ZERO_C_K: f64 = 273.15;
/// `1 − 1/√2`: the Rosenbrock method is then L-stable.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
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
    /// Heat transfer, W/(m² K), at a surface temperature, K, and an age, s; see `heat::total_h_w_m2k`.
    pub h_w_m2k: &'a dyn Fn(f64, f64) -> f64,
    /// Heat made in the strand at an age, s, W/m³, everywhere alike: the heat of cure.
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
    /// Error of a step by its own estimate, K; 0.05 keeps times to a temperature within 0.05 %.
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
/// Range: `R`, `ρ`, `k` and `cp` positive over the temperatures met. Cost O(N) a step; some 70 steps and
/// 15 µs from 240 °C to 40 °C with 12 rings and cheap `h`. Input that is not finite or not positive gives
/// one age and temperatures that are not a number. Cases: COOL-RADIAL-* within 0.02 s.
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

/// Heat content over that at 0 °C, J/m³: `ρ (a T + b T²/2)`.
fn content_j_m3(strand: &RoundStrand, temperature_k: f64) -> f64 {
    let over_k = temperature_k - ZERO_C_K;
    let cp = strand.cp_j_kgk;
    strand.density_kg_m3 * over_k * (cp.at_0c + 0.5 * cp.per_k * over_k)
}

/// Inverse of [`content_j_m3`]: temperature, K, and heat capacity there, J/(m³ K).
///
/// `cp = √(a² + 2 b H/ρ)`, kept above a tenth of `a` where a falling `cp` would end.
fn temperature_and_capacity(strand: &RoundStrand, content_j_m3: f64) -> (f64, f64) {
    let (a, b) = (strand.cp_j_kgk.at_0c, strand.cp_j_kgk.per_k);
    let specific = content_j_m3 / strand.density_kg_m3;
    let cp = (a * a + 2.0 * b * specific).max(0.01 * a * a).sqrt();
    (ZERO_C_K + 2.0 * specific / (a + cp), strand.density_kg_m3 * cp)
}

/// What follows from the heat contents at an age.
#[derive(Default)]
struct Look {
    temperature_k: Vec<f64>,
    /// J/(m³ K).
    capacity: Vec<f64>,
    /// Conductance from each ring to the next, from the last to the air, per volume of a ring, W/(m³ K).
    pass: Vec<f64>,
    /// Rate of the heat content, W/m³.
    rate: Vec<f64>,
    /// Heat lost to the air per volume of a ring, W/m³.
    loss: f64,
    /// Heat made, W/m³.
    source: f64,
    surface_k: f64,
}

impl Look {
    /// Looks anew, keeping the room of the last look.
    fn fill(&mut self, strand: &RoundStrand, around: &Surroundings, content: &[f64], age_s: f64) {
        let rings = content.len();
        let last = rings - 1;
        self.temperature_k.clear();
        self.capacity.clear();
        self.pass.clear();
        self.rate.clear();
        for &h in content {
            let (temperature_k, capacity) = temperature_and_capacity(strand, h);
            self.temperature_k.push(temperature_k);
            self.capacity.push(capacity);
        }
        let t = &self.temperature_k;
        let conductivity = |t: f64| strand.conductivity_w_mk.at(t).max(0.0);
        let radius_m = 0.5 * strand.diameter_m;
        let outer_k = t[last];
        let drawn_k = 1.5 * outer_k - 0.5 * t[last.saturating_sub(1)];
        let (low_k, high_k) = (outer_k.min(around.air_k), outer_k.max(around.air_k));
        let h = (around.h_w_m2k)(drawn_k.max(low_k).min(high_k), age_s);
        // What stays of the last ring's excess at the surface: the ring's outer half stands between.
        let inner_h = 4.0 * rings as f64 * conductivity(outer_k) / radius_m;
        let share = inner_h / (inner_h + h);
        self.source = (around.source_w_m3)(age_s);
        let unit = 4.0 * rings as f64 / (radius_m * radius_m);
        let mut from_inside = 0.0;
        for i in 0..last {
            let pass = unit * (i + 1) as f64 * conductivity(0.5 * (t[i] + t[i + 1]));
            let heat = pass * (t[i] - t[i + 1]);
            self.pass.push(pass);
            self.rate.push(self.source + from_inside - heat);
            from_inside = heat;
        }
        let pass = 2.0 * rings as f64 / radius_m * h * share;
        self.loss = pass * (outer_k - around.air_k);
        self.pass.push(pass);
        self.rate.push(self.source + from_inside - self.loss);
        self.surface_k = around.air_k + share * (outer_k - around.air_k);
    }
}

/// One run: heat contents per volume, J/m³ over those at 0 °C, and the room the steps need.
struct Run<'a> {
    strand: &'a RoundStrand,
    around: &'a Surroundings<'a>,
    age_s: f64,
    content: Vec<f64>,
    now: Look,
    balance: HeatBalance,
    ahead: Look,
    first: Vec<f64>,
    second: Vec<f64>,
    next_content: Vec<f64>,
    next_balance: HeatBalance,
    solver: Tridiagonal,
}

impl<'a> Run<'a> {
    fn new(
        strand: &'a RoundStrand,
        around: &'a Surroundings<'a>,
        start_k: &[f64],
        age_s: f64,
    ) -> Self {
        let content: Vec<f64> = start_k.iter().map(|&t| content_j_m3(strand, t)).collect();
        let mut now = Look::default();
        now.fill(strand, around, &content, age_s);
        let zeros = vec![0.0; content.len()];
        Self {
            strand,
            around,
            age_s,
            content,
            now,
            balance: HeatBalance::default(),
            ahead: Look::default(),
            first: zeros.clone(),
            second: zeros.clone(),
            next_content: zeros.clone(),
            next_balance: HeatBalance::default(),
            solver: Tridiagonal::default(),
        }
    }

    /// A tenth of the time in which heat crosses the last ring, s.
    fn first_step_s(&self) -> f64 {
        let last = self.content.len() - 1;
        let ring_m = 0.25 * self.strand.diameter_m / self.content.len() as f64;
        let conductivity = self.strand.conductivity_w_mk.at(self.now.temperature_k[last]);
        0.1 * ring_m * ring_m * self.now.capacity[last] / conductivity
    }

    /// One Rosenbrock–W step (ROS2, Verwer et al. 1999), kept aside; returns the error of its first-order
    /// part, K.
    ///
    /// `(C − γτG) κ1 = τ F(H, a)`, `(C − γτG) κ2 = τ F(H + C κ1, a + τ) − 2 C κ1`,
    /// `H' = H + C (3 κ1 + κ2)/2`; of second order and free of loss whatever `C` and `G` lag behind.
    fn try_step(&mut self, step_s: f64) -> f64 {
        let (now, rings) = (&self.now, self.content.len());
        self.solver.fill(now, GAMMA * step_s);
        for i in 0..rings {
            self.first[i] = step_s * now.rate[i];
        }
        self.solver.solve(&mut self.first);
        for i in 0..rings {
            self.next_content[i] = self.content[i] + now.capacity[i] * self.first[i];
        }
        self.ahead.fill(self.strand, self.around, &self.next_content, self.age_s + step_s);
        for i in 0..rings {
            self.second[i] = step_s * self.ahead.rate[i] - 2.0 * now.capacity[i] * self.first[i];
        }
        self.solver.solve(&mut self.second);
        let (mut error_k, mut gained) = (0.0, 0.0);
        for i in 0..rings {
            let (first, second) = (self.first[i], self.second[i]);
            let gain = now.capacity[i] * (1.5 * first + 0.5 * second);
            self.next_content[i] = self.content[i] + gain;
            gained += gain;
            let error = 0.5 * (first + second).abs();
            error_k = if error <= error_k { error_k } else { error };
        }
        // Heat through the surface by the same two stages, from the surface's own terms alone.
        let (ahead, last) = (&self.ahead, rings - 1);
        let implicit = GAMMA * step_s * now.pass[last];
        let out = step_s * now.loss + implicit * self.first[last];
        let out_ahead = step_s * ahead.loss + implicit * self.second[last] - 2.0 * out;
        let strand_m2 = PI * self.strand.diameter_m * self.strand.diameter_m / 4.0;
        let ring_m2 = strand_m2 / rings as f64;
        let before = &self.balance;
        self.next_balance = HeatBalance {
            lost_j_m: before.lost_j_m + ring_m2 * (1.5 * out + 0.5 * out_ahead),
            made_j_m: before.made_j_m + strand_m2 * step_s * 0.5 * (now.source + ahead.source),
            content_lost_j_m: before.content_lost_j_m - ring_m2 * gained,
        };
        error_k
    }

    fn accept(&mut self, age_s: f64) {
        self.age_s = age_s;
        std::mem::swap(&mut self.content, &mut self.next_content);
        self.balance = self.next_balance;
        self.now.fill(self.strand, self.around, &self.content, age_s);
    }

    fn node(&self) -> Node {
        let (now, rings) = (&self.now, self.content.len());
        let slope = |i: usize| now.rate[i] / now.capacity[i];
        let mean_k = now.temperature_k.iter().sum::<f64>() / rings as f64;
        let mean_slope_k_s = (0..rings).map(slope).sum::<f64>() / rings as f64;
        let near_axis = |i: usize| slope(i.min(rings - 1));
        Node {
            age_s: self.age_s,
            mean_k,
            mean_slope_k_s,
            core_k: at_axis(&now.temperature_k),
            core_slope_k_s: at_axis(&[0, 1, 2].map(near_axis)[..rings.min(3)]),
            surface_k: now.surface_k,
        }
    }
}

/// Value on the axis of the parabola in `r²` whose ring means are the first three.
fn at_axis(rings: &[f64]) -> f64 {
    match rings {
        [a, b, c, ..] => (11.0 * a - 7.0 * b + 2.0 * c) / 6.0,
        [a, b] => 1.5 * a - 0.5 * b,
        [a] => *a,
        [] => f64::NAN,
    }
}

/// `C − γτG`, symmetric and diagonally dominant, taken apart once for both stages (Thomas).
#[derive(Default)]
struct Tridiagonal {
    /// What a ring's equation takes of the one inside it, and of the one outside.
    share: Vec<f64>,
    /// One over the pivots.
    inverse: Vec<f64>,
}

impl Tridiagonal {
    fn fill(&mut self, look: &Look, weight_s: f64) {
        self.share.clear();
        self.inverse.clear();
        let (mut inner, mut taken) = (0.0, 0.0);
        for (capacity, pass) in look.capacity.iter().zip(&look.pass) {
            let outer = weight_s * pass;
            let inverse = 1.0 / (capacity + inner + outer - taken);
            let share = outer * inverse;
            self.inverse.push(inverse);
            self.share.push(share);
            (inner, taken) = (outer, outer * share);
        }
    }

    fn solve(&self, right: &mut [f64]) {
        let mut before = 0.0;
        for (i, value) in right.iter_mut().enumerate() {
            *value += before;
            before = self.share[i] * *value;
            *value *= self.inverse[i];
        }
        let mut after = 0.0;
        for (i, value) in right.iter_mut().enumerate().rev() {
            if i + 1 < self.share.len() {
                *value += self.share[i] * after;
            }
            after = *value;
        }
    }
}
