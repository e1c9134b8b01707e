//! What is written on a picture: title, scale bar, axes, legend, marks.

pub(crate) mod legend;

use crate::canvas::{At, line, rect, ring, triangle};
use crate::paint::{FAINT, INK, severity};
use crate::shade::shoot;
use crate::text::{Anchor, Ink, Pen};
use crate::view::{Margins, Projection, View};
use crate::{Engine, Picture, RenderError};
use image::RgbaImage;
use sim::pose::Vector;
use sim::scene::Scene;

/// Labels beyond this many only clutter; their places are still ringed.
const MOST_LABELS: usize = 24;
/// Colours of x, y and z.
const AXES: [(u32, &str); 3] = [(0xC92A2A, "x"), (0x2B8A3E, "y"), (0x1C5FC4, "z")];

/// Size of letters and lines against those of a picture 800 px high.
pub(crate) fn unit(size_px: (u32, u32)) -> f32 {
    (size_px.0.min(size_px.1 * 8 / 5) as f32 / 1280.0).clamp(0.55, 3.0)
}

/// One view with everything written on it.
pub(crate) fn picture(scene: &Scene, view: &View, engine: &Engine) -> Result<Picture, RenderError> {
    let pen = Pen::new()?;
    let u = unit(view.size_px);
    let side = f64::from(28.0 * u);
    let legend = f64::from(legend::WIDTH * u);
    let margins = Margins {
        left: side,
        top: f64::from(68.0 * u),
        right: legend + side,
        bottom: f64::from(64.0 * u),
    };
    let shot = shoot(scene, view, margins, engine)?;
    let (mut image, projection) = (shot.image, shot.projection);
    let (width, height) = (view.size_px.0 as f32, view.size_px.1 as f32);
    marks(&mut image, &pen, scene, &projection, u, true);
    let title = pen.cut(&scene.title, 27.0 * u, width - 56.0 * u);
    let wide = pen.width(&title, 27.0 * u);
    rect(&mut image, [18.0 * u, 16.0 * u], [wide + 16.0 * u, 36.0 * u], 0xFFFFFF, 0.6);
    pen.write(
        &mut image,
        [26.0 * u, 34.0 * u],
        Anchor::Left,
        Ink { size: 27.0 * u, rgb: INK, halo: 2.0 * u },
        &title,
    );
    let faint = Ink { size: 18.0 * u, rgb: FAINT, halo: 2.0 * u };
    pen.write(&mut image, [26.0 * u, 60.0 * u], Anchor::Left, faint, &view.camera.name());
    furniture(&mut image, &pen, &projection, u);
    let at = [width - legend as f32, 84.0 * u];
    legend::draw(&mut image, &pen, (scene, &shot.seen), at, height - 190.0 * u, u);
    drawn_by(&mut image, &pen, engine, u);
    Ok(Picture { rgba: image, drawn_by: engine.drawn_by(), views: vec![((0, 0), projection)] })
}

/// Says in the lower right corner who drew.
pub(crate) fn drawn_by(image: &mut RgbaImage, pen: &Pen, engine: &Engine, u: f32) {
    let (w, h) = (image.width() as f32, image.height() as f32);
    let text = match engine {
        Engine::Gpu(gpu) => gpu.drawn_by().to_string(),
        // the reason belongs in the report
        Engine::Cpu { .. } => crate::DrawnBy::Cpu { because: None }.to_string(),
    };
    let size = 14.0 * u;
    let text = format!("drawn by {}", pen.cut(&text, size, 0.4 * w));
    pen.write(
        image,
        [w - 20.0 * u, h - 18.0 * u],
        Anchor::Right,
        Ink { size, rgb: FAINT, halo: 2.0 * u },
        &text,
    );
}

/// Axes and scale bar in the lower left corner.
pub(crate) fn furniture(image: &mut RgbaImage, pen: &Pen, view: &Projection, u: f32) {
    let h = image.height() as f32;
    triad(image, pen, view, [58.0 * u, h - 62.0 * u], u);
    scale_bar(image, pen, view, [124.0 * u, h - 30.0 * u], u);
}

/// A bar of a round length in millimetres.
fn scale_bar(image: &mut RgbaImage, pen: &Pen, view: &Projection, at: At, u: f32) {
    let longest_m = 190.0 * f64::from(u) / view.px_per_m;
    let length_m = round_below(longest_m);
    let px = (length_m * view.px_per_m) as f32;
    let [x, y] = at;
    let thick = 5.0 * u;
    rect(
        image,
        [x - 1.5 * u, y - thick - 1.5 * u],
        [px + 3.0 * u, thick + 3.0 * u],
        0xFFFFFF,
        0.85,
    );
    rect(image, [x, y - thick], [px, thick], INK, 1.0);
    rect(image, [x + px / 2.0, y - thick + u], [px / 2.0 - u, thick - 2.0 * u], 0xFFFFFF, 1.0);
    let mm = length_m * 1e3;
    let digits = if mm < 1.0 { (-mm.log10()).ceil() as usize } else { 0 };
    let ink = Ink { size: 18.0 * u, rgb: INK, halo: 2.0 * u };
    pen.write(
        image,
        [x + px / 2.0, y - 19.0 * u],
        Anchor::Centre,
        ink,
        &format!("{mm:.digits$} mm"),
    );
}

/// The largest of 1, 2 and 5 times a power of ten that is not above.
pub(crate) fn round_below(most: f64) -> f64 {
    if !(most > 0.0 && most.is_finite()) {
        return 1.0;
    }
    let decade = 10f64.powf(most.log10().floor());
    [5.0, 2.0, 1.0]
        .into_iter()
        .map(|k| k * decade)
        .find(|v| *v <= most * (1.0 + 1e-9))
        .unwrap_or(decade)
}

/// The world's axes as the view sees them; those that point away come first.
fn triad(image: &mut RgbaImage, pen: &Pen, view: &Projection, at: At, u: f32) {
    let length = 34.0 * u;
    let mut order: Vec<(Vector, (u32, &str))> =
        [Vector::x(), Vector::y(), Vector::z()].into_iter().zip(AXES).collect();
    order.sort_by(|a, b| b.0.dot(&view.forward).total_cmp(&a.0.dot(&view.forward)));
    let mut letters: Vec<At> = Vec::new();
    for (axis, (rgb, name)) in order {
        let d = [axis.dot(&view.right) as f32, -axis.dot(&view.up) as f32];
        let seen = d[0].hypot(d[1]);
        let ink = Ink { size: 17.0 * u, rgb, halo: 2.0 * u };
        if seen < 0.12 {
            ring(image, at, 4.0 * u, 4.0 * u, rgb);
            pen.write(image, [at[0] - 10.0 * u, at[1] + 10.0 * u], Anchor::Centre, ink, name);
            continue;
        }
        let along = |k: f32, across: f32| {
            [at[0] + d[0] * k - d[1] / seen * across, at[1] + d[1] * k + d[0] / seen * across]
        };
        line(image, at, along(length, 0.0), 4.6 * u, 0xFFFFFF, 0.7);
        line(image, at, along(length, 0.0), 2.4 * u, rgb, 1.0);
        let head = length + 7.0 * u / seen;
        triangle(
            image,
            [along(head, 0.0), along(length - u, 4.2 * u), along(length - u, -4.2 * u)],
            rgb,
        );
        let mut letter = along(head + 10.0 * u / seen, 0.0);
        // two axes that point the same way on the screen
        let near = |a: &At| (a[0] - letter[0]).hypot(a[1] - letter[1]) < 13.0 * u;
        if letters.iter().any(near) {
            letter[1] += 15.0 * u;
        }
        letters.push(letter);
        pen.write(image, letter, Anchor::Centre, ink, name);
    }
}

/// Rings at the marks, and labels beside them that do not lie on each other.
pub(crate) fn marks(
    image: &mut RgbaImage,
    pen: &Pen,
    scene: &Scene,
    view: &Projection,
    u: f32,
    labelled: bool,
) {
    let (w, h) = (image.width() as f32, image.height() as f32);
    let mut order: Vec<_> = scene.marks.iter().collect();
    order.sort_by_key(|m| std::cmp::Reverse(m.severity));
    let mut taken: Vec<[f32; 4]> = Vec::new();
    let mut written: Vec<(At, At, u32, String)> = Vec::new();
    let size = 18.0 * u;
    for mark in order {
        let [x, y, _] = view.project(mark.at);
        let at = [x as f32, y as f32];
        if !(at[0] >= 0.0 && at[1] >= 0.0 && at[0] < w && at[1] < h) {
            continue;
        }
        let rgb = severity(mark.severity);
        ring(image, at, 9.5 * u, 5.0 * u, 0xFFFFFF);
        ring(image, at, 8.5 * u, 3.0 * u, rgb);
        if labelled && written.len() < MOST_LABELS && !mark.label.is_empty() {
            let text = pen.cut(&mark.label, size, 0.45 * w);
            let place = free_place(at, [pen.width(&text, size), size], (w, h), u, &taken);
            taken.push([place[0], place[1] - size / 2.0, pen.width(&text, size) + 8.0 * u, size]);
            written.push((at, place, rgb, text));
        }
    }
    for (at, place, rgb, text) in written {
        let d = [place[0] - at[0] - 5.0 * u, place[1] - at[1]];
        let far = d[0].hypot(d[1]).max(1.0);
        let from = [at[0] + d[0] / far * 9.0 * u, at[1] + d[1] / far * 9.0 * u];
        if far > 26.0 * u {
            line(image, from, [place[0] - 4.0 * u, place[1]], 3.4 * u, 0xFFFFFF, 0.7);
            line(image, from, [place[0] - 4.0 * u, place[1]], 1.4 * u, rgb, 1.0);
        }
        let wide = pen.width(&text, size) + 8.0 * u;
        let (low, box_size) = ([place[0] - 4.0 * u, place[1] - size * 0.56], [wide, size * 1.14]);
        rect(image, low, box_size, 0xFFFFFF, 0.84);
        rect(image, low, [2.4 * u, box_size[1]], rgb, 1.0);
        pen.write(
            image,
            [place[0] + 2.0 * u, place[1]],
            Anchor::Left,
            Ink { size, rgb, halo: 0.0 },
            &text,
        );
    }
}

/// A place right of a mark, or further down or up, where no label lies yet.
fn free_place(at: At, size: [f32; 2], room: (f32, f32), u: f32, taken: &[[f32; 4]]) -> At {
    let x = (at[0] + 17.0 * u).min(room.0 - size[0] - 4.0 * u).max(2.0 * u);
    let step = size[1] * 1.2;
    let mut tries = (0..80).map(|k| {
        let k = (k + 1) / 2 * if k % 2 == 0 { 1 } else { -1 };
        [x, at[1] + step * k as f32]
    });
    let free = |p: &At| {
        let [px, py] = [p[0], p[1] - size[1] / 2.0];
        let inside = py > 0.0 && py + size[1] < room.1;
        inside
            && taken.iter().all(|[x, y, w, h]| {
                px + size[0] < *x || px > x + w || py + size[1] * 1.15 < *y || py > y + h * 1.15
            })
    };
    tries.find(free).unwrap_or([x, at[1]])
}
