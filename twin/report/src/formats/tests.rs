use std::collections::BTreeSet;

use serde_json::Value;

use super::shared::{excess, fingerprints, relative, uri, worst_first};
use super::*;
use crate::parts::{Allowed, Finding, Report, Severity, Site};
use crate::sample;

/// A report with so many findings: errors and warnings mixed, each worse than the one before.
pub(super) fn crowd(count: usize) -> Report {
    let mut report = sample::report();
    report.findings = (0..count)
        .map(|n| {
            let mut finding = if n % 3 == 0 { sample::near_stop() } else { sample::too_near() };
            finding.site.strand = Some(format!("strand-{n}"));
            finding.measured = finding.measured.map(|value| value - 1e-6 * n as f64);
            finding.line = Some(n + 1);
            finding.time_s = Some(n as f64 * 0.3);
            finding
        })
        .collect();
    report
}

fn allow(finding: &mut Finding) {
    finding.allowed = Some(Allowed {
        reason: "seen <on> the machine".to_owned(),
        until: "2027-01-31".to_owned(),
    });
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

#[test]
fn the_worst_comes_first() {
    let mut report = sample::report();
    let (near, stop) = (sample::too_near(), sample::near_stop());
    let nearer = Finding { measured: Some(-0.002), ..near.clone() };
    let earlier = Finding { time_s: Some(1.0), ..near.clone() };
    let endless = Finding { code: "P301".to_owned(), measured: None, ..near.clone() };
    report.findings = vec![stop, near, nearer, earlier, endless];
    assert_eq!(worst_first(&report), [4, 2, 3, 1, 0]);
    let share = |at: usize| excess(&report.findings[at]);
    assert!((share(1) - 0.69).abs() < 1e-12 && (share(2) - 3.0).abs() < 1e-12);
    assert!((share(0) - 1.0 / 3.0).abs() < 1e-12, "1° of 3° is lacking");
    let concise = concise(&report, "");
    let codes: Vec<&str> = concise.lines().filter_map(|line| line.split(' ').nth(2)).collect();
    assert_eq!(codes, ["P301", "C201", "C201", "C201", "R102"]);
}

#[test]
fn a_line_of_the_concise_format() {
    let mut report = sample::report();
    allow(&mut report.findings[1]);
    insta::assert_snapshot!(concise(&report, ""), @r"
    job.slam:12: error C201 nozzle comes within 0.31 mm of s3 in the print of strand `s7` (0.31 mm (-0.19 to 0.81), at least 1.00 mm; worst of 12)
    job.slam:12: note R102 joint a4 is 2.0° from its stop on strand `s7` at 4.0 mm (2.00°, at least 3.00°) (allowed until 2027-01-31 because: seen <on> the machine)
    ");
}

#[test]
fn paths_are_told_from_the_root() {
    for (path, root, told) in [
        ("/ci/repo/jobs/a.slam", "/ci/repo", "jobs/a.slam"),
        ("/ci/repo/jobs/a.slam", "/ci/repo/", "jobs/a.slam"),
        ("/ci/repo/./jobs/../a.slam", "/ci/x/../repo", "a.slam"),
        ("/ci/repository/a.slam", "/ci/repo", "/ci/repository/a.slam"),
        ("jobs/a.slam", "", "jobs/a.slam"),
        ("./jobs/a.slam", ".", "jobs/a.slam"),
        ("jobs/a.slam", "jobs", "a.slam"),
        ("jobs/a.slam", "/ci/repo", "jobs/a.slam"),
        ("../a.slam", "", "../a.slam"),
        ("/../../a.slam", "/", "a.slam"),
    ] {
        assert_eq!(relative(path, root), told, "{path} from {root}");
    }
    assert_eq!(uri("jobs/a b/ä%:#?.slam"), "jobs/a%20b/%C3%A4%25%3A%23%3F.slam");
    assert_eq!(uri("/ci/a.slam"), "file:///ci/a.slam");
}

#[test]
fn fingerprints_outlive_lines_and_numbers_and_are_never_twice() {
    let report = crowd(1000);
    let mut edited = report.clone();
    for finding in &mut edited.findings {
        finding.line = finding.line.map(|line| line + 40);
        (finding.measured, finding.time_s, finding.count) = (Some(0.1), None, 3);
        finding.message = "other words".to_owned();
    }
    let prints = fingerprints(&report, "");
    assert_eq!(prints, fingerprints(&edited, ""));
    assert_eq!(prints.iter().collect::<BTreeSet<_>>().len(), 1000);
    edited.findings[4].site.phase = None;
    assert_ne!(prints[4], fingerprints(&edited, "")[4]);
    let twins = Report { findings: vec![sample::too_near(); 3], ..sample::report() };
    assert_eq!(fingerprints(&twins, "").into_iter().collect::<BTreeSet<_>>().len(), 3);
}

#[test]
fn sarif_has_what_github_asks_for() {
    let mut report = sample::report();
    allow(&mut report.findings[1]);
    report.provenance.inputs[0].name = "/ci/repo/my jobs/a.slam".to_owned();
    let log = json(&sarif(&report, "/ci/repo"));
    assert_eq!(log["version"], "2.1.0");
    let run = &log["runs"][0];
    assert_eq!(run["automationDetails"]["id"], "twin/tower/");
    let rules = run["tool"]["driver"]["rules"].as_array().expect("rules");
    assert_eq!(rules.len(), sim::finding::Code::ALL.len());
    for rule in rules {
        assert!(rule["help"]["text"].as_str().is_some_and(|page| page.len() > 200), "{rule}");
        assert!(rule["fullDescription"]["text"].as_str().is_some_and(|text| text.len() > 20));
    }
    let results = run["results"].as_array().expect("results");
    assert_eq!(results.len(), 2);
    for (result, code) in results.iter().zip(["C201", "R102"]) {
        let rule = result["ruleIndex"].as_u64().expect("a rule") as usize;
        assert_eq!((&result["ruleId"], &rules[rule]["id"]), (&code.into(), &code.into()));
        let place = &result["locations"][0]["physicalLocation"];
        assert_eq!(place["artifactLocation"]["uri"], "my%20jobs/a.slam");
        assert_eq!(place["region"]["startLine"], 12);
        assert_eq!(result["locations"][0]["logicalLocations"][0]["fullyQualifiedName"], "tower/s7");
    }
    assert_eq!(results[0]["relatedLocations"][0]["message"]["text"], "strand s3");
    assert_eq!(results[0].get("suppressions"), None);
    assert_eq!(
        results[1]["suppressions"][0]["justification"],
        "until 2027-01-31: seen <on> the machine"
    );
}

#[test]
fn github_gets_ten_of_each_and_a_last_word() {
    let mut report = crowd(100);
    report.findings.iter_mut().rev().take(7).for_each(allow);
    let text = github(&report, "", "the step summary");
    let begins = |word: &str| text.lines().filter(|line| line.starts_with(word)).count();
    assert_eq!((begins("::error "), begins("::warning "), text.lines().count()), (10, 10, 21));
    assert_eq!(
        text.lines().last(),
        Some(
            "::notice title=twin::52 more errors, 21 more warnings, 7 allowed findings; see the step summary"
        )
    );
    let two = github(&sample::report(), "", "");
    insta::assert_snapshot!(two, @r"
    ::error title=C201 nozzle too near printed strands,file=job.slam,line=12::nozzle comes within 0.31 mm of s3 in the print of strand `s7`%0Afound: 0.31 mm (-0.19 to 0.81), at least 1.00 mm; worst of 12%0Ahint: print `s3` after this strand, tilt the nozzle away, or move one of them by 0.7 mm
    ::warning title=R102 too near a joint limit,file=job.slam,line=12::joint a4 is 2.0° from its stop on strand `s7` at 4.0 mm%0Afound: 2.00°, at least 3.00°%0Ahint: turn the spin
    ");
}

#[test]
fn gitlab_lists_what_is_not_let_pass() {
    let mut report = sample::report();
    allow(&mut report.findings[1]);
    let list = json(&gitlab(&report, ""));
    let entries = list.as_array().expect("a list");
    assert_eq!(entries.len(), 1);
    assert_eq!(entries[0]["severity"], "critical");
    assert_eq!(entries[0]["location"]["path"], "job.slam");
    assert_eq!(entries[0]["location"]["lines"]["begin"], 12);
    assert_eq!(entries[0]["fingerprint"].as_str().map(str::len), Some(32));
}

#[test]
fn the_summary_of_a_small_report() {
    let mut report = sample::report();
    allow(&mut report.findings[1]);
    report.findings.push(Finding { site: Site::default(), ..sample::too_near() });
    insta::assert_snapshot!(step_summary(&report, "report.json"), @r#"
    ## ❌ tower: infeasible, score 0 of 100

    2 errors, 0 warnings, 1 allowed.

    | family | score | errors | warnings | allowed |
    | --- | ---: | ---: | ---: | ---: |
    | R reach and motion | 80 | 0 | 0 | 1 |
    | C clearance | 0 | 2 | 0 | 0 |
    | P process | 55 | 0 | 0 | 0 |
    | S structure | 90 | 0 | 0 | 0 |
    | E program | – | 0 | 0 | 0 |

    ### Key figures

    | figure | value |
    | --- | ---: |
    | time | 1:02:03 |
    | time printing | 0:50:00 |
    | time dwelling | 0:02:00 |
    | time in transit | 0:10:03 |
    | length | 0.12 m |
    | mass | 0.88 g |
    | smallest clearance | 0.31 mm |
    | largest sag behind the nozzle | 0.42 mm |
    | largest sag once set | 0.020 mm |
    | largest displacement by weight, one-shot | 0.12 mm |
    | largest displacement by weight, staged | 0.080 mm |
    | strength used in members | 2.00 % |
    | strength used at nodes | 5.00 % |
    | least buckling factor | 45.0 |
    | load seat: deflection | 2.40 mm |
    | load seat: first yield at | 3.20 |
    | load seat: buckling at | 8.50 |

    ### Worst findings

    |  | code | where | what | found |
    | --- | --- | --- | --- | --- |
    | error | C201 | strand s7, at 12.5 mm, print, 0:01:23, job.slam:12 | nozzle comes within 0.31 mm of s3 in the print of strand \`s7\` | 0.31 mm (-0.19 to 0.81), at least 1.00 mm; worst of 12 |
    | error | C201 | 0:01:23, job.slam:12 | nozzle comes within 0.31 mm of s3 in the print of strand \`s7\` | 0.31 mm (-0.19 to 0.81), at least 1.00 mm; worst of 12 |

    ```mermaid
    xychart-beta
        title "findings along the program"
        x-axis "time, min" 0 --> 62.057
        y-axis "findings" 0 --> 2
        bar [2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]
    ```

    ### All findings by code

    | code |  | errors | warnings | allowed |
    | --- | --- | ---: | ---: | ---: |
    | C201 | nozzle too near printed strands | 2 | 0 | 0 |
    | R102 | too near a joint limit | 0 | 0 | 1 |
    "#);
}

#[test]
fn the_report_to_read_tells_all_parts() {
    let mut report = sample::report();
    allow(&mut report.findings[1]);
    let page = markdown(&report);
    for part in [
        "# tower: infeasible, score 0 of 100",
        "1 error, 0 warnings, 1 allowed.",
        "| C clearance | 0 | 1 | 0 | 0 |",
        "| smallest clearance | 0.31 mm |",
        "- **error C201 nozzle too near printed strands**: nozzle comes within",
        "  - allowed until 2027-01-31 because: seen &lt;on&gt; the machine",
        "| motion | no ramps. |",
        "| job | job.slam | 0000",
    ] {
        assert!(page.contains(part), "{part}\n{page}");
    }
}

/// The platforms' limits, with ten thousand findings.
#[test]
fn ten_thousand_findings_fit() {
    let report = crowd(10_000);
    let page = step_summary(&report, "report.json");
    assert!(page.len() < 1 << 20, "{}", page.len());
    assert!(page.contains("and 9950 more, in report.json") && page.contains("```mermaid"));
    assert_eq!(github(&report, "", "there").lines().count(), 21);
    let xml = junit(&report, "");
    assert!(xml.len() < 100_000, "{}", xml.len());
    assert!(xml.contains("and 6646 more in report.json"), "6666 of them are C201");
    let log = json(&sarif(&report, ""));
    assert_eq!(log["runs"][0]["results"].as_array().map(Vec::len), Some(10_000));
    let levels: Vec<&str> = log["runs"][0]["results"]
        .as_array()
        .expect("results")
        .iter()
        .filter_map(|result| result["level"].as_str())
        .collect();
    assert!(levels[..6666].iter().all(|&level| level == "error") && levels[6666] == "warning");
    assert_eq!(json(&gitlab(&report, "")).as_array().map(Vec::len), Some(10_000));
    assert_eq!(concise(&report, "").lines().count(), 10_000);
    assert!(markdown(&report).contains("and 9800 more in report.json"));
}

#[test]
fn sarif_stops_at_the_number_that_github_takes() {
    let log = json(&sarif(&crowd(25_010), ""));
    assert_eq!(log["runs"][0]["results"].as_array().map(Vec::len), Some(25_000));
    assert_eq!(log["runs"][0]["properties"]["findingsLeftOut"], 10);
}

#[test]
fn a_report_without_findings_is_whole_in_every_format() {
    let mut report = sample::report();
    report.findings.clear();
    report.totals.time_s = None;
    report.provenance.inputs.clear();
    assert_eq!((concise(&report, ""), github(&report, "", "x")), (String::new(), String::new()));
    assert_eq!(json(&gitlab(&report, "")), Value::Array(Vec::new()));
    assert_eq!(json(&sarif(&report, ""))["runs"][0]["results"], Value::Array(Vec::new()));
    assert!(markdown(&report).contains("None."));
    assert!(!step_summary(&report, "").contains("Worst"));
    assert!(junit(&report, "").contains("failures=\"0\""));
}

#[test]
fn severity_is_what_counts_in_github() {
    let mut report = sample::report();
    report.findings[0].severity = Severity::Warning;
    assert_eq!(github(&report, "", "x").matches("::warning ").count(), 2);
}
