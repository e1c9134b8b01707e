//! A page: the whole cell, a close-up of the part, and what the colours mean.

use crate::canvas::{border, line, rect};
use crate::overlay::{self, legend, unit};
use crate::paint::{FAINT, INK};
use crate::shade::shoot;
use crate::text::{Anchor, Ink, Pen};
use crate::view::{Camera, Fit, Margins, Projection, View};
use crate::{Engine, Picture, RenderError, cpu, layer};
use image::{Rgba, RgbaImage, imageops};
use sim::scene::cast::Caster;
use sim::scene::solid::{HitId, solids};
use sim::scene::{BodyKind, Scene};
use std::collections::BTreeSet;

/// Sides to look from, the usual one first; another is taken only if it shows clearly more of the part.
const SIDES_DEG: [f64; 4] = [-50.0, 40.0, -140.0, 130.0];
pub(crate) const ELEVATION_DEG: f64 = 28.0;
const CLEARLY_MORE: f64 = 1.3;

/// A box on the page: left, top, width, height, px.
type Place = [u32; 4];

/// The whole cell, and beside it the part as seen through the arm, with one legend for both.
pub(crate) fn compose(
    scene: &Scene,
    size_px: (u32, u32),
    engine: &Engine,
) -> Result<Picture, RenderError> {
    let pen = Pen::new()?;
    let (width, height) = size_px;
    let u = unit(size_px);
    let gap = (16.0 * u) as u32;
    let head = (62.0 * u) as u32;
    let foot = (36.0 * u) as u32;
    let tall = height - head - foot;
    let legend_width = ((legend::WIDTH + 12.0) * u) as u32;
    let both = width - legend_width - 4 * gap;
    let main: Place = [gap, head, both * 56 / 100, tall];
    let inset: Place = [2 * gap + main[2], head, both - main[2], tall];
    let mut page = RgbaImage::from_pixel(width, height, Rgba([255; 4]));
    let ink = Ink { size: 29.0 * u, rgb: INK, halo: 0.0 };
    let title = pen.cut(&scene.title, ink.size, (width - 2 * gap) as f32);
    pen.write(&mut page, [gap as f32, head as f32 * 0.5], Anchor::Left, ink, &title);
    let (mut views, mut seen) = (Vec::new(), BTreeSet::new());
    for (place, fit, ghost_arm, name) in
        [(main, Fit::Cell, false, "cell"), (inset, Fit::Part, true, "part, arm as glass")]
    {
        let azimuth_deg = best_side(scene, ghost_arm);
        let camera = Camera::Orbit { azimuth_deg, elevation_deg: ELEVATION_DEG };
        let view = View { size_px: (place[2], place[3]), camera, fit, ghost_arm };
        let around = f64::from(30.0 * u);
        let bottom = f64::from(if ghost_arm { 120.0 * u } else { 84.0 * u });
        let margins = Margins { left: around, top: f64::from(52.0 * u), right: around, bottom };
        let shot = shoot(scene, &view, margins, engine)?;
        let mut image = shot.image;
        seen.extend(shot.seen);
        if !ghost_arm {
            frame_part(&mut image, scene, &shot.projection, u);
        }
        overlay::marks(&mut image, &pen, scene, &shot.projection, u, ghost_arm);
        overlay::furniture(&mut image, &pen, &shot.projection, u);
        let caption = Ink { size: 19.0 * u, rgb: FAINT, halo: 2.0 * u };
        pen.write(&mut image, [16.0 * u, 22.0 * u], Anchor::Left, caption, name);
        imageops::replace(&mut page, &image, i64::from(place[0]), i64::from(place[1]));
        let [x, y, w, h] = place.map(|v| v as f32);
        border(&mut page, [x, y], [w, h], 0xC3CBD3, u.max(1.0).round());
        views.push(((place[0], place[1]), shot.projection));
    }
    let x = (inset[0] + inset[2] + gap) as f32;
    let at = [x, head as f32 + 12.0 * u];
    legend::draw(&mut page, &pen, (scene, &seen), at, tall as f32 - 24.0 * u, u);
    overlay::drawn_by(&mut page, &pen, engine, u);
    rect(&mut page, [0.0, 0.0], [width as f32, 4.0 * u], INK, 1.0);
    Ok(Picture { rgba: page, drawn_by: engine.drawn_by(), views })
}

/// Draws the edges of the part's box, so that the eye finds the part in the cell.
fn frame_part(image: &mut RgbaImage, scene: &Scene, view: &Projection, u: f32) {
    let Some(part) = scene.part() else { return };
    let corners = part.corners().map(|p| view.project(p));
    let at = |i: usize| [corners[i][0] as f32, corners[i][1] as f32];
    for (i, bit) in
        (0..8).flat_map(|i| [1, 2, 4].map(|bit| (i, bit))).filter(|(i, bit)| i & bit == 0)
    {
        line(image, at(i), at(i | bit), 1.2 * u, 0x2563EB, 0.45);
    }
}

/// The side from which most of the strands is seen, by a few rays.
pub(crate) fn best_side(scene: &Scene, ghost_arm: bool) -> f64 {
    let clear = |id: HitId| match id {
        HitId::Body(i) => scene.bodies.get(i).is_some_and(|b| match b.kind {
            BodyKind::Obstacle => true,
            BodyKind::Arm | BodyKind::OtherArm | BodyKind::Tool => ghost_arm,
            BodyKind::Nozzle | BodyKind::Bed | BodyKind::Form => false,
        }),
        HitId::Bed | HitId::Strand(_) => false,
    };
    let Some(part) = scene.part() else { return SIDES_DEG[0] };
    let caster = Caster::of(solids(scene, |id| !clear(id)));
    let far_m = -100.0;
    let seen = |azimuth_deg: f64| {
        let camera = Camera::Orbit { azimuth_deg, elevation_deg: ELEVATION_DEG };
        let corners = part.corners();
        let view =
            Projection::fit(camera.axes(), corners.into_iter(), (120, 90), Margins::default());
        let samples = cpu::capture(&caster, &view, far_m);
        let strand = |s: &&layer::Sample| matches!(layer::thing(s.id), Some(HitId::Strand(_)));
        samples.iter().filter(strand).count() as f64
    };
    let usual = seen(SIDES_DEG[0]);
    let mut best = (SIDES_DEG[0], usual * CLEARLY_MORE);
    for side in &SIDES_DEG[1..] {
        let here = seen(*side);
        if here > best.1 {
            best = (*side, here);
        }
    }
    best.0
}
