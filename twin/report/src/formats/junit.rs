//! JUnit XML, in the dialect of Jenkins.

use std::collections::BTreeMap;

use sim::finding::{Code, Family};

use super::shared::{job_path, worst_first};
use super::xml::{escape, open};
use crate::human::place;
use crate::line::{allowed_words, one_line};
use crate::parts::{Finding, Report, Severity};
use crate::quantity::found;

/// Findings told of one code, of each kind; with the clipping below no report exceeds 20 MB.
const TOLD_MAX: usize = 20;

/// One suite per family of findings, one case per code, those that pass too, so that a server can
/// draw trends. An error is a failure; a warning is told in the case's output; a code with
/// findings that are let pass and no other error is skipped, and so is every code of a family in which
/// nothing was checked. A case that passes has no finding; whether its check concerned the job is not told.
pub fn junit(report: &Report, root: &str) -> String {
    let path = one_line(&job_path(report, root), 1000);
    let mut by_code: BTreeMap<&str, Vec<&Finding>> = BTreeMap::new();
    for place in worst_first(report) {
        let finding = &report.findings[place];
        by_code.entry(&finding.code).or_default().push(finding);
    }
    let writer = Writer { report, path };
    let mut suites: Vec<Suite> = Vec::new();
    for family in Family::ALL {
        let checked = report.scores.of(family).is_some();
        let codes = Code::ALL.into_iter().filter(|code| code.family() == family);
        let cases = codes.map(|code| {
            let found = by_code.remove(code.as_str()).unwrap_or_default();
            writer.case(family.title(), code.as_str(), code.title(), &found, checked)
        });
        let name = format!("{} {}", family.letter(), family.title());
        suites.push(Suite { name, cases: cases.collect() });
    }
    // of a newer twin's report
    let unknown = by_code.iter().take(Code::ALL.len());
    let cases: Vec<Case> = unknown
        .map(|(code, found)| {
            writer.case("other", &one_line(code, 16), &one_line(&found[0].title, 200), found, true)
        })
        .collect();
    if !cases.is_empty() {
        suites.push(Suite { name: "other".to_owned(), cases });
    }
    document(report, &suites)
}

struct Suite {
    name: String,
    cases: Vec<Case>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Outcome {
    Passed,
    Failed,
    Skipped,
}

struct Case {
    outcome: Outcome,
    xml: String,
}

fn count(cases: &[Case], outcome: Outcome) -> String {
    cases.iter().filter(|case| case.outcome == outcome).count().to_string()
}

fn document(report: &Report, suites: &[Suite]) -> String {
    let totals = |cases: &[Case], name: String| {
        vec![
            ("name", name),
            ("tests", cases.len().to_string()),
            ("failures", count(cases, Outcome::Failed)),
            ("errors", "0".to_owned()),
            ("skipped", count(cases, Outcome::Skipped)),
        ]
    };
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let sum = |outcome| {
        suites
            .iter()
            .flat_map(|suite| &suite.cases)
            .filter(move |case| case.outcome == outcome)
            .count()
    };
    let head = [
        ("name", format!("twin {}", one_line(&report.name, 200))),
        ("tests", suites.iter().map(|suite| suite.cases.len()).sum::<usize>().to_string()),
        ("failures", sum(Outcome::Failed).to_string()),
        ("errors", "0".to_owned()),
        ("time", format!("{:.3}", report.timing.total_s)),
    ];
    text.push_str(&open("testsuites", &head, ">\n"));
    for suite in suites {
        text.push_str("  ");
        text.push_str(&open("testsuite", &totals(&suite.cases, suite.name.clone()), ">\n"));
        for case in &suite.cases {
            text.push_str(&case.xml);
        }
        text.push_str("  </testsuite>\n");
    }
    text.push_str("</testsuites>\n");
    text
}

struct Writer<'a> {
    report: &'a Report,
    path: String,
}

impl Writer<'_> {
    fn case(
        &self,
        family: &str,
        code: &str,
        title: &str,
        found: &[&Finding],
        checked: bool,
    ) -> Case {
        let (allowed, counted): (Vec<&Finding>, Vec<&Finding>) =
            found.iter().partition(|finding| finding.allowed.is_some());
        let (errors, warnings): (Vec<&Finding>, Vec<&Finding>) =
            counted.iter().partition(|finding| finding.severity == Severity::Error);
        let outcome = match (errors.is_empty(), allowed.is_empty()) {
            (false, _) => Outcome::Failed,
            (true, false) => Outcome::Skipped,
            (true, true) if !checked && found.is_empty() => Outcome::Skipped,
            (true, true) => Outcome::Passed,
        };
        // a dot begins a class in the names of Java
        let job = one_line(&self.report.name, 200).replace('.', "_");
        let mut attributes = vec![
            ("name", format!("{code} {title}")),
            ("classname", format!("{job}.{family}")),
            ("file", self.path.clone()),
        ];
        let worst = found.first().and_then(|finding| finding.line);
        attributes.extend(worst.map(|line| ("line", line.to_string())));
        let mut xml = format!("    {}", open("testcase", &attributes, ">"));
        match outcome {
            Outcome::Failed => {
                let head =
                    [("message", one_line(&errors[0].message, 500)), ("type", code.to_owned())];
                xml.push_str(&open("failure", &head, ">"));
                xml.push_str(&escape(&self.told(&errors)).replace("&#10;", "\n"));
                xml.push_str("</failure>");
            }
            Outcome::Skipped => {
                let why = match allowed.first().and_then(|finding| finding.allowed.as_ref()) {
                    Some(allowed) => one_line(&allowed_words(allowed), 500),
                    None => "nothing of this family was checked".to_owned(),
                };
                xml.push_str(&open("skipped", &[("message", why)], "/>"));
            }
            Outcome::Passed => {}
        }
        let output = [self.told(&warnings), self.told(&allowed)].concat();
        if !output.is_empty() {
            let output = escape(&output).replace("&#10;", "\n");
            xml.push_str(&format!("<system-out>{output}</system-out>"));
        }
        xml.push_str("</testcase>\n");
        Case { outcome, xml }
    }

    /// The worst findings of a list, three lines each, and how many more there are.
    fn told(&self, findings: &[&Finding]) -> String {
        let mut text = String::new();
        for finding in findings.iter().take(TOLD_MAX) {
            let word = finding.severity.word();
            text.push_str(&format!("{word}: {}\n", one_line(&finding.message, 500)));
            text.push_str(&format!("  where: {}\n", one_line(&place(self.report, finding), 300)));
            if let Some(found) = found(finding) {
                text.push_str(&format!("  found: {found}\n"));
            }
            text.push_str(&format!("  hint: {}\n", one_line(&finding.hint, 500)));
            if let Some(allowed) = &finding.allowed {
                text.push_str(&format!("  {}\n", one_line(&allowed_words(allowed), 500)));
            }
        }
        if let Some(more @ 1..) = findings.len().checked_sub(TOLD_MAX) {
            text.push_str(&format!("and {more} more in report.json\n"));
        }
        text
    }
}
