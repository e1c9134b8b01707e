//! The colours of `render`'s pictures, so that recordings look like them.

use sim::film::{Film, Painted};
use sim::scene::{BodyKind, MarkSeverity, colours};

/// Red, green, blue as they stand on a screen (sRGB).
pub(crate) type Rgb = [u8; 3];

/// Colour of a kind of body.
pub(crate) fn kind(kind: BodyKind) -> Rgb {
    colours::bytes(colours::of_kind(kind))
}

/// Colour of a mark: lighter than on a page, for the dark ground of viewers.
pub(crate) fn severity(severity: MarkSeverity) -> Rgb {
    match severity {
        MarkSeverity::Note => [0x25, 0x63, 0xEB],
        MarkSeverity::Warning => [0xE0, 0x8A, 0x1E],
        MarkSeverity::Error => [0xE0, 0x2E, 0x2E],
    }
}

/// Linear share of light of a screen's byte.
pub(crate) fn linear(byte: u8) -> f64 {
    let s = f64::from(byte) / 255.0;
    if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) }
}

/// Colour of a segment of a strand at a time.
pub(crate) fn segment(
    film: &Film,
    painted: Option<&Painted>,
    order: usize,
    segment: usize,
    time_s: f64,
) -> Rgb {
    let value_of = |painted: &Painted| {
        let value = film.strands.get(order)?.value(order, segment, painted.quantity, time_s)?;
        Some(painted.scale.colour(painted.quantity.on_screen(value)))
    };
    colours::bytes(painted.and_then(value_of).unwrap_or(colours::PLAIN))
}

/// What the colours mean, in a line.
pub(crate) fn words(painted: &Painted) -> String {
    let sim::scene::ColourScale { title, unit, low, high, .. } = &painted.scale;
    let told = |value: f64| {
        let digits = if value.abs() >= 100.0 { 0 } else { 2 };
        let text = format!("{value:.digits$}");
        match text.contains('.') {
            true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
            false => text,
        }
    };
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    format!("{title}, {} to {}{unit}", told(*low), told(*high))
}
