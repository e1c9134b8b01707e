//! Air nozzles on the tool: how fast the air of their free jets passes a strand.

use crate::pose::{Point, Vector};

#[cfg(test)]
mod tests;

/// Length of the potential core over the bore, and the constant of the decay behind it.
///
/// Found: 6.11 at an exit Reynolds number of 19400 (Abdel-Rahman et al. 1996, abstract). From memory: 5.8
/// (Hussein, Capp and George 1994) and 6.06 (Panchapakesan and Lumley 1993), both behind a virtual origin.
const CORE_BORES: f64 = 6.2;

/// A nozzle that blows air, in the tool's axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AirNozzle {
    /// Middle of its mouth, m.
    pub at: Point,
    /// Where it blows; its length does not matter.
    pub along: Vector,
    /// Bore, m.
    pub bore_m: f64,
    /// Speed of the air at its mouth, alike over the bore, m/s.
    pub exit_speed_m_s: f64,
}

/// Speed of the air of a free round turbulent jet, m/s, along its axis.
///
/// `ahead_m` is the distance from the mouth along the axis, `beside_m` the distance from the axis. Behind
/// `x = 6.2 d` the middle slows as `u = 6.2 u0 d/x` and the speed falls off as `exp(−ln 2 (r/b)²)`; before
/// it a core of radius `(d/2)(1 − x/6.2 d)` keeps `u0` and the fall-off starts at its edge. `b` follows from
/// momentum, `∫ u² dA = u0² π d²/4` at every `x`: far on `b = 0.0950 x` (measured 0.094 to 0.096, from
/// memory, same authors). Nothing behind the mouth.
///
/// Range: still air at the jet's own temperature, nothing in its way (strand and part are left out), exit
/// Reynolds number above about 1e4; a jet of 1400 slows several times sooner (1.35 for 6.2: Abdel-Rahman),
/// so what a fine needle does is overstated. Error 10 % in the middle, more at the edge, where the true
/// profile falls faster. Zero where bore or speed is not positive.
pub fn free_jet_m_s(bore_m: f64, exit_speed_m_s: f64, ahead_m: f64, beside_m: f64) -> f64 {
    use std::f64::consts::{LN_2, PI};
    if !(bore_m > 0.0 && exit_speed_m_s > 0.0 && ahead_m >= 0.0 && beside_m >= 0.0) {
        return 0.0;
    }
    let (core_end_m, radius_m) = (CORE_BORES * bore_m, 0.5 * bore_m);
    let core_m = radius_m * (1.0 - ahead_m / core_end_m).max(0.0);
    let past_core_m = beside_m - core_m;
    let middle_m_s = exit_speed_m_s * (core_end_m / ahead_m).min(1.0);
    if past_core_m <= 0.0 {
        return middle_m_s;
    }
    // c² + 2 c b √(π/8 ln 2) + b²/(2 ln 2) = (u0 d / 2u)², for b.
    let linear = core_m * (PI / (8.0 * LN_2)).sqrt();
    let square = 0.5 / LN_2;
    let full_m = radius_m * exit_speed_m_s / middle_m_s;
    let missing_m2 = (full_m - core_m) * (full_m + core_m);
    let half_m = missing_m2 / (linear + (linear * linear + square * missing_m2).sqrt());
    let fall = past_core_m / half_m;
    if half_m > 0.0 { middle_m_s * (-LN_2 * fall * fall).exp() } else { 0.0 }
}

/// Speed of the air across a strand at a point, m/s, from all nozzles.
///
/// `point` and `tangent` in the tool's axes; `tangent` need not be of unit length. Of each jet counts what
/// is square to the strand, `u sin θ`, as cross-flow laws want it; several add by momentum, `√Σ u²` (ours).
/// Flow along the strand is left out, which understates a jet that follows it. Cost O(nozzles).
pub fn air_speed_m_s(nozzles: &[AirNozzle], point: &Point, tangent: &Vector) -> f64 {
    let square = |nozzle: &AirNozzle| {
        let (along, tangent) = (unit(&nozzle.along), unit(tangent));
        let from_mouth = point - nozzle.at;
        let ahead_m = from_mouth.dot(&along);
        let beside_m = (from_mouth - along * ahead_m).norm();
        let speed = free_jet_m_s(nozzle.bore_m, nozzle.exit_speed_m_s, ahead_m, beside_m);
        speed * speed * along.cross(&tangent).norm_squared()
    };
    nozzles.iter().map(square).sum::<f64>().sqrt()
}

/// A vector of length one, or zero where it has no direction.
fn unit(vector: &Vector) -> Vector {
    let length = vector.norm();
    if length > 0.0 && length.is_finite() { vector / length } else { Vector::zeros() }
}

/// Speed of the air across a straight strand against the distance behind the orifice, m/s.
///
/// Straight between its points, zero outside them: what hits at one place does not cool elsewhere.
#[derive(Debug, Clone, PartialEq)]
pub struct JetProfile {
    step_m: f64,
    speeds_m_s: Vec<f64>,
}

impl JetProfile {
    /// The profile of a strand that leaves the orifice along a direction.
    ///
    /// `orifice` and `leaving` in the tool's axes, `leaving` from the orifice to what is already made;
    /// `points` (at least two, at most 10 000) from the orifice to `reach_m`, a few to a bore's width.
    pub fn new(
        nozzles: &[AirNozzle],
        orifice: &Point,
        leaving: &Vector,
        reach_m: f64,
        points: usize,
    ) -> Self {
        let points = points.clamp(2, 10_000);
        let (along, step_m) = (unit(leaving), reach_m.max(0.0) / (points - 1) as f64);
        let speed =
            |i: usize| air_speed_m_s(nozzles, &(orifice + along * (step_m * i as f64)), &along);
        Self { step_m, speeds_m_s: (0..points).map(speed).collect() }
    }

    /// Length of strand that the profile covers, m.
    pub fn reach_m(&self) -> f64 {
        self.step_m * (self.speeds_m_s.len() - 1) as f64
    }

    /// Speed across the strand at a distance behind the orifice, m/s.
    pub fn at_distance_m_s(&self, distance_m: f64) -> f64 {
        let place = distance_m / self.step_m;
        let last = self.speeds_m_s.len() - 1;
        if !(place >= 0.0 && place <= last as f64) {
            return 0.0;
        }
        let i = (place as usize).min(last - 1);
        let share = place - i as f64;
        self.speeds_m_s[i] + share * (self.speeds_m_s[i + 1] - self.speeds_m_s[i])
    }

    /// Speed that a section meets at an age when the nozzle moves steadily, m/s: the greater of the jets'
    /// at `distance = v a` and the room's draught.
    pub fn at_age_m_s(&self, age_s: f64, nozzle_m_s: f64, room_m_s: f64) -> f64 {
        self.at_distance_m_s(nozzle_m_s * age_s).max(room_m_s)
    }
}
