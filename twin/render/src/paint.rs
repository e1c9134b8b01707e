//! Colours, all linear inside; sRGB only in the finished pixels.

use crate::layer::thing;
pub(crate) use sim::scene::colours::{OVER, UNDER, of_severity as severity};
use sim::scene::colours::{PLAIN, of_kind, viridis};
use sim::scene::solid::HitId;
use sim::scene::{BodyKind, Scene};

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
/// Outline of highlighted strands.
pub(crate) const HIGHLIGHT: u32 = 0xE8590C;

/// Colour and name of a kind of body.
pub(crate) fn kind(kind: BodyKind) -> (u32, &'static str) {
    let name = match kind {
        BodyKind::Arm => "arm",
        BodyKind::Tool => "tool",
        BodyKind::Nozzle => "nozzle",
        BodyKind::Bed => "bed",
        BodyKind::Obstacle => "obstacle",
        BodyKind::Form => "form",
        BodyKind::OtherArm => "other arm",
    };
    (of_kind(kind), name)
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
    hex(viridis(t))
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
                (Some(scale), Some(v)) => hex(scale.colour(v)),
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
