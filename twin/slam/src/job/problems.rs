//! What was found wrong so far.

use super::MAX_PROBLEMS;
use crate::{Diagnostic, Severity, Span};

/// Problems of one file, capped so that a million equal mistakes do not fill the memory.
#[derive(Default)]
pub(super) struct Problems {
    listed: Vec<Diagnostic>,
    errors: usize,
    warnings: usize,
}

impl Problems {
    pub(super) fn add(&mut self, diagnostic: Diagnostic) {
        let count = match diagnostic.severity {
            Severity::Error => &mut self.errors,
            Severity::Warning => &mut self.warnings,
        };
        *count += 1;
        if *count <= MAX_PROBLEMS {
            self.listed.push(diagnostic);
        }
    }

    pub(super) fn error(&mut self, span: Span, message: impl Into<String>) {
        self.add(Diagnostic::error(span, message));
    }

    pub(super) fn warning(&mut self, span: Span, message: impl Into<String>) {
        self.add(Diagnostic::warning(span, message));
    }

    /// Warnings where nothing is wrong, else everything; by place.
    pub(super) fn finish(mut self) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
        self.listed.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.severity));
        let last = self.listed.last().map_or(Span::default(), |diagnostic| diagnostic.span);
        for (count, severity, word) in [
            (self.errors, Severity::Error, "errors"),
            (self.warnings, Severity::Warning, "warnings"),
        ] {
            if count > MAX_PROBLEMS {
                let message = format!("{} more {word} are not listed", count - MAX_PROBLEMS);
                self.listed.push(Diagnostic { severity, ..Diagnostic::error(last, message) });
            }
        }
        if self.errors == 0 { Ok(self.listed) } else { Err(self.listed) }
    }
}
