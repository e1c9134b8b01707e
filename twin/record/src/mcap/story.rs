//! What both profiles draw from.

use std::collections::BTreeMap;

use sim::film::{Film, FilmLeg, Player, Quantity, Trace, TraceOf, traces};
use sim::finding::{Finding, Severity};
use sim::preflight::Preflight;
use sim::scene::colours;

use super::agenda::{Due, Item, agenda};
use super::frames::Frames;
use super::text;

/// Everything a recording tells, and when.
pub(crate) struct Story<'a> {
    /// The checked job.
    pub(crate) preflight: &'a Preflight,
    /// Its film.
    pub(crate) film: &'a Film,
    /// Poses at any time.
    pub(crate) player: Player<'a>,
    /// Frames.
    pub(crate) frames: Frames,
    /// Names of joints.
    pub(crate) joints: Vec<String>,
    /// Pictures as PNG, with their times, s.
    pub(crate) pictures: &'a [(f64, Vec<u8>)],
    /// The robot's URDF.
    pub(crate) urdf: Option<&'a [u8]>,
    traces: Vec<Trace>,
}

impl<'a> Story<'a> {
    /// The story of a film of a checked job.
    pub(crate) fn new(
        preflight: &'a Preflight,
        film: &'a Film,
        pictures: &'a [(f64, Vec<u8>)],
        urdf: Option<&'a [u8]>,
    ) -> Self {
        Self {
            preflight,
            film,
            player: Player::new(preflight),
            frames: Frames::new(film),
            joints: super::frames::joint_names(film),
            pictures,
            urdf,
            traces: traces(preflight, film),
        }
    }

    /// All of it in order of time.
    pub(crate) fn agenda(&self) -> Vec<Due> {
        let pictures_s: Vec<f64> = self.pictures.iter().map(|(time_s, _)| *time_s).collect();
        agenda(self.film, &self.player, &pictures_s)
    }

    /// A trace at a time; `None` where it has no value.
    pub(crate) fn traced(&self, of: TraceOf, time_s: f64) -> Option<f64> {
        at(self.traces.iter().find(|trace| trace.of == of)?, time_s)
    }

    /// Phase, strand and its place in the order, where the item is one of the film's states.
    pub(crate) fn state(&self, item: Item) -> Option<(&'static str, String, usize)> {
        let leg: Option<&FilmLeg> = match item {
            Item::Leg(index) => Some(self.film.legs.get(index)?),
            Item::Wait | Item::Done => None,
            _ => return None,
        };
        let word = super::agenda::phase_word(leg.map(|leg| leg.phase), item == Item::Done);
        let order = leg.and_then(|leg| leg.strand);
        let strand = order.and_then(|order| self.film.strands.get(order));
        let id = strand.map_or(String::new(), |strand| text::name(&strand.id));
        Some((word, id, order.map_or(0, |order| order + 1)))
    }

    /// What a click on a strand's piece tells, as keys and values.
    pub(crate) fn facts(
        &self,
        order: usize,
        from: usize,
        to: usize,
    ) -> Vec<(&'static str, String)> {
        let Some(strand) = self.film.strands.get(order) else { return Vec::new() };
        let mut facts =
            vec![("strand", text::name(&strand.id)), ("order", (order + 1).to_string())];
        let born_s = strand.time_s.get(from).copied().unwrap_or_default();
        for quantity in [Quantity::Speed, Quantity::BeadWidth, Quantity::Temperature, Quantity::Sag]
        {
            // at birth, in the middle of the piece
            if let Some(value) = strand.value(order, (from + to) / 2, quantity, born_s) {
                let value = quantity.on_screen(value);
                facts.push((quantity.title(), format!("{value:.3} {}", quantity.unit())));
            }
        }
        facts
    }

    /// Mean diameter of a strand's piece as drawn, m.
    pub(crate) fn bead_m(&self, order: usize, from: usize, to: usize) -> f64 {
        let Some(strand) = self.film.strands.get(order) else { return 0.0 };
        let known = strand.bead_m.get(from..to).unwrap_or_default().iter();
        let known: Vec<f64> =
            known.copied().filter(|bead_m| *bead_m > 0.0 && bead_m.is_finite()).collect();
        let mean_m = known.iter().sum::<f64>() / known.len() as f64;
        if mean_m.is_finite() { mean_m } else { 2.0 * strand.radius_m }
    }

    /// A finding in full, and one line to read: code, message, what to do.
    pub(crate) fn finding(&self, index: usize) -> Option<(&'a Finding, String)> {
        let finding = self.preflight.findings().get(index)?;
        let hint = if finding.hint.is_empty() { "" } else { "\n" };
        let words = format!("{}: {}{hint}{}", finding.code.as_str(), finding.message, finding.hint);
        Some((finding, text::shown(&words, text::SENTENCE_MAX)))
    }

    /// What a click on a finding tells, as keys and values.
    pub(crate) fn finding_facts(&self, index: usize) -> Vec<(&'static str, String)> {
        let Some(place) = self.film.findings.get(index) else { return Vec::new() };
        let mut facts = vec![
            ("code", place.code.to_owned()),
            ("severity", place.severity.word().to_owned()),
            ("value", text::name(&place.words)),
        ];
        let strand = place.strand.and_then(|order| self.film.strands.get(order));
        facts.extend(strand.map(|strand| ("strand", text::name(&strand.id))));
        facts.extend(place.bodies.iter().map(|body| ("body", text::name(body))));
        facts
    }

    /// The first line of the log: the job and its verdict.
    pub(crate) fn headline(&self) -> String {
        let told = self.verdict();
        let word = |key: &str| told.get(key).map_or("", String::as_str);
        format!(
            "{}: {}, score {}, errors {}, warnings {}",
            text::name(&self.film.job),
            word("verdict"),
            word("score"),
            word("errors"),
            word("warnings")
        )
    }

    /// Verdict, score and what decided it.
    pub(crate) fn verdict(&self) -> BTreeMap<String, String> {
        let findings = self.preflight.findings();
        let count = |severity| findings.iter().filter(|f| f.severity == severity).count();
        let mut codes: BTreeMap<&str, usize> = BTreeMap::new();
        for finding in findings {
            *codes.entry(finding.code.as_str()).or_default() += 1;
        }
        let codes: Vec<String> =
            codes.iter().map(|(code, many)| format!("{code} {many}")).collect();
        let word = match self.preflight.verdict() {
            sim::finding::Verdict::Feasible => "feasible",
            sim::finding::Verdict::Infeasible => "infeasible",
        };
        let score =
            self.preflight.scores().total().map_or(String::new(), |score| format!("{score:.1}"));
        [
            ("verdict", word.to_owned()),
            ("score", score),
            ("errors", count(Severity::Error).to_string()),
            ("warnings", count(Severity::Warning).to_string()),
            ("findings", codes.join(", ")),
            ("time_s", format!("{:.3}", self.film.total_s)),
        ]
        .map(|(key, value)| (key.to_owned(), value))
        .into()
    }
}

/// A trace at a time; `None` before its first and, unless it holds, after its last value.
fn at(trace: &Trace, time_s: f64) -> Option<f64> {
    let known = trace.points.partition_point(|point| point[0] <= time_s);
    let [from_s, from] = *trace.points.get(known.checked_sub(1)?)?;
    let value = match trace.points.get(known) {
        Some([to_s, to]) if !trace.steps => {
            from + (to - from) * (time_s - from_s) / (to_s - from_s)
        }
        None if !trace.steps && time_s > from_s => return None,
        _ => from,
    };
    value.is_finite().then_some(value)
}

/// Colour of strands, sRGB.
pub(crate) const STRAND_COLOUR: u32 = colours::PLAIN;

/// Red, green and blue of a colour, 0 to 1.
pub(crate) fn rgb(colour: u32) -> [f64; 3] {
    colours::bytes(colour).map(|byte| f64::from(byte) / 255.0)
}
