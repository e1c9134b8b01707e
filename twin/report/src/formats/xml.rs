//! XML as text, element by element.

/// The characters that XML 1.0 has, those with a meaning of their own as entities. Line breaks stay
/// line breaks in an attribute too.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&apos;"),
            '\n' => escaped.push_str("&#10;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => {}
            c => escaped.push(c),
        }
    }
    escaped
}

/// An opening tag with its attributes; `end` is `>` or `/>`.
pub(super) fn open(name: &str, attributes: &[(&str, String)], end: &str) -> String {
    let mut tag = format!("<{name}");
    for (attribute, value) in attributes {
        tag.push_str(&format!(" {attribute}=\"{}\"", escape(value)));
    }
    tag + end
}
