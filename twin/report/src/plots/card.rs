//! One strand: its findings, its numbers, its plots.

use super::quantities::rows;
use super::text::{LONGEST_ID, LONGEST_SENTENCE, counted, escaped};
use super::{ageing, course};
use crate::parts::{Finding, Severity};
use crate::results::{Ends, Strand};

/// Findings told of one strand.
const FINDINGS: usize = 8;

/// A strand with its place in printing order, from 1.
pub(super) fn card(order: usize, strand: &Strand, findings: &[&Finding]) -> String {
    let id = format!("s{order}");
    let line = strand.line.map_or(String::new(), |line| format!(", line {line} of the job"));
    let ends = match strand.ends {
        Ends::BothHeld => "joined at both ends",
        Ends::StartHeld => "joined where it begins",
        Ends::Resting => "lies on bed or form",
    };
    let panels = ageing::panels(strand, &id) + &course::views(strand, &id);
    format!(
        "<section id=\"{id}\"><h3><bdi>{}</bdi></h3><p>Strand {order}{line}; {ends}.</p>{}\
         <div class=\"plots\">{panels}</div>{}</section>",
        escaped(&strand.id, LONGEST_ID),
        told(findings),
        table(order, strand)
    )
}

/// Findings, one line each.
fn told(findings: &[&Finding]) -> String {
    if findings.is_empty() {
        return String::new();
    }
    let mut items = String::new();
    for finding in findings.iter().take(FINDINGS) {
        let (class, word) = match finding.severity {
            Severity::Error => ("error", "■ error"),
            Severity::Warning => ("warning", "▲ warning"),
        };
        items.push_str(&format!(
            "<li><b class=\"{class}\">{word} {}</b> {}</li>",
            escaped(&finding.code, LONGEST_ID),
            escaped(&finding.message, LONGEST_SENTENCE)
        ));
    }
    if let Some(more @ 1..) = findings.len().checked_sub(FINDINGS) {
        items.push_str(&format!("<li>and {} in report.json</li>", counted(more, "more finding")));
    }
    format!("<ul>{items}</ul>")
}

fn table(order: usize, strand: &Strand) -> String {
    let rows: String = rows(strand)
        .iter()
        .map(|(name, value)| format!("<tr><th scope=\"row\">{name}</th><td>{value}</td></tr>"))
        .collect();
    format!(
        "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"Values of strand {order}\"><table><caption>Expected value (low to high end)</caption><tbody>{rows}</tbody></table></div>"
    )
}
