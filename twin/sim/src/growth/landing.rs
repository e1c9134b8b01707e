//! S401: where a node is when the nozzle comes back to it.

use super::nozzle::Coming;
use super::remedy::{Remedy, remedies};
use super::{Built, Planned, Printed, Record};
use crate::cell::Job;
use crate::finding::{Check, Code, Findings, Site, Words};
use crate::interval::Interval;
use crate::pose::Vector;
use crate::structure::{StageRecord, StageState};

/// What moves a node that a strand begins or ends on, each part by itself.
#[derive(Debug, Clone, PartialEq)]
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
    /// How far the strand it lands on lies from its plan at that place, by its own sag and shrinkage, m.
    pub sag_m: Vector,
    /// Displacement by the weight of the strand that lands, hanging soft between its ends, m.
    pub weight_m: Vector,
    /// Displacement by the nozzle's push along its axis, m.
    pub push_m: Vector,
    /// Length of the push, with its interval, m.
    pub push_length_m: Interval,
    /// Length of the sum of the five, m.
    pub sum_m: f64,
    /// Accuracy of the arm, m; widens the interval, its direction is unknown.
    pub accuracy_m: f64,
    /// What would mend it, and the sum after; empty where it is inside its limit.
    pub remedies: Vec<Remedy>,
}

/// Judges every landing on a node that is already there.
///
/// ```text
/// miss = |u_frame + u_shrinkage + u_sag + u_weight + u_push|
/// interval: ± accuracy, push from its low to its high
/// ```
///
/// `u_push = K⁻¹ f n̂` with the nozzle's force along its axis. Sag and shrinkage of a strand move it in the geometry as
/// printed; what its shrinkage does to the frame it is joined to is `u_shrinkage`: no part is counted twice. A strand that lies
/// from its plan so far that it no longer touches is S402's.
pub(super) fn landings(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    plan: &[Planned],
    comings: &[Coming],
    records: &[Record],
    findings: &mut Findings,
) -> Vec<Landing> {
    let mut landings = Vec::new();
    for coming in comings {
        for end in 0..2 {
            let Some(mut landing) =
                landing(job, printed, built, coming, &records[coming.stage], end)
            else {
                continue;
            };
            if landing.high_m() > job.limits.node_miss_m {
                landing.remedies = remedies(job, printed, built, plan, coming, &landing);
            }
            judge(job, printed, built, &landing, findings);
            landings.push(landing);
        }
    }
    landings
}

fn landing(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    coming: &Coming,
    record: &Record,
    end: usize,
) -> Option<Landing> {
    let node = coming.nodes[end]?;
    let watched = coming.watched[end]?;
    let by_weight = displacement(record.by_weight.staged.as_ref(), watched);
    let in_all = displacement(record.in_all.staged.as_ref(), watched);
    let hung = coming.hangs.map_or_else(Vector::zeros, |trial| at(&record.in_all, trial, node));
    let pressed = at(&record.in_all, coming.pressed[end]?.nominal, node);
    let weight_m = if end == 1 { hung } else { Vector::zeros() };
    let push_m = pressed - weight_m;
    let sag_m = sag(printed, built, coming.order, end);
    let force_n = job.cell.extruder.nozzle_force_n;
    let per_newton = if force_n.nominal > 0.0 { push_m.norm() / force_n.nominal } else { 0.0 };
    Some(Landing {
        strand: printed.deposit.strands[coming.order].strand,
        at_end: end == 1,
        node,
        frame_m: by_weight,
        shrinkage_m: in_all - by_weight,
        sag_m,
        weight_m,
        push_m,
        push_length_m: force_n.scaled(per_newton),
        sum_m: (in_all + sag_m + weight_m + push_m).norm(),
        accuracy_m: job.cell.robot.accuracy_m,
        remedies: Vec::new(),
    })
}

fn displacement(state: Option<&StageState>, watched: usize) -> Vector {
    let six = state.and_then(|state| state.watched.get(watched));
    six.map_or_else(Vector::zeros, |u| Vector::new(u[0], u[1], u[2]))
}

/// What a trial does to one of the nodes it acts on.
fn at(record: &StageRecord, trial: usize, node: usize) -> Vector {
    let six = record.trials.get(trial).and_then(|trial| {
        trial.displacement.iter().find(|(of, _)| *of == node).map(|(_, six)| six)
    });
    six.map_or_else(Vector::zeros, |u| Vector::new(u[0], u[1], u[2]))
}

/// How far the earlier strand that this end touches lies from its plan there.
fn sag(printed: &Printed<'_>, built: &Built, order: usize, end: usize) -> Vector {
    let length_m = printed.deposit.strands[order].length_m();
    let end_m = if end == 1 { length_m } else { 0.0 };
    let nearest = built
        .contacts_of(order)
        .iter()
        .map(|&contact| &printed.contacts[contact])
        .min_by(|a, b| (a.at_m[0] - end_m).abs().total_cmp(&(b.at_m[0] - end_m).abs()));
    nearest.map_or_else(Vector::zeros, |contact| {
        let earlier = &printed.deposit.strands[contact.orders[1]];
        earlier.printed_at(contact.at_m[1]) - earlier.planned_at(contact.at_m[1])
    })
}

impl Landing {
    /// The sum, m.
    fn miss_m(&self) -> Vector {
        self.frame_m + self.shrinkage_m + self.sag_m + self.weight_m + self.push_m
    }

    /// Its length at its highest, m.
    pub(super) fn high_m(&self) -> f64 {
        let push = self.push_length_m;
        self.sum_m + (push.high - push.nominal) + self.accuracy_m
    }

    fn measured(&self) -> Interval {
        let push = self.push_length_m;
        let low_m = self.sum_m - (push.nominal - push.low) - self.accuracy_m;
        Interval::new(self.sum_m, low_m.max(0.0), self.high_m())
    }

    /// The parts by name, m.
    pub fn parts(&self) -> [(&'static str, f64); 5] {
        [
            ("frame", self.frame_m.norm()),
            ("shrinkage", self.shrinkage_m.norm()),
            ("sag", self.sag_m.norm()),
            ("weight of the strand", self.weight_m.norm()),
            ("nozzle push", self.push_m.norm()),
        ]
    }
}

fn judge(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    landing: &Landing,
    findings: &mut Findings,
) {
    let strand = printed.deposit.strands.iter().find(|p| p.strand == landing.strand);
    let length_m = strand.map_or(0.0, |p| p.length_m());
    let time_s = strand.map(|p| if landing.at_end { p.done_s } else { p.born_s });
    // the node as it is built lies where the earlier strand has sagged to
    let planned = built.frame.nodes()[landing.node] - landing.sag_m;
    let site = Site {
        strand: Some(landing.strand),
        at_m: Some(if landing.at_end { length_m } else { 0.0 }),
        node: Some(landing.node),
        point: Some(planned),
        found: Some(planned + landing.miss_m()),
        ..Site::default()
    };
    let limit = job.limits.node_miss_m;
    let measured = landing.measured();
    let check = Check { code: Code::S401, measured, limit, warn_limit: None, site, time_s };
    findings.check(check, || {
        let mm = |v: f64| v * 1e3;
        let parts = landing.parts();
        let told: Vec<String> = parts
            .iter()
            .filter(|(_, m)| mm(*m) >= 0.005)
            .map(|(name, m)| format!("{name} {:.2}", mm(*m)))
            .collect();
        let largest = parts.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or("", |part| part.0);
        Words {
            message: format!(
                "strand `{}` {} on node {} that has moved {:.2} mm: {}; the arm adds ± {:.2}",
                job.strands[landing.strand].id,
                if landing.at_end { "ends" } else { "begins" },
                landing.node,
                mm(landing.sum_m),
                told.join(", "),
                mm(landing.accuracy_m)
            ),
            hint: hint(job, landing, largest),
        }
    });
}

/// What is most of it, and what would mend it, the easiest first.
fn hint(job: &Job, landing: &Landing, largest: &str) -> String {
    let told: Vec<String> = landing
        .remedies
        .iter()
        .map(|remedy| format!("{} ({:.2} mm left)", remedy.change.words(job), remedy.left_m * 1e3))
        .collect();
    let otherwise = "brace the node before landing on it";
    let ways = if told.is_empty() { otherwise.to_owned() } else { told.join(", or ") };
    format!("most of it is {largest}: {ways}")
}
