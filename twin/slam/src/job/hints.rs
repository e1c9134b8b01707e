//! Guesses at what an author meant.

use crate::diagnostic::quoted;
use crate::schema::Table;
use crate::schema::keys::{NAMED_OBJECTS, SUFFIXES};

/// The candidate nearest to a misspelt name, if near enough.
pub fn nearest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    if name.len() > 80 {
        return None; // no typing error of a name of ours, and the distance costs its square
    }
    let allowed = (name.chars().count() / 3).max(1);
    candidates
        .map(|candidate| (strsim::damerau_levenshtein(name, candidate), candidate))
        .filter(|&(distance, _)| distance <= allowed)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// What to write instead of a key that the table does not know.
pub(super) fn unknown_key(name: &str, table: &Table) -> Option<String> {
    if let Some(hint) = other_unit(name, table) {
        return Some(hint);
    }
    let near = nearest(name, table.keys().map(|key| key.name));
    let elsewhere = || {
        let (owner, _) = NAMED_OBJECTS.iter().find(|(_, other)| other.key(name).is_some())?;
        Some(format!("this key belongs in \"{owner}\""))
    };
    near.map(|key| format!("did you mean {}?", quoted(key))).or_else(elsewhere)
}

/// For a key that differs from a known one in its unit alone: the unit that is expected.
fn other_unit(name: &str, table: &Table) -> Option<String> {
    let (stem, dimension, unit) = split_unit(name);
    let same_stem = || table.keys().filter(move |key| split_unit(key.name).0 == stem);
    let key = same_stem()
        .find(|key| split_unit(key.name).1 == dimension)
        .or_else(|| same_stem().find(|key| !split_unit(key.name).1.is_empty()))?;
    let expected = split_unit(key.name).2;
    let instead = if unit.is_empty() { String::new() } else { format!(", not {unit}") };
    Some(format!("did you mean {}? The unit here is {expected}{instead}", quoted(key.name)))
}

/// Stem, dimension and unit of a key; the last two empty where it carries none.
fn split_unit(name: &str) -> (&str, &'static str, &'static str) {
    let best = SUFFIXES
        .iter()
        .filter_map(|&(suffix, dimension, unit)| {
            name.strip_suffix(suffix).map(|stem| (stem, dimension, unit))
        })
        .filter(|(stem, ..)| !stem.is_empty())
        .min_by_key(|(stem, ..)| stem.len());
    best.unwrap_or((name, "", ""))
}
