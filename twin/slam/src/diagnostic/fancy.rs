//! Diagnostics with the line of the text and a caret below the place.

use std::ops::Range;

use annotate_snippets::{AnnotationKind, Level, Origin, Renderer, Snippet};

use super::{Diagnostic, Severity, Source};

/// Longest piece of a line that is shown, characters.
const SHOWN: usize = 160;
/// How much of it may stand before the place.
const BEFORE: usize = 60;

/// All diagnostics, one below the other.
pub(super) fn render(source: &Source, diagnostics: &[Diagnostic], color: bool) -> String {
    let renderer = if color { Renderer::styled() } else { Renderer::plain() };
    let mut text = String::new();
    for diagnostic in diagnostics {
        text.push_str(&one(&renderer, source, diagnostic));
        text.push_str("\n\n");
    }
    text
}

fn one(renderer: &Renderer, source: &Source, diagnostic: &Diagnostic) -> String {
    let level = match diagnostic.severity {
        Severity::Warning => Level::WARNING,
        Severity::Error => Level::ERROR,
    };
    let (line, column) = source.line_column(diagnostic.span.start);
    let (shown, span) = excerpt(source, diagnostic);
    let snippet = Snippet::source(shown)
        .line_start(line)
        .fold(false)
        .annotation(AnnotationKind::Primary.span(span));
    let place = Origin::path(source.name.as_str()).line(line).char_column(column);
    let hints = diagnostic.hints.iter().map(|hint| Level::HELP.message(hint.as_str()));
    let group = level.primary_title(diagnostic.message.as_str());
    renderer.render(&[group.element(place).element(snippet).elements(hints)])
}

/// The piece of the line around the place, and the place in it.
fn excerpt(source: &Source, diagnostic: &Diagnostic) -> (String, Range<usize>) {
    let text = source.text.as_str();
    let start = source.boundary(diagnostic.span.start);
    let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
    let line_end = text[start..].find('\n').map_or(text.len(), |at| start + at);
    let before: String = {
        let mut tail: Vec<char> = text[line_start..start].chars().rev().take(BEFORE).collect();
        tail.reverse();
        tail.into_iter().collect()
    };
    let after: String = text[start..line_end].trim_end().chars().take(SHOWN - BEFORE).collect();
    let cut_before = if before.len() < start - line_start { "…" } else { "" };
    let cut_after = if after.len() < text[start..line_end].trim_end().len() { "…" } else { "" };
    let from = cut_before.len() + before.len();
    let length = source.boundary(diagnostic.span.end).saturating_sub(start).min(after.len());
    // a tab has no fixed width and would move the caret
    let shown = format!("{cut_before}{before}{after}{cut_after}").replace('\t', " ");
    (shown, from..from + length)
}
