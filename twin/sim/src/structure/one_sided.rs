//! Supports that hold by adhesion: they let go where they are pulled too hard, and then only rest.
//!
//! ```text
//! held      u = 0 in all it holds            while  -R · n < a
//! let go    λ ≥ 0,  g ≥ 0,  λ g = 0          g = n · (u - u₀),  force on the node  λ n
//! ```
//! R is the staged reaction, a the greatest pull, n out of the surface, u₀ where the node was when it
//! let go. Letting go hands R to the frame within the same stage: the staged answer grows by steps, so
//! that is one step more. Of those pulled too hard the one most so goes first (and those as much so
//! with it), the frame finds its rest, and so on: as if the load of the stage had grown evenly. What
//! has let go never holds again; past [`ROUNDS`] of a print all that are pulled too hard go together.
//!
//! The surface is rigid and without friction. Resting is solved exactly, by flexibilities along the
//! normals (`W = nᵀ K⁻¹ n`, half a solve for each node near the surface) and not by springs, so nothing
//! sinks in. Adhesion is a mean
//! stress over the area of contact: a crack that runs along the edge (peeling) is not seen, nor
//! shear along the surface, nor the moment at the node.

use std::borrow::Cow;

use super::frame::Frame;
use super::hold::{Hold, Holding, Pull};
use super::ldl::Pair;
use super::seat::{Seat, all_reactions};
use super::solve::SolveError;
use super::stages::{Sequence, Stage, StageRecord};
use super::standing::{ONE_SHOT, STAGED};
use crate::pose::Vector;

/// Rounds of a whole print in which only the most pulled support lets go: each may cost a new factor.
const ROUNDS: usize = 256;
/// Rounds of a stage.
const ROUNDS_OF_STAGE: usize = 64;
/// Rounds at the end of those in which all that are pulled too hard let go together.
const ROUNDS_OF_ALL: usize = 16;
/// Nodes of those that let go that are solved for at once; each takes half a solve at each stage.
const MOST_SEATS: usize = 256;
/// Supports pulled as much as the most pulled one, but for rounding, let go with it.
const AS_MUCH: f64 = 1e-9;
/// A pull below this part of the largest reaction is rounding.
const NO_PULL: f64 = 1e-12;
/// Rounds of looking for nodes that come back to the surface, or are not yet quite on it; in the last
/// all that let go are looked at.
const LOOKS: usize = 8;
/// Depth below the surface, as part of the largest displacement, that is rounding: solves end at a
/// residual of 1e-10, and what is deeper is mended by another look.
const DEPTH: f64 = 1e-9;

/// Length of the mean of normals below which a node cannot lift: held by surfaces that face different ways (two
/// of them 36° apart) it would have to slide along one, and sliding is held whatever comes.
const FACING: f64 = 0.95;

/// The holds of a sequence.
pub(super) struct Grip<'a> {
    holds: &'a [Hold],
    /// Rounds so far.
    rounds: usize,
}

impl<'a> Grip<'a> {
    /// # Errors
    /// A node that is not there, a normal that is none, a pull that is negative.
    pub(super) fn new(frame: &Frame, holds: &'a [Hold]) -> Result<Self, SolveError> {
        let count = frame.nodes().len();
        let sound = |hold: &Hold| {
            let unit = (hold.normal.norm() - 1.0).abs() < 1e-6;
            hold.node < count && unit && hold.pull_n >= 0.0
        };
        match holds.iter().find(|hold| !sound(hold)) {
            Some(hold) => Err(SolveError::BadNode { node: hold.node }),
            None => Ok(Self { holds, rounds: 0 }),
        }
    }

    /// One stage, with all that lets go in it.
    pub(super) fn take(
        &mut self,
        sequence: &mut Sequence,
        stage: &Stage,
        index: usize,
    ) -> StageRecord {
        if self.holds.is_empty() {
            return sequence.take(stage, index);
        }
        let held = self.held(sequence.frame.nodes().len(), index);
        // a surface that is gone no longer presses
        let mut supported = vec![false; held.len()];
        stage.supports.iter().for_each(|support| supported[support.node] = true);
        sequence.standing.seats.retain(|seat| supported[seat.node]);
        let mut holding = Holding {
            worst: None,
            let_go: Vec::new(),
            resting: Vec::new(),
            rounds: 0,
            is_settled: true,
        };
        let mut record = loop {
            let (record, came_to_rest) = rest(sequence, stage, index);
            holding.is_settled = came_to_rest;
            if record.mechanism.is_some() {
                break record;
            }
            let pulls = pulls(sequence, stage, &held);
            let worst =
                pulls.iter().copied().reduce(|a, b| if b.share() > a.share() { b } else { a });
            if holding.rounds == 0 {
                holding.worst = worst;
            }
            let most = worst.map_or(0.0, |pull| pull.share());
            if !(most >= 1.0) {
                break record;
            }
            if holding.rounds == ROUNDS_OF_STAGE {
                holding.is_settled = false;
                break record;
            }
            let one = self.rounds < ROUNDS && holding.rounds < ROUNDS_OF_STAGE - ROUNDS_OF_ALL;
            let least = if one { most * (1.0 - AS_MUCH) } else { 1.0 };
            for pull in pulls.iter().filter(|pull| pull.share() >= least.max(1.0)) {
                holding.let_go.push(pull.node);
                sequence.standing.let_go(pull.node, held[pull.node].normal);
            }
            holding.rounds += 1;
            self.rounds += 1;
        };
        finish(sequence, stage, &mut holding, &mut record);
        record.holding = Some(holding);
        record
    }

    /// By node: what holds it at a stage; a pull that is infinite where it cannot lift.
    fn held(&self, node_count: usize, index: usize) -> Vec<Held> {
        let mut held = vec![Held { normal: Vector::zeros(), pull_n: 0.0, count: 0.0 }; node_count];
        for hold in self.holds.iter().filter(|hold| (hold.from..hold.until).contains(&index)) {
            held[hold.node].normal += hold.normal;
            held[hold.node].pull_n += hold.pull_n;
            held[hold.node].count += 1.0;
        }
        for held in &mut held {
            let facing = held.normal.norm() / held.count;
            if facing > FACING {
                held.normal.normalize_mut();
            } else {
                held.pull_n = f64::INFINITY;
            }
        }
        held
    }
}

/// Who rests, and the reactions in the order of the stage's own supports.
fn finish(sequence: &Sequence, stage: &Stage, holding: &mut Holding, record: &mut StageRecord) {
    let seats = &sequence.standing.seats;
    let rests = seats.iter().filter(|seat| seat.force_n[STAGED] > 0.0);
    holding.resting = rests.map(|seat| seat.node).collect();
    holding.resting.sort_unstable();
    let sides = [(&mut record.one_shot, ONE_SHOT), (&mut record.staged, STAGED)];
    for (state, side) in sides.into_iter().filter_map(|(s, side)| Some((s.as_mut()?, side))) {
        state.reactions = all_reactions(stage, seats, &state.reactions, side);
    }
}

#[derive(Debug, Clone, Copy)]
struct Held {
    normal: Vector,
    pull_n: f64,
    /// Holds added up.
    count: f64,
}

/// The stage without the supports that have let go.
fn without<'a>(stage: &'a Stage, seats: &[Seat]) -> Cow<'a, Stage> {
    if seats.is_empty() {
        return Cow::Borrowed(stage);
    }
    let mut now = stage.clone();
    now.supports.retain(|support| seats.iter().all(|seat| seat.node != support.node));
    Cow::Owned(now)
}

/// Staged pulls of the supports that still hold and may lift, by node.
fn pulls(sequence: &Sequence, stage: &Stage, held: &[Held]) -> Vec<Pull> {
    let still = without(stage, &sequence.standing.seats);
    let reaction = |node: usize| sequence.standing.held_force(node, STAGED);
    let largest_n = still.supports.iter().map(|it| reaction(it.node).norm()).fold(0.0, f64::max);
    let mut nodes: Vec<usize> = still.supports.iter().map(|support| support.node).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let lifts = nodes.into_iter().filter(|&node| held[node].pull_n.is_finite());
    let pull = |node: usize| {
        let pull_n = -reaction(node).dot(&held[node].normal);
        let is_none = pull_n.abs() <= NO_PULL * largest_n;
        Pull { node, pull_n: if is_none { 0.0 } else { pull_n }, held_n: held[node].pull_n }
    };
    lifts.map(pull).collect()
}

/// Lets the frame come to rest on what still holds and on the surface below what has let go; and
/// whether it did.
///
/// Nodes that press or sink in are looked at; few do, and each costs a solve.
fn rest(sequence: &mut Sequence, stage: &Stage, index: usize) -> (StageRecord, bool) {
    let now = without(stage, &sequence.standing.seats);
    let mut record = sequence.take(&now, index);
    let mut near: Vec<bool> =
        sequence.standing.seats.iter().map(|seat| seat.force_n != [0.0; 2]).collect();
    for look in 0..=LOOKS {
        if record.mechanism.is_some() {
            break;
        }
        let depth_m = DEPTH * sequence.standing.largest_m();
        let gaps = sequence.standing.gaps_m();
        let mut is_off = look == 0 && near.contains(&true);
        let forces_n: Vec<Pair> = sequence.standing.seats.iter().map(|seat| seat.force_n).collect();
        for ((near, gap), force_n) in near.iter_mut().zip(&gaps).zip(&forces_n) {
            let off = |side: usize| {
                let gap_m = gap.map_or(0.0, |gap| gap[side]);
                // what presses has to touch, within what the solve of a softer frame left
                gap_m < -depth_m || (force_n[side] > 0.0 && gap_m > depth_m)
            };
            let is_here = off(ONE_SHOT) || off(STAGED);
            is_off |= is_here;
            *near = gap.is_some() && (*near || is_here);
        }
        if !is_off {
            break;
        }
        if look == LOOKS {
            near.iter_mut().zip(&gaps).for_each(|(near, gap)| *near = gap.is_some());
        }
        if near.iter().filter(|near| **near).count() > MOST_SEATS {
            return (record, false);
        }
        let is_settled = sequence.press(&near, &gaps);
        record = sequence.take(&now, index);
        if !is_settled {
            return (record, false);
        }
    }
    (record, true)
}
