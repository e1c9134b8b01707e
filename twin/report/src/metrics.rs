//! The figures by which one job is compared with another.

use crate::frame::{LoadCase, Stage};
use crate::parts::Report;
use crate::quantity::Unit;
use crate::results::{Range, Strand};

/// One figure of a report.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Metric {
    /// What it is.
    pub(crate) name: String,
    /// Its SI unit; `1`: a ratio or a number.
    pub(crate) si: &'static str,
    /// What it is shown in.
    pub(crate) unit: Unit,
    /// The figure, SI; `None`: not known, not checked or without end.
    pub(crate) value: Option<f64>,
}

fn metric(name: &str, si: &'static str, unit: Unit, value: Option<f64>) -> Metric {
    Metric { name: name.to_owned(), si, unit, value }
}

/// Score of the whole and of each family.
pub(crate) fn scores(report: &Report) -> Vec<Metric> {
    let scores = &report.scores;
    let rows = [
        ("score", report.score),
        ("score R, reach and motion", scores.reach),
        ("score C, clearance", scores.clearance),
        ("score P, process", scores.process),
        ("score S, structure", scores.structure),
        ("score E, program", scores.program),
    ];
    rows.into_iter().map(|(name, score)| metric(name, "1", Unit::Plain, score)).collect()
}

/// Times, length, mass and the worst of what was measured.
pub(crate) fn figures(report: &Report) -> Vec<Metric> {
    let totals = &report.totals;
    let nearest = report.motion.smallest_clearance.as_ref();
    let strand = |of: fn(&Strand) -> Range| {
        report.strands.iter().filter_map(|each| of(each).value).reduce(f64::max)
    };
    let stage =
        |of: fn(&Stage) -> Option<f64>| report.stages.iter().filter_map(of).reduce(f64::max);
    let buckling = report.stages.iter().filter_map(|each| each.buckling_factor).reduce(f64::min);
    let (mm, share) = (Unit::Millimetre, Unit::Percent);
    let mut figures = vec![
        metric("time", "s", Unit::Second, totals.time_s),
        metric("time printing", "s", Unit::Second, totals.print_s),
        metric("time dwelling", "s", Unit::Second, totals.dwell_s),
        metric("time in transit", "s", Unit::Second, totals.transit_s),
        metric("length", "m", Unit::Metre, totals.length_m),
        metric("mass", "kg", Unit::Gram, totals.mass_kg),
        metric("smallest clearance", "m", mm, nearest.and_then(|nearest| nearest.clearance_m)),
        metric("largest sag behind the nozzle", "m", mm, strand(|each| each.sag_nozzle_m)),
        metric("largest sag once set", "m", mm, strand(|each| each.sag_set_m)),
        metric("largest displacement by weight, one-shot", "m", mm, stage(|each| each.one_shot_m)),
        metric("largest displacement by weight, staged", "m", mm, stage(|each| each.staged_m)),
        metric("strength used in members", "1", share, stage(|each| each.member_utilisation)),
        metric("strength used at nodes", "1", share, stage(|each| each.node_utilisation)),
        metric("least buckling factor", "1", Unit::Plain, buckling),
    ];
    for load in report.loads.iter().take(LOADS_MAX) {
        figures.extend(of_load(load));
    }
    figures
}

/// Load cases that are told.
const LOADS_MAX: usize = 50;

fn of_load(load: &LoadCase) -> [Metric; 3] {
    let name = |what: &str| format!("load {}: {what}", crate::line::one_line(&load.name, 80));
    [
        metric(&name("deflection"), "m", Unit::Millimetre, load.deflection_m),
        metric(&name("first yield at"), "1", Unit::Plain, load.first_yield),
        metric(&name("buckling at"), "1", Unit::Plain, load.buckling_factor),
    ]
}
