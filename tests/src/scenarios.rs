//! Every scenario says what is found, where, and in which range; nothing else may be found.

use std::fs;
use std::path::Path;

use serde::Deserialize;
use serde_json::Value;

use crate::tools;

/// `expected.toml` of a scenario.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Expected {
    job: Vec<ExpectedJob>,
}

/// What one job of the scenario comes to.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ExpectedJob {
    file: String,
    verdict: String,
    exit: u8,
    #[serde(default)]
    finding: Vec<ExpectedFinding>,
    /// Values of the report by JSON pointer, with the range they lie in.
    #[serde(default)]
    value: Vec<ExpectedValue>,
}

/// Findings of one code. Whatever is not said may be anything.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ExpectedFinding {
    code: String,
    severity: String,
    strand: Option<String>,
    phase: Option<String>,
    bodies: Option<Vec<String>>,
    /// Range of the measured value, SI.
    measured: [f64; 2],
    /// Range of the arc length, m.
    at_m: Option<[f64; 2]>,
    /// How many findings this line stands for; one if not said.
    number: Option<[usize; 2]>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ExpectedValue {
    pointer: String,
    range: [f64; 2],
}

impl ExpectedFinding {
    /// Whether this line speaks of that finding; the ranges are not looked at.
    fn speaks_of(&self, finding: &Value) -> bool {
        let text =
            |pointer: &str| finding.pointer(pointer).and_then(Value::as_str).map(str::to_owned);
        let bodies = finding.pointer("/site/bodies").cloned().unwrap_or_default();
        text("/code").as_ref() == Some(&self.code)
            && text("/severity").as_ref() == Some(&self.severity)
            && (self.strand.is_none() || self.strand == text("/site/strand"))
            && (self.phase.is_none() || self.phase == text("/site/phase"))
            && self.bodies.as_ref().is_none_or(|names| serde_json::json!(names) == bodies)
    }

    fn complaints(&self, found: &[&Value]) -> Vec<String> {
        let [least, most] = self.number.unwrap_or([1, 1]);
        let mut complaints = Vec::new();
        if !(least..=most).contains(&found.len()) {
            complaints.push(format!("{self:?}: found {} times", found.len()));
        }
        let number =
            |finding: &Value, pointer: &str| finding.pointer(pointer).and_then(Value::as_f64);
        let inside = |range: [f64; 2], value: Option<f64>| {
            value.is_some_and(|v| v >= range[0] && v <= range[1])
        };
        for finding in found {
            let measured = number(finding, "/measured");
            if !inside(self.measured, measured) {
                complaints.push(format!(
                    "{} measured {measured:?}, not in {:?}",
                    self.code, self.measured
                ));
            }
            let at_m = number(finding, "/site/at_m");
            if self.at_m.is_some_and(|range| !inside(range, at_m)) {
                complaints.push(format!("{} at {at_m:?} m, not in {:?}", self.code, self.at_m));
            }
        }
        complaints
    }
}

/// What is wrong with one job of a scenario.
fn complaints(folder: &Path, expected: &ExpectedJob) -> Vec<String> {
    let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let out = tools::scratch(&format!("{name}-{}", expected.file));
    let (ran, report) = tools::check(&folder.join(&expected.file), &out);
    let Some(report) = report else { return vec![format!("no report: {}", ran.err)] };
    let mut complaints = Vec::new();
    if ran.code != expected.exit {
        complaints.push(format!("exit code {}, expected {}", ran.code, expected.exit));
    }
    if report["verdict"] != expected.verdict.as_str() {
        complaints.push(format!("verdict {}, expected {}", report["verdict"], expected.verdict));
    }
    let findings = report["findings"].as_array().cloned().unwrap_or_default();
    for line in &expected.finding {
        let spoken: Vec<&Value> =
            findings.iter().filter(|finding| line.speaks_of(finding)).collect();
        complaints.extend(line.complaints(&spoken));
    }
    for finding in &findings {
        if !expected.finding.iter().any(|line| line.speaks_of(finding)) {
            complaints
                .push(format!("not expected: {} {}", finding["severity"], finding["message"]));
        }
    }
    for value in &expected.value {
        let found = report.pointer(&value.pointer).and_then(Value::as_f64);
        if !found.is_some_and(|found| found >= value.range[0] && found <= value.range[1]) {
            complaints.push(format!("{} is {found:?}, not in {:?}", value.pointer, value.range));
        }
    }
    complaints
}

/// Row 3 of the issue: every scenario, exactly as its `expected.toml` says.
#[test]
fn every_scenario_finds_what_it_expects() {
    let mut failures = Vec::new();
    let mut n_jobs = 0;
    for folder in folders() {
        let text = fs::read_to_string(folder.join("expected.toml"))
            .unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        let expected: Expected =
            toml::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        assert!(folder.join("README.md").exists(), "{} has no README.md", folder.display());
        for job in &expected.job {
            n_jobs += 1;
            for complaint in complaints(&folder, job) {
                failures.push(format!("{}/{}: {complaint}", folder.display(), job.file));
            }
        }
    }
    assert!(n_jobs > 0, "there are scenarios");
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

/// Every code of the register is provoked by a scenario, and one close by stays clear of it.
#[test]
fn every_code_has_a_scenario_on_both_sides() {
    for code in sim::finding::Code::ALL {
        let code = code.as_str();
        let folder =
            tools::root().join("scenarios").join(format!("near-miss-{}", code.to_lowercase()));
        let text = fs::read_to_string(folder.join("expected.toml"))
            .unwrap_or_else(|error| panic!("{code}: {}: {error}", folder.display()));
        let expected: Expected =
            toml::from_str(&text).unwrap_or_else(|error| panic!("{code}: {error}"));
        let provokes = |job: &ExpectedJob| {
            job.finding.iter().any(|line| line.code == code && line.severity == "error")
        };
        assert!(expected.job.iter().any(provokes), "{code}: no job provokes it");
        assert!(expected.job.iter().any(|job| !provokes(job)), "{code}: no job stays clear of it");
    }
}

/// Folders of the scenarios, by name.
fn folders() -> Vec<std::path::PathBuf> {
    let entries = fs::read_dir(tools::root().join("scenarios")).expect("scenarios/ is there");
    let mut folders: Vec<_> =
        entries.filter_map(|entry| Some(entry.ok()?.path())).filter(|path| path.is_dir()).collect();
    folders.sort();
    folders
}
