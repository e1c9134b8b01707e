//! The finished part under its loads.

use super::Built;
use crate::cell::{Job, LoadCase};
use crate::finding::{Check, Code, Findings, Site, Words};
use crate::pose::{Point, Vector};
use crate::structure::{
    BucklingAsk, Frame, Load, Mode, NodeLoad, SolveError, Strength, Support, buckling,
    first_yield_factor, solve,
};

/// What a load case came to.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadResult {
    /// Its name.
    pub name: String,
    /// Largest displacement of a node under weight and forces, m.
    pub deflection_m: f64,
    /// Factor on the forces at which the first member yields; `None`: it could not be found.
    pub first_yield: Option<f64>,
    /// Factor on weight and forces together at which the frame, were it perfect, would buckle; infinite: at none;
    /// `None`: it could not be found. Two parts per member.
    pub buckling: Option<f64>,
    /// Why the case could not be solved, if it could not.
    pub fault: Option<SolveError>,
}

/// Solves and judges every load case of a job.
pub(super) fn solve_all(
    job: &Job,
    built: &Built,
    strengths: &[Strength],
    findings: &mut Findings,
) -> Vec<LoadResult> {
    job.loads
        .iter()
        .map(|case| {
            let result = solve_case(job, built, strengths, case);
            judge(job, &result, findings);
            result
        })
        .collect()
}

fn solve_case(job: &Job, built: &Built, strengths: &[Strength], case: &LoadCase) -> LoadResult {
    let mut seats = Seats { frame: built.weightless_strain(), strengths: strengths.to_vec() };
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
    match under(&case.name, &seats, &supports, forces, gravity) {
        Ok(result) => result,
        Err(fault) => LoadResult {
            name: case.name.clone(),
            deflection_m: 0.0,
            first_yield: None,
            buckling: None,
            fault: Some(fault),
        },
    }
}

fn under(
    name: &str,
    seats: &Seats,
    supports: &[Support],
    forces: Vec<NodeLoad>,
    gravity: [f64; 3],
) -> Result<LoadResult, SolveError> {
    let weight = Load { gravity_m_s2: gravity, ..Load::default() };
    let load = Load { at_nodes: forces, ..Load::default() };
    let resting = solve(&seats.frame, supports, &weight)?;
    let loaded = solve(&seats.frame, supports, &load)?;
    let moved = resting.displacement.iter().zip(&loaded.displacement);
    let deflection_m = moved
        .map(|(a, b)| Vector::new(a[0] + b[0], a[1] + b[1], a[2] + b[2]).norm())
        .fold(0.0, f64::max);
    let factor = first_yield_factor(
        &seats.frame,
        &seats.strengths,
        (&resting, gravity),
        (&loaded, [0.0; 3]),
    )
    .ok();
    let both = Load { gravity_m_s2: gravity, ..load };
    let modes = buckling(&seats.frame, supports, &both, BucklingAsk::default());
    let least = |modes: &[Mode]| modes.first().map_or(f64::INFINITY, |mode| mode.factor);
    Ok(LoadResult {
        name: name.to_owned(),
        deflection_m,
        first_yield: factor.filter(|factor| factor.is_finite()),
        buckling: modes.ok().map(|modes| least(&modes)),
        fault: None,
    })
}

/// A frame that gets a node wherever a support or force sits.
struct Seats {
    frame: Frame,
    strengths: Vec<Strength>,
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
                        node
                    }
                    Err(_) => node,
                }
            }
            _ => node,
        }
    }
}

fn judge(job: &Job, result: &LoadResult, findings: &mut Findings) {
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
}
