//! The colours of `render`'s pictures, so that recordings look like them.

use sim::film::{Film, Painted, Quantity};
use sim::scene::{BodyKind, ColourScale, MarkSeverity};

/// Red, green, blue as they stand on a screen (sRGB).
pub(crate) type Rgb = [u8; 3];

/// Values above the scale.
const OVER: Rgb = [0xD7, 0x26, 0x3D];
/// Values below the scale.
const UNDER: Rgb = [0x9A, 0xA5, 0xB1];
/// Strands without a value.
const PLAIN: Rgb = [0xB9, 0xB2, 0xA6];

/// Colour of a kind of body.
pub(crate) fn kind(kind: BodyKind) -> Rgb {
    match kind {
        BodyKind::Arm => [0xE9, 0x8A, 0x3A],
        BodyKind::Tool => [0x3E, 0x48, 0x52],
        BodyKind::Nozzle => [0xC7, 0x9A, 0x3B],
        BodyKind::Bed => [0xB8, 0xC2, 0xCC],
        BodyKind::Obstacle => [0x8F, 0xA9, 0xC4],
        BodyKind::Form => [0xD8, 0xCD, 0xB8],
        BodyKind::OtherArm => [0xA7, 0xAF, 0xB8],
    }
}

/// Colour of a mark.
pub(crate) fn severity(severity: MarkSeverity) -> Rgb {
    match severity {
        MarkSeverity::Note => [0x25, 0x63, 0xEB],
        MarkSeverity::Warning => [0xE0, 0x8A, 0x1E],
        MarkSeverity::Error => [0xE0, 0x2E, 0x2E],
    }
}

/// Viridis at 0 to 1: polynomial of degree 6 by M. Zucker (CC0), within 0.01 of the table.
pub(crate) fn viridis(t: f64) -> Rgb {
    const C: [[f64; 3]; 7] = [
        [0.277_727_327_2, 0.005_407_344_5, 0.334_099_805_3],
        [0.105_093_043_1, 1.404_613_529_9, 1.384_590_162_6],
        [-0.330_861_828_7, 0.214_847_559_5, 0.095_095_163_0],
        [-4.634_230_499_0, -5.799_100_973_4, -19.332_440_956_3],
        [6.228_269_936_3, 14.179_933_366_8, 56.690_552_600_7],
        [4.776_384_997_7, -13.745_145_377_7, -65.353_032_633_4],
        [-5.435_455_855_9, 4.645_852_612_2, 26.312_435_249_6],
    ];
    let t = t.clamp(0.0, 1.0);
    std::array::from_fn(|i| {
        let share = C.iter().rev().fold(0.0, |acc, c| acc * t + c[i]).clamp(0.0, 1.0);
        (255.0 * share).round() as u8
    })
}

/// Colour of a value: beyond the ends the colours are of another kind.
pub(crate) fn value(scale: &ColourScale, value: f64) -> Rgb {
    let span = scale.high - scale.low;
    if !value.is_finite() {
        PLAIN
    } else if value > scale.high {
        OVER
    } else if value < scale.low {
        UNDER
    } else if span > 0.0 {
        viridis((value - scale.low) / span)
    } else {
        viridis(0.5)
    }
}

/// Linear share of light of a screen's byte.
pub(crate) fn linear(byte: u8) -> f64 {
    let s = f64::from(byte) / 255.0;
    if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) }
}

/// The scale of a quantity, where the film has it.
pub(crate) fn scale_of(film: &Film, quantity: Option<Quantity>) -> Option<&Painted> {
    film.painted.iter().find(|painted| Some(painted.quantity) == quantity)
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
        Some(value_colour(painted, value))
    };
    painted.and_then(value_of).unwrap_or(PLAIN)
}

fn value_colour(painted: &Painted, si: f64) -> Rgb {
    value(&painted.scale, painted.quantity.on_screen(si))
}

/// What the colours mean, in a line.
pub(crate) fn words(painted: &Painted) -> String {
    let ColourScale { title, unit, low, high, .. } = &painted.scale;
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
