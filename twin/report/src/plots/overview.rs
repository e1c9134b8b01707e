//! Every strand in printing order: one plot for each quantity.

use super::axis::Axis;
use super::chart::{Chart, Words, at};
use super::quantities::{OVERVIEW, Quantity};
use super::text::{LONGEST_ID, counted, escaped, short};
use crate::parts::{Report, Severity};

/// Most places along the abscissa; more strands share them.
const PLACES: usize = 1000;
/// From here on marks are small.
const MANY: usize = 120;
const HEIGHT: f64 = 200.0;
/// Limits drawn in one plot.
const LIMITS: usize = 2;

/// One place of the abscissa: a strand, or neighbours that share it.
#[derive(Debug, Clone, Copy)]
struct Place {
    order: f64,
    /// Nominal, low, high in the plot's unit; `None` where there is no end.
    value: Option<f64>,
    low: Option<f64>,
    high: Option<f64>,
    mark: Option<Severity>,
}

/// All plots, then what there was nothing to plot of; `marks` is the worst finding of each strand.
pub(super) fn plots(report: &Report, marks: &[Option<Severity>]) -> String {
    let (mut plots, mut told) = (String::new(), String::new());
    for (k, quantity) in OVERVIEW.iter().enumerate() {
        match plot(report, marks, quantity, k) {
            Ok(figure) => plots.push_str(&figure),
            Err(why) => told.push_str(&format!("<li>{}: {why}</li>", quantity.name)),
        }
    }
    if !told.is_empty() {
        told = format!("<p>Not plotted:</p><ul>{told}</ul>");
    }
    format!("<div class=\"plots\">{plots}</div>{told}")
}

/// The plot, or why there is none.
fn plot(
    report: &Report,
    marks: &[Option<Severity>],
    quantity: &Quantity,
    k: usize,
) -> Result<String, &'static str> {
    let each = places(report, marks, quantity);
    let values = each.iter().flat_map(|place| [place.value, place.low, place.high]);
    let heading = quantity.name;
    if each.is_empty() {
        return Err(quantity.absent);
    }
    if values.clone().all(|value| value == Some(0.0)) {
        return Err("zero for every strand.");
    }
    let limits = limits(report, quantity);
    let shown = values.flatten().chain(limits.iter().copied());
    let y = if quantity.from_zero { Axis::from_zero(shown, 4) } else { Axis::round(shown, 4) };
    let log = y.log;
    let names = ["strand, in printing order", quantity.scale.axis_name()];
    let mut chart = Chart::new(Axis::counting(report.strands.len()), y, names, HEIGHT);
    let each: Vec<Place> = shared(each, report.strands.len());
    bars(&mut chart, &each);
    for &limit in &limits {
        chart.level("limit", limit, &format!("limit {}", quantity.scale.with_sign(limit)));
    }
    dots(&mut chart, &each);
    let caption = caption(report, quantity, log);
    let words = Words {
        id: &format!("o{k}"),
        title: &format!("{heading} of each strand, in printing order"),
        desc: &caption,
    };
    Ok(figure(heading, &chart.finish(&words), &caption))
}

/// The strands that have such a thing.
fn places(report: &Report, marks: &[Option<Severity>], quantity: &Quantity) -> Vec<Place> {
    let each = report.strands.iter().enumerate().filter_map(|(k, strand)| {
        let range = (quantity.of)(strand)?;
        let [value, low, high] = quantity.scale.of_range(&range);
        let mark = marks.get(k).copied().flatten();
        Some(Place { order: (k + 1) as f64, value, low, high, mark })
    });
    each.collect()
}

/// Neighbours that share a place: lowest and highest end, greatest value, worst mark.
fn shared(each: Vec<Place>, n: usize) -> Vec<Place> {
    if n <= PLACES {
        return each;
    }
    let place = |order: f64| ((order - 1.0) * PLACES as f64 / n as f64) as usize;
    let mut out: Vec<Place> = Vec::with_capacity(PLACES);
    for next in each {
        match out.last_mut().filter(|last| place(last.order) == place(next.order)) {
            None => out.push(next),
            Some(last) => {
                last.value = both(last.value, next.value, f64::max);
                last.low = both(last.low, next.low, f64::min);
                last.high = both(last.high, next.high, f64::max);
                last.mark = worse(last.mark, next.mark);
            }
        }
    }
    out
}

fn both(a: Option<f64>, b: Option<f64>, pick: fn(f64, f64) -> f64) -> Option<f64> {
    Some(pick(a?, b?))
}

/// The worse of two marks.
pub(super) fn worse(a: Option<Severity>, b: Option<Severity>) -> Option<Severity> {
    match (a, b) {
        (Some(Severity::Error), _) | (_, Some(Severity::Error)) => Some(Severity::Error),
        (None, other) => other,
        (one, _) => one,
    }
}

/// Intervals; an arrow head where one has no end.
fn bars(chart: &mut Chart, each: &[Place]) {
    let (mut bars, mut heads) = (String::new(), String::new());
    for place in each {
        let x = chart.px(place.order);
        let from = place.low.map_or(chart.bottom(), |low| chart.py(low));
        let to = place.high.map_or(chart.top(), |high| chart.py(high));
        bars.push_str(&format!("M{} {}V{}", at(x), at(from), at(to)));
        if place.high.is_none() {
            heads.push_str(&format!("M{} {}l2 -4l2 4", at(x - 2.0), at(chart.top() + 4.0)));
        }
        if place.low.is_none() {
            heads.push_str(&format!("M{} {}l2 4l2 -4", at(x - 2.0), at(chart.bottom() - 4.0)));
        }
    }
    let class = if each.len() > MANY { "bar thin" } else { "bar" };
    chart.path(class, &bars);
    chart.path(&format!("{class} head"), &heads);
}

/// Nominal values: a dot, with a warning a triangle, with an error a square; at the top where it has no end.
fn dots(chart: &mut Chart, each: &[Place]) {
    let [mut plain, mut warned, mut failed] = [String::new(), String::new(), String::new()];
    let many = each.len() > MANY;
    for place in each {
        let x = chart.px(place.order);
        let y = place.value.map_or(chart.top() + 8.0, |value| chart.py(value));
        match place.mark {
            None => plain.push_str(&format!("M{} {}h0", at(x), at(y))),
            Some(Severity::Warning) if many => {
                warned.push_str(&format!("M{} {}l2 3.5h-4z", at(x), at(y - 2.0)));
            }
            Some(Severity::Warning) => {
                warned.push_str(&format!("M{} {}l3.5 6h-7z", at(x), at(y - 4.0)));
            }
            Some(Severity::Error) if many => {
                failed.push_str(&format!("M{} {}h3v3h-3z", at(x - 1.5), at(y - 1.5)));
            }
            Some(Severity::Error) => {
                failed.push_str(&format!("M{} {}h5v5h-5z", at(x - 2.5), at(y - 2.5)));
            }
        }
    }
    chart.path(if many { "dot thin" } else { "dot" }, &plain);
    chart.path(if many { "warned thin" } else { "warned" }, &warned);
    chart.path(if many { "failed thin" } else { "failed" }, &failed);
}

/// What the findings of this quantity were held against, in its unit: the report knows no other.
fn limits(report: &Report, quantity: &Quantity) -> Vec<f64> {
    let own = report.findings.iter().filter(|finding| quantity.codes.contains(&&*finding.code));
    let mut limits: Vec<f64> = own.filter_map(|finding| quantity.scale.of(finding.limit)).collect();
    limits.sort_by(f64::total_cmp);
    limits.dedup_by(|a, b| short(*a) == short(*b));
    limits.truncate(LIMITS);
    limits
}

fn caption(report: &Report, quantity: &Quantity, log: bool) -> String {
    let mut says = vec![quantity.says.to_owned()];
    if log {
        says.push("Logarithmic axis.".to_owned());
    }
    let ranges: Vec<_> = report.strands.iter().map(|strand| (quantity.of)(strand)).collect();
    let known = || ranges.iter().flatten().map(|range| quantity.scale.of_range(range));
    let count = |n: usize, what: &str| match n {
        0 => None,
        n => Some(format!("{} {what}.", counted(n, "strand"))),
    };
    let endless = known().filter(|[value, _, _]| value.is_none()).count();
    says.extend(count(endless, &format!("{}: mark at the top", quantity.endless)));
    let open = known().filter(|[value, _, high]| value.is_some() && high.is_none()).count();
    says.extend(count(open, "with no high end: bar up to the arrow"));
    let below = known().filter(|[_, low, _]| low.is_none()).count();
    says.extend(count(below, "with no low end: bar down to the lower edge"));
    let absent = ranges.iter().filter(|range| range.is_none()).count();
    says.extend(count(absent, "without it: a gap"));
    if report.strands.len() > PLACES {
        says.push("Neighbours share a place: outermost ends, greatest value.".to_owned());
    }
    says.join(" ")
}

/// Least, middle and greatest nominal value of each quantity, with the strands they belong to.
pub(super) fn table(report: &Report) -> String {
    let mut rows = String::new();
    for quantity in &OVERVIEW {
        let mut known: Vec<(f64, &str)> = report
            .strands
            .iter()
            .filter_map(|strand| Some(((quantity.of)(strand)?, strand)))
            .map(|(range, strand)| {
                (quantity.scale.of(range.value).unwrap_or(f64::INFINITY), strand.id.as_str())
            })
            .collect();
        known.sort_by(|a, b| a.0.total_cmp(&b.0));
        let cell = |k: usize| {
            known.get(k).map_or("<td>–</td>".to_owned(), |&(value, id)| {
                let value = if value.is_finite() {
                    quantity.scale.with_sign(value)
                } else {
                    "no end".to_owned()
                };
                format!("<td>{value} <bdi class=\"who\">{}</bdi></td>", escaped(id, LONGEST_ID))
            })
        };
        let last = known.len().saturating_sub(1);
        rows.push_str(&format!(
            "<tr><th scope=\"row\">{}</th>{}{}{}<td>{}</td></tr>",
            quantity.name,
            cell(0),
            cell(last / 2),
            cell(last),
            known.len()
        ));
    }
    format!(
        "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"Values of all strands\"><table><caption>Expected values over all strands, and which strand each belongs to</caption>\
         <thead><tr><th scope=\"col\">Quantity</th><th scope=\"col\">Least</th><th scope=\"col\">Middle</th>\
         <th scope=\"col\">Greatest</th><th scope=\"col\">Strands</th></tr></thead><tbody>{rows}</tbody></table></div>"
    )
}

/// A plot with its heading and caption.
fn figure(heading: &str, svg: &str, caption: &str) -> String {
    format!("<figure><h3>{heading}</h3>{svg}<figcaption>{caption}</figcaption></figure>")
}
