//! Sag of a gel behind the nozzle: the plastic beam drawn out section by section, its yield stress coming back.
//!
//! The beam of [`super::sag`] with `κ̇ = M/(3 η I)` replaced by [`super::plastic_bending`]: a section at `ξ`
//! behind the nozzle has the age `ξ/v`, the moment `M0 + V0 ξ + w ξ²/2`, and the set strand beyond `ℓ = v t` is
//! straight, so `∫ κ̇ dξ = 0`, under a nozzle that clamps the slope `∫ ξ κ̇ dξ = 0` too, and `δ = ∫ ξ² κ̇ dξ / (2 v)`. For a Newtonian that is its closed form.

use super::kamal::GAUSS_UNIT;
use super::plastic_bending::{Bend, GelBeam, falling_root, gauss, integral, plastic_moment_n_m};
use super::yield_stress::{HerschelBulkley, Structure, yield_at_age_pa};

/// Quadrature panels of five points to the soft zone of a hinged nozzle: 2e-3 of the sag, a few hundredths of the little just
/// past yield.
const PANELS: usize = 5;
const POINTS: usize = 5 * PANELS;
/// `w L²/M_p` that a beam clamped at one end and hinged at the other carries: `2 (3 + 2√2)`.
const PROPPED: f64 = 11.656_854_249_492_381;

/// Times of recovery after which little of it is left to come: an integral over ages is parted there.
const RECOVERIES: f64 = 3.0;

/// A gel as it leaves the nozzle, its yield stress coming back with age: [`yield_at_age_pa`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreshGel {
    /// The rested gel.
    pub fluid: HerschelBulkley,
    /// How it recovers.
    pub structure: Structure,
    /// Structure as it leaves the nozzle; one: rested, its yield stress is then the same at every age.
    pub start: f64,
}

impl FreshGel {
    /// A gel that the nozzle has done nothing to.
    pub fn rested(fluid: HerschelBulkley) -> Self {
        let structure = Structure { recovery_s: f64::INFINITY, breakdown: 0.0 };
        Self { fluid, structure, start: 1.0 }
    }

    /// A gel sheared long enough at a rate, 1/s, to be as it then stays.
    pub fn sheared(fluid: HerschelBulkley, structure: Structure, rate_per_s: f64) -> Self {
        Self { fluid, structure, start: structure.steady(rate_per_s) }
    }

    /// Yield stress at an age, Pa.
    pub fn yield_pa(&self, age_s: f64) -> f64 {
        if self.start >= 1.0 {
            return self.fluid.yield_pa;
        }
        yield_at_age_pa(self.fluid.yield_pa, self.structure, self.start, age_s)
    }

    /// Age at which it has a yield stress, s; infinite if never.
    fn age_s(&self, yield_pa: f64) -> f64 {
        if yield_pa <= self.yield_pa(0.0) {
            return 0.0;
        }
        if self.start >= 1.0 {
            return f64::INFINITY;
        }
        self.structure.age_to_s(self.start, yield_pa / self.fluid.yield_pa)
    }
}

/// A level strand of gel behind the nozzle, soft up to an age and rigid after.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GelStrand {
    /// What flows.
    pub gel: FreshGel,
    /// Diameter while soft, m.
    pub diameter_m: f64,
    /// Weight across the strand, `ρ g`, N/m³.
    pub weight_n_m3: f64,
    /// Speed of the nozzle, m/s.
    pub speed_m_s: f64,
    /// Length that hangs free, m.
    pub span_m: f64,
    /// Age at which it is set, s.
    pub until_s: f64,
}

impl GelStrand {
    /// Sag below the nozzle path where the nozzle clamps the slope, m; small slopes.
    ///
    /// All at the yield stress it leaves the nozzle with, the least it has: exact for a rested gel, too much
    /// for one that recovers. Zero up to the span of case YIELD-CC, `w ℓ⁵/(2160 η I v)` for a Newtonian (case
    /// VISC-SS-CLAMPED); spans under twice the soft zone are bounded by [`GelBeam::clamped_m_s`] for the whole time.
    pub fn clamped_sag_m(&self) -> f64 {
        let beam = self.beam(0.0);
        self.least(
            |length_m| beam.clamped_zone_m2_s(length_m) / self.speed_m_s,
            |span_m| beam.clamped_m_s(span_m) * self.until_s,
        )
    }

    /// Sag below the nozzle path where the nozzle is a hinge, m; small slopes.
    ///
    /// `M0 = 0`, yield stress by age all along the zone. `w ℓ⁵/(360 η I v)` for a Newtonian (case VISC-SS-HINGED);
    /// spans under twice the zone are bounded by a beam of one age, clamped at one end and hinged at the
    /// other, whose yield stress comes back meanwhile.
    pub fn hinged_sag_m(&self) -> f64 {
        self.least(|length_m| self.hinged_zone_m(length_m), |span_m| self.propped_m(span_m))
    }

    /// Drop of a free end after the nozzle has left it soft, m; small slopes.
    ///
    /// `δ = ∫ ξ ∫ κ̇(w ξ²/2, a) da dξ` over ages from `ξ/v` on, up to that at which the section yields no
    /// more; `w ℓ⁵/(120 η I v)` for a Newtonian. Bounded by a cantilever of the span for the whole time.
    pub fn tip_drop_m(&self) -> f64 {
        let beam = self.beam(0.0);
        let (line_n_m, plastic_n_m) = beam.loads();
        let from_m = (2.0 * plastic_n_m / line_n_m).sqrt();
        let bend = Bend::new(&beam);
        let drop = |to_m: f64, speed_m_s: f64| {
            integral(from_m, to_m, |x| {
                x * self.curvature(&bend, 0.5 * line_n_m * x * x, x / speed_m_s)
            })
        };
        self.least(|length_m| drop(length_m, self.speed_m_s), |span_m| drop(span_m, f64::INFINITY))
    }

    /// Sag by shear of the zone, held at both ends, m: `∫ γ̇(ρ g x/0.9) dx` over half of it.
    ///
    /// `(h/(1 + 1/n)) (o/K)^(1/n) o/τ`, `τ = ρ g h/0.9`, `o = τ − τ_y`; `ρ g ℓ² t/(7.2 η)` for a Newtonian (process-physics.md
    /// 1.3). At the yield stress it leaves the nozzle with. That a section which bends past yield also shears
    /// below it is left out.
    pub fn shear_sag_m(&self) -> f64 {
        if !self.told() {
            return f64::NAN;
        }
        let half_m = 0.5 * (self.speed_m_s * self.until_s).min(self.span_m);
        let shear_pa = self.weight_n_m3.abs() * half_m / 0.9;
        let HerschelBulkley { consistency_pa_sn, index, .. } = self.gel.fluid;
        let over_pa = shear_pa - self.gel.yield_pa(0.0);
        if over_pa <= 0.0 || half_m <= 0.0 {
            return 0.0;
        }
        let rate_per_s = (over_pa / consistency_pa_sn).powf(1.0 / index);
        half_m * rate_per_s * over_pa / shear_pa / (1.0 + 1.0 / index) * self.until_s
    }

    /// Law of the zone, or where the span is shorter than twice it the bound of the span if less.
    fn least(&self, zone: impl Fn(f64) -> f64, span: impl Fn(f64) -> f64) -> f64 {
        if !self.told() {
            return f64::NAN;
        }
        let length_m = self.speed_m_s * self.until_s;
        if length_m <= 0.0 || self.span_m <= 0.0 {
            return 0.0;
        }
        let long_m = zone(length_m);
        let is_short = self.span_m < 2.0 * length_m && long_m > 0.0;
        let sag_m = if is_short { long_m.min(span(self.span_m)) } else { long_m };
        // powers of 1/n with n near zero cancel where they overflow
        if sag_m < 0.0 { f64::NAN } else { sag_m }
    }

    /// Whether the numbers mean anything.
    fn told(&self) -> bool {
        let HerschelBulkley { yield_pa, consistency_pa_sn, index } = self.gel.fluid;
        let finite = [yield_pa, self.weight_n_m3, self.speed_m_s, self.span_m, self.until_s];
        [consistency_pa_sn, index, self.diameter_m].iter().all(|value| *value > 0.0)
            && (0.0..=1.0).contains(&self.gel.start)
            && (self.gel.start >= 1.0 || self.gel.structure.recovery_s > 0.0)
            && finite.iter().all(|value| value.is_finite())
            && [yield_pa, self.speed_m_s, self.until_s].iter().all(|value| *value >= 0.0)
    }

    /// All of it at an age, s.
    fn beam(&self, age_s: f64) -> GelBeam {
        GelBeam {
            fluid: HerschelBulkley { yield_pa: self.gel.yield_pa(age_s), ..self.gel.fluid },
            diameter_m: self.diameter_m,
            weight_n_m3: self.weight_n_m3,
        }
    }

    /// Curvature that a section gets under a moment from an age to the set, 1/m.
    fn curvature(&self, bend: &Bend, moment_n_m: f64, from_s: f64) -> f64 {
        let plastic_n_m = |age_s| plastic_moment_n_m(self.gel.yield_pa(age_s), self.diameter_m);
        if self.gel.start >= 1.0 {
            return bend.rate(moment_n_m, plastic_n_m(0.0)) * (self.until_s - from_s).max(0.0);
        }
        let yields_pa = moment_n_m / plastic_moment_n_m(1.0, self.diameter_m);
        let to_s = self.until_s.min(self.gel.age_s(yields_pa));
        self.by_age(from_s, to_s, |age_s| bend.rate(moment_n_m, plastic_n_m(age_s)))
    }

    fn hinged_zone_m(&self, length_m: f64) -> f64 {
        let age_s = |x_m: f64| x_m / self.speed_m_s;
        let Some(hinged) = Hinged::new(self, length_m, age_s, |_| 1.0) else { return 0.0 };
        hinged.sum(|x_m| 0.5 * x_m * x_m / self.speed_m_s)
    }

    /// Sag of a beam of the span, clamped at one end and hinged at the other, m, until it carries itself or is set.
    fn propped_m(&self, span_m: f64) -> f64 {
        let line_n_m = self.beam(0.0).loads().0;
        let carried_pa =
            line_n_m * span_m * span_m / PROPPED / plastic_moment_n_m(1.0, self.diameter_m);
        let to_s = self.until_s.min(self.gel.age_s(carried_pa));
        let speed = |age_s: f64| {
            Hinged::new(self, span_m, |_| age_s, |x_m| x_m).map_or(0.0, |hinged| hinged.greatest())
        };
        if self.gel.start >= 1.0 { speed(0.0) * to_s } else { self.by_age(0.0, to_s, speed) }
    }

    /// Over ages: first those in which the yield stress comes back, then the rest.
    fn by_age(&self, from_s: f64, to_s: f64, rate: impl Fn(f64) -> f64) -> f64 {
        let back_s = (from_s + RECOVERIES * self.gel.structure.recovery_s).min(to_s);
        gauss(from_s, back_s, &rate) + gauss(back_s, to_s, &rate)
    }
}

/// Rates of curvature along a beam hinged at zero and clamped at its length.
struct Hinged {
    at_m: [f64; POINTS],
    /// Rate times quadrature weight, 1/s.
    turn: [f64; POINTS],
}

impl Hinged {
    /// With the force at the hinge for which rate times a weight sums to none; `None` where the yield stress of the
    /// youngest carries it.
    fn new(
        strand: &GelStrand,
        length_m: f64,
        age_s: impl Fn(f64) -> f64,
        weight: impl Fn(f64) -> f64,
    ) -> Option<Self> {
        let beam = strand.beam(age_s(0.0));
        let (line_n_m, least_n_m) = beam.loads();
        if !(line_n_m * length_m * length_m > PROPPED * least_n_m) {
            return None;
        }
        let bend = Bend::new(&beam);
        let step_m = length_m / PANELS as f64;
        let at_m: [f64; POINTS] =
            std::array::from_fn(|k| step_m * ((k / 5) as f64 + GAUSS_UNIT[k % 5].0));
        let plastic_n_m =
            at_m.map(|x| plastic_moment_n_m(strand.gel.yield_pa(age_s(x)), strand.diameter_m));
        let rate = |k: usize, force_n: f64| {
            let moment_n_m = (0.5 * line_n_m * at_m[k] - force_n) * at_m[k];
            step_m * GAUSS_UNIT[k % 5].1 * bend.rate(moment_n_m, plastic_n_m[k])
        };
        let kept = |force_n: f64| {
            let (mut forth, mut back) = (0.0, 0.0);
            for (k, &x) in at_m.iter().enumerate() {
                let turn = weight(x) * rate(k, force_n);
                if turn > 0.0 { forth += turn } else { back -= turn }
            }
            bend.even(forth, back)
        };
        let force_n = falling_root(0.0, 0.5 * line_n_m * length_m, 1e-9, kept);
        Some(Self { at_m, turn: std::array::from_fn(|k| rate(k, force_n)) })
    }

    fn sum(&self, weight: impl Fn(f64) -> f64) -> f64 {
        (0..POINTS).map(|k| self.turn[k] * weight(self.at_m[k])).sum()
    }

    /// Greatest speed of sinking, m/s: where the slope, summed from the clamp, is level; to a thousandth.
    fn greatest(&self) -> f64 {
        let (mut slope, mut moment, mut greatest) = (0.0, 0.0, 0.0_f64);
        for k in (0..POINTS).rev() {
            slope += self.turn[k];
            moment += self.turn[k] * self.at_m[k];
            greatest = greatest.max(moment - slope * self.at_m[k]);
        }
        greatest
    }
}
