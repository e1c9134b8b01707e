//! The program as stretches of time: what the arm does when.

use sim::film::Film;
use sim::finding::Phase;

use crate::parts::Report;
use crate::quantity::clock;

/// Stretches the script gets to know; a longer program is sampled.
const STRETCHES_MAX: usize = 4000;
/// Shorter pauses are no wait, s.
const PAUSE_S: f64 = 1e-6;

/// What the arm does, or that it does nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    Doing(Phase),
    Wait,
}

impl State {
    pub(super) const ALL: [Self; 6] = [
        Self::Doing(Phase::Approach),
        Self::Doing(Phase::Print),
        Self::Doing(Phase::Dwell),
        Self::Doing(Phase::Retract),
        Self::Doing(Phase::Transit),
        Self::Wait,
    ];

    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Doing(phase) => phase.word(),
            Self::Wait => "wait",
        }
    }
}

/// A stretch of the program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stretch {
    pub(super) from_s: f64,
    pub(super) to_s: f64,
    pub(super) state: State,
    /// Place in printing order.
    pub(super) strand: Option<usize>,
}

/// The program in order of time.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Course {
    pub(super) total_s: f64,
    pub(super) stretches: Vec<Stretch>,
    /// Names of strands in printing order.
    pub(super) strands: Vec<String>,
    /// Whether all states are known, rather than print alone.
    pub(super) is_whole: bool,
}

impl Course {
    /// From the film; without one, when strands are printed.
    pub(super) fn new(report: &Report, film: Option<&Film>) -> Self {
        let (legs, strands, total_s) = match film {
            Some(film) => {
                let ids = film.strands.iter().map(|strand| strand.id.clone()).collect();
                (of_film(film), ids, Some(film.total_s))
            }
            None => {
                let ids = report.strands.iter().map(|strand| strand.id.clone()).collect();
                (of_report(report), ids, report.totals.time_s)
            }
        };
        let end_s = legs.iter().map(|leg| leg.to_s).fold(0.0, f64::max);
        let total_s = total_s.filter(|total_s| total_s.is_finite()).unwrap_or(0.0).max(end_s);
        let is_whole = film.is_some();
        let stretches = if is_whole { with_waits(legs, total_s) } else { legs };
        Self { total_s, stretches, strands, is_whole }
    }

    /// Time spent in a state, s.
    pub(super) fn spent_s(&self, state: State) -> f64 {
        self.stretches.iter().filter(|it| it.state == state).map(|it| it.to_s - it.from_s).sum()
    }

    /// When the arm stands still between what it does.
    pub(super) fn waits(&self) -> impl Iterator<Item = [f64; 2]> {
        let waits = self.stretches.iter().filter(|it| it.state == State::Wait);
        waits.map(|it| [it.from_s, it.to_s])
    }

    /// What stands for all stretches: themselves, or one for each of many moments.
    pub(super) fn sampled(&self) -> Vec<Stretch> {
        if self.stretches.len() <= STRETCHES_MAX {
            return self.stretches.clone();
        }
        let slot_s = self.total_s / STRETCHES_MAX as f64;
        let mut sampled: Vec<Stretch> = Vec::new();
        for k in 0..STRETCHES_MAX {
            let from_s = k as f64 * slot_s;
            let next = self.stretches.partition_point(|it| it.to_s <= from_s + 0.5 * slot_s);
            let Some(at) = self.stretches.get(next) else { continue };
            match sampled
                .last_mut()
                .filter(|last| last.state == at.state && last.strand == at.strand)
            {
                Some(last) => last.to_s = from_s + slot_s,
                None => sampled.push(Stretch { from_s, to_s: from_s + slot_s, ..*at }),
            }
        }
        sampled
    }

    /// Unit of an axis of time and how many seconds it has.
    pub(super) fn unit(&self) -> (&'static str, f64) {
        match self.total_s {
            total_s if total_s > 10_800.0 => ("h", 3600.0),
            total_s if total_s > 300.0 => ("min", 60.0),
            _ => ("s", 1.0),
        }
    }

    /// Share of the program gone at a time, 0 to 1.
    pub(super) fn share(&self, time_s: f64) -> f64 {
        let share = time_s / self.total_s;
        if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }
    }
}

/// A moment in words: h:mm:ss, and tenths while a program is short.
pub(super) fn moment(time_s: Option<f64>) -> String {
    match time_s {
        Some(time_s) if time_s.abs() < 60.0 => format!("{time_s:.1} s"),
        time_s => clock(time_s),
    }
}

fn of_film(film: &Film) -> Vec<Stretch> {
    let known = film.legs.iter().filter(|leg| leg.from_s.is_finite() && leg.to_s.is_finite());
    let mut legs: Vec<Stretch> = known
        .map(|leg| Stretch {
            from_s: leg.from_s.max(0.0),
            to_s: leg.to_s.max(leg.from_s).max(0.0),
            state: State::Doing(leg.phase),
            strand: leg.strand,
        })
        .collect();
    legs.sort_by(|a, b| a.from_s.total_cmp(&b.from_s));
    legs
}

fn of_report(report: &Report) -> Vec<Stretch> {
    let legs = report.strands.iter().enumerate().filter_map(|(k, strand)| {
        let (from_s, to_s) = (strand.start_s?.max(0.0), strand.end_s?);
        (from_s.is_finite() && to_s >= from_s && to_s.is_finite()).then_some(Stretch {
            from_s,
            to_s,
            state: State::Doing(Phase::Print),
            strand: Some(k),
        })
    });
    let mut legs: Vec<Stretch> = legs.collect();
    legs.sort_by(|a, b| a.from_s.total_cmp(&b.from_s));
    legs
}

/// The arm waits where it does nothing else.
fn with_waits(legs: Vec<Stretch>, total_s: f64) -> Vec<Stretch> {
    let mut all: Vec<Stretch> = Vec::with_capacity(legs.len());
    let mut until_s = 0.0;
    let wait = |from_s: f64, to_s: f64| Stretch { from_s, to_s, state: State::Wait, strand: None };
    for leg in legs {
        if leg.from_s > until_s + PAUSE_S {
            all.push(wait(until_s, leg.from_s));
        }
        until_s = leg.to_s.max(until_s);
        all.push(leg);
    }
    if total_s > until_s + PAUSE_S {
        all.push(wait(until_s, total_s));
    }
    all
}
