//! Parts of pages in Markdown that summary and report share.

use std::collections::BTreeMap;

use sim::finding::Family;

use super::shared::Tally;
use crate::human::place;
use crate::line::{allowed_words, one_line};
use crate::metrics::{self, Metric};
use crate::parts::{Finding, Report};
use crate::quantity::{Unit, clock, found};

/// Kinds of findings counted in a table.
const CODES_MAX: usize = 60;

/// A text of others between words of ours: one line, nothing in it means anything to Markdown or HTML.
pub(crate) fn plain(text: &str, longest: usize) -> String {
    let mut plain = String::new();
    let line = one_line(text, longest);
    let mut rest = line.chars().peekable();
    while let Some(c) = rest.next() {
        match c {
            '&' => plain.push_str("&amp;"),
            '<' => plain.push_str("&lt;"),
            '>' => plain.push_str("&gt;"),
            // no links of bare addresses, no calls of people; times and lines of a file stay
            ':' if rest.peek().is_some_and(|next| !next.is_ascii_digit() && *next != ' ') => {
                plain.push_str("&#58;");
            }
            '@' => plain.push_str("&#64;"),
            '\\' | '`' | '*' | '_' | '{' | '}' | '[' | ']' | '#' | '|' | '~' | '$' | '!' => {
                plain.push('\\');
                plain.push(c);
            }
            'w' if plain.ends_with("ww") => plain.push_str("&#119;"),
            _ => plain.push(c),
        }
    }
    plain
}

/// One row of a table.
pub(crate) fn row(cells: &[String]) -> String {
    format!("| {} |\n", cells.join(" | "))
}

/// The two lines above the rows; a heading that ends in a colon is of a column of numbers.
pub(crate) fn heading(names: &[&str]) -> String {
    let cells: Vec<String> =
        names.iter().map(|name| name.trim_end_matches(':').to_owned()).collect();
    let rules: Vec<String> = names
        .iter()
        .map(|name| if name.ends_with(':') { "---:".to_owned() } else { "---".to_owned() })
        .collect();
    row(&cells) + &row(&rules)
}

/// `infeasible`, with the score.
pub(super) fn verdict(report: &Report) -> String {
    let word = report.verdict.word();
    match report.score {
        Some(score) => format!("{word}, score {score:.0} of 100"),
        None => word.to_owned(),
    }
}

/// Score and number of findings of each family.
pub(super) fn families(report: &Report) -> String {
    let mut table = heading(&["family", "score:", "errors:", "warnings:", "allowed:"]);
    for family in Family::ALL {
        let letter = family.letter();
        let of_family = |finding: &&Finding| finding.code.starts_with(letter);
        let tally = Tally::of(report.findings.iter().filter(of_family));
        let score = report.scores.of(family);
        let score = score.map_or_else(|| "–".to_owned(), |score| format!("{score:.0}"));
        table.push_str(&row(&[
            format!("{letter} {}", family.title()),
            score,
            tally.errors.to_string(),
            tally.warnings.to_string(),
            tally.allowed.to_string(),
        ]));
    }
    table
}

/// The figures that are known.
pub(super) fn figures(report: &Report) -> String {
    let mut table = heading(&["figure", "value:"]);
    for Metric { name, unit, value, .. } in metrics::figures(report) {
        let value = match (unit, value) {
            (_, None) => continue,
            (Unit::Second, _) => clock(value),
            _ => unit.show(value),
        };
        table.push_str(&row(&[plain(&name, 120), value]));
    }
    table
}

/// Findings as a table.
pub(super) fn findings<'a>(report: &Report, list: impl Iterator<Item = &'a Finding>) -> String {
    let mut table = heading(&["", "code", "where", "what", "found"]);
    for finding in list {
        table.push_str(&row(&[
            finding.severity.word().to_owned(),
            plain(&finding.code, 16),
            plain(&place(report, finding), 160),
            plain(&finding.message, 300),
            plain(&found(finding).unwrap_or_default(), 120),
        ]));
    }
    table
}

/// How many findings there are of each code.
pub(super) fn by_code(report: &Report) -> String {
    let mut codes: BTreeMap<&str, Vec<&Finding>> = BTreeMap::new();
    for finding in &report.findings {
        codes.entry(&finding.code).or_default().push(finding);
    }
    let mut table = heading(&["code", "", "errors:", "warnings:", "allowed:"]);
    for (code, list) in codes.iter().take(CODES_MAX) {
        let tally = Tally::of(list.iter().copied());
        table.push_str(&row(&[
            plain(code, 16),
            plain(&list[0].title, 120),
            tally.errors.to_string(),
            tally.warnings.to_string(),
            tally.allowed.to_string(),
        ]));
    }
    table
}

/// `allowed until … because: …`, if it is.
pub(super) fn allowed(finding: &Finding) -> Option<String> {
    finding.allowed.as_ref().map(|allowed| plain(&allowed_words(allowed), 400))
}
