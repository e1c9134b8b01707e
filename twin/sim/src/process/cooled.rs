//! What a run of [`super::radial`] leaves: temperatures against age, between the steps as well.

#[cfg(test)]
mod tests;

/// A step's end, as the solver hands it over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Node {
    pub(super) age_s: f64,
    pub(super) mean_k: f64,
    pub(super) mean_slope_k_s: f64,
    pub(super) core_k: f64,
    pub(super) core_slope_k_s: f64,
    pub(super) surface_k: f64,
}

/// Heat of a metre of strand over a run, J/m; `lost = content_lost + made`.
///
/// `lost` and `made` are summed from the surface and the source alone, `content_lost` from the rings.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HeatBalance {
    /// Lost through the surface.
    pub lost_j_m: f64,
    /// Made inside.
    pub made_j_m: f64,
    /// By which the heat content fell.
    pub content_lost_j_m: f64,
}

/// Temperatures of a round strand against its age.
///
/// Mean and core between the steps are cubics with the true slopes at both ends, limited so that they
/// never leave the span of their two ends; the surface is straight. Before the first age all hold their
/// first value; after the last, the excess over the air dies at the mean's last rate (ours).
#[derive(Debug, Clone, PartialEq)]
pub struct Cooled {
    /// Ages at the ends of the steps, s, rising.
    pub ages_s: Vec<f64>,
    /// Mean temperature of the section, K.
    pub mean_k: Vec<f64>,
    /// Temperature of the surface, K.
    pub surface_k: Vec<f64>,
    /// Temperature on the axis, K.
    pub core_k: Vec<f64>,
    /// Mean temperatures of the rings at the last age, from the axis outward, K: a start for a later run.
    pub profile_k: Vec<f64>,
    /// Heat over the run.
    pub balance: HeatBalance,
    air_k: f64,
    mean_slope_k_s: Vec<f64>,
    core_slope_k_s: Vec<f64>,
    /// `∫ (T − T∞) da` of the mean up to each age, K s.
    excess_k_s: Vec<f64>,
    /// Rate of the tail, 1/s.
    tail_per_s: f64,
}

impl Cooled {
    pub(super) fn new(
        air_k: f64,
        nodes: &[Node],
        profile_k: Vec<f64>,
        balance: HeatBalance,
    ) -> Self {
        let all = |value: fn(&Node) -> f64| nodes.iter().map(value).collect::<Vec<f64>>();
        let tail_per_s = nodes.last().map_or(0.0, |n| n.mean_slope_k_s / (air_k - n.mean_k));
        let mut cooled = Self {
            ages_s: all(|n| n.age_s),
            mean_k: all(|n| n.mean_k),
            surface_k: all(|n| n.surface_k),
            core_k: all(|n| n.core_k),
            profile_k,
            balance,
            air_k,
            mean_slope_k_s: all(|n| n.mean_slope_k_s),
            core_slope_k_s: all(|n| n.core_slope_k_s),
            excess_k_s: Vec::with_capacity(nodes.len()),
            tail_per_s: if tail_per_s > 0.0 && tail_per_s.is_finite() { tail_per_s } else { 0.0 },
        };
        let mut sum = 0.0;
        for i in 0..nodes.len() {
            if i > 0 {
                let width_s = cooled.ages_s[i] - cooled.ages_s[i - 1];
                sum += cooled.mean().piece(i - 1).integral(width_s) - air_k * width_s;
            }
            cooled.excess_k_s.push(sum);
        }
        cooled
    }

    /// A strand of which nothing can be said: one age, no temperatures.
    pub(super) fn unknown(air_k: f64, age_s: f64) -> Self {
        let (mean_k, mean_slope_k_s) = (f64::NAN, f64::NAN);
        let (core_k, core_slope_k_s) = (f64::NAN, f64::NAN);
        let surface_k = f64::NAN;
        let node = Node { age_s, mean_k, mean_slope_k_s, core_k, core_slope_k_s, surface_k };
        Self::new(air_k, &[node], Vec::new(), HeatBalance::default())
    }

    /// Mean temperature of the section at an age, K. Cost O(log steps).
    pub fn mean_at_k(&self, age_s: f64) -> f64 {
        self.at(self.mean(), age_s)
    }

    /// Temperature on the axis at an age, K.
    pub fn core_at_k(&self, age_s: f64) -> f64 {
        self.at(self.core(), age_s)
    }

    /// Temperature of the surface at an age, K.
    pub fn surface_at_k(&self, age_s: f64) -> f64 {
        let last = self.ages_s.len() - 1;
        if !(age_s < self.ages_s[last]) {
            return self.tail_k(self.surface_k[last], age_s);
        }
        let i = self.piece_at(age_s);
        let [from_s, to_s, ..] = self.ages_s[i..] else { return self.surface_k[i] };
        let share = ((age_s - from_s) / (to_s - from_s)).max(0.0);
        self.surface_k[i] + share * (self.surface_k[i + 1] - self.surface_k[i])
    }

    /// First age at which the mean has fallen to a target, s; infinite if it never does.
    pub fn time_to_s(&self, target_k: f64) -> f64 {
        self.time_of(self.mean(), target_k)
    }

    /// First age at which the axis has fallen to a target, s; infinite if it never does.
    pub fn core_time_to_s(&self, target_k: f64) -> f64 {
        self.time_of(self.core(), target_k)
    }

    /// `∫ (T − T∞) da` of the mean between two ages, K s; of the curve that [`Self::mean_at_k`] draws.
    pub fn excess_k_s(&self, from_s: f64, to_s: f64) -> f64 {
        self.excess_from_start_k_s(to_s) - self.excess_from_start_k_s(from_s)
    }

    fn excess_from_start_k_s(&self, age_s: f64) -> f64 {
        let last = self.ages_s.len() - 1;
        let after_s = age_s - self.ages_s[last];
        if !(after_s < 0.0) {
            let rate_per_s = self.tail_per_s;
            let time_s = if rate_per_s > 0.0 {
                -(-rate_per_s * after_s).exp_m1() / rate_per_s
            } else {
                after_s
            };
            return self.excess_k_s[last] + (self.mean_k[last] - self.air_k) * time_s;
        }
        let before_s = age_s - self.ages_s[0];
        if before_s < 0.0 {
            return before_s * (self.mean_k[0] - self.air_k);
        }
        let i = self.piece_at(age_s);
        let in_s = age_s - self.ages_s[i];
        self.excess_k_s[i] + self.mean().piece(i).integral(in_s) - self.air_k * in_s
    }

    fn mean(&self) -> Curve<'_> {
        Curve { ages_s: &self.ages_s, values: &self.mean_k, slopes: &self.mean_slope_k_s }
    }

    fn core(&self) -> Curve<'_> {
        Curve { ages_s: &self.ages_s, values: &self.core_k, slopes: &self.core_slope_k_s }
    }

    /// The step that holds an age below the last.
    fn piece_at(&self, age_s: f64) -> usize {
        let after = self.ages_s.partition_point(|&a| a <= age_s);
        after.saturating_sub(1).min(self.ages_s.len().saturating_sub(2))
    }

    fn at(&self, curve: Curve, age_s: f64) -> f64 {
        let last = self.ages_s.len() - 1;
        if !(age_s < self.ages_s[last]) {
            return self.tail_k(curve.values[last], age_s);
        }
        let i = self.piece_at(age_s);
        curve.piece(i).value((age_s - self.ages_s[i]).max(0.0))
    }

    fn tail_k(&self, last_k: f64, age_s: f64) -> f64 {
        let after_s = age_s - self.ages_s[self.ages_s.len() - 1];
        self.air_k + (last_k - self.air_k) * (-self.tail_per_s * after_s).exp()
    }

    fn time_of(&self, curve: Curve, target_k: f64) -> f64 {
        if target_k >= curve.values[0] {
            return self.ages_s[0];
        }
        let Some(i) = curve.values.iter().position(|&t| t <= target_k) else {
            let last = self.ages_s.len() - 1;
            let ratio = (curve.values[last] - self.air_k) / (target_k - self.air_k);
            let reached = target_k > self.air_k && self.tail_per_s > 0.0 && ratio > 0.0;
            let after_s = ratio.ln() / self.tail_per_s;
            return if reached { self.ages_s[last] + after_s } else { f64::INFINITY };
        };
        let piece = curve.piece(i - 1);
        let (mut early, mut late) = (0.0, self.ages_s[i] - self.ages_s[i - 1]);
        for _ in 0..52 {
            let middle = 0.5 * (early + late);
            if piece.value(middle) > target_k { early = middle } else { late = middle }
        }
        self.ages_s[i - 1] + late
    }
}

/// Values and slopes at the ages.
#[derive(Clone, Copy)]
struct Curve<'a> {
    ages_s: &'a [f64],
    values: &'a [f64],
    slopes: &'a [f64],
}

impl Curve<'_> {
    /// The cubic of a step. Its slopes are held to the sign of the chord and to three times it, which
    /// keeps it between its ends (Fritsch and Carlson 1980); true slopes of a smooth curve pass untouched.
    fn piece(self, i: usize) -> Piece {
        if i + 1 >= self.values.len() {
            return Piece { start: self.values[i], slope: 0.0, second: 0.0, third: 0.0 };
        }
        let width = self.ages_s[i + 1] - self.ages_s[i];
        let chord = (self.values[i + 1] - self.values[i]) / width;
        let limit = |slope: f64| {
            if chord >= 0.0 {
                slope.max(0.0).min(3.0 * chord)
            } else {
                slope.min(0.0).max(3.0 * chord)
            }
        };
        let (from, to) = (limit(self.slopes[i]), limit(self.slopes[i + 1]));
        Piece {
            start: self.values[i],
            slope: from,
            second: (3.0 * chord - 2.0 * from - to) / width,
            third: (from + to - 2.0 * chord) / (width * width),
        }
    }
}

/// `y = start + slope s + second s² + third s³`.
struct Piece {
    start: f64,
    slope: f64,
    second: f64,
    third: f64,
}

impl Piece {
    fn value(&self, s: f64) -> f64 {
        self.start + s * (self.slope + s * (self.second + s * self.third))
    }

    fn integral(&self, s: f64) -> f64 {
        s * (self.start + s * (self.slope / 2.0 + s * (self.second / 3.0 + s * self.third / 4.0)))
    }
}
