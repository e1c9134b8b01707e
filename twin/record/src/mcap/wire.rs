//! Protobuf on the wire, as much of it as the messages here need.
//!
//! Every number given is written, zeros too: readers take both, and one rule is easier to hold.

/// A message being written.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Proto {
    bytes: Vec<u8>,
}

/// Kinds of value on the wire.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wire {
    /// Seven bits a byte.
    Varint = 0,
    /// Eight bytes.
    Fixed64 = 1,
    /// A length and as many bytes.
    Sized = 2,
    /// Four bytes.
    Fixed32 = 5,
}

impl Proto {
    /// What was written.
    pub(crate) fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    /// A `double`.
    pub(crate) fn double(mut self, number: u32, value: f64) -> Self {
        self.tag(number, Wire::Fixed64);
        self.bytes.extend_from_slice(&value.to_le_bytes());
        self
    }

    /// An `optional double`: nothing where it is not known or not finite.
    pub(crate) fn known(self, number: u32, value: Option<f64>) -> Self {
        match value.filter(|value| value.is_finite()) {
            Some(value) => self.double(number, value),
            None => self,
        }
    }

    /// A `bool`, `uint32`, `enum`, or an `int32` or `int64` that is not negative.
    pub(crate) fn uint(mut self, number: u32, value: u64) -> Self {
        self.tag(number, Wire::Varint);
        self.varint(value);
        self
    }

    /// A `fixed32`.
    pub(crate) fn fixed32(mut self, number: u32, value: u32) -> Self {
        self.tag(number, Wire::Fixed32);
        self.bytes.extend_from_slice(&value.to_le_bytes());
        self
    }

    /// A packed `repeated fixed32`.
    pub(crate) fn fixed32s(mut self, number: u32, values: &[u32]) -> Self {
        self.tag(number, Wire::Sized);
        self.varint(4 * values.len() as u64);
        values.iter().for_each(|value| self.bytes.extend_from_slice(&value.to_le_bytes()));
        self
    }

    /// A `string`.
    pub(crate) fn text(self, number: u32, value: &str) -> Self {
        self.bytes(number, value.as_bytes())
    }

    /// `bytes`.
    pub(crate) fn bytes(mut self, number: u32, value: &[u8]) -> Self {
        self.tag(number, Wire::Sized);
        self.varint(value.len() as u64);
        self.bytes.extend_from_slice(value);
        self
    }

    /// A message in this message.
    pub(crate) fn message(self, number: u32, value: Proto) -> Self {
        self.bytes(number, &value.bytes)
    }

    /// Messages of a repeated field.
    pub(crate) fn messages(self, number: u32, values: impl IntoIterator<Item = Proto>) -> Self {
        values.into_iter().fold(self, |proto, value| proto.message(number, value))
    }

    fn tag(&mut self, number: u32, wire: Wire) {
        self.varint(u64::from(number) << 3 | wire as u64);
    }

    fn varint(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.bytes.push(value as u8 | 0x80);
            value >>= 7;
        }
        self.bytes.push(value as u8);
    }
}
