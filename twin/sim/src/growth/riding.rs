//! S409: how far a bed that rides on the arm shakes what stands on it.

use super::{Built, Planned};
use crate::cell::{Job, Mode};
use crate::finding::{Check, Code, Findings, Phase, Site, Words};
use crate::motion::{Motion, Ride};
use crate::structure::{Ridden, Riding, SolveError, Stage, ride_stages};

/// The farthest that shaking moves a node while a stage stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shaken {
    /// Translation of the node, m.
    pub translation_m: f64,
    /// The node.
    pub node: usize,
    /// When, s.
    pub time_s: f64,
    /// What the arm does then.
    pub phase: Phase,
    /// The strand that the move belongs to, as index in the job.
    pub strand: Option<usize>,
}

/// The worst of every stage over all moves while it stands: the transit and approach to the next
/// strand, its printing, the retract from the last. `None` where the bed stands still or nothing
/// moves.
///
/// ```text
/// shaken = max over moves, nodes of |u(-a₀, α, ω)|
/// ```
///
/// that is all a node does in that posture less what weight does in the same posture: weight is
/// counted by the stage already. The strand in progress is no member yet.
///
/// # Errors
/// A frame too large to index.
pub(super) fn shaken(
    job: &Job,
    motion: &Motion,
    built: &Built,
    plan: &[Planned],
) -> Result<Vec<Option<Shaken>>, SolveError> {
    let mut worst: Vec<Option<Shaken>> = vec![None; plan.len()];
    if job.cell.mode != Mode::BedOnFlange || motion.rides.is_empty() {
        return Ok(worst);
    }
    let mut rides: Vec<Vec<&Ride>> = vec![Vec::new(); plan.len()];
    for ride in &motion.rides {
        if let Some(stage) = standing(plan, motion.legs[ride.leg].printed, ride.time_s) {
            rides[stage].push(ride);
        }
    }
    let stages: Vec<Stage> = plan.iter().map(|planned| planned.stage.clone()).collect();
    ride_stages(&built.weightless_strain(), &stages, |stage, riding| {
        // a mechanism is S402
        if let Ok(riding) = riding {
            worst[stage] = farthest(motion, &riding, &rides[stage]);
        }
    })?;
    Ok(worst)
}

/// The stage that stands at a time, of those with so many strands at most.
fn standing(plan: &[Planned], printed: usize, time_s: f64) -> Option<usize> {
    let begun = plan.partition_point(|planned| planned.time_s <= time_s);
    plan[..begun].iter().rposition(|planned| planned.printed <= printed)
}

fn farthest(motion: &Motion, riding: &Riding<'_>, rides: &[&Ride]) -> Option<Shaken> {
    let mut worst: Option<Shaken> = None;
    for ride in rides {
        let at = Ridden {
            specific_m_s2: -ride.carried.acceleration_m_s2,
            alpha_rad_s2: ride.carried.alpha_rad_s2,
            omega_rad_s: ride.carried.omega_rad_s,
        };
        let known_m = worst.map_or(0.0, |worst| worst.translation_m);
        if riding.bound_m(&at) <= known_m {
            continue;
        }
        let far = riding.farthest(&at);
        if far.translation_m > known_m {
            let leg = &motion.legs[ride.leg];
            worst = Some(Shaken {
                translation_m: far.translation_m,
                node: far.node,
                time_s: ride.time_s,
                phase: leg.phase,
                strand: leg.strand,
            });
        }
    }
    worst
}

/// Holds every stage against the capture radius of a landing.
pub(super) fn judge(
    job: &Job,
    built: &Built,
    plan: &[Planned],
    shaken: &[Option<Shaken>],
    findings: &mut Findings,
) {
    let e_pa = job.material.youngs_modulus_pa;
    for (planned, shaken) in plan.iter().zip(shaken) {
        let Some(shaken) = shaken else { continue };
        let site = Site {
            strand: shaken.strand,
            stage: Some(planned.printed),
            node: Some(shaken.node),
            phase: Some(shaken.phase),
            point: Some(built.frame.nodes()[shaken.node]),
            ..Site::default()
        };
        let check = Check {
            code: Code::S409,
            // as 1/E
            measured: e_pa.map(|e| shaken.translation_m * e_pa.nominal / e),
            limit: job.limits.node_miss_m,
            warn_limit: None,
            site,
            time_s: Some(shaken.time_s),
        };
        findings.check(check, || Words {
            message: format!(
                "the moving bed shakes node {} by {:.3} mm with {} strands printed ({})",
                shaken.node,
                shaken.translation_m * 1e3,
                planned.printed,
                shaken.phase.word()
            ),
            hint: "let the arm start and stop more gently, or brace what stands free".to_owned(),
        });
    }
}
