//! The report in the formats of others.
//!
//! Every format lists the worst findings first: errors before warnings, then by how far past the
//! limit, then by time. `root` is the folder that paths are told from, written the way the job's
//! path is (both absolute, or both from the working folder; empty: the working folder). What a job
//! says is put on one line, clipped and escaped by the rules of each format.

mod concise;
mod github;
mod gitlab;
mod junit;
mod markdown;
mod mermaid;
mod sarif;
pub(crate) mod shared;
mod summary;
pub(crate) mod tables;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_any;
#[cfg(test)]
mod tests_junit;
mod xml;

pub use concise::concise;
pub use github::github;
pub use gitlab::gitlab;
pub use junit::junit;
pub use markdown::markdown;
pub use sarif::sarif;
pub use summary::step_summary;
