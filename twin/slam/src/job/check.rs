//! The tree against the table of keys: types, ranges, unknown, repeated and missing keys.

use std::collections::BTreeSet;
use std::fmt;

use jsonc_parser::ast::{Object, Value};

use super::hints;
use super::problems::Problems;
use super::syntax::span_of;
use crate::date::is_date;
use crate::diagnostic::quoted;
use crate::schema::keys::JOB;
use crate::schema::{Kind, Range, Rule, Table};
use crate::{Diagnostic, Span};

/// A key, or an item of a list, as messages call it.
#[derive(Clone, Copy)]
enum Label<'a> {
    Key(&'a str, &'static str),
    Item(&'a Label<'a>, usize),
}

impl Label<'_> {
    fn unit(&self) -> &'static str {
        match self {
            Label::Key(_, unit) => unit,
            Label::Item(list, _) => list.unit(),
        }
    }
}

impl fmt::Display for Label<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Label::Key(name, _) => f.write_str(name),
            Label::Item(list, index) => write!(f, "{list}[{index}]"),
        }
    }
}

/// Refuses another version before anything else is judged by the rules of this one.
pub(super) fn version(root: &Object<'_>) -> Result<(), Box<Diagnostic>> {
    let Some(number) = root.get_number("slam") else { return Ok(()) };
    match number.value.parse::<f64>() {
        Ok(1.0) => Ok(()),
        _ => {
            let text = format!("this file is version {}; this twin reads 1", clip(number.value));
            Err(Box::new(Diagnostic::error(span_of(number), text)))
        }
    }
}

/// Checks a whole job.
pub(super) fn table(root: &Object<'_>, problems: &mut Problems) {
    check_object(root, &JOB, problems);
}

fn check_object(object: &Object<'_>, table: &Table, problems: &mut Problems) {
    let mut seen = BTreeSet::new();
    for property in &object.properties {
        let name = property.name.as_str();
        // a property starts at its name, which is longer by two quotes (or escapes) in the text
        let start = span_of(property).start;
        let span = Span { start, end: (start + name.len() + 2).min(span_of(property).end) };
        let Some(key) = table.key(name) else {
            let problem = Diagnostic::error(span, format!("unknown key {}", quoted(name)));
            problems.add(match hints::unknown_key(name, table) {
                Some(hint) => problem.hint(hint),
                None => problem.hint(known_keys(table)),
            });
            continue;
        };
        if !seen.insert(key.name) {
            problems.error(span, format!("key {} stands here twice", quoted(name)));
            continue;
        }
        check_value(&property.value, key.kind, Label::Key(key.name, key.unit), problems);
    }
    missing_keys(object, table, &seen, problems);
}

fn known_keys(table: &Table) -> String {
    let names: Vec<_> = table.keys().map(|key| key.name).collect();
    format!("{} has the keys {}", table.name, names.join(", "))
}

fn missing_keys(
    object: &Object<'_>,
    table: &Table,
    seen: &BTreeSet<&str>,
    problems: &mut Problems,
) {
    let start = span_of(object).start;
    let span = Span { start, end: start + 1 };
    for key in table.keys().filter(|key| key.required && !seen.contains(key.name)) {
        let problem =
            Diagnostic::error(span, format!("{} lacks the key {}", table.name, quoted(key.name)));
        let version = key.name == "slam";
        problems.add(if version { problem.hint("write \"slam\": 1 first") } else { problem });
    }
    let (names, most) = match table.rule {
        Rule::Free => return,
        Rule::OneOf(names) => (names, 1),
        Rule::AnyOf(names) => (names, names.len()),
    };
    let count = names.iter().filter(|&&name| seen.contains(name)).count();
    if count == 0 || count > most {
        let amount = if most == 1 { "exactly one" } else { "at least one" };
        let list = names.join(", ");
        problems.error(span, format!("{} needs {amount} of the keys {list}", table.name));
    }
}

fn check_value(value: &Value<'_>, kind: Kind, label: Label<'_>, problems: &mut Problems) {
    match (kind, value) {
        (Kind::Object(table), Value::Object(object))
        | (Kind::TextOr(table), Value::Object(object)) => {
            check_object(object, table, problems);
        }
        (Kind::Number(range) | Kind::WordOrNumber(_, range), Value::NumberLit(_)) => {
            check_number(value, range, false, label, problems);
        }
        (Kind::Integer(range), Value::NumberLit(_)) => {
            check_number(value, range, true, label, problems)
        }
        (Kind::Triple(range), Value::Array(array)) => {
            if array.elements.len() != 3 {
                let count = array.elements.len();
                problems.error(
                    span_of(array),
                    format!("{label} needs three numbers; here are {count}"),
                );
            }
            for element in &array.elements {
                check_value(element, Kind::Number(range), label, problems);
            }
        }
        (Kind::List(item, least), Value::Array(array)) => {
            if array.elements.len() < least {
                let count = array.elements.len();
                let items = if least == 1 { "item" } else { "items" };
                let message = format!("{label} needs at least {least} {items}; here are {count}");
                problems.error(span_of(array), message);
            }
            for (index, element) in array.elements.iter().enumerate() {
                check_value(element, *item, Label::Item(&label, index), problems);
            }
        }
        (_, Value::StringLit(text)) => {
            check_text(&text.value, span_of(text), kind, label, problems)
        }
        _ => wrong_type(value, kind, label, problems),
    }
}

fn check_number(
    value: &Value<'_>,
    range: Range,
    whole: bool,
    label: Label<'_>,
    problems: &mut Problems,
) {
    let Value::NumberLit(literal) = value else { return };
    let shown = clip(literal.value);
    let span = span_of(literal);
    let number = literal.value.parse::<f64>().unwrap_or(f64::NAN);
    if !number.is_finite() {
        problems.error(span, format!("{label}: {shown} is too large for a number"));
    } else if !range.holds(number) {
        let unit = label.unit();
        let space = if unit.is_empty() { "" } else { " " };
        problems.error(span, format!("{label} is {shown}; it must be {range}{space}{unit}"));
    } else if whole && number.fract() != 0.0 {
        problems.error(span, format!("{label} is {shown}; it must be a whole number"));
    }
}

fn check_text(text: &str, span: Span, kind: Kind, label: Label<'_>, problems: &mut Problems) {
    let shown = quoted(text);
    match kind {
        Kind::Text | Kind::TextOr(_) if text.is_empty() => {
            problems.error(span, format!("{label} is empty"))
        }
        Kind::Text | Kind::TextOr(_) => {}
        Kind::Date if is_date(text) => {}
        Kind::Choice(words) if words.contains(&text) => {}
        Kind::Choice(words) => {
            let message = format!("{label} is {shown}; it must be one of {}", words.join(", "));
            let problem = Diagnostic::error(span, message);
            problems.add(match hints::nearest(text, words.iter().copied()) {
                Some(word) => problem.hint(format!("did you mean {}?", quoted(word))),
                None => problem,
            });
        }
        Kind::WordOrNumber(word, _) if word == text => {}
        Kind::Letters(letters) if in_order(text, letters) => {}
        Kind::Letters(letters) => {
            let message = format!(
                "{label} is {shown}; it must be some of the letters {letters}, in this order"
            );
            problems.error(span, message);
        }
        _ => problems.error(span, format!("{label} is {shown}; it must be {}", expected(kind))),
    }
}

fn wrong_type(value: &Value<'_>, kind: Kind, label: Label<'_>, problems: &mut Problems) {
    let found = match value {
        Value::StringLit(_) => "a text",
        Value::NumberLit(_) => "a number",
        Value::BooleanLit(_) => "true or false",
        Value::Object(_) => "an object",
        Value::Array(_) => "a list",
        Value::NullKeyword(_) => "null",
    };
    let start = span_of(value).start;
    let one_line = Span { start, end: span_of(value).end.min(start + 60) };
    let message = format!("{label} is {found}; it must be {}", expected(kind));
    let problem = Diagnostic::error(one_line, message);
    let null = matches!(value, Value::NullKeyword(_));
    problems.add(if null { problem.hint("leave the key out instead") } else { problem });
}

fn expected(kind: Kind) -> String {
    match kind {
        Kind::Number(_) => "a number".to_owned(),
        Kind::Integer(_) => "a whole number".to_owned(),
        Kind::Text | Kind::Letters(_) => "a text".to_owned(),
        Kind::Date => "a day of the calendar, as 2027-01-31".to_owned(),
        Kind::Choice(words) => format!("one of {}", words.join(", ")),
        Kind::Triple(_) => "a list of three numbers".to_owned(),
        Kind::List(..) => "a list".to_owned(),
        Kind::Object(_) => "an object".to_owned(),
        Kind::WordOrNumber(word, _) => format!("{} or a number", quoted(word)),
        Kind::TextOr(_) => "the id of a strand or an object".to_owned(),
    }
}

/// Whether a text is a non-empty selection of `letters` in their order.
fn in_order(text: &str, letters: &str) -> bool {
    let mut rest = letters.chars();
    !text.is_empty() && text.chars().all(|wanted| rest.any(|letter| letter == wanted))
}

fn clip(number: &str) -> &str {
    number.get(..40).unwrap_or(number)
}
