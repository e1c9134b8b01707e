//! Limits of acceptance.

use serde::Deserialize;

use super::checks::{Checks, Place, Rule};
use crate::Diagnostic;

/// Limits of acceptance. Every one is positive.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LimitsFile {
    /// Least clearance of bodies that may not touch, mm.
    pub clearance_mm: f64,
    /// Nozzle tip and deposit may touch within this distance of a node they share, mm.
    pub touch_zone_mm: f64,
    /// Largest miss of a node at landing, mm.
    pub node_miss_mm: f64,
    /// Largest sag of a strand, mm.
    pub sag_mm: f64,
    /// Least distance of a joint to its stop, degrees or mm.
    pub joint_margin_deg: f64,
    /// Largest share of a joint's speed limit, percent.
    pub joint_speed_percent: f64,
    /// Condition number of the Jacobian (length scale 1 m) that warns, and that stops.
    pub condition_number: [f64; 2],
    /// Least wrist angle from its singularity, degrees.
    pub wrist_deg: f64,
    /// Largest distance from the orifice at which the strand must be set, mm.
    pub set_distance_mm: f64,
    /// Largest deflection of the finished part under its loads, mm.
    pub deflection_mm: f64,
    /// Largest share of the strength of a member or node while printing, percent.
    #[serde(default = "all_of_it")]
    pub strength_percent: f64,
    /// Least factor on what the growing frame carries at which it buckles.
    #[serde(default = "twice")]
    pub buckling_factor: f64,
    /// Least factor on the loads at which the finished part yields or collapses.
    #[serde(default = "one")]
    pub load_factor: f64,
    /// Share of a strand's radius left uncured that warns, and that stops.
    pub uncured_share: [f64; 2],
    /// Largest difference of the TCP's speed from the asked one, percent.
    #[serde(default = "ten_percent")]
    pub speed_band_percent: f64,
    /// Largest share of a joint's torque limit, percent.
    #[serde(default = "all_of_it")]
    pub torque_percent: f64,
    /// Largest share of a joint's acceleration limit, percent.
    #[serde(default = "all_of_it")]
    pub acceleration_percent: f64,
    /// Largest difference of the bead's diameter from the asked one, percent.
    #[serde(default = "ten_percent")]
    pub bead_band_percent: f64,
    /// Least and largest speed of the nozzle over that of a free strand.
    #[serde(default = "draw_ratio")]
    pub draw_ratio: [f64; 2],
    /// Largest dose at the nozzle's tip while one bead passes, as a share of the critical exposure.
    #[serde(default = "one")]
    pub tip_dose_share: f64,
    /// Largest angle between the nozzle's axis and the strand, degrees; not given: any.
    pub nozzle_angle_deg: Option<f64>,
    /// Longest the program may take, s; not given: as long as it takes.
    pub cycle_time_s: Option<f64>,
}

/// A tenth of the speed is a twentieth of the bead's diameter.
fn ten_percent() -> f64 {
    10.0
}

/// Below, a strand coils; above, it thins and may break (process-physics.md, sections 4 and 8).
fn draw_ratio() -> [f64; 2] {
    [0.9, 3.0]
}

/// At twice what it carries an imperfect frame already bends twice as far as a linear one: `1/(1 - 1/2)`.
fn twice() -> f64 {
    2.0
}

/// At a critical exposure the gel on the tip sets; at its own load a part yields.
fn one() -> f64 {
    1.0
}

fn all_of_it() -> f64 {
    100.0
}

/// A score divides by the limit, so none may be zero.
pub(super) fn check(limits: Option<Place<'_>>, checks: &mut Checks) {
    let Some(limits) = limits else { return };
    for limit in limits.entries() {
        let rule = match limit.name() {
            "joint_speed_percent"
            | "torque_percent"
            | "acceleration_percent"
            | "speed_band_percent"
            | "bead_band_percent"
            | "strength_percent" => Rule::AboveUpTo(0.0, 100.0),
            "nozzle_angle_deg" => Rule::AboveUpTo(0.0, 180.0),
            "wrist_deg" => Rule::Between(0.0, 90.0),
            _ => Rule::Positive,
        };
        checks.number(Some(limit), rule);
    }
    pair(limits.get("condition_number"), Rule::FromTo(1.0, 1e9), checks);
    pair(limits.get("uncured_share"), Rule::AboveUpTo(0.0, 1.0), checks);
    pair(limits.get("draw_ratio"), Rule::Between(0.0, 1e3), checks);
}

/// Two numbers, the second not below the first.
fn pair(place: Option<Place<'_>>, rule: Rule, checks: &mut Checks) {
    checks.numbers(place, rule);
    let Some(place) = place else { return };
    if let Some([low, high]) = place.numbers().as_deref()
        && low > high
    {
        let says = format!("the first number, {low}, is above the second, {high}");
        checks.refuse(Diagnostic::error(place.span(), says).hint("the order is [low, high]"));
    }
}
