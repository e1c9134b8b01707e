//! `twin solve`: the frame solver on a plain frame.

use std::path::PathBuf;

use serde_json::json;
use sim::pose::{Point, Vector};
use sim::structure::{
    Ask, BucklingAsk, Elastic, Frame, Load, Member, NodeLoad, Section, Solution, SolveError, Stage,
    StageRecord, StageState, Support, buckling, solve, solve_stages,
};
use slam::frame_file::{self, FrameFile};

use crate::files;
use crate::refusal::{Failure, Refusal};
use crate::screen::Screen;
use crate::{FEASIBLE, FOUND};

/// Parts per member where none are told: one cannot see a member buckle between its ends.
const PARTS: usize = 2;

/// Solve a plain frame of round bars, to hold the solver against another
///
/// FRAME.json, in mm, N, MPa, kg/mm³: `nodes [n][3]`, `members [m][2]`, `radius [m]`, `fixed [node…]`, `E`, `G`,
/// `density`; optional `gravity_m_s2`, `nodal_loads [{node, load[6]}]`, `initial_strain [m]`, `stiffness_factor [m]`,
/// `shear`, `sequence [member…]`, `buckling {elements_per_member, modes}`. Other keys are passed over. Exits with 1
/// where the frame, or a prefix of its sequence, floats or is a mechanism.
#[derive(Debug, clap::Args)]
pub(crate) struct Solve {
    /// The frame
    #[arg(value_name = "FRAME.json")]
    frame: PathBuf,
    /// How to tell the answer
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    /// The largest of everything, in words
    Text,
    /// Everything, in the units of the file
    Json,
}

/// All that was asked.
struct Answer {
    solution: Solution,
    buckling: Option<Vec<f64>>,
    history: Vec<StageRecord>,
}

/// Where a frame has no answer: step and member of the sequence, if it is one of its prefixes, and the node.
struct Unstable {
    step: Option<(usize, usize)>,
    node: usize,
}

impl Solve {
    pub(crate) fn run(self, screen: &mut Screen<'_>) -> Result<u8, Failure> {
        let source = files::text(&self.frame, files::MAX_TEXT)?;
        let file =
            frame_file::parse(&source).map_err(|problem| Refusal::of(&source, vec![problem]))?;
        let unusable =
            |message: String| Failure::from(Refusal::whole(source.name.clone(), message));
        let answer = answer(&file).map_err(unusable)?;
        let text = match (&answer, self.format) {
            (Err(unstable), Format::Json) => {
                let (step, member) = unstable.step.unzip();
                json!({"unstable": {"step": step, "member": member, "node": unstable.node}})
                    .to_string()
            }
            (Err(unstable), Format::Text) => unstable.words(),
            (Ok(answer), Format::Json) => as_json(answer).to_string(),
            (Ok(answer), Format::Text) => as_text(&file, answer),
        };
        writeln!(screen.out, "{text}")?;
        Ok(if answer.is_ok() { FEASIBLE } else { FOUND })
    }
}

/// Solves what is asked for. The outer error: no frame that can be used.
fn answer(file: &FrameFile) -> Result<Result<Answer, Unstable>, String> {
    let whole: Vec<usize> = (0..file.members.len()).collect();
    let frame = frame(file, &whole)?;
    let supports: Vec<Support> = file.fixed.iter().map(|&node| Support::clamped(node)).collect();
    let load = Load {
        gravity_m_s2: file.gravity_m_s2,
        at_nodes: file.nodal_loads.iter().map(node_load).collect(),
        with_initial_strain: !file.initial_strain.is_empty(),
    };
    let history = match history(file, &supports)? {
        Ok(history) => history,
        Err(unstable) => return Ok(Err(unstable)),
    };
    let solution = match solve(&frame, &supports, &load) {
        Ok(solution) => solution,
        Err(SolveError::Floats { node } | SolveError::Mechanism { node, .. }) => {
            return Ok(Err(Unstable { step: None, node }));
        }
        Err(error) => return Err(error.to_string()),
    };
    let factors = |modes| {
        let parts = file.buckling.elements_per_member.unwrap_or(PARTS);
        let ask = BucklingAsk { parts, modes, with_twist: false, near: None };
        buckling(&frame, &supports, &load, ask)
            .map(|modes| modes.iter().map(|mode| mode.factor).collect())
            .map_err(|error| error.to_string())
    };
    let buckling = file.buckling.modes.map(factors).transpose()?;
    Ok(Ok(Answer { solution, buckling, history }))
}

/// The frame in SI, its members in the given order.
fn frame(file: &FrameFile, order: &[usize]) -> Result<Frame, String> {
    let nodes = file.nodes.iter().map(|node| Point::from(Vector::from(*node) * 1e-3)).collect();
    let poisson = file.e_mpa / (2.0 * file.g_mpa) - 1.0;
    let member = |&member: &usize| {
        let factor = file.stiffness_factor.get(member).copied().unwrap_or(1.0);
        let round = Section::circle(2e-3 * file.radius[member]);
        Member {
            ends: file.members[member],
            section: if file.shear {
                round.sheared(Section::cowper_circle(poisson))
            } else {
                round
            },
            elastic: Elastic { e_pa: file.e_mpa * 1e6 * factor, g_pa: file.g_mpa * 1e6 * factor },
            density_kg_m3: file.density * 1e9,
            initial_strain: file.initial_strain.get(member).copied().unwrap_or(0.0),
            side: Vector::zeros(),
            strand: member,
        }
    };
    Frame::new(nodes, order.iter().map(member).collect()).map_err(|fault| fault.to_string())
}

fn node_load(told: &frame_file::FrameLoad) -> NodeLoad {
    let [fx, fy, fz, mx, my, mz] = told.load;
    NodeLoad { node: told.node, load: [fx, fy, fz, mx * 1e-3, my * 1e-3, mz * 1e-3] }
}

/// Every prefix of the sequence under its weight, one-shot and staged.
fn history(
    file: &FrameFile,
    supports: &[Support],
) -> Result<Result<Vec<StageRecord>, Unstable>, String> {
    let mut weight_only = frame(file, &file.sequence)?;
    if !file.initial_strain.is_empty() {
        let members = weight_only.members().iter().map(|m| Member { initial_strain: 0.0, ..*m });
        let members = members.collect();
        weight_only =
            Frame::new(weight_only.nodes().to_vec(), members).map_err(|f| f.to_string())?;
    }
    let stage = |born: usize| Stage {
        born,
        supports: supports.to_vec(),
        gravity_m_s2: file.gravity_m_s2,
        at_nodes: Vec::new(),
        ..Stage::default()
    };
    let stages: Vec<Stage> = (1..=file.sequence.len()).map(stage).collect();
    let ask = Ask { staged: true, ..Ask::default() };
    let records = solve_stages(&weight_only, &stages, ask).map_err(|error| error.to_string())?;
    for (step, record) in records.iter().enumerate() {
        let lost = record.floats.first().copied().or(record.mechanism.map(|(node, _)| node));
        if let Some(node) = lost {
            return Ok(Err(Unstable { step: Some((step, file.sequence[step])), node }));
        }
    }
    Ok(Ok(records))
}

/// Lengths in mm and moments in N mm; turns and forces as they are.
fn in_mm<const N: usize>(numbers: &[f64; N], first_is_length: bool) -> Vec<f64> {
    let scale = |(at, x): (usize, &f64)| {
        if ((at / 3) % 2 == 0) == first_is_length { x * 1e3 } else { *x }
    };
    numbers.iter().enumerate().map(scale).collect()
}

fn as_json(answer: &Answer) -> serde_json::Value {
    let Solution { displacement, end_forces, reactions, residual } = &answer.solution;
    let mut told = json!({
        "u": displacement.iter().map(|six| in_mm(six, true)).collect::<Vec<_>>(),
        "member_end_forces_global": end_forces.iter().map(|it| in_mm(it, false)).collect::<Vec<_>>(),
        "reactions": reactions.iter().map(|six| in_mm(six, false)).collect::<Vec<_>>(),
        "residual": residual,
    });
    if let Some(factors) = &answer.buckling {
        told["buckling"] = json!(factors);
    }
    if !answer.history.is_empty() {
        let row = |state: &Option<StageState>| {
            state.as_ref().map(|state| {
                json!({"max_translation": state.max_translation_m * 1e3, "node": state.max_node})
            })
        };
        let history = answer.history.iter();
        told["one_shot"] = history.clone().map(|record| row(&record.one_shot)).collect();
        told["staged"] = history.map(|record| row(&record.staged)).collect();
    }
    told
}

fn as_text(file: &FrameFile, answer: &Answer) -> String {
    let (n_nodes, n_members) = (file.nodes.len(), file.members.len());
    let mut rows =
        vec![format!("{n_nodes} nodes, {n_members} members, {} fixed", file.fixed.len())];
    let moved_mm = |six: &[f64; 6]| 1e3 * Vector::new(six[0], six[1], six[2]).norm();
    let moved = answer.solution.displacement.iter().map(moved_mm).enumerate();
    if let Some((node, mm)) = moved.max_by(|a, b| a.1.total_cmp(&b.1)) {
        rows.push(format!("moves      {mm:.6} mm at the most, node {node}"));
    }
    rows.push(format!("residual   {:.1e} of the loads", answer.solution.residual));
    if let Some(factors) = &answer.buckling {
        let told: Vec<String> = factors.iter().map(|factor| format!("{factor:.6}")).collect();
        let told = if told.is_empty() { "never".to_owned() } else { told.join(", ") };
        rows.push(format!("buckles    at {told} times the loads"));
    }
    let worst = |of: fn(&StageRecord) -> Option<&StageState>| {
        let states = answer.history.iter().enumerate().filter_map(|(k, it)| Some((k, of(it)?)));
        states.max_by(|a, b| a.1.max_translation_m.total_cmp(&b.1.max_translation_m))
    };
    for (name, worst) in [
        ("one-shot", worst(|record| record.one_shot.as_ref())),
        ("staged", worst(|record| record.staged.as_ref())),
    ] {
        if let Some((step, state)) = worst {
            rows.push(format!(
                "{name:<11}{:.6} mm at the most, node {} after step {step}",
                state.max_translation_m * 1e3,
                state.max_node
            ));
        }
    }
    rows.join("\n")
}

impl Unstable {
    fn words(&self) -> String {
        let Self { step, node } = self;
        match step {
            Some((step, member)) => {
                format!(
                    "unstable: once member {member} is printed (step {step}), node {node} is held by nothing"
                )
            }
            None => format!("unstable: node {node} is held by nothing"),
        }
    }
}
