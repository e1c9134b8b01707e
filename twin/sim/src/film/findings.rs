//! Findings as eyes and recordings show them.

use super::{Film, FilmStrand};
use crate::finding::{self, Bound, Phase, Severity};
use crate::interval::Interval;
use crate::pose::Point;
use crate::preflight::Preflight;
use crate::scene::MarkSeverity;

/// A finding as a place and a time.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmFinding {
    /// Its code.
    pub code: &'static str,
    /// How bad it is.
    pub severity: MarkSeverity,
    /// When to look, s: its own time, or when its strand or stage is done.
    pub time_s: Option<f64>,
    /// Where, part axes.
    pub at: Option<Point>,
    /// Where that which should be there is instead, part axes.
    pub found: Option<Point>,
    /// How far past its limit, as a share of it; what must not happen at all is past it by more than any other.
    pub excess: f64,
    /// The strand, by printing order.
    pub strand: Option<usize>,
    /// The bodies concerned, by name.
    pub bodies: Vec<String>,
    /// Value against limit in a few words, such as "0.31 mm, limit 1 mm".
    pub words: String,
    /// Whether the place lies on the part: in transit it is the nozzle's, far from what a picture of the part shows.
    pub shown_on_part: bool,
}

impl Film {
    /// Findings that can be shown, by their places in the list, the worst first, errors before warnings; the worst of each
    /// code before a second of any, which says more than six of one.
    pub fn one_of_each_code_first(
        &self,
        can_be_shown: impl Fn(&FilmFinding) -> bool,
    ) -> impl Iterator<Item = usize> {
        let mut codes: Vec<&str> = Vec::new();
        let all = 0..self.findings.len();
        let mut shown: Vec<usize> = all.filter(|&at| can_be_shown(&self.findings[at])).collect();
        let of = |at: usize| &self.findings[at];
        shown.sort_by(|&a, &b| {
            let by_severity = of(b).severity.cmp(&of(a).severity);
            by_severity.then(of(b).excess.total_cmp(&of(a).excess)).then(a.cmp(&b))
        });
        let (first, more): (Vec<usize>, Vec<usize>) = shown.into_iter().partition(|&index| {
            let code = self.findings[index].code;
            let is_new = !codes.contains(&code);
            codes.extend(is_new.then_some(code));
            is_new
        });
        first.into_iter().chain(more)
    }
}

pub(super) fn film_finding(
    preflight: &Preflight,
    film: &Film,
    order_of: &[Option<usize>],
    finding: &finding::Finding,
) -> FilmFinding {
    let site = &finding.site;
    let order = site.strand.and_then(|strand| order_of[strand]);
    let strand = order.map(|order| &preflight.deposit.strands[order]);
    let built = &preflight.growth.built.frame;
    let node =
        site.node.or_else(|| site.member.and_then(|m| Some(built.members().get(m)?.ends[0])));
    let at = site
        .point
        .or_else(|| {
            strand.filter(|s| s.at_m.len() > 1).zip(site.at_m).map(|(s, at_m)| s.printed_at(at_m))
        })
        .or_else(|| built.nodes().get(node?).copied())
        .or_else(|| {
            film.strands.get(order?).and_then(|s| s.points.get(s.points.len() / 2).copied())
        });
    let of_stage =
        |printed: usize| film.strands.get(printed.checked_sub(1)?).and_then(FilmStrand::done_s);
    let time_s = finding
        .time_s
        .or_else(|| of_stage(site.stage?))
        .or_else(|| film.strands.get(order?)?.done_s())
        .filter(|time_s| time_s.is_finite());
    FilmFinding {
        code: finding.code.as_str(),
        severity: match finding.severity {
            Severity::Error => MarkSeverity::Error,
            Severity::Warning => MarkSeverity::Warning,
        },
        time_s,
        at,
        found: site.found,
        excess: excess(finding),
        strand: order,
        bodies: site.bodies.clone(),
        words: words(finding),
        shown_on_part: site.phase != Some(Phase::Transit),
    }
}

fn excess(finding: &finding::Finding) -> f64 {
    let Interval { nominal, low, high } = finding.measured;
    let past = |value: f64| match finding.code.bound() {
        Bound::Upper => value - finding.limit,
        Bound::Lower => finding.limit - value,
        Bound::Forbidden => f64::INFINITY,
    };
    let past = match finding.severity {
        Severity::Error => past(nominal),
        Severity::Warning => past(low).max(past(high)),
    };
    let share = past / finding.limit.abs();
    if share.is_nan() { 0.0 } else { share }
}

/// Value against limit, on a screen's units; what must not happen in its own words.
fn words(finding: &finding::Finding) -> String {
    if finding.code.bound() == Bound::Forbidden {
        return finding.code.title().to_owned();
    }
    let (factor, unit) = match finding.unit {
        "m" => (1e3, " mm"),
        "rad" => (180.0 / std::f64::consts::PI, "°"),
        _ => (1.0, ""),
    };
    let told = |value: f64| {
        let value = value * factor;
        let digits =
            if value == 0.0 { 0.0 } else { (2.0 - value.abs().log10().floor()).clamp(0.0, 4.0) };
        let text = format!("{value:.*}", digits as usize);
        match text.contains('.') {
            true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
            false => text,
        }
    };
    let limit = told(finding.limit);
    match finding.measured.nominal.is_finite() {
        true => format!("{}{unit}, limit {limit}{unit}", told(finding.measured.nominal)),
        false => format!("limit {limit}{unit}"),
    }
}
