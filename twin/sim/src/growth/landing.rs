//! S401: where a node is when the nozzle comes back to it.

use super::{Built, Planned, Printed};
use crate::cell::Job;
use crate::finding::{Check, Code, Findings, Phase, Site, Words};
use crate::interval::Interval;
use crate::pose::Vector;
use crate::structure::{Ask, NodeLoad, SolveError, Stage, StageRecord, StageState, solve_stages};

/// What moves a node that a strand begins or ends on, each part by itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Landing {
    /// Strand (index in the job) that lands.
    pub strand: usize,
    /// Whether it is its end rather than its start.
    pub at_end: bool,
    /// The node.
    pub node: usize,
    /// Displacement by gravity on the frame so far, staged, m, part axes.
    pub frame_m: Vector,
    /// Displacement by the shrinkage of strands that are joined at both ends, staged, m.
    pub shrinkage_m: Vector,
    /// Displacement by the nozzle's push along its axis, m, and the interval of its length.
    pub push_m: Vector,
    /// Length of the push, with its interval, m.
    pub push_length_m: Interval,
    /// Length of the sum of the three, m.
    pub sum_m: f64,
    /// Accuracy of the arm, m; widens the interval, its direction is unknown.
    pub accuracy_m: f64,
}

/// Judges every landing on a node that is already there.
///
/// ```text
/// miss = |u_frame + u_shrinkage + u_push|      interval: ± accuracy, push from its low to its high
/// ```
///
/// `u_push = K⁻¹ f n̂` with the nozzle's force along its axis. The end-point error of a strand
/// whose end hangs free is P304 and is not counted again.
pub(super) fn landings(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    plan: &[Planned],
    by_gravity: &[StageRecord],
    findings: &mut Findings,
) -> Result<Vec<Landing>, SolveError> {
    let keep: Vec<usize> = (0..plan.len()).collect();
    let by_shrinkage = if printed.laws.iter().all(|law| law.strain == 0.0) {
        None
    } else {
        let weightless =
            |planned: &Planned| Stage { gravity_m_s2: [0.0; 3], ..planned.stage.clone() };
        let stages: Vec<Stage> = plan.iter().map(weightless).collect();
        let ask = Ask { staged: true, strengths: &[], keep: &keep };
        Some(solve_stages(&built.frame, &stages, ask)?)
    };
    let pushed = push_stages(job, printed, built, plan);
    let stages: Vec<Stage> = pushed.iter().map(|(_, stage)| stage.clone()).collect();
    let all: Vec<usize> = (0..stages.len()).collect();
    let ask = Ask { staged: false, strengths: &[], keep: &all };
    let by_push = solve_stages(&built.weightless_strain(), &stages, ask)?;
    let mut landings = Vec::new();
    for ((landing, _), push) in pushed.iter().zip(&by_push) {
        let before = plan.iter().rposition(|planned| planned.printed == landing.printed);
        let Some(before) = before else { continue };
        let at = |state: Option<&StageState>| displacement(state, landing.node);
        let frame_m = at(by_gravity[before].staged.as_ref());
        let shrinkage_m = by_shrinkage
            .as_ref()
            .map_or_else(Vector::zeros, |records| at(records[before].staged.as_ref()));
        let landing = landing.sum(job, frame_m, shrinkage_m, at(push.one_shot.as_ref()));
        judge(job, printed, built, &landing, findings);
        landings.push(landing);
    }
    Ok(landings)
}

fn displacement(state: Option<&StageState>, node: usize) -> Vector {
    let six = state.and_then(|state| state.displacement.get(node));
    six.map_or_else(Vector::zeros, |u| Vector::new(u[0], u[1], u[2]))
}

/// A landing before its displacements are known.
struct Bare {
    printed: usize,
    strand: usize,
    at_end: bool,
    node: usize,
}

impl Bare {
    fn sum(&self, job: &Job, frame_m: Vector, shrinkage_m: Vector, push_m: Vector) -> Landing {
        let force_n = job.cell.extruder.nozzle_force_n;
        let per_newton = if force_n.nominal > 0.0 { push_m.norm() / force_n.nominal } else { 0.0 };
        Landing {
            strand: self.strand,
            at_end: self.at_end,
            node: self.node,
            frame_m,
            shrinkage_m,
            push_m,
            push_length_m: force_n.scaled(per_newton),
            sum_m: (frame_m + shrinkage_m + push_m).norm(),
            accuracy_m: job.cell.robot.accuracy_m,
        }
    }
}

/// For every strand end on a node of earlier strands, the frame as it then is with the nozzle's
/// force on that node. A node the bed or a form holds does not move and is left out.
fn push_stages(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    plan: &[Planned],
) -> Vec<(Bare, Stage)> {
    let force_n = job.cell.extruder.nozzle_force_n.nominal;
    let mut stages = Vec::new();
    for (order, ends) in built.ends.iter().enumerate() {
        let Some(before) = plan.iter().rfind(|planned| planned.printed == order) else { continue };
        let strand = printed.deposit.strands[order].strand;
        let axis = nozzle_axis(job, printed, strand);
        for (at_end, &node) in [(false, &ends[0]), (true, &ends[1])] {
            let is_there =
                built.frame.members()[..before.stage.born].iter().any(|m| m.ends.contains(&node));
            let is_held = before.stage.supports.iter().any(|support| support.node == node);
            if !is_there || is_held {
                continue;
            }
            let f = axis * force_n;
            let load = NodeLoad { node, load: [f.x, f.y, f.z, 0.0, 0.0, 0.0] };
            let stage =
                Stage { gravity_m_s2: [0.0; 3], at_nodes: vec![load], ..before.stage.clone() };
            stages.push((Bare { printed: order, strand, at_end, node }, stage));
        }
    }
    stages
}

/// Axis of the nozzle at the start of a strand, part axes; straight down where it was not reached.
fn nozzle_axis(job: &Job, printed: &Printed<'_>, strand: usize) -> Vector {
    let print = |leg: &&crate::motion::Leg| leg.phase == Phase::Print && leg.strand == Some(strand);
    let moment = printed.motion.legs.iter().find(print).and_then(|leg| leg.moments.first());
    let q = moment.map_or(&job.cell.home[..], |moment| &moment.q[..]);
    job.part_from_tool(q) * Vector::z()
}

fn judge(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    landing: &Landing,
    findings: &mut Findings,
) {
    let push = landing.push_length_m;
    let measured = Interval::new(
        landing.sum_m,
        (landing.sum_m - (push.nominal - push.low) - landing.accuracy_m).max(0.0),
        landing.sum_m + (push.high - push.nominal) + landing.accuracy_m,
    );
    let length_m = printed
        .deposit
        .strands
        .iter()
        .find(|p| p.strand == landing.strand)
        .map_or(0.0, |p| p.at_m.last().copied().unwrap_or(0.0));
    let at_m = if landing.at_end { length_m } else { 0.0 };
    let site = Site {
        strand: Some(landing.strand),
        at_m: Some(at_m),
        node: Some(landing.node),
        point: Some(built.frame.nodes()[landing.node]),
        ..Site::default()
    };
    let limit = job.limits.node_miss_m;
    let check = Check { code: Code::S401, measured, limit, warn_limit: None, site, time_s: None };
    findings.check(check, || {
        let mm = |v: f64| v * 1e3;
        let parts = [
            ("frame", landing.frame_m.norm()),
            ("shrinkage", landing.shrinkage_m.norm()),
            ("nozzle push", push.nominal),
        ];
        let largest = parts.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or("", |part| part.0);
        Words {
            message: format!(
                "strand `{}` {} on node {} that has moved {:.2} mm: frame {:.2}, shrinkage {:.2}, nozzle push {:.2}; the arm adds ± {:.2}",
                job.strands[landing.strand].id,
                if landing.at_end { "ends" } else { "begins" },
                landing.node,
                mm(landing.sum_m),
                mm(landing.frame_m.norm()),
                mm(landing.shrinkage_m.norm()),
                mm(push.nominal),
                mm(landing.accuracy_m)
            ),
            hint: format!("most of it is {largest}: brace the node before landing on it, or print another strand first"),
        }
    });
}
