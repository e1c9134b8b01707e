//! E501: mass on the flange, and its lever.

use crate::finding::{Check, Code, Findings, Site, Words};
use crate::interval::Interval;

/// What hangs on the flange.
#[derive(Debug, Clone, PartialEq)]
pub struct Payload {
    /// Its mass, kg: tool or bed, what is bolted to it, and the print if that rides.
    pub mass_kg: Interval,
    /// Rated payload of the arm, kg; `None`: its file does not say.
    pub rated_kg: Option<f64>,
    /// Joints with the greatest share of the allowed static moment that it takes in any posture of
    /// the program; empty: not known.
    pub moments: Vec<(String, f64)>,
    /// When it is heaviest, s.
    pub time_s: Option<f64>,
}

/// Holds the mass against the rated payload or, where its lever is what counts, against the mass
/// that the weakest joint would hold at that lever,
///
/// ```text
/// allowed = min(rated, mass / share)
/// ```
///
/// since the static moment goes with the mass. A share that counts the arm's own weight with the load's
/// makes the allowed mass too large by as much as the arm takes; which side of it the mass lies on is
/// right all the same. Nothing is held where neither is known.
pub fn judge_payload(payload: &Payload, findings: &mut Findings) {
    let worst = payload.moments.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    let by_moment = worst
        .filter(|(_, share)| *share > 0.0)
        .map(|(joint, share)| (payload.mass_kg.nominal / share, Some(joint)));
    let by_rating = payload.rated_kg.map(|rated_kg| (rated_kg, None));
    let allowed = [by_moment, by_rating].into_iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0));
    let Some((limit, joint)) = allowed else { return };
    let mut site = Site::default();
    site.bodies.extend(joint.cloned());
    let check = Check {
        code: Code::E501,
        measured: payload.mass_kg,
        limit,
        warn_limit: None,
        site,
        time_s: payload.time_s,
    };
    findings.check(check, || {
        let mass_kg = payload.mass_kg.nominal;
        let (message, what) = match joint {
            None => (format!("the flange carries {mass_kg:.2} kg, rated for {limit:.2} kg"), ""),
            Some(joint) => (
                format!(
                    "the flange carries {mass_kg:.2} kg so far out that joint {joint} holds {limit:.2} kg there"
                ),
                ", or bring its centre of gravity nearer to the flange",
            ),
        };
        Words { message, hint: format!("take {:.2} kg off{what}", (payload.mass_kg.high - limit).max(0.0)) }
    });
}
