//! What the script gets to know, as JSON inside the page.

use serde_json::{Value, json};

use super::course::{Course, State};
use super::traces::Plots;
use crate::plots::chart::Chart;
use crate::plots::text::cleaned;

/// Longest name of a strand.
const NAME: usize = 40;
/// Names told; a longer job counts its strands.
const NAMES: usize = 5000;

/// Total, stretches, names of strands, lines of plots.
pub(super) fn json(course: &Course, plots: &Plots) -> String {
    let stretches: Vec<Value> = course
        .sampled()
        .iter()
        .map(|it| {
            let state = State::ALL.iter().position(|state| *state == it.state);
            json!([milli(it.from_s), milli(it.to_s), state, it.strand])
        })
        .collect();
    let strands: Vec<String> = match course.strands.len() {
        n if n <= NAMES => course.strands.iter().map(|id| cleaned(id, NAME)).collect(),
        _ => Vec::new(),
    };
    let words: Vec<&str> = State::ALL.iter().map(|state| state.word()).collect();
    in_script(&json!({
        "total": course.total_s,
        "states": words,
        "stretches": stretches,
        "strands": strands,
        "plots": plots.data,
        "field": Chart::margins(),
    }))
}

/// To a millisecond.
fn milli(time_s: f64) -> f64 {
    (time_s * 1e3).round() / 1e3
}

/// JSON that cannot end its element, whatever it holds.
pub(super) fn in_script(value: &impl serde::Serialize) -> String {
    let json = serde_json::to_string(value).unwrap_or_else(|_| "null".to_owned());
    let mut out = String::with_capacity(json.len());
    for c in json.chars() {
        match c {
            // these stand in strings alone
            c if c.is_control() || matches!(c, '<' | '>' | '&' | '\u{2028}' | '\u{2029}') => {
                out.push_str(&format!("\\u{:04x}", u32::from(c)));
            }
            c => out.push(c),
        }
    }
    out
}
