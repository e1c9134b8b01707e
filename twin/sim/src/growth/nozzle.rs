//! The nozzle on the frame: what it does where a strand begins and ends.
//!
//! A stage has three states. *About to touch*: the frame alone. *Held*: the nozzle presses on the node where the strand
//! begins, or on that where it ends, and there the soft strand hangs on the frame with its weight. *Released
//! while soft*: the nozzle is gone, the weight hangs. While it is soft the new strand carries nothing.

use super::{Built, Planned, Printed, State};
use crate::cell::Job;
use crate::finding::Phase;
use crate::pose::Vector;
use crate::structure::NodeLoad;

/// A strand that comes to the frame as it stands at a stage.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Coming {
    /// Index of the stage, just before the strand.
    pub(super) stage: usize,
    /// Position of the strand in the printing order.
    pub(super) order: usize,
    /// Nodes of earlier strands, free to move, on which it begins and ends.
    pub(super) nodes: [Option<usize>; 2],
    /// Where those are among the nodes watched at the stage.
    pub(super) watched: [Option<usize>; 2],
    /// Where the trials of each end are among those of the stage.
    pub(super) pressed: [Option<Pressed>; 2],
    /// Trial: released while soft.
    pub(super) hangs: Option<usize>,
}

/// Trials with the nozzle on a node: its force nominal, and at its highest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Pressed {
    pub(super) nominal: usize,
    pub(super) high: usize,
}

/// Every strand that begins or ends on the frame; writes its trials and nodes into the stage before it.
pub(super) fn comings(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    plan: &mut [Planned],
) -> Vec<Coming> {
    let mut comings = Vec::new();
    let first_member = first_members(built);
    let mut before_strand = vec![None; built.ends.len() + 1];
    for (index, planned) in plan.iter().enumerate() {
        before_strand[planned.printed] = Some(index);
    }
    for (order, ends) in built.ends.iter().enumerate() {
        let Some(stage) = before_strand[order] else { continue };
        let before = &mut plan[stage];
        let is_free = |node: &usize| {
            first_member[*node] < before.stage.born
                && before.stage.supports.iter().all(|support| support.node != *node)
        };
        let nodes = ends.map(|node| Some(node).filter(is_free));
        if nodes == [None; 2] {
            continue;
        }
        let gravity_m_s2 = Vector::from(before.stage.gravity_m_s2);
        let hanging = hanging(job, printed, built, order, gravity_m_s2, nodes);
        let push = Push { job, axis: nozzle_axis(job, printed, order) };
        let pressed = [push.on(nodes[0], &[], before), push.on(nodes[1], &hanging, before)];
        let hangs = (!hanging.is_empty()).then(|| before.try_out(hanging, Some(State::Released)));
        let watched = nodes.map(|node| {
            before.stage.watch.push(node?);
            Some(before.stage.watch.len() - 1)
        });
        comings.push(Coming { stage, order, nodes, watched, pressed, hangs });
    }
    comings
}

struct Push<'a> {
    job: &'a Job,
    axis: Vector,
}

impl Push<'_> {
    /// Trials with the nozzle's force on a node, beside other loads.
    fn on(&self, node: Option<usize>, with: &[NodeLoad], before: &mut Planned) -> Option<Pressed> {
        let node = node?;
        let force_n = self.job.cell.extruder.nozzle_force_n;
        let loads = |newton: f64| {
            let f = self.axis * newton;
            let push = NodeLoad { node, load: [f.x, f.y, f.z, 0.0, 0.0, 0.0] };
            [&[push], with].concat()
        };
        Some(Pressed {
            nominal: before.try_out(loads(force_n.nominal), Some(State::Held)),
            high: before.try_out(loads(force_n.high), None),
        })
    }
}

/// The first member at each node; none: beyond all.
fn first_members(built: &Built) -> Vec<usize> {
    let mut first = vec![usize::MAX; built.frame.nodes().len()];
    for (index, member) in built.frame.members().iter().enumerate().rev() {
        for node in member.ends {
            first[node] = index;
        }
    }
    first
}

/// The weight of the soft strand on the nodes it hangs on: half at each end that is joined; all of it, with its moment, at the
/// start where the far end is free.
fn hanging(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    order: usize,
    gravity_m_s2: Vector,
    nodes: [Option<usize>; 2],
) -> Vec<NodeLoad> {
    let strand = &printed.deposit.strands[order];
    if !matches!(job.strands[strand.strand].on, crate::cell::On::Air) {
        return Vec::new();
    }
    let law = &printed.laws[order];
    let area_m2 = std::f64::consts::PI * law.diameter_m * law.diameter_m / 4.0;
    let weight_n = gravity_m_s2 * (law.density_kg_m3 * area_m2 * strand.length_m());
    let is_joined = |end: usize| {
        let node = built.ends[order][end];
        let on_bed = || built.grounded.iter().any(|(held, _)| *held == node);
        let on_form = || built.formed.iter().any(|(held, ..)| *held == node);
        nodes[end].is_some() || on_bed() || on_form()
    };
    let force =
        |node: usize, f: Vector, m: Vector| NodeLoad { node, load: [f.x, f.y, f.z, m.x, m.y, m.z] };
    let both = is_joined(0) && is_joined(1);
    match nodes {
        [start, end] if both => {
            let half = |node: usize| force(node, weight_n * 0.5, Vector::zeros());
            start.into_iter().chain(end).map(half).collect()
        }
        [Some(start), None] => {
            let arm_m = strand.planned_at(0.5 * strand.length_m()) - built.frame.nodes()[start];
            vec![force(start, weight_n, arm_m.cross(&weight_n))]
        }
        [None, Some(end)] => vec![force(end, weight_n, Vector::zeros())],
        _ => Vec::new(),
    }
}

/// Axis of the nozzle at the start of a strand, part axes; straight down where it was not reached.
fn nozzle_axis(job: &Job, printed: &Printed<'_>, order: usize) -> Vector {
    let strand = printed.deposit.strands[order].strand;
    let print = |leg: &&crate::motion::Leg| leg.phase == Phase::Print && leg.strand == Some(strand);
    let moment = printed.motion.legs.iter().find(print).and_then(|leg| leg.moments.first());
    let q = moment.map_or(&job.cell.home[..], |moment| &moment.q[..]);
    job.part_from_tool(q) * Vector::z()
}
