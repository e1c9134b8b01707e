//! What the twin found: as JSON, as text for a terminal, as a page that people send to each other, as a page of plots and in the
//! formats of CI systems.
//!
//! [`Report::new`] takes everything it says from a [`sim::preflight::Preflight`]; hashes, times and
//! the name of who drew the pictures come from the caller. Nothing here computes a result.
//! `report.json` is in SI; mm, degrees and percent are on screens alone. The same input gives the
//! same bytes but for `provenance` and `timing`.

mod allow;
mod compare;
mod fill;
mod formats;
mod frame;
mod html;
mod human;
mod line;
mod metrics;
mod parts;
mod plots;
mod program;
mod quantity;
mod read;
mod results;
#[cfg(test)]
mod sample;
mod screen;
mod strands;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_allow;
#[cfg(test)]
mod tests_human;

pub use allow::{apply_allowances, fails};
pub use compare::{Baseline, Both, Change, Diff, Side, diff};
pub use formats::{concise, github, gitlab, junit, markdown, sarif, step_summary};
pub use frame::{Landing, LoadCase, Remedy, Stage, Yield, YieldCriterion};
pub use html::{EmbeddedPicture, Extras, PictureKind, page as html_page, view3d};
pub use human::human;
pub use parts::{
    Allowed, Assumption, Finding, Input, Phase, Provenance, Report, Scores, Severity, Site,
    StepTime, Timing, Totals, Verdict,
};
pub use plots::strands_page;
pub use program::{Budget, Cycle, Hose, Payload, Share, TcpSpeed, Tracking};
pub use read::{MAX_BYTES, ReadError, from_json};
pub use results::{Coverage, Ends, Motion, Nearest, Range, Strand, StrandMotion, WorstAt};

/// Value of `schema` in every report this version writes.
pub const SCHEMA: &str = "twin-report/1";

/// The report as JSON, indented, with a line feed at its end.
pub fn to_json(report: &Report) -> String {
    let mut text =
        serde_json::to_string_pretty(report).expect("structs and lists of finite numbers");
    text.push('\n');
    text
}

/// JSON Schema (draft 2020-12) of what [`to_json`] writes.
pub fn schema() -> serde_json::Value {
    let settings = schemars::generate::SchemaSettings::draft2020_12().for_serialize();
    settings.into_generator().into_root_schema_for::<Report>().to_value()
}
