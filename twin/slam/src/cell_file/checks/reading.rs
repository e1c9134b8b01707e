//! serde's half of the reading: one error at a time, made into as many diagnostics as it allows.

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer, Error};

use crate::{Diagnostic, Span};

/// A text can hold this many unknown keys before reading stops.
const MOST_UNKNOWN_KEYS: usize = 40;

/// The structs a document describes. serde stops at the first fault; an unknown key is noted, cut
/// out and reading starts again, so that all of them are reported. A missing key is not reported
/// where an unknown one was taken to mean it.
pub(super) fn structs_of<T: DeserializeOwned>(
    mut document: Spanned<DeTable<'_>>,
) -> Result<T, Vec<Diagnostic>> {
    let mut problems = Vec::new();
    let mut meant: Vec<String> = Vec::new();
    for _ in 0..MOST_UNKNOWN_KEYS {
        let error = match T::deserialize(Deserializer::from(document.clone())) {
            Ok(value) if problems.is_empty() => return Ok(value),
            Ok(_) => return Err(problems),
            Err(error) => error,
        };
        let message = error.message().to_owned();
        let names = quoted(&message);
        if let Some(missing) = message.strip_prefix("missing field ") {
            if !meant.iter().any(|key| missing.trim_matches('`') == key) {
                problems.push(missing_key(&error, missing));
            }
            return Err(problems);
        }
        problems.push(reading_fault(&error, &names));
        let cut = message.starts_with("unknown field")
            && error.span().is_some_and(|span| cut_key(document.get_mut(), span.start));
        if !cut {
            return Err(problems);
        }
        meant.extend(names.split_first().and_then(|(key, known)| nearest(key, known)));
    }
    Err(problems)
}

/// A fault of the TOML itself.
pub(super) fn syntax_fault(error: &Error) -> Diagnostic {
    Diagnostic::error(span_of(error), error.message().trim().to_owned())
        .hint("the file is TOML: `key = value` lines under `[table]` headers")
}

fn missing_key(error: &Error, missing: &str) -> Diagnostic {
    let span = span_of(error);
    // A table's place is all of it: point at where it begins.
    let start = Span { start: span.start, end: span.end.min(span.start + 1) };
    Diagnostic::error(start, format!("{missing} is missing here"))
        .hint(format!("add a line `{} = …`", missing.trim_matches('`')))
}

fn reading_fault(error: &Error, names: &[String]) -> Diagnostic {
    let message = error.message();
    let kind = [("unknown field", "unknown key"), ("unknown variant", "unknown word")]
        .into_iter()
        .find(|(serde, _)| message.starts_with(serde));
    let (Some((_, ours)), Some((name, known))) = (kind, names.split_first()) else {
        return Diagnostic::error(
            span_of(error),
            message.replace('\n', ", ").replace("expected f64", "expected a number"),
        );
    };
    let problem = Diagnostic::error(span_of(error), format!("{ours} `{name}`"));
    match nearest(name, known) {
        Some(near) => problem.hint(format!("did you mean `{near}`?")),
        None if known.is_empty() => problem,
        None => problem.hint(format!("known here: {}", known.join(", "))),
    }
}

fn span_of(error: &Error) -> Span {
    let span = error.span().unwrap_or(0..0);
    Span { start: span.start, end: span.end }
}

/// The words between backticks, in order: serde names first the word it read, then those it knows.
fn quoted(message: &str) -> Vec<String> {
    message.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

/// The known word that `word` most likely is a slip of.
fn nearest(word: &str, known: &[String]) -> Option<String> {
    let score = |candidate: &String| strsim::jaro_winkler(word, candidate);
    let near = known.iter().max_by(|a, b| score(a).total_cmp(&score(b)))?;
    (score(near) > 0.8).then(|| near.clone())
}

/// Takes out the key that begins at `start`; whether it was there.
fn cut_key(table: &mut DeTable<'_>, start: usize) -> bool {
    let found = table.keys().find(|key| key.span().start == start).cloned();
    match found {
        Some(key) => table.remove(&key).is_some(),
        None => table.iter_mut().any(|(_, value)| cut_below(value.get_mut(), start)),
    }
}

fn cut_below(value: &mut DeValue<'_>, start: usize) -> bool {
    match value {
        DeValue::Table(table) => cut_key(table, start),
        DeValue::Array(array) => array.iter_mut().any(|item| cut_below(item.get_mut(), start)),
        _ => false,
    }
}
