//! A strand that already stands, warmed again by the nozzle that passes it and by its jet.

use std::f64::consts::PI;

use super::heat::{air_properties, radiation_h_w_m2k};

/// The hot face of a nozzle: a flat disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HotTip {
    /// Its temperature, K.
    pub temperature_k: f64,
    /// Its radius, m; with a bare heater block, that of the block.
    pub radius_m: f64,
    /// Its emissivity.
    pub emissivity: f64,
}

/// Air of the jet where it meets the strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WarmJet {
    /// Its temperature there, K: between that of the supply and of the nozzle.
    pub temperature_k: f64,
    /// Distance from the axis of the nozzle to which it blows, m.
    pub reach_m: f64,
    /// Heat transfer in it, W/(m² K).
    pub h_w_m2k: f64,
}

/// The strand that stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbour {
    /// Temperature as the nozzle comes near, K.
    pub start_k: f64,
    /// Its glass transition, K.
    pub glass_k: f64,
    /// Diameter, m.
    pub diameter_m: f64,
    /// Length, m.
    pub length_m: f64,
    /// Density times specific heat, J/(m³ K).
    pub heat_capacity_j_m3k: f64,
    /// Emissivity.
    pub emissivity: f64,
    /// Temperature of the room, K.
    pub air_k: f64,
    /// Heat transfer to the room, radiation included, W/(m² K).
    pub room_h_w_m2k: f64,
}

/// How the nozzle goes by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passing {
    /// Still air between the face of the nozzle and the nearest point of the strand, m; under a micrometre it counts as
    /// one, which is touching.
    pub gap_m: f64,
    /// Speed of the nozzle, m/s.
    pub speed_m_s: f64,
    /// Time it stands at the nearest point, s.
    pub dwell_s: f64,
    /// Its way over the strand.
    pub way: Way,
}

/// The way of a nozzle over a strand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Along it.
    Along,
    /// Square across it.
    Across,
}

/// What the passing nozzle does to the strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reheat {
    /// Highest mean temperature of a section at the nearest point, K.
    pub peak_k: f64,
    /// Time that section is above the glass transition, s; infinite in air as warm.
    pub above_glass_s: f64,
    /// Length of strand brought above it at one time or another, m, at most the strand's.
    pub length_m: f64,
}

/// Steps in each stretch of the way; error second order, below 1e-3 of the rise.
const STEPS: u32 = 16;

/// Rough faces do not come nearer; ours.
const LEAST_GAP_M: f64 = 1e-6;

/// What a passing nozzle does to a strand.
///
/// Lumped section, no conduction along the strand:
/// ```text
/// ρ cp πD²/4 dT/dt = D (h_gap + h_rad F)(T_tip − T) + πD h (T_gas − T)
/// ```
/// `F` the view factor of the disc ([`disc_view_factor`]) times both emissivities, `h_gap = k_air/gap` where the disc
/// is opposite (air midway between tip and strand as it starts) and nothing elsewhere, `h` and `T_gas` those of the jet within its reach and of the room
/// beyond. Each step is the exponential of coefficients frozen at its middle, so no temperature leaves the range
/// of its sources. For `D h/(2k)` up to about 0.3; above it the surface is warmer than the mean given here. `h_gap`
/// takes the round strand as flat: high by a factor of up to two for gaps well below `D/2`; heat carried by the
/// plume of a hot block is left out. Call at low and high gap and reach for a range. The model is
/// ours, unmeasured. Starts and ends ten disc radii or reaches away. Cost: about 10 µs, 300 µs
/// where the length must be searched. Numbers that are not positive and finite give numbers that are not finite.
pub fn reheat(
    tip: &HotTip,
    jet: Option<&WarmJet>,
    neighbour: &Neighbour,
    passing: &Passing,
) -> Reheat {
    let scene = Scene::new(tip, jet, neighbour, passing);
    let nearest = scene.section(0.0, STEPS);
    let is_hot = |aside_m: f64| scene.section(aside_m, STEPS).0 > neighbour.glass_k;
    let half_m = 0.5 * neighbour.length_m;
    let length_m = if !(nearest.0 > neighbour.glass_k) {
        0.0
    } else if is_hot(half_m) {
        neighbour.length_m
    } else {
        let (mut hot_m, mut cold_m) = (0.0, half_m);
        for _ in 0..14 {
            let middle_m = 0.5 * (hot_m + cold_m);
            if is_hot(middle_m) { hot_m = middle_m } else { cold_m = middle_m }
        }
        2.0 * hot_m
    };
    Reheat { peak_k: nearest.0, above_glass_s: nearest.1, length_m }
}

/// Share of what a small surface sees that is a disc, it facing the disc's plane squarely.
///
/// `F = ½ [1 − (ρ² + g² − r²) / √((ρ² + g² + r²)² − 4 r² ρ²)]`: radius `r`, distance of the planes `g`, distance
/// `ρ` from the axis, all m. Exact; a half at the rim where they touch.
pub fn disc_view_factor(radius_m: f64, gap_m: f64, offset_m: f64) -> f64 {
    let (r2, g2, o2) = (radius_m * radius_m, gap_m * gap_m, offset_m * offset_m);
    let root = ((o2 + g2 + r2).powi(2) - 4.0 * r2 * o2).max(0.0).sqrt();
    if root > 0.0 { 0.5 * (1.0 - (o2 + g2 - r2) / root) } else { 0.5 }
}

struct Scene<'a> {
    tip: &'a HotTip,
    jet: Option<&'a WarmJet>,
    neighbour: &'a Neighbour,
    passing: &'a Passing,
    /// Heat transfer through the still air under the disc, W/(m² K).
    gap_h_w_m2k: f64,
}

/// A section as it is warmed.
struct Section {
    now_k: f64,
    peak_k: f64,
    hot_s: f64,
}

impl<'a> Scene<'a> {
    fn new(
        tip: &'a HotTip,
        jet: Option<&'a WarmJet>,
        neighbour: &'a Neighbour,
        passing: &'a Passing,
    ) -> Self {
        let film_k = 0.5 * (tip.temperature_k + neighbour.start_k);
        let gap_h_w_m2k = air_properties(film_k).conductivity_w_mk / passing.gap_m.max(LEAST_GAP_M);
        Self { tip, jet, neighbour, passing, gap_h_w_m2k }
    }

    /// Peak temperature and time above the glass transition of the section a distance along the strand from the
    /// point where the nozzle is nearest or waits.
    fn section(&self, aside_m: f64, steps: u32) -> (f64, f64) {
        let start_k = self.neighbour.start_k;
        let mut section = Section { now_k: start_k, peak_k: start_k, hot_s: 0.0 };
        let (shift_m, across_m) = match self.passing.way {
            Way::Along => (aside_m, 0.0),
            Way::Across => (0.0, aside_m),
        };
        let reach_m = self.jet.map_or(0.0, |jet| jet.reach_m);
        let far_m = 10.0 * self.tip.radius_m.max(reach_m).max(self.passing.gap_m);
        let half_chord =
            |radius_m: f64| (radius_m * radius_m - across_m * across_m).max(0.0).sqrt();
        let (face_m, blown_m) = (half_chord(self.tip.radius_m), half_chord(reach_m));
        let mut marks = [
            -far_m,
            shift_m - blown_m,
            shift_m - face_m,
            0.0,
            shift_m,
            shift_m + face_m,
            shift_m + blown_m,
            shift_m + far_m,
        ];
        marks.sort_by(f64::total_cmp);
        for pair in marks.windows(2) {
            let step_m = (pair[1] - pair[0]) / f64::from(steps);
            if step_m > 0.0 {
                for i in 0..steps {
                    let ahead_m = pair[0] + step_m * (f64::from(i) + 0.5) - shift_m;
                    let offset_m = ahead_m.hypot(across_m);
                    self.step(&mut section, step_m / self.passing.speed_m_s, offset_m);
                }
            }
            if pair[1] == 0.0 && pair[0] < 0.0 && self.passing.dwell_s > 0.0 {
                for _ in 0..4 * steps {
                    let step_s = self.passing.dwell_s / f64::from(4 * steps);
                    self.step(&mut section, step_s, aside_m);
                }
            }
        }
        (section.peak_k, section.hot_s + self.still_hot_s(section.now_k))
    }

    /// Conductance per length, W/(m K), and the temperature it draws to, K.
    fn draw(&self, now_k: f64, offset_m: f64) -> (f64, f64) {
        let (tip, strand) = (self.tip, self.neighbour);
        let seen = disc_view_factor(tip.radius_m, self.passing.gap_m, offset_m);
        let emissivity = tip.emissivity * strand.emissivity;
        let mut tip_h = seen * radiation_h_w_m2k(emissivity, now_k, tip.temperature_k);
        if offset_m < tip.radius_m {
            tip_h += self.gap_h_w_m2k;
        }
        let (gas_h, gas_k) = match self.jet {
            Some(jet) if offset_m < jet.reach_m => (jet.h_w_m2k, jet.temperature_k),
            Some(_) | None => (strand.room_h_w_m2k, strand.air_k),
        };
        let (by_tip, by_gas) = (strand.diameter_m * tip_h, PI * strand.diameter_m * gas_h);
        let sum = by_tip + by_gas;
        if sum > 0.0 {
            (sum, (by_tip * tip.temperature_k + by_gas * gas_k) / sum)
        } else {
            (0.0, now_k)
        }
    }

    /// Heat per length and kelvin, J/(m K).
    fn capacity_j_mk(&self) -> f64 {
        let strand = self.neighbour;
        strand.heat_capacity_j_m3k * PI * strand.diameter_m * strand.diameter_m / 4.0
    }

    fn step(&self, section: &mut Section, step_s: f64, offset_m: f64) {
        let from_k = section.now_k;
        let after = |(sum, to_k): (f64, f64), time_s: f64| {
            to_k + (from_k - to_k) * (-sum * time_s / self.capacity_j_mk()).exp()
        };
        let middle_k = after(self.draw(from_k, offset_m), 0.5 * step_s);
        let (sum, drawn_to_k) = self.draw(middle_k, offset_m);
        let to_k = after((sum, drawn_to_k), step_s);
        let glass_k = self.neighbour.glass_k;
        if from_k > glass_k && to_k > glass_k {
            section.hot_s += step_s;
        } else if from_k > glass_k || to_k > glass_k {
            let folds = ((from_k - drawn_to_k) / (glass_k - drawn_to_k)).ln();
            let crossing_s = (folds * self.capacity_j_mk() / sum).max(0.0).min(step_s);
            section.hot_s += if to_k > glass_k { step_s - crossing_s } else { crossing_s };
        }
        section.now_k = to_k;
        section.peak_k = section.peak_k.max(to_k);
    }

    /// Time still above the glass transition once the nozzle is away, s.
    fn still_hot_s(&self, now_k: f64) -> f64 {
        let strand = self.neighbour;
        if now_k <= strand.glass_k {
            return 0.0;
        }
        if strand.glass_k <= strand.air_k {
            return f64::INFINITY;
        }
        let conductance = PI * strand.diameter_m * strand.room_h_w_m2k;
        let folds = ((now_k - strand.air_k) / (strand.glass_k - strand.air_k)).ln();
        folds * self.capacity_j_mk() / conductance
    }
}

#[cfg(test)]
mod tests;
