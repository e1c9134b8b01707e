//! The parts of a report that tell of the frame: stages, landings, loads.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sim::cell::Job;
use sim::growth::{self, Built, Used};
use sim::structure::Criterion;

use crate::fill::{number, range, vector};
use crate::results::Range;

/// The frame at one moment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stage {
    /// The newest strand; null: none yet.
    pub strand: Option<String>,
    /// Number of strands printed.
    pub printed: usize,
    /// The form just released, if this stage is a release.
    pub released: Option<String>,
    /// Largest displacement, gravity on the frame as it stands so far, m; null: nothing solved.
    pub one_shot_m: Option<f64>,
    /// Its node.
    pub one_shot_node: Option<usize>,
    /// Largest displacement by weight when each strand is born stress-free on the frame as it then stands, m.
    pub staged_m: Option<f64>,
    /// Its node.
    pub staged_node: Option<usize>,
    /// The same with the strain that shrinkage locks in, m: before the nozzle touches, while it presses, just
    /// released while the new strand is soft.
    pub states_m: [Option<f64>; 3],
    /// Factor on what the frame carries at which it would buckle, were it perfect; null: at none, not asked or not found.
    pub buckling_factor: Option<f64>,
    /// The same followed with large displacements and an imperfection; null but at the worst stage, where it is below 4.
    pub followed_factor: Option<f64>,
    /// Largest share of strength used in a member, of all three states.
    pub member_utilisation: Option<f64>,
    /// The member.
    pub member: Option<usize>,
    /// Largest share of strength used at a node, of all three states.
    pub node_utilisation: Option<f64>,
    /// The node.
    pub node: Option<usize>,
    /// How far a bed that rides on the arm shakes a node while the stage stands, beyond weight, m; null: the bed stands
    /// still.
    pub shaken_m: Option<f64>,
    /// Largest pull on what bed or form holds over what it holds; null: nothing there may lift.
    pub hold: Option<f64>,
    /// Largest displacement by this release with the shrinkage locked in, staged, m; null: no release, or a piece
    /// of which nothing is held any more.
    pub released_m: Option<f64>,
    /// Forces left out of balance relative to the loads, one-shot.
    pub residual: Option<f64>,
}

/// What moves a node that a strand begins or ends on, each part by itself, in part axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Landing {
    /// The strand that lands.
    pub strand: String,
    /// Whether it is its end rather than its start.
    pub at_end: bool,
    /// The node.
    pub node: usize,
    /// Displacement by gravity, m.
    pub frame_m: Option<[f64; 3]>,
    /// Displacement by shrinkage, m.
    pub shrinkage_m: Option<[f64; 3]>,
    /// How far the strand it lands on lies from its plan there, m.
    pub sag_m: Option<[f64; 3]>,
    /// Displacement by the weight of the strand that lands, m.
    pub weight_m: Option<[f64; 3]>,
    /// Displacement by the nozzle's push, m.
    pub push_m: Option<[f64; 3]>,
    /// Length of the push, m.
    pub push_length_m: Range,
    /// Length of the sum of the five, m.
    pub sum_m: Option<f64>,
    /// Accuracy of the arm, m; of unknown direction.
    pub accuracy_m: Option<f64>,
    /// What would mend it; empty where it is inside its limit.
    pub remedies: Vec<Remedy>,
}

/// A change and what it leaves of a miss.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Remedy {
    /// The change, in words.
    pub change: String,
    /// Length of the sum after it, m.
    pub left_m: Option<f64>,
}

/// What a load case came to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadCase {
    /// Its name.
    pub name: String,
    /// Largest displacement of a node under weight and forces, m; null: not solved.
    pub deflection_m: Option<f64>,
    /// Sum of the forces, N.
    pub load_n: Option<f64>,
    /// Weight of the frame, N.
    pub weight_n: Option<f64>,
    /// Stiffness under these forces: their sum over how far their places move along them, N/m; null: nothing moves.
    pub stiffness_n_m: Option<f64>,
    /// The forces at first yield, as computed, over the weight, N/N.
    pub yield_per_weight: Option<f64>,
    /// Factor on the forces at which the first member or node is used up, as computed; null: not found.
    pub first_yield: Option<f64>,
    /// The same by each criterion.
    pub yields: Vec<Yield>,
    /// Factor on the forces that the members carry for sure if the material is ductile (a plastic lower bound; nodes are not
    /// asked); null: not a thermoplastic, or too large a frame. Held against nothing.
    pub plastic_factor: Option<f64>,
    /// Factor on weight and forces together at which the frame, were it perfect, would buckle; null: at none, or not
    /// found.
    pub buckling_factor: Option<f64>,
    /// The same followed with large displacements and an imperfection; null but where it is below 4.
    pub followed_factor: Option<f64>,
    /// Why the case could not be solved, if it could not.
    pub fault: Option<String>,
}

/// First yield by one criterion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Yield {
    /// By what.
    pub criterion: YieldCriterion,
    /// Factor on the forces, as computed; null: at none.
    pub factor: Option<f64>,
    /// The same with what such predictions are worth.
    pub expected: Range,
    /// The strand that is used up, or whose bond is.
    pub strand: Option<String>,
    /// The node, where it is a bond.
    pub node: Option<usize>,
}

/// What decides that something is used up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum YieldCriterion {
    /// Axial stress of a member.
    Axial,
    /// The outermost fibre of a member, with bending and torsion.
    Fibre,
    /// The bond at a node.
    Node,
}

pub(crate) fn stage(job: &Job, built: &Built, stage: &growth::StageResult) -> Stage {
    let share = |used: &Option<Used>| used.as_ref().and_then(|used| number(used.share.nominal));
    Stage {
        strand: stage.strand.map(|strand| job.strands[strand].id.clone()),
        printed: stage.printed,
        released: stage.released.map(|form| job.forms[form].id.clone()),
        one_shot_m: stage.one_shot_m.and_then(number),
        one_shot_node: stage.one_shot_node,
        staged_m: stage.staged_m.and_then(number),
        staged_node: stage.staged_node,
        states_m: stage.states_m.map(|m| m.and_then(number)),
        buckling_factor: stage.buckling.and_then(|buckled| number(buckled.factor)),
        followed_factor: stage.followed.and_then(number),
        member_utilisation: share(&stage.member),
        member: stage.member.as_ref().map(|used| used.at),
        node_utilisation: share(&stage.weld),
        node: stage.weld.as_ref().map(|used| built.welds[used.at].node),
        shaken_m: stage.shaken.and_then(|shaken| number(shaken.translation_m)),
        hold: stage.hold.and_then(number),
        released_m: stage.released_m.and_then(number),
        residual: number(stage.residual),
    }
}

pub(crate) fn landing(job: &Job, landing: &growth::Landing) -> Landing {
    let remedy = |remedy: &growth::Remedy| Remedy {
        change: remedy.change.words(job),
        left_m: number(remedy.left_m),
    };
    Landing {
        strand: job.strands[landing.strand].id.clone(),
        at_end: landing.at_end,
        node: landing.node,
        frame_m: vector(&landing.frame_m),
        shrinkage_m: vector(&landing.shrinkage_m),
        sag_m: vector(&landing.sag_m),
        weight_m: vector(&landing.weight_m),
        push_m: vector(&landing.push_m),
        push_length_m: range(landing.push_length_m),
        sum_m: number(landing.sum_m),
        accuracy_m: number(landing.accuracy_m),
        remedies: landing.remedies.iter().map(remedy).collect(),
    }
}

pub(crate) fn load(job: &Job, load: &growth::LoadResult) -> LoadCase {
    let solved = load.fault.is_none();
    let yielding = |found: &growth::Yield| Yield {
        criterion: match found.criterion {
            Criterion::Axial => YieldCriterion::Axial,
            Criterion::Fibre => YieldCriterion::Fibre,
            Criterion::Node => YieldCriterion::Node,
        },
        factor: number(found.factor),
        expected: range(found.expected),
        strand: found.strand.map(|strand| job.strands[strand].id.clone()),
        node: found.node,
    };
    LoadCase {
        name: load.name.clone(),
        deflection_m: solved.then_some(load.deflection_m).and_then(number),
        load_n: solved.then_some(load.load_n).and_then(number),
        weight_n: solved.then_some(load.weight_n).and_then(number),
        stiffness_n_m: solved.then_some(load.load_n / load.travel_m).and_then(number),
        yield_per_weight: load
            .first_yield()
            .and_then(|found| number(found.factor * load.load_n / load.weight_n)),
        first_yield: load.first_yield().and_then(|found| number(found.factor)),
        yields: load.yields.iter().flatten().map(yielding).collect(),
        plastic_factor: load.plastic.and_then(number),
        buckling_factor: load.buckling.and_then(number),
        followed_factor: load.followed.and_then(number),
        fault: load.fault.map(|fault| fault.to_string()),
    }
}
