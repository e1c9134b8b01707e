//! Key figures as tiles: value, limit, and how much of the limit is used.

use sim::film::TraceOf;
use sim::finding::{Bound, Phase};

use super::course::{Course, State, moment};
use super::{Extras, name, verdict};
use crate::parts::Report;
use crate::quantity::{Unit, clock, counted, digits};

/// A figure with its limit.
struct Tile {
    name: &'static str,
    /// Value with unit.
    value: String,
    /// What belongs to it, escaped.
    about: String,
    limit: Option<Held>,
}

/// A value held against a limit, both SI.
struct Held {
    value: f64,
    limit: f64,
    bound: Bound,
    unit: Unit,
}

/// Tiles and the table of scores.
pub(super) fn body(report: &Report, extras: &Extras<'_>, course: &Course) -> String {
    let tiles = [
        cycle(report, course),
        length(report),
        mass(report),
        clearance(report, extras),
        sag(report, extras),
        joint_speed(report, extras),
        displacement(report, extras),
        buckling(report, extras),
        first_yield(report),
    ];
    let tiles: String = tiles.into_iter().flatten().map(|tile| tile.html()).collect();
    format!("<dl class=\"tiles\">{tiles}</dl>\n{}", verdict::scores(report))
}

impl Tile {
    fn html(&self) -> String {
        let Self { name, value, about, limit } = self;
        let about = if about.is_empty() {
            String::new()
        } else {
            format!("<dd class=\"soft\">{about}</dd>")
        };
        let limit = limit.as_ref().map_or_else(String::new, Held::html);
        format!("<div><dt>{name}</dt><dd class=\"value\">{value}</dd>{limit}{about}</div>")
    }
}

impl Held {
    /// Share of the limit that is used: 1 is at the limit.
    fn used(&self) -> f64 {
        let used = match self.bound {
            Bound::Lower if self.value <= 0.0 => f64::INFINITY,
            Bound::Lower => self.limit / self.value,
            Bound::Upper | Bound::Forbidden => self.value / self.limit,
        };
        if used.is_nan() { 0.0 } else { used.max(0.0) }
    }

    fn html(&self) -> String {
        let used = self.used();
        let word = if self.bound == Bound::Lower { "at least" } else { "at most" };
        let past = match self.bound {
            Bound::Lower => self.value < self.limit,
            Bound::Upper | Bound::Forbidden => self.value > self.limit,
        };
        let limit = match self.unit {
            Unit::Second => clock(Some(self.limit)),
            unit => unit.show(Some(self.limit)),
        };
        let (class, told) = match past {
            true => ("gauge past", "■ past".to_owned()),
            false => ("gauge", format!("{} % used", (100.0 * used).round().min(100.0))),
        };
        format!(
            "<dd class=\"held\"><span class=\"{class}\" aria-hidden=\"true\"><i style=\"width:{:.0}%\"></i></span>\
             {word} {limit} · {told}</dd>",
            (100.0 * used).clamp(0.0, 100.0)
        )
    }
}

/// Limit of a kind of trace, else that of a finding of one of these codes.
fn limit(report: &Report, extras: &Extras<'_>, of: Option<TraceOf>, codes: &[&str]) -> Option<f64> {
    let trace =
        extras.traces.iter().find(|trace| Some(trace.of) == of).and_then(|trace| trace.limit);
    let error = crate::parts::Severity::Error;
    let mut found =
        report.findings.iter().filter(|it| it.severity == error && codes.contains(&&*it.code));
    trace.or_else(|| found.find_map(|it| it.limit)).filter(|limit| limit.is_finite())
}

fn held(value: f64, limit: Option<f64>, bound: Bound, unit: Unit) -> Option<Held> {
    limit.map(|limit| Held { value, limit, bound, unit })
}

fn cycle(report: &Report, course: &Course) -> Option<Tile> {
    let total_s = report.totals.time_s?;
    let share = match course.is_whole && total_s > 0.0 {
        true => format!(
            "{:.0} % of it printing",
            100.0 * course.spent_s(State::Doing(Phase::Print)) / total_s
        ),
        false => String::new(),
    };
    let limit = report.findings.iter().find(|it| it.code == "E504").and_then(|it| it.limit);
    let limit = held(total_s, limit, Bound::Upper, Unit::Second);
    Some(Tile { name: "Cycle time", value: clock(Some(total_s)), about: share, limit })
}

fn length(report: &Report) -> Option<Tile> {
    let value = format!("{} m", digits(report.totals.length_m?));
    let about = counted(report.strands.len(), "strand");
    Some(Tile { name: "Printed length", value, about, limit: None })
}

fn mass(report: &Report) -> Option<Tile> {
    let value = format!("{} g", digits(report.totals.mass_kg? * 1e3));
    Some(Tile { name: "Mass", value, about: String::new(), limit: None })
}

fn clearance(report: &Report, extras: &Extras<'_>) -> Option<Tile> {
    let nearest = report.motion.smallest_clearance.as_ref()?;
    let clearance_m = nearest.clearance_m?;
    let [a, b] = &nearest.bodies;
    let codes = ["C201", "C202", "C203", "C204", "C205", "C206"];
    let limit = limit(report, extras, Some(TraceOf::Clearance), &codes);
    Some(Tile {
        name: "Least clearance",
        value: Unit::Millimetre.show(Some(clearance_m)),
        about: format!("{} to {}, {}", name(a), name(b), moment(nearest.time_s)),
        limit: held(clearance_m, limit, Bound::Lower, Unit::Millimetre),
    })
}

/// Greatest of the known, with what it belongs to.
fn greatest<T>(known: impl Iterator<Item = (f64, T)>) -> Option<(f64, T)> {
    known.reduce(|best, next| if next.0 > best.0 { next } else { best })
}

fn sag(report: &Report, extras: &Extras<'_>) -> Option<Tile> {
    let (sag_m, id) = greatest(
        report.strands.iter().filter_map(|strand| Some((strand.sag_nozzle_m.value?, &strand.id))),
    )?;
    let limit = limit(report, extras, Some(TraceOf::Sag), &["P301"]);
    Some(Tile {
        name: "Largest sag",
        value: Unit::Millimetre.show(Some(sag_m)),
        about: format!("behind the nozzle, strand {}", name(id)),
        limit: held(sag_m, limit, Bound::Upper, Unit::Millimetre),
    })
}

fn joint_speed(report: &Report, extras: &Extras<'_>) -> Option<Tile> {
    let (share, motion) = greatest(report.strands.iter().filter_map(|strand| {
        let motion = strand.motion.as_ref()?;
        Some((motion.joint_speed_share?, motion))
    }))?;
    let limit = limit(report, extras, Some(TraceOf::Joint(0)), &["R105"]);
    let joint =
        motion.worst_at.joint_speed.as_deref().map_or(String::new(), |joint| name(joint) + ", ");
    Some(Tile {
        name: "Largest joint speed in print",
        value: Unit::Percent.show(Some(share)),
        about: format!("{joint}of what it can"),
        limit: held(share, limit, Bound::Upper, Unit::Percent),
    })
}

fn displacement(report: &Report, extras: &Extras<'_>) -> Option<Tile> {
    let stages = report.stages.iter();
    let (moved_m, printed) =
        greatest(stages.filter_map(|stage| Some((stage.staged_m?, stage.printed))))?;
    let limit = limit(report, extras, Some(TraceOf::Displacement), &[]);
    Some(Tile {
        name: "Displacement by weight",
        value: Unit::Millimetre.show(Some(moved_m)),
        about: format!("staged, after {}", counted(printed, "strand")),
        limit: held(moved_m, limit, Bound::Upper, Unit::Millimetre),
    })
}

fn buckling(report: &Report, extras: &Extras<'_>) -> Option<Tile> {
    let stages = report.stages.iter();
    let (least, printed) =
        greatest(stages.filter_map(|stage| Some((-stage.buckling_factor?, stage.printed))))?;
    let limit = limit(report, extras, Some(TraceOf::Buckling), &["S404"]);
    Some(Tile {
        name: "Buckling factor",
        value: digits(-least),
        about: format!("on its weight, after {}", counted(printed, "strand")),
        limit: held(-least, limit, Bound::Lower, Unit::Plain),
    })
}

fn first_yield(report: &Report) -> Option<Tile> {
    let loads = report.loads.iter();
    let (least, load) = greatest(loads.filter_map(|load| Some((-load.first_yield?, load))))?;
    let found = report.findings.iter().find(|it| it.code == "S407").and_then(|it| it.limit);
    let force = load.load_n.map_or(String::new(), |load_n| format!(" of {} N", digits(load_n)));
    Some(Tile {
        name: "Load at first yield",
        value: format!("{} times", digits(-least)),
        about: format!("load case {}{force}", name(&load.name)),
        limit: held(-least, found, Bound::Lower, Unit::Plain),
    })
}
