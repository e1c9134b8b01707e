//! A page of several moments of one thing: one side, one scale, one legend.

use crate::canvas::{border, rect};
use crate::overlay::{self, legend, unit};
use crate::paint::{FAINT, INK};
use crate::shade::shoot;
use crate::sheet::{ELEVATION_DEG, best_side};
use crate::text::{Anchor, Ink, Pen};
use crate::view::{Camera, Fit, Margins, Projection, View};
use crate::{Engine, Picture, RenderError};
use image::{Rgba, RgbaImage, imageops};
use sim::pose::Vector;
use sim::scene::{Bounds, Row, Scene};
use std::collections::BTreeSet;

/// More would be too small to see.
const MOST_SCENES: usize = 6;
/// Turns from the usual side that may show a long part larger, deg.
const TURNS_DEG: [f64; 3] = [0.0, -28.0, 28.0];
const CLEARLY_LARGER: f64 = 1.1;
/// Colour of the word that says what a picture is not.
const STAMP: u32 = 0xB45309;

/// Where the moments go: how many px each, from where on, and what of it is free of letters.
struct Places {
    /// Left, top, width, height, px.
    each: Vec<[u32; 4]>,
    margins: Margins,
}

impl Places {
    /// `area` is left, top, width, height of all together.
    fn new(area: [u32; 4], count: u32, below: bool, u: f32) -> Places {
        let gap = (12.0 * u) as u32;
        let [left, top, width, height] = area;
        let room = |all: u32| (all.saturating_sub((count - 1) * gap) / count).max(1);
        let px = |v: f32| f64::from(v * u);
        let each = |k: u32| match below {
            true => [left, top + k * (room(height) + gap), width, room(height)],
            false => [left + k * (room(width) + gap), top, room(width), height],
        };
        // letters stand left of the thing, or above and below it
        let margins = match below {
            true => Margins { left: px(290.0), top: px(26.0), right: px(26.0), bottom: px(26.0) },
            false => Margins { left: px(26.0), top: px(104.0), right: px(26.0), bottom: px(118.0) },
        };
        Places { each: (0..count).map(each).collect(), margins }
    }

    fn size_px(&self) -> (u32, u32) {
        self.each.first().map_or((1, 1), |place| (place[2], place[3]))
    }

    /// How long the box's longest edge would be drawn, px: a long part seen end on is drawn at a large
    /// scale and shows little.
    fn longest_px(&self, camera: Camera, bounds: Bounds) -> f64 {
        let corners = bounds.corners().into_iter();
        let view = Projection::fit(camera.axes(), corners, self.size_px(), self.margins);
        let edge = bounds.size();
        let longest = Vector::ith(edge.imax(), edge.max());
        let [right, up, _] = camera.axes();
        longest.dot(&right).hypot(longest.dot(&up)) * view.px_per_m
    }
}

/// The moments of a row beside or below each other, whichever shows them larger.
pub(crate) fn compose(
    row: &Row,
    size_px: (u32, u32),
    engine: &Engine,
) -> Result<Picture, RenderError> {
    let pen = Pen::new()?;
    let (width, height) = size_px;
    let u = unit(size_px);
    let gap = (16.0 * u) as u32;
    let (head, foot) = ((62.0 * u) as u32, (36.0 * u) as u32);
    let legend_width = ((legend::WIDTH + 12.0) * u) as u32;
    let mut page = RgbaImage::from_pixel(width, height, Rgba([255; 4]));
    let ink = Ink { size: 29.0 * u, rgb: INK, halo: 0.0 };
    let title = pen.cut(&row.title, ink.size, (width - 2 * gap) as f32);
    pen.write(&mut page, [gap as f32, head as f32 * 0.5], Anchor::Left, ink, &title);

    let scenes = &row.scenes[..row.scenes.len().min(MOST_SCENES)];
    let area = [gap, head, width - legend_width - 3 * gap, height - head - foot];
    let whole = scenes.iter().filter_map(Scene::part).flat_map(|b| [b.min, b.max]);
    let bounds = Bounds::of(whole);
    let side_deg = scenes.last().map_or(0.0, |scene| best_side(scene, false));
    let (mut views, mut seen) = (Vec::new(), BTreeSet::new());
    if let (Some(bounds), Ok(count @ 1..)) = (bounds, u32::try_from(scenes.len())) {
        let (places, camera) = largest(area, count, side_deg, bounds, u);
        for (scene, place) in scenes.iter().zip(&places.each) {
            let view = View {
                size_px: (place[2], place[3]),
                camera,
                fit: Fit::Box(bounds),
                ghost_arm: false,
            };
            let shot = shoot(scene, &view, places.margins, engine)?;
            let mut image = shot.image;
            seen.extend(shot.seen);
            overlay::marks(&mut image, &pen, scene, &shot.projection, u, true);
            overlay::furniture(&mut image, &pen, &shot.projection, u);
            caption(&mut image, &pen, &scene.title, row.stamp.as_deref(), u);
            imageops::replace(&mut page, &image, i64::from(place[0]), i64::from(place[1]));
            let [x, y, w, h] = place.map(|v| v as f32);
            border(&mut page, [x, y], [w, h], 0xC3CBD3, u.max(1.0).round());
            views.push(((place[0], place[1]), shot.projection));
        }
    }
    let at = [(area[0] + area[2] + gap) as f32, head as f32 + 12.0 * u];
    if let Some(named) = scenes.last() {
        let end = legend::draw(&mut page, &pen, (named, &seen), at, area[3] as f32 * 0.5, u);
        legend::notes(&mut page, &pen, &row.notes, [at[0], end + 20.0 * u], u);
    }
    overlay::drawn_by(&mut page, &pen, engine, u);
    rect(&mut page, [0.0, 0.0], [width as f32, 4.0 * u], INK, 1.0);
    Ok(Picture { rgba: page, drawn_by: engine.drawn_by(), views })
}

/// Places and camera that show a box largest; the usual side unless another is clearly better.
fn largest(area: [u32; 4], count: u32, side_deg: f64, bounds: Bounds, u: f32) -> (Places, Camera) {
    let ways = TURNS_DEG.into_iter().flat_map(|turn| [(turn, false), (turn, true)]);
    let way = |(turn_deg, below): (f64, bool)| {
        let camera =
            Camera::Orbit { azimuth_deg: side_deg + turn_deg, elevation_deg: ELEVATION_DEG };
        let places = Places::new(area, count, below, u);
        let usual = if turn_deg == 0.0 { CLEARLY_LARGER } else { 1.0 };
        (places.longest_px(camera, bounds) * usual, places, camera)
    };
    let mut best = way((0.0, false));
    for other in ways.map(way) {
        if other.0 > best.0 {
            best = other;
        }
    }
    (best.1, best.2)
}

/// The lines of a title in the upper left corner, and the stamp in the upper right one.
fn caption(image: &mut RgbaImage, pen: &Pen, title: &str, stamp: Option<&str>, u: f32) {
    let w = image.width() as f32;
    for (k, text) in title.lines().take(3).enumerate() {
        let (size, rgb) = if k == 0 { (20.0 * u, INK) } else { (17.0 * u, FAINT) };
        let text = pen.cut(text, size, w - 28.0 * u);
        let at = [14.0 * u, (20.0 + 24.0 * k as f32) * u];
        pen.write(image, at, Anchor::Left, Ink { size, rgb, halo: 2.0 * u }, &text);
    }
    if let Some(stamp) = stamp {
        let ink = Ink { size: 24.0 * u, rgb: STAMP, halo: 3.0 * u };
        pen.write(image, [w - 16.0 * u, 24.0 * u], Anchor::Right, ink, stamp);
    }
}
