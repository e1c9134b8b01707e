//! The frame as it grows: strands and contacts become nodes and members, every stage is solved,
//! and what the nozzle meets at each landing is added up.
//!
//! The mechanics are in `structure`; here is what a print makes of them.

mod build;
mod hold;
mod landing;
mod loads;
#[cfg(test)]
mod tests;

pub use build::{Built, StrandLaw, build};
pub use landing::Landing;
pub use loads::LoadResult;

use crate::cell::Job;
use crate::deposit::{Contact, Deposit};
use crate::finding::{Code, Findings, Phase, Site, Words};
use crate::motion::{Leg, Motion};
use crate::pose::Vector;
use crate::structure::{Ask, SolveError, Stage, StageRecord, Strength, solve_stages};

/// Displacements of every node at every stage are kept up to this many numbers; beyond it the
/// landing check (S401) is left out and the report says so.
const KEEP_MAX: usize = 15_000_000;

/// One stage of the print as the report tells it.
#[derive(Debug, Clone, PartialEq)]
pub struct StageResult {
    /// Number of strands printed.
    pub printed: usize,
    /// The form just released, if this stage is a release.
    pub released: Option<usize>,
    /// Largest displacement, gravity on the frame as it stands so far, m; `None`: nothing solved.
    pub one_shot_m: Option<f64>,
    /// Largest displacement when each strand is born stress-free on the frame as it then stands, m.
    pub staged_m: Option<f64>,
    /// Node of the largest one-shot displacement.
    pub node: Option<usize>,
    /// Largest share of strength used, one-shot.
    pub utilisation: Option<f64>,
    /// Forces left out of balance relative to the loads, one-shot.
    pub residual: f64,
    /// Largest pull on what bed or form holds over what it holds (S410).
    pub hold: Option<f64>,
    /// Largest displacement by a release with the shrinkage locked in, staged, m; `None`: no release,
    /// or a piece of which nothing is held any more.
    pub released_m: Option<f64>,
}

/// What became of the frame.
#[derive(Debug, Clone)]
pub struct Growth {
    /// Nodes and members.
    pub built: Built,
    /// One entry per stage.
    pub stages: Vec<StageResult>,
    /// One entry per strand end that lands on the frame.
    pub landings: Vec<Landing>,
    /// One entry per load case.
    pub loads: Vec<LoadResult>,
    /// Whether the frame was too large for the landing check.
    pub landing_skipped: bool,
}

/// What is known about the deposit when its mechanics are asked for.
#[derive(Debug, Clone, Copy)]
pub struct Printed<'a> {
    /// As printed.
    pub deposit: &'a Deposit,
    /// Where beads touch.
    pub contacts: &'a [Contact],
    /// Section, moduli and strain of each strand, in printing order.
    pub laws: &'a [StrandLaw],
    /// The motion, for gravity and releases.
    pub motion: &'a Motion,
}

/// Solves every stage and load case, and judges them.
///
/// # Errors
/// A frame too large to index.
pub fn grow(
    job: &Job,
    printed: &Printed<'_>,
    findings: &mut Findings,
) -> Result<Growth, SolveError> {
    let built = build(job, printed.deposit, printed.contacts, printed.laws);
    let plan = plan(job, printed, &built);
    let strengths: Vec<Strength> = built.strengths(printed.laws);
    let n_numbers = plan.len() * built.frame.nodes().len() * 12;
    let landing_skipped = n_numbers > KEEP_MAX;
    let keep: Vec<usize> = if landing_skipped { Vec::new() } else { (0..plan.len()).collect() };
    let stages: Vec<Stage> = plan.iter().map(|planned| planned.stage.clone()).collect();
    let ask = Ask { staged: true, strengths: &strengths, keep: &keep };
    let records = solve_stages(&built.weightless_strain(), &stages, ask)?;
    let held = hold::judge(job, printed, &built, (&plan, &stages), findings)?;
    let results = plan
        .iter()
        .zip(&records)
        .zip(&held)
        .map(|((planned, record), held)| result(planned, record, held))
        .collect();
    for (planned, record) in plan.iter().zip(&records) {
        floats(job, printed, &built, planned, record, findings);
    }
    let landings = if landing_skipped {
        Vec::new()
    } else {
        landing::landings(job, printed, &built, &plan, &records, findings)?
    };
    let loads = loads::solve_all(job, &built, &strengths, findings);
    Ok(Growth { built, stages: results, landings, loads, landing_skipped })
}

/// A stage with what it stands for.
#[derive(Debug, Clone)]
struct Planned {
    printed: usize,
    released: Option<usize>,
    time_s: f64,
    stage: Stage,
}

/// Stages in order of time: one after each strand, one after each release.
fn plan(job: &Job, printed: &Printed<'_>, built: &Built) -> Vec<Planned> {
    let motion = printed.motion;
    let mut plan = Vec::new();
    let mut held_forms: Vec<bool> = vec![true; job.forms.len()];
    let mut releases = motion.releases.iter().peekable();
    for n_printed in 0..=motion.printings.len() {
        if let Some(printing) = n_printed.checked_sub(1).map(|k| motion.printings[k]) {
            let stage = stage(job, printed, built, n_printed, &held_forms);
            plan.push(Planned {
                printed: n_printed,
                released: None,
                time_s: printing.end_s,
                stage,
            });
        }
        while let Some(&&(form, _, time_s)) =
            releases.peek().filter(|release| release.1 == n_printed)
        {
            releases.next();
            held_forms[form] = false;
            let stage = stage(job, printed, built, n_printed, &held_forms);
            plan.push(Planned { printed: n_printed, released: Some(form), time_s, stage });
        }
    }
    plan
}

fn stage(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    n_printed: usize,
    held_forms: &[bool],
) -> Stage {
    Stage {
        born: built.born[n_printed],
        supports: built.supports(n_printed, held_forms),
        gravity_m_s2: gravity(job, printed.motion, n_printed).into(),
        at_nodes: Vec::new(),
        stiffness: Vec::new(),
    }
}

/// Gravity in part axes when the nozzle comes to the strand after `n_printed` others; after the
/// last one, where the arm came to rest.
fn gravity(job: &Job, motion: &Motion, n_printed: usize) -> Vector {
    let chain = &job.cell.robot.arm.chain;
    let prints = |leg: &&Leg| leg.phase == Phase::Print && leg.printed == n_printed;
    let next = motion.legs.iter().find(prints).and_then(|leg| leg.moments.first());
    let last = || motion.legs.iter().rev().find_map(|leg| leg.moments.last());
    let q = next.or_else(last).map(|moment| moment.q);
    let world_from_tip = q.map_or_else(|| chain.forward(&job.cell.home), |q| chain.forward(&q));
    job.gravity_in_part(&world_from_tip)
}

fn result(planned: &Planned, record: &StageRecord, held: &hold::StageHold) -> StageResult {
    let one_shot = record.one_shot.as_ref();
    StageResult {
        printed: planned.printed,
        released: planned.released,
        one_shot_m: one_shot.map(|state| state.max_translation_m),
        staged_m: record.staged.as_ref().map(|state| state.max_translation_m),
        node: one_shot.map(|state| state.max_node),
        utilisation: one_shot.and_then(|state| state.utilisation).map(|used| used.value),
        residual: one_shot.map_or(0.0, |state| state.residual),
        hold: held.share,
        released_m: held.released_m,
    }
}

/// S402: a piece of the frame that nothing holds.
fn floats(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    planned: &Planned,
    record: &StageRecord,
    findings: &mut Findings,
) {
    let Some(order) = planned.printed.checked_sub(1) else { return };
    let newest = printed.deposit.strands[order].strand;
    let check = |findings: &mut Findings, found: bool, strand: usize, node: Option<usize>| {
        let site = Site {
            strand: Some(strand),
            at_m: Some(0.0),
            stage: Some(planned.printed),
            node,
            point: node.map(|node| built.frame.nodes()[node]),
            ..Site::default()
        };
        findings.forbid(Code::S402, found, site, Some(planned.time_s), || Words {
            message: format!(
                "strand `{}` hangs on nothing once {} strands are printed",
                job.strands[strand].id, planned.printed
            ),
            hint: "print what it rests on first, start it on the bed, or join it to a strand it touches".to_owned(),
        });
    };
    check(findings, false, newest, None);
    for &node in &record.floats {
        let order = built.strand_at(node).unwrap_or(order);
        check(findings, true, printed.deposit.strands[order].strand, Some(node));
    }
    if let Some((node, _)) = record.mechanism {
        let order = built.strand_at(node).unwrap_or(order);
        check(findings, true, printed.deposit.strands[order].strand, Some(node));
    }
}
