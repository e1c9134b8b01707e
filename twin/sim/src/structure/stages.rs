//! The frame while it grows: every stage one-shot, and staged.
//!
//! One order of elimination and one pattern serve all stages; from stage to stage the factor is
//! updated by the members that came, hardened or went ([`Growing`]). Every stage is watched by its
//! residual, taken member by member: past [`LIMIT`] it is solved once more for what is left, and
//! where that does not do, the factor is made anew. Cost: one update per member (rank six, up the
//! elimination tree), one solve per stage for both answers, and O(members) for forces. All of it is
//! in order, so nothing depends on the number of threads.

use super::assembly::Mechanism;
use super::beam::{Beam, beams};
use super::buckling::{Buckled, BucklingAsk, BucklingError, Mode, critical};
use super::divided::Standing as Pushed;
use super::euler::{EULER_FLAG, most_slender};
use super::frame::{Frame, NodeLoad, Support};
use super::ground::{Ground, Tie, ground};
use super::growing::Growing;
use super::hold::{Hold, Holding};
use super::ldl::Pair;
use super::one_sided::Grip;
use super::solve::{SolveError, check_inputs, fixed_freedoms};
use super::standing::{Moment, ONE_SHOT, STAGED, Standing};
use super::strength::{Span, Strength, Utilisation, check_strengths, spans};
use super::trial::{Capacity, Trial, TrialState, trials};
use super::weld::{Weld, WeldUse, check_welds};

/// Residual, relative to the loads, with which a stage is left.
const LIMIT: f64 = 1e-10;

/// One moment of the print.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Stage {
    /// Members `0..born` exist; never fewer than at the stage before.
    pub born: usize,
    /// What holds the frame now.
    pub supports: Vec<Support>,
    /// Gravity in the axes of the part, m/s².
    pub gravity_m_s2: [f64; 3],
    /// Forces at nodes that act now, such as the nozzle's; gone at the next stage unless given again.
    pub at_nodes: Vec<NodeLoad>,
    /// Factor on E and G of each born member at this age; empty: 1.
    pub stiffness: Vec<f64>,
    /// What the nozzle does, each by itself.
    pub trials: Vec<Trial>,
    /// Nodes whose displacement is wanted.
    pub watch: Vec<usize>,
}

/// What is wanted of a sequence.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ask<'a> {
    /// Also the staged answer.
    pub staged: bool,
    /// By member; empty: no utilisation.
    pub strengths: &'a [Strength],
    /// What holds strands together; asked where strengths are given.
    pub welds: &'a [Weld],
    /// Buckling of the last stage, of every stage that is a multiple of this, and of every one that Euler's screen flags;
    /// 0: of none.
    pub buckling_every: usize,
    /// Stages (by index) whose displacements and peaks are kept.
    pub keep: &'a [usize],
}

/// What a stage came to.
#[derive(Debug, Clone, PartialEq)]
pub struct StageRecord {
    /// Lowest node of each piece tied to no support, and nodes loaded before they have a member.
    /// These are left out; the rest is solved.
    pub floats: Vec<usize>,
    /// Node and freedom (0 to 5) of a motion without stiffness; there is then no state.
    pub mechanism: Option<(usize, usize)>,
    /// All loads on the frame so far, as if it had been printed without weight and then released.
    pub one_shot: Option<StageState>,
    /// Each member born free of stress on the frame as it stood; nodes appear where planned.
    pub staged: Option<StageState>,
    /// In the order of the stage's trials.
    pub trials: Vec<TrialState>,
    /// By member: the largest share of its strength that it used at a stage so far, staged, in the trials that are no bounds
    /// too; empty unless strengths are given and the stage is kept.
    pub peaks: Vec<f64>,
    /// Buckling under the staged forces, where it was asked for.
    pub buckling: Option<Result<Buckled, BucklingError>>,
    /// What let go and what rests; `None` where nothing was said of adhesion.
    pub holding: Option<Holding>,
}

/// How the frame stands at a stage.
#[derive(Debug, Clone, PartialEq)]
pub struct StageState {
    /// Largest translation of a node, m.
    pub max_translation_m: f64,
    /// Its node.
    pub max_node: usize,
    /// Largest turn of a node, rad.
    pub max_rotation_rad: f64,
    /// The most used of the born members; `None` if not asked.
    pub utilisation: Option<Utilisation>,
    /// The most used of the welds that are there; `None` if not asked, or without any.
    pub weld: Option<WeldUse>,
    /// In the order of the stage's supports, N and N m.
    pub reactions: Vec<[f64; 6]>,
    /// Forces left out of balance, relative to the loads.
    pub residual: f64,
    /// By node; empty unless kept.
    pub displacement: Vec<[f64; 6]>,
    /// Of the stage's watched nodes, in their order.
    pub watched: Vec<[f64; 6]>,
}

/// Solves every stage of a print.
///
/// One-shot: `K(S_k) u = f(S_k)`. Staged: `K(S_k) du = f(S_k) - p` with p what the members already
/// carry, `u += du`, and each member's own force grown by `k_e du` with the stiffness of that stage:
/// stress once locked in is kept when a member hardens. A support that goes hands its reaction to
/// the frame; one that comes holds the node where it then is. Initial strain comes with birth.
/// Rotations of a turning bed come through `gravity_m_s2`.
///
/// # Errors
/// Only unusable input ([`SolveError::BadNode`], [`SolveError::BadMember`]) and size; what floats or
/// is a mechanism is in the records.
pub fn solve_stages(
    frame: &Frame,
    stages: &[Stage],
    ask: Ask,
) -> Result<Vec<StageRecord>, SolveError> {
    solve_held_stages(frame, stages, &[], ask)
}

/// [`solve_stages`] on supports that may let go: those with a [`Hold`]; the others cannot lift.
///
/// # Errors
/// As [`solve_stages`]; a hold that is unusable.
pub fn solve_held_stages(
    frame: &Frame,
    stages: &[Stage],
    holds: &[Hold],
    ask: Ask,
) -> Result<Vec<StageRecord>, SolveError> {
    if !ask.strengths.is_empty() {
        check_strengths(frame.members().len(), ask.strengths)?;
        check_welds(ask.welds, frame.members().len(), frame.nodes().len())?;
    }
    check_stages(frame, stages)?;
    let mut grip = Grip::new(frame, holds)?;
    let beams = beams(frame);
    let spans = if ask.strengths.is_empty() { Vec::new() } else { spans(frame, &beams) };
    let born = stages.last().map_or(0, |stage| stage.born);
    let mut sequence = Sequence {
        frame,
        beams: &beams,
        spans: &spans,
        ask,
        growing: Growing::new(frame, &beams, &moving(frame, stages, holds), born),
        standing: Standing::new(frame),
        fresh: 0.0,
        last: stages.len().saturating_sub(1),
        mode: None,
        peaks: Peaks::default(),
    };
    let stages = stages.iter().enumerate();
    Ok(stages.map(|(index, stage)| grip.take(&mut sequence, stage, index)).collect())
}

/// Members that are there and come in order, numbers that are finite.
pub(crate) fn check_stages(frame: &Frame, stages: &[Stage]) -> Result<(), SolveError> {
    let mut before = 0;
    for stage in stages {
        check_inputs(frame, &stage.supports, &stage.at_nodes, stage.gravity_m_s2)?;
        for trial in &stage.trials {
            check_inputs(frame, &[], &trial.loads, [0.0; 3])?;
        }
        if let Some(&node) = stage.watch.iter().find(|&&node| node >= frame.nodes().len()) {
            return Err(SolveError::BadNode { node });
        }
        let given = stage.stiffness.len();
        let sound = |factor: &f64| factor.is_finite() && *factor > 0.0;
        let unsound = stage.stiffness.iter().position(|factor| !sound(factor));
        let member = match unsound {
            _ if stage.born < before || stage.born > frame.members().len() => Some(stage.born),
            None if given > 0 && given < stage.born => Some(given),
            other => other,
        };
        if let Some(member) = member {
            return Err(SolveError::BadMember { member });
        }
        before = stage.born;
    }
    Ok(())
}

/// Nodes that have a member at the end, without those clamped throughout that cannot lift.
pub(crate) fn moving(frame: &Frame, stages: &[Stage], holds: &[Hold]) -> Vec<bool> {
    let count = frame.nodes().len();
    let born = &frame.members()[..stages.last().map_or(0, |stage| stage.born)];
    let mut clamped = vec![true; count];
    for stage in stages {
        for (clamped, fixed) in clamped.iter_mut().zip(fixed_freedoms(count, &stage.supports)) {
            *clamped &= fixed == [true; 6];
        }
    }
    holds.iter().filter(|hold| hold.pull_n.is_finite()).for_each(|hold| clamped[hold.node] = false);
    let mut moving = vec![false; count];
    for node in born.iter().flat_map(|member| member.ends) {
        moving[node] = !clamped[node];
    }
    moving
}

pub(super) struct Sequence<'a> {
    pub(super) frame: &'a Frame,
    beams: &'a [Beam],
    spans: &'a [Span<'a>],
    ask: Ask<'a>,
    pub(super) growing: Growing<'a>,
    pub(super) standing: Standing,
    /// Residual past [`LIMIT`] that a new factor left at the last stage that needed one.
    fresh: f64,
    /// Index of the last stage.
    last: usize,
    /// How the frame buckled when that was last asked: the next shape is near.
    mode: Option<Mode>,
    peaks: Peaks,
}

/// Largest shares of strength by member.
#[derive(Default)]
struct Peaks {
    /// Up to the stage before this one.
    before: Vec<f64>,
    /// With this one, as it was last taken.
    now: Vec<f64>,
    /// Its index.
    index: usize,
}

impl Peaks {
    /// Those to grow at a stage, which may be taken again: what it came to before is then forgotten.
    fn at(&mut self, index: usize, members: usize) -> &mut [f64] {
        if index != self.index {
            (self.index, self.before) = (index, self.now.clone());
        }
        self.now.clone_from(&self.before);
        self.now.resize(members, 0.0);
        &mut self.now
    }
}

impl Sequence<'_> {
    /// A stage on the supports it names. Taken again with fewer supports or other forces of surfaces
    /// it goes on from where it stood.
    pub(super) fn take(&mut self, stage: &Stage, index: usize) -> StageRecord {
        let node_count = self.frame.nodes().len();
        let born = &self.frame.members()[..stage.born];
        let Ground { tie, mut floats } = ground(node_count, born, &stage.supports);
        let loaded = stage.at_nodes.iter().map(|load| load.node);
        floats.extend(loaded.filter(|&node| tie[node] == Tie::Unborn));
        floats.sort_unstable();
        floats.dedup();
        let mut record = StageRecord {
            floats,
            mechanism: None,
            one_shot: None,
            staged: None,
            trials: Vec::new(),
            peaks: Vec::new(),
            buckling: None,
            holding: None,
        };

        let mut free = fixed_freedoms(node_count, &stage.supports).into_iter().zip(&tie);
        let free: Vec<[bool; 6]> =
            free.by_ref().map(|(fixed, &tie)| fixed.map(|f| !f && tie == Tie::Held)).collect();
        let mut wanted = vec![0.0; self.frame.members().len()];
        for (at, _) in born.iter().enumerate().filter(|(_, m)| tie[m.ends[0]] == Tie::Held) {
            wanted[at] = stage.stiffness_of(at);
        }
        let moment = Moment { frame: self.frame, beams: self.beams, stage, tie: &tie, free: &free };
        self.standing.bear(&moment);
        if let Err(Mechanism { node, freedom }) = self.growing.advance(&wanted, &free) {
            record.mechanism = Some((node, freedom));
            return record;
        }
        let residuals = self.settle(&moment);
        let kept = self.ask.keep.contains(&index);
        let capacity =
            Capacity { spans: self.spans, strengths: self.ask.strengths, welds: self.ask.welds };
        let peaks = self.peaks.at(index, self.spans.len());
        let state = |side: usize, peaks: &mut [f64]| {
            self.standing.state(&moment, side, &capacity, residuals[side], kept, peaks)
        };
        record.one_shot = Some(state(ONE_SHOT, &mut []));
        record.staged = self.ask.staged.then(|| state(STAGED, &mut *peaks));
        record.trials = trials(&moment, &self.standing, &self.growing, &capacity, &mut *peaks);
        if kept {
            record.peaks = peaks.to_vec();
        }
        record.buckling = self.buckling(&moment, &wanted, index);
        record
    }

    /// Where it is asked for; the shape is kept for the next time.
    fn buckling(
        &mut self,
        moment: &Moment,
        stiffness: &[f64],
        index: usize,
    ) -> Option<Result<Buckled, BucklingError>> {
        let every = self.ask.buckling_every;
        if every == 0 {
            return None;
        }
        let cuts = self.standing.cuts(moment, STAGED);
        let asked = index == self.last || index.is_multiple_of(every);
        if !asked && most_slender(moment.born(), self.beams, &cuts) <= EULER_FLAG {
            return None;
        }
        let free: Vec<bool> = moment.free.iter().flatten().copied().collect();
        let solve = |forces: &[f64]| {
            let mut pairs: Vec<Pair> = forces.iter().map(|&force| [force, 0.0]).collect();
            self.growing.solve(&mut pairs);
            pairs.iter().map(|pair| pair[0]).collect()
        };
        let of = Pushed {
            members: moment.born(),
            beams: &self.beams[..moment.born().len()],
            stiffness: &stiffness[..moment.born().len()],
            cuts: &cuts,
            free: &free,
            solve: &solve,
        };
        let ask = BucklingAsk { near: self.mode.as_ref(), ..BucklingAsk::default() };
        Some(critical(&of, ask).map(|modes| {
            let mode = modes.into_iter().next();
            let buckled = Buckled::of(mode.as_ref());
            self.mode = mode;
            buckled
        }))
    }

    /// Lets both answers come to rest; what is left out of balance, relative to the loads.
    ///
    /// Four solves at most: the first, one for what is left, and both again with a new factor.
    fn settle(&mut self, moment: &Moment) -> [f64; 2] {
        let (mut step, loads) = self.standing.start(moment);
        let mut residuals = [0.0; 2];
        for solves in 1..=4 {
            self.growing.solve(&mut step);
            let gaps = self.standing.step(moment, &mut step);
            residuals = gaps.map(|gap| if loads > 0.0 { gap / loads } else { 0.0 });
            let worst = residuals[0].max(residuals[1]);
            if worst <= LIMIT {
                self.fresh = 0.0;
                break;
            }
            // what a new factor did not mend last time it will not mend now
            if solves == 2 && (worst <= 2.0 * self.fresh || self.growing.refactor().is_err()) {
                break;
            }
            if solves == 4 {
                self.fresh = worst;
            }
        }
        self.standing.settle(moment);
        residuals
    }
}

impl Stage {
    /// Factor on the stiffness of a member.
    pub(crate) fn stiffness_of(&self, member: usize) -> f64 {
        self.stiffness.get(member).copied().unwrap_or(1.0)
    }
}
