//! The frame while it grows: every stage one-shot, and staged.
//!
//! Stages are taken in runs of [`RUN`]. A run has one pattern and one symbolic factorisation, made
//! for its last and largest stage; each stage is then assembled and factored in parallel, on its
//! own, with unborn freedoms uncoupled. Cost: `n/RUN` symbolic and `n` numeric factorisations, each
//! of a frame no larger than at the end of its run; memory: `RUN` factors at a time. The staged
//! answer adds one solve per stage, in order. Nothing depends on the number of threads.

use rayon::prelude::*;

use super::assembly::{Mechanism, Pattern};
use super::beam::{Beam, Vector12, beams};
use super::frame::{Frame, NodeLoad, Support};
use super::ground::{Tie, ground};
use super::solve::{
    SolveError, active_freedoms, add_ends, by_node, check_inputs, ends_of, fixed_freedoms, masked,
    node_forces, parts, reactions, relative_gap,
};
use super::strength::{Cut, Span, Strength, Utilisation, check_strengths, spans, worst};
use crate::pose::Vector;

/// Stages that share a pattern: enough that ordering costs little, few enough that early stages do
/// not carry the rows of late ones.
const RUN: usize = 16;

/// One moment of the print.
#[derive(Debug, Clone, PartialEq)]
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
}

/// What is wanted of a sequence.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ask<'a> {
    /// Also the staged answer.
    pub staged: bool,
    /// By member; empty: no utilisation.
    pub strengths: &'a [Strength],
    /// Stages (by index) whose displacements are kept.
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
    /// In the order of the stage's supports, N and N m.
    pub reactions: Vec<[f64; 6]>,
    /// Forces left out of balance, relative to the loads.
    pub residual: f64,
    /// By node; empty unless kept.
    pub displacement: Vec<[f64; 6]>,
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
    check(frame, stages, &ask)?;
    let beams = beams(frame);
    let spans = if ask.strengths.is_empty() { Vec::new() } else { spans(frame, &beams) };
    let sequence = Sequence { frame, beams: &beams, spans: &spans, ask };
    let mut memory = Memory::new(frame);
    let mut records = Vec::with_capacity(stages.len());
    for run in stages.chunks(RUN) {
        let pattern = run_pattern(frame, run).ok_or(SolveError::TooLarge)?;
        let first = records.len();
        let prepared: Vec<Prepared> = run
            .par_iter()
            .enumerate()
            .map(|(at, stage)| sequence.prepare(&pattern, stage, first + at))
            .collect();
        for (stage, mut prepared) in run.iter().zip(prepared) {
            if ask.staged {
                let index = records.len();
                prepared.record.staged =
                    sequence.advance(&pattern, stage, &prepared, &mut memory, index);
            }
            records.push(prepared.record);
        }
    }
    Ok(records)
}

fn check(frame: &Frame, stages: &[Stage], ask: &Ask) -> Result<(), SolveError> {
    if !ask.strengths.is_empty() {
        check_strengths(frame, ask.strengths)?;
    }
    let mut before = 0;
    for stage in stages {
        check_inputs(frame, &stage.supports, &stage.at_nodes, stage.gravity_m_s2)?;
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

/// Pattern of a run: nodes born by its end, without those clamped throughout.
fn run_pattern(frame: &Frame, run: &[Stage]) -> Option<Pattern> {
    let born = &frame.members()[..run.last().map_or(0, |stage| stage.born)];
    let mut keep = vec![false; frame.nodes().len()];
    for node in born.iter().flat_map(|member| member.ends) {
        keep[node] = true;
    }
    let mut clamped = vec![true; frame.nodes().len()];
    for stage in run {
        for (clamped, fixed) in
            clamped.iter_mut().zip(fixed_freedoms(frame.nodes().len(), &stage.supports))
        {
            *clamped &= fixed == [true; 6];
        }
    }
    for (keep, clamped) in keep.iter_mut().zip(clamped) {
        *keep &= !clamped;
    }
    Pattern::new(&keep, born)
}

struct Sequence<'a> {
    frame: &'a Frame,
    beams: &'a [Beam],
    spans: &'a [Span<'a>],
    ask: Ask<'a>,
}

/// A stage ready to be solved for any right side.
struct Prepared {
    tie: Vec<Tie>,
    active: Vec<bool>,
    /// `None` where the stage is a mechanism.
    factor: Option<Vec<f64>>,
    record: StageRecord,
}

/// What the staged answer carries from stage to stage.
struct Memory {
    u: Vec<f64>,
    /// Elastic force of each member on its nodes, weight not included.
    elastic: Vec<Vector12>,
    /// Load each member's initial strain was born with.
    strain: Vec<Vector12>,
    born: usize,
}

impl Memory {
    fn new(frame: &Frame) -> Self {
        let none = vec![Vector12::zeros(); frame.members().len()];
        Self { u: vec![0.0; 6 * frame.nodes().len()], elastic: none.clone(), strain: none, born: 0 }
    }
}

impl Sequence<'_> {
    fn prepare(&self, pattern: &Pattern, stage: &Stage, index: usize) -> Prepared {
        let node_count = self.frame.nodes().len();
        let born = &self.frame.members()[..stage.born];
        let ground = ground(node_count, born, &stage.supports);
        let mut floats = ground.floats;
        let loaded = stage.at_nodes.iter().map(|load| load.node);
        floats.extend(loaded.filter(|&node| ground.tie[node] == Tie::Unborn));
        floats.sort_unstable();
        floats.dedup();
        let active =
            active_freedoms(pattern, &ground.tie, &fixed_freedoms(node_count, &stage.supports));
        let values = pattern.assemble(parts(born, self.beams, &stage.stiffness), &active);
        let record = StageRecord { floats, mechanism: None, one_shot: None, staged: None };
        let mut prepared = Prepared { tie: ground.tie, active, factor: None, record };
        match pattern.factor(&values, &prepared.active) {
            Ok(factor) => {
                prepared.record.one_shot =
                    Some(self.one_shot(pattern, stage, &prepared, (&values, &factor), index));
                prepared.factor = Some(factor);
            }
            Err(Mechanism { node, freedom }) => prepared.record.mechanism = Some((node, freedom)),
        }
        prepared
    }

    fn one_shot(
        &self,
        pattern: &Pattern,
        stage: &Stage,
        prepared: &Prepared,
        (values, factor): (&[f64], &[f64]),
        index: usize,
    ) -> StageState {
        let fixed_load = |member: usize| {
            self.beams[member].weight_load(stage.gravity_m_s2)
                + self.beams[member].strain_load * stiffness_of(stage, member)
        };
        let f = self.sum(stage, fixed_load);
        let right = masked(pattern.gather(&f), &prepared.active);
        let mut kept_u = right.clone();
        pattern.solve(factor, &mut kept_u);
        let residual = relative_gap(&pattern.multiply(values, &kept_u), &right);
        let mut u = vec![0.0; f.len()];
        pattern.scatter_add(&kept_u, &mut u);
        let end_forces: Vec<Vector12> = (0..stage.born)
            .map(|member| {
                let stretch = ends_of(&u, &self.frame.members()[member]);
                self.beams[member].stiffness * stretch * stiffness_of(stage, member)
                    - fixed_load(member)
            })
            .collect();
        self.state(stage, &prepared.tie, &u, &end_forces, residual, index)
    }

    /// Takes the staged answer over one stage; a mechanism leaves it where it was.
    fn advance(
        &self,
        pattern: &Pattern,
        stage: &Stage,
        prepared: &Prepared,
        memory: &mut Memory,
        index: usize,
    ) -> Option<StageState> {
        for member in memory.born..stage.born {
            memory.strain[member] = self.beams[member].strain_load * stiffness_of(stage, member);
            memory.elastic[member] = -memory.strain[member];
        }
        memory.born = stage.born;
        let factor = prepared.factor.as_ref()?;
        let weight = |member: usize| self.beams[member].weight_load(stage.gravity_m_s2);
        let loads = self.sum(stage, |member| weight(member) + memory.strain[member]);
        let loads = masked(pattern.gather(&loads), &prepared.active);
        let left_over = |elastic: &[Vector12]| {
            let gap = self.sum(stage, |member| weight(member) - elastic[member]);
            masked(pattern.gather(&gap), &prepared.active)
        };
        let mut step = left_over(&memory.elastic);
        pattern.solve(factor, &mut step);
        pattern.scatter_add(&step, &mut memory.u);
        let mut du = vec![0.0; memory.u.len()];
        pattern.scatter_add(&step, &mut du);
        for (member, elastic) in memory.elastic[..stage.born].iter_mut().enumerate() {
            let stretch = ends_of(&du, &self.frame.members()[member]);
            *elastic += self.beams[member].stiffness * stretch * stiffness_of(stage, member);
        }
        let left = left_over(&memory.elastic);
        let balanced: Vec<f64> = loads.iter().zip(&left).map(|(load, left)| load - left).collect();
        let end_forces: Vec<Vector12> =
            (0..stage.born).map(|member| memory.elastic[member] - weight(member)).collect();
        let residual = relative_gap(&balanced, &loads);
        Some(self.state(stage, &prepared.tie, &memory.u, &end_forces, residual, index))
    }

    /// Loads at nodes, and a load of every born member, in the freedoms of the frame.
    fn sum(&self, stage: &Stage, of_member: impl Fn(usize) -> Vector12) -> Vec<f64> {
        let mut f = node_forces(self.frame.nodes().len(), &stage.at_nodes);
        for (at, member) in self.frame.members()[..stage.born].iter().enumerate() {
            add_ends(&mut f, member, &of_member(at));
        }
        f
    }

    fn state(
        &self,
        stage: &Stage,
        tie: &[Tie],
        u: &[f64],
        end_forces: &[Vector12],
        residual: f64,
        index: usize,
    ) -> StageState {
        let (mut max_translation_m, mut max_node, mut max_rotation_rad) = (0.0, 0, 0.0f64);
        for (node, six) in u.chunks_exact(6).enumerate() {
            let translation_m = Vector::new(six[0], six[1], six[2]).norm();
            if translation_m > max_translation_m {
                (max_translation_m, max_node) = (translation_m, node);
            }
            max_rotation_rad = max_rotation_rad.max(Vector::new(six[3], six[4], six[5]).norm());
        }
        let cut = |(member, forces): (usize, &Vector12)| {
            let held = tie[self.frame.members()[member].ends[0]] == Tie::Held;
            let line = self.beams[member].line_load(stage.gravity_m_s2);
            let part = if held { 1.0 } else { 0.0 };
            Cut::new((forces * part).as_slice(), line * part)
        };
        let utilisation = if self.spans.is_empty() {
            None
        } else {
            let cuts: Vec<Cut> = end_forces.iter().enumerate().map(cut).collect();
            worst(self.spans, &cuts, self.ask.strengths)
        };
        let kept = self.ask.keep.contains(&index);
        StageState {
            max_translation_m,
            max_node,
            max_rotation_rad,
            utilisation,
            reactions: reactions(self.frame, end_forces, &stage.supports, &stage.at_nodes),
            residual,
            displacement: if kept { by_node(u) } else { Vec::new() },
        }
    }
}

fn stiffness_of(stage: &Stage, member: usize) -> f64 {
    stage.stiffness.get(member).copied().unwrap_or(1.0)
}
