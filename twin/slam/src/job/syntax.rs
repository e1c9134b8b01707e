//! Text to syntax tree, within limits.

use jsonc_parser::ast::{Object, Value};
use jsonc_parser::common::Ranged;
use jsonc_parser::errors::{ParseError, ParseErrorKind};
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};

use super::{MAX_BYTES, MAX_DEPTH, MAX_POINTS, MAX_STRANDS};
use crate::{Diagnostic, Span};

/// Commas outside strings; more would take gigabytes as a tree.
const MAX_COMMAS: usize = 6 * MAX_POINTS;

/// Boxed: an error is rare and large.
type Fallible<T> = Result<T, Box<Diagnostic>>;

const OPTIONS: ParseOptions = ParseOptions {
    allow_comments: true,
    allow_loose_object_property_names: false,
    allow_trailing_commas: true,
    allow_missing_commas: false,
    allow_single_quoted_strings: false,
    allow_hexadecimal_numbers: false,
    allow_unary_plus_numbers: false,
    allow_bare_decimal_point_numbers: false,
    allow_non_finite_numbers: false,
    allow_extended_string_escapes: false,
};

/// Place of a node.
pub(super) fn span_of(node: &impl Ranged) -> Span {
    Span { start: node.start(), end: node.end() }
}

/// The tree of a text; its root is an object.
pub(super) fn tree(text: &str) -> Fallible<Object<'_>> {
    scan(text)?;
    let tree = parse_to_ast(text, &CollectOptions::default(), &OPTIONS);
    match tree.map_err(|error| syntax_error(text, &error))?.value {
        Some(Value::Object(root)) => Ok(root),
        Some(other) => fail(span_of(&other), "a job is an object; the file must start with {"),
        None => fail(Span::default(), "the file is empty"),
    }
}

/// Refuses more strands or points than the twin takes.
pub(super) fn sizes(root: &Object<'_>) -> Fallible<()> {
    let Some(strands) = root.get_array("strands") else { return Ok(()) };
    if strands.elements.len() > MAX_STRANDS {
        let message = format!("{} strands; at most {MAX_STRANDS}", strands.elements.len());
        return fail(span_of(strands), message);
    }
    let lists =
        strands.elements.iter().filter_map(|strand| strand.as_object()?.get_array("points_mm"));
    let points: usize = lists.map(|list| list.elements.len()).sum();
    if points > MAX_POINTS {
        return fail(span_of(strands), format!("{points} points; at most {MAX_POINTS}"));
    }
    Ok(())
}

/// Checks what must hold before the recursive parser may see the text: size, depth, no binary.
fn scan(text: &str) -> Fallible<()> {
    if text.len() > MAX_BYTES {
        return fail(
            Span::default(),
            format!("the file has {} bytes; at most {MAX_BYTES}", text.len()),
        );
    }
    if text.starts_with('\u{feff}') {
        let problem =
            Diagnostic::error(Span { start: 0, end: 3 }, "the file starts with a byte order mark");
        return Err(Box::new(problem.hint("save it as UTF-8 without BOM")));
    }
    if let Some(at) = text.bytes().position(|byte| byte == 0) {
        return fail(
            Span { start: at, end: at + 1 },
            "the file holds a NUL byte; this is not a text",
        );
    }
    let (mut depth, mut commas, mut at) = (0_usize, 0_usize, 0_usize);
    let bytes = text.as_bytes();
    while at < bytes.len() {
        let here = Span { start: at, end: at + 1 };
        match bytes[at] {
            b'"' => at = string_end(bytes, at)?,
            b'/' => at = comment_end(bytes, at),
            b'[' | b'{' => depth += 1,
            b']' | b'}' => depth = depth.saturating_sub(1),
            b',' => commas += 1,
            _ => {}
        }
        if depth > MAX_DEPTH {
            return fail(here, format!("nested deeper than {MAX_DEPTH} levels"));
        }
        if commas > MAX_COMMAS {
            let problem = Diagnostic::error(here, format!("more than {MAX_COMMAS} values"));
            return Err(Box::new(problem.hint("split the job in two")));
        }
        at += 1;
    }
    Ok(())
}

/// Index of the closing quote, or of the last byte where there is none.
fn string_end(bytes: &[u8], open: usize) -> Fallible<usize> {
    let mut at = open + 1;
    while at < bytes.len() {
        match bytes[at] {
            b'"' => return Ok(at),
            b'\\' => at += 2,
            byte if byte < 0x20 => {
                let message = match byte {
                    b'\n' | b'\r' => "this text is not closed on its line".to_owned(),
                    _ => format!("control character {byte:#04x} inside a text"),
                };
                let problem = Diagnostic::error(Span { start: open, end: at }, message);
                return Err(Box::new(
                    problem.hint("close it with \", or write \\n for a line break"),
                ));
            }
            _ => at += 1,
        }
    }
    Ok(bytes.len())
}

/// Index of the last byte of a comment that opens here; here itself where none does.
fn comment_end(bytes: &[u8], open: usize) -> usize {
    let rest = &bytes[open..];
    let length = match rest.get(1) {
        Some(b'/') => rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')),
        Some(b'*') => rest[2..].windows(2).position(|pair| pair == b"*/").map(|at| at + 3),
        _ => Some(0),
    };
    length.map_or(bytes.len(), |length| open + length)
}

fn syntax_error(text: &str, error: &ParseError) -> Box<Diagnostic> {
    use ParseErrorKind as K;
    let range = error.range();
    let span = Span { start: range.start.min(text.len()), end: range.end.min(text.len()) };
    let rest = text.get(span.start..).unwrap_or_default();
    let word = &rest[..rest.find(|letter: char| !letter.is_alphanumeric()).unwrap_or(rest.len())];
    let (message, hint) = match error.kind() {
        K::UnexpectedWord | K::UnexpectedToken if !word.is_empty() => word_message(word),
        K::NonFiniteNumbersNotAllowed => word_message("Infinity"),
        K::ExpectedComma => ("a comma is missing after this".to_owned(), ""),
        K::UnterminatedObject => ("this { is never closed".to_owned(), "is the file cut off?"),
        K::UnterminatedArray => ("this [ is never closed".to_owned(), "is the file cut off?"),
        K::UnterminatedCommentBlock => ("this /* is never closed".to_owned(), ""),
        K::ExpectedStringObjectProperty => ("keys stand in double quotes".to_owned(), ""),
        K::SingleQuotedStringsNotAllowed => {
            ("texts stand in double quotes, not single".to_owned(), "")
        }
        K::MultipleRootJsonValues => {
            ("text after the end of the job".to_owned(), "one file, one job")
        }
        K::ExpectedDigitFollowingNegativeSign if rest.starts_with(['I', 'N']) => {
            word_message("Infinity")
        }
        other => (lower_first(&other.to_string()), ""),
    };
    let mut problem = Diagnostic::error(span, message);
    if !hint.is_empty() {
        problem = problem.hint(hint);
    }
    Box::new(problem)
}

fn word_message(word: &str) -> (String, &'static str) {
    let hint = match word.trim_start_matches('-') {
        "NaN" | "nan" | "Infinity" | "inf" | "Inf" => "every number must be finite",
        "True" | "TRUE" | "False" | "FALSE" => "true and false are written in lower case",
        "None" | "nil" | "undefined" => "leave the key out instead",
        _ => "texts stand in double quotes",
    };
    (format!("{} is not a value", crate::diagnostic::quoted(word)), hint)
}

fn lower_first(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or(String::new(), |first| first.to_lowercase().chain(chars).collect())
}

fn fail<T>(span: Span, message: impl Into<String>) -> Fallible<T> {
    Err(Box::new(Diagnostic::error(span, message)))
}
