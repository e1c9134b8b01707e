//! Numbers against the time of the program: one plot for each, one for all joints.

use serde_json::{Value, json};
use sim::film::{Trace, TraceOf};

use super::course::{Course, moment};
use super::decimate::{Points, decimated, stepped};
use super::look::{Look, look};
use super::{Extras, name};
use crate::plots::axis::{Axis, ends};
use crate::plots::chart::{Chart, Words};
use crate::plots::text::{LONGEST_ID, cleaned};

const HEIGHT: f64 = 190.0;
/// Joints with a line of their own look; the others are thin and grey.
const NAMED: usize = 3;
/// Joints drawn.
const JOINTS: usize = 16;
/// A limit that is further from the values than this many times their size is told, not drawn.
const FAR: f64 = 4.0;
/// From here on a line is drawn thin.
const DENSE: usize = 300;
/// Plots as HTML, and what the cursor reads.
pub(super) struct Plots {
    pub(super) html: String,
    pub(super) data: Vec<Value>,
}

/// A line in the unit of its plot.
struct Line {
    name: String,
    points: Points,
    class: &'static str,
}

/// All plots of the traces; empty where there are none.
pub(super) fn plots(course: &Course, extras: &Extras<'_>) -> Plots {
    let joints: Vec<&Trace> = extras
        .traces
        .iter()
        .filter(|trace| matches!(trace.of, TraceOf::Joint(_)))
        .take(JOINTS)
        .collect();
    let mut groups: Vec<Vec<&Trace>> = Vec::new();
    for trace in extras.traces {
        match trace.of {
            TraceOf::Joint(_)
                if joints.first().is_some_and(|first| std::ptr::eq(*first, trace)) =>
            {
                groups.push(joints.clone());
            }
            TraceOf::Joint(_) => {}
            _ => groups.push(vec![trace]),
        }
    }
    let mut plots = Plots { html: String::new(), data: Vec::new() };
    for group in groups {
        let lines = lines(&group, course, extras);
        let Some(trace) = group.first().filter(|_| !lines.is_empty()) else { continue };
        let k = plots.data.len();
        plots.html.push_str(&figure(k, trace, &lines, course));
        plots.data.push(data(&look(trace.of), &lines));
    }
    if !plots.html.is_empty() {
        plots.html = format!(
            "<p class=\"js-only soft\">Move over a plot, or focus it and use the arrow keys: the values at that time are told, \
             and all parts of the page follow.</p><div class=\"plots\">{}</div>",
            plots.html
        );
    }
    plots
}

/// Lines of a plot: the worst joints first, so that they have the looks.
fn lines(group: &[&Trace], course: &Course, extras: &Extras<'_>) -> Vec<Line> {
    const CLASSES: [&str; NAMED] = ["one", "two", "three"];
    let mut lines: Vec<Line> = group
        .iter()
        .map(|trace| {
            let name = match trace.of {
                TraceOf::Joint(k) => extras.film.and_then(|film| film.joints.get(k)).map_or_else(
                    || format!("joint {}", k.saturating_add(1)),
                    |joint| cleaned(&joint.name, LONGEST_ID),
                ),
                _ => look(trace.of).title.to_owned(),
            };
            Line { name, points: points(trace, course), class: "rest" }
        })
        .filter(|line| line.points.iter().any(|point| point.1.is_some()))
        .collect();
    lines.sort_by(|a, b| peak(b).total_cmp(&peak(a)));
    lines.iter_mut().zip(CLASSES).for_each(|(line, class)| line.class = class);
    lines
}

fn peak(line: &Line) -> f64 {
    line.points.iter().filter_map(|point| point.1).fold(f64::NEG_INFINITY, f64::max)
}

/// In the unit of the plot, few.
fn points(trace: &Trace, course: &Course) -> Points {
    let look = look(trace.of);
    let told = trace.points.iter().filter(|point| point[0].is_finite());
    let mut all: Points =
        told.map(|&[time_s, value]| (time_s.clamp(0.0, course.total_s), look.of(value))).collect();
    if matches!(trace.of, TraceOf::Speed | TraceOf::Joint(_)) {
        all.extend(
            course.waits().flat_map(|[from_s, to_s]| [(from_s, Some(0.0)), (to_s, Some(0.0))]),
        );
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let few = decimated(&all, course.total_s);
    if trace.steps { stepped(&few, course.total_s) } else { few }
}

fn figure(k: usize, trace: &Trace, lines: &[Line], course: &Course) -> String {
    let look = look(trace.of);
    let (chart, log) = drawn(trace, lines, course);
    let log = if log { " Logarithmic axis." } else { "" };
    let caption = format!("{}{log}", caption(&look, lines));
    let words = Words { id: &format!("p{k}"), title: look.title, desc: &caption };
    let many = if lines.len() > 1 { " many" } else { "" };
    format!(
        "<figure class=\"plot{many}\" data-plot=\"{k}\"><h3>{}</h3><p class=\"reading js-only\" aria-live=\"off\"></p>{}{}\
         <figcaption>{caption}</figcaption></figure>\n",
        look.title,
        chart.finish(&words),
        legend(&look, lines)
    )
}

/// Lines and limit, and whether the axis is logarithmic.
fn drawn(trace: &Trace, lines: &[Line], course: &Course) -> (Chart, bool) {
    let look = look(trace.of);
    let values = || lines.iter().flat_map(|line| line.points.iter().filter_map(|point| point.1));
    let limit = trace.limit.and_then(|limit| look.of(limit));
    let near = limit.filter(|&limit| is_near(&look, limit, values()));
    let shown = values().chain(near);
    let y = match trace.of {
        TraceOf::Temperature => Axis::round(shown, 4),
        _ => Axis::from_zero(shown, 4),
    };
    let log = y.log;
    let (unit, seconds) = course.unit();
    let axis_name = if look.unit.is_empty() { "ratio" } else { look.unit };
    let end = course.total_s / seconds;
    let x = Axis::within(0.0, end, 6);
    let mut chart = Chart::new(x, y, [&format!("time, {unit}"), axis_name], HEIGHT);
    for line in lines.iter().rev() {
        let fine = if line.points.len() > DENSE { " fine" } else { "" };
        let points: Points =
            line.points.iter().map(|&(time_s, value)| (time_s / seconds, value)).collect();
        chart.line(&format!("{}{fine}", line.class), &points);
    }
    match (near, limit) {
        (Some(limit), _) => chart.level("limit", limit, &look.limit(limit)),
        (None, Some(limit)) => {
            let (mark, y) =
                if look.lower { ("↓", chart.bottom() - 4.0) } else { ("↑", chart.top() + 9.0) };
            chart.word(chart.px(end), y, "e limit-word", &format!("{mark} {}", look.limit(limit)));
        }
        (None, None) => {}
    }
    (chart, log)
}

/// Whether a limit stands near enough to the values that they still show when both are drawn.
fn is_near(look: &Look, limit: f64, values: impl Iterator<Item = f64>) -> bool {
    let Some([least, most]) = ends(values) else { return true };
    if look.lower { least <= FAR * limit } else { limit <= FAR * most }
}

/// The worst value and when.
fn caption(look: &Look, lines: &[Line]) -> String {
    let known = lines.iter().flat_map(|line| {
        line.points.iter().filter_map(move |&(time_s, value)| Some((value?, time_s, line)))
    });
    let worst = known.reduce(|best, next| {
        let better = if look.lower { next.0 < best.0 } else { next.0 > best.0 };
        if better { next } else { best }
    });
    let Some((value, time_s, line)) = worst else { return String::new() };
    let word = if look.lower { "Least" } else { "Greatest" };
    let whose = if lines.len() > 1 { format!(" ({})", name(&line.name)) } else { String::new() };
    let note = if look.note.is_empty() { String::new() } else { format!(" {}", look.note) };
    format!("{word} {} at {}{whose}.{note}", look.told(value), moment(Some(time_s)))
}

/// Which line is which joint.
fn legend(look: &Look, lines: &[Line]) -> String {
    if lines.len() < 2 {
        return String::new();
    }
    let key = |class: &str| {
        format!(
            "<svg class=\"key\" viewBox=\"0 0 30 8\" aria-hidden=\"true\"><path class=\"{class}\" d=\"M0 4H30\"/></svg>"
        )
    };
    let mut items: String = lines
        .iter()
        .take(NAMED)
        .map(|line| {
            format!(
                "<li>{} {} up to {}</li>",
                key(line.class),
                name(&line.name),
                look.told(peak(line))
            )
        })
        .collect();
    if let Some(others @ 1..) = lines.len().checked_sub(NAMED) {
        items.push_str(&format!("<li>{} {others} others</li>", key("rest")));
    }
    format!("<ul class=\"legend\">{items}</ul>")
}

/// What the cursor reads: times and values, rounded; null is a gap.
fn data(look: &Look, lines: &[Line]) -> Value {
    let lines: Vec<Value> = lines
        .iter()
        .map(|line| {
            let times: Vec<f64> = line.points.iter().map(|point| rounded(point.0, 6)).collect();
            let values: Vec<Option<f64>> =
                line.points.iter().map(|point| point.1.map(|value| rounded(value, 3))).collect();
            json!({ "name": line.name, "t": times, "v": values })
        })
        .collect();
    json!({ "unit": look.unit, "lines": lines })
}

/// To so many significant digits.
fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.digits$e}").parse().unwrap_or(0.0)
}
