//! What the colours mean: a bar for the values, squares for the kinds of body.

use crate::canvas::{At, blend, border, line, rect, triangle};
use crate::overlay::round_below;
use crate::paint::{FAINT, HIGHLIGHT, INK, OVER, PLANNED, UNDER, bytes, kind, ramp, severity};
use crate::shade::Seen;
use crate::text::{Anchor, Ink, Pen};
use image::RgbaImage;
use sim::scene::{ColourScale, MarkSeverity, Scene};
use std::collections::BTreeSet;

/// Width of the legend for a picture 800 px high, px.
pub(crate) const WIDTH: f32 = 178.0;
const BAR: f32 = 20.0;
const LINE: f32 = 25.0;

/// Writes the legend of a scene and what is seen of it from `at` downwards, no longer than `room`; returns where it ends.
pub(crate) fn draw(
    image: &mut RgbaImage,
    pen: &Pen,
    (scene, seen): (&Scene, &BTreeSet<Seen>),
    at: At,
    room: f32,
    u: f32,
) -> f32 {
    let key_height = LINE * u * seen.len() as f32;
    let mut y = at[1];
    if let Some(scale) = &scene.colour {
        let length = (room - key_height - 100.0 * u).clamp(90.0 * u, 300.0 * u);
        y = bar(image, pen, scene, scale, at, length, u) + 22.0 * u;
    }
    for (rgb, name) in seen.iter().map(told) {
        rect(image, [at[0], y], [15.0 * u, 15.0 * u], rgb, 1.0);
        border(image, [at[0], y], [15.0 * u, 15.0 * u], FAINT, u);
        let ink = Ink { size: 18.0 * u, rgb: INK, halo: 2.0 * u };
        pen.write(image, [at[0] + 24.0 * u, y + 7.5 * u], Anchor::Left, ink, name);
        y += LINE * u;
    }
    y
}

/// Sentences from `at` downwards, broken to the width of the legend.
pub(crate) fn notes(image: &mut RgbaImage, pen: &Pen, notes: &[String], at: At, u: f32) {
    let ink = Ink { size: 16.0 * u, rgb: INK, halo: 2.0 * u };
    let mut y = at[1];
    for note in notes {
        for text in wrapped(pen, note.split_ascii_whitespace(), ink.size, (WIDTH - 10.0) * u) {
            pen.write(image, [at[0], y], Anchor::Left, ink, &text);
            y += 19.0 * u;
        }
        y += 9.0 * u;
    }
}

/// Colour and word.
fn told(seen: &Seen) -> (u32, &'static str) {
    match seen {
        Seen::Kind(of) => kind(*of),
        Seen::ToCome => (PLANNED, "still to come"),
        Seen::Concerned => (HIGHLIGHT, "concerned"),
    }
}

/// The bar with title, ticks, limit and what lies beyond the ends; returns where it ends.
fn bar(
    image: &mut RgbaImage,
    pen: &Pen,
    scene: &Scene,
    scale: &ColourScale,
    [x, top]: At,
    length: f32,
    u: f32,
) -> f32 {
    let head = Ink { size: 18.0 * u, rgb: INK, halo: 2.0 * u };
    let mut y = top;
    for text in heading(pen, scale, head.size, (WIDTH - 14.0) * u) {
        pen.write(image, [x, y], Anchor::Left, head, &text);
        y += 20.0 * u;
    }
    y += 14.0 * u;
    let width = BAR * u;
    for row in 0..length as i64 {
        let rgb = bytes(ramp(1.0 - f64::from(row as f32 / length)));
        for column in 0..width as i64 {
            blend(image, x as i64 + column, y as i64 + row, rgb, 1.0);
        }
    }
    border(image, [x.floor(), y.floor()], [width.floor(), length.floor()], FAINT, u.max(1.0));
    let values = || scene.strands.iter().filter_map(|s| s.value);
    let (mid, cap) = (x + width / 2.0, 12.0 * u);
    if values().any(|v| v > scale.high) {
        triangle(
            image,
            [[x, y - 2.0 * u], [x + width, y - 2.0 * u], [mid, y - 2.0 * u - cap]],
            OVER,
        );
    }
    let end = y + length;
    let below = values().any(|v| v < scale.low);
    if below {
        triangle(
            image,
            [[x, end + 2.0 * u], [x + width, end + 2.0 * u], [mid, end + 2.0 * u + cap]],
            UNDER,
        );
    }
    let span = scale.high - scale.low;
    let height_of = |v: f64| y + length * (1.0 - ((v - scale.low) / span) as f32);
    let limit = scale.limit.filter(|l| span > 0.0 && *l >= scale.low && *l <= scale.high);
    for (value, text) in ticks(scale.low, scale.high) {
        let at = if span > 0.0 { height_of(value) } else { y + length / 2.0 };
        line(image, [x + width, at], [x + width + 5.0 * u, at], 1.4 * u, FAINT, 1.0);
        if limit.is_none_or(|l| (height_of(l) - at).abs() > 17.0 * u) {
            let ink = Ink { size: 17.0 * u, rgb: INK, halo: 2.0 * u };
            pen.write(image, [x + width + 10.0 * u, at], Anchor::Left, ink, &text);
        }
    }
    if let Some(limit) = limit {
        let at = height_of(limit);
        let rgb = severity(MarkSeverity::Error);
        line(image, [x - 3.0 * u, at], [x + width + 3.0 * u, at], 4.0 * u, 0xFFFFFF, 1.0);
        line(image, [x - 3.0 * u, at], [x + width + 4.0 * u, at], 2.2 * u, rgb, 1.0);
        let ink = Ink { size: 17.0 * u, rgb, halo: 2.0 * u };
        let text = format!("limit {}", plain(limit, span));
        pen.write(image, [x + width + 10.0 * u, at], Anchor::Left, ink, &text);
    }
    end + if below { cap } else { 0.0 }
}

/// Title and unit, broken at a space where they do not fit one line.
fn heading(pen: &Pen, scale: &ColourScale, size: f32, room: f32) -> Vec<String> {
    let unit = if scale.unit.is_empty() { String::new() } else { format!("[{}]", scale.unit) };
    let words = scale.title.split_whitespace().chain([unit.as_str()]).filter(|w| !w.is_empty());
    let mut lines = wrapped(pen, words, size, room);
    lines.truncate(3);
    lines
}

/// Words in lines no longer than `room`; a word that is longer is cut.
fn wrapped<'a>(
    pen: &Pen,
    words: impl Iterator<Item = &'a str>,
    size: f32,
    room: f32,
) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words {
        match lines.last_mut() {
            Some(last) if pen.width(&format!("{last} {word}"), size) <= room => {
                last.push(' ');
                last.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines.iter().map(|l| pen.cut(l, size, room)).collect()
}

/// Round values from low to high, about five, with the digits they need.
pub(crate) fn ticks(low: f64, high: f64) -> Vec<(f64, String)> {
    let span = high - low;
    if !(span > 0.0 && span.is_finite() && low.is_finite()) {
        return if low.is_finite() { vec![(low, plain(low, low.abs()))] } else { Vec::new() };
    }
    let step = round_below(span / 3.5);
    let digits = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
    let first = (low / step - 1e-9).ceil();
    (0..12)
        .map(|k| (first + f64::from(k)) * step)
        .take_while(|v| *v <= high + 1e-9 * span)
        .map(|v| if v.abs() < 1e-9 * span { 0.0 } else { v })
        .map(|v| (v, format!("{v:.digits$}")))
        .collect()
}

/// A value with as many digits as a span asks for.
fn plain(value: f64, span: f64) -> String {
    let digits = if span > 0.0 { (2.0 - span.log10().floor()).clamp(0.0, 9.0) as usize } else { 2 };
    let text = format!("{value:.digits$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}
