//! The finished part under its loads.

use super::{Built, Printed, imperfect};
use crate::cell::{Job, LoadCase};
use crate::finding::{Check, Code, Findings, Site, Words};
use crate::interval::Interval;
use crate::pose::{Point, Vector};
use crate::process::Setting;
use crate::structure::{
    At, BucklingAsk, Criterion, FirstYield, Frame, Held, Load, Mode, NodeLoad, SolveError,
    Strength, Support, Weld, first_yield, model_factor, plastic_bound,
};

/// What a load case came to.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadResult {
    /// Its name.
    pub name: String,
    /// Largest displacement of a node under weight and forces, m.
    pub deflection_m: f64,
    /// Sum of the lengths of the forces, N.
    pub load_n: f64,
    /// Weight of the frame, N.
    pub weight_n: f64,
    /// Displacement of the places of the forces along them by the forces alone, weighted by them, m: load over it is the
    /// stiffness.
    pub travel_m: f64,
    /// Factors on the forces at which the first member or weld is used up, by criterion; `None`: not found.
    pub yields: Option<[Yield; 3]>,
    /// Factor on the forces that the members carry for sure if the material is ductile, by a plastic lower bound; welds are
    /// not asked. `None`: not a thermoplastic, or too large a frame.
    pub plastic: Option<f64>,
    /// Factor on weight and forces together at which the frame, were it perfect, would buckle; infinite: at none;
    /// `None`: it could not be found. Two parts per member.
    pub buckling: Option<f64>,
    /// The same followed with large displacements and an imperfection, where the perfect factor is below 4.
    pub followed: Option<f64>,
    /// Why the case could not be solved, if it could not.
    pub fault: Option<SolveError>,
}

/// First yield by one criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Yield {
    /// By what.
    pub criterion: Criterion,
    /// Factor on the forces as computed; infinite: at none.
    pub factor: f64,
    /// The same with what such predictions are worth.
    pub expected: Interval,
    /// The strand (index in the job) of the member, or the younger one of the weld.
    pub strand: Option<usize>,
    /// The node of the weld.
    pub node: Option<usize>,
}

impl LoadResult {
    /// The first yield that is judged: of outermost fibres or nodes, whichever comes first.
    pub fn first_yield(&self) -> Option<&Yield> {
        let judged = self.yields.iter().flatten().filter(|it| it.criterion != Criterion::Axial);
        judged.min_by(|a, b| a.factor.total_cmp(&b.factor))
    }

    /// The factor at which it gives way altogether.
    pub fn collapse(&self) -> Option<f64> {
        self.followed.or(self.buckling)
    }
}

/// Solves and judges every load case of a job.
pub(super) fn solve_all(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    strengths: &[Strength],
    findings: &mut Findings,
) -> Vec<LoadResult> {
    job.loads
        .iter()
        .map(|case| {
            let result = solve_case(job, printed, built, strengths, case);
            judge(job, built, &result, findings);
            result
        })
        .collect()
}

fn solve_case(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    strengths: &[Strength],
    case: &LoadCase,
) -> LoadResult {
    let mut seats = Seats {
        frame: built.weightless_strain(),
        strengths: strengths.to_vec(),
        welds: built.welds.clone(),
    };
    let supports: Vec<Support> = case
        .supports
        .iter()
        .map(|support| Support { node: seats.at(&support.at), fixed: support.fixed })
        .collect();
    let forces: Vec<NodeLoad> = case
        .forces
        .iter()
        .map(|force| {
            let f = force.force_n;
            NodeLoad { node: seats.at(&force.at), load: [f.x, f.y, f.z, 0.0, 0.0, 0.0] }
        })
        .collect();
    let gravity: [f64; 3] =
        job.gravity_in_part(&job.cell.robot.arm.chain.forward(&job.cell.home)).into();
    let nothing = LoadResult {
        name: case.name.clone(),
        deflection_m: 0.0,
        load_n: 0.0,
        weight_n: 0.0,
        travel_m: 0.0,
        yields: None,
        plastic: None,
        buckling: None,
        followed: None,
        fault: None,
    };
    let is_plastic = matches!(job.material.setting, Setting::Thermoplastic(_));
    match under(&seats, &supports, forces, (gravity, is_plastic)) {
        Ok(answer) => LoadResult {
            deflection_m: answer.deflection_m,
            load_n: answer.load_n,
            weight_n: answer.weight_n,
            travel_m: answer.travel_m,
            yields: answer
                .yields
                .map(|yields| yields.map(|found| expected(job, printed, built, &seats, &found))),
            plastic: answer.plastic,
            buckling: answer.buckling,
            followed: answer.followed,
            ..nothing
        },
        Err(fault) => LoadResult { fault: Some(fault), ..nothing },
    }
}

struct Answer {
    deflection_m: f64,
    load_n: f64,
    weight_n: f64,
    travel_m: f64,
    yields: Option<[FirstYield; 3]>,
    plastic: Option<f64>,
    buckling: Option<f64>,
    followed: Option<f64>,
}

/// Frames of more members are not asked for a plastic bound: it takes up to 80 solves of three times as many.
const PLASTIC_MAX: usize = 1000;

fn under(
    seats: &Seats,
    supports: &[Support],
    forces: Vec<NodeLoad>,
    (gravity, is_plastic): ([f64; 3], bool),
) -> Result<Answer, SolveError> {
    let weight = Load { gravity_m_s2: gravity, ..Load::default() };
    let load = Load { at_nodes: forces, ..Load::default() };
    let held = Held::new(&seats.frame, supports)?;
    let (resting, loaded) = (held.solution(&weight)?, held.solution(&load)?);
    let moved = resting.displacement.iter().zip(&loaded.displacement);
    let deflection_m = moved
        .map(|(a, b)| Vector::new(a[0] + b[0], a[1] + b[1], a[2] + b[2]).norm())
        .fold(0.0, f64::max);
    let lengths = |load: &NodeLoad| Vector::from_column_slice(&load.load[..3]).norm();
    let load_n: f64 = load.at_nodes.iter().map(lengths).sum();
    let work = |load: &NodeLoad| -> f64 {
        let u = loaded.displacement[load.node];
        (0..3).map(|axis| load.load[axis] * u[axis]).sum()
    };
    let work_j: f64 = load.at_nodes.iter().map(work).sum();
    let travel_m = if load_n > 0.0 { work_j / load_n } else { 0.0 };
    let weight_n = seats.frame.mass_kg() * Vector::from(gravity).norm();
    let capacity = (seats.strengths.as_slice(), seats.welds.as_slice());
    let yields = first_yield(&seats.frame, capacity, (&resting, gravity), (&loaded, [0.0; 3])).ok();
    let plastic = (is_plastic && seats.frame.members().len() <= PLASTIC_MAX)
        .then(|| plastic_bound(&seats.frame, supports, &seats.strengths, &weight, &load).ok())
        .flatten();
    let both = Load { gravity_m_s2: gravity, ..load };
    let modes = held.buckling(&both, BucklingAsk::default()).ok();
    let least = |modes: &Vec<Mode>| modes.first().map_or(f64::INFINITY, |mode| mode.factor);
    let buckling = modes.as_ref().map(least);
    let is_near = buckling.is_some_and(|factor| factor < imperfect::TRUSTED);
    let followed = if is_near { imperfect::followed(&seats.frame, supports, &both) } else { None };
    let plastic = plastic.map(|found| found.bound);
    Ok(Answer { deflection_m, load_n, weight_n, travel_m, yields, plastic, buckling, followed })
}

/// A first yield with what it is worth: by the model factor for thermoplastics, else by the strength alone; a node also by how
/// well it has bonded.
fn expected(
    job: &Job,
    printed: &Printed<'_>,
    built: &Built,
    seats: &Seats,
    found: &FirstYield,
) -> Yield {
    let by_node = found.criterion == Criterion::Node;
    let contact = found.at.filter(|_| by_node).map(|weld| built.weld_contact[weld]);
    let strand = match contact {
        Some(contact) => Some(printed.deposit.strands[printed.contacts[contact].orders[0]].strand),
        None => found.at.map(|member| seats.frame.members()[member].strand),
    };
    let strength =
        contact.map_or(job.material.strength_pa, |contact| printed.bonds[contact].tension_pa);
    let range = |strength: Interval| {
        Interval::new(1.0, strength.low / strength.nominal, strength.high / strength.nominal)
    };
    let worth = match (&job.material.setting, contact) {
        (Setting::Thermoplastic(_), None) => model_factor(),
        (Setting::Thermoplastic(_), Some(_)) => {
            let (model, bond) = (model_factor(), range(strength));
            Interval::new(model.nominal, model.low * bond.low, model.high * bond.high)
        }
        _ => range(strength),
    };
    Yield {
        criterion: found.criterion,
        factor: found.factor,
        expected: worth.map(|worth| if worth > 0.0 { worth * found.factor } else { 0.0 }),
        strand,
        node: contact.and(found.at).map(|weld| built.welds[weld].node),
    }
}

/// A frame that gets a node wherever a support or force sits.
struct Seats {
    frame: Frame,
    strengths: Vec<Strength>,
    welds: Vec<Weld>,
}

impl Seats {
    /// The nearest node, or a new one on the nearest member if that is nearer by more than 0.1 mm.
    fn at(&mut self, place: &Point) -> usize {
        let nodes = self.frame.nodes();
        let far = |node: &Point| (node - place).norm();
        let node = (0..nodes.len())
            .min_by(|&a, &b| far(&nodes[a]).total_cmp(&far(&nodes[b])))
            .unwrap_or(0);
        let members = self.frame.members().iter().enumerate();
        let on_member = members
            .map(|(member, each)| {
                let [a, b] = each.ends.map(|node| nodes[node]);
                let along = b - a;
                let share = ((place - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
                (member, share, far(&(a + along * share)))
            })
            .min_by(|a, b| a.2.total_cmp(&b.2));
        match on_member {
            Some((member, share, off_m)) if off_m + 1e-4 < far(&nodes[node]) => {
                match self.frame.split(member, share) {
                    Ok((frame, node)) => {
                        self.frame = frame;
                        self.strengths.insert(member, self.strengths[member]);
                        self.shift_welds(member);
                        node
                    }
                    Err(_) => node,
                }
            }
            _ => node,
        }
    }

    /// Members after the one that was cut have moved on by one; a weld at its last end is now on the second half.
    fn shift_welds(&mut self, member: usize) {
        for (of, at) in self.welds.iter_mut().flat_map(|weld| &mut weld.through) {
            if *of > member || (*of == member && *at == At::Last) {
                *of += 1;
            }
        }
    }
}

fn judge(job: &Job, built: &Built, result: &LoadResult, findings: &mut Findings) {
    if let Some(fault) = result.fault {
        findings.forbid(Code::S402, true, Site::default(), None, || Words {
            message: format!("load case `{}` cannot be solved: {fault}", result.name),
            hint: "hold the part at more points, or join the pieces of the print".to_owned(),
        });
        return;
    }
    let check = Check {
        code: Code::S406,
        // Young's modulus is the material number that deflection depends on, as 1/E.
        measured: job
            .material
            .youngs_modulus_pa
            .map(|e| result.deflection_m * job.material.youngs_modulus_pa.nominal / e),
        limit: job.limits.deflection_m,
        warn_limit: None,
        site: Site::default(),
        time_s: None,
    };
    findings.check(check, || Words {
        message: format!(
            "load case `{}` bends the part by {:.3} mm",
            result.name,
            result.deflection_m * 1e3
        ),
        hint: "add strands along the load path, or thicken them".to_owned(),
    });
    yields(job, built, result, findings);
    collapses(job, result, findings);
}

/// S407.
fn yields(job: &Job, built: &Built, result: &LoadResult, findings: &mut Findings) {
    let Some(first) = result.first_yield().filter(|first| first.factor.is_finite()) else { return };
    let site = Site {
        strand: first.strand,
        node: first.node,
        point: first.node.map(|node| built.frame.nodes()[node]),
        ..Site::default()
    };
    let (measured, limit) = (first.expected, job.limits.load_factor);
    let check = Check { code: Code::S407, measured, limit, warn_limit: None, site, time_s: None };
    findings.check(check, || {
        let strand = first.strand.map_or("?", |strand| &job.strands[strand].id);
        let what = match first.node {
            Some(node) => format!("node {node}, where `{strand}` holds to the frame,"),
            None => format!("strand `{strand}`"),
        };
        Words {
            message: format!(
                "load case `{}`: {what} is used up at {:.2} times the load; {:.2} ({:.2} to {:.2}) is what such predictions are worth",
                result.name, first.factor, measured.nominal, measured.low, measured.high
            ),
            hint: if first.node.is_some() {
                "enlarge the contact (press beads nearer together), or lead the load to other nodes".to_owned()
            } else {
                "add strands along the load path, or thicken them".to_owned()
            },
        }
    });
}

/// S408.
fn collapses(job: &Job, result: &LoadResult, findings: &mut Findings) {
    let Some(factor) = result.collapse().filter(|factor| factor.is_finite()) else { return };
    let e = job.material.youngs_modulus_pa;
    let measured = e.map(|e_pa| factor * e_pa / e.nominal);
    let (site, limit) = (Site::default(), job.limits.load_factor);
    let check = Check { code: Code::S408, measured, limit, warn_limit: None, site, time_s: None };
    findings.check(check, || Words {
        message: format!(
            "load case `{}` buckles the part at {factor:.2} times weight and load",
            result.name
        ),
        hint: "shorten or thicken the members in compression, or brace them".to_owned(),
    });
}
