//! The workings of a run: rings, fluxes, one step.

use std::f64::consts::PI;

use super::{RoundStrand, Surroundings, ZERO_C_K};
use crate::process::cooled::{HeatBalance, Node};

/// `1 − 1/√2`: the Rosenbrock method is then L-stable.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

/// Heat content over that at 0 °C, J/m³: `ρ (a T + b T²/2)`.
fn content_j_m3(strand: &RoundStrand, temperature_k: f64) -> f64 {
    let over_k = temperature_k - ZERO_C_K;
    let cp = strand.cp_j_kgk;
    strand.density_kg_m3 * over_k * (cp.at_0c + 0.5 * cp.per_k * over_k)
}

/// Inverse of [`content_j_m3`] from `H/ρ`, J/kg: temperature, K, and heat capacity there, J/(m³ K).
///
/// `cp = √(a² + 2 b H/ρ)`, kept above a tenth of `a` where a falling `cp` would end.
fn temperature_and_capacity(strand: &RoundStrand, content_j_kg: f64) -> (f64, f64) {
    let (a, b) = (strand.cp_j_kgk.at_0c, strand.cp_j_kgk.per_k);
    let cp = (a * a + 2.0 * b * content_j_kg).max(0.01 * a * a).sqrt();
    (ZERO_C_K + 2.0 * content_j_kg / (a + cp), strand.density_kg_m3 * cp)
}

/// What follows from the heat contents at an age.
pub(super) struct Look {
    pub(super) temperature_k: Vec<f64>,
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
    fn new(rings: usize) -> Self {
        let zeros = vec![0.0; rings];
        let (capacity, pass, rate) = (zeros.clone(), zeros.clone(), zeros.clone());
        Self { temperature_k: zeros, capacity, pass, rate, loss: 0.0, source: 0.0, surface_k: 0.0 }
    }

    /// Looks anew.
    fn fill(&mut self, strand: &RoundStrand, around: &Surroundings, content: &[f64], age_s: f64) {
        let per_density = 1.0 / strand.density_kg_m3;
        let places = self.temperature_k.iter_mut().zip(&mut self.capacity);
        for ((temperature_k, capacity), h) in places.zip(content) {
            (*temperature_k, *capacity) = temperature_and_capacity(strand, h * per_density);
        }
        let (t, rings, radius_m) = (&self.temperature_k, content.len(), 0.5 * strand.diameter_m);
        // Kept positive where a falling `k(T)` would end.
        let conductivity = |t: f64| strand.conductivity_w_mk.at(t).max(1e-9);
        let last = rings - 1;
        let outer_k = t[last];
        let drawn_k = 1.5 * outer_k - 0.5 * t[last.saturating_sub(1)];
        let (low_k, high_k) = (outer_k.min(around.air_k), outer_k.max(around.air_k));
        let h = (around.h_w_m2k)(drawn_k.max(low_k).min(high_k), age_s);
        let h = if h < 0.0 { 0.0 } else { h };
        // The outer half of the last ring stands before the surface.
        let inner_h = 4.0 * rings as f64 * conductivity(outer_k) / radius_m;
        let pass_out = 2.0 * rings as f64 / radius_m * inner_h / (1.0 + inner_h / h);
        self.surface_k = around.air_k + (outer_k - around.air_k) / (1.0 + h / inner_h);
        self.source = (around.source_w_m3)(age_s);
        self.loss = pass_out * (outer_k - around.air_k);
        let unit = 4.0 * rings as f64 / (radius_m * radius_m);
        let (mut from_inside, mut ring) = (0.0, 0.0);
        for ((t, pass), rate) in t.windows(2).zip(&mut self.pass).zip(&mut self.rate) {
            ring += unit;
            *pass = ring * conductivity(0.5 * (t[0] + t[1]));
            let heat = *pass * (t[0] - t[1]);
            *rate = self.source + from_inside - heat;
            from_inside = heat;
        }
        self.pass[last] = pass_out;
        self.rate[last] = self.source + from_inside - self.loss;
    }
}

/// One run: heat contents per volume, J/m³ over those at 0 °C, and the room the steps need.
pub(super) struct Run<'a> {
    strand: &'a RoundStrand,
    around: &'a Surroundings<'a>,
    pub(super) age_s: f64,
    content: Vec<f64>,
    pub(super) now: Look,
    pub(super) balance: HeatBalance,
    ahead: Look,
    first: Vec<f64>,
    second: Vec<f64>,
    next_content: Vec<f64>,
    next_balance: HeatBalance,
    solver: Tridiagonal,
}

impl<'a> Run<'a> {
    pub(super) fn new(
        strand: &'a RoundStrand,
        around: &'a Surroundings<'a>,
        start_k: &[f64],
        age_s: f64,
    ) -> Self {
        let content: Vec<f64> = start_k.iter().map(|&t| content_j_m3(strand, t)).collect();
        let mut now = Look::new(content.len());
        now.fill(strand, around, &content, age_s);
        let zeros = vec![0.0; content.len()];
        Self {
            strand,
            around,
            age_s,
            content,
            now,
            balance: HeatBalance::default(),
            ahead: Look::new(start_k.len()),
            first: zeros.clone(),
            second: zeros.clone(),
            next_content: zeros.clone(),
            next_balance: HeatBalance::default(),
            solver: Tridiagonal { share: zeros.clone(), inverse: zeros },
        }
    }

    /// A tenth of the time in which heat crosses the last ring, s.
    pub(super) fn first_step_s(&self) -> f64 {
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
    pub(super) fn try_step(&mut self, step_s: f64) -> f64 {
        let (now, rings) = (&self.now, self.content.len());
        self.solver.fill(now, GAMMA * step_s);
        for (first, rate) in self.first.iter_mut().zip(&now.rate) {
            *first = step_s * rate;
        }
        self.solver.solve(&mut self.first);
        for i in 0..rings {
            let change = now.capacity[i] * self.first[i];
            self.next_content[i] = self.content[i] + change;
            self.second[i] = -2.0 * change;
        }
        self.ahead.fill(self.strand, self.around, &self.next_content, self.age_s + step_s);
        for (second, rate) in self.second.iter_mut().zip(&self.ahead.rate) {
            *second += step_s * rate;
        }
        self.solver.solve(&mut self.second);
        let (mut error_k, mut gained) = (0.0_f64, 0.0);
        for i in 0..rings {
            let (first, second) = (self.first[i], self.second[i]);
            let gain = now.capacity[i] * (1.5 * first + 0.5 * second);
            self.next_content[i] = self.content[i] + gain;
            gained += gain;
            error_k = (0.5 * (first + second).abs()).max(error_k);
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
        if gained.is_finite() { error_k } else { f64::NAN }
    }

    pub(super) fn accept(&mut self, age_s: f64) {
        self.age_s = age_s;
        std::mem::swap(&mut self.content, &mut self.next_content);
        self.balance = self.next_balance;
        self.now.fill(self.strand, self.around, &self.content, age_s);
    }

    pub(super) fn node(&self) -> Node {
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
struct Tridiagonal {
    /// What a ring's unknown passes on to its outer neighbour, and takes from it.
    share: Vec<f64>,
    /// One over the pivots.
    inverse: Vec<f64>,
}

impl Tridiagonal {
    fn fill(&mut self, look: &Look, weight_s: f64) {
        let (mut inner, mut taken) = (0.0, 0.0);
        let places = self.share.iter_mut().zip(&mut self.inverse);
        for ((share, inverse), (capacity, pass)) in places.zip(look.capacity.iter().zip(&look.pass))
        {
            let outer = weight_s * pass;
            *inverse = 1.0 / (capacity + inner + outer - taken);
            *share = outer * *inverse;
            taken = outer * outer * *inverse;
            inner = outer;
        }
        // Outside the last ring is the air, whose temperature is given.
        if let Some(last) = self.share.last_mut() {
            *last = 0.0;
        }
    }

    fn solve(&self, right: &mut [f64]) {
        let mut before = 0.0;
        for ((value, share), inverse) in right.iter_mut().zip(&self.share).zip(&self.inverse) {
            let sum = *value + before;
            before = share * sum;
            *value = sum * inverse;
        }
        let mut after = 0.0;
        for (value, share) in right.iter_mut().zip(&self.share).rev() {
            *value += share * after;
            after = *value;
        }
    }
}
