//! Cross-section of a strand from flow and speed.

use std::f64::consts::PI;

/// Diameter of a round strand as it is drawn from the nozzle, m.
///
/// `D = sqrt(4 Q / (π v))`, flow `Q` in m³/s, speed `v` in m/s. Mass conservation; holds for draw
/// ratios near and above one (an over-fed strand meanders instead, and this is the diameter of the
/// same volume per length of path). Not a number or infinite where the speed is not positive.
/// Source: process-physics.md section 4, case MASS-BALANCE.
pub fn drawn_diameter_m(flow_m3_s: f64, speed_m_s: f64) -> f64 {
    (4.0 * flow_m3_s / (PI * speed_m_s)).sqrt()
}

/// Flow that gives a drawn strand of this diameter at this speed, m³/s: `Q = π D² v / 4`.
///
/// Inverse of [`drawn_diameter_m`].
pub fn flow_m3_s(diameter_m: f64, speed_m_s: f64) -> f64 {
    PI * diameter_m * diameter_m * speed_m_s / 4.0
}

/// Diameter once set, m: `D_cold = D_hot (ρ_hot / ρ_cold)^½`.
///
/// The volume lost is taken up across the strand, its length being held between nozzle and node;
/// what is lost along it is shrinkage. Source: process-physics.md section 2.6.
pub fn cold_diameter_m(hot_m: f64, hot_density_kg_m3: f64, cold_density_kg_m3: f64) -> f64 {
    hot_m * (hot_density_kg_m3 / cold_density_kg_m3).sqrt()
}

/// Speed at which a strand leaves the nozzle when nothing draws it, m/s.
///
/// `v_free = 4 Q / (π B² D_n²)`, swell `B` = free strand diameter over nozzle diameter `D_n` (m).
/// Source: process-physics.md section 4.
pub fn free_speed_m_s(flow_m3_s: f64, nozzle_diameter_m: f64, swell: f64) -> f64 {
    drawn_speed(flow_m3_s, swell * nozzle_diameter_m)
}

/// Draw ratio `v / v_free`: below one the strand is over-fed (slack, meander, coil), above about
/// three it thins and may break. Source: process-physics.md section 4, case SEWING-ONSET.
pub fn draw_ratio(flow_m3_s: f64, speed_m_s: f64, nozzle_diameter_m: f64, swell: f64) -> f64 {
    speed_m_s / free_speed_m_s(flow_m3_s, nozzle_diameter_m, swell)
}

/// Strain by which an over-fed strand is longer than its path: `1/DR − 1`, zero where `DR ≥ 1`.
pub fn overfeed_strain(draw_ratio: f64) -> f64 {
    (1.0 / draw_ratio - 1.0).max(0.0)
}

/// Width of a bead pressed flat to a height on bed or form, m: `Q / (v h)`.
///
/// A rectangle of the same area; rounded sides make the true bead wider by `h (1 − π/4)`.
pub fn flattened_width_m(flow_m3_s: f64, speed_m_s: f64, height_m: f64) -> f64 {
    flow_m3_s / (speed_m_s * height_m)
}

fn drawn_speed(flow_m3_s: f64, diameter_m: f64) -> f64 {
    4.0 * flow_m3_s / (PI * diameter_m * diameter_m)
}

/// A place along a strand's path and when the nozzle is there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Time, s.
    pub time_s: f64,
    /// Arc length from the strand's start, m.
    pub arc_m: f64,
}

/// What the bead's diameter depends on besides volume and path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orifice {
    /// Diameter of the nozzle's mouth, m.
    pub nozzle_m: f64,
    /// Swell `B`: diameter of a strand that nothing draws over the nozzle's.
    pub swell: f64,
    /// Density as it leaves, kg/m³.
    pub hot_kg_m3: f64,
    /// Density once set, kg/m³.
    pub cold_kg_m3: f64,
}

/// The bead of one segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bead {
    /// Length of path, m.
    pub length_m: f64,
    /// Volume that came out along it, m³, hot.
    pub volume_m3: f64,
    /// Diameter as drawn, m; infinite where the nozzle rests while material comes (that volume is a blob).
    pub hot_m: f64,
    /// Diameter once set, m.
    pub cold_m: f64,
    /// Draw ratio; infinite where nothing comes out.
    pub draw_ratio: f64,
}

/// Bead of each segment between stations by mass balance: `D = √(4 V/(π Δs))`. O(n).
///
/// `volumes_m3` holds what came out between neighbours ([`super::feed::Delivered::volumes_m3`]); one bead for
/// each volume that has two stations. The draw ratio is the segment's mean, `π B² D_n² Δs/(4 V)`. A volume
/// below zero (a retract) counts as none. Range: the material that leaves in a segment stays in it, so for
/// segments longer than a few diameters; exact in volume. Source: process-physics.md section 4, case
/// MASS-BALANCE.
pub fn beads(stations: &[Station], volumes_m3: &[f64], orifice: &Orifice) -> Vec<Bead> {
    stations
        .windows(2)
        .zip(volumes_m3)
        .map(|(ends, &volume_m3)| bead(ends[1].arc_m - ends[0].arc_m, volume_m3, orifice))
        .collect()
}

fn bead(length_m: f64, volume_m3: f64, orifice: &Orifice) -> Bead {
    let hot_m = if volume_m3 > 0.0 { drawn_diameter_m(volume_m3, length_m) } else { 0.0 };
    let free_m = orifice.swell * orifice.nozzle_m;
    Bead {
        length_m,
        volume_m3,
        hot_m,
        cold_m: cold_diameter_m(hot_m, orifice.hot_kg_m3, orifice.cold_kg_m3),
        draw_ratio: (free_m / hot_m).powi(2),
    }
}

/// Arc length at a time, m: straight between stations, the ends' own outside them.
///
/// Turns a time of [`super::feed::Starved`] into a length. O(log n); zero where there are no stations.
pub fn arc_at_m(stations: &[Station], time_s: f64) -> f64 {
    let after = stations.partition_point(|station| station.time_s <= time_s);
    match (after.checked_sub(1).and_then(|i| stations.get(i)), stations.get(after)) {
        (Some(one), Some(other)) => {
            let share = (time_s - one.time_s) / (other.time_s - one.time_s);
            one.arc_m + share * (other.arc_m - one.arc_m)
        }
        (Some(end), None) | (None, Some(end)) => end.arc_m,
        (None, None) => 0.0,
    }
}

/// Where a draw ratio lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Draw {
    /// Below the low limit: the strand is fed faster than it is laid; slack, meander, coil.
    Overfed,
    /// Between the limits.
    Within,
    /// Above the high limit: thins and may break.
    Thinned,
}

/// Judges a draw ratio; the reference's limits are 0.9 and 3 (process-physics.md section 8). Not a number is
/// `Thinned`.
pub fn judge_draw(draw_ratio: f64, low: f64, high: f64) -> Draw {
    if draw_ratio < low {
        Draw::Overfed
    } else if draw_ratio <= high {
        Draw::Within
    } else {
        Draw::Thinned
    }
}

/// The flows between which a speed keeps the draw ratio within limits, m³/s: what would satisfy the rule.
///
/// `Q = π B² D_n² v/(4 DR)`, lowest flow first (at the high limit).
pub fn flow_limits_m3_s(speed_m_s: f64, orifice: &Orifice, low: f64, high: f64) -> (f64, f64) {
    let at_one = flow_m3_s(orifice.swell * orifice.nozzle_m, speed_m_s);
    (at_one / high, at_one / low)
}

/// What a loss of strength would mean if all of it were narrowing at constant flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Narrowing {
    /// Area over the area meant.
    pub area_ratio: f64,
    /// Diameter over the diameter meant.
    pub diameter_ratio: f64,
    /// Speed over the speed meant.
    pub overspeed: f64,
}

/// Narrowing that explains a strength ratio: area ratio the same, diameter its root, overspeed its inverse.
///
/// Strength along the strand goes with its area, and area with flow over speed. An upper bound of the
/// overspeed: quality scatters too. Not a number below zero. Source: process-physics.md section 4, case
/// SLPL-NARROWING.
pub fn narrowing_from_strength(strength_ratio: f64) -> Narrowing {
    Narrowing {
        area_ratio: strength_ratio,
        diameter_ratio: strength_ratio.sqrt(),
        overspeed: 1.0 / strength_ratio,
    }
}
