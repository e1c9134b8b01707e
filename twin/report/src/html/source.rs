//! The lines of the job that a finding is about.

use crate::plots::text::escaped;

/// Lines told after the one that is meant.
const AFTER: usize = 2;
/// Longest line told, characters.
const LONGEST: usize = 100;

/// The job's text by lines.
pub(super) struct Lines<'a> {
    lines: Vec<&'a str>,
}

impl<'a> Lines<'a> {
    pub(super) fn of(source: &'a slam::Source) -> Self {
        Self { lines: source.text.lines().collect() }
    }

    /// The line before, this line (from 1) marked, and two after it; empty where the job has no such line.
    pub(super) fn excerpt(&self, line: usize) -> String {
        if line == 0 || line > self.lines.len() {
            return String::new();
        }
        let from = line.saturating_sub(1).max(1);
        let to = (line + AFTER).min(self.lines.len());
        let width = to.to_string().len();
        let told: String = (from..=to)
            .map(|number| {
                let text = escaped(self.lines[number - 1].replace('\t', "  ").trim_end(), LONGEST);
                match number == line {
                    true => format!("<b>▸ {number:>width$}  {text}</b>\n"),
                    false => format!("  {number:>width$}  {text}\n"),
                }
            })
            .collect();
        format!(
            "<pre tabindex=\"0\" aria-label=\"Lines {from} to {to} of the job\"><code>{told}</code></pre>"
        )
    }
}
