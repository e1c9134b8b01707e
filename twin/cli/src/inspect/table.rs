//! The chain of a robot as a table.

use serde_json::{Value, json};
use sim::kinematics::{ChainJoint, Coverage, JointKind};

use super::{HeldArm, Inspected, solver_word};
use crate::refusal::Failure;
use crate::screen::Screen;

/// Joint by joint, then what is known about the whole.
pub(super) fn print(
    it: &Inspected,
    arm: Option<&HeldArm>,
    json: bool,
    screen: &mut Screen<'_>,
) -> Result<(), Failure> {
    if json {
        writeln!(screen.out, "{:#}", as_json(it, arm))?;
        return Ok(());
    }
    let notes = it.robot.notes.as_ref().map(|(_, notes)| notes);
    let name = notes.map_or(&it.robot.urdf.name, |notes| &notes.name);
    writeln!(screen.out, "{name}: {} to {}, {} moving joints\n", it.base, it.tip, it.chain.dof())?;
    let width =
        it.chain.joints().iter().map(|joint| joint.name.chars().count()).max().unwrap_or(0).max(5);
    writeln!(
        screen.out,
        "{:<width$}  {:<8} {:>10} {:>10} {:>11} {:>12} {:>13}",
        "joint", "kind", "lower", "upper", "speed", "effort", "acceleration"
    )?;
    for joint in it.chain.joints() {
        line(it, joint, width, screen)?;
    }
    writeln!(screen.out)?;
    whole(it, arm, screen)
}

fn line(
    it: &Inspected,
    joint: &ChainJoint,
    width: usize,
    screen: &mut Screen<'_>,
) -> Result<(), Failure> {
    let (kind, scale, unit, force) = match joint.kind {
        JointKind::Revolute => ("turns", 1f64.to_degrees(), "deg", "N m"),
        JointKind::Prismatic => ("slides", 1e3, "mm", "N"),
    };
    let stop = |value: f64| match value.is_finite() {
        true => format!("{:.2} {unit}", value * scale),
        false => "none".to_owned(),
    };
    let per = |value: Option<f64>, unit: &str, digits: usize| {
        value
            .filter(|value| value.is_finite())
            .map_or_else(|| "–".to_owned(), |value| format!("{value:.digits$} {unit}"))
    };
    let follows = joint.mimic.map(|mimic| {
        let master = &it.chain.joints()[mimic.master].name;
        format!("  follows {master}: {} × q + {}", mimic.multiplier, mimic.offset)
    });
    writeln!(
        screen.out,
        "{:<width$}  {kind:<8} {:>10} {:>10} {:>11} {:>12} {:>13}{}",
        joint.name,
        stop(joint.lower),
        stop(joint.upper),
        per(Some(joint.velocity * scale), &format!("{unit}/s"), 1),
        per(joint.effort, force, 1),
        per(acceleration(it, joint).map(|value| value * scale), &format!("{unit}/s²"), 0),
        follows.unwrap_or_default(),
    )?;
    Ok(())
}

fn acceleration(it: &Inspected, joint: &ChainJoint) -> Option<f64> {
    let (_, notes) = it.robot.notes.as_ref()?;
    notes.joints.get(&joint.name)?.acceleration
}

fn whole(it: &Inspected, arm: Option<&HeldArm>, screen: &mut Screen<'_>) -> Result<(), Failure> {
    let solved = arm.map_or("too many joints for inverse kinematics; hold some", |arm| {
        solver_word(&arm.arm.solver)
    });
    writeln!(screen.out, "arm       {solved}")?;
    if let Some(HeldArm { held, .. }) = arm.filter(|arm| !arm.held.is_empty()) {
        let names: Vec<&str> = (0..held.len()).map(|axis| it.chain.axis_name(axis)).collect();
        writeln!(screen.out, "          with {} held (--seed says where)", names.join(", "))?;
    }
    let urdf = &it.robot.urdf;
    let masses: Vec<f64> = urdf.links.iter().filter_map(|link| link.mass_kg).collect();
    let mass = match masses.is_empty() {
        true => "no masses".to_owned(),
        false => format!("masses on {}, {:.1} kg in all", masses.len(), masses.iter().sum::<f64>()),
    };
    let n_shapes: usize = urdf.links.iter().map(|link| link.collisions.len()).sum();
    writeln!(screen.out, "links     {}, {n_shapes} collision shapes, {mass}", urdf.links.len())?;
    match &it.robot.notes {
        None => {
            writeln!(screen.out, "source    {} (no robot.toml beside it)", it.robot.source.name)?
        }
        Some((text, notes)) => {
            writeln!(screen.out, "source    {}", notes.source)?;
            if !notes.joints_source.is_empty() {
                writeln!(screen.out, "          joints: {}", notes.joints_source)?;
            }
            if !notes.note.is_empty() {
                writeln!(screen.out, "note      {}", notes.note)?;
            }
            writeln!(screen.out, "files     {}, {}", it.robot.source.name, text.name)?;
        }
    }
    Ok(())
}

fn as_json(it: &Inspected, arm: Option<&HeldArm>) -> Value {
    let finite = |value: f64| value.is_finite().then_some(value);
    let joints: Vec<Value> = it
        .chain
        .joints()
        .iter()
        .map(|joint| {
            json!({
                "name": joint.name,
                "kind": match joint.kind { JointKind::Revolute => "revolute", JointKind::Prismatic => "prismatic" },
                "lower": finite(joint.lower),
                "upper": finite(joint.upper),
                "velocity": finite(joint.velocity),
                "effort": joint.effort.and_then(finite),
                "acceleration": acceleration(it, joint),
                "follows": joint.mimic.map(|mimic| json!({
                    "joint": it.chain.joints()[mimic.master].name,
                    "multiplier": mimic.multiplier,
                    "offset": mimic.offset,
                })),
            })
        })
        .collect();
    let notes = it.robot.notes.as_ref().map(|(_, notes)| notes);
    json!({
        "name": notes.map_or(&it.robot.urdf.name, |notes| &notes.name),
        "base": it.base,
        "tip": it.tip,
        "joints": joints,
        "arm": arm.map(|arm| json!({
            "solver": solver_word(&arm.arm.solver),
            "held": arm.held,
            "complete": arm.arm.coverage() == Coverage::Complete,
        })),
        "source": notes.map(|notes| &notes.source),
        "note": notes.map(|notes| &notes.note),
    })
}
