//! How much a strand still wants to shorten, and what becomes of it: a miss or a force.

use super::age_samples::gauss;
use super::heat::Cooling;
use super::material::{Material, Setting};
use crate::interval::Interval;

/// Shortening still to come when the nozzle leaves a free end, by cooling, m.
///
/// `δ = α ∫₀ᴸ [min(T(a), T_set) − T∞] ds`, age `a = (L − s)/v + dwell`: above `T_set` the strand is fed, not
/// strained. Closed form in the pieces of [`Cooling`]. Expansion `α` 1/K, length m, speed m/s, dwell s.
/// Zero where the air is warmer than the set temperature. Case ENDPOINT-ABS.
pub fn cooling_end_miss_m(
    expansion_per_k: f64,
    set_k: f64,
    cooling: &Cooling,
    length_m: f64,
    speed_m_s: f64,
    dwell_s: f64,
) -> f64 {
    let above_air_k = set_k.min(cooling.start_k) - cooling.air_k;
    if above_air_k <= 0.0 {
        return 0.0;
    }
    let (from_s, to_s) = (dwell_s, dwell_s + length_m / speed_m_s);
    let set_s = cooling.time_to_s(set_k).max(from_s).min(to_s);
    let excess_k_s = above_air_k * (set_s - from_s) + cooling.excess_k_s(set_s, to_s);
    expansion_per_k * speed_m_s * excess_k_s
}

/// How the shrinkage of a curing strand runs off behind the nozzle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CureRun {
    /// Linear shrinkage after the gel point.
    pub strain: f64,
    /// Length behind the nozzle where nothing happens, m.
    pub shadow_m: f64,
    /// Time past the shadow at which it gels, s.
    pub gel_s: f64,
    /// Time past the shadow at which it has shrunk, s.
    pub done_s: f64,
}

impl CureRun {
    /// Share of the shrinkage still to come at a time past the shadow: one up to the gel point, then a
    /// straight line to zero at the end. The line is an assumption, unmeasured.
    pub fn remaining(&self, lit_s: f64) -> f64 {
        if lit_s <= self.gel_s {
            return 1.0;
        }
        ((self.done_s - lit_s) / (self.done_s - self.gel_s)).max(0.0)
    }

    /// Shortening still to come when the nozzle leaves a free end, m.
    ///
    /// `δ = ε ∫₀ᴸ r dξ`: what has not gelled is fed by the nozzle while it is there and shrinks in full after
    /// it; what has gelled has the rest of its line to go; a dwell moves everything past the shadow on,
    /// and leaves what stands in the shadow. Dark cure and the heat of reaction are left out.
    pub fn end_miss_m(&self, length_m: f64, speed_m_s: f64, dwell_s: f64) -> f64 {
        let shadowed_m = self.shadow_m.min(length_m);
        let to_s = dwell_s + (length_m - shadowed_m) / speed_m_s;
        let gel_s = self.gel_s.max(dwell_s).min(to_s);
        let done_s = self.done_s.max(self.gel_s).max(dwell_s).min(to_s);
        let line_s = if done_s > gel_s {
            0.5 * (self.remaining(gel_s) + self.remaining(done_s)) * (done_s - gel_s)
        } else {
            0.0
        };
        self.strain * (shadowed_m + speed_m_s * (gel_s - dwell_s + line_s))
    }
}

/// Linear strain a free strand loses from its set point to the temperature of the air; positive is shorter.
///
/// Thermoplastic: `α (T_g − T∞)`, zero in warmer air; `α` is the material's one number, which understates
/// the step just below the glass transition (ABS: 118e-6 against 88e-6 1/K). Photopolymer and two-part:
/// the linear shrinkage after the gel point. Source: process-physics.md section 2.6.
pub fn free_strain(material: &Material, air_k: f64) -> Interval {
    let strain = |expansion: f64, glass_k: f64| expansion * (glass_k - air_k).max(0.0);
    match &material.setting {
        Setting::Thermoplastic(plastic) => {
            let (cte, glass) = (material.cte_per_k, plastic.glass_k);
            Interval::new(
                strain(cte.nominal, glass.nominal),
                strain(cte.low, glass.low),
                strain(cte.high, glass.high),
            )
        }
        Setting::Photopolymer(resin) => resin.linear_shrinkage,
        Setting::TwoPart(mix) => mix.linear_shrinkage,
    }
}

/// Strain still to come at each age of a cooling strand, as samples `(age s, strain)`; positive is shorter.
///
/// `ε(a) = ∫ α dT` from the temperature of the air up to `min(T(a), T_set)`: above `T_set` the strand is fed, not
/// strained. Temperature as samples `(age s, K)`; `expansion_per_k` gives `α` in 1/K at a temperature in K, a
/// closure of one number where it is constant. The age at which the set temperature is passed is put in as a
/// sample, so the kink is where it is. Negative in air warmer than the strand. `O(n)`; exact for a
/// polynomial `α` of degree five, else `O(ΔT⁶)` in its smooth stretches. Source: process-physics.md section 2.6.
pub fn remaining_by_cooling(
    samples: &[(f64, f64)],
    set_k: f64,
    air_k: f64,
    expansion_per_k: impl Fn(f64) -> f64,
) -> Vec<(f64, f64)> {
    let strain = |kelvin: f64| gauss(air_k, kelvin.min(set_k), 4, &expansion_per_k);
    let mut out = Vec::with_capacity(samples.len() + 1);
    let mut last: Option<(f64, f64)> = None;
    for &(age_s, kelvin) in samples {
        if let Some((from_s, from_k)) = last
            && (from_k - set_k) * (kelvin - set_k) < 0.0
        {
            let crossing_s = from_s + (age_s - from_s) * (set_k - from_k) / (kelvin - from_k);
            out.push((crossing_s, strain(set_k)));
        }
        out.push((age_s, strain(kelvin)));
        last = Some((age_s, kelvin));
    }
    out
}

/// Strain still to come at a degree of cure: `ε (α_max − α) / (α_max − α_gel)`, within 0 and `ε`.
///
/// `ε` the linear shrinkage after the gel point, all of it still to come before. In step with conversion: bonds made
/// are volume lost. For a clock, take ages instead of degrees of cure.
pub fn remaining_by_cure(strain: f64, cure: f64, gel_cure: f64, full_cure: f64) -> f64 {
    if cure <= gel_cure {
        strain
    } else if cure >= full_cure {
        0.0
    } else {
        strain * ((full_cure - cure) / (full_cure - gel_cure))
    }
}

/// Linear shrinkage of a volume that shrinks alike in all directions: `1 − (1 − v)^⅓`.
pub fn linear_shrinkage(volumetric: f64) -> f64 {
    1.0 - (1.0 - volumetric).cbrt()
}

/// Shortening still to come at a time, m, of a strand printed at the times it was really printed:
/// `δ = ∫₀ᴸ ε(t − t(s)) ds`.
///
/// Stations `(distance along the strand m, time the nozzle passed s)`, both rising, straight between them; the nozzle
/// leaves at `left_s`, its wait at the end included. `remaining` is the strain still to come at an age
/// ([`remaining_by_cooling`] read by `age_samples::at_age`, [`remaining_by_cure`], [`CureRun::remaining`]). Three Gauss
/// points on each piece, a quarter of a second of age or less, 64 at most to a stretch: each stretch
/// by itself, so a strand cut at a station sums to the same. `O(n)`, 3 calls or more to a stretch.
pub fn end_miss_m(stations: &[(f64, f64)], left_s: f64, remaining: impl Fn(f64) -> f64) -> f64 {
    const PIECE_S: f64 = 0.25;
    let mut sum_m = 0.0;
    for pair in stations.windows(2) {
        let ((from_m, from_s), (to_m, to_s)) = (pair[0], pair[1]);
        let pieces = ((to_s - from_s) / PIECE_S).ceil().clamp(1.0, 64.0);
        let mean = gauss(0.0, 1.0, pieces as usize, |x| {
            remaining((left_s - from_s - x * (to_s - from_s)).max(0.0))
        });
        sum_m += (to_m - from_m) * mean;
    }
    sum_m
}

/// What becomes of the strain still to come: never a miss and a force at once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shrinkage {
    /// The far end is free and is pulled back.
    Free {
        /// How far, m.
        end_miss_m: f64,
    },
    /// Both ends are joined: nothing moves, the strain is locked in.
    Joined {
        /// Strain, mean of the length; positive wants to be shorter. A frame takes `−locked_strain` as the strain its
        /// member would have if free, and then not the force as well.
        locked_strain: f64,
        /// Pull on what the ends are joined to, if that does not yield, N.
        locked_force_n: f64,
    },
}

/// What the far end of a strand is joined to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FarEnd {
    /// Nothing.
    Free,
    /// Something that holds it, from the time on for which the shortening is given.
    Joined {
        /// Stiffness of the whole strand along itself, once set: `E A`, N.
        stiffness_n: f64,
    },
}

impl Shrinkage {
    /// From the shortening a strand of a length, m, would still make if free ([`end_miss_m`] at the time the far end
    /// is left or joined).
    ///
    /// Free: that. Joined: `ε = δ/L`, `F = E A ε`. What relaxes while a part is above its glass transition or
    /// just gelled is not taken off, nor the yielding of the joints and creep: the force is an upper bound.
    /// A strand of no length has no strain.
    pub fn new(shortening_m: f64, length_m: f64, far_end: FarEnd) -> Self {
        match far_end {
            FarEnd::Free => Self::Free { end_miss_m: shortening_m },
            FarEnd::Joined { stiffness_n } => {
                let strain = if length_m > 0.0 { shortening_m / length_m } else { 0.0 };
                Self::Joined { locked_strain: strain, locked_force_n: stiffness_n * strain }
            }
        }
    }

    /// Pull-back of the far end, m; none where it is joined.
    pub fn end_miss_m(&self) -> f64 {
        match *self {
            Self::Free { end_miss_m } => end_miss_m,
            Self::Joined { .. } => 0.0,
        }
    }

    /// Force locked in, N; none where the far end is free.
    pub fn locked_force_n(&self) -> f64 {
        match *self {
            Self::Free { .. } => 0.0,
            Self::Joined { locked_force_n, .. } => locked_force_n,
        }
    }

    /// Strain locked in; none where the far end is free.
    pub fn locked_strain(&self) -> f64 {
        match *self {
            Self::Free { .. } => 0.0,
            Self::Joined { locked_strain, .. } => locked_strain,
        }
    }
}

/// What takes a miss away, either of the two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Remedy {
    /// Shortest further wait at the end that holds the limit, s; none where no wait does.
    pub dwell_s: Option<f64>,
    /// How far to go past the node without it, m: the miss itself. The added length shrinks too, by a share of the miss
    /// as small as the strain.
    pub over_travel_m: f64,
}

/// What brings the shortening still to come down to `limit_m`, by a wait of `longest_s` at most.
///
/// `shortening_m` gives what is still to come after a further wait in s ([`end_miss_m`] with the wait added to
/// `left_s`) and must not grow with it. Bisected to `longest_s / 2²⁴`, 27 calls at
/// most; the answer is on
/// the side that holds the limit.
pub fn remedy(limit_m: f64, longest_s: f64, shortening_m: impl Fn(f64) -> f64) -> Remedy {
    let miss_m = shortening_m(0.0);
    let over_travel_m = if miss_m <= limit_m { 0.0 } else { miss_m };
    let dwell_s = dwell_s(limit_m, longest_s, shortening_m);
    Remedy { dwell_s, over_travel_m }
}

/// A minute is then known to four microseconds.
const HALVINGS: usize = 24;

fn dwell_s(limit_m: f64, longest_s: f64, shortening_m: impl Fn(f64) -> f64) -> Option<f64> {
    let holds = |wait_s: f64| shortening_m(wait_s) <= limit_m;
    if holds(0.0) {
        return Some(0.0);
    }
    if !(longest_s.is_finite() && longest_s > 0.0 && holds(longest_s)) {
        return None;
    }
    let (mut short_s, mut long_s) = (0.0, longest_s);
    for _ in 0..HALVINGS {
        let middle_s = 0.5 * (short_s + long_s);
        if holds(middle_s) { long_s = middle_s } else { short_s = middle_s }
    }
    Some(long_s)
}

#[cfg(test)]
mod tests;
