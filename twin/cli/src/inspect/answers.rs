//! Forward and inverse kinematics of a file of joint vectors or poses.

use std::path::Path;

use serde_json::{Value, json};
use sim::kinematics::{Coverage, IkOptions, ROTATION_TOLERANCE_RAD, Solution};
use sim::pose::Pose;

use super::{HeldArm, Inspected, joint_order, numbers};
use crate::refusal::Failure;
use crate::screen::Screen;

/// What is asked beside the poses.
pub(super) struct Ask {
    /// All moving joints, rad or m.
    pub(super) seed: Option<Vec<f64>>,
    /// Elbow of seven-joint arms, rad.
    pub(super) elbow_rad: f64,
}

/// Tip poses and Jacobians of joint vectors.
pub(super) fn forward(
    it: &Inspected,
    path: &Path,
    json: bool,
    screen: &mut Screen<'_>,
) -> Result<(), Failure> {
    let vectors = numbers::joint_vectors(path, it.chain.dof(), &joint_order(&it.chain))?;
    let answers = vectors.iter().map(|q| {
        let (position_m, quaternion_wxyz) = parts(&it.chain.forward(q));
        let jacobian = it.chain.jacobian(q);
        let rows: Vec<Vec<f64>> =
            jacobian.row_iter().map(|row| row.iter().copied().collect()).collect();
        json!({ "position_m": position_m, "quaternion_wxyz": quaternion_wxyz, "jacobian": rows })
    });
    if json {
        return list(answers, screen);
    }
    writeln!(screen.out, "{} in {}: x y z mm, quaternion w x y z", it.tip, it.base)?;
    for (k, q) in vectors.iter().enumerate() {
        let ([x, y, z], [qw, qx, qy, qz]) = parts(&it.chain.forward(q));
        let [x, y, z] = [x, y, z].map(|m| m * 1e3);
        writeln!(
            screen.out,
            "{k:>4}  {x:>11.4} {y:>11.4} {z:>11.4}   {qw:>10.7} {qx:>10.7} {qy:>10.7} {qz:>10.7}"
        )?;
    }
    Ok(())
}

/// All joint vectors of poses.
pub(super) fn inverse(
    it: &Inspected,
    arm: &HeldArm,
    path: &Path,
    ask: &Ask,
    json: bool,
    screen: &mut Screen<'_>,
) -> Result<(), Failure> {
    let targets = numbers::poses(path)?;
    let n_held = arm.held.len();
    let seed = ask.seed.as_ref().map(|seed| &seed[n_held..]);
    let options = IkOptions { seed, elbow_rad: ask.elbow_rad };
    let mut found: Vec<Solution> = Vec::new();
    let mut solve = |target: &Pose| {
        let coverage = arm.arm.inverse(target, &options, &mut found);
        // sliding axes reach a place in whatever orientation; a pose asks for both
        let fits = found.iter().filter(|each| each.rotation_error_rad <= ROTATION_TOLERANCE_RAD);
        let whole = |each: &Solution| arm.held.iter().chain(each.q.iter()).copied().collect();
        (fits.map(whole).collect::<Vec<Vec<f64>>>(), coverage == Coverage::Complete)
    };
    if json {
        let answers = targets.iter().map(|target| {
            let (solutions, complete) = solve(target);
            json!({ "solutions": solutions, "complete": complete })
        });
        return list(answers, screen);
    }
    let sliding = sliding(it);
    writeln!(
        screen.out,
        "{} (deg, mm), {}",
        joint_order(&it.chain),
        super::solver_word(&arm.arm.solver)
    )?;
    for (k, target) in targets.iter().enumerate() {
        let (solutions, complete) = solve(target);
        let all = if complete { "" } else { ", maybe not all" };
        writeln!(screen.out, "pose {k}: {} solutions{all}", solutions.len())?;
        for q in solutions {
            let shown = q.iter().zip(&sliding).map(|(&q, &slides)| {
                format!("{:>10.4}", if slides { q * 1e3 } else { q.to_degrees() })
            });
            writeln!(screen.out, "  {}", shown.collect::<Vec<_>>().join(" "))?;
        }
    }
    Ok(())
}

/// Whether each entry of a joint vector is a length.
fn sliding(it: &Inspected) -> Vec<bool> {
    let slides = |axis: &sim::kinematics::ChainAxis| {
        it.chain.joints()[axis.joint].kind == sim::kinematics::JointKind::Prismatic
    };
    it.chain.axes().iter().map(slides).collect()
}

/// Position, m, and the unit quaternion w x y z with w ≥ 0.
fn parts(pose: &Pose) -> ([f64; 3], [f64; 4]) {
    let q = pose.rotation.normalize();
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    (pose.translation.vector.into(), [q.w, q.i, q.j, q.k].map(|part| sign * part))
}

/// A JSON array, one item per line, written as it is computed.
fn list(items: impl Iterator<Item = Value>, screen: &mut Screen<'_>) -> Result<(), Failure> {
    let mut separator = "[\n";
    for item in items {
        write!(screen.out, "{separator}{item}")?;
        separator = ",\n";
    }
    let open = if separator == "[\n" { "[" } else { "" };
    writeln!(screen.out, "{open}\n]")?;
    Ok(())
}
