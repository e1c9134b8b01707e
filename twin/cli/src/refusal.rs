//! Input that cannot be used, with the place and what to do.

use std::io;

use sim::structure::SolveError;
use slam::{Diagnostic, Source, Span};

/// Why a command has no answer.
#[derive(Debug)]
pub(crate) enum Failure {
    /// Input that cannot be used.
    Refused(Refusal),
    /// Standard output or standard error cannot be written.
    Output(io::Error),
}

/// What is wrong with one text.
#[derive(Debug)]
pub(crate) struct Refusal {
    /// The text.
    pub(crate) source: Source,
    /// What and where.
    pub(crate) diagnostics: Vec<Diagnostic>,
}

impl Refusal {
    /// Something about a file, or an argument, as a whole.
    pub(crate) fn whole(name: impl Into<String>, message: impl Into<String>) -> Self {
        let diagnostics = vec![Diagnostic::error(Span::default(), message)];
        Self { source: Source::new(name, ""), diagnostics }
    }

    /// A job whose frame no solver answers for.
    pub(crate) fn unsolved(job: &str, error: &SolveError) -> Self {
        Self::whole(job, format!("the frame cannot be solved: {error}"))
    }

    /// Problems of a text.
    pub(crate) fn of(source: &Source, diagnostics: Vec<Diagnostic>) -> Self {
        Self { source: source.clone(), diagnostics }
    }

    /// What is wrong, without places.
    pub(crate) fn sentences(&self) -> String {
        let all: Vec<&str> = self.diagnostics.iter().map(|d| d.message.as_str()).collect();
        all.join("; ")
    }

    /// Adds what to do about the first problem.
    #[must_use]
    pub(crate) fn hint(mut self, hint: impl Into<String>) -> Self {
        if let Some(first) = self.diagnostics.first_mut() {
            first.hints.push(hint.into());
        }
        self
    }
}

impl From<Refusal> for Failure {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(refusal)
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}
