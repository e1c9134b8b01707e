//! What a recording tells, in order of time, before any of it is written.

use sim::film::{Film, FilmStrand, Player};
use sim::finding::Phase;

/// Most poses a second.
const POSES_A_SECOND: f64 = 25.0;
/// Most poses of a recording.
const POSES_MAX: usize = 200_000;
/// Longest time between poses of a short program, s: a viewer does not look ahead to turn a joint evenly.
const GAP_S: f64 = 0.2;
/// In a long program as many poses as this fill the gaps.
const FILLED: f64 = 20_000.0;
/// About the most pieces all strands are cut into: each is a thing of its own to a viewer.
const PIECES_MAX: usize = 2_000;
/// How often all that lies there is told anew.
const SNAPSHOTS: usize = 16;
/// Shortest time of a piece but for the end of a strand, s.
const PIECE_S: f64 = 0.25;

/// Something to tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Item {
    /// What never changes: cell, frames at rest, the robot's description.
    Cell,
    /// Poses, joints and numbers at this time.
    Pose,
    /// A leg of the film begins.
    Leg(usize),
    /// The arm waits.
    Wait,
    /// The program is over.
    Done,
    /// A strand begins.
    Strand(usize),
    /// A piece of a strand lies there: strand, its first and its last point.
    Piece(usize, usize, usize),
    /// All that lies there by now. A viewer that jumps in time is given the last message of each topic only.
    Printed,
    /// A body is taken away.
    Gone(usize),
    /// A finding.
    Finding(usize),
    /// A picture.
    Picture(usize),
}

/// Something to tell and when, s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Due {
    /// When, s from the start of the program.
    pub(crate) time_s: f64,
    /// What.
    pub(crate) item: Item,
}

/// All there is to tell, in order of time; what is due together in the order of [`Item`]. `pictures_s` are the times of the
/// pictures.
pub(crate) fn agenda(film: &Film, player: &Player<'_>, pictures_s: &[f64]) -> Vec<Due> {
    let mut all = Vec::new();
    let mut add = |time_s: f64, item: Item| {
        // what has no time is known from the start
        let time_s = if time_s.is_finite() { time_s.max(0.0) } else { 0.0 };
        all.push(Due { time_s, item });
    };
    add(0.0, Item::Cell);
    pose_times(film, player).into_iter().for_each(|time_s| add(time_s, Item::Pose));
    let mut until_s = 0.0;
    for (index, leg) in film.legs.iter().enumerate() {
        if leg.from_s > until_s + 1e-6 {
            add(until_s, Item::Wait);
        }
        add(leg.from_s, Item::Leg(index));
        until_s = leg.to_s.max(until_s);
    }
    add(film.total_s.max(until_s), Item::Done);
    for (index, strand) in film.strands.iter().enumerate() {
        if let Some(born_s) = strand.born_s() {
            add(born_s, Item::Strand(index));
        }
    }
    for (strand, from, to) in pieces(&film.strands) {
        add(film.strands[strand].time_s[to], Item::Piece(strand, from, to));
    }
    (1..=SNAPSHOTS).for_each(|k| add(film.total_s * k as f64 / SNAPSHOTS as f64, Item::Printed));
    for (index, body) in film.bodies.iter().enumerate() {
        if let Some(gone_s) = body.gone_s {
            add(gone_s, Item::Gone(index));
        }
    }
    for (index, finding) in film.findings.iter().enumerate() {
        add(finding.time_s.unwrap_or(0.0), Item::Finding(index));
    }
    for (index, time_s) in pictures_s.iter().enumerate() {
        add(*time_s, Item::Picture(index));
    }
    all.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
    all
}

/// Times at which poses are told: moments of the motion, thinned and filled up.
fn pose_times(film: &Film, player: &Player<'_>) -> Vec<f64> {
    let room = (film.total_s * POSES_A_SECOND).clamp(2.0, POSES_MAX as f64 / 2.0);
    let gap_s = GAP_S.max(film.total_s / FILLED);
    let mut times = vec![0.0];
    for time_s in player.key_times(room as usize) {
        let last_s = times[times.len() - 1];
        if !(time_s - last_s >= 1.0 / POSES_A_SECOND) {
            continue;
        }
        let more = ((time_s - last_s) / gap_s).ceil().min(POSES_MAX as f64) as usize;
        times.extend((1..more).map(|k| last_s + (time_s - last_s) * k as f64 / more as f64));
        times.push(time_s);
    }
    if film.total_s > times[times.len() - 1] {
        times.push(film.total_s);
    }
    times
}

/// Pieces of strands: strand, first and last point.
fn pieces(strands: &[FilmStrand]) -> Vec<(usize, usize, usize)> {
    let segments: usize = strands.iter().map(FilmStrand::segments).sum();
    let least = segments.div_ceil(PIECES_MAX).max(1);
    let mut all = Vec::new();
    for (index, strand) in strands.iter().enumerate() {
        let last = strand.segments().min(strand.time_s.len().saturating_sub(1));
        let mut from = 0;
        for to in 1..=last {
            let long = strand.time_s[to] - strand.time_s[from] >= PIECE_S;
            if to == last || (to - from >= least && long) {
                all.push((index, from, to));
                from = to;
            }
        }
    }
    all
}

/// The word for a leg in both profiles.
pub(crate) fn phase_word(phase: Option<Phase>, done: bool) -> &'static str {
    match (phase, done) {
        (Some(phase), _) => phase.word(),
        (None, false) => "wait",
        (None, true) => "done",
    }
}
