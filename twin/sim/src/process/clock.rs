//! What sets by the clock: two-part resins from the mixer on, melts that must not wait in the hot end.

use super::kamal::{CureCurve, Kamal};
use super::kinetics::{Kinetics, arrhenius};
use super::sag::Fluidity;

/// Quadrature panels to each stretch of [`Mixed::fluidity`]; the stretches shorten towards the gel point, where the
/// viscosity runs away.
const PANELS: u32 = 5;
const STRETCHES: [f64; 5] = [0.0, 0.8, 0.96, 0.995, 1.0];

/// A two-part resin's clock. Ages count from the mixing, not from the nozzle.
///
/// Temperature makes it go faster by `exp[−Ea/R (1/T − 1/T_ref)]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Age at which it gels at the reference temperature, s.
    pub set_time_s: f64,
    /// Age up to which it may stand in the mixer and still be pushed out, at the reference temperature, s.
    pub pot_life_s: f64,
    /// Activation energy, J/mol.
    pub activation_j_mol: f64,
    /// Reference temperature, K.
    pub reference_k: f64,
}

impl Clock {
    /// The clock of a resin whose set time was seen behind the nozzle: the residence in the mixer, s, comes on top.
    ///
    /// LAARMAN-SET gives 0.3 s after the nozzle; how long its mixer holds the resin is not known.
    #[must_use]
    pub fn seen_behind_nozzle(self, after_nozzle_s: f64, residence_s: f64) -> Self {
        Self { set_time_s: after_nozzle_s + residence_s, ..self }
    }

    /// How much faster it goes at a temperature, K.
    pub fn speed(&self, temperature_k: f64) -> f64 {
        arrhenius(self.activation_j_mol, self.reference_k, temperature_k)
    }

    /// Age at the reference temperature that has done as much, s: the mixer at its temperature, then the strand.
    pub fn reduced_s(&self, residence_s: f64, mixer_k: f64, age_s: f64, strand_k: f64) -> f64 {
        residence_s.max(0.0) * self.speed(mixer_k) + age_s.max(0.0) * self.speed(strand_k)
    }

    /// Time from nozzle to set, s; zero where it sets in the mixer, infinite where it is too cold to.
    pub fn set_after_nozzle_s(&self, residence_s: f64, mixer_k: f64, strand_k: f64) -> f64 {
        let left_s = self.set_time_s - residence_s.max(0.0) * self.speed(mixer_k);
        if left_s <= 0.0 { 0.0 } else { left_s / self.speed(strand_k) }
    }

    /// Cure law that gels at the set time; of the law given only `k2/k1` is kept.
    pub fn kamal(&self, law: Kamal) -> Kamal {
        law.gelling_in(self.set_time_s)
    }

    /// The same as a law for [`super::cured::cure`], for strands whose temperature changes: any irradiance
    /// above zero lets the clock go, so give histories one of 1 W/m².
    pub fn kinetics(&self, law: Kamal) -> Kinetics {
        Kinetics {
            kamal: self.kamal(law),
            b: 0.0,
            activation_j_mol: self.activation_j_mol,
            reference_w_m2: 1.0,
            reference_k: self.reference_k,
        }
    }

    /// Longest time the flow may stop without blocking the mixer, s (E511): `pot life(T) − V/Q`.
    ///
    /// The oldest resin in the mixer is a residence old when the flow stops. Negative: it blocks while
    /// flowing, by so much. Plug flow; what sticks to the walls is older, which is left out.
    pub fn longest_idle_s(&self, residence_s: f64, mixer_k: f64) -> f64 {
        longest_wait_s(self.pot_life_s, self.speed(mixer_k), residence_s)
    }
}

/// Age at the nozzle, s: time in a mixer or hot end, `V/Q`, in plug flow; infinite without flow.
pub fn age_at_nozzle_s(volume_m3: f64, flow_m3_s: f64) -> f64 {
    if flow_m3_s > 0.0 { volume_m3 / flow_m3_s } else { f64::INFINITY }
}

/// Least flow that keeps a mixer or hot end from going off, m³/s: `V / life`.
pub fn least_flow_m3_s(volume_m3: f64, life_s: f64) -> f64 {
    volume_m3 / life_s
}

/// How long a melt stands heat before it degrades.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeltLife {
    /// That time at the reference temperature, s.
    pub life_s: f64,
    /// Activation energy of the degradation, J/mol.
    pub activation_j_mol: f64,
    /// Reference temperature, K.
    pub reference_k: f64,
}

impl MeltLife {
    /// Longest time the flow may stop, s (E511): `life(T) − V/Q`. Negative: too slow even while it flows.
    pub fn longest_idle_s(&self, residence_s: f64, hot_end_k: f64) -> f64 {
        let speed = arrhenius(self.activation_j_mol, self.reference_k, hot_end_k);
        longest_wait_s(self.life_s, speed, residence_s)
    }
}

fn longest_wait_s(life_s: f64, speed: f64, residence_s: f64) -> f64 {
    life_s / speed - residence_s
}

/// Viscosity up to the gel point: `η = η0 [α_gel/(α_gel − α)]^(a + b α)`, infinite from there on.
///
/// Castro & Macosko; `η0` Pa s at the strand's temperature. Exponents of no resin here are known: 1 to 2 and
/// 0 to 2 are usual for polyurethanes (ours, from memory).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thickening {
    /// Viscosity before cure, Pa s.
    pub viscosity_pa_s: f64,
    /// Degree of cure at the gel point.
    pub gel: f64,
    /// Exponent at the start.
    pub a: f64,
    /// Growth of the exponent with the degree of cure.
    pub b: f64,
}

impl Thickening {
    /// Viscosity at a degree of cure, Pa s.
    pub fn viscosity_pa_s(&self, degree: f64) -> f64 {
        if !(degree < self.gel) {
            return f64::INFINITY;
        }
        let held = degree.max(0.0);
        self.viscosity_pa_s * (self.gel / (self.gel - held)).powf(self.a + self.b * held)
    }
}

/// A two-part strand as it leaves the nozzle, at one temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mixed<'a> {
    /// Its clock.
    pub clock: Clock,
    /// Solution of `clock.kamal(..)`, made once to a material.
    pub curve: &'a CureCurve,
    /// Time in the mixer, s.
    pub residence_s: f64,
    /// Temperature there, K.
    pub mixer_k: f64,
    /// Temperature of the strand, K; its heat of cure is left out.
    pub strand_k: f64,
}

impl Mixed<'_> {
    /// Degree of cure at an age after the nozzle, s.
    pub fn degree(&self, age_s: f64) -> f64 {
        let reduced_s = self.clock.reduced_s(self.residence_s, self.mixer_k, age_s, self.strand_k);
        self.curve.degree(reduced_s)
    }

    /// Fluidity of the strand as the sag laws take it, `1/(3η)` up to the set time.
    ///
    /// Zero moments where it leaves the mixer set; moments of infinite age where it never sets are cut at
    /// `patience_s`. Cost: a hundred degrees of cure, 40 µs.
    pub fn fluidity(&self, thickening: &Thickening, patience_s: f64) -> Fluidity {
        let set_s = self.clock.set_after_nozzle_s(self.residence_s, self.mixer_k, self.strand_k);
        let fluid = |age_s: f64| 1.0 / (3.0 * thickening.viscosity_pa_s(self.degree(age_s)));
        Fluidity::integrate(fluid, &STRETCHES.map(|share| share * set_s.min(patience_s)), PANELS)
    }
}
