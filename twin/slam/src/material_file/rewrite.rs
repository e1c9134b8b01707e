//! A material's text with some of its numbers replaced.

use std::ops::Range;

use toml::de::{DeTable, DeValue};

use crate::Source;

/// New numbers of one table of a material's file.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// The keys that lead to the table.
    pub table: Vec<&'static str>,
    /// Its keys with their new values.
    pub numbers: Vec<(&'static str, f64)>,
    /// Where they come from.
    pub source: String,
}

/// The text with the changes made: numbers to six digits, `status` "measured" and `source` as said; all else,
/// comments and layout included, as it stands. `None` where the text has no such number.
pub fn rewritten(source: &Source, changes: &[Change]) -> Option<String> {
    let document = DeTable::parse(&source.text).ok()?;
    let mut edits: Vec<(Range<usize>, String)> = Vec::new();
    for change in changes {
        let mut table = document.get_ref();
        for key in &change.table {
            table = table.get(*key)?.get_ref().as_table()?;
        }
        let place =
            |key: &str| table.get(key).map(|value: &toml::Spanned<DeValue<'_>>| value.span());
        for (key, number) in &change.numbers {
            edits.push((place(key)?, number_text(*number)));
        }
        edits.push((place("status")?, "\"measured\"".to_owned()));
        edits.push((place("source")?, text_text(&change.source)));
    }
    edits.sort_by_key(|(range, _)| std::cmp::Reverse(range.start));
    let mut text = source.text.clone();
    for (range, new) in edits {
        text.replace_range(range, &new);
    }
    Some(text)
}

/// Six digits are more than any print tells. A float of TOML has a point or an exponent, as `{:?}` writes it.
fn number_text(number: f64) -> String {
    let rounded = format!("{number:.5e}").parse().unwrap_or(number);
    format!("{rounded:?}")
}

/// A string of TOML on one line; control characters, which it may not hold, become spaces.
fn text_text(text: &str) -> String {
    let plain = |c: char| if c.is_control() { ' ' } else { c };
    let escaped: String = text.chars().map(plain).collect();
    format!("\"{}\"", escaped.replace('\\', "\\\\").replace('"', "\\\""))
}
