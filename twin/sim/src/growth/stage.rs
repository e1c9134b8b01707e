//! What each stage came to, and S403 to S405: members, buckling and nodes while printing.

use super::part::Part;
use super::{Built, Planned, Printed, Record, Shaken, imperfect};
use crate::cell::Job;
use crate::finding::{Check, Code, Findings, Site, Words, counted};
use crate::interval::Interval;
use crate::structure::{Buckled, Load, StageRecord, StageState};

/// A share of strength that is used, and where.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Used {
    /// 1 is the limit; interval by strength and by the nozzle's force.
    pub share: Interval,
    /// The member, or the weld.
    pub at: usize,
    /// What the nozzle is doing.
    pub state: State,
}

/// The three states of a stage (see `nozzle`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    /// About to touch.
    Touching,
    /// The nozzle presses on the node of a landing.
    Held,
    /// Just released while soft.
    Released,
}

impl State {
    /// The words for it.
    pub fn words(self) -> &'static str {
        match self {
            Self::Touching => "before the nozzle touches",
            Self::Held => "while the nozzle presses",
            Self::Released => "when the nozzle has left the soft strand",
        }
    }
}

/// One stage of the print as the report tells it.
#[derive(Debug, Clone, PartialEq)]
pub struct StageResult {
    /// Number of strands printed.
    pub printed: usize,
    /// The newest strand, as index in the job.
    pub strand: Option<usize>,
    /// The form just released, if this stage is a release.
    pub released: Option<usize>,
    /// Largest displacement, gravity on the frame as it stands so far, m; `None`: nothing solved.
    pub one_shot_m: Option<f64>,
    /// Its node.
    pub one_shot_node: Option<usize>,
    /// Largest displacement by weight when each strand is born stress-free on the frame as it then stands, m.
    pub staged_m: Option<f64>,
    /// Its node.
    pub staged_node: Option<usize>,
    /// The same with the strain that shrinkage locks in, m: about to touch, held, released while soft.
    pub states_m: [Option<f64>; 3],
    /// The most used member, of all three states.
    pub member: Option<Used>,
    /// The most used weld, of all three states.
    pub weld: Option<Used>,
    /// Buckling under weight and locked-in strain; `None`: not asked for, or not found.
    pub buckling: Option<Buckled>,
    /// Of the stage nearest to buckling, where that is near: the factor with an imperfection and large displacements.
    pub followed: Option<f64>,
    /// Whether a buckling factor was asked for and not found.
    pub buckling_failed: bool,
    /// What a bed that rides on the arm does to it while it stands, beyond weight; `None` where the bed stands
    /// still.
    pub shaken: Option<Shaken>,
    /// Largest pull on what bed or form holds over what it holds (S410); `None`: nothing there may lift.
    pub hold: Option<f64>,
    /// Largest displacement by a release with the shrinkage locked in, staged, m; `None`: no release, or a piece of which
    /// nothing is held any more.
    pub released_m: Option<f64>,
    /// Forces left out of balance relative to the loads, one-shot by weight.
    pub residual: f64,
}

/// The stages as results, judged.
pub(super) fn results(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    plan: &[Planned],
    records: &[Record],
    findings: &mut Findings,
) -> Vec<StageResult> {
    let result =
        |(planned, record): (&Planned, &Record)| result(job, printed, built, planned, record);
    let mut results: Vec<StageResult> = plan.iter().zip(records).map(result).collect();
    follow(built, plan, &mut results);
    for (planned, result) in plan.iter().zip(&results) {
        judge(job, printed, built, planned, result, findings);
    }
    results
}

/// Follows the stage that is nearest to buckling with large displacements, where it is near.
fn follow(built: &Built, plan: &[Planned], results: &mut [StageResult]) {
    let factor = |result: &StageResult| result.buckling.map_or(f64::INFINITY, |it| it.factor);
    let worst =
        (0..results.len()).min_by(|&a, &b| factor(&results[a]).total_cmp(&factor(&results[b])));
    let Some(worst) = worst.filter(|&worst| factor(&results[worst]) < imperfect::TRUSTED) else {
        return;
    };
    let stage = &plan[worst].stage;
    let born = built.frame.members()[..stage.born].iter().copied();
    let Some(part) = Part::new(built.frame.nodes(), born) else { return };
    let load =
        Load { gravity_m_s2: stage.gravity_m_s2, at_nodes: Vec::new(), with_initial_strain: true };
    results[worst].followed =
        imperfect::followed(&part.frame, &part.supports(&stage.supports), &load);
}

fn result(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    planned: &Planned,
    record: &Record,
) -> StageResult {
    let one_shot = record.by_weight.one_shot.as_ref();
    let staged = record.by_weight.staged.as_ref();
    let newest = planned.printed.checked_sub(1).map(|order| printed.deposit.strands[order].strand);
    let buckling = record.in_all.buckling.as_ref();
    let most =
        |state: Option<&StageState>| state.map(|state| (state.max_translation_m, state.max_node));
    StageResult {
        printed: planned.printed,
        strand: newest,
        released: planned.released,
        one_shot_m: most(one_shot).map(|it| it.0),
        one_shot_node: most(one_shot).map(|it| it.1),
        staged_m: most(staged).map(|it| it.0),
        staged_node: most(staged).map(|it| it.1),
        states_m: states_m(planned, &record.in_all),
        member: used(planned, &record.in_all, Side::Member).map(|(share, at, state)| {
            let strength = job.material.strength_pa;
            Used { share: by_strength(share, strength), at, state }
        }),
        weld: used(planned, &record.in_all, Side::Weld).map(|(share, weld, state)| {
            let strength = printed.bonds[built.weld_contact[weld]].tension_pa;
            Used { share: by_strength(share, strength), at: weld, state }
        }),
        buckling: buckling.and_then(|found| found.as_ref().ok()).copied(),
        followed: None,
        buckling_failed: buckling.is_some_and(Result::is_err),
        shaken: None,
        hold: None,
        released_m: None,
        residual: one_shot.map_or(0.0, |state| state.residual),
    }
}

/// A share of strength with the range that a strength leaves.
fn by_strength(share: Interval, strength: Interval) -> Interval {
    Interval::new(
        share.nominal,
        share.low * strength.nominal / strength.high,
        if strength.low > 0.0 {
            share.high * strength.nominal / strength.low
        } else {
            f64::INFINITY
        },
    )
}

fn states_m(planned: &Planned, record: &StageRecord) -> [Option<f64>; 3] {
    let most = |state: State| {
        let trials = record.trials.iter().enumerate();
        let of_state = trials.filter(|(trial, _)| planned.state_of(*trial) == Some(state));
        of_state.map(|(_, trial)| trial.max_translation_m).reduce(f64::max)
    };
    let touching = record.staged.as_ref().map(|state| state.max_translation_m);
    [touching, most(State::Held), most(State::Released)]
}

/// What is asked for its share of strength.
#[derive(Clone, Copy)]
enum Side {
    Member,
    Weld,
}

/// The share used at the worst state, with the range that the nozzle's force leaves; where, and which state.
fn used(planned: &Planned, record: &StageRecord, side: Side) -> Option<(Interval, usize, State)> {
    let staged = record.staged.as_ref()?;
    let of_state = match side {
        Side::Member => staged.utilisation.map(|used| (used.value, used.member)),
        Side::Weld => staged.weld.map(|used| (used.value, used.weld)),
    };
    let (alone, at) = of_state?;
    let (mut worst, mut high) = ((alone, at, State::Touching), alone);
    for (index, trial) in record.trials.iter().enumerate() {
        let of_trial = match side {
            Side::Member => trial.utilisation.map(|used| (used.value, used.member)),
            Side::Weld => trial.weld.map(|used| (used.value, used.weld)),
        };
        let Some((value, at)) = of_trial else { continue };
        high = high.max(value);
        if let Some(state) = planned.state_of(index)
            && value > worst.0
        {
            worst = (value, at, state);
        }
    }
    Some((Interval::new(worst.0, alone.min(worst.0), high), worst.1, worst.2))
}

fn judge(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    planned: &Planned,
    result: &StageResult,
    findings: &mut Findings,
) {
    let site_of = |order: usize, member: Option<usize>, node: usize| Site {
        strand: Some(printed.deposit.strands[order].strand),
        stage: Some(result.printed),
        member,
        node: Some(node),
        point: Some(built.frame.nodes()[node]),
        ..Site::default()
    };
    let id = |order: usize| &job.strands[printed.deposit.strands[order].strand].id;
    let time_s = Some(planned.time_s);
    if let Some(used) = &result.member {
        let order = built.member_order[used.at];
        let site = site_of(order, Some(used.at), built.frame.members()[used.at].ends[0]);
        let limit = job.limits.strength_share;
        let check =
            Check { code: Code::S403, measured: used.share, limit, warn_limit: None, site, time_s };
        findings.check(check, || Words {
            message: format!(
                "strand `{}` is strained to {:.0} % of its strength after {}, {}",
                id(order), used.share.nominal * 100.0, counted(result.printed, "strand"), used.state.words()
            ),
            hint: "brace the frame before more hangs on it, thicken the strand, or let it shrink before its far end is joined"
                .to_owned(),
        });
    }
    if let Some(used) = &result.weld {
        let order = printed.contacts[built.weld_contact[used.at]].orders[0];
        let node = built.welds[used.at].node;
        let site = site_of(order, None, node);
        let limit = job.limits.strength_share;
        let check =
            Check { code: Code::S405, measured: used.share, limit, warn_limit: None, site, time_s };
        findings.check(check, || Words {
            message: format!(
                "node {} where `{}` holds to the frame is strained to {:.0} % of its strength after {}, {}",
                node, id(order), used.share.nominal * 100.0, counted(result.printed, "strand"), used.state.words()
            ),
            hint: "press the beads nearer together, dwell at the node, or bring another strand to it first"
                .to_owned(),
        });
    }
    if let Some(buckled) = result.buckling.filter(|buckled| buckled.factor.is_finite()) {
        let order = built.member_order[buckled.member];
        let site =
            site_of(order, Some(buckled.member), built.frame.members()[buckled.member].ends[0]);
        // The load is there whatever the modulus: the factor goes with E.
        let e = job.material.youngs_modulus_pa;
        let factor = result.followed.unwrap_or(buckled.factor);
        let measured = e.map(|e_pa| factor * e_pa / e.nominal);
        let limit = job.limits.buckling_factor;
        let check = Check { code: Code::S404, measured, limit, warn_limit: None, site, time_s };
        findings.check(check, || Words {
            message: format!(
                "after {} the frame buckles at {:.2} times what it carries; `{}` moves most",
                counted(result.printed, "strand"),
                factor,
                id(order)
            ),
            hint: "shorten or thicken the strand, or brace its middle before more is hung on it"
                .to_owned(),
        });
    }
}
