//! A difference as text and Markdown.

use super::{Both, Change, Diff, ROUNDING};
use crate::formats::shared::{Tally, excess};
use crate::formats::tables::{heading, plain, row};
use crate::line::one_line;
use crate::parts::Finding;
use crate::quantity::{Unit, clock, digits, found};

/// Findings told of each kind.
const TOLD_MAX: usize = 50;

/// What is said of a list of findings, one sentence each.
struct Told {
    heading: String,
    lines: Vec<String>,
    more: usize,
}

impl Diff {
    /// For a terminal.
    pub fn to_text(&self) -> String {
        let (a, b) = (one_line(&self.a.name, 100), one_line(&self.b.name, 100));
        let mut text = format!("{a} -> {b}: {}\n", self.verdicts());
        for change in self.metrics.iter().filter(|change| change.is_one()) {
            let [name, a, b, by] = change.cells();
            let line = format!("  {name:<34} {a:>12} -> {b:>12}  {by}");
            text.push_str(line.trim_end());
            text.push('\n');
        }
        for told in self.told() {
            text.push_str(&format!("\n{}\n", told.heading));
            for line in &told.lines {
                text.push_str(&format!("  {line}\n"));
            }
            if told.more > 0 {
                text.push_str(&format!("  and {} more\n", told.more));
            }
        }
        text.push_str(&format!(
            "\n{} as before\n",
            crate::quantity::counted(self.n_same, "finding")
        ));
        text
    }

    /// For a page.
    pub fn to_markdown(&self) -> String {
        let (a, b) = (plain(&self.a.name, 100), plain(&self.b.name, 100));
        let mut page = format!("## {a} → {b}: {}\n\n", self.verdicts());
        page.push_str(&heading(&["figure", "A:", "B:", "change:"]));
        for change in self.metrics.iter().filter(|change| change.is_one()) {
            page.push_str(&row(&change.cells().map(|cell| plain(&cell, 200))));
        }
        for told in self.told() {
            page.push_str(&format!("\n### {}\n\n", told.heading));
            for line in &told.lines {
                page.push_str(&format!("- {}\n", plain(line, 700)));
            }
            if told.more > 0 {
                page.push_str(&format!("- and {} more\n", told.more));
            }
        }
        let same = crate::quantity::counted(self.n_same, "finding");
        page.push_str(&format!("\n{same} as before.\n"));
        page
    }

    /// As JSON, indented, with a line feed at its end.
    pub fn to_json(&self) -> String {
        let mut text =
            serde_json::to_string_pretty(self).expect("structs and lists of finite numbers");
        text.push('\n');
        text
    }

    fn verdicts(&self) -> String {
        let (a, b) = (self.a.verdict.word(), self.b.verdict.word());
        if a == b { format!("{b} as before") } else { format!("was {a}, is {b}") }
    }

    /// The lists that are not empty.
    fn told(&self) -> Vec<Told> {
        let list = |what: &str, findings: &[Finding]| Told {
            heading: format!("{what}: {}", Tally::of(findings.iter()).words()),
            lines: findings.iter().take(TOLD_MAX).map(sentence).collect(),
            more: findings.len().saturating_sub(TOLD_MAX),
        };
        let both = Told {
            heading: format!(
                "changed: {}",
                crate::quantity::counted(self.changed.len(), "finding")
            ),
            lines: self.changed.iter().take(TOLD_MAX).map(change_of).collect(),
            more: self.changed.len().saturating_sub(TOLD_MAX),
        };
        let all = [list("new", &self.added), list("gone", &self.gone), both];
        all.into_iter().filter(|told| !told.lines.is_empty()).collect()
    }
}

impl Change {
    /// Whether it changed by more than rounding, or came or went.
    fn is_one(&self) -> bool {
        match (self.a, self.b) {
            (Some(a), Some(b)) => (b - a).abs() > ROUNDING * a.abs(),
            (a, b) => a != b,
        }
    }

    /// Name, A, B, and by how much.
    fn cells(&self) -> [String; 4] {
        let unit = self.shown.0;
        let show = |value: Option<f64>| match (unit, value) {
            (_, None) => "–".to_owned(),
            (Unit::Second, _) => clock(value),
            _ => unit.show(value),
        };
        let sign = |value: f64| if value > 0.0 { "+" } else { "" };
        let absolute = self.absolute.map(|by| format!("{}{}", sign(by), unit.show(Some(by))));
        let relative = self.relative.map(|by| format!(" ({}{} %)", sign(by), digits(by * 100.0)));
        let by = absolute.unwrap_or_default() + &relative.unwrap_or_default();
        [self.name.clone(), show(self.a), show(self.b), by]
    }
}

fn sentence(finding: &Finding) -> String {
    let (code, message) = (one_line(&finding.code, 16), one_line(&finding.message, 500));
    let found = found(finding).map_or_else(String::new, |found| format!(" ({found})"));
    format!("{} {code} {message}{found}", finding.severity.word())
}

fn change_of(both: &Both) -> String {
    let (a, b) = (&both.a, &both.b);
    let word = match (excess(a), excess(b)) {
        _ if a.severity != b.severity => {
            format!("{} became {}", a.severity.word(), b.severity.word())
        }
        (before, after) if after > before => "worse".to_owned(),
        (before, after) if after < before => "better".to_owned(),
        _ => "other".to_owned(),
    };
    let unit = Unit::of(&b.code, &b.unit);
    let (code, message) = (one_line(&b.code, 16), one_line(&b.message, 500));
    format!(
        "{word}: {code} {message} (was {}, is {})",
        unit.show(a.measured),
        unit.show(b.measured)
    )
}
