//! A run of the nozzle cut into steps, and the scenes of lamps within each.

use super::dose::Run;
use super::lights::{Lights, Scene, Station};

/// Finer pieces of a step where something happens within it.
pub(super) const FINE: usize = 16;
/// Instants of a step that are looked at.
pub(super) const MIDDLE: usize = 0;
pub(super) const END: usize = 1;
/// With the middle, the three of Gauss.
pub(super) const EARLY: usize = 2;
pub(super) const LATE: usize = 3;
/// The middles of the finer pieces.
pub(super) const PIECES: usize = 4;
pub(super) const INSTANTS: usize = PIECES + FINE;

/// A short piece of the run and the scenes within it, each made when first asked for.
pub(super) struct Step<'a> {
    pub(super) ends: [Station; 2],
    /// Which span of the run, and which step of that.
    pub(super) place: (usize, usize),
    lights: &'a Lights,
    pub(super) middle: Scene,
    others: Vec<Option<Scene>>,
}

impl<'a> Step<'a> {
    pub(super) fn new(ends: [Station; 2], place: (usize, usize), lights: &'a Lights) -> Self {
        let others = (0..INSTANTS).map(|_| None).collect();
        let mut step = Self { ends, place, lights, middle: Scene::default(), others };
        step.middle = step.scene(0.5);
        step
    }

    fn scene(&self, share: f64) -> Scene {
        // No lamp is switched inside a step: its middle says which are on.
        let lit_at_s = 0.5 * (self.ends[0].time_s + self.ends[1].time_s);
        self.lights.scene(&self.ends[0].towards(&self.ends[1], share), lit_at_s)
    }

    pub(super) fn scene_at(&mut self, instant: usize) -> &Scene {
        let share = match instant {
            MIDDLE => return &self.middle,
            END => 1.0,
            EARLY => 0.5 - 0.15_f64.sqrt(),
            LATE => 0.5 + 0.15_f64.sqrt(),
            piece => ((piece - PIECES) as f64 + 0.5) / FINE as f64,
        };
        if self.others[instant].is_none() {
            self.others[instant] = Some(self.scene(share));
        }
        self.others[instant].as_ref().unwrap_or(&self.middle)
    }
}

/// The run between stations, cut where a set of lamps is switched, with the dwell at the end.
pub(super) fn spans(run: &Run) -> Vec<[Station; 2]> {
    let mut switches: Vec<f64> = run.lights.switch_times_s().collect();
    switches.sort_by(f64::total_cmp);
    let mut spans = Vec::with_capacity(run.stations.len() + switches.len());
    let mut cut = |a: &Station, b: &Station| {
        let span_s = b.time_s - a.time_s;
        if !(span_s > 0.0 && span_s.is_finite()) {
            return;
        }
        let first = switches.partition_point(|t| *t <= a.time_s);
        let mut from = *a;
        for at_s in switches[first..].iter().take_while(|t| **t < b.time_s) {
            let to = a.towards(b, (at_s - a.time_s) / span_s);
            spans.push([from, to]);
            from = to;
        }
        spans.push([from, *b]);
    };
    for pair in run.stations.windows(2) {
        cut(&pair[0], &pair[1]);
    }
    if let Some(last) = run.stations.last() {
        let rested = Station { time_s: last.time_s + run.dwell_s, ..*last };
        cut(last, &rested);
    }
    spans
}
