//! Degree of cure of a material point along its life, under any light and temperature.

use super::cure_piece::{Piece, pieces};
use super::kamal::CureCurve;
use super::kinetics::Kinetics;
use super::oxygen::Reoxygenation;

/// What a material point meets at an age; straight lines between, a step is two of one age.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exposed {
    /// Time since the nozzle, s.
    pub age_s: f64,
    /// Irradiance there, W/m².
    pub irradiance_w_m2: f64,
    /// Temperature there, K.
    pub temperature_k: f64,
}

/// Degree of cure against age.
#[derive(Debug, Clone, PartialEq)]
pub struct Cured {
    /// Ages at which the light or the temperature turns, s.
    pub ages_s: Vec<f64>,
    /// Degree of cure there.
    pub alpha: Vec<f64>,
    /// Age at which it gels, s; infinite if it never does.
    pub gel_age_s: f64,
    kinetics: Kinetics,
    curve: CureCurve,
    pieces: Vec<Piece>,
}

/// Cure under a history: [`Kinetics`] with light and temperature piecewise linear over age.
///
/// `curve` is `kinetics.kamal.curve()`, made once. The light may come in several passes; in the dark nothing
/// happens but, with `reoxygenation`, oxygen coming back, which eats the first of the next light. Reduced
/// time is integrated by piece: in closed form where the temperature is constant, else by five-point quadrature
/// weighted by the closed form (1e-6 for a change of 50 K in one piece, tested). Samples that go back in age or
/// are no number are passed over; no light where it is not positive. Cost: 0.4 µs a
/// sample, 1 µs where the temperature changes.
pub fn cure(
    kinetics: &Kinetics,
    curve: &CureCurve,
    history: &[Exposed],
    reoxygenation: Option<Reoxygenation>,
) -> Cured {
    let mut pieces = pieces(history, reoxygenation);
    let mut reduced_s = 0.0;
    for piece in &mut pieces {
        piece.before_s = reduced_s;
        reduced_s += piece.reduced_s(kinetics, 1.0);
    }
    let mut cured = Cured {
        ages_s: pieces.first().map(|piece| piece.from_s).into_iter().collect(),
        alpha: Vec::new(),
        gel_age_s: f64::INFINITY,
        kinetics: *kinetics,
        curve: curve.clone(),
        pieces,
    };
    cured.ages_s.extend(cured.pieces.iter().map(|piece| piece.to_s));
    let after = |i: usize| cured.pieces.get(i).map_or(reduced_s, |piece| piece.before_s);
    cured.alpha = (0..cured.ages_s.len()).map(|i| curve.degree(after(i))).collect();
    cured.gel_age_s = cured.gel_age_behind_s(1.0);
    cured
}

impl Cured {
    /// Degree of cure at an age; zero before the history, what it came to after it.
    pub fn at(&self, age_s: f64) -> f64 {
        self.at_behind(age_s, 1.0)
    }

    /// The same where only a share of the light arrives: reduced time goes by `shareᵇ`.
    ///
    /// Exact where temperature is the same and that share is constant; oxygen that came back is counted as
    /// here. 1 µs at most.
    pub fn at_behind(&self, age_s: f64, share: f64) -> f64 {
        self.curve.degree(self.reduced_s(age_s) * self.slowed(share))
    }

    /// Age at which a point gels where only a share of the light arrives, s; infinite if it never does.
    pub fn gel_age_behind_s(&self, share: f64) -> f64 {
        let target_s = self.curve.gel_s / self.slowed(share);
        if !target_s.is_finite() {
            return f64::INFINITY;
        }
        let reached = self.pieces.partition_point(|piece| piece.before_s < target_s);
        let Some(piece) = reached.checked_sub(1).and_then(|i| self.pieces.get(i)) else {
            return self.pieces.first().map_or(f64::INFINITY, |piece| piece.from_s);
        };
        piece.age_at_s(&self.kinetics, target_s - piece.before_s)
    }

    /// Reduced time at an age, s: seconds of reference light at reference temperature.
    pub fn reduced_s(&self, age_s: f64) -> f64 {
        let begun = self.pieces.partition_point(|piece| piece.from_s <= age_s);
        let Some(piece) = begun.checked_sub(1).and_then(|i| self.pieces.get(i)) else {
            return 0.0;
        };
        let share = ((age_s - piece.from_s) / (piece.to_s - piece.from_s)).clamp(0.0, 1.0);
        piece.before_s + piece.reduced_s(&self.kinetics, share)
    }

    fn slowed(&self, share: f64) -> f64 {
        if share > 0.0 { share.powf(self.kinetics.b) } else { 0.0 }
    }
}
