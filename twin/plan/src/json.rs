//! JSON with places: the few questions that frame and order files are asked.

use jsonc_parser::ast::{Object, Value};
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};
use slam::{Diagnostic, Source, Span};

/// The root value; strict JSON, nested at most as deep as the parser allows.
pub(crate) fn parse(source: &Source) -> Result<Value<'_>, Diagnostic> {
    let strict = ParseOptions {
        allow_comments: false,
        allow_loose_object_property_names: false,
        allow_trailing_commas: false,
        allow_missing_commas: false,
        allow_single_quoted_strings: false,
        allow_hexadecimal_numbers: false,
        allow_unary_plus_numbers: false,
        allow_bare_decimal_point_numbers: false,
        // Python writes them; where a number is needed they are refused.
        allow_non_finite_numbers: true,
        allow_extended_string_escapes: false,
    };
    match parse_to_ast(&source.text, &CollectOptions::default(), &strict) {
        Ok(parsed) => {
            parsed.value.ok_or_else(|| Diagnostic::error(Span::default(), "the file is empty"))
        }
        Err(error) => {
            let range = error.range();
            let span = Span { start: range.start, end: range.end };
            Err(Diagnostic::error(span, format!("not JSON: {}", error.kind())))
        }
    }
}

/// Where a value stands.
pub(crate) fn span(value: &impl Ranged) -> Span {
    let range = value.range();
    Span { start: range.start, end: range.end }
}

/// The value under `key`, or an error that names it.
pub(crate) fn need<'o, 'a>(object: &'o Object<'a>, key: &str) -> Result<&'o Value<'a>, Diagnostic> {
    match object.get(key) {
        Some(property) => Ok(&property.value),
        None => {
            let open = span(object);
            let brace = Span { start: open.start, end: open.start + 1 };
            Err(Diagnostic::error(brace, format!("`{key}` is missing here")))
        }
    }
}

/// The object under `key`.
pub(crate) fn object<'o, 'a>(
    value: &'o Value<'a>,
    what: &str,
) -> Result<&'o Object<'a>, Diagnostic> {
    value
        .as_object()
        .ok_or_else(|| Diagnostic::error(span(value), format!("{what} must be an object {{…}}")))
}

/// The values of an array.
pub(crate) fn array<'o, 'a>(
    value: &'o Value<'a>,
    what: &str,
) -> Result<&'o [Value<'a>], Diagnostic> {
    match value.as_array() {
        Some(array) => Ok(&array.elements),
        None => Err(Diagnostic::error(span(value), format!("{what} must be an array […]"))),
    }
}

/// A finite number.
pub(crate) fn number(value: &Value, what: &str) -> Result<f64, Diagnostic> {
    value
        .as_number_lit()
        .and_then(|literal| literal.value.parse::<f64>().ok())
        .filter(|number| number.is_finite())
        .ok_or_else(|| Diagnostic::error(span(value), format!("{what} must be a finite number")))
}

/// A whole number, also where a program wrote it as `3.0`.
pub(crate) fn integer(value: &Value, what: &str) -> Result<i64, Diagnostic> {
    let number = number(value, what)?;
    if number.fract() == 0.0 && number.abs() < 1e15 {
        return Ok(number as i64);
    }
    Err(Diagnostic::error(span(value), format!("{what} must be a whole number")))
}

/// A text.
pub(crate) fn text<'o>(value: &'o Value, what: &str) -> Result<&'o str, Diagnostic> {
    match value.as_string_lit() {
        Some(literal) => Ok(&literal.value),
        None => Err(Diagnostic::error(span(value), format!("{what} must be a text"))),
    }
}

/// The triple of an object `{X, Y, Z}`.
pub(crate) fn xyz(value: &Value, what: &str) -> Result<[f64; 3], Diagnostic> {
    let object = object(value, what)?;
    let mut triple = [0.0; 3];
    for (slot, key) in triple.iter_mut().zip(["X", "Y", "Z"]) {
        *slot = number(need(object, key)?, key)?;
    }
    Ok(triple)
}
