//! The banner: feasible or not, the score, and what decided it.

use std::cmp::Ordering;

use sim::finding::{Bound, Code, Family};

use super::course::moment;
use super::{name, sentence};
use crate::parts::{Finding, Report, Scores, Severity, Verdict};
use crate::quantity::{against, counted, digits};

/// Heading of the page.
pub(super) fn banner(report: &Report) -> String {
    let (class, mark) = match report.verdict {
        Verdict::Feasible => ("good", "●"),
        Verdict::Infeasible => ("bad", "■"),
    };
    let score = report.score.map_or("–".to_owned(), |score| format!("{score:.0}"));
    format!(
        "<section id=\"verdict\" class=\"banner {class}\" aria-labelledby=\"verdict-h\">\
         <div><h1 id=\"verdict-h\">{}</h1>\
         <p class=\"verdict\"><span aria-hidden=\"true\">{mark}</span> {}</p>\
         <p class=\"why-so\">{}</p><p class=\"tally\">{}</p></div>\
         <div class=\"score\"><p><b>{score}</b> <span>of 100</span></p><p class=\"soft\">score; 50 is the limit</p></div>\
         </section>\n",
        name(&report.name),
        report.verdict.word().to_uppercase(),
        decided(report),
        tally(report)
    )
}

/// One sentence on what the verdict rests on.
fn decided(report: &Report) -> String {
    if let Some((index, worst)) = worst(report) {
        let values =
            against(worst).map_or(String::new(), |values| format!(": {}", sentence(&values)));
        let strand = worst
            .site
            .strand
            .as_ref()
            .map_or(String::new(), |id| format!(", on strand {}", name(id)));
        let time =
            worst.time_s.map_or(String::new(), |time_s| format!(", at {}", moment(Some(time_s))));
        let link = if index < super::findings::ROWS {
            format!("<a href=\"#finding-{}\">{}</a>", index + 1, sentence(&worst.code))
        } else {
            sentence(&worst.code)
        };
        return format!("Decided by {link} {}{values}{strand}{time}.", sentence(&worst.title));
    }
    match tightest(&report.scores) {
        Some((family, score)) => {
            let left = match score - 50.0 {
                left if left >= 50.0 => "half of the limit or more is left".to_owned(),
                left => format!("{} % of the limit is left", digits(left)),
            };
            format!("The smallest margin is in {}: {left}.", family.title())
        }
        None => "Nothing was held against a limit.".to_owned(),
    }
}

fn tally(report: &Report) -> String {
    let n =
        |severity| report.findings.iter().filter(|finding| finding.severity == severity).count();
    format!(
        "{}, {}.",
        counted(n(Severity::Error), "error"),
        counted(n(Severity::Warning), "warning")
    )
}

/// The error furthest past its limit, with its place in the report.
pub(super) fn worst(report: &Report) -> Option<(usize, &Finding)> {
    let errors = report
        .findings
        .iter()
        .enumerate()
        .filter(|(_, finding)| finding.severity == Severity::Error);
    errors.min_by(|a, b| margin(a.1).partial_cmp(&margin(b.1)).unwrap_or(Ordering::Equal))
}

/// Distance from the limit as a share of it, as the score counts it; negative: past it. What must not happen, or has no
/// end, is past it by half.
fn margin(finding: &Finding) -> f64 {
    let bound = Code::from_name(&finding.code).map_or(Bound::Upper, Code::bound);
    let known = finding.measured.zip(finding.limit).filter(|(_, limit)| *limit != 0.0);
    let margin = known.map(|(measured, limit)| match bound {
        Bound::Upper => (limit - measured) / limit,
        Bound::Lower => (measured - limit) / limit,
        Bound::Forbidden => -0.5,
    });
    margin.filter(|margin| margin.is_finite()).unwrap_or(-0.5)
}

/// The family with the lowest score.
fn tightest(scores: &Scores) -> Option<(Family, f64)> {
    let known = Family::ALL.into_iter().filter_map(|family| Some((family, scores.of(family)?)));
    known.reduce(|best, next| if next.1 < best.1 { next } else { best })
}

/// Scores by family as a table.
pub(super) fn scores(report: &Report) -> String {
    let rows: String = Family::ALL.into_iter().map(|family| score_row(report, family)).collect();
    format!(
        "<table class=\"scores\"><caption>Score by family: the worst margin of each; the mark on the bar is 50, the limit.</caption>\
         <thead><tr><th scope=\"col\">Family</th><th scope=\"col\" class=\"n\">Score</th>\
         <th scope=\"col\"><span class=\"sr\">as a bar</span></th><th scope=\"col\" class=\"n\">Errors</th>\
         <th scope=\"col\" class=\"n\">Warnings</th></tr></thead><tbody>{rows}</tbody></table>"
    )
}

fn score_row(report: &Report, family: Family) -> String {
    let own = |finding: &&Finding| finding.code.starts_with(family.letter());
    let n = |severity| {
        report.findings.iter().filter(own).filter(|finding| finding.severity == severity).count()
    };
    let score = report.scores.of(family);
    let (number, bar) = match score {
        Some(score) => {
            let class = if score < 50.0 { "gauge past" } else { "gauge" };
            let share = score.clamp(0.0, 100.0);
            (
                format!("{score:.0}"),
                format!(
                    "<span class=\"{class} half\" aria-hidden=\"true\"><i style=\"width:{share:.0}%\"></i></span>"
                ),
            )
        }
        None => ("–".to_owned(), "<span class=\"soft\">not checked</span>".to_owned()),
    };
    format!(
        "<tr><th scope=\"row\"><b class=\"letter\">{}</b> {}</th><td class=\"n\">{number}</td><td>{bar}</td>\
         <td class=\"n\">{}</td><td class=\"n\">{}</td></tr>",
        family.letter(),
        family.title(),
        n(Severity::Error),
        n(Severity::Warning)
    )
}
