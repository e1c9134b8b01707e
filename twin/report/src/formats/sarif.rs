//! SARIF 2.1.0, as GitHub's code scanning reads it.

use serde_json::{Value, json};
use sim::finding::Code;

use super::shared::{fingerprints, job_path, uri, worst_first};
use crate::line::one_line;
use crate::parts::{Finding, Report};
use crate::quantity::found;

/// Results of one run that GitHub takes; it shows the first 5000.
const RESULTS_MAX: usize = 25_000;
/// Largest sum of all results, bytes; GitHub takes 10 MB of gzip, and such text shrinks more than tenfold.
const BYTES_MAX: usize = 48 << 20;
/// Related places told of one result.
const RELATED_MAX: usize = 8;

/// One run with a rule per code, its help the page of `twin explain`, and a result per finding,
/// worst first. Fingerprints depend on path, code, strand, phase and bodies alone.
pub fn sarif(report: &Report, root: &str) -> String {
    let path = job_path(report, root);
    let writer = Writer { report, uri: uri(&path), lines: strand_lines(report) };
    let prints = fingerprints(report, root);
    let (mut results, mut bytes) = (Vec::new(), 0);
    for place in worst_first(report).into_iter().take(RESULTS_MAX) {
        let result = writer.result(&report.findings[place], &prints[place]);
        bytes += result.to_string().len();
        if bytes > BYTES_MAX {
            break;
        }
        results.push(result);
    }
    let left_out = report.findings.len() - results.len();
    let run = json!({
        "tool": { "driver": {
            "name": "twin",
            "version": one_line(&report.provenance.twin, 40),
            "rules": Code::ALL.map(rule).to_vec(),
        }},
        "automationDetails": { "id": format!("twin/{}/", category(&report.name)) },
        "artifacts": [artifact(report, &writer.uri)],
        "invocations": [{ "executionSuccessful": true }],
        "results": results,
        "columnKind": "unicodeCodePoints",
        "properties": {
            "verdict": report.verdict,
            "score": report.score,
            "findingsLeftOut": left_out,
        },
    });
    let log = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [run],
    });
    format!("{log}\n")
}

fn rule(code: Code) -> Value {
    let page = code.page();
    let body = page.split_once('\n').map_or(page, |(_, body)| body).trim();
    let first = body.split("\n\n").next().unwrap_or(body).replace('\n', " ");
    json!({
        "id": code.as_str(),
        "name": code.title(),
        "shortDescription": { "text": code.title() },
        "fullDescription": { "text": one_line(&first, 1000) },
        "help": { "text": page.trim(), "markdown": page.trim() },
        "defaultConfiguration": { "level": "error" },
        "properties": { "tags": [code.family().title()], "problem.severity": "error" },
    })
}

/// The job's name without what would end the category.
fn category(name: &str) -> String {
    one_line(name, 100).replace('/', "-")
}

fn artifact(report: &Report, uri: &str) -> Value {
    let mut artifact = json!({ "location": { "uri": uri }, "roles": ["analysisTarget"] });
    if let Some(job) = report.provenance.inputs.iter().find(|input| input.what == "job") {
        artifact["hashes"] = json!({ "sha-256": one_line(&job.sha256, 64) });
    }
    artifact
}

/// Lines of the strands, by id.
fn strand_lines(report: &Report) -> std::collections::BTreeMap<&str, usize> {
    let lines = report.strands.iter().filter_map(|strand| Some((strand.id.as_str(), strand.line?)));
    lines.collect()
}

struct Writer<'a> {
    report: &'a Report,
    uri: String,
    lines: std::collections::BTreeMap<&'a str, usize>,
}

impl Writer<'_> {
    fn result(&self, finding: &Finding, fingerprint: &str) -> Value {
        let mut result = json!({
            "ruleId": one_line(&finding.code, 16),
            "level": finding.severity.word(),
            "message": { "text": message(&self.text(finding)) },
            "locations": [self.location(finding)],
            "partialFingerprints": {
                "primaryLocationLineHash": format!("{fingerprint}:1"),
                "twin/v1": fingerprint,
            },
            "properties": numbers(finding),
        });
        let rule = Code::ALL.iter().position(|code| code.as_str() == finding.code);
        if let Some(rule) = rule {
            result["ruleIndex"] = json!(rule);
        }
        let related = self.related(finding);
        if !related.is_empty() {
            result["relatedLocations"] = Value::from(related);
        }
        if let Some(allowed) = &finding.allowed {
            let why = format!("until {}: {}", allowed.until, allowed.reason);
            result["suppressions"] = json!([{
                "kind": "inSource",
                "status": "accepted",
                "justification": one_line(&why, 1000),
            }]);
        }
        result
    }

    fn text(&self, finding: &Finding) -> String {
        let mut text = one_line(&finding.message, 1000);
        if let Some(found) = found(finding) {
            text.push_str(&format!("; found {found}"));
        }
        if !finding.hint.is_empty() {
            text.push_str(&format!(". Hint: {}", one_line(&finding.hint, 1000)));
        }
        text
    }

    fn physical(&self, line: usize) -> Value {
        json!({
            "artifactLocation": { "uri": self.uri },
            "region": { "startLine": line.max(1) },
        })
    }

    fn location(&self, finding: &Finding) -> Value {
        let mut location = json!({ "physicalLocation": self.physical(finding.line.unwrap_or(1)) });
        if let Some(strand) = &finding.site.strand {
            let strand = one_line(strand, 200);
            let job = one_line(&self.report.name, 200);
            location["logicalLocations"] = json!([{
                "name": strand,
                "fullyQualifiedName": format!("{job}/{strand}"),
                "kind": "element",
            }]);
        }
        location
    }

    /// The strands among the bodies.
    fn related(&self, finding: &Finding) -> Vec<Value> {
        let others =
            finding.site.bodies.iter().filter(|&body| finding.site.strand.as_ref() != Some(body));
        let lines = others.filter_map(|body| Some((body, *self.lines.get(body.as_str())?)));
        lines
            .take(RELATED_MAX)
            .enumerate()
            .map(|(id, (body, line))| {
                json!({
                    "id": id + 1,
                    "message": { "text": message(&format!("strand {}", one_line(body, 200))) },
                    "physicalLocation": self.physical(line),
                })
            })
            .collect()
    }
}

/// Text of a message, in which brackets would make links of what a job says.
fn message(text: &str) -> String {
    text.replace('\\', "\\\\").replace('[', "\\[").replace(']', "\\]")
}

fn numbers(finding: &Finding) -> Value {
    json!({
        "measured": finding.measured,
        "low": finding.low,
        "high": finding.high,
        "limit": finding.limit,
        "unit": one_line(&finding.unit, 16),
        "time_s": finding.time_s,
        "count": finding.count,
        "problem.severity": finding.severity.word(),
    })
}
