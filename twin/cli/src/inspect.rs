//! `twin inspect`: what a robot is, where its tip goes, and which joints bring it there.

mod answers;
mod numbers;
mod table;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use sim::kinematics::{self, Arm, Chain, Solver};
use slam::urdf::RobotDescription;
use slam::{Diagnostic, Source, Span};

use crate::FEASIBLE;
use crate::library::{Kind, Library, LibraryArgs};
use crate::names::with_names;
use crate::refusal::{Failure, Refusal};
use crate::robot::{self, RobotFiles};
use crate::screen::Screen;

/// Look at a robot: chain, limits, forward and inverse kinematics
///
/// Without --q and --ik: a table of the joints from base to tip, with limits and their source. No
/// ROS is needed; meshes that are not there are named in a warning.
#[derive(Debug, clap::Args)]
pub(crate) struct Inspect {
    /// URDF, or a robot of the library such as kuka/kr6_r900_sixx
    #[arg(value_name = "ROBOT.urdf")]
    robot: String,
    /// First link of the chain; base_link if absent, else the root
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// Last link of the chain; tool0 if absent, else the only leaf
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
    /// Joint vectors (rad or m, moving joints base to tip, mimic joints left out): answers tip
    /// poses and Jacobians
    #[arg(long, value_name = "FILE.json", conflicts_with = "ik")]
    q: Option<PathBuf>,
    /// Poses {"position_m", "quaternion_wxyz"} of the tip in the base: answers all joint vectors
    #[arg(long, value_name = "FILE.json")]
    ik: Option<PathBuf>,
    /// All moving joints, rad or m: joints before the arm stay here; a search starts here
    #[arg(long, value_name = "Q1,Q2,…", allow_hyphen_values = true)]
    seed: Option<String>,
    /// Elbow of seven-joint arms: angle about the line shoulder to wrist, degrees
    #[arg(long, value_name = "D", default_value_t = 0.0, allow_hyphen_values = true, value_parser = degrees)]
    elbow_deg: f64,
    /// Folder of a package:// of the URDF; may be given again
    #[arg(long, value_name = "NAME=DIR", value_parser = package)]
    package: Vec<(String, PathBuf)>,
    /// What to print; JSON is the default with --q and --ik
    #[arg(long, value_enum)]
    format: Option<Format>,
    #[command(flatten)]
    library: LibraryArgs,
}

fn package(text: &str) -> Result<(String, PathBuf), String> {
    match text.split_once('=') {
        Some((name, folder)) if !name.is_empty() && !folder.is_empty() => {
            Ok((name.to_owned(), PathBuf::from(folder)))
        }
        _ => Err("say NAME=DIR".to_owned()),
    }
}

fn degrees(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().map_err(|error| error.to_string())?;
    if value.is_finite() { Ok(value) } else { Err("a finite number is needed".to_owned()) }
}

/// A robot with the chain asked for.
struct Inspected {
    robot: RobotFiles,
    base: String,
    tip: String,
    chain: Chain,
}

/// An arm with the joints before it held.
struct HeldArm {
    arm: Arm,
    /// Values of the leading joints of the whole chain, rad or m.
    held: Vec<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    /// Text for people
    Human,
    /// JSON for programs
    Json,
}

impl Inspect {
    pub(crate) fn run(self, screen: &mut Screen<'_>) -> Result<u8, Failure> {
        let robot = self.robot(&Library::open(&self.library)?)?;
        let packages: BTreeMap<String, PathBuf> = self.package.iter().cloned().collect();
        screen.say(&robot.source, &robot.missing_meshes(&packages))?;
        let base = base(&robot, self.base.as_deref())?;
        let tip = tip(&robot, self.tip.as_deref())?;
        let tree = kinematics::from_urdf(&robot.urdf, &base, &tip, &[])
            .map_err(|fault| Refusal::whole(&robot.source.name, fault.to_string()))?;
        let it = Inspected { robot, base, tip, chain: tree.chain };
        let json = |default| self.format.unwrap_or(default) == Format::Json;
        match (&self.q, &self.ik) {
            (Some(path), _) => answers::forward(&it, path, json(Format::Json), screen)?,
            (None, Some(path)) => {
                let seed = self.seed(&it)?;
                let arm = held_arm(&it, seed.as_deref())?;
                let ask = answers::Ask { seed, elbow_rad: self.elbow_deg.to_radians() };
                answers::inverse(&it, &arm, path, &ask, json(Format::Json), screen)?;
            }
            (None, None) => {
                let arm = held_arm(&it, self.seed(&it)?.as_deref());
                table::print(&it, arm.ok().as_ref(), json(Format::Human), screen)?;
            }
        }
        Ok(FEASIBLE)
    }

    /// A file of this name goes before a robot of the library.
    fn robot(&self, library: &Library) -> Result<RobotFiles, Refusal> {
        let path = Path::new(&self.robot);
        if path.is_file() || self.robot.to_lowercase().ends_with(".urdf") {
            return robot::from_path(path);
        }
        if let Some(robot) = robot::from_library(library, &self.robot)? {
            return Ok(robot);
        }
        let wrong = crate::names::clipped(&self.robot);
        let problem = Diagnostic::error(
            Span::default(),
            format!("neither a file nor a robot of the library is called `{wrong}`"),
        );
        let problem = with_names(problem, &self.robot, &library.names(Kind::Robot));
        Err(Refusal::of(&Source::new(&self.robot, ""), vec![problem]))
    }

    /// `--seed`: one finite number per moving joint.
    fn seed(&self, it: &Inspected) -> Result<Option<Vec<f64>>, Refusal> {
        let Some(text) = &self.seed else { return Ok(None) };
        let source = Source::new("--seed", text);
        let (mut seed, mut at) = (Vec::new(), 0);
        for part in text.split(',') {
            match part.trim().parse::<f64>() {
                Ok(value) if value.is_finite() => seed.push(value),
                _ => {
                    let span = Span { start: at, end: at + part.len() };
                    let message =
                        format!("{:?} is not a finite number", crate::names::clipped(part));
                    return Err(Refusal::of(&source, vec![Diagnostic::error(span, message)]));
                }
            }
            at += part.len() + 1;
        }
        if seed.len() == it.chain.dof() {
            return Ok(Some(seed));
        }
        let message =
            format!("{} values; the chain has {} moving joints", seed.len(), it.chain.dof());
        let problem = Diagnostic::error(Span { start: 0, end: text.len() }, message);
        Err(Refusal::of(&source, vec![problem.hint(joint_order(&it.chain))]))
    }
}

/// The joints of a joint vector, for a hint.
fn joint_order(chain: &Chain) -> String {
    let names: Vec<&str> = (0..chain.dof()).map(|axis| chain.axis_name(axis)).collect();
    format!("in this order: {}", names.join(", "))
}

fn base(robot: &RobotFiles, asked: Option<&str>) -> Result<String, Refusal> {
    if let Some(asked) = asked {
        return known_link(robot, "--base", asked);
    }
    let urdf = &robot.urdf;
    let is_child = |name: &str| urdf.joints.iter().any(|joint| joint.child == name);
    let named = urdf.links.iter().find(|link| link.name == "base_link");
    let root = urdf.links.iter().find(|link| !is_child(&link.name));
    let link = named.or(root).map(|link| link.name.clone());
    link.ok_or_else(|| Refusal::whole(&robot.source.name, "the robot has no root link"))
}

fn tip(robot: &RobotFiles, asked: Option<&str>) -> Result<String, Refusal> {
    if let Some(asked) = asked {
        return known_link(robot, "--tip", asked);
    }
    if robot.urdf.links.iter().any(|link| link.name == "tool0") {
        return Ok("tool0".to_owned());
    }
    match leaves(&robot.urdf).as_slice() {
        [only] => Ok((*only).to_owned()),
        leaves => Err(Refusal::whole(
            &robot.source.name,
            format!("no link is called tool0, and the robot ends in {} links", leaves.len()),
        )
        .hint(format!("say --tip and one of: {}", leaves.join(", ")))),
    }
}

fn leaves(urdf: &RobotDescription) -> Vec<&str> {
    let is_parent = |name: &str| urdf.joints.iter().any(|joint| joint.parent == name);
    let links = urdf.links.iter().map(|link| link.name.as_str());
    links.filter(|name| !is_parent(name)).collect()
}

fn known_link(robot: &RobotFiles, option: &str, asked: &str) -> Result<String, Refusal> {
    let known: Vec<String> = robot.urdf.links.iter().map(|link| link.name.clone()).collect();
    if known.iter().any(|name| name == asked) {
        return Ok(asked.to_owned());
    }
    let message = format!("the robot has no link `{}`", crate::names::clipped(asked));
    let problem = with_names(Diagnostic::error(Span::default(), message), asked, &known);
    Err(Refusal::of(&Source::new(option, asked), vec![problem]))
}

/// The arm of a chain. Where no closed form fits the whole, leading joints (a torso, a rail) are
/// held at the seed, else at zero or the limit nearest to it, until one fits the rest.
fn held_arm(it: &Inspected, seed: Option<&[f64]>) -> Result<HeldArm, Refusal> {
    let chain = &it.chain;
    let fault =
        |fault: kinematics::ChainFault| Refusal::whole(&it.robot.source.name, fault.to_string());
    let whole = kinematics::recognise(chain);
    if let Ok(arm) = &whole
        && !matches!(arm.solver, Solver::Numeric(_))
    {
        return Ok(HeldArm { arm: arm.clone(), held: Vec::new() });
    }
    let rest = |axis: usize| {
        let limits = &chain.axes()[axis];
        seed.map_or(0.0_f64.max(limits.lower).min(limits.upper), |seed| seed[axis])
    };
    for n_held in 1..chain.dof().saturating_sub(5) {
        let held: Vec<f64> = (0..n_held).map(rest).collect();
        let named: Vec<(&str, f64)> =
            held.iter().enumerate().map(|(axis, &value)| (chain.axis_name(axis), value)).collect();
        let arm = kinematics::recognise(&chain.hold(&named).map_err(fault)?).map_err(fault);
        let Ok(arm) = arm else { continue };
        if matches!(arm.solver, Solver::Opw(_) | Solver::Parallel(_) | Solver::Srs(_)) {
            within_limits(chain, &held)?;
            return Ok(HeldArm { arm, held });
        }
    }
    Ok(HeldArm { arm: whole.map_err(fault)?, held: Vec::new() })
}

fn within_limits(chain: &Chain, held: &[f64]) -> Result<(), Refusal> {
    for (axis, value) in held.iter().enumerate() {
        let limits = &chain.axes()[axis];
        if !(limits.lower..=limits.upper).contains(value) {
            let name = chain.axis_name(axis);
            let message = format!(
                "joint {name} is held at {value}, outside its limits {} to {}",
                limits.lower, limits.upper
            );
            return Err(Refusal::whole("--seed", message));
        }
    }
    Ok(())
}

/// The word for how an arm is solved.
fn solver_word(solver: &Solver) -> &'static str {
    match solver {
        Solver::Opw(_) => "six joints with spherical wrist (OPW), closed form, all branches",
        Solver::Parallel(_) => "three parallel axes with offset wrist, closed form, all branches",
        Solver::Srs(_) => {
            "seven joints, spherical shoulder and wrist (S-R-S), closed form by elbow angle"
        }
        Solver::Cartesian(_) => "three sliding joints, closed form",
        Solver::Numeric(_) => "no closed form fits: numeric search, solutions may be missed",
    }
}
