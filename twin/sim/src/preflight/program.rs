//! What the program asks of the arm beyond its path: drives, payload, hoses, time, calibration.

use super::Totals;
use super::tracking::{Tracking, tracking};
use crate::cell::{Job, Mode};
use crate::deposit::{Contact, Deposit};
use crate::dynamics::{self, Body};
use crate::finding::{Findings, Phase};
use crate::interval::Interval;
use crate::kinematics::Posture;
use crate::motion::{Load, Motion};
use crate::program::{
    CycleTimes, DriveLoad, DrivePeak, HoseUse, Meeting, Payload, StrandBudget, StrandSpeed,
};
use crate::program::{budget, cycle, hoses, speeds};
use crate::program::{
    judge_budget, judge_cycle, judge_drives, judge_hoses, judge_payload, judge_speeds,
};
use crate::toolpath::Path;

/// What was measured of the program.
#[derive(Debug, Clone, PartialEq)]
pub struct Program {
    /// True TCP speed along every printed strand.
    pub speeds: Vec<StrandSpeed>,
    /// What prints ask of the drives at the asked speed.
    pub drives: Vec<DrivePeak>,
    /// What hangs on the flange; `None`: its mass is not known.
    pub payload: Option<Payload>,
    /// Use of every hose.
    pub hoses: Vec<HoseUse>,
    /// Where the time goes.
    pub cycle: CycleTimes,
    /// What errors of calibration do to every strand.
    pub budgets: Vec<StrandBudget>,
    /// How the drives follow the hardest stop; `None` where no masses are known.
    pub tracking: Option<Tracking>,
}

/// Measures and judges the program.
pub(super) fn check(
    job: &Job,
    paths: &[Path],
    motion: &Motion,
    deposit: &Deposit,
    contacts: &[Contact],
    totals: &Totals,
    findings: &mut Findings,
) -> Program {
    let program = Program {
        speeds: speeds(job, paths, motion),
        drives: drives(job, motion),
        payload: payload(job, motion, totals),
        hoses: hoses(job, motion),
        cycle: cycle(job, motion),
        budgets: budget(job, paths, motion, &meetings(deposit, contacts)),
        tracking: tracking(job, motion),
    };
    judge_speeds(job, &program.speeds, findings);
    judge_drives(job, &program.drives, findings);
    if let Some(payload) = &program.payload {
        judge_payload(payload, findings);
    }
    judge_hoses(job, &program.hoses, findings);
    judge_cycle(job, &program.cycle, findings);
    judge_budget(job, &program.budgets, findings);
    program
}

fn drives(job: &Job, motion: &Motion) -> Vec<DrivePeak> {
    let chain = &job.cell.robot.arm.chain;
    let peak = |need: &crate::motion::Need| DrivePeak {
        strand: motion.legs[need.leg].strand,
        phase: Phase::Print,
        at_m: need.at_m,
        point: None,
        time_s: need.time_s,
        joint: chain.axis_name(need.joint).to_owned(),
        load: match need.load {
            Load::Acceleration => DriveLoad::Acceleration,
            Load::Torque { resting } => DriveLoad::Torque { resting },
        },
        share: Interval::exact(need.share),
    };
    motion.needs.iter().map(peak).collect()
}

/// Postures at which static moments are looked at: the ends of every leg.
fn payload(job: &Job, motion: &Motion, totals: &Totals) -> Option<Payload> {
    let robot = &job.cell.robot;
    let load = job.cell.flange_load()?;
    // A bed on the flange carries the whole print in the end; where on it is within the bed.
    let print = match job.cell.mode {
        Mode::ToolOnFlange => Body::none(),
        Mode::BedOnFlange => Body::point(totals.mass_kg, load.centre),
    };
    let load = load.with(&print);
    let ends = |leg: &crate::motion::Leg| -> Vec<Posture> {
        [leg.moments.first(), leg.moments.last()].into_iter().flatten().map(|m| m.q).collect()
    };
    let postures: Vec<Posture> = motion.legs.iter().flat_map(ends).collect();
    let model = job.cell.dynamics();
    let rated = robot.payload_kg.zip(robot.payload_centre);
    let moments = dynamics::wrist_moments(
        &robot.arm.chain,
        &postures,
        job.cell.gravity_m_s2,
        &load,
        model.as_ref().map(|model| (model, robot.torque.as_slice())),
        rated,
    );
    Some(Payload {
        mass_kg: Interval::exact(load.mass_kg),
        rated_kg: robot.payload_kg,
        moments: moments
            .iter()
            .map(|moment| {
                let share = moment.moment.measured / moment.moment.limit;
                (robot.arm.chain.axis_name(moment.joint).to_owned(), share)
            })
            .collect(),
        time_s: Some(motion.total_s),
    })
}

/// Where strands meet: the later one lands on the earlier.
fn meetings(deposit: &Deposit, contacts: &[Contact]) -> Vec<Meeting> {
    let meeting = |contact: &Contact| {
        let [strand, earlier] = contact.orders.map(|order| deposit.strands[order].strand);
        let [at_m, earlier_at_m] = contact.at_m;
        Meeting { strand, at_m, earlier, earlier_at_m }
    };
    contacts.iter().map(meeting).collect()
}
