//! The table of keys of `job.slam`, and the JSON Schema made from it.
//!
//! Each key stands once, in [`keys`], with type, unit, range, default and one sentence. The
//! decoder checks a text against this table and [`job_schema`] prints the same table, so the two
//! cannot differ.

pub mod keys;
#[cfg(test)]
mod tests;

use std::fmt;

use serde_json::{Map, Value, json};

/// Numbers a key may take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Least value.
    pub low: f64,
    /// Largest value, always allowed itself.
    pub high: f64,
    /// Whether `low` itself is refused.
    pub above: bool,
}

impl Range {
    /// `low ≤ x ≤ high`.
    pub const fn within(low: f64, high: f64) -> Self {
        Self { low, high, above: false }
    }

    /// `0 < x ≤ high`.
    pub const fn positive(high: f64) -> Self {
        Self { low: 0.0, high, above: true }
    }

    /// Whether a number is allowed; NaN is not.
    pub fn holds(&self, value: f64) -> bool {
        value <= self.high && if self.above { value > self.low } else { value >= self.low }
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.above {
            true => write!(f, "above {} and at most {}", self.low, self.high),
            false => write!(f, "from {} to {}", self.low, self.high),
        }
    }
}

/// What a key holds.
#[derive(Debug, Clone, Copy)]
pub enum Kind {
    /// A number.
    Number(Range),
    /// A whole number.
    Integer(Range),
    /// A text that is not empty.
    Text,
    /// A day of the calendar, `YYYY-MM-DD`.
    Date,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// Some of these letters, in this order, each at most once.
    Letters(&'static str),
    /// Three numbers.
    Triple(Range),
    /// A list of at least so many items.
    List(&'static Kind, usize),
    /// An object.
    Object(&'static Table),
    /// This word, or a number.
    WordOrNumber(&'static str, Range),
    /// A text, or an object.
    TextOr(&'static Table),
}

/// How many keys of a set an object must have.
#[derive(Debug, Clone, Copy)]
pub enum Rule {
    /// No such set.
    Free,
    /// Exactly one of them.
    OneOf(&'static [&'static str]),
    /// One of them or more.
    AnyOf(&'static [&'static str]),
}

/// The keys of one object.
#[derive(Debug, Clone, Copy)]
pub struct Table {
    /// What to call such an object in messages, with its article.
    pub name: &'static str,
    /// Its keys; groups so that objects can share some.
    pub groups: &'static [&'static [Key]],
    /// Keys that exclude or replace each other.
    pub rule: Rule,
}

impl Table {
    /// All keys.
    pub fn keys(&self) -> impl Iterator<Item = &'static Key> + use<> {
        self.groups.iter().flat_map(|group| group.iter())
    }

    /// The key of this name.
    pub fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys().find(|key| key.name == name)
    }
}

/// One key.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// Its name in the file.
    pub name: &'static str,
    /// What it holds.
    pub kind: Kind,
    /// Unit, as people write it; empty: none.
    pub unit: &'static str,
    /// Whether it must be there.
    pub required: bool,
    /// What holds where it is absent; empty where it is required.
    pub default: &'static str,
    /// One sentence for people.
    pub doc: &'static str,
}

/// JSON Schema (draft 2020-12) of `job.slam`, without its comments and trailing commas.
pub fn job_schema() -> Value {
    let mut schema = object_schema(&keys::JOB);
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("job.slam, version 1");
    schema
}

fn object_schema(table: &Table) -> Value {
    let properties: Map<String, Value> =
        table.keys().map(|key| (key.name.to_owned(), key_schema(key))).collect();
    let required: Vec<_> = table.keys().filter(|key| key.required).map(|key| key.name).collect();
    let mut schema = json!({
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    });
    let alternatives =
        |names: &[&str]| names.iter().map(|name| json!({ "required": [name] })).collect();
    match table.rule {
        Rule::Free => {}
        Rule::OneOf(names) => schema["oneOf"] = Value::Array(alternatives(names)),
        Rule::AnyOf(names) => schema["anyOf"] = Value::Array(alternatives(names)),
    }
    schema
}

fn key_schema(key: &Key) -> Value {
    let mut schema = kind_schema(key.kind);
    let unit = if key.unit.is_empty() { String::new() } else { format!(" Unit: {}.", key.unit) };
    let default =
        if key.default.is_empty() { String::new() } else { format!(" Default: {}.", key.default) };
    schema["description"] = json!(format!("{}{unit}{default}", key.doc));
    schema
}

fn kind_schema(kind: Kind) -> Value {
    match kind {
        Kind::Number(range) => number_schema("number", range),
        Kind::Integer(range) => number_schema("integer", range),
        Kind::Text => json!({ "type": "string", "minLength": 1 }),
        Kind::Date => json!({
            "type": "string", "format": "date", "pattern": "^[0-9]{4}-[0-9]{2}-[0-9]{2}$",
        }),
        Kind::Choice(words) => json!({ "type": "string", "enum": words }),
        Kind::Letters(letters) => {
            let pattern: String = letters.chars().map(|letter| format!("{letter}?")).collect();
            json!({ "type": "string", "minLength": 1, "pattern": format!("^{pattern}$") })
        }
        Kind::Triple(range) => json!({
            "type": "array", "minItems": 3, "maxItems": 3, "items": number_schema("number", range),
        }),
        Kind::List(item, least) => {
            json!({ "type": "array", "minItems": least, "items": kind_schema(*item) })
        }
        Kind::Object(table) => object_schema(table),
        Kind::WordOrNumber(word, range) => {
            json!({ "anyOf": [{ "const": word }, number_schema("number", range)] })
        }
        Kind::TextOr(table) => {
            json!({ "anyOf": [kind_schema(Kind::Text), object_schema(table)] })
        }
    }
}

fn number_schema(name: &str, range: Range) -> Value {
    let least = if range.above { "exclusiveMinimum" } else { "minimum" };
    json!({ "type": name, least: range.low, "maximum": range.high })
}
