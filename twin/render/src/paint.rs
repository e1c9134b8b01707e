//! Colours, all linear inside; sRGB only in the finished pixels.

use crate::layer::thing;
use sim::scene::solid::HitId;
use sim::scene::{BodyKind, ColourScale, MarkSeverity, Scene};

/// Linear red, green, blue.
pub(crate) type Rgb = [f32; 3];

/// Linear colour of an sRGB hex number.
pub(crate) fn hex(rgb: u32) -> Rgb {
    [16, 8, 0].map(|shift| {
        let s = ((rgb >> shift) & 255) as f32 / 255.0;
        if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) }
    })
}

/// sRGB bytes of a linear colour.
pub(crate) fn bytes(rgb: Rgb) -> [u8; 3] {
    rgb.map(|l| {
        let l = l.clamp(0.0, 1.0);
        let s = if l <= 0.003_130_8 { 12.92 * l } else { 1.055 * l.powf(1.0 / 2.4) - 0.055 };
        (255.0 * s + 0.5) as u8
    })
}

pub(crate) fn mix(a: Rgb, b: Rgb, t: f32) -> Rgb {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t)
}

pub(crate) fn scaled(a: Rgb, k: f32) -> Rgb {
    a.map(|x| x * k)
}

/// Writing.
pub(crate) const INK: u32 = 0x1F2933;
/// Writing of less weight.
pub(crate) const FAINT: u32 = 0x5B6672;
/// Values above the scale.
pub(crate) const OVER: u32 = 0xD7263D;
/// Values below the scale.
pub(crate) const UNDER: u32 = 0x9AA5B1;
/// Strands without a value.
const PLAIN: u32 = 0xB9B2A6;
/// Outline of highlighted strands.
pub(crate) const HIGHLIGHT: u32 = 0xE8590C;

/// Colour and name of a kind of body.
pub(crate) fn kind(kind: BodyKind) -> (u32, &'static str) {
    match kind {
        BodyKind::Arm => (0xE98A3A, "arm"),
        BodyKind::Tool => (0x3E4852, "tool"),
        BodyKind::Nozzle => (0xC79A3B, "nozzle"),
        BodyKind::Bed => (0xB8C2CC, "bed"),
        BodyKind::Obstacle => (0x8FA9C4, "obstacle"),
        BodyKind::Form => (0xD8CDB8, "form"),
        BodyKind::OtherArm => (0xA7AFB8, "other arm"),
    }
}

/// Colour of a mark.
pub(crate) fn severity(severity: MarkSeverity) -> u32 {
    match severity {
        MarkSeverity::Note => 0x2563EB,
        MarkSeverity::Warning => 0xB45309,
        MarkSeverity::Error => 0xC81E1E,
    }
}

/// Viridis at 0 to 1, sRGB: polynomial of degree 6 by M. Zucker (CC0), within 0.01 of the table.
fn viridis(t: f64) -> [f64; 3] {
    const C: [[f64; 3]; 7] = [
        [0.277_727_327_2, 0.005_407_344_5, 0.334_099_805_3],
        [0.105_093_043_1, 1.404_613_529_9, 1.384_590_162_6],
        [-0.330_861_828_7, 0.214_847_559_5, 0.095_095_163_0],
        [-4.634_230_499_0, -5.799_100_973_4, -19.332_440_956_3],
        [6.228_269_936_3, 14.179_933_366_8, 56.690_552_600_7],
        [4.776_384_997_7, -13.745_145_377_7, -65.353_032_633_4],
        [-5.435_455_855_9, 4.645_852_612_2, 26.312_435_249_6],
    ];
    std::array::from_fn(|i| C.iter().rev().fold(0.0, |acc, c| acc * t + c[i]).clamp(0.0, 1.0))
}

/// Strands still to come.
pub(crate) const PLANNED: u32 = 0x5B7FA6;

/// Tone mapping: light beyond this part of full is bent towards full and never reaches it.
const SHOULDER: f32 = 0.8;

/// A lit colour as a screen can show it.
///
/// Below the shoulder nothing changes, so that strands keep the colours of the legend; above,
/// `1 − (1−s)·exp(−(x−s)/(1−s))` with the same slope. A film curve over everything would shift the scale's colours.
pub(crate) fn toned(rgb: Rgb) -> Rgb {
    rgb.map(|x| match x > SHOULDER {
        true => 1.0 - (1.0 - SHOULDER) * (-(x - SHOULDER) / (1.0 - SHOULDER)).exp(),
        false => x,
    })
}

/// Linear colour of a place on the scale, 0 to 1.
pub(crate) fn ramp(t: f64) -> Rgb {
    let [r, g, b] = viridis(t.clamp(0.0, 1.0)).map(|s| (s * 255.0).round() as u32);
    hex(r << 16 | g << 8 | b)
}

/// Linear colour of a value: beyond the ends the colours are of another kind.
pub(crate) fn value(scale: &ColourScale, value: f64) -> Rgb {
    let span = scale.high - scale.low;
    let t = (value - scale.low) / span;
    if !value.is_finite() {
        hex(PLAIN)
    } else if value > scale.high {
        hex(OVER)
    } else if value < scale.low {
        hex(UNDER)
    } else if span > 0.0 {
        ramp(t)
    } else {
        ramp(0.5)
    }
}

/// Colours of everything in a scene, looked up by a layer's numbers.
pub(crate) struct Palette {
    bodies: Vec<Rgb>,
    strands: Vec<Rgb>,
}

impl Palette {
    pub(crate) fn new(scene: &Scene) -> Palette {
        let any = scene.strands.iter().any(|s| s.highlighted);
        let strand = |s: &sim::scene::StrandShape| {
            let own = match (&scene.colour, s.value) {
                (Some(scale), Some(v)) => value(scale, v),
                _ => hex(PLAIN),
            };
            // what is not pointed at steps back
            if any && !s.highlighted { mix(own, hex(0xD5D8DC), 0.55) } else { own }
        };
        Palette {
            bodies: scene.bodies.iter().map(|b| hex(kind(b.kind).0)).collect(),
            strands: scene.strands.iter().map(strand).collect(),
        }
    }

    /// Colour of a numbered thing.
    pub(crate) fn of(&self, code: u32) -> Rgb {
        let found = match thing(code) {
            Some(HitId::Body(i)) => self.bodies.get(i),
            Some(HitId::Strand(i)) => self.strands.get(i),
            Some(HitId::Bed) | None => None,
        };
        found.copied().unwrap_or_else(|| hex(kind(BodyKind::Bed).0))
    }
}
