//! Clearance of tool, arm, bed and fixtures, against the deposit and against each other.
//!
//! | pair | code | looked at |
//! |---|---|---|
//! | nozzle, other tool parts – earlier strands | C201, C202 | every moment |
//! | arm links – strands | C203 | every third moment |
//! | nozzle and tool – strand in progress | C204 | every moment of a print |
//! | tool, arm, moving bed – bed, forms, fixtures | C205 | tool every moment, arm every third |
//! | arm, tool – arm itself | C206 | every third moment |
//!
//! Clearance is measured at the moments of the motion, which are at most 4 mm of strand, 5 mm of
//! straight travel or 0.05 rad of a joint apart, not swept between them; the report says so.
//! Beads are tested at full width into nodes and crossings. What may touch is the *touch zone* of
//! the cell: the nozzle within that distance of a place where its strand touches the other one.

mod fixtures;
mod strands;
#[cfg(test)]
mod tests;
mod zone;

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::cell::Job;
use crate::deposit::{Contact, Deposit};
use crate::finding::{Code, Findings, Phase, Site};
use crate::interval::Interval;
use crate::motion::{Leg, Motion};
use crate::pose::{Point, Pose};

use crate::clearance::Bodies;

/// Smallest clearance found, with its pair.
#[derive(Debug, Clone, PartialEq)]
pub struct Nearest {
    /// Clearance, m; negative: overlap.
    pub clearance_m: f64,
    /// The two bodies.
    pub bodies: [String; 2],
    /// When, s.
    pub time_s: f64,
}

/// Every how many moments arm links are looked at.
const ARM_STRIDE: usize = 3;

/// Judges every leg of the motion; legs are looked at in parallel, findings kept in order.
pub fn check(
    job: &Job,
    motion: &Motion,
    deposit: &Deposit,
    contacts: &[Contact],
    findings: &mut Findings,
) -> Option<Nearest> {
    let bodies = Bodies::new(job);
    let mut by_order: Vec<Vec<&Contact>> = vec![Vec::new(); deposit.strands.len()];
    for contact in contacts {
        contact.orders.iter().for_each(|&order| by_order[order].push(contact));
    }
    let mut order_of: Vec<Option<usize>> = vec![None; job.strands.len()];
    for (order, printed) in deposit.strands.iter().enumerate() {
        order_of[printed.strand] = Some(order);
    }
    let parts: Vec<(Findings, Option<Nearest>)> = motion
        .legs
        .par_iter()
        .map(|leg| {
            let order = leg.strand.and_then(|strand| order_of[strand]);
            let mut look = Look::new(job, &bodies, deposit, leg, order);
            if let Some(order) = order.filter(|_| leg.phase != Phase::Transit) {
                look.zone_contacts.clone_from(&by_order[order]);
            }
            look.leg();
            (look.findings, look.nearest)
        })
        .collect();
    if motion.legs.iter().any(|leg| !leg.moments.is_empty()) {
        far(job, findings);
    }
    let mut nearest: Option<Nearest> = None;
    for (found, near) in parts {
        findings.absorb(found);
        nearest = nearer(nearest, near);
    }
    nearest
}

/// What is further apart than the horizon was looked at too, and scores as that far.
fn far(job: &Job, findings: &mut Findings) {
    let limit = job.limits.clearance_m;
    let check = crate::finding::Check {
        code: Code::C201,
        measured: Interval::exact(2.0 * limit),
        limit,
        warn_limit: None,
        site: Site::default(),
        time_s: None,
    };
    findings.check(check, || unreachable!("twice the limit passes"));
}

fn nearer(a: Option<Nearest>, b: Option<Nearest>) -> Option<Nearest> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.clearance_m < a.clearance_m { b } else { a }),
        (a, b) => a.or(b),
    }
}

/// One leg under the glass.
struct Look<'a> {
    job: &'a Job,
    bodies: &'a Bodies,
    deposit: &'a Deposit,
    leg: &'a Leg,
    /// Contacts of the strand being approached, printed or left.
    zone_contacts: Vec<&'a Contact>,
    /// Radius of the bead of that strand, m.
    half_bead_m: f64,
    /// Where the nozzle leaves the strand, on a retract.
    left: Option<Point>,
    /// Bodies further apart than this are not measured.
    horizon_m: f64,
    near: Vec<u32>,
    /// Pairs of bodies last seen further apart than the horizon. As long as their motion since is
    /// less than the rest, they need not be measured.
    apart: BTreeMap<(usize, usize), Apart>,
    findings: Findings,
    nearest: Option<Nearest>,
}

/// How far apart two bodies were, and where they then stood.
struct Apart {
    clearance_m: f64,
    pose: Pose,
    other_pose: Pose,
}

/// Where everything is at one moment.
struct Now {
    time_s: f64,
    at_m: f64,
    /// Poses of the bodies that move with chain joints, world axes.
    carriers: Vec<Pose>,
    world_from_tool: Pose,
    world_from_bed: Pose,
    part_from_world: Pose,
    /// The orifice in part axes.
    tip: Point,
}

impl<'a> Look<'a> {
    fn new(
        job: &'a Job,
        bodies: &'a Bodies,
        deposit: &'a Deposit,
        leg: &'a Leg,
        order: Option<usize>,
    ) -> Self {
        Self {
            job,
            bodies,
            deposit,
            leg,
            zone_contacts: Vec::new(),
            half_bead_m: order.map_or(0.0, |order| deposit.strands[order].radius_m),
            left: None,
            horizon_m: 2.0 * job.limits.clearance_m,
            near: Vec::new(),
            apart: BTreeMap::new(),
            findings: Findings::default(),
            nearest: None,
        }
    }

    fn leg(&mut self) {
        let last = self.leg.moments.len().saturating_sub(1);
        if self.leg.phase == Phase::Retract && !self.leg.moments.is_empty() {
            self.left = Some(self.now(0).tip);
        }
        for k in 0..self.leg.moments.len() {
            let now = self.now(k);
            self.tool_and_strands(&now);
            self.tool_and_fixtures(&now);
            if k % ARM_STRIDE == 0 || k == last {
                self.arm_and_strands(&now);
                self.arm_and_fixtures(&now);
                self.arm_and_itself(&now);
            }
        }
    }

    fn now(&self, k: usize) -> Now {
        let moment = &self.leg.moments[k];
        let cell = &self.job.cell;
        let chain = &cell.robot.arm.chain;
        let mut carriers = Vec::new();
        chain.link_poses(&moment.q, &mut carriers);
        let world_from_tip = chain.forward(&moment.q);
        let world_from_tool = cell.world_from_tool(&world_from_tip);
        let world_from_bed = cell.world_from_bed(&world_from_tip);
        let part_from_world = (world_from_bed * self.job.bed_from_part).inverse();
        Now {
            time_s: moment.time_s,
            at_m: moment.at_m,
            carriers,
            tip: part_from_world * (world_from_tool * Point::origin()),
            world_from_tool,
            world_from_bed,
            part_from_world,
        }
    }

    /// Records one measured clearance of two named bodies.
    fn measured(
        &mut self,
        code: Code,
        clearance_m: f64,
        limit_m: f64,
        names: [&str; 2],
        now: &Now,
    ) {
        if limit_m > 0.0 {
            let bodies = names.map(str::to_owned);
            let here = Nearest { clearance_m, bodies, time_s: now.time_s };
            self.nearest = nearer(self.nearest.take(), Some(here));
        }
        let site = Site {
            strand: self.leg.strand,
            at_m: (self.leg.phase == Phase::Print).then_some(now.at_m),
            phase: Some(self.leg.phase),
            point: Some(now.tip),
            ..Site::default()
        };
        // A clearance that may be negative is held against its limit by how much is missing of
        // the full clearance, so that both kinds have a margin on one scale.
        let full_m = self.job.limits.clearance_m;
        let value_m = clearance_m + (full_m - limit_m);
        // The arm's error moves the strand in progress with the nozzle, and is what those that may
        // touch may press into each other for.
        let moves_together = code == Code::C204 || limit_m < 0.0;
        let accuracy_m = if moves_together { 0.0 } else { self.job.cell.robot.accuracy_m };
        let measured = Interval::new(value_m, value_m - accuracy_m, value_m + accuracy_m);
        let job = self.job;
        let phase = self.leg.phase.word();
        let strand = self.leg.strand;
        self.findings.check(
            crate::finding::Check {
                code,
                measured,
                limit: full_m,
                warn_limit: None,
                site: site.between(names),
                time_s: Some(now.time_s),
            },
            || words::clearance(job, code, clearance_m, limit_m, names, phase, strand),
        );
    }
}

mod words {
    //! Sentences of clearance findings.

    use crate::cell::Job;
    use crate::finding::{Code, Phase, Words};

    pub(super) fn clearance(
        job: &Job,
        code: Code,
        clearance_m: f64,
        limit_m: f64,
        [body, other]: [&str; 2],
        phase: &str,
        strand: Option<usize>,
    ) -> Words {
        let of = strand
            .map_or_else(String::new, |strand| format!(" of strand `{}`", job.strands[strand].id));
        let how = if clearance_m < 0.0 {
            format!("{body} overlaps {other} by {:.2} mm", -clearance_m * 1e3)
        } else {
            format!("{body} comes within {:.2} mm of {other}", clearance_m * 1e3)
        };
        // A warning lacks what the arm may be off; an error lacks that too.
        let missing_mm = (limit_m + job.cell.robot.accuracy_m - clearance_m) * 1e3;
        let own = strand.is_some_and(|strand| job.strands[strand].id == other);
        let hint = match code {
            _ if phase == Phase::Transit.word() => {
                "lead the arm round it with a `move` step before the strand, or lengthen approach and retract"
                    .to_owned()
            }
            Code::C201 | Code::C202 if own => {
                "tilt the nozzle away from the strand it leaves, or print that in the other direction".to_owned()
            }
            Code::C201 | Code::C202 => format!(
                "print `{other}` after this strand, tilt the nozzle away, or move one of them by {missing_mm:.1} mm"
            ),
            Code::C204 => {
                "tilt the nozzle to trail the strand, or print it in the other direction".to_owned()
            }
            Code::C203 | Code::C206 => {
                "turn the spin, or give the strand another posture".to_owned()
            }
            _ => format!("move the part by {missing_mm:.1} mm, or tilt the nozzle away"),
        };
        Words { message: format!("{how} in the {phase}{of}"), hint }
    }
}
