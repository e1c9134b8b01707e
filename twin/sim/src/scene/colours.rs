//! Colours that mean the same in every picture, page and recording, as sRGB hex numbers.

use super::{BodyKind, ColourScale, MarkSeverity};

/// Values above a scale.
pub const OVER: u32 = 0xD7263D;
/// Values below a scale.
pub const UNDER: u32 = 0x9AA5B1;
/// Strands without a value.
pub const PLAIN: u32 = 0xB9B2A6;

/// Colour of a kind of body.
pub fn of_kind(kind: BodyKind) -> u32 {
    match kind {
        BodyKind::Arm => 0xE98A3A,
        BodyKind::Tool => 0x3E4852,
        BodyKind::Nozzle => 0xC79A3B,
        BodyKind::Bed => 0xB8C2CC,
        BodyKind::Obstacle => 0x8FA9C4,
        BodyKind::Form => 0xD8CDB8,
        BodyKind::OtherArm => 0xA7AFB8,
    }
}

/// Colour of a mark on a light ground.
pub fn of_severity(severity: MarkSeverity) -> u32 {
    match severity {
        MarkSeverity::Note => 0x2563EB,
        MarkSeverity::Warning => 0xB45309,
        MarkSeverity::Error => 0xC81E1E,
    }
}

/// Viridis at 0 to 1: polynomial of degree 6 by M. Zucker (CC0), within 0.01 of the table.
pub fn viridis(share: f64) -> u32 {
    const C: [[f64; 3]; 7] = [
        [0.277_727_327_2, 0.005_407_344_5, 0.334_099_805_3],
        [0.105_093_043_1, 1.404_613_529_9, 1.384_590_162_6],
        [-0.330_861_828_7, 0.214_847_559_5, 0.095_095_163_0],
        [-4.634_230_499_0, -5.799_100_973_4, -19.332_440_956_3],
        [6.228_269_936_3, 14.179_933_366_8, 56.690_552_600_7],
        [4.776_384_997_7, -13.745_145_377_7, -65.353_032_633_4],
        [-5.435_455_855_9, 4.645_852_612_2, 26.312_435_249_6],
    ];
    let t = share.clamp(0.0, 1.0);
    let byte = |i: usize| {
        let share = C.iter().rev().fold(0.0, |acc, c| acc * t + c[i]).clamp(0.0, 1.0);
        (255.0 * share).round() as u32
    };
    byte(0) << 16 | byte(1) << 8 | byte(2)
}

impl ColourScale {
    /// Colour of a value: beyond the ends the colours are of another kind.
    pub fn colour(&self, value: f64) -> u32 {
        let span = self.high - self.low;
        match value {
            value if !value.is_finite() => PLAIN,
            value if value > self.high => OVER,
            value if value < self.low => UNDER,
            value if span > 0.0 => viridis((value - self.low) / span),
            _ => viridis(0.5),
        }
    }
}

/// Red, green and blue of a colour.
pub fn bytes(colour: u32) -> [u8; 3] {
    let [_, r, g, b] = colour.to_be_bytes();
    [r, g, b]
}
