//! What is told of every strand, and in which unit.

use super::text::Scale;
use crate::results::{Range, Strand};

/// One number of a strand.
pub(super) struct Quantity {
    /// Short name.
    pub(super) name: &'static str,
    /// One sentence saying what it is.
    pub(super) says: &'static str,
    pub(super) scale: Scale,
    /// `None` where the strand has no such thing.
    pub(super) of: fn(&Strand) -> Option<Range>,
    /// Findings that hold it against a limit of its own unit.
    pub(super) codes: &'static [&'static str],
    /// Where no strand has it.
    pub(super) absent: &'static str,
    /// Of strands where it has no end: `3 strands …`.
    pub(super) endless: &'static str,
    /// Whether its axis shows zero.
    pub(super) from_zero: bool,
}

const SAG: &[&str] = &["P301", "P303"];
const LOST: &str = "not told of any strand.";

/// What is plotted over all strands.
pub(super) const OVERVIEW: [Quantity; 9] = [
    Quantity {
        name: "Sag behind the nozzle",
        says: "Greatest offset from the nozzle's path while the strand sets.",
        scale: Scale::MILLIMETRE,
        of: |strand| Some(strand.sag_nozzle_m),
        codes: SAG,
        absent: LOST,
        endless: "sag without end",
        from_zero: true,
    },
    Quantity {
        name: "Sag by slack",
        says: "How far a strand hangs that is longer than its chord.",
        scale: Scale::MILLIMETRE,
        of: |strand| Some(strand.sag_slack_m),
        codes: SAG,
        absent: LOST,
        endless: "sag without end",
        from_zero: true,
    },
    Quantity {
        name: "Sag once set",
        says: "Deflection of the set strand under its own weight.",
        scale: Scale::MILLIMETRE,
        of: |strand| Some(strand.sag_set_m),
        codes: SAG,
        absent: LOST,
        endless: "sag without end",
        from_zero: true,
    },
    Quantity {
        name: "End miss",
        says: "How far shrinkage pulls the strand's end back after the nozzle has left it.",
        scale: Scale::MILLIMETRE,
        of: |strand| Some(strand.end_miss_m),
        codes: &["P304"],
        absent: LOST,
        endless: "miss without end",
        from_zero: true,
    },
    Quantity {
        name: "Bead diameter",
        says: "Diameter of the strand once it is set.",
        scale: Scale::MILLIMETRE,
        of: |strand| Some(strand.bead_m),
        codes: &[],
        absent: LOST,
        endless: "have no diameter",
        from_zero: false,
    },
    Quantity {
        name: "Draw ratio",
        says: "Speed of the nozzle over that of a strand that nothing draws: below 1 slack, above 1 drawn thin.",
        scale: Scale::PLAIN,
        of: |strand| Some(strand.draw_ratio),
        codes: &[],
        absent: LOST,
        endless: "have no draw ratio",
        from_zero: false,
    },
    Quantity {
        name: "Set distance",
        says: "How far behind the nozzle the strand is set.",
        scale: Scale::MILLIMETRE,
        of: |strand| Some(strand.set_distance_m),
        codes: &["P306"],
        absent: LOST,
        endless: "never set",
        from_zero: true,
    },
    Quantity {
        name: "Cured depth",
        says: "Depth cured from the surface at the least lit place.",
        scale: Scale::MILLIMETRE,
        of: |strand| strand.cured_depth_m,
        codes: &[],
        absent: "no strand is of a photopolymer.",
        endless: "have no cured depth",
        from_zero: true,
    },
    Quantity {
        name: "Bond",
        says: "What the weakest bond to an earlier strand bears.",
        scale: Scale::NEWTON,
        of: |strand| strand.bond.as_ref().map(|bond| bond.strength_n),
        codes: &["P310"],
        absent: "no strand touches an earlier one.",
        endless: "have no such force",
        from_zero: true,
    },
];

/// Further rows of a strand's own table.
pub(super) fn rows(strand: &Strand) -> Vec<(&'static str, String)> {
    let mut rows: Vec<(&str, String)> = OVERVIEW
        .iter()
        .filter_map(|quantity| {
            let range = (quantity.of)(strand)?;
            Some((quantity.name, quantity.scale.show_range(&range)))
        })
        .collect();
    if !strand.sag_linear {
        rows[0].1.push_str("; an order of magnitude");
    }
    if let Some(bond) = &strand.bond {
        let degree = Range { value: bond.value, low: bond.low, high: bond.high };
        let name =
            if bond.by_law { "Bond, healed" } else { "Bond, share of the strength, measured" };
        rows.push((name, Scale::PERCENT.show_range(&degree)));
    }
    rows.push(("Age when set", Scale::SECOND.show_range(&strand.set_time_s)));
    rows.push(("Shortening still to come", Scale::MILLIMETRE.show_range(&strand.shortening_m)));
    if let Some(core_m) = &strand.uncured_core_m {
        rows.push(("Uncured radius", Scale::MILLIMETRE.show_range(core_m)));
    }
    let known = [
        ("Length", Scale::MILLIMETRE, strand.length_m),
        ("Longest span", Scale::MILLIMETRE, strand.span_m),
        ("Speed", Scale::MILLIMETRE_PER_S, strand.speed_m_s),
    ];
    rows.extend(
        known
            .into_iter()
            .filter(|row| row.2.is_some())
            .map(|(name, scale, value)| (name, scale.show(value))),
    );
    rows
}

/// Greatest of a strand's three sags, m; without end: infinite.
pub(super) fn worst_sag_m(strand: &Strand) -> f64 {
    let sags = [strand.sag_nozzle_m, strand.sag_slack_m, strand.sag_set_m];
    sags.iter().map(|sag| sag.value.unwrap_or(f64::INFINITY)).fold(0.0, f64::max)
}
