//! Elements and attributes of an XML text with their places.
//!
//! No reader of XML as a whole: it looks for what must be known before urdf-rs may see the text
//! (size, depth, no DOCTYPE) and for places that urdf-rs does not give. Well-formedness beyond
//! balanced tags is urdf-rs's to judge.

use super::MAX_BYTES;
use crate::{Diagnostic, Span};

/// Deepest nesting; URDF itself needs five.
const MAX_DEPTH: usize = 32;

type Fallible<T> = Result<T, Box<Diagnostic>>;

/// An element, in order of its opening tag.
pub(super) struct Element<'a> {
    /// Tag name.
    pub(super) name: &'a str,
    /// Place of the opening tag.
    pub(super) span: Span,
    /// Index of the enclosing element.
    pub(super) parent: Option<usize>,
    /// Its attributes.
    pub(super) attributes: Vec<Attribute<'a>>,
}

/// An attribute as written, entities and all.
pub(super) struct Attribute<'a> {
    /// Its name.
    pub(super) name: &'a str,
    /// Between the quotes.
    pub(super) value: &'a str,
    /// Place of the value.
    pub(super) span: Span,
}

impl<'a> Element<'a> {
    /// The attribute of this name.
    pub(super) fn attribute(&self, name: &str) -> Option<&Attribute<'a>> {
        self.attributes.iter().find(|attribute| attribute.name == name)
    }
}

/// All elements of a text.
pub(super) fn elements(text: &str) -> Fallible<Vec<Element<'_>>> {
    if text.len() > MAX_BYTES {
        return fail(0..0, format!("the file has {} bytes; at most {MAX_BYTES}", text.len()));
    }
    let mut elements: Vec<Element<'_>> = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    let mut at = 0;
    while let Some(found) = text[at..].find('<') {
        let start = at + found;
        let rest = &text[start..];
        if rest.starts_with("<!--") {
            at = past(text, start, "-->", "comment")?;
        } else if rest.starts_with("<?") {
            at = past(text, start, "?>", "instruction")?;
        } else if rest.starts_with("<![CDATA[") {
            at = past(text, start, "]]>", "CDATA")?;
        } else if rest.starts_with("<!") {
            return fail(start..start + 2, "DOCTYPE and entities are not read");
        } else if rest.starts_with("</") {
            at = past(text, start, ">", "tag")?;
            let name = text[start + 2..at - 1].trim();
            match open.pop() {
                Some(index) if elements[index].name == name => {}
                _ => {
                    return fail(
                        start..at,
                        format!("</{}> closes nothing that is open", shown(name)),
                    );
                }
            }
        } else {
            let (mut element, closed, next) = opening_tag(text, start)?;
            if open.is_empty() && !elements.is_empty() {
                return fail(start..next, "a second root element");
            }
            element.parent = open.last().copied();
            at = next;
            if !closed {
                open.push(elements.len());
            }
            elements.push(element);
            if open.len() > MAX_DEPTH {
                return fail(start..next, format!("nested deeper than {MAX_DEPTH} levels"));
            }
        }
    }
    if let Some(&index) = open.last() {
        let element = &elements[index];
        return fail(
            element.span.start..element.span.end,
            format!("<{}> is never closed", shown(element.name)),
        );
    }
    if elements.is_empty() { fail(0..0, "no XML element in this file") } else { Ok(elements) }
}

/// Offset just past the next `end`.
fn past(text: &str, start: usize, end: &str, what: &str) -> Fallible<usize> {
    match text[start..].find(end) {
        Some(length) => Ok(start + length + end.len()),
        None => fail(start..start + 1, format!("this {what} is never closed")),
    }
}

/// The element, whether it closes itself, and the offset just past its tag.
fn opening_tag(text: &str, start: usize) -> Fallible<(Element<'_>, bool, usize)> {
    let ends_name =
        |letter: char| letter.is_whitespace() || matches!(letter, '=' | '/' | '>' | '<');
    let word = |from: usize| -> &str {
        let rest = &text[from..];
        &rest[..rest.find(ends_name).unwrap_or(rest.len())]
    };
    let skip = |from: usize| text.len() - text[from..].trim_start().len();
    let name = word(start + 1);
    if name.is_empty() {
        return fail(start..start + 1, "a tag without a name");
    }
    let mut attributes = Vec::new();
    let mut at = skip(start + 1 + name.len());
    loop {
        let rest = &text[at..];
        let closed = rest.starts_with("/>");
        if closed || rest.starts_with('>') {
            let next = at + if closed { 2 } else { 1 };
            let span = Span { start, end: next };
            return Ok((Element { name, span, parent: None, attributes }, closed, next));
        }
        let key = word(at);
        let equals = skip(at + key.len());
        let quote_at = if text[equals..].starts_with('=') { skip(equals + 1) } else { text.len() };
        let quote = text[quote_at..].chars().next().filter(|quote| matches!(quote, '"' | '\''));
        let value = quote.and_then(|quote| {
            let rest = &text[quote_at + 1..];
            rest.find(quote).map(|length| &rest[..length])
        });
        let (false, Some(value)) = (key.is_empty(), value) else {
            return fail(
                start..at.max(start + 1),
                format!("the tag <{}> is not well formed", shown(name)),
            );
        };
        let span = Span { start: quote_at + 1, end: quote_at + 1 + value.len() };
        attributes.push(Attribute { name: key, value, span });
        at = skip(span.end + 1);
    }
}

/// A name short enough for a message.
fn shown(name: &str) -> String {
    name.chars().filter(|letter| !letter.is_control()).take(60).collect()
}

fn fail<T>(place: std::ops::Range<usize>, message: impl Into<String>) -> Fallible<T> {
    Err(Box::new(Diagnostic::error(Span { start: place.start, end: place.end }, message)))
}
