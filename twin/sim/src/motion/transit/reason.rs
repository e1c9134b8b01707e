//! Why no way was found, and the finding that says so (C207).

use super::rrt::Tree;
use crate::cell::Job;
use crate::clearance::Blocked;
use crate::finding::{Code, Findings, Phase, Site, Words};
use crate::kinematics::Posture;
use crate::motion::{Leg, Motion, between};

/// An end of a move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum End {
    /// Where it begins.
    Start,
    /// Where it leads.
    Goal,
    /// The strand, in approach and retract.
    Strand,
}

/// Why no way was found.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Reason {
    /// The end that is shut in.
    pub(crate) end: End,
    /// The bodies that are in the way.
    pub(crate) bodies: [String; 2],
    /// Their clearance in the posture `q`, m.
    pub(crate) clearance_m: f64,
    /// What they should have kept, m.
    pub(crate) need_m: f64,
    /// The posture in which they are in the way nearest to that end; the end itself where that is
    /// not clear.
    pub(crate) q: Posture,
    /// Their share of all moves that were not clear; `None`: the end itself is not clear, and
    /// nothing was searched.
    pub(crate) share: Option<f64>,
}

impl Reason {
    /// The end itself is not clear.
    pub(super) fn of_end(end: End, blocked: Blocked, q: Posture, need_m: f64) -> Self {
        let Blocked { clearance_m, pair: bodies, .. } = blocked;
        Self { end, bodies, clearance_m, need_m, q, share: None }
    }

    /// A search failed: the tree that grew less is the one that is shut in, and what blocked it most
    /// often is in the way.
    pub(super) fn of_search(here: &Tree, there: &Tree, need_m: f64) -> Self {
        let is_here = here.n_grown() <= there.n_grown();
        let ends = if is_here { [End::Start, End::Goal] } else { [End::Goal, End::Start] };
        let trees = if is_here { [here, there] } else { [there, here] };
        let told = ends.into_iter().zip(trees).find_map(|(end, tree)| {
            let (row, share) = tree.blocked.worst()?;
            let bodies = row.bodies.clone();
            let (clearance_m, q) = (row.clearance_m, row.q);
            Some(Self { end, bodies, clearance_m, need_m, q, share: Some(share) })
        });
        // Trees that were never blocked would have met.
        told.unwrap_or_else(|| Self {
            end: ends[0],
            bodies: [String::new(), String::new()],
            clearance_m: need_m,
            need_m,
            q: trees[0].root(),
            share: None,
        })
    }
}

/// Tells for every move without extrusion whether a way was found (C207).
pub(in crate::motion) fn tell(job: &Job, motion: &Motion, findings: &mut Findings) {
    for (index, leg) in motion.legs.iter().enumerate() {
        let Some(first) = leg.moments.first().filter(|_| leg.phase != Phase::Print) else {
            continue;
        };
        let lost = motion.lost.iter().find(|lost| lost.leg == index);
        let site = Site { strand: leg.strand, ..Site::default() }.during(leg.phase);
        match lost.map(|lost| &lost.reason) {
            None => {
                findings.forbid(Code::C207, false, site, None, || unreachable!("all is well"));
            }
            Some(reason) => {
                let (point, _) = between::nozzle_at(job, &reason.q);
                let site = site.at(point).between([&reason.bodies[0], &reason.bodies[1]]);
                let words = || words(job, leg, reason);
                findings.forbid(Code::C207, true, site, Some(first.time_s), words);
            }
        }
    }
}

fn words(job: &Job, leg: &Leg, reason: &Reason) -> Words {
    let strand = leg.strand.map(|strand| format!("strand `{}`", job.strands[strand].id));
    let goal = strand.unwrap_or_else(|| "home".to_owned());
    let [one, other] = &reason.bodies;
    let apart = if reason.clearance_m < 0.0 {
        format!("they overlap by {:.2} mm", -reason.clearance_m * 1e3)
    } else {
        format!("they are {:.2} mm apart", reason.clearance_m * 1e3)
    };
    let apart = format!("{apart}, where {:.2} mm are needed", reason.need_m * 1e3);
    if reason.end == End::Strand {
        let phase = leg.phase.word();
        return Words {
            message: format!(
                "no collision-free {phase} of {goal}: along the nozzle {one} and {other} are in \
                 the way ({apart}), and no direction up to 60 degrees from it is clear"
            ),
            hint: format!("print `{other}` after this strand, or tilt the nozzle away from it"),
        };
    }
    let (place, mend) = match reason.end {
        End::Start => ("where the transit begins", "lengthen `retract_mm` of the strand before"),
        _ => ("where it ends", "lengthen `approach_mm`"),
    };
    let message = match reason.share {
        None => format!(
            "no collision-free transit to {goal}: {place}, {one} and {other} are in the way: {apart}"
        ),
        Some(share) => format!(
            "no collision-free transit to {goal}: tried were the direct move, along the nozzle, \
             over the deposit, through home and a search; {place}, {one} and {other} stopped {:.0} \
             % of the moves that failed; in the nearest {apart}",
            share * 100.0
        ),
    };
    let hint = format!(
        "{mend}, print what is in the way later, turn the spin, or lead the arm with a `move` step \
         before the strand"
    );
    Words { message, hint }
}
