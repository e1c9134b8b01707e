//! Named arrays of numbers in one run of bytes.

use serde_json::{Map, Value, json};

/// Numbers for the viewer: a heading in JSON, then arrays that begin at multiples of eight bytes.
#[derive(Debug, Clone, Default)]
pub(super) struct Blob {
    bytes: Vec<u8>,
    /// Of each array: type, first byte, number of entries.
    arrays: Map<String, Value>,
}

impl Blob {
    pub(super) fn u8s(&mut self, name: &str, values: impl IntoIterator<Item = u8>) {
        self.push(name, "u8", values.into_iter().map(|value| [value]));
    }

    pub(super) fn i8s(&mut self, name: &str, values: impl IntoIterator<Item = i8>) {
        self.push(name, "i8", values.into_iter().map(i8::to_le_bytes));
    }

    pub(super) fn u16s(&mut self, name: &str, values: impl IntoIterator<Item = u16>) {
        self.push(name, "u16", values.into_iter().map(u16::to_le_bytes));
    }

    pub(super) fn i16s(&mut self, name: &str, values: impl IntoIterator<Item = i16>) {
        self.push(name, "i16", values.into_iter().map(i16::to_le_bytes));
    }

    pub(super) fn u32s(&mut self, name: &str, values: impl IntoIterator<Item = u32>) {
        self.push(name, "u32", values.into_iter().map(u32::to_le_bytes));
    }

    pub(super) fn f32s(&mut self, name: &str, values: impl IntoIterator<Item = f64>) {
        self.push(name, "f32", values.into_iter().map(|value| (value as f32).to_le_bytes()));
    }

    pub(super) fn f64s(&mut self, name: &str, values: impl IntoIterator<Item = f64>) {
        self.push(name, "f64", values.into_iter().map(f64::to_le_bytes));
    }

    fn push<const N: usize>(
        &mut self,
        name: &str,
        kind: &str,
        values: impl Iterator<Item = [u8; N]>,
    ) {
        self.bytes.resize(self.bytes.len().next_multiple_of(8), 0);
        let from = self.bytes.len();
        values.for_each(|value| self.bytes.extend_from_slice(&value));
        let many = (self.bytes.len() - from) / N;
        self.arrays.insert(name.to_owned(), json!([kind, from, many]));
    }

    /// Number of bytes so far, the heading not counted.
    pub(super) fn len(&self) -> usize {
        self.bytes.len()
    }

    /// Length of the heading (u32), heading with the places of the arrays, arrays.
    pub(super) fn finish(self, mut head: Map<String, Value>) -> Vec<u8> {
        head.insert("arrays".to_owned(), Value::Object(self.arrays));
        let mut text = Value::Object(head).to_string();
        // the arrays begin at a multiple of eight; JSON does not mind blanks
        while !(text.len() + 4).is_multiple_of(8) {
            text.push(' ');
        }
        let mut all = (text.len() as u32).to_le_bytes().to_vec();
        all.extend_from_slice(text.as_bytes());
        all.extend_from_slice(&self.bytes);
        all
    }
}
