//! The report for a terminal.

use crate::formats::shared::worst_first;
use crate::frame::{LoadCase, YieldCriterion};
use crate::line::{allowed_words, one_line};
use crate::parts::{Finding, Report, Severity, Verdict};
use crate::quantity::{Unit, clock, counted, digits, found};
use crate::results::{Range, Strand};
use crate::screen::{Paint, Screen};

/// Errors told, and warnings told, the worst of each code first; the rest is in report.json.
const FINDINGS_MAX: usize = 20;

/// The report as text: verdict, findings, worst values, totals. At most `width` columns where words allow.
///
/// ```text
/// INFEASIBLE  score 12 of 100  (R 80, C 12, P 55, S 50, E –)  tower
/// ```
pub fn human(report: &Report, color: bool, width: usize) -> String {
    let mut screen = Screen::new(color, width);
    verdict(report, &mut screen);
    findings(report, Severity::Error, &mut screen);
    findings(report, Severity::Warning, &mut screen);
    strands(report, &mut screen);
    frame(report, &mut screen);
    totals(report, &mut screen);
    screen.finish()
}

fn verdict(report: &Report, screen: &mut Screen) {
    let paint = match report.verdict {
        Verdict::Feasible => Paint::Green,
        Verdict::Infeasible => Paint::Red,
    };
    let score =
        |score: Option<f64>| score.map_or_else(|| "–".to_owned(), |score| format!("{score:.0}"));
    let scores = &report.scores;
    let families = [
        ("R", scores.reach),
        ("C", scores.clearance),
        ("P", scores.process),
        ("S", scores.structure),
        ("E", scores.program),
    ];
    let families: Vec<String> =
        families.iter().map(|(letter, of)| format!("{letter} {}", score(*of))).collect();
    let word = screen.paint(paint, &report.verdict.word().to_uppercase());
    screen.line(&format!(
        "{word}  score {} of 100  ({})  {}",
        score(report.score),
        families.join(", "),
        one_line(&report.name, 200)
    ));
}

fn findings(report: &Report, severity: Severity, screen: &mut Screen) {
    let order = worst_first(report).into_iter().map(|at| &report.findings[at]);
    let (mut all, mut more): (Vec<&Finding>, Vec<&Finding>) = (Vec::new(), Vec::new());
    for finding in order.filter(|finding| finding.severity == severity) {
        // the worst of each code says more than twenty of one
        let is_known = all.iter().any(|known| known.code == finding.code);
        if is_known { more.push(finding) } else { all.push(finding) }
    }
    all.append(&mut more);
    let word = severity.word();
    for finding in all.iter().take(FINDINGS_MAX) {
        screen.line("");
        one(report, finding, word, screen);
    }
    if let Some(more @ 1..) = all.len().checked_sub(FINDINGS_MAX) {
        screen.line("");
        let more = counted(more, &format!("more {word}"));
        screen.line(&format!("… and {more} in report.html and report.json"));
    }
}

fn one(report: &Report, finding: &Finding, word: &str, screen: &mut Screen) {
    let paint = if finding.severity == Severity::Error { Paint::Red } else { Paint::Yellow };
    let head = screen.paint(paint, &format!("{word} {}", one_line(&finding.code, 16)));
    let title = screen.paint(Paint::Bold, &one_line(&finding.title, 200));
    screen.line(&format!("{head} {title}"));
    screen.labelled("", &finding.message);
    let place = place(report, finding);
    if !place.is_empty() {
        screen.labelled("where", &place);
    }
    if let Some(found) = found(finding) {
        screen.labelled("found", &found);
    }
    screen.labelled("hint", &finding.hint);
    if let Some(allowed) = &finding.allowed {
        screen.labelled("", &allowed_words(allowed));
    }
}

/// Strand, place on it, phase, line of the job, time.
pub(crate) fn place(report: &Report, finding: &Finding) -> String {
    let site = &finding.site;
    let mut parts = Vec::new();
    parts.extend(site.strand.as_ref().map(|strand| format!("strand {strand}")));
    parts.extend(site.at_m.map(|at_m| format!("at {}", Unit::Millimetre.show(Some(at_m)))));
    parts.extend(site.stage.map(|stage| format!("after {}", counted(stage, "strand"))));
    parts.extend(site.node.map(|node| format!("node {node}")));
    parts.extend(site.member.map(|member| format!("member {member}")));
    parts.extend(site.phase.map(|phase| phase.word().to_owned()));
    parts.extend(finding.time_s.map(|time_s| clock(Some(time_s))));
    let job = report.provenance.inputs.iter().find(|input| input.what == "job");
    parts.extend(finding.line.map(|line| match job {
        Some(job) => format!("{}:{line}", job.name),
        None => format!("line {line}"),
    }));
    parts.join(", ")
}

/// The worst strand of each kind.
fn strands(report: &Report, screen: &mut Screen) {
    if report.strands.is_empty() {
        return;
    }
    screen.line("");
    let heading =
        screen.paint(Paint::Bold, &format!("worst of {}", counted(report.strands.len(), "strand")));
    screen.line(&heading);
    let core = |strand: &Strand| strand.uncured_core_m;
    type Column<'a> = (&'a str, &'a dyn Fn(&Strand) -> Option<Range>);
    let rows: [Column<'_>; 7] = [
        ("bead", &|strand| Some(strand.bead_m)),
        ("sag behind nozzle", &|strand| Some(strand.sag_nozzle_m)),
        ("sag by slack", &|strand| Some(strand.sag_slack_m)),
        ("sag once set", &|strand| Some(strand.sag_set_m)),
        ("set behind nozzle", &|strand| Some(strand.set_distance_m)),
        ("end pulled back", &|strand| Some(strand.end_miss_m)),
        ("uncured core", &core),
    ];
    for (name, of) in rows {
        let worst = report
            .strands
            .iter()
            .filter_map(|strand| Some((strand, of(strand)?)))
            .reduce(|worst, next| if size(&next.1) > size(&worst.1) { next } else { worst });
        if let Some((strand, range)) = worst.filter(|(_, range)| size(range) > 0.0) {
            let value = Unit::Millimetre.show_range(&range);
            let order = if name == "sag behind nozzle" && !strand.sag_linear {
                " (order of magnitude)"
            } else {
                ""
            };
            screen.line(&format!("  {name:<18} {value:<28} {}{order}", one_line(&strand.id, 80)));
        }
    }
}

/// Nominal value to rank by; then the high end, for values that nominally are zero.
fn size(range: &Range) -> f64 {
    let nominal = range.value.unwrap_or(f64::INFINITY);
    if nominal > 0.0 { nominal } else { 1e-9 * range.high.unwrap_or(f64::INFINITY) }
}

fn frame(report: &Report, screen: &mut Screen) {
    screen.line("");
    let worst = |of: fn(&crate::frame::Stage) -> Option<f64>| {
        let known = report.stages.iter().filter_map(|stage| Some((stage.printed, of(stage)?)));
        known.reduce(|worst, next| if next.1 > worst.1 { next } else { worst })
    };
    if let Some((printed, one_shot_m)) = worst(|stage| stage.one_shot_m) {
        let staged = worst(|stage| stage.staged_m).map_or_else(String::new, |(_, m)| {
            format!(", staged {}", Unit::Millimetre.show(Some(m)))
        });
        let value = Unit::Millimetre.show(Some(one_shot_m));
        let after = counted(printed, "strand");
        screen
            .line(&format!("frame      moves {value} by its weight, worst after {after}{staged}"));
    }
    used(report, screen);
    for load in &report.loads {
        let yields = first_yield(load);
        let buckles = load
            .buckling_factor
            .map_or_else(String::new, |factor| format!(", buckles at {}", digits(factor)));
        let value = match &load.fault {
            Some(fault) => format!("not solved: {fault}"),
            None => format!("bends {}{yields}{buckles}", Unit::Millimetre.show(load.deflection_m)),
        };
        screen.line(&format!("load       {}: {value}", one_line(&load.name, 80)));
    }
    if let Some(nearest) = &report.motion.smallest_clearance {
        let [a, b] = nearest.bodies.each_ref().map(|body| one_line(body, 80));
        let value = Unit::Millimetre.show(nearest.clearance_m);
        let at = clock(nearest.time_s);
        let open = Unit::Millimetre.show(nearest.resolution_m);
        let accuracy = Unit::Millimetre.show(nearest.accuracy_m);
        screen.line(&format!(
            "clearance  {value} at the least, {a} to {b} at {at}; covered to {open}, arm ± {accuracy}"
        ));
    } else {
        screen.line("clearance  nothing comes within twice the limit of anything");
    }
}

/// The most used member and node of all stages, and the least buckling factor.
fn used(report: &Report, screen: &mut Screen) {
    let most = |of: fn(&crate::frame::Stage) -> Option<f64>| {
        report.stages.iter().filter_map(of).reduce(f64::max)
    };
    let percent = |share: Option<f64>| share.map(|share| format!("{} %", digits(share * 100.0)));
    let (members, nodes) = (
        percent(most(|stage| stage.member_utilisation)),
        percent(most(|stage| stage.node_utilisation)),
    );
    let least = report.stages.iter().filter_map(|stage| stage.buckling_factor).reduce(f64::min);
    let told: Vec<String> = [
        members.map(|share| format!("members to {share}")),
        nodes.map(|share| format!("nodes to {share}")),
        least.map(|factor| format!("buckling at {} times its load", digits(factor))),
    ]
    .into_iter()
    .flatten()
    .collect();
    if !told.is_empty() {
        screen.line(&format!("strength   used while printing: {}", told.join(", ")));
    }
}

/// First yield as computed, by what, and what that is worth.
fn first_yield(load: &LoadCase) -> String {
    let judged = load.yields.iter().filter(|it| it.criterion != YieldCriterion::Axial);
    let first = judged.filter_map(|it| Some((it.factor?, it))).min_by(|a, b| a.0.total_cmp(&b.0));
    let Some((factor, first)) = first else { return String::new() };
    let strand = one_line(first.strand.as_deref().unwrap_or("?"), 80);
    let what = match first.criterion {
        YieldCriterion::Node => format!("a node of `{strand}`"),
        _ => format!("`{strand}`"),
    };
    let range = match (first.expected.value, first.expected.low, first.expected.high) {
        (Some(value), Some(low), Some(high)) => {
            format!(" (worth {}, {} to {})", digits(value), digits(low), digits(high))
        }
        _ => String::new(),
    };
    format!(", {what} yields at {} times{range}", digits(factor))
}

fn totals(report: &Report, screen: &mut Screen) {
    let totals = &report.totals;
    let many = |value: Option<f64>, scale: f64| {
        value.map_or_else(|| "?".to_owned(), |value| digits(value * scale))
    };
    screen.line(&format!(
        "totals     {} m, {} g",
        many(totals.length_m, 1.0),
        many(totals.mass_kg, 1e3)
    ));
    screen.line(&format!(
        "time       {}: print {}, dwell {}, transit {}",
        clock(totals.time_s),
        clock(totals.print_s),
        clock(totals.dwell_s),
        clock(totals.transit_s)
    ));
    screen.line(&format!(
        "           {} in report.json",
        counted(report.assumptions.len(), "assumption")
    ));
}
