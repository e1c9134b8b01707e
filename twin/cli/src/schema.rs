//! `twin schema`: the formats, for programs that write jobs and read reports.

use crate::FEASIBLE;
use crate::refusal::Failure;
use crate::screen::Screen;

/// Print the JSON Schema of a format
///
/// The schema of the job is also its table of keys: type, unit, range, default and a sentence for
/// each.
#[derive(Debug, clap::Args)]
pub(crate) struct Schema {
    /// Which format
    #[arg(value_enum)]
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    /// job.slam, without its comments and trailing commas
    Job,
    /// report.json
    Report,
}

impl Schema {
    pub(crate) fn run(self, screen: &mut Screen<'_>) -> Result<u8, Failure> {
        let schema = match self.format {
            Format::Job => slam::schema::job_schema(),
            Format::Report => report::schema(),
        };
        // `{:#}` of a JSON value is its indented text
        writeln!(screen.out, "{schema:#}")?;
        Ok(FEASIBLE)
    }
}
