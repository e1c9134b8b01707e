//! TOML with the place of every number: reading, and the checks serde cannot make.
//!
//! A text is read twice. serde turns it into the structs of the formats; a second pass walks the
//! same document with its places and holds each number against what it may be, so that every bad
//! number is reported at once, on its own line.

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::{Diagnostic, Source, Span};

mod reading;
pub(crate) mod shapes;

/// Reads a TOML format of ours and checks it; every problem with its place, in order of place.
pub(crate) fn parse_checked<T: DeserializeOwned>(
    source: &Source,
    check: impl FnOnce(Place<'_>, &mut Checks),
) -> Result<T, Vec<Diagnostic>> {
    let (document, faults) = DeTable::parse_recoverable(&source.text);
    if !faults.is_empty() {
        return Err(in_order(faults.iter().map(reading::syntax_fault).collect()));
    }
    let mut checks = Checks::default();
    let whole = Spanned::new(document.span(), DeValue::Table(document.get_ref().clone()));
    check(Place { node: &whole, name: "" }, &mut checks);
    match reading::structs_of::<T>(document) {
        Ok(value) if checks.problems.is_empty() => Ok(value),
        Ok(_) => Err(in_order(checks.problems)),
        Err(mut problems) => {
            problems.append(&mut checks.problems);
            Err(in_order(problems))
        }
    }
}

fn in_order(mut problems: Vec<Diagnostic>) -> Vec<Diagnostic> {
    problems.sort_by_key(|problem| problem.span);
    problems.dedup();
    problems.into_iter().map(|problem| problem.or_hint(SEE_LIBRARY)).collect()
}

/// What to do about a problem that says no better.
const SEE_LIBRARY: &str = "compare with a file of the library; `twin doctor` lists them";

/// What one number may be.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Rule {
    /// Any number but `inf` and `nan`.
    Finite,
    /// More than zero.
    Positive,
    /// Zero or more.
    NotNegative,
    /// More than the first, at most the second.
    AboveUpTo(f64, f64),
    /// More than the first, less than the second.
    Between(f64, f64),
    /// From the first to the second, both allowed.
    FromTo(f64, f64),
}

impl Rule {
    /// What is wrong with `number`; `None`: nothing.
    fn refuses(self, number: f64) -> Option<String> {
        if !number.is_finite() {
            return Some("must be a finite number".to_owned());
        }
        let (allowed, says) = match self {
            Rule::Finite => (true, String::new()),
            Rule::Positive => (number > 0.0, "must be more than 0".to_owned()),
            Rule::NotNegative => (number >= 0.0, "must not be negative".to_owned()),
            Rule::AboveUpTo(low, high) => {
                (number > low && number <= high, format!("must be above {low} and at most {high}"))
            }
            Rule::Between(low, high) => {
                (number > low && number < high, format!("must be above {low} and below {high}"))
            }
            Rule::FromTo(low, high) => {
                (number >= low && number <= high, format!("must be from {low} to {high}"))
            }
        };
        (!allowed).then_some(says)
    }
}

/// A value of the document with its place and the key it stands under.
#[derive(Clone, Copy)]
pub(crate) struct Place<'d> {
    node: &'d Spanned<DeValue<'d>>,
    name: &'d str,
}

impl<'d> Place<'d> {
    /// Where it stands.
    pub(crate) fn span(self) -> Span {
        let span = self.node.span();
        Span { start: span.start, end: span.end }
    }

    /// The key it stands under.
    pub(crate) fn name(self) -> &'d str {
        self.name
    }

    /// The value under `key`; `None` where this is no table or lacks it (serde says so).
    pub(crate) fn get(self, key: &str) -> Option<Place<'d>> {
        self.entries().into_iter().find(|place| place.name == key)
    }

    /// Values of a table with their keys; empty for anything else.
    pub(crate) fn entries(self) -> Vec<Place<'d>> {
        let Some(table) = self.node.get_ref().as_table() else { return Vec::new() };
        table.iter().map(|(key, node)| Place { node, name: key.get_ref().as_ref() }).collect()
    }

    /// Values of an array, each under the array's own key; empty for anything else.
    pub(crate) fn items(self) -> Vec<Place<'d>> {
        let Some(array) = self.node.get_ref().as_array() else { return Vec::new() };
        array.iter().map(|node| Place { node, name: self.name }).collect()
    }

    /// The number written here.
    pub(crate) fn number(self) -> Option<f64> {
        match self.node.get_ref() {
            DeValue::Integer(whole) => {
                i64::from_str_radix(whole.as_str(), whole.radix()).ok().map(|whole| whole as f64)
            }
            DeValue::Float(float) => float.as_str().parse().ok(),
            _ => None,
        }
    }

    /// The numbers of an array of numbers; `None` if anything else is in it.
    pub(crate) fn numbers(self) -> Option<Vec<f64>> {
        self.items().into_iter().map(Place::number).collect()
    }

    /// Whether `true` is written here.
    pub(crate) fn is_true(self) -> bool {
        self.node.get_ref().as_bool() == Some(true)
    }

    /// The text written here.
    pub(crate) fn text(self) -> Option<&'d str> {
        self.node.get_ref().as_str()
    }
}

/// Collects what the second pass finds. A value that is missing or of the wrong type is left to
/// serde, so every method takes what may not be there.
#[derive(Default)]
pub(crate) struct Checks {
    problems: Vec<Diagnostic>,
}

impl Checks {
    /// Adds a problem.
    pub(crate) fn refuse(&mut self, problem: Diagnostic) {
        self.problems.push(problem);
    }

    /// Adds a problem at a place.
    pub(crate) fn error(&mut self, place: Place<'_>, message: String) {
        self.refuse(Diagnostic::error(place.span(), message));
    }

    /// Holds one number against a rule.
    pub(crate) fn number(&mut self, place: Option<Place<'_>>, rule: Rule) {
        let Some(place) = place else { return };
        let Some(number) = place.number() else { return };
        if let Some(says) = rule.refuses(number) {
            self.error(place, format!("`{}` {says}, not {number}", place.name));
        }
    }

    /// Holds every number of an array, or of arrays in it, against a rule.
    pub(crate) fn numbers(&mut self, place: Option<Place<'_>>, rule: Rule) {
        for item in place.map(Place::items).unwrap_or_default() {
            self.number(Some(item), rule);
            self.numbers(Some(item), rule);
        }
    }

    /// Holds `[nominal, low, high]` against a rule and its own order.
    pub(crate) fn interval(&mut self, place: Option<Place<'_>>, rule: Rule) {
        self.numbers(place, rule);
        let Some(place) = place else { return };
        if let Some([value, low, high]) = place.numbers().as_deref() {
            self.order(place, *value, *low, *high, "the order is [nominal, low, high]");
        }
    }

    /// Holds `{ value, low, high, source }` against a rule and its own order.
    pub(crate) fn ranged(&mut self, place: Option<Place<'_>>, rule: Rule) {
        let Some(place) = place else { return };
        let numbers = ["value", "low", "high"].map(|key| place.get(key));
        for number in numbers {
            if let Some(number) = number
                && let Some(says) = number.number().and_then(|number| rule.refuses(number))
            {
                self.error(number, format!("`{}` of `{}` {says}", number.name, place.name));
            }
        }
        self.text(place.get("source"), "say where the number comes from, or \"ours\"");
        if let [Some(value), Some(low), Some(high)] = numbers.map(|place| place?.number()) {
            self.order(place, value, low, high, "a range holds its nominal value");
        }
    }

    fn order(&mut self, place: Place<'_>, value: f64, low: f64, high: f64, hint: &str) {
        let name = place.name;
        if low > value {
            let says = format!("`{name}`: its low end {low} is above its nominal value {value}");
            self.refuse(Diagnostic::error(place.span(), says).hint(hint));
        }
        if value > high {
            let says = format!("`{name}`: its high end {high} is below its nominal value {value}");
            self.refuse(Diagnostic::error(place.span(), says).hint(hint));
        }
    }

    /// Refuses an empty text.
    pub(crate) fn text(&mut self, place: Option<Place<'_>>, hint: &str) {
        let Some(place) = place else { return };
        if place.text().is_some_and(|text| text.trim().is_empty()) {
            let says = format!("`{}` is empty", place.name);
            self.refuse(Diagnostic::error(place.span(), says).hint(hint));
        }
    }

    /// Refuses empty and repeated texts; `what` is one of the things they name.
    pub(crate) fn distinct(&mut self, places: &[Place<'_>], what: &str) {
        for (index, place) in places.iter().enumerate() {
            self.text(Some(*place), "give it a name");
            let name = place.text();
            if name.is_some() && places[..index].iter().any(|earlier| earlier.text() == name) {
                let name = name.unwrap_or_default();
                self.error(*place, format!("there are two {what} named `{name}`"));
            }
        }
    }
}
