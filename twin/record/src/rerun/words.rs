//! What is told in words: states, lines of the log, the report, pictures.

use super::FindingWords;
use super::cell::colour;
use super::tape::{Tape, packing, path};
use crate::RecordError;
use crate::paint::{self, Rgb};
use rerun::{EncodedImage, StateChange, StateConfiguration, TextDocument, TextLog, TextLogLevel};
use sim::film::Film;
use sim::scene::MarkSeverity;

/// Lines of each log.
const LINES_MAX: usize = 5_000;
/// Characters of a line.
const LINE_MAX: usize = 600;
/// States that are told.
const STATES_MAX: usize = 100_000;
/// Gaps between legs shorter than this are none, s.
const GAP_S: f64 = 1e-3;

/// States of the process with their colours.
const STATES: [(&str, Rgb); 6] = [
    ("print", [0x2E, 0x9E, 0x6B]),
    ("transit", [0x5B, 0x7D, 0xB1]),
    ("approach", [0x8F, 0xB3, 0xD9]),
    ("retract", [0xA9, 0x9B, 0xC9]),
    ("dwell", [0xE0, 0xB0, 0x3A]),
    ("wait", [0x6B, 0x72, 0x7C]),
];

/// What the arm is doing.
pub(super) fn state(tape: &Tape, film: &Film) -> Result<(), RecordError> {
    let at = path(["state", "process"]);
    let style = StateConfiguration::new()
        .with_values(STATES.map(|(word, _)| word))
        .with_colors(STATES.map(|(_, rgb)| colour(rgb)));
    tape.still(at.clone(), &style)?;
    let (times_s, words): (Vec<f64>, Vec<&str>) = states(film).into_iter().unzip();
    let rows = StateChange::new().with_state(words);
    tape.rows(at, &times_s, rows.columns_of_unit_batches().map_err(packing)?)
}

/// Changes of state, in order of time; an empty word after the end.
fn states(film: &Film) -> Vec<(f64, &'static str)> {
    let mut out: Vec<(f64, &'static str)> = Vec::new();
    let mut change = |time_s: f64, word: &'static str| {
        if time_s.is_finite() && out.last().is_none_or(|(_, last)| *last != word) {
            out.push((time_s, word));
        }
    };
    for (k, leg) in film.legs.iter().enumerate().take(STATES_MAX) {
        change(leg.from_s, leg.phase.word());
        match film.legs.get(k + 1) {
            Some(next) if next.from_s > leg.to_s + GAP_S => change(leg.to_s, "wait"),
            Some(_) => {}
            None => change(leg.to_s, ""),
        }
    }
    out
}

/// Findings, and the strands as they begin.
pub(super) fn log(
    tape: &Tape,
    film: &Film,
    findings: &[FindingWords<'_>],
) -> Result<(), RecordError> {
    let line = |(index, words): (usize, &FindingWords<'_>)| Line {
        time_s: film.findings.get(index).and_then(|finding| finding.time_s).unwrap_or(0.0),
        level: match words.severity {
            MarkSeverity::Error => TextLogLevel::ERROR,
            MarkSeverity::Warning => TextLogLevel::WARN,
            MarkSeverity::Note => TextLogLevel::INFO,
        },
        rgb: paint::severity(words.severity),
        text: match words.hint {
            "" => format!("{} {}", words.code, words.message),
            hint => format!("{} {} → {hint}", words.code, words.message),
        },
    };
    lines(tape, "findings", findings.iter().enumerate().map(line).collect())?;
    let n = film.strands.len();
    let begun = film.strands.iter().enumerate().filter_map(|(order, strand)| {
        Some(Line {
            time_s: strand.born_s()?,
            level: TextLogLevel::INFO,
            rgb: [0x9A, 0xA5, 0xB1],
            text: format!("strand {} of {n}: {}", order + 1, strand.id),
        })
    });
    lines(tape, "strands", begun.collect())
}

struct Line {
    time_s: f64,
    level: &'static str,
    rgb: Rgb,
    text: String,
}

/// Lines in order of time; more than [`LINES_MAX`] are cut, and the last line says so.
fn lines(tape: &Tape, name: &str, mut lines: Vec<Line>) -> Result<(), RecordError> {
    let more = lines.len().saturating_sub(LINES_MAX);
    lines.truncate(LINES_MAX);
    lines.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
    if more > 0 {
        let time_s = lines.last().map_or(0.0, |line| line.time_s);
        let text = format!("{more} more are not told here; the report has them");
        lines.push(Line { time_s, level: TextLogLevel::INFO, rgb: [0x9A, 0xA5, 0xB1], text });
    }
    let times_s: Vec<f64> = lines.iter().map(|line| line.time_s).collect();
    let short = |line: &Line| line.text.chars().take(LINE_MAX).collect::<String>();
    let rows = TextLog::update_fields()
        .with_many_text(lines.iter().map(short))
        .with_many_level(lines.iter().map(|line| line.level))
        .with_many_color(lines.iter().map(|line| colour(line.rgb)));
    tape.rows(path(["log", name]), &times_s, rows.columns_of_unit_batches().map_err(packing)?)
}

/// The report's text.
pub(super) fn report(tape: &Tape, markdown: &str) -> Result<(), RecordError> {
    tape.still(path(["report"]), &TextDocument::from_markdown(markdown))
}

/// Pictures at their times.
pub(super) fn pictures(tape: &Tape, pictures: &[(f64, Vec<u8>)]) -> Result<(), RecordError> {
    for (time_s, png) in pictures {
        let image = EncodedImage::from_file_contents(png.clone()).with_media_type("image/png");
        tape.at(path(["camera", "overview"]), *time_s, &image)?;
    }
    Ok(())
}
