//! The timeline: a lane for every state of the arm, one for findings, one for stages.

use super::Extras;
use super::course::{Course, State, Stretch, moment};
use super::findings::sign;
use crate::parts::Report;
use crate::plots::axis::Axis;
use crate::plots::chart::at;
use crate::quantity::{clock, counted};

/// Length of a lane, units of its view box; what is nearer than one becomes one piece.
const LENGTH: f64 = 1000.0;
/// Places for marks of findings.
const PLACES: usize = 120;
/// Releases told.
const RELEASES: usize = 24;

/// All lanes; empty where no time is known.
pub(super) fn body(report: &Report, extras: &Extras<'_>, course: &Course) -> String {
    if !(course.total_s > 0.0) {
        return String::new();
    }
    let mut lanes: Vec<String> =
        State::ALL.into_iter().filter_map(|state| lane(course, state)).collect();
    lanes.extend(finding_lane(report, extras, course));
    lanes.extend(stage_lane(report, extras, course));
    let note = match course.is_whole {
        true => "",
        false => " Only the times of printing are known here.",
    };
    format!(
        "<p>What the arm does over {}.{note} <span class=\"js-only\">Click a lane to go to a time.</span></p>\
         <div class=\"lanes\" id=\"lanes\">{}{}<div class=\"cursor js-only\" aria-hidden=\"true\"><i></i></div></div>{}",
        clock(Some(course.total_s)),
        lanes.concat(),
        axis(course),
        releases(extras)
    )
}

/// A state: when the arm is in it, and what share of the program that is.
fn lane(course: &Course, state: State) -> Option<String> {
    let spent_s = course.spent_s(state);
    if spent_s <= 0.0 {
        return None;
    }
    let own: Vec<Stretch> =
        course.stretches.iter().filter(|it| it.state == state).copied().collect();
    let share = 100.0 * spent_s / course.total_s;
    let told = format!("{}, {share:.1} % of the program", moment(Some(spent_s)));
    Some(row(
        state.word(),
        &format!("{share:.1} %"),
        &format!(
            "<svg class=\"lane {}\" role=\"img\" aria-label=\"{}: {told}\" viewBox=\"0 0 1000 10\" \
             preserveAspectRatio=\"none\"><path d=\"{}\"/></svg>",
            state.word(),
            state.word(),
            pieces(course, &own)
        ),
    ))
}

/// Filled pieces; neighbours less than a unit apart become one.
fn pieces(course: &Course, stretches: &[Stretch]) -> String {
    let mut merged: Vec<[f64; 2]> = Vec::new();
    for stretch in stretches {
        let [from, to] = [stretch.from_s, stretch.to_s].map(|time_s| LENGTH * course.share(time_s));
        match merged.last_mut().filter(|last| from - last[1] < 1.0) {
            Some(last) => last[1] = last[1].max(to),
            None => merged.push([from, to]),
        }
    }
    let piece = |[from, to]: [f64; 2]| {
        let width = at((to - from).max(0.6));
        format!("M{} 0h{width}v10h-{width}z", at(from))
    };
    merged.into_iter().map(piece).collect()
}

fn row(word: &str, share: &str, lane: &str) -> String {
    format!(
        "<span class=\"lane-name\">{word}</span><div class=\"lane-field\">{lane}</div><span class=\"n lane-share\">{share}</span>"
    )
}

/// A mark where a finding is; neighbours share one, the worst is told.
fn finding_lane(report: &Report, extras: &Extras<'_>, course: &Course) -> Option<String> {
    let mut places: [Option<usize>; PLACES] = [None; PLACES];
    let mut n = 0;
    for (index, finding) in report.findings.iter().enumerate() {
        let of_film =
            extras.film.and_then(|film| film.findings.get(index)).and_then(|it| it.time_s);
        let Some(time_s) = finding.time_s.or(of_film) else { continue };
        let place = &mut places[((course.share(time_s) * PLACES as f64) as usize).min(PLACES - 1)];
        // errors come first in a report
        *place = Some(place.map_or(index, |known| known.min(index)));
        n += 1;
    }
    if n == 0 {
        return None;
    }
    let marks: String = places
        .iter()
        .enumerate()
        .filter_map(|(place, index)| Some((place, (*index)?)))
        .map(|(place, index)| {
            let (class, mark) = sign(report.findings[index].severity);
            let left = 100.0 * (place as f64 + 0.5) / PLACES as f64;
            format!(
                "<i class=\"{class}\" data-finding=\"{index}\" style=\"left:{left:.1}%\">{mark}</i>"
            )
        })
        .collect();
    let words = format!("{} with a time", counted(n, "finding"));
    let lane = format!("<div class=\"marks\" role=\"img\" aria-label=\"{words}\">{marks}</div>");
    Some(row("findings", &n.to_string(), &lane))
}

/// A tick where the frame was solved after a strand, a longer one where a form is taken away.
fn stage_lane(report: &Report, extras: &Extras<'_>, course: &Course) -> Option<String> {
    let done = |printed: usize| -> Option<f64> {
        let order = printed.checked_sub(1)?;
        match extras.film {
            Some(film) => film.strands.get(order)?.done_s(),
            None => report.strands.get(order)?.end_s,
        }
    };
    let mut ticks: Vec<i64> = report
        .stages
        .iter()
        .filter_map(|stage| Some((LENGTH * course.share(done(stage.printed)?)).round() as i64))
        .collect();
    ticks.sort_unstable();
    ticks.dedup();
    if ticks.is_empty() {
        return None;
    }
    let ticks: String = ticks.iter().map(|x| format!("M{x} 3v7")).collect();
    let gone: String = gone(extras)
        .map(|(_, time_s)| format!("M{} 0v10", at(LENGTH * course.share(time_s))))
        .collect();
    let n = report.stages.len();
    let svg = format!(
        "<svg class=\"lane stages\" role=\"img\" aria-label=\"{} of the frame solved\" viewBox=\"0 0 1000 10\" \
         preserveAspectRatio=\"none\"><path d=\"{ticks}\"/><path class=\"gone\" d=\"{gone}\"/></svg>",
        counted(n, "stage")
    );
    Some(row("stages", &n.to_string(), &svg))
}

/// Forms that are taken away, and when.
fn gone<'a>(extras: &Extras<'a>) -> impl Iterator<Item = (&'a str, f64)> {
    let bodies = extras.film.map_or(&[][..], |film| &film.bodies[..]);
    bodies.iter().filter_map(|body| Some((body.name.as_str(), body.gone_s?))).take(RELEASES)
}

fn releases(extras: &Extras<'_>) -> String {
    let told: Vec<String> = gone(extras)
        .map(|(form, time_s)| format!("{} at {}", super::name(form), moment(Some(time_s))))
        .collect();
    if told.is_empty() { String::new() } else { format!("<p>Taken away: {}.</p>", told.join(", ")) }
}

/// Round times below the lanes.
fn axis(course: &Course) -> String {
    let (unit, seconds) = course.unit();
    let axis = Axis::within(0.0, course.total_s / seconds, 6);
    let ticks: String = axis
        .ticks
        .iter()
        .map(|&tick| {
            let left = 100.0 * axis.share(tick);
            format!("<span style=\"left:{left:.2}%\">{}</span>", axis.label(tick))
        })
        .collect();
    format!(
        "<span class=\"lane-name soft\">{unit}</span><div class=\"lane-axis\" aria-hidden=\"true\">{ticks}</div><span></span>"
    )
}
