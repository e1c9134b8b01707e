//! `twin diff`: what differs between two reports.

use std::path::{Path, PathBuf};

use report::{Baseline, Report, Severity};

use crate::refusal::{Failure, Refusal};
use crate::screen::Screen;
use crate::{FEASIBLE, FOUND, files};

/// Compare two reports
///
/// Tells verdict, figures and findings that differ between report.json of A and of B. Exits with 1 if B
/// has an error that A has not and that is not let pass, else with 0.
#[derive(Debug, clap::Args)]
pub(crate) struct Diff {
    /// Report to compare with
    #[arg(value_name = "A.json")]
    a: PathBuf,
    /// Report that is compared
    #[arg(value_name = "B.json")]
    b: PathBuf,
    /// What to print
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    /// Text for people
    Human,
    /// A page in Markdown
    Markdown,
    /// JSON for programs
    Json,
}

impl Diff {
    pub(crate) fn run(self, screen: &mut Screen<'_>) -> Result<u8, Failure> {
        let (a, b) = (read(&self.a)?, read(&self.b)?);
        let diff = report::diff(&a, &b);
        let text = match self.format {
            Format::Human => diff.to_text(),
            Format::Markdown => diff.to_markdown(),
            Format::Json => diff.to_json(),
        };
        screen.out.write_all(text.as_bytes())?;
        let worse = report::fails(&b, Severity::Error, Some(&Baseline::of(&a)));
        Ok(if worse { FOUND } else { FEASIBLE })
    }
}

/// A report from its file; also what `--baseline` reads.
pub(crate) fn read(path: &Path) -> Result<Report, Refusal> {
    let source = files::text(path, report::MAX_BYTES as u64)?;
    report::from_json(&source.text).map_err(|error| {
        Refusal::whole(&source.name, error.to_string())
            .hint("give the report.json that `twin check` wrote")
    })
}
