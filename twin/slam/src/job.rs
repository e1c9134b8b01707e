//! `job.slam`: text to [`crate::Document`] and back.
//!
//! `syntax` (limits, comments, the tree) → `check` (the tree against [`crate::schema`]) →
//! `decode` (tree to document) → `meaning` (what one key says about another); `print` goes back.

mod check;
mod decode;
mod hints;
mod meaning;
mod print;
mod problems;
mod syntax;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_round_trip;

pub use hints::nearest;
pub use print::print;

use crate::{Diagnostic, Document, Source};
use problems::Problems;

/// Largest file that is read, bytes.
pub const MAX_BYTES: usize = 64 << 20;
/// Largest number of strands in a job.
pub const MAX_STRANDS: usize = 200_000;
/// Largest number of points of all strands of a job.
pub const MAX_POINTS: usize = 5_000_000;
/// Deepest nesting of objects and lists; the format itself needs eight.
pub const MAX_DEPTH: usize = 32;
/// Problems listed for one file; a last one says how many more there are.
pub const MAX_PROBLEMS: usize = 100;

/// What to do about a problem that says no better.
const SEE_SCHEMA: &str = "`twin schema job` prints every key with its type, unit and range";

/// Reads a job. `Ok` carries warnings, `Err` all problems of the file, both in order of place.
///
/// Names of cell and material are not looked up; everything else that the text alone can show to
/// be wrong is refused.
pub fn parse(source: &Source) -> Result<(Document, Vec<Diagnostic>), Vec<Diagnostic>> {
    let only = |hint| move |problem: Box<Diagnostic>| vec![problem.or_hint(hint)];
    let root = syntax::tree(&source.text)
        .map_err(only("a job is JSON with // comments and trailing commas allowed"))?;
    check::version(&root).map_err(only("another release of twin reads it"))?;
    syntax::sizes(&root).map_err(only("split the job in two"))?;
    let mut problems = Problems::default();
    check::table(&root, &mut problems);
    let document = decode::document(&root);
    meaning::check(&document, &mut problems);
    let advised = |problems: Vec<Diagnostic>| {
        problems.into_iter().map(|problem| problem.or_hint(SEE_SCHEMA)).collect()
    };
    problems.finish().map(|warnings| (document, warnings)).map_err(advised)
}
