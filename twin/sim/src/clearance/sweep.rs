//! Smallest clearance over a whole motion, covered and not sampled: branch and bound.
//!
//! A stretch of motion is looked at in its middle. What the bodies can move from there to its ends
//! is taken off what was measured: the clearance is nowhere on the stretch less than that. The
//! stretch with the least such bound is halved until the bound is near enough to the smallest
//! clearance found, or beyond what is asked for. Far pairs cost one look per long stretch.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// What is found is no more than this above what is guaranteed, m; [`Covered::low_m`] says by how
/// much where the work allowed did not suffice.
pub const RESOLUTION_M: f64 = 1e-4;

/// Near a limit the search goes on down to this, so that resolution decides no verdict, m.
const FINE_M: f64 = 5e-6;

/// Looks spent on one pair before it is told with a coarser resolution.
const LOOKS_MAX: usize = 20_000;

/// Stretches are not split below this share of a step.
const SHORTEST: f64 = 1e-7;

/// What is asked of a search.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Asked {
    /// Clearances beyond this are of no interest, m.
    pub(crate) horizon_m: f64,
    /// Clearances that decide: above one the resolution is no coarser than the room left.
    pub(crate) judged_at_m: [f64; 2],
    /// A find below this ends the search, m.
    pub(crate) enough_m: f64,
}

impl Asked {
    /// The gap between found and guaranteed that will do.
    fn resolution_m(&self, found_m: f64) -> f64 {
        let rooms = self.judged_at_m.iter().map(|judged_m| found_m - judged_m);
        let room_m = rooms.filter(|&room_m| room_m >= 0.0).fold(f64::INFINITY, f64::min);
        room_m.clamp(FINE_M, RESOLUTION_M)
    }
}

/// Smallest clearance of a pair over a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Covered {
    /// The smallest found, m; it is taken at `u`.
    pub(crate) found_m: f64,
    /// Where on the path.
    pub(crate) u: f64,
    /// No clearance on the path is less than this, m.
    pub(crate) low_m: f64,
}

/// One look at a stretch.
pub(crate) struct Look<T> {
    /// Clearance in its middle, m; infinite where it is beyond the cutoff.
    pub(crate) found_m: f64,
    /// Bound on the clearance over all of it, m.
    pub(crate) low_m: f64,
    /// What is worth looking at in its halves.
    pub(crate) keep: T,
}

struct Stretch<T> {
    range: [f64; 2],
    low_m: f64,
    keep: T,
}

/// Smallest clearance over the stretches `starts`; `None` where none is within the horizon.
///
/// `look(range, kept, cutoff)` looks at a stretch; what is further apart than the cutoff all over
/// it need not be measured.
pub(crate) fn least<T>(
    asked: &Asked,
    starts: Vec<([f64; 2], T)>,
    mut look: impl FnMut([f64; 2], &T, f64) -> Look<T>,
) -> Option<Covered> {
    let mut best = (f64::INFINITY, 0.0);
    let mut heap = BinaryHeap::new();
    let mut dropped_m = f64::INFINITY;
    let mut n_looks = 0;
    let enough = |best_m: f64| (best_m - asked.resolution_m(best_m)).min(asked.horizon_m);
    let mut put = |heap: &mut BinaryHeap<Stretch<T>>,
                   best: &mut (f64, f64),
                   dropped_m: &mut f64,
                   range: [f64; 2],
                   kept: &T| {
        let seen = look(range, kept, best.0.min(asked.horizon_m));
        if seen.found_m < best.0 {
            *best = (seen.found_m, middle(range));
        }
        if seen.low_m >= enough(best.0) {
            *dropped_m = dropped_m.min(seen.low_m);
        } else {
            heap.push(Stretch { range, low_m: seen.low_m, keep: seen.keep });
        }
    };
    for (range, kept) in &starts {
        put(&mut heap, &mut best, &mut dropped_m, *range, kept);
    }
    while let Some(next) = heap.pop() {
        n_looks += 2;
        let width = next.range[1] - next.range[0];
        let done = next.low_m >= enough(best.0) || best.0 < asked.enough_m;
        if done || n_looks > LOOKS_MAX || width < SHORTEST {
            dropped_m = dropped_m.min(next.low_m);
            break;
        }
        let split = split(next.range);
        for half in [[next.range[0], split], [split, next.range[1]]] {
            put(&mut heap, &mut best, &mut dropped_m, half, &next.keep);
        }
    }
    let (found_m, u) = best;
    let low_m = dropped_m.min(found_m);
    // Nothing found, but for want of work nothing ruled out either: told as the horizon.
    let unproven = low_m < asked.horizon_m - RESOLUTION_M;
    let found_m = found_m.min(asked.horizon_m.max(low_m));
    (best.0 <= asked.horizon_m || unproven).then_some(Covered { found_m, u, low_m })
}

/// Middle of a stretch.
pub(crate) fn middle(range: [f64; 2]) -> f64 {
    (range[0] + range[1]) / 2.0
}

/// Steps are kept whole as long as there are several.
pub(crate) fn split(range: [f64; 2]) -> f64 {
    let middle = middle(range);
    if range[1] - range[0] > 1.0 { middle.round().clamp(range[0], range[1]) } else { middle }
}

impl<T> Ord for Stretch<T> {
    /// The least bound comes first, then the earliest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.low_m.total_cmp(&self.low_m).then(other.range[0].total_cmp(&self.range[0]))
    }
}

impl<T> PartialOrd for Stretch<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> PartialEq for Stretch<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<T> Eq for Stretch<T> {}
