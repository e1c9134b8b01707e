//! The interactive 3-D view: a film packed into one string, the HTML around it, and the script that draws it.
//!
//! [`View3d::new`] packs, [`section`] writes the fragment, [`SCRIPT`] and [`STYLE`] go into the page once. The script
//! (WebGL 2, no library, no request) reads the string, draws, and talks to the page by events on `document`:
//! `twin:time`, `twin:finding` and `twin:theme`; tests and the page may call `window.twinView`.

mod blob;
mod bodies;
mod grid;
mod keys;
mod markup;
mod strands;
#[cfg(test)]
mod tests;

use super::base64::encode as base64;
use blob::Blob;
use keys::Keys;
use serde_json::{Map, Value, json};
use sim::film::{Film, FilmStrand, Player};
use sim::pose::is_finite_point;
use sim::preflight::Preflight;
use strands::Kept;

pub(crate) use markup::section;

/// The script, one function that is called at once.
pub(crate) const SCRIPT: &str = concat!(
    "(() => {\n'use strict';\n",
    include_str!("data.js"),
    include_str!("camera.js"),
    include_str!("shaders.js"),
    include_str!("draw.js"),
    include_str!("pointer.js"),
    include_str!("controls.js"),
    include_str!("viewer.js"),
    "})();\n"
);

/// The style, all of it below `#view3d`.
pub(crate) const STYLE: &str = include_str!("viewer.css");

/// The 3-D view of a checked job as a section of HTML of about `budget_bytes` at most, for [`crate::Extras::view`].
pub fn view3d(preflight: &Preflight, film: &Film, budget_bytes: usize) -> String {
    section(&View3d::new(preflight, film, budget_bytes))
}

/// Findings that are marked at most.
const FINDINGS_MAX: usize = 2000;
/// Characters of a name at most.
const NAME_MAX: usize = 60;

/// A film as the viewer reads it.
#[derive(Debug, Clone)]
pub(crate) struct View3d {
    /// What was left out to keep the file small, as a sentence; `None`: nothing.
    pub(crate) thinned: Option<String>,
    /// Words and titles of the quantities that strands can be coloured by.
    choices: Vec<(&'static str, String)>,
    /// Name of the job.
    job: String,
    total_s: f64,
    /// Heading and arrays as base64.
    data: String,
}

impl View3d {
    /// The film of a checked job in at most `budget_bytes` of text; at least a few kilobytes are always needed.
    pub(crate) fn new(preflight: &Preflight, film: &Film, budget_bytes: usize) -> View3d {
        let keys = Keys::of(&Player::new(preflight), film, bytes_of(budget_bytes) / 4);
        View3d::of(film, &keys, budget_bytes)
    }

    /// The same with the poses of the movers given.
    fn of(film: &Film, keys: &Keys, budget_bytes: usize) -> View3d {
        let room = bytes_of(budget_bytes);
        let mut said = Vec::new();
        let mut blob = Blob::default();
        let movers = keys.pack(film.movers.len(), &mut blob);
        let findings = findings(film, room / 8, &mut said);
        let mut names = Value::Array(film.strands.iter().map(|s| json!(cut(&s.id))).collect());
        if names.to_string().len() > room / 8 {
            said.push("strands have no names".to_owned());
            names = Value::Null;
        }
        let head = |key: &str, value: Value| (key.to_owned(), value);
        let mut told: Map<String, Value> = Map::from_iter([
            head("total_s", json!(film.total_s)),
            head("part", json!(film.part)),
            head("movers", movers),
            head("painted", painted(film)),
            head("findings", findings),
            head("names", names),
        ]);
        // the heading's own length, with room for the list of bodies and arrays
        let used = |blob: &Blob, told: &Map<String, Value>| {
            blob.len() + Value::Object(told.clone()).to_string().len() + 4096
        };
        let all = Kept::all(film);
        let left = room.saturating_sub(used(&blob, &told));
        // strands are what it is about: bodies take what they leave, yet always something
        let of_bodies = left.saturating_sub(all.bytes(film)).max(left * 2 / 5);
        let (bodies, coarse) = bodies::pack(film, of_bodies);
        if coarse > 0 {
            said.push(format!("{coarse} bodies are drawn coarser or not at all"));
        }
        told.insert("bodies".to_owned(), bodies::write(&bodies, &mut blob));
        let left = room.saturating_sub(used(&blob, &told));
        let kept = fitting(film, all, left, &mut said);
        told.insert("strands".to_owned(), strands::write(film, &kept, &mut blob));
        View3d {
            thinned: (!said.is_empty())
                .then(|| format!("To keep this file small, {} in the 3-D view.", said.join(", "))),
            choices: film
                .painted
                .iter()
                .map(|p| (p.quantity.word(), p.scale.title.clone()))
                .collect(),
            job: film.job.clone(),
            total_s: film.total_s,
            data: base64(&blob.finish(told)),
        }
    }
}

/// Bytes that fit in so much base64.
fn bytes_of(budget_bytes: usize) -> usize {
    budget_bytes / 4 * 3
}

/// The strands within `room` bytes: points that lie nearly on a line go first, then all between the ends, then strands.
fn fitting(film: &Film, all: Kept, room: usize, said: &mut Vec<String>) -> Kept {
    // ageing tables come on top of what is counted
    let room = room.saturating_sub(room / 8);
    if all.bytes(film) <= room {
        return all;
    }
    let many = all.segments();
    let mut kept = all;
    for share in [0.02, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, f64::INFINITY] {
        kept = strands::thinner(film, &kept, |strand: &FilmStrand| strand.radius_m * share);
        if kept.bytes(film) <= room {
            said.push(format!("{many} segments are drawn as {}", kept.segments()));
            return kept;
        }
    }
    let strands = kept.strands.len();
    let each = kept.bytes(film).div_ceil(strands.max(1));
    let fit = room / each.max(1);
    // evenly spread over the job
    let chosen = (0..fit).map(|k| kept.strands[k * strands / fit].clone());
    said.push(format!("{fit} of {strands} strands are drawn, from end to end"));
    Kept { strands: chosen.collect() }
}

/// Scales of the quantities.
fn painted(film: &Film) -> Value {
    let told = film.painted.iter().map(|painted| {
        let scale = &painted.scale;
        json!({
            "word": painted.quantity.word(),
            "source": strands::source(painted.quantity),
            "title": scale.title,
            "unit": scale.unit,
            "low": scale.low,
            "high": scale.high,
            "limit": scale.limit,
        })
    });
    Value::Array(told.collect())
}

/// Findings with their number in the report, the worst first where not all fit.
fn findings(film: &Film, room: usize, said: &mut Vec<String>) -> Value {
    let mut order: Vec<usize> = (0..film.findings.len()).collect();
    order.sort_by_key(|&k| std::cmp::Reverse(film.findings[k].severity));
    let mut left = room;
    let mut told: Vec<(usize, Value)> = Vec::new();
    for index in order.into_iter().take(FINDINGS_MAX) {
        let finding = &film.findings[index];
        let at = finding.at.filter(is_finite_point).map(|at| [at.x, at.y, at.z].map(shorter));
        let bodies: Vec<String> = finding.bodies.iter().take(4).map(|name| cut(name)).collect();
        let value = json!({
            "index": index,
            "code": finding.code,
            "kind": finding.severity.word(),
            "time_s": finding.time_s,
            "at": at,
            "strand": finding.strand,
            "bodies": bodies,
            "words": cut(&finding.words),
        });
        let bytes = value.to_string().len() + 1;
        if bytes > left {
            break;
        }
        left -= bytes;
        told.push((index, value));
    }
    if told.len() < film.findings.len() {
        said.push(format!("{} of {} findings are marked", told.len(), film.findings.len()));
    }
    told.sort_by_key(|(index, _)| *index);
    Value::Array(told.into_iter().map(|(_, value)| value).collect())
}

/// A place to 0.01 mm.
fn shorter(x_m: f64) -> f64 {
    (x_m * 1e5).round() / 1e5
}

/// A name no longer than is read.
fn cut(name: &str) -> String {
    match name.char_indices().nth(NAME_MAX) {
        Some((end, _)) => format!("{}…", &name[..end]),
        None => name.to_owned(),
    }
}
