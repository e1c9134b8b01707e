//! A section against its age: temperature, degree of cure, modulus.

use super::axis::Axis;
use super::chart::{Chart, Words};
use super::text::{Scale, short};
use crate::results::{Range, Strand};

const HEIGHT: f64 = 160.0;
/// Absolute zero, °C.
const ZERO_C: f64 = -273.15;
/// Temperatures that move less than this are told, not plotted, K.
const STILL_K: f64 = 0.5;

type Points = Vec<(f64, Option<f64>)>;

/// Panels of a strand, each with its caption; `id` is that of its card.
pub(super) fn panels(strand: &Strand, id: &str) -> String {
    [temperature(strand, id), cure(strand, id), modulus(strand, id)].concat()
}

fn temperature(strand: &Strand, id: &str) -> String {
    let ageing = &strand.ageing;
    let mean = points(strand, &ageing.temperature_k, celsius);
    let core = points(strand, &ageing.core_k, celsius);
    let all = || mean.iter().chain(&core).filter_map(|point| point.1);
    let Some([low, high]) = super::axis::ends(all()) else { return String::new() };
    if high - low < STILL_K {
        return format!("<p>The section stays at {} °C.</p>", short(0.5 * (low + high)));
    }
    let y = Axis::round(all(), 4);
    let mut chart =
        Chart::new(ages(strand), y, ["age behind the nozzle, s", "temperature, °C"], HEIGHT);
    set_time(&mut chart, &strand.set_time_s);
    chart.line("one", &mean);
    chart.line("two", &core);
    let title = "Temperature of the section against its age";
    let lines =
        if core.is_empty() { "" } else { " Full line: mean of the section; dashed: on its axis." };
    let desc = format!(
        "From {} to {} °C.{lines}{}{}",
        short(high),
        short(low),
        shaded(strand),
        gaps(&mean)
    );
    done(chart, &format!("{id}-temperature"), title, &desc)
}

fn cure(strand: &Strand, id: &str) -> String {
    let cure = points(strand, &strand.ageing.cure, |share| Scale::PERCENT.of(Some(share)));
    let Some([low, high]) = super::axis::ends(cure.iter().filter_map(|point| point.1)) else {
        return String::new();
    };
    let y = Axis::from_zero([low, high.max(1.0)], 4);
    let mut chart =
        Chart::new(ages(strand), y, ["age behind the nozzle, s", "degree of cure, %"], HEIGHT);
    set_time(&mut chart, &strand.set_time_s);
    chart.line("one", &cure);
    let desc = format!(
        "From {} to {} % at the surface.{}{}",
        short(low),
        short(high),
        shaded(strand),
        gaps(&cure)
    );
    done(chart, &format!("{id}-cure"), "Degree of cure at the surface against age", &desc)
}

fn modulus(strand: &Strand, id: &str) -> String {
    let positive = |pa| Scale::MEGAPASCAL.of(Some(pa)).filter(|&mpa| mpa > 0.0);
    let modulus = points(strand, &strand.ageing.modulus_pa, positive);
    let known = || modulus.iter().filter_map(|point| point.1);
    let Some([low, high]) = super::axis::ends(known()) else { return String::new() };
    if short(low) == short(high) {
        return format!("<p>Young's modulus stays at {} MPa over these ages.</p>", short(low));
    }
    let y = Axis::round(known(), 4);
    let log = if y.log { " Logarithmic axis." } else { "" };
    let mut chart =
        Chart::new(ages(strand), y, ["age behind the nozzle, s", "Young's modulus, MPa"], HEIGHT);
    set_time(&mut chart, &strand.set_time_s);
    chart.line("one", &modulus);
    let desc = format!(
        "From {} to {} MPa.{log}{}{}",
        short(low),
        short(high),
        shaded(strand),
        gaps(&modulus)
    );
    done(chart, &format!("{id}-modulus"), "Young's modulus against age", &desc)
}

/// Ages with their values; none where the report has none. A number that `pick` refuses is a gap.
fn points(strand: &Strand, values: &[Option<f64>], pick: impl Fn(f64) -> Option<f64>) -> Points {
    let ages = strand.ageing.age_s.iter().map(|&age| Scale::SECOND.of(Some(age)));
    let both = ages.zip(values).filter_map(|(age, &value)| Some((age?, value)));
    both.map(|(age, value)| (age, value.filter(|value| value.is_finite()).and_then(&pick)))
        .collect()
}

fn celsius(kelvin: f64) -> Option<f64> {
    Scale::PLAIN.of(Some(kelvin + ZERO_C))
}

fn ages(strand: &Strand) -> Axis {
    let ages = strand.ageing.age_s.iter().filter_map(|&age| Scale::SECOND.of(Some(age)));
    let [low, high] = super::axis::ends(ages).unwrap_or([0.0, 1.0]);
    Axis::within(low, high, 6)
}

fn set_time(chart: &mut Chart, range: &Range) {
    let [value, low, high] = Scale::SECOND.of_range(range);
    if value.is_some() {
        chart.band(low, value, high);
    }
}

fn shaded(strand: &Strand) -> String {
    match Scale::SECOND.of(strand.set_time_s.value) {
        Some(_) => format!(
            " Upright line and shade: set at {}.",
            Scale::SECOND.show_range(&strand.set_time_s)
        ),
        None => " Never sets.".to_owned(),
    }
}

fn gaps(points: &Points) -> &'static str {
    if points.iter().any(|point| point.1.is_none()) {
        " The line breaks where there is no number, or zero on a logarithmic axis."
    } else {
        ""
    }
}

fn done(chart: Chart, id: &str, title: &str, desc: &str) -> String {
    let svg = chart.finish(&Words { id, title, desc });
    format!("<figure>{svg}<figcaption>{title}. {desc}</figcaption></figure>")
}
