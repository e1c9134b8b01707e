//! Where answers and complaints go.

use std::io::{self, Write};
use std::path::PathBuf;

use slam::{Diagnostic, Source};

/// The two streams of the program, and what is known about who reads them.
pub struct Screen<'a> {
    /// Answers.
    pub out: &'a mut dyn Write,
    /// Complaints and progress.
    pub err: &'a mut dyn Write,
    /// Whether a person reads the answers as they come.
    pub out_is_terminal: bool,
    /// Whether a person reads the complaints as they come.
    pub err_is_terminal: bool,
    /// Whether a terminal may be written to in colour (`NO_COLOR`).
    pub colour_asked: bool,
    /// The process that draws; `None`: this one.
    pub drawer: Option<::render::Drawer>,
    /// GitHub's runner, where it reads what is printed: annotations and a step summary are written for it.
    pub github: Option<GitHub>,
}

/// What GitHub's runner has told of itself.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct GitHub {
    /// File that the step's summary is added to.
    pub summary: Option<PathBuf>,
}

/// Width of answers where `COLUMNS` does not say, characters.
const WIDTH: usize = 100;

impl<'a> Screen<'a> {
    /// Two streams that nobody watches.
    pub fn quiet(out: &'a mut dyn Write, err: &'a mut dyn Write) -> Self {
        Self {
            out,
            err,
            out_is_terminal: false,
            err_is_terminal: false,
            colour_asked: false,
            drawer: None,
            github: None,
        }
    }
}

impl Screen<'_> {
    /// Tells diagnostics: with the lines they are about on a terminal, else one line each.
    pub(crate) fn say(&mut self, source: &Source, diagnostics: &[Diagnostic]) -> io::Result<()> {
        if self.err_is_terminal {
            return write!(self.err, "{}", source.fancy(diagnostics, self.colour_asked));
        }
        for diagnostic in diagnostics {
            writeln!(self.err, "{}", source.plain(diagnostic))?;
        }
        Ok(())
    }

    /// Width of answers, characters.
    pub(crate) fn width(&self) -> usize {
        let columns = std::env::var("COLUMNS").ok().and_then(|text| text.parse().ok());
        columns.filter(|_| self.out_is_terminal).unwrap_or(WIDTH).clamp(40, 200)
    }
}
