//! `MEASURED.toml`: a few prints, what was measured on them, and how surely.

use serde::Deserialize;

use crate::cell_file::checks::{Checks, Place, Rule, parse_checked};
use crate::{Diagnostic, Source, Span};

#[cfg(test)]
mod tests;

/// Measured prints as written.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeasuredFile {
    /// Cell they were printed in: nozzle, swell, air jets, lamps, usual speed and bead.
    pub cell: String,
    /// Material whose numbers are to be fitted.
    pub material: String,
    /// Strain by which a held strand is longer than flow and shrinkage say: nominal, low, high.
    ///
    /// Half a percent either way if absent: ours, after the 0.03 to 0.3 % that bridges of practice imply.
    #[serde(default = "half_a_percent")]
    pub slack: [f64; 3],
    /// The air they were printed in.
    #[serde(default)]
    pub air: AirFile,
    /// Strands that hung from the nozzle.
    #[serde(default)]
    pub free_hang: Vec<FreeHangFile>,
    /// Level strands between two supports.
    #[serde(default)]
    pub bridge: Vec<BridgeFile>,
    /// Level strands held where they begin.
    #[serde(default)]
    pub cantilever: Vec<CantileverFile>,
    /// Pools of resin lit from one side.
    #[serde(default)]
    pub cured_depth: Vec<CuredDepthFile>,
}

/// The air, as a job has it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct AirFile {
    /// Its temperature, °C.
    pub air_c: f64,
    /// Draught, m/s.
    pub air_m_s: f64,
}

impl Default for AirFile {
    fn default() -> Self {
        Self { air_c: 23.0, air_m_s: 0.0 }
    }
}

/// A short strand that hung from the nozzle at the flow of the print.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FreeHangFile {
    /// Its diameter once set, mm.
    pub diameter_mm: f64,
    /// Standard deviation of that, spread from print to print included, mm.
    pub sd_mm: f64,
}

/// A level strand between two supports.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BridgeFile {
    /// Distance of the supports, mm.
    pub span_mm: f64,
    /// Speed of the nozzle, mm/s; the cell's if absent.
    pub speed_mm_s: Option<f64>,
    /// Bead asked for, mm; the cell's if absent.
    pub diameter_mm: Option<f64>,
    /// Flow instead of a bead, mm³/s.
    pub flow_mm3_s: Option<f64>,
    /// Sag at the middle below the nozzle's path, mm.
    pub sag_mm: f64,
    /// Standard deviation of that, mm.
    pub sd_mm: f64,
}

/// A level strand held where it begins.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CantileverFile {
    /// Its length, mm.
    pub length_mm: f64,
    /// Speed of the nozzle, mm/s; the cell's if absent.
    pub speed_mm_s: Option<f64>,
    /// Bead asked for, mm; the cell's if absent.
    pub diameter_mm: Option<f64>,
    /// Flow instead of a bead, mm³/s.
    pub flow_mm3_s: Option<f64>,
    /// Time the nozzle waited at the end, s.
    #[serde(default)]
    pub dwell_s: f64,
    /// How far the end was pulled back along the strand once cold, mm.
    pub end_miss_mm: f64,
    /// Standard deviation of that, mm.
    pub sd_mm: f64,
}

/// A pool of resin lit from one side.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CuredDepthFile {
    /// Dose at its surface, mJ/cm².
    pub dose_mj_cm2: f64,
    /// Depth of what stayed, mm.
    pub depth_mm: f64,
    /// Standard deviation of that, mm.
    pub sd_mm: f64,
}

fn half_a_percent() -> [f64; 3] {
    [0.0, -0.005, 0.005]
}

/// Reads measured prints; refuses missing and impossible values, each with its place.
///
/// # Errors
/// Every problem found, in order of place.
pub fn parse(source: &Source) -> Result<MeasuredFile, Vec<Diagnostic>> {
    parse_checked(source, |file, checks| {
        checks.text(file.get("cell"), "name the cell they were printed in");
        checks.text(file.get("material"), "name the material");
        checks.interval(file.get("slack"), Rule::Between(-0.5, 0.5));
        if let Some(air) = file.get("air") {
            // as in a job
            checks.number(air.get("air_c"), Rule::FromTo(-50.0, 200.0));
            checks.number(air.get("air_m_s"), Rule::FromTo(0.0, 100.0));
        }
        let mut any = false;
        for kind in ["free_hang", "bridge", "cantilever", "cured_depth"] {
            for print in file.get(kind).map(Place::items).unwrap_or_default() {
                any = true;
                one_print(print, checks);
            }
        }
        if !any {
            let says = "no print is in this file";
            checks.refuse(Diagnostic::error(Span::default(), says).hint(
                "add a table [[free_hang]], [[bridge]], [[cantilever]] or [[cured_depth]] for each",
            ));
        }
    })
}

fn one_print(print: Place<'_>, checks: &mut Checks) {
    for number in print.entries() {
        let rule = match number.name() {
            // The high ends only keep out what cannot be meant.
            "span_mm" | "length_mm" => Rule::AboveUpTo(0.0, 10_000.0),
            "speed_mm_s" => Rule::AboveUpTo(0.0, 1000.0),
            "diameter_mm" => Rule::AboveUpTo(0.0, 100.0),
            "sag_mm" | "end_miss_mm" | "depth_mm" => Rule::FromTo(0.0, 10_000.0),
            "dwell_s" => Rule::FromTo(0.0, 3600.0),
            _ => Rule::Positive,
        };
        checks.number(Some(number), rule);
    }
    if let (Some(flow), Some(_)) = (print.get("flow_mm3_s"), print.get("diameter_mm")) {
        checks.refuse(
            Diagnostic::error(flow.span(), "both a flow and a bead are given")
                .hint("keep the one the machine was told; the other follows from the speed"),
        );
    }
}
