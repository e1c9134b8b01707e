//! What is rigid, and where it is carried.

use super::tape::{Tape, packing, path};
use crate::RecordError;
use crate::mesh::{self, Mesh};
use crate::paint;
use rerun::{Clear, Color, EntityPath, Mesh3D, Transform3D, ViewCoordinates};
use sim::film::{Film, Player};
use sim::pose::Pose;
use sim::preflight::Preflight;
use sim::scene::BodyKind;

/// Poses of all movers together.
const POSES_MAX: usize = 200_000;
/// Times between moments are filled up so far that a turning arm does not jump, s.
const STEP_S: f64 = 0.1;

/// Names of the way to each mover.
fn mover_names(film: &Film, mover: usize) -> Vec<String> {
    let owned = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    match mover {
        Film::ROOM => owned(&["world", "room"]),
        _ if mover == film.tool => owned(&["world", "tool"]),
        _ if mover == film.bed => owned(&["world", "bed"]),
        _ if mover == film.part => owned(&["world", "part"]),
        _ => {
            let own = &film.movers[mover];
            let twins = film.movers[1..mover].iter().filter(|name| *name == own).count();
            vec!["world".into(), "arm".into(), apart(own, twins)]
        }
    }
}

/// The path of each body, no two alike.
pub(super) fn body_paths(film: &Film) -> Vec<EntityPath> {
    let each = film.bodies.iter().enumerate().map(|(index, body)| {
        let before = film.bodies[..index].iter();
        let twins = before.filter(|b| b.mover == body.mover && b.name == body.name).count();
        let mut names = mover_names(film, body.mover);
        if body.kind == BodyKind::Form {
            names.push("forms".to_owned());
        }
        names.push(apart(&body.name, twins));
        path(names.iter().map(String::as_str))
    });
    each.collect()
}

fn apart(name: &str, twins: usize) -> String {
    if twins == 0 { name.to_owned() } else { format!("{}~{}", name, twins + 1) }
}

/// Meshes of everything rigid.
pub(super) fn bodies(tape: &Tape, film: &Film) -> Result<(), RecordError> {
    tape.still(path(["world"]), &ViewCoordinates::RIGHT_HAND_Z_UP())?;
    for (body, at) in film.bodies.iter().zip(body_paths(film)) {
        let Some(mesh) = packed(&mesh::of_body(body), body.kind) else { continue };
        match body.gone_s {
            None => tape.still(at, &mesh)?,
            Some(gone_s) => {
                tape.at(at.clone(), 0.0, &mesh)?;
                tape.at(at, gone_s, &Clear::flat())?;
            }
        }
    }
    match film.plate().and_then(|bed| packed(&mesh::of_body(&bed), bed.kind)) {
        Some(bed) => tape.still(path(["world", "bed", "plate"]), &bed),
        None => Ok(()),
    }
}

fn packed(mesh: &Mesh, kind: BodyKind) -> Option<Mesh3D> {
    if mesh.triangles.is_empty() {
        return None;
    }
    let points = mesh.points.iter().map(|p| [p.x, p.y, p.z]);
    let normals = mesh.normals.iter().map(|n| [n.x, n.y, n.z]);
    let [r, g, b] = paint::kind(kind);
    Some(
        Mesh3D::new(points)
            .with_vertex_normals(normals)
            .with_triangle_indices(mesh.triangles.iter().copied())
            .with_albedo_factor(rerun::datatypes::Rgba32::from_rgb(r, g, b)),
    )
}

/// Poses of the movers; those that never move are told once. How many were told.
pub(super) fn poses(tape: &Tape, preflight: &Preflight, film: &Film) -> Result<usize, RecordError> {
    let player = Player::new(preflight);
    let times_s = times(&player, film);
    let mut columns: Vec<Vec<Pose>> = vec![Vec::with_capacity(times_s.len()); film.movers.len()];
    for &time_s in &times_s {
        for (column, pose) in columns.iter_mut().zip(player.frame_at(time_s).world_from_mover) {
            column.push(pose);
        }
    }
    let mut told = 0;
    for (mover, poses) in columns.iter().enumerate() {
        let names = mover_names(film, mover);
        let at = path(names.iter().map(String::as_str));
        let Some(first) = poses.first() else { continue };
        let still = poses.iter().all(|pose| same(pose, first));
        let poses = if still { &poses[..1] } else { &poses[..] };
        told += poses.len();
        let translations = poses.iter().map(|pose| {
            let t = pose.translation.vector;
            [t.x, t.y, t.z]
        });
        let quaternions = poses.iter().map(|pose| {
            let q = pose.rotation.coords;
            rerun::Quaternion::from_xyzw([q.x, q.y, q.z, q.w].map(|x| x as f32))
        });
        let moved = Transform3D::update_fields()
            .with_many_translation(translations)
            .with_many_quaternion(quaternions);
        if still {
            tape.still(at, &moved)?;
        } else {
            tape.rows(at, &times_s, moved.columns_of_unit_batches().map_err(packing)?)?;
        }
    }
    Ok(told)
}

/// Key times, filled up where the arm moves for long between two of them.
fn times(player: &Player<'_>, film: &Film) -> Vec<f64> {
    let most = (POSES_MAX / film.movers.len().max(1)).max(2);
    let keys = player.key_times(most / 2);
    let keys = if keys.is_empty() { vec![0.0] } else { keys };
    let step_s = STEP_S.max(film.total_s / (most as f64 / 2.0));
    let mut times_s = Vec::with_capacity(most);
    for pair in keys.windows(2) {
        times_s.push(pair[0]);
        let steps = ((pair[1] - pair[0]) / step_s).ceil();
        if steps > 1.0 && player.posture_at(pair[0]) != player.posture_at(pair[1]) {
            let between =
                (1..steps as usize).map(|k| pair[0] + (pair[1] - pair[0]) * k as f64 / steps);
            times_s.extend(between);
        }
    }
    times_s.extend(keys.last());
    times_s
}

fn same(a: &Pose, b: &Pose) -> bool {
    (a.translation.vector - b.translation.vector).norm() < 1e-9
        && a.rotation.angle_to(&b.rotation) < 1e-7
}

/// The colour as the library has it.
pub(super) fn colour([r, g, b]: paint::Rgb) -> Color {
    Color::from_rgb(r, g, b)
}
