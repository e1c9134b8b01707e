//! "Did you mean", and hashes of what was read.

use sha2::{Digest as _, Sha256};
use slam::Diagnostic;

/// Less alike than this is another word, not a slip.
const ALIKE: f64 = 0.75;
/// Longest list of names in a hint.
const MOST_NAMES: usize = 60;

/// Adds the nearest of the known names, and the list of them.
pub(crate) fn with_names(problem: Diagnostic, wrong: &str, known: &[String]) -> Diagnostic {
    let score = |name: &String| strsim::jaro_winkler(&wrong.to_lowercase(), &name.to_lowercase());
    let nearest = known.iter().max_by(|a, b| score(a).total_cmp(&score(b)));
    let problem = match nearest.filter(|name| score(name) > ALIKE) {
        Some(name) => problem.hint(format!("did you mean `{name}`?")),
        None => problem,
    };
    let left_out = known.len().saturating_sub(MOST_NAMES);
    let mut list = known.iter().take(MOST_NAMES).cloned().collect::<Vec<_>>().join(", ");
    if left_out > 0 {
        list.push_str(&format!(" and {left_out} more"));
    }
    problem.hint(if list.is_empty() {
        "there is none".to_owned()
    } else {
        format!("there is {list}")
    })
}

/// SHA-256 in hexadecimal.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A piece of somebody's text for a message: one line, clipped.
pub(crate) fn clipped(text: &str) -> String {
    const LONGEST: usize = 80;
    let clean: String =
        text.chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).take(LONGEST).collect();
    if text.chars().nth(LONGEST).is_some() { format!("{clean}…") } else { clean }
}
