//! What is wrong with a text, and where.

mod fancy;
#[cfg(test)]
mod tests;

use std::fmt;

/// Byte range `start..end` of a value in its text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, PartialOrd, Ord)]
pub struct Span {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

/// A value and where it stands in the text it was read from.
///
/// Equality compares the value alone: two documents are the same if they say the same.
#[derive(Debug, Clone, Copy, Default)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Its place.
    pub span: Span,
}

impl<T: PartialEq> PartialEq for Spanned<T> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<T> Spanned<T> {
    /// Pairs a value with its place.
    pub fn new(value: T, span: Span) -> Self {
        Self { value, span }
    }
}

/// How bad a diagnostic is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The text can be used; the author should know.
    Warning,
    /// The text cannot be used.
    Error,
}

/// One statement about a text: what, where, and what to do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// Whether the text can still be used.
    pub severity: Severity,
    /// What is wrong, one sentence without a full stop.
    pub message: String,
    /// Where, in the text.
    pub span: Span,
    /// What to do about it, one sentence each.
    pub hints: Vec<String>,
}

impl Diagnostic {
    /// An error at `span`.
    pub fn error(span: Span, message: impl Into<String>) -> Self {
        Self { severity: Severity::Error, message: message.into(), span, hints: Vec::new() }
    }

    /// A warning at `span`.
    pub fn warning(span: Span, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(span, message) }
    }

    /// Adds what to do about it.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hints.push(hint.into());
        self
    }

    /// An error that does not say what to do gets this hint.
    #[must_use]
    pub(crate) fn or_hint(self, hint: &str) -> Self {
        let advised = self.severity == Severity::Warning || !self.hints.is_empty();
        if advised { self } else { self.hint(hint) }
    }
}

/// A named text; turns byte offsets into lines and columns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// What to call the text in messages, usually a path.
    pub name: String,
    /// The text itself.
    pub text: String,
}

impl Source {
    /// Names a text.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self { name: name.into(), text: text.into() }
    }

    /// Line and column, both from 1, of a byte offset; columns count characters.
    pub fn line_column(&self, offset: usize) -> (usize, usize) {
        let before = &self.text[..self.boundary(offset)];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        let line = before.bytes().filter(|&byte| byte == b'\n').count() + 1;
        (line, before[line_start..].chars().count() + 1)
    }

    /// The nearest offset at or before this one where a character starts.
    fn boundary(&self, offset: usize) -> usize {
        let mut at = offset.min(self.text.len());
        while !self.text.is_char_boundary(at) {
            at -= 1;
        }
        at
    }

    /// The diagnostics with the lines they are about, a caret below each place, hints below.
    ///
    /// Long lines are clipped around the place. Each contains `file:line:column`.
    pub fn fancy(&self, diagnostics: &[Diagnostic], color: bool) -> String {
        fancy::render(self, diagnostics, color)
    }

    /// The diagnostic as `file:line:column: error: message`, hints below, without colour.
    pub fn plain<'a>(&'a self, diagnostic: &'a Diagnostic) -> impl fmt::Display + 'a {
        Plain { source: self, diagnostic }
    }
}

struct Plain<'a> {
    source: &'a Source,
    diagnostic: &'a Diagnostic,
}

impl fmt::Display for Plain<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (line, column) = self.source.line_column(self.diagnostic.span.start);
        let severity = match self.diagnostic.severity {
            Severity::Warning => "warning",
            Severity::Error => "error",
        };
        write!(f, "{}:{line}:{column}: {severity}: {}", self.source.name, self.diagnostic.message)?;
        for hint in &self.diagnostic.hints {
            write!(f, "\n  hint: {hint}")?;
        }
        Ok(())
    }
}

/// A piece of somebody's text in quotes, clipped and without control characters.
pub(crate) fn quoted(text: &str) -> String {
    const LONGEST: usize = 60;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{:?}…", &text[..end]),
        None => format!("{text:?}"),
    }
}
