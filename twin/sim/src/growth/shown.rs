//! What pictures need of the stages: displacements of three, and the first that fails.

use super::{Built, Planned, Record};
use crate::pose::Vector;
use crate::structure::{StageRecord, Support};

/// Stages that are shown, and the first failure.
#[derive(Debug, Clone, Default)]
pub struct Shown {
    /// Three at most, in order.
    pub stages: Vec<ShownStage>,
    /// By member: the largest share of its strength used at a stage, weight, locked-in strain and the nozzle; empty where
    /// the last stage was not solved.
    pub used: Vec<f64>,
    /// The first stage with a piece that nothing holds, a mechanism, or a member past its strength.
    pub fails: Option<Fails>,
}

/// A stage with its displacements.
#[derive(Debug, Clone)]
pub struct ShownStage {
    /// Index in [`Growth::stages`](super::Growth::stages).
    pub stage: usize,
    /// Members `0..born` are there.
    pub born: usize,
    /// Staged translation and turn of each node, m and rad, part axes.
    pub staged: Vec<[f64; 6]>,
}

/// A stage that fails.
#[derive(Debug, Clone)]
pub struct Fails {
    /// Index in [`Growth::stages`](super::Growth::stages).
    pub stage: usize,
    /// How.
    pub cause: Cause,
    /// Members `0..born` are there.
    pub born: usize,
    /// What holds the frame.
    pub supports: Vec<Support>,
    /// Gravity in part axes, m/s².
    pub gravity_m_s2: Vector,
}

/// How a stage fails.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cause {
    /// A piece is tied to nothing.
    Floats {
        /// Its lowest node.
        node: usize,
    },
    /// Something moves without stiffness.
    Mechanism {
        /// Where.
        node: usize,
    },
    /// A member is past its strength before the nozzle touches.
    Breaks {
        /// The most used member.
        member: usize,
        /// Where, as a share of its length.
        share: f64,
    },
}

/// Displacements of every node at every stage are kept up to this many numbers.
const KEEP_MAX: usize = 15_000_000;

/// Stages whose displacements are kept: all, or where there is no room for that three.
pub(super) fn kept(stages: usize, nodes: usize) -> Vec<usize> {
    if stages * nodes * 6 <= KEEP_MAX { (0..stages).collect() } else { thirds(stages) }
}

fn thirds(stages: usize) -> Vec<usize> {
    let mut at: Vec<usize> =
        (1..=3).map(|k| (stages * k / 3).saturating_sub(1)).filter(|&at| at < stages).collect();
    at.dedup();
    at
}

/// Chooses what is shown: the stage that moves most (staged), the one with the most used member, the last, and
/// stages at thirds in place of those that coincide.
pub(super) fn shown(built: &Built, plan: &[Planned], records: &[Record]) -> Shown {
    let has = |at: &usize| moved_m(&records[*at]).is_some();
    let known: Vec<usize> = (0..records.len()).filter(has).collect();
    let most = |of: &dyn Fn(&Record) -> f64| {
        known.iter().copied().max_by(|&a, &b| of(&records[a]).total_cmp(&of(&records[b])))
    };
    let moves_most = most(&|record| moved_m(record).unwrap_or(0.0));
    let used_most = most(&|record| used(record).unwrap_or(0.0));
    let thirds = thirds(known.len()).into_iter().map(|at| known[at]);
    let wanted = [moves_most, used_most, known.last().copied()].into_iter().flatten().chain(thirds);
    let mut chosen: Vec<usize> = Vec::new();
    for at in wanted {
        if chosen.len() < 3 && !chosen.contains(&at) {
            chosen.push(at);
        }
    }
    chosen.sort_unstable();
    let stage = |at: usize| ShownStage {
        stage: at,
        born: plan[at].stage.born,
        staged: records[at]
            .by_weight
            .staged
            .as_ref()
            .map_or_else(Vec::new, |s| s.displacement.clone()),
    };
    Shown {
        stages: chosen.into_iter().map(stage).collect(),
        used: records.last().map_or_else(Vec::new, |record| record.in_all.peaks.clone()),
        fails: records.iter().enumerate().find_map(|(at, record)| {
            let planned = &plan[at].stage;
            cause(built, &record.in_all).map(|cause| Fails {
                stage: at,
                cause,
                born: planned.born,
                supports: planned.supports.clone(),
                gravity_m_s2: planned.gravity_m_s2.into(),
            })
        }),
    }
}

/// Largest staged displacement of a stage whose displacements were kept.
fn moved_m(record: &Record) -> Option<f64> {
    record
        .by_weight
        .staged
        .as_ref()
        .filter(|s| !s.displacement.is_empty())
        .map(|s| s.max_translation_m)
}

fn used(record: &Record) -> Option<f64> {
    record.in_all.staged.as_ref()?.utilisation.map(|used| used.value)
}

fn cause(built: &Built, record: &StageRecord) -> Option<Cause> {
    if let Some(&node) = record.floats.first() {
        return Some(Cause::Floats { node });
    }
    if let Some((node, _)) = record.mechanism {
        return Some(Cause::Mechanism { node });
    }
    let used = record.staged.as_ref()?.utilisation.filter(|used| used.value >= 1.0)?;
    let [a, b] = built.frame.members().get(used.member)?.ends.map(|node| built.frame.nodes()[node]);
    let share = (used.station_m / (b - a).norm()).clamp(0.0, 1.0);
    Some(Cause::Breaks { member: used.member, share })
}
