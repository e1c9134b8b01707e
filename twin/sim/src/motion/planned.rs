//! What will have been printed, as planned: what postures are chosen to keep clear of before anything is
//! known of how it comes out.

use crate::cell::Job;
use crate::clearance::{Bodies, Space, Touch};
use crate::deposit::{Contact, Deposit, Printed, contacts};
use crate::kinematics::Posture;
use crate::toolpath::stations;

/// All strands in printing order as thick as their flow makes them at the asked speed.
///
/// ```text
/// d = √(4 Q / (π v))
/// ```
pub(super) fn deposit(job: &Job) -> Deposit {
    let printed = |strand: usize| {
        let law = &job.strands[strand];
        let places = std::iter::once(f64::NEG_INFINITY).chain(law.profile.iter().map(|p| p.at_m));
        // The thickest there is stands for all of it.
        let area_m2 = places.map(|at_m| law.asked(at_m)).map(|(speed, flow)| flow / speed);
        let radius_m = (area_m2.fold(0.0, f64::max) / std::f64::consts::PI).sqrt();
        Printed {
            strand,
            as_planned: law.points.clone(),
            as_printed: law.points.clone(),
            at_m: stations(&law.points),
            radius_m,
            born_s: 0.0,
            done_s: 0.0,
        }
    };
    Deposit::new(job.print_order().map(printed).collect())
}

/// Clearance of postures along strands.
pub(super) struct Room<'a> {
    space: Space<'a>,
    contacts: Vec<Contact>,
}

impl<'a> Room<'a> {
    pub(super) fn new(job: &'a Job, bodies: &'a Bodies, deposit: &'a Deposit) -> Self {
        Self { space: Space::new(job, bodies, deposit), contacts: contacts(deposit) }
    }

    /// Clearance of tool, arm and what rides while the strand of this printing order is printed and
    /// the forms in `gone` are no longer there; nothing beyond twice the limit is told.
    pub(super) fn along(&self, order: usize, gone: &[usize]) -> impl Fn(&Posture) -> f64 + '_ {
        let (job, deposit) = (self.space.job, self.space.deposit);
        let touch = Touch::strand(job, deposit, order, &self.contacts, true).without(gone.to_vec());
        let beyond_m = 2.0 * job.limits.clearance_m;
        move |q| self.space.posture(q, order, &touch, beyond_m).clearance_m
    }
}
