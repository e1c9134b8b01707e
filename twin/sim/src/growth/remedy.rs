//! What would mend a landing that misses, and how much would be left of the miss: solved, not guessed.

use super::nozzle::Coming;
use super::part::Part;
use super::{Built, Landing, Planned, Printed};
use crate::cell::Job;
use crate::pose::{Point, Vector};
use crate::structure::{Load, Member, NodeLoad, Stage, Support, solve};

/// A change to the job.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// Move the target by this, m, part axes: the parts that are there before the nozzle comes are aimed at.
    Shift(Vector),
    /// Print the strand after another one (index in the job).
    After(usize),
    /// Stand a strut of the same bead from the bed under the node.
    Prop,
}

impl Change {
    /// The words for it.
    pub fn words(&self, job: &Job) -> String {
        match self {
            Self::Shift(by) => {
                let mm = by * 1e3;
                format!("aim {:+.2}, {:+.2}, {:+.2} mm off the plan", mm.x, mm.y, mm.z)
            }
            Self::After(strand) => format!("print it after `{}`", job.strands[*strand].id),
            Self::Prop => "prop the node from the bed".to_owned(),
        }
    }
}

/// A change and what it leaves.
#[derive(Debug, Clone, PartialEq)]
pub struct Remedy {
    /// The change.
    pub change: Change,
    /// Length of the sum after it, m; without the arm's accuracy.
    pub left_m: f64,
}

/// Later strands that are tried as ones to print first.
const ORDERS_TRIED: usize = 3;

/// Remedies that leave less than there is, those that suffice first, then by what they leave.
///
/// A shift takes away what is known before the nozzle comes. A later place in the order and a prop are solved anew: the frame of
/// then, without the strand, with the nozzle's push (and the strand's weight) on the node; locked-in shrinkage and sag are
/// taken as they were. Cost: one solve each, at most four per landing that misses.
pub(super) fn remedies(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    plan: &[Planned],
    coming: &Coming,
    landing: &Landing,
) -> Vec<Remedy> {
    let lasting = landing.frame_m + landing.shrinkage_m + landing.sag_m;
    let shifted = (landing.weight_m + landing.push_m).norm();
    let mut all = vec![Remedy { change: Change::Shift(lasting), left_m: shifted }];
    let stage = &plan[coming.stage].stage;
    let pressed = coming.pressed[usize::from(landing.at_end)].map_or(0, |p| p.nominal);
    let loads = &stage.trials[pressed].loads;
    let rest = landing.shrinkage_m + landing.sag_m;
    for order in later(built, coming, landing.node).take(ORDERS_TRIED) {
        let Some(then) = plan.iter().find(|planned| planned.printed == order + 1) else { continue };
        let members = built.frame.members()[..then.stage.born].iter().zip(&built.member_order);
        let others: Vec<Member> =
            members.filter(|(_, of)| **of != coming.order).map(|(member, _)| *member).collect();
        let nodes = built.frame.nodes();
        if let Some(moved) = moved(nodes, &others, &then.stage, loads, landing.node) {
            let change = Change::After(printed.deposit.strands[order].strand);
            all.push(Remedy { change, left_m: (moved + rest).norm() });
        }
    }
    all.extend(
        prop(job, printed, built, stage, loads, landing)
            .map(|moved| Remedy { change: Change::Prop, left_m: (moved + rest).norm() }),
    );
    all.retain(|remedy| remedy.left_m < 0.9 * landing.sum_m);
    let fails = |remedy: &Remedy| remedy.left_m > job.limits.node_miss_m;
    all.sort_by(|a, b| {
        fails(a).cmp(&fails(b)).then(if fails(a) {
            a.left_m.total_cmp(&b.left_m)
        } else {
            std::cmp::Ordering::Equal
        })
    });
    all
}

/// Strands that come later and bring a member to the node without needing the strand that lands.
fn later<'a>(
    built: &'a Built,
    coming: &'a Coming,
    node: usize,
) -> impl Iterator<Item = usize> + 'a {
    let touches = move |order: &usize| built.ends[*order].contains(&node);
    (coming.order + 1..built.ends.len()).filter(touches)
}

/// Displacement of a node by weight and loads on a frame; `None` where that does not stand.
fn moved(
    nodes: &[Point],
    members: &[Member],
    stage: &Stage,
    loads: &[NodeLoad],
    node: usize,
) -> Option<Vector> {
    let unstrained = members.iter().map(|member| Member { initial_strain: 0.0, ..*member });
    let part = Part::new(nodes, unstrained)?;
    let at_nodes = part.loads(loads)?;
    let load = Load { gravity_m_s2: stage.gravity_m_s2, at_nodes, with_initial_strain: false };
    let solution = solve(&part.frame, &part.supports(&stage.supports), &load).ok()?;
    let six = solution.displacement[part.node(node)?];
    Some(Vector::new(six[0], six[1], six[2]))
}

/// The same with a strut of the landing strand's bead from the bed straight up to the node.
fn prop(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    stage: &Stage,
    loads: &[NodeLoad],
    landing: &Landing,
) -> Option<Vector> {
    let order = printed.deposit.strands.iter().position(|it| it.strand == landing.strand)?;
    let top = built.frame.nodes()[landing.node];
    let height_m = (job.bed_from_part * top).z;
    if height_m <= printed.laws[order].diameter_m {
        return None;
    }
    let foot = top - (job.bed_from_part.inverse() * Vector::z()) * height_m;
    let mut nodes = built.frame.nodes().to_vec();
    nodes.push(foot);
    let mut members = built.frame.members()[..stage.born].to_vec();
    members.push(Member {
        ends: [nodes.len() - 1, landing.node],
        section: printed.laws[order].section(),
        elastic: printed.laws[order].elastic(),
        density_kg_m3: printed.laws[order].density_kg_m3,
        initial_strain: 0.0,
        side: Vector::zeros(),
        strand: landing.strand,
    });
    let mut stage = stage.clone();
    stage.supports.push(Support::clamped(nodes.len() - 1));
    moved(&nodes, &members, &stage, loads, landing.node)
}
