//! A load put on the frame as it stands and taken off again: what the nozzle does while it is there.

use super::balance::{carried, stretch};
use super::frame::{Member, NodeLoad};
use super::growing::Growing;
use super::ldl::Pair;
use super::standing::{Moment, STAGED, Standing};
use super::strength::{Cut, Span, Strength, Utilisation, worst_by};
use super::weld::{Weld, WeldUse, worst_weld};
use crate::pose::Vector;

/// Loads put on the frame as it stands and taken off again.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trial {
    /// What is put on.
    pub loads: Vec<NodeLoad>,
    /// Whether it only bounds another one: what members use in it is not what they are expected to.
    pub is_bound: bool,
}

/// How the frame answers to a trial load, staged.
#[derive(Debug, Clone, PartialEq)]
pub struct TrialState {
    /// What the trial alone does to the nodes it acts on, in the order of its loads.
    pub displacement: Vec<(usize, [f64; 6])>,
    /// Largest translation of a node with the trial on, from where it was planned, m.
    pub max_translation_m: f64,
    /// Its node.
    pub max_node: usize,
    /// The most used member with the trial on; `None` if not asked.
    pub utilisation: Option<Utilisation>,
    /// The most used weld with the trial on; `None` if not asked, or without any.
    pub weld: Option<WeldUse>,
}

/// What members and welds can take; without strengths nothing is asked.
pub(super) struct Capacity<'a> {
    pub(super) spans: &'a [Span<'a>],
    pub(super) strengths: &'a [Strength],
    pub(super) welds: &'a [Weld],
}

impl Capacity<'_> {
    /// The most used member and weld; `peaks` grow to what each member uses.
    pub(super) fn used(
        &self,
        cuts: impl FnOnce() -> Vec<Cut>,
        peaks: &mut [f64],
    ) -> (Option<Utilisation>, Option<WeldUse>) {
        if self.spans.is_empty() {
            return (None, None);
        }
        let cuts = cuts();
        let member = worst_by(self.spans, &cuts, self.strengths, |member, span, cut, strength| {
            let used = span.utilisation(cut, strength);
            if let Some(peak) = peaks.get_mut(member) {
                *peak = peak.max(used.0);
            }
            used
        });
        (member, worst_weld(self.welds, self.spans, &cuts))
    }
}

/// Every trial of a stage, two to a solve: O(nonzeros of the factor) per pair, O(members) each for the forces.
///
/// The frame answers elastically and gives all of it back, so trials leave no trace in either answer.
pub(super) fn trials(
    moment: &Moment,
    standing: &Standing,
    growing: &Growing,
    capacity: &Capacity,
    peaks: &mut [f64],
) -> Vec<TrialState> {
    let mut states = Vec::with_capacity(moment.stage.trials.len());
    for pair in moment.stage.trials.chunks(2) {
        let mut u: Vec<Pair> = vec![[0.0; 2]; 6 * moment.free.len()];
        for (side, trial) in pair.iter().enumerate() {
            for load in &trial.loads {
                for (freedom, value) in load.load.iter().enumerate() {
                    u[6 * load.node + freedom][side] += value;
                }
            }
        }
        growing.solve(&mut u);
        for (side, trial) in pair.iter().enumerate() {
            let peaks: &mut [f64] = if trial.is_bound { &mut [] } else { &mut *peaks };
            let u = |freedom: usize| u[freedom][side];
            states.push(state(moment, standing, capacity, &trial.loads, &u, peaks));
        }
    }
    states
}

fn state(
    moment: &Moment,
    standing: &Standing,
    capacity: &Capacity,
    loads: &[NodeLoad],
    u: &dyn Fn(usize) -> f64,
    peaks: &mut [f64],
) -> TrialState {
    let (mut max_translation_m, mut max_node) = (0.0, 0);
    for node in 0..moment.free.len() {
        let six = standing.staged(node);
        let moved = Vector::from_fn(|axis, _| six[axis] + u(6 * node + axis)).norm();
        if moved > max_translation_m {
            (max_translation_m, max_node) = (moved, node);
        }
    }
    let cuts = || {
        let lasting = standing.cuts(moment, STAGED);
        let added =
            moment.born().iter().enumerate().map(|(at, member)| first_end(moment, at, member, u));
        lasting.iter().zip(added).map(|(lasting, added)| lasting.plus(&added, 1.0)).collect()
    };
    let (utilisation, weld) = capacity.used(cuts, peaks);
    let of_node = |node: usize| std::array::from_fn(|freedom| u(6 * node + freedom));
    TrialState {
        displacement: loads.iter().map(|load| (load.node, of_node(load.node))).collect(),
        max_translation_m,
        max_node,
        utilisation,
        weld,
    }
}

/// What a displacement alone does to the first end of a member.
fn first_end(moment: &Moment, at: usize, member: &Member, u: &dyn Fn(usize) -> f64) -> Cut {
    let nodes = moment.frame.nodes();
    let r = nodes[member.ends[1]] - nodes[member.ends[0]];
    let by = stretch(&r, |end, k| [u(6 * member.ends[end] + k), 0.0]);
    let stiffness = &moment.beams[at].stiffness;
    let factor = moment.stage.stiffness_of(at);
    let far: [Pair; 6] = std::array::from_fn(|row| {
        let sum: f64 = (0..6).map(|column| stiffness[(6 + row, 6 + column)] * by[column][0]).sum();
        [factor * sum, 0.0]
    });
    Cut::new(&carried(&r, &far).map(|pair| pair[0]), Vector::zeros())
}
