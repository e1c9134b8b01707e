//! The frame as it grows: strands and contacts become nodes and members, every stage is solved,
//! and what the nozzle meets at each landing is added up.
//!
//! The mechanics are in `structure`; here is what a print makes of them.

mod build;
mod built;
mod hold;
mod imperfect;
mod landing;
mod loads;
mod nozzle;
mod part;
mod remedy;
mod riding;
mod shown;
mod stage;
mod strand_law;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_contacts;
#[cfg(test)]
mod tests_riding;
mod welds;

pub use build::build;
pub use built::Built;
pub use landing::Landing;
pub use loads::{LoadResult, Yield};
pub use remedy::{Change, Remedy};
pub use riding::Shaken;
pub use shown::{Cause, Fails, Shown, ShownStage};
pub use stage::{StageResult, State, Used};
pub use strand_law::StrandLaw;
pub use welds::Bond;

use crate::cell::Job;
use crate::deposit::{Contact, Deposit};
use crate::finding::{Code, Findings, Phase, Site, Words};
use crate::motion::{Leg, Motion};
use crate::pose::Vector;
use crate::structure::{Ask, NodeLoad, SolveError, Stage, StageRecord, Trial, solve_stages};

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
    /// What pictures show of it.
    pub shown: Shown,
}

/// What is known about the deposit when its mechanics are asked for.
#[derive(Debug, Clone, Copy)]
pub struct Printed<'a> {
    /// As printed.
    pub deposit: &'a Deposit,
    /// Where beads touch.
    pub contacts: &'a [Contact],
    /// What holds there, in the same order.
    pub bonds: &'a [Bond],
    /// Section, moduli and strain of each strand, in printing order.
    pub laws: &'a [StrandLaw],
    /// The motion, for gravity and releases.
    pub motion: &'a Motion,
}

/// Stages of which the buckling factor is asked, beside those that Euler's screen flags.
const BUCKLING_STAGES: usize = 16;

/// Solves every stage and load case, and judges them.
///
/// Two runs over the same stages, side by side: weight alone, which is what other programs give; and weight with the strain
/// that shrinkage has locked in, which is what strains members and nodes. In the second the nozzle tries the frame at every
/// landing ([`nozzle`]).
///
/// # Errors
/// A frame too large to index.
pub fn grow(
    job: &Job,
    printed: &Printed<'_>,
    findings: &mut Findings,
) -> Result<Growth, SolveError> {
    let built = build(job, printed);
    let mut plan = plan(job, printed, &built);
    let comings = nozzle::comings(job, printed, &built, &mut plan);
    let stages: Vec<Stage> = plan.iter().map(|planned| planned.stage.clone()).collect();
    let strengths = built.strengths(printed.laws);
    let whole = Ask {
        staged: true,
        strengths: &strengths,
        welds: &built.welds,
        buckling_every: plan.len().div_ceil(BUCKLING_STAGES),
        keep: &[plan.len().saturating_sub(1)],
    };
    let unloaded = |stage: &Stage| Stage { trials: Vec::new(), ..stage.clone() };
    let bare: Vec<Stage> = stages.iter().map(unloaded).collect();
    let keep = shown::kept(plan.len(), built.frame.nodes().len());
    let weight = Ask { staged: true, keep: &keep, ..Ask::default() };
    let (by_weight, in_all) = rayon::join(
        || solve_stages(&built.weightless_strain(), &bare, weight),
        || solve_stages(&built.frame, &stages, whole),
    );
    let records: Vec<Record> = by_weight?
        .into_iter()
        .zip(in_all?)
        .map(|(by_weight, in_all)| Record { by_weight, in_all })
        .collect();
    let shaken = riding::shaken(job, printed.motion, &built, &plan)?;
    riding::judge(job, &built, &plan, &shaken, findings);
    let mut results = stage::results(job, printed, &built, &plan, &records, findings);
    let held = hold::judge(job, printed, &built, (&plan, &bare), findings)?;
    for ((result, shaken), held) in results.iter_mut().zip(shaken).zip(held) {
        result.shaken = shaken;
        result.hold = held.share;
        result.released_m = held.released_m;
    }
    for (planned, record) in plan.iter().zip(&records) {
        floats(job, printed, &built, planned, &record.in_all, findings);
    }
    let landings = landing::landings(job, printed, &built, &plan, &comings, &records, findings);
    let loads = loads::solve_all(job, printed, &built, &strengths, findings);
    let shown = shown::shown(&built, &plan, &records);
    Ok(Growth { built, stages: results, landings, loads, shown })
}

/// A stage with what it stands for.
#[derive(Debug, Clone)]
struct Planned {
    printed: usize,
    released: Option<usize>,
    time_s: f64,
    stage: Stage,
    /// State that each trial of the stage shows; `None`: the nozzle's force at its highest.
    states: Vec<Option<State>>,
}

impl Planned {
    /// What a trial shows; `None` where it only bounds another.
    fn state_of(&self, trial: usize) -> Option<State> {
        self.states.get(trial).copied().flatten()
    }

    /// Adds a trial; its place among them.
    fn try_out(&mut self, loads: Vec<NodeLoad>, shows: Option<State>) -> usize {
        self.stage.trials.push(Trial { loads, is_bound: shows.is_none() });
        self.states.push(shows);
        self.states.len() - 1
    }
}

/// What a stage came to.
#[derive(Debug, Clone)]
struct Record {
    /// Under its weight alone.
    by_weight: StageRecord,
    /// Under its weight, locked-in strain and the nozzle.
    in_all: StageRecord,
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
                states: Vec::new(),
            });
        }
        while let Some(&&(form, _, time_s)) =
            releases.peek().filter(|release| release.1 == n_printed)
        {
            releases.next();
            held_forms[form] = false;
            let stage = stage(job, printed, built, n_printed, &held_forms);
            let states = Vec::new();
            plan.push(Planned { printed: n_printed, released: Some(form), time_s, stage, states });
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
        stiffness: stiffness(printed, built, n_printed),
        ..Stage::default()
    }
}

/// Share of its modulus that each member has when the nozzle comes back after `n_printed` strands; empty: all of it.
///
/// The newest strand counts as set: how it bends before, `process` says, and its sag is in the geometry.
fn stiffness(printed: &Printed<'_>, built: &Built, n_printed: usize) -> Vec<f64> {
    let strands = &printed.deposit.strands;
    let now_s = strands.get(n_printed).or(strands.last()).map_or(f64::INFINITY, |next| next.born_s);
    let share = |order: usize| {
        if order + 1 == n_printed || n_printed == strands.len() {
            return 1.0;
        }
        let middle_s = 0.5 * (strands[order].born_s + strands[order].done_s);
        printed.laws[order].share_at((now_s - middle_s).max(0.0))
    };
    let by_strand: Vec<f64> = (0..n_printed).map(share).collect();
    if by_strand.iter().all(|&share| share == 1.0) {
        return Vec::new();
    }
    built.member_order[..built.born[n_printed]].iter().map(|&order| by_strand[order]).collect()
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
