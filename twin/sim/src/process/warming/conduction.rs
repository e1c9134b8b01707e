//! Heat through rings of equal area, by steps that damp what is fast.

/// `1 − 1/√2`: both stages of the step then have the same matrix, and it is L-stable.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
/// A greater heat transfer than this is as good as none at all, W/(m² K): the surface is as warm as the air.
const MOST_H_W_M2K: f64 = 1e12;

/// Rings of one area and the heat between them.
#[derive(Debug, Clone)]
pub(super) struct Rings {
    middles_m: Vec<f64>,
    /// From each ring to the next outer one, 1/s: conductance over heat capacity.
    outward_per_s: Vec<f64>,
    /// From the outermost ring to the surface, W/(m² K) of surface.
    skin_w_m2k: f64,
    /// Surface over heat capacity of a ring, m² K/J.
    surface_m2k_j: f64,
}

impl Rings {
    /// Rings of a round of a radius, m, conductivity, W/(m K), and `ρ cp`, J/(m³ K); `None` where nothing comes of it.
    pub(super) fn new(radius_m: f64, k_w_mk: f64, heat_j_m3k: f64, count: usize) -> Option<Self> {
        use std::f64::consts::{PI, TAU};
        let middle = |i: usize| radius_m * ((i as f64 + 0.5) / count as f64).sqrt();
        let middles_m: Vec<f64> = (0..count).map(middle).collect();
        let ring_j_mk = PI * radius_m * radius_m / count as f64 * heat_j_m3k;
        let between = |pair: &[f64]| TAU * k_w_mk / (pair[1] / pair[0]).ln() / ring_j_mk;
        let outward_per_s: Vec<f64> = middles_m.windows(2).map(between).collect();
        let skin_w_m2k = k_w_mk / (radius_m * (radius_m / middles_m[count - 1]).ln());
        let surface_m2k_j = TAU * radius_m / ring_j_mk;
        let numbers = [skin_w_m2k, surface_m2k_j];
        let good = numbers.iter().chain(&outward_per_s).all(|v| *v > 0.0 && v.is_finite());
        good.then_some(Self { middles_m, outward_per_s, skin_w_m2k, surface_m2k_j })
    }

    /// Radii that halve the area of each ring, m.
    pub(super) fn middles_m(&self) -> &[f64] {
        &self.middles_m
    }

    /// Conducts for a time, s; returns the surface temperature after it, K. Two stages of one tridiagonal matrix.
    pub(super) fn conduct(&self, kelvin: &mut [f64], air_k: f64, h: f64, step_s: f64) -> f64 {
        let h = if h >= MOST_H_W_M2K { MOST_H_W_M2K } else { h.max(0.0) };
        let out_w_m2k = h * self.skin_w_m2k / (h + self.skin_w_m2k);
        let lost_per_s = out_w_m2k * self.surface_m2k_j;
        let mut first: Vec<f64> = kelvin.iter().map(|kelvin| kelvin - air_k).collect();
        let start = first.clone();
        self.rates(&mut first, lost_per_s, GAMMA * step_s);
        let mut second: Vec<f64> =
            start.iter().zip(&first).map(|(u, rate)| u + (1.0 - GAMMA) * step_s * rate).collect();
        self.rates(&mut second, lost_per_s, GAMMA * step_s);
        for ((kelvin, a), b) in kelvin.iter_mut().zip(&first).zip(&second) {
            *kelvin += step_s * ((1.0 - GAMMA) * a + GAMMA * b);
        }
        let outermost_k = kelvin.last().copied().unwrap_or(air_k);
        air_k + (outermost_k - air_k) * self.skin_w_m2k / (h + self.skin_w_m2k)
    }

    /// `(1 − s A)⁻¹ A u` in the place of `u`, `A` the rate of change by conduction; Thomas' algorithm.
    fn rates(&self, u: &mut [f64], lost_per_s: f64, s: f64) {
        let n = u.len();
        let inward = |i: usize| if i > 0 { self.outward_per_s[i - 1] } else { 0.0 };
        let outward = |i: usize| self.outward_per_s.get(i).copied().unwrap_or(0.0);
        let lost = |i: usize| if i + 1 == n { lost_per_s } else { 0.0 };
        let change = |i: usize| {
            let below = if i > 0 { u[i - 1] - u[i] } else { 0.0 };
            let above = if i + 1 < n { u[i + 1] - u[i] } else { 0.0 };
            inward(i) * below + outward(i) * above - lost(i) * u[i]
        };
        let mut right: Vec<f64> = (0..n).map(change).collect();
        let mut upper = vec![0.0; n];
        for i in 0..n {
            let carried = if i > 0 { upper[i - 1] } else { 0.0 };
            let pivot = 1.0 + s * (inward(i) + outward(i) + lost(i)) + s * inward(i) * carried;
            upper[i] = -s * outward(i) / pivot;
            let before = if i > 0 { right[i - 1] } else { 0.0 };
            right[i] = (right[i] + s * inward(i) * before) / pivot;
        }
        for i in (0..n.saturating_sub(1)).rev() {
            right[i] -= upper[i] * right[i + 1];
        }
        u.copy_from_slice(&right);
    }
}
