//! Colour and line breaks of a terminal.

use crate::line::one_line;

/// How a word is painted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Paint {
    /// Errors and infeasible jobs.
    Red,
    /// Warnings.
    Yellow,
    /// Feasible jobs.
    Green,
    /// Headings.
    Bold,
    /// Labels.
    Dim,
}

/// Lines of text, painted or not.
pub(crate) struct Screen {
    color: bool,
    width: usize,
    text: String,
}

/// Narrower than this nothing is broken any more, it would not help.
const NARROWEST: usize = 40;
/// Longest text beside a label, characters.
const LONGEST: usize = 4000;

impl Screen {
    pub(crate) fn new(color: bool, width: usize) -> Self {
        Self { color, width: width.max(NARROWEST), text: String::new() }
    }

    pub(crate) fn finish(self) -> String {
        self.text
    }

    /// The word with its colour, if there are colours.
    pub(crate) fn paint(&self, paint: Paint, word: &str) -> String {
        let sgr = match paint {
            Paint::Red => "1;31",
            Paint::Yellow => "1;33",
            Paint::Green => "1;32",
            Paint::Bold => "1",
            Paint::Dim => "2",
        };
        if self.color { format!("\x1b[{sgr}m{word}\x1b[0m") } else { word.to_owned() }
    }

    /// One line as it stands.
    pub(crate) fn line(&mut self, line: &str) {
        self.text.push_str(line.trim_end());
        self.text.push('\n');
    }

    /// A dim label and text beside it, broken between words.
    pub(crate) fn labelled(&mut self, label: &str, text: &str) {
        const INDENT: usize = 2;
        const LABEL: usize = 7;
        let label = self.paint(Paint::Dim, &format!("{label:<LABEL$}"));
        let mut first = true;
        for row in wrap(&one_line(text, LONGEST), self.width - INDENT - LABEL) {
            let before = if first { label.clone() } else { " ".repeat(LABEL) };
            first = false;
            self.line(&format!("{:INDENT$}{before}{row}", ""));
        }
    }
}

/// Rows of at most `width` characters, broken between words; a longer word has a row of its own.
pub(crate) fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut rows: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match rows.last_mut() {
            Some(row) if row.chars().count() + 1 + word.chars().count() <= width => {
                row.push(' ');
                row.push_str(word);
            }
            _ => rows.push(word.to_owned()),
        }
    }
    rows
}
