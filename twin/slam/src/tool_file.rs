//! `tools/<name>.toml`: a nozzle with all that surrounds it.
//!
//! Tool axes: origin at the centre of the nozzle's orifice, z along the strand as it leaves, so
//! every part of the tool has z < 0 or lies around the strand.

use serde::Deserialize;

use crate::cell_file::checks::{Checks, Place, Rule, parse_checked, shapes};
use crate::{Diagnostic, Source};

/// A tool as written.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ToolFile {
    /// Its name.
    pub name: String,
    /// Where the dimensions come from.
    pub source: String,
    /// Diameter of the orifice, mm.
    pub orifice_diameter_mm: f64,
    /// Mass on the flange, kg.
    pub mass_kg: Option<f64>,
    /// Its centre of mass in tool axes, mm.
    pub centre_mm: Option<[f64; 3]>,
    /// The parts, each convex or split into convex ones.
    pub part: Vec<PartFile>,
    /// All that its air nozzles do together, where they are not told one by one.
    pub air_jet: Option<AirJetFile>,
    /// Its air nozzles one by one.
    #[serde(default)]
    pub air_nozzle: Vec<AirNozzleFile>,
    /// Light ring, if any.
    pub light_ring: Option<LightRingFile>,
    /// Lamps besides the ring, in tool axes.
    #[serde(default)]
    pub lamp: Vec<LampFile>,
}

/// A named part of a tool.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PartFile {
    /// Name used in findings.
    pub name: String,
    /// Whether it is the nozzle itself (C201) or another part (C202).
    #[serde(default)]
    pub nozzle: bool,
    /// Its shape.
    pub shape: ShapeFile,
}

/// A shape, in the axes of what it belongs to.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum ShapeFile {
    /// Truncated cone between two points; equal radii make a cylinder.
    Cone {
        /// Centre of one face, mm.
        from_mm: [f64; 3],
        /// Centre of the other, mm.
        to_mm: [f64; 3],
        /// Radius at `from_mm`, mm.
        radius_from_mm: f64,
        /// Radius at `to_mm`, mm.
        radius_to_mm: f64,
    },
    /// All points within a radius of a line.
    Capsule {
        /// One end of the line, mm.
        from_mm: [f64; 3],
        /// The other, mm.
        to_mm: [f64; 3],
        /// Radius, mm.
        radius_mm: f64,
    },
    /// A box.
    Box {
        /// Edge lengths, mm.
        size_mm: [f64; 3],
        /// Centre, mm.
        xyz_mm: [f64; 3],
        /// Rotation, fixed axes, degrees.
        #[serde(default)]
        rpy_deg: [f64; 3],
    },
    /// Convex hull of points.
    Hull {
        /// The points, mm.
        points_mm: Vec<[f64; 3]>,
    },
    /// A ring of capsules about the z axis, touching each other.
    Ring {
        /// Radius of the centre line, mm.
        radius_mm: f64,
        /// Radius of the tube, mm.
        tube_radius_mm: f64,
        /// Height of the ring's plane, mm.
        z_mm: f64,
    },
}

/// Air nozzles that cool the strand.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AirJetFile {
    /// Air speed at the strand, m/s: nominal, low, high.
    pub speed_m_s: [f64; 3],
    /// Length of strand behind the nozzle that the jets reach, mm.
    pub reach_mm: f64,
    /// Where it comes from.
    pub source: String,
}

/// An air nozzle on the tool.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AirNozzleFile {
    /// Middle of its mouth in tool axes, mm.
    pub at_mm: [f64; 3],
    /// The way it blows, in tool axes; any length.
    pub along: [f64; 3],
    /// Diameter of its bore, mm.
    pub bore_mm: f64,
    /// Air speed at its mouth, m/s: nominal, low, high.
    pub exit_m_s: [f64; 3],
    /// Where it comes from.
    pub source: String,
}

/// A lamp.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LampFile {
    /// Its place in the axes of what carries it, mm.
    pub at_mm: [f64; 3],
    /// The way it shines; any length.
    pub along: [f64; 3],
    /// Radiant intensity on its axis, W/sr: nominal, low, high.
    pub intensity_w_sr: [f64; 3],
    /// Full angle at half intensity, degrees.
    pub full_angle_deg: f64,
    /// Where it comes from.
    pub source: String,
}

/// A ring of LEDs that shines on the strand just behind the nozzle.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LightRingFile {
    /// Number of LEDs.
    pub leds: u32,
    /// Distance LED to strand, mm.
    pub distance_mm: f64,
    /// Angle between beam and strand, degrees.
    pub angle_deg: f64,
    /// Radiant intensity on the axis of one LED, W/sr: nominal, low, high.
    pub intensity_w_sr: [f64; 3],
    /// Full angle at half intensity, degrees.
    pub full_angle_deg: f64,
    /// Strand shaded by the shadow ring: no light nearer to the orifice than this, mm.
    pub shadow_mm: f64,
    /// Below the orifice, the point that all LEDs aim at, mm; not given: where the shadow ends.
    pub aim_mm: Option<f64>,
    /// Where it comes from.
    pub source: String,
}

/// Reads a tool; refuses missing and impossible values, each with its place.
///
/// # Errors
/// Every problem found, in order of place.
pub fn parse(source: &Source) -> Result<ToolFile, Vec<Diagnostic>> {
    parse_checked(source, |tool, checks| {
        checks.text(tool.get("name"), "name the tool");
        checks.text(tool.get("source"), "say where the dimensions come from, or \"ours\"");
        checks.number(tool.get("orifice_diameter_mm"), Rule::Positive);
        checks.number(tool.get("mass_kg"), Rule::Positive);
        checks.numbers(tool.get("centre_mm"), Rule::Finite);
        if let (Some(centre), None) = (tool.get("centre_mm"), tool.get("mass_kg")) {
            checks.refuse(
                Diagnostic::error(centre.span(), "a centre of mass, but no mass")
                    .hint("add a line `mass_kg = …`"),
            );
        }
        parts(tool.get("part"), checks);
        if let Some(jet) = tool.get("air_jet") {
            checks.interval(jet.get("speed_m_s"), Rule::NotNegative);
            checks.number(jet.get("reach_mm"), Rule::Positive);
            checks.text(jet.get("source"), "say where it comes from, or \"ours\"");
        }
        for nozzle in tool.get("air_nozzle").map(Place::items).unwrap_or_default() {
            checks.numbers(nozzle.get("at_mm"), Rule::Finite);
            direction(nozzle.get("along"), checks);
            checks.number(nozzle.get("bore_mm"), Rule::Positive);
            checks.interval(nozzle.get("exit_m_s"), Rule::NotNegative);
            checks.text(nozzle.get("source"), "say where it comes from, or \"ours\"");
        }
        if let (Some(jet), Some(_)) = (tool.get("air_jet"), tool.get("air_nozzle")) {
            let says = "air told both as a whole and nozzle by nozzle";
            checks.refuse(
                Diagnostic::error(jet.span(), says).hint("keep `[air_jet]` or `[[air_nozzle]]`"),
            );
        }
        light_ring(tool.get("light_ring"), checks);
        lamps(tool, checks);
    })
}

/// Lamps of a tool or a cell.
pub(crate) fn lamps(carrier: Place<'_>, checks: &mut Checks) {
    for lamp in carrier.get("lamp").map(Place::items).unwrap_or_default() {
        checks.numbers(lamp.get("at_mm"), Rule::Finite);
        direction(lamp.get("along"), checks);
        checks.interval(lamp.get("intensity_w_sr"), Rule::Positive);
        checks.number(lamp.get("full_angle_deg"), Rule::AboveUpTo(0.0, 180.0));
        checks.text(lamp.get("source"), "say where it comes from, or \"ours\"");
    }
}

fn direction(place: Option<Place<'_>>, checks: &mut Checks) {
    checks.numbers(place, Rule::FromTo(-1e6, 1e6));
    let Some(place) = place else { return };
    if place.numbers().is_some_and(|way| way.iter().all(|part| part.abs() < 1e-6)) {
        checks.error(place, "a direction of no length".to_owned());
    }
}

fn parts(parts: Option<Place<'_>>, checks: &mut Checks) {
    let Some(place) = parts else { return };
    let parts = place.items();
    let names: Vec<_> = parts.iter().filter_map(|part| part.get("name")).collect();
    checks.distinct(&names, "parts");
    for part in &parts {
        shapes::shape(part.get("shape"), checks);
    }
    if !parts.iter().any(|part| part.get("nozzle").is_some_and(|nozzle| nozzle.is_true())) {
        checks.refuse(
            Diagnostic::error(place.span(), "no part of the tool is its nozzle")
                .hint("add `nozzle = true` to the part the strand leaves from"),
        );
    }
}

fn light_ring(ring: Option<Place<'_>>, checks: &mut Checks) {
    let Some(ring) = ring else { return };
    checks.number(ring.get("leds"), Rule::Positive);
    checks.number(ring.get("distance_mm"), Rule::Positive);
    checks.number(ring.get("angle_deg"), Rule::AboveUpTo(0.0, 90.0));
    checks.number(ring.get("full_angle_deg"), Rule::AboveUpTo(0.0, 180.0));
    checks.interval(ring.get("intensity_w_sr"), Rule::Positive);
    checks.number(ring.get("shadow_mm"), Rule::NotNegative);
    checks.number(ring.get("aim_mm"), Rule::NotNegative);
    checks.text(ring.get("source"), "say where it comes from, or \"ours\"");
}
