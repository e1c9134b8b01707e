//! S410: where the part lets go of bed or form.
//!
//! What rests on them holds by adhesion, a mean stress over the area of contact. Weight and locked-in
//! shrinkage pull on it together, staged: shrinkage is what lifts corners.

mod area;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use self::area::Foot;
use super::{Built, Planned, Printed};
use crate::cell::Job;
use crate::finding::{Check, Code, Findings, Site, Words};
use crate::interval::Interval;
use crate::pose::{Point, Vector};
use crate::structure::{
    Ask, Hold, Pull, SolveError, Stage, StageRecord, StageState, solve_held_stages,
};

/// Pull over what is held where nothing is held; larger shares are told as this one.
const HELD_BY_NOTHING: f64 = 1e6;

/// What bed and forms hold at a stage.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct StageHold {
    /// Largest pull over what is held; `None`: nothing that may lift, or nothing solved.
    pub(super) share: Option<f64>,
    /// Largest displacement by a release with shrinkage locked in, m; `None`: no release, or a piece
    /// of which nothing is held any more.
    pub(super) released_m: Option<f64>,
}

/// A place where a strand is held, from one stage to another.
struct Grip {
    node: usize,
    order: usize,
    foot: Foot,
    adhesion_pa: Interval,
    from: usize,
    until: usize,
}

/// Solves all stages with weight, shrinkage and adhesion together, and holds pulls against what is held.
///
/// ```text
/// share = pull / Σ σ A        interval: through low and high σ
/// ```
///
/// The pull is the staged reaction of the node along the surface's normal before any lets go at that
/// stage, so a share of 2 says that twice the adhesion would hold.
pub(super) fn judge(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    (plan, stages): (&[Planned], &[Stage]),
    findings: &mut Findings,
) -> Result<Vec<StageHold>, SolveError> {
    let grips = grips(job, printed, built, plan);
    if grips.is_empty() {
        return Ok(vec![StageHold::default(); plan.len()]);
    }
    let holds: Vec<Hold> = grips.iter().map(Grip::hold).collect();
    let released = |k: &usize| plan[*k].released.is_some();
    let keep: Vec<usize> =
        (0..plan.len()).filter(released).flat_map(|k| [k.saturating_sub(1), k]).collect();
    let ask = Ask { staged: true, keep: &keep, ..Ask::default() };
    let records = solve_held_stages(&built.frame, stages, &holds, ask)?;
    let mut of_node: BTreeMap<usize, Vec<&Grip>> = BTreeMap::new();
    for grip in &grips {
        of_node.entry(grip.node).or_default().push(grip);
    }
    let mut held = Vec::with_capacity(plan.len());
    for (stage, record) in records.iter().enumerate() {
        let worst = record.holding.as_ref().and_then(|holding| holding.worst);
        held.push(StageHold {
            share: worst.map(share),
            released_m: released(&stage).then(|| moved_m(&records, stage)).flatten(),
        });
        if let Some(pull) = worst {
            let now = |grip: &&&Grip| (grip.from..grip.until).contains(&stage);
            let grips: Vec<&Grip> = of_node[&pull.node].iter().filter(now).copied().collect();
            told(job, printed, built, (&plan[stage], record), (pull, &grips), findings);
        }
    }
    Ok(held)
}

fn share(pull: Pull) -> f64 {
    pull.share().min(HELD_BY_NOTHING)
}

/// Largest displacement between a release and the stage before, m; `None` if a piece then floats.
fn moved_m(records: &[StageRecord], stage: usize) -> Option<f64> {
    if !records[stage].floats.is_empty() {
        return None;
    }
    let now = &records[stage].staged.as_ref()?.displacement;
    let before = stage.checked_sub(1).and_then(|before| records[before].staged.as_ref());
    let before: &[[f64; 6]] = before.map_or(&[], |state: &StageState| &state.displacement);
    let translation = |u: &[f64; 6]| Vector::new(u[0], u[1], u[2]);
    let at = |node: usize| before.get(node).map_or_else(Vector::zeros, translation);
    let moved = now.iter().enumerate().map(|(node, u)| (translation(u) - at(node)).norm());
    Some(moved.fold(0.0, f64::max))
}

impl Grip {
    fn hold(&self) -> Hold {
        Hold {
            node: self.node,
            normal: self.foot.normal,
            pull_n: self.adhesion_pa.nominal * self.foot.area_m2,
            from: self.from,
            until: self.until,
        }
    }
}

/// Every place where a strand lies or stands on bed or form, once.
fn grips(job: &Job, printed: &Printed<'_>, built: &Built, plan: &[Planned]) -> Vec<Grip> {
    let feet = area::Feet::new(job, printed, built);
    let from = |order: usize| plan.iter().position(|planned| planned.printed > order);
    let until = |form: usize| plan.iter().position(|planned| planned.released == Some(form));
    let bed_pa = job.cell.bed.adhesion_pa;
    let on_bed = built.grounded.iter().map(|&(node, order)| (node, order, None));
    let on_form = built.formed.iter().map(|&(node, order, form)| (node, order, Some(form)));
    let mut places: Vec<(usize, usize, Option<usize>)> = on_bed.chain(on_form).collect();
    places.sort_unstable();
    places.dedup();
    let grip = |(node, order, form): (usize, usize, Option<usize>)| {
        Some(Grip {
            node,
            order,
            foot: feet.foot(node, order, form),
            adhesion_pa: form.map_or(bed_pa, |form| job.forms[form].adhesion_pa),
            from: from(order)?,
            until: form.and_then(until).unwrap_or(plan.len()),
        })
    };
    places.into_iter().filter_map(grip).collect()
}

fn told(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    (planned, record): (&Planned, &StageRecord),
    (pull, grips): (Pull, &[&Grip]),
    findings: &mut Findings,
) {
    let Some(first) = grips.first() else { return };
    let force_n = |pa: fn(&Interval) -> f64| -> f64 {
        grips.iter().map(|grip| pa(&grip.adhesion_pa) * grip.foot.area_m2).sum()
    };
    let share = share(pull);
    let of = |held_n: f64| (share * (pull.held_n / held_n)).min(HELD_BY_NOTHING);
    let [low_n, high_n] = [force_n(|pa| pa.low), force_n(|pa| pa.high)];
    let measured = if share > 0.0 && pull.held_n > 0.0 {
        Interval::new(share, of(high_n), of(low_n))
    } else {
        Interval::exact(share)
    };
    let bead = &printed.deposit.strands[first.order];
    let point = built.frame.nodes()[pull.node];
    let site = Site {
        strand: Some(bead.strand),
        at_m: Some(nearest_m(&bead.as_printed, &bead.at_m, point)),
        stage: Some(planned.printed),
        node: Some(pull.node),
        point: Some(point),
        ..Site::default()
    };
    let time_s = Some(planned.time_s);
    let check = Check { code: Code::S410, measured, limit: 1.0, warn_limit: None, site, time_s };
    findings.check(check, || {
        let let_go = record.holding.as_ref().map_or(0, |holding| holding.let_go.len());
        Words {
            message: format!(
                "strand `{}` is pulled off with {:.2} N where {:.2} N ({:.2} to {:.2}) hold it, once {} strands are printed; {} let go there",
                job.strands[bead.strand].id,
                pull.pull_n,
                pull.held_n,
                low_n,
                high_n,
                planned.printed,
                match let_go {
                    0 => "no nodes".to_owned(),
                    1 => "1 node".to_owned(),
                    n => format!("{n} nodes"),
                }
            ),
            hint: "give it a larger footprint or brim strands, press the first strands flatter, heat or coat the bed, or print so that less shrinks between joined ends"
                .to_owned(),
        }
    });
}

/// Arc length of the place on a polyline that is nearest to a point, m.
fn nearest_m(points: &[Point], at_m: &[f64], point: Point) -> f64 {
    let place = |k: usize| {
        let along = points[k + 1] - points[k];
        let share = (point - points[k]).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
        let share = share.clamp(0.0, 1.0);
        let far_m = (points[k] + along * share - point).norm();
        (far_m, at_m[k] + (at_m[k + 1] - at_m[k]) * share)
    };
    let places = (0..points.len().saturating_sub(1)).map(place);
    places.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, at_m)| at_m)
}
