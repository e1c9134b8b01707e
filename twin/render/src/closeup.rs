//! A finding from near by: the place in the middle, the bodies and the strand concerned outlined and named.

use crate::canvas::line;
use crate::layer::{Things, thing};
use crate::overlay::{self, unit};
use crate::paint::{HIGHLIGHT, INK};
use crate::sheet::ELEVATION_DEG;
use crate::text::{Anchor, Ink, Pen};
use crate::view::{Camera, Fit, Margins, Projection, View};
use crate::{Engine, Picture, RenderError, shade};
use image::RgbaImage;
use sim::pose::{Point, Vector};
use sim::scene::solid::HitId;
use sim::scene::{Bounds, Scene};

/// Half of what is shown, against the radius of the thickest bead, and at least and at most, m.
const REACH_RADII: f64 = 14.0;
const REACH_M: [f64; 2] = [0.008, 0.08];
/// Sides that are tried; the one that shows most of what is outlined is taken.
const SIDES_DEG: [f64; 8] = [-50.0, -5.0, 40.0, 85.0, 130.0, 175.0, -140.0, -95.0];
/// Size of the trial pictures, px.
const TRIAL_PX: (u32, u32) = (96, 72);

/// The first mark from near by; the whole part where there is none.
pub(crate) fn close_up(
    scene: &Scene,
    size_px: (u32, u32),
    engine: &Engine,
) -> Result<Picture, RenderError> {
    let near = scene.marks.first().map(|mark| around(scene, mark.at));
    let fit = near.map_or(Fit::Part, Fit::Box);
    let camera = near.map_or(Camera::Isometric, |near| best_side(scene, &near));
    let view = View { size_px, camera, fit, ghost_arm: true };
    let mut picture = overlay::picture(scene, &view, engine)?;
    let (_, projection) = picture.views[0];
    names(&mut picture.rgba, scene, &projection, engine)?;
    Ok(picture)
}

/// A box about the place, with the other marks that are not far.
fn around(scene: &Scene, at: Point) -> Bounds {
    let radius_m = scene.strands.iter().map(|strand| strand.radius_m).fold(0.0, f64::max);
    let others = scene.marks.iter().map(|mark| 1.2 * (mark.at - at).norm());
    let others_m = others.filter(|off_m| *off_m <= REACH_M[1]).fold(0.0, f64::max);
    let reach = (REACH_RADII * radius_m).max(others_m).clamp(REACH_M[0], REACH_M[1]);
    Bounds { min: at - Vector::repeat(reach), max: at + Vector::repeat(reach) }
}

fn outlined(scene: &Scene, id: HitId) -> bool {
    match id {
        HitId::Body(i) => scene.bodies.get(i).is_some_and(|body| body.highlighted),
        HitId::Strand(i) => scene.strands.get(i).is_some_and(|strand| strand.highlighted),
        HitId::Bed => false,
    }
}

/// The side that shows the place itself, and of these the one that shows most of what is outlined.
fn best_side(scene: &Scene, near: &Bounds) -> Camera {
    // a few thousand rays are cheaper than a pass of a software card
    let by_rays = Engine::Cpu { because: None };
    let solid = |id: HitId| {
        outlined(scene, id) || !matches!(id, HitId::Body(i) if shade::is_ghost(scene, i))
    };
    let things = Things::new(scene, &by_rays, 0.0, solid);
    let score = |camera: &Camera| {
        let corners = near.corners().into_iter();
        let view = Projection::fit(camera.axes(), corners, TRIAL_PX, Margins::default());
        let Ok(layer) = things.capture(&by_rays, &view) else { return 0.0 };
        let seen =
            layer.samples.iter().filter_map(|s| thing(s.id)).filter(|id| outlined(scene, *id));
        let [x, y, depth_m] = view.project(near.centre());
        let front_m = f64::from(layer.at(x as i64, y as i64).depth_m);
        // hidden by more than a tenth of the box
        let hidden = front_m < depth_m - 0.1 * near.size().x;
        seen.count() as f64 * if hidden { 0.3 } else { 1.0 }
    };
    let all = SIDES_DEG.iter().flat_map(|&azimuth_deg| {
        [ELEVATION_DEG, 4.0].map(|elevation_deg| Camera::Orbit { azimuth_deg, elevation_deg })
    });
    let mut best = (Camera::Isometric, f64::NEG_INFINITY);
    for camera in all {
        let here = score(&camera);
        if here > 1.1 * best.1.max(0.0) || best.1 == f64::NEG_INFINITY {
            best = (camera, here);
        }
    }
    best.0
}

/// Writes the name of each outlined body beside the nearest place where it is seen.
fn names(
    image: &mut RgbaImage,
    scene: &Scene,
    view: &Projection,
    engine: &Engine,
) -> Result<(), RenderError> {
    let Some(mark) = scene.marks.first() else { return Ok(()) };
    let solid = |id: HitId| outlined(scene, id) || matches!(id, HitId::Strand(_) | HitId::Bed);
    let layer = Things::new(scene, engine, 0.0, solid).capture(engine, view)?;
    let [mx, my, _] = view.project(mark.at);
    let (width, height) = view.size_px;
    let mut nearest: Vec<(String, [f64; 2], f64)> = Vec::new();
    for (k, sample) in layer.samples.iter().enumerate() {
        let Some(HitId::Body(i)) = thing(sample.id) else { continue };
        let name = &scene.bodies[i].name;
        let at = [(k as u32 % width) as f64, (k as u32 / width) as f64];
        let off = (at[0] - mx).hypot(at[1] - my);
        match nearest.iter_mut().find(|(known, ..)| known == name) {
            Some(known) if off < known.2 => (known.1, known.2) = (at, off),
            Some(_) => {}
            None => nearest.push((name.clone(), at, off)),
        }
    }
    let pen = Pen::new()?;
    let u = unit(view.size_px);
    let ink = Ink { size: 18.0 * u, rgb: INK, halo: 3.0 * u };
    for (row, (name, [x, y], _)) in nearest.iter().enumerate() {
        // beside the place, on the side with more room, one row for each
        let left = *x > f64::from(width) * 0.5;
        let (dx, anchor) = if left { (-64.0, Anchor::Right) } else { (64.0, Anchor::Left) };
        let from = [*x as f32, *y as f32];
        let down = (row as f32 + 1.0) * 30.0 * u;
        let to_y =
            if from[1] + down < height as f32 - 90.0 * u { from[1] + down } else { from[1] - down };
        let to = [from[0] + dx * u, to_y];
        line(image, from, to, 3.6 * u, 0xFFFFFF, 0.8);
        line(image, from, to, 1.6 * u, HIGHLIGHT, 1.0);
        let text = pen.cut(name, ink.size, 0.35 * width as f32);
        pen.write(image, [to[0] + dx.signum() * 5.0 * u, to[1]], anchor, ink, &text);
    }
    Ok(())
}
