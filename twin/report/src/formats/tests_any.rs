use proptest::prelude::*;

use super::tests_junit::cases;
use super::*;
use crate::parts::{Allowed, Report, Severity};
use crate::sample;

/// Text that wants to be more than text.
fn hostile() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        ".{0,6}",
        any::<char>().prop_map(String::from),
        prop::sample::select(vec![
            "\n",
            "\r\n",
            "\0",
            "\u{1b}[2J",
            "::error::",
            "::",
            "%0A",
            "%",
            "]]>",
            "<!--",
            "-->",
            "&amp;",
            "&#0;",
            "|",
            "`",
            "```",
            "[a](b)",
            "](",
            "<script>",
            "\u{202e}",
            "\u{2028}",
            "\u{feff}",
            "\u{ffff}",
            "\"",
            "'",
            "\\",
            "@team",
            "https://x.y",
            "www.x.y",
            "$x$",
            "**",
            "\t",
            "🙂",
            "e\u{301}",
        ])
        .prop_map(str::to_owned),
    ];
    prop::collection::vec(piece, 0..12).prop_map(|pieces| pieces.concat())
}

/// Every text of a report is hostile.
fn report() -> impl Strategy<Value = Report> {
    let texts = prop::collection::vec(hostile(), 16);
    (texts, any::<bool>(), any::<Option<usize>>()).prop_map(|(text, allowed, line)| {
        let mut report = sample::report();
        let take = |n: usize| text[n].clone();
        report.name = take(0);
        let finding = &mut report.findings[0];
        (finding.code, finding.title, finding.message) = (take(1), take(2), take(3));
        (finding.hint, finding.unit, finding.line) = (take(4), take(5), line);
        finding.site.strand = Some(take(6));
        finding.site.bodies = vec![take(7), take(8)];
        let reason = Allowed { reason: take(9), until: take(10) };
        let other = &mut report.findings[1];
        (other.message, other.site.strand) = (take(11), Some(take(6)));
        other.allowed = allowed.then_some(reason);
        (report.strands[0].id, report.loads[0].name) = (take(7), take(12));
        (report.assumptions[0].about, report.assumptions[0].text) = (take(13), take(14));
        (report.provenance.inputs[0].name, report.provenance.inputs[0].sha256) =
            (take(15), take(8));
        report.provenance.twin = take(9);
        report
    })
}

fn is_quiet(text: &str) -> bool {
    let forbidden = |c: char| {
        (c.is_control() && c != '\n')
            || ('\u{202a}'..='\u{202e}').contains(&c)
            || matches!(c, '\u{2028}' | '\u{feff}' | '\u{ffff}')
    };
    !text.contains(forbidden)
}

/// Pipes that part cells.
fn cells(row: &str) -> usize {
    row.replace("\\|", "").matches('|').count()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn lines_stay_lines(report in report(), rest in hostile()) {
        let concise = concise(&report, "");
        prop_assert_eq!(concise.split('\n').count(), 3, "{}", concise);
        prop_assert!(is_quiet(&concise));
        let text = github(&report, "", &rest);
        let n_allowed = report.findings.iter().filter(|finding| finding.allowed.is_some()).count();
        prop_assert_eq!(text.lines().count(), 2, "{}", &text);
        prop_assert!(is_quiet(&text));
        for (line, finding) in text.lines().zip(&report.findings).take(2 - n_allowed) {
            let word = if finding.severity == Severity::Error { "::error title=" } else { "::warning title=" };
            prop_assert!(line.starts_with(word));
            // what stands before the second `::` is properties alone
            let properties = line[2..].split_once("::").map(|(head, _)| head).unwrap_or_default();
            let (_, properties) = properties.split_once(' ').unwrap_or_default();
            let keys: Vec<&str> = properties.split(',').filter_map(|one| one.split('=').next()).collect();
            prop_assert_eq!(keys, ["title", "file", "line"]);
        }
    }

    #[test]
    fn xml_and_json_stay_well_formed(report in report()) {
        let all = cases(&junit(&report, ""));
        prop_assert!(all.len() >= sim::finding::Code::ALL.len());
        prop_assert!(all.iter().all(|case| is_quiet(&case.name)));
        let log: serde_json::Value = serde_json::from_str(&sarif(&report, "")).expect("JSON");
        let place = &log["runs"][0]["results"][0]["locations"][0]["physicalLocation"];
        prop_assert!(place["region"]["startLine"].as_u64().is_some_and(|line| line >= 1));
        let uri = place["artifactLocation"]["uri"].as_str().expect("a URI");
        prop_assert!(uri.bytes().all(|byte| byte.is_ascii_graphic() && !b"\"<>\\^`{|}".contains(&byte)), "{}", uri);
        let id = log["runs"][0]["automationDetails"]["id"].as_str().expect("an id");
        prop_assert_eq!(id.matches('/').count(), 2);
        let list: serde_json::Value = serde_json::from_str(&gitlab(&report, "")).expect("JSON");
        prop_assert!(list[0]["location"]["lines"]["begin"].as_u64().is_some_and(|line| line >= 1));
    }

    #[test]
    fn tables_keep_their_columns_and_pages_have_no_html(report in report(), rest in hostile()) {
        for page in [step_summary(&report, &rest), markdown(&report), crate::diff(&report, &sample::report()).to_markdown()] {
            prop_assert!(is_quiet(&page));
            let mut columns = 0;
            for line in page.lines() {
                if line.starts_with('|') {
                    columns = if columns == 0 { cells(line) } else { columns };
                    prop_assert_eq!(cells(line), columns, "{}", line);
                } else {
                    columns = 0;
                }
            }
            let outside = page.replace("```mermaid\n", "").replace("0 -->", "").replace("```\n", "");
            prop_assert!(!outside.contains('<') && !outside.contains('>'), "{}", page);
            for what in ["```", "](", "https://", "www."] {
                prop_assert!(!outside.replace("\\`", "").replace("\\]", "").contains(what), "{}: {}", what, page);
            }
        }
        let text = crate::human(&report, false, 80) + &crate::diff(&report, &sample::report()).to_text();
        prop_assert!(is_quiet(&text));
    }
}
