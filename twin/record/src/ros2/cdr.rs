//! CDR as ROS 2 writes it: plain CDR version 1, little-endian, each number aligned to its own size from the end of the
//! four-byte header.

/// A message being written.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cdr {
    bytes: Vec<u8>,
}

/// Encapsulation: plain CDR, little-endian, no options.
const HEADER: [u8; 4] = [0, 1, 0, 0];

impl Cdr {
    /// A message without fields yet.
    pub(super) fn new() -> Self {
        Self { bytes: HEADER.to_vec() }
    }

    /// What was written.
    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    /// `uint8`.
    pub(super) fn u8(&mut self, value: u8) -> &mut Self {
        self.bytes.push(value);
        self
    }

    /// `bool`.
    pub(super) fn bool(&mut self, value: bool) -> &mut Self {
        self.u8(u8::from(value))
    }

    /// `int32`.
    pub(super) fn i32(&mut self, value: i32) -> &mut Self {
        self.aligned(&value.to_le_bytes())
    }

    /// `uint32`.
    pub(super) fn u32(&mut self, value: u32) -> &mut Self {
        self.aligned(&value.to_le_bytes())
    }

    /// `float32`.
    pub(super) fn f32(&mut self, value: f32) -> &mut Self {
        self.aligned(&value.to_le_bytes())
    }

    /// `float64`.
    pub(super) fn f64(&mut self, value: f64) -> &mut Self {
        self.aligned(&value.to_le_bytes())
    }

    /// Several `float64` without a count, as in a vector's fields.
    pub(super) fn f64s(&mut self, values: &[f64]) -> &mut Self {
        values.iter().fold(self, |cdr, value| cdr.f64(*value))
    }

    /// Number of entries that follow.
    pub(super) fn count(&mut self, entries: usize) -> &mut Self {
        self.u32(u32::try_from(entries).unwrap_or(u32::MAX))
    }

    /// `string`: its length with the closing zero, its bytes, the zero. Zeros inside are made visible.
    pub(super) fn text(&mut self, text: &str) -> &mut Self {
        let text = text.replace('\0', "\u{FFFD}");
        self.count(text.len() + 1);
        self.bytes.extend_from_slice(text.as_bytes());
        self.u8(0)
    }

    fn aligned<const N: usize>(&mut self, value: &[u8; N]) -> &mut Self {
        let past = (self.bytes.len() - HEADER.len()) % N;
        if past > 0 {
            self.bytes.resize(self.bytes.len() + N - past, 0);
        }
        self.bytes.extend_from_slice(value);
        self
    }
}
