//! A stretch of a material point's life in which light and temperature are straight lines.

use super::cured::Exposed;
use super::kamal::GAUSS_UNIT;
use super::kinetics::{Kinetics, arrhenius};
use super::oxygen::Reoxygenation;

/// Ends of the stretches that light from or to darkness is integrated over, from the dark end on.
const DUSK: [f64; 5] = [0.0, 0.015_625, 0.0625, 0.25, 1.0];

/// A stretch of straight light and temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piece {
    pub(super) from_s: f64,
    pub(super) to_s: f64,
    pub(super) light: [f64; 2],
    pub(super) kelvin: [f64; 2],
    /// Reduced time before it, s.
    pub(super) before_s: f64,
}

impl Piece {
    fn between(from: Exposed, to: Exposed) -> Self {
        let lit = |light: f64| if light > 0.0 && light.is_finite() { light } else { 0.0 };
        Self {
            from_s: from.age_s,
            to_s: to.age_s,
            light: [lit(from.irradiance_w_m2), lit(to.irradiance_w_m2)],
            kelvin: [from.temperature_k, to.temperature_k],
            before_s: 0.0,
        }
    }

    /// Reduced time from its start to a share of its length, s.
    pub(super) fn reduced_s(&self, kinetics: &Kinetics, share: f64) -> f64 {
        let along = |ends: [f64; 2], x: f64| ends[0] + x * (ends[1] - ends[0]);
        let unit_w_m2 = kinetics.reference_w_m2;
        let light = [self.light[0], along(self.light, share)].map(|light| light / unit_w_m2);
        if !(light[0] > 0.0 || light[1] > 0.0) {
            return 0.0;
        }
        let kelvin = [self.kelvin[0], along(self.kelvin, share)];
        let speed = |kelvin| arrhenius(kinetics.activation_j_mol, kinetics.reference_k, kelvin);
        let mean = if kelvin[0] == kelvin[1] {
            mean_power(light, kinetics.b) * speed(kelvin[0])
        } else {
            let mean = |[from, to]: [f64; 2]| {
                let (mut sum, mut weights) = (0.0, 0.0);
                for (x, gauss) in GAUSS_UNIT {
                    let at = from + x * (to - from);
                    let weight = gauss * along(light, at).powf(kinetics.b);
                    sum += weight * speed(along(kelvin, at));
                    weights += weight;
                }
                let ends = [along(light, from), along(light, to)];
                (to - from) * mean_power(ends, kinetics.b) * sum / weights
            };
            if light[0].min(light[1]) > 0.25 * light[0].max(light[1]) {
                mean([0.0, 1.0])
            } else {
                // near darkness Iᵇ is steep: shorter stretches there
                let mark = |x: f64| if light[0] < light[1] { x } else { 1.0 - x };
                DUSK.windows(2).map(|pair| mean([mark(pair[0]), mark(pair[1])]).abs()).sum()
            }
        };
        let reduced_s = (self.to_s - self.from_s) * share * mean;
        if reduced_s >= 0.0 { reduced_s.min(1e300) } else { 0.0 }
    }

    /// Age at which it has given a reduced time, s; infinite if it does not. Newton kept inside by halving.
    pub(super) fn age_at_s(&self, kinetics: &Kinetics, reduced_s: f64) -> f64 {
        let total_s = self.reduced_s(kinetics, 1.0);
        if !(total_s >= reduced_s) {
            return f64::INFINITY;
        }
        let (mut low, mut high) = (0.0, 1.0);
        let mut share = (reduced_s / total_s).clamp(0.0, 1.0);
        for _ in 0..60 {
            let miss_s = self.reduced_s(kinetics, share) - reduced_s;
            if miss_s > 0.0 {
                high = share
            } else {
                low = share
            }
            if miss_s.abs() <= 1e-13 * reduced_s || high - low <= 1e-15 {
                break;
            }
            let light = self.light[0] + share * (self.light[1] - self.light[0]);
            let kelvin = self.kelvin[0] + share * (self.kelvin[1] - self.kelvin[0]);
            let slope_s = (self.to_s - self.from_s) * kinetics.drive(light, kelvin);
            let next = share - miss_s / slope_s;
            share = if next > low && next < high { next } else { 0.5 * (low + high) };
        }
        self.from_s + share * (self.to_s - self.from_s)
    }

    /// The piece in two at a share of its length.
    fn split(self, share: f64) -> (Self, Self) {
        let middle = |ends: [f64; 2]| ends[0] + share * (ends[1] - ends[0]);
        let (age_s, light, kelvin) =
            (middle([self.from_s, self.to_s]), middle(self.light), middle(self.kelvin));
        (
            Self {
                to_s: age_s,
                light: [self.light[0], light],
                kelvin: [self.kelvin[0], kelvin],
                ..self
            },
            Self {
                from_s: age_s,
                light: [light, self.light[1]],
                kelvin: [kelvin, self.kelvin[1]],
                ..self
            },
        )
    }
}

/// Stretches of a history; light that oxygen eats is taken out.
pub(super) fn pieces(history: &[Exposed], reoxygenation: Option<Reoxygenation>) -> Vec<Piece> {
    let mut pieces = Vec::with_capacity(history.len());
    let (mut was_lit, mut dark_s, mut owed_j_m2) = (false, 0.0, 0.0_f64);
    let mut last: Option<Exposed> = None;
    for &to in history.iter().filter(|sample| sample.age_s.is_finite()) {
        let Some(from) = last else {
            last = Some(to);
            continue;
        };
        let length_s = to.age_s - from.age_s;
        if !(length_s >= 0.0 && length_s.is_finite()) {
            continue;
        }
        last = Some(to);
        if length_s == 0.0 {
            continue; // a step
        }
        let piece = Piece::between(from, to);
        if piece.light == [0.0; 2] {
            dark_s += length_s;
            pieces.push(piece);
            continue;
        }
        if let (Some(oxygen), true) = (reoxygenation, was_lit) {
            owed_j_m2 = oxygen.owed_j_m2(owed_j_m2, dark_s);
        }
        (was_lit, dark_s) = (true, 0.0);
        let eaten = eaten_share(&piece, &mut owed_j_m2);
        if eaten <= 0.0 {
            pieces.push(piece);
            continue;
        }
        let (idle, rest) = piece.split(eaten);
        pieces.push(Piece { light: [0.0; 2], ..idle });
        if rest.to_s > rest.from_s {
            pieces.push(rest);
        }
    }
    pieces
}

/// Share of a piece's length whose light oxygen eats; takes its dose off what is owed.
fn eaten_share(piece: &Piece, owed_j_m2: &mut f64) -> f64 {
    if !(*owed_j_m2 > 0.0) {
        return 0.0;
    }
    let length_s = piece.to_s - piece.from_s;
    let [from, to] = piece.light;
    let dose_j_m2 = 0.5 * (from + to) * length_s;
    if dose_j_m2 <= *owed_j_m2 {
        *owed_j_m2 -= dose_j_m2;
        return 1.0;
    }
    // I0 t + (I1 − I0) t²/(2 L) = owed, in the form that does not cancel
    let root = (from * from + 2.0 * (to - from) * *owed_j_m2 / length_s).max(0.0).sqrt();
    let share = 2.0 * *owed_j_m2 / (from + root) / length_s;
    *owed_j_m2 = 0.0;
    share.clamp(0.0, 1.0)
}

/// Mean of `Iᵇ` along a straight line of light: closed, or by quadrature where the ends are too close for it.
fn mean_power([from, to]: [f64; 2], b: f64) -> f64 {
    if from == to {
        return from.powf(b);
    }
    if (to - from).abs() > 0.1 * from.max(to) {
        return (to.powf(b + 1.0) - from.powf(b + 1.0)) / ((b + 1.0) * (to - from));
    }
    GAUSS_UNIT.into_iter().map(|(x, weight)| weight * (from + x * (to - from)).powf(b)).sum()
}
