//! From layers to pixels: light, shadow, creases, outlines, grid lines and ground.

mod edl;
mod light;

use crate::layer::{FLOOR, Layer, NOTHING, Sample, Things, outline, thing};
use crate::paint::{HIGHLIGHT, PLANNED, Palette, Rgb, bytes, hex, mix, scaled, toned};
use crate::view::{Camera, Fit, Margins, Projection, View};
use crate::{Engine, RenderError};
use image::{Rgba, RgbaImage};
use light::{Light, occlusion};
use rayon::prelude::*;
use sim::pose::{Point, Vector};
use sim::scene::solid::{HitId, solids};
use sim::scene::{BedShape, BodyKind, Bounds, Scene};
use std::collections::{BTreeMap, BTreeSet};

/// Samples along each edge of a pixel.
pub(crate) const FINE: u32 = 2;
/// Strands are drawn at least this wide, px, so that a far lattice does not break up.
const THINNEST_PX: f64 = 1.2;
/// How much of what is behind shows through an obstacle and a ghost of the arm.
const OBSTACLE_GLASS: f32 = 0.72;
const GHOST_GLASS: f32 = 0.84;
/// How much a strand that is still to come covers what is behind it.
const PLANNED_COVER: f32 = 0.42;
/// Lines of strands to come are at least this wide, px.
const PLANNED_PX: f64 = 1.1;

const SKY: (u32, u32) = (0xFAFBFC, 0xE6EAEF);

/// A drawn view without letters.
pub(crate) struct Shot {
    pub(crate) image: RgbaImage,
    pub(crate) projection: Projection,
    pub(crate) seen: BTreeSet<Seen>,
}

/// What a legend tells of a view.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Seen {
    /// A body of a kind, or the bed.
    Kind(BodyKind),
    /// The way of strands that are still to come.
    ToCome,
    /// Something outlined.
    Concerned,
}

/// Samples of a thing from which on it is worth a line of the legend, as a share of all.
const SEEN_SHARE: f64 = 2e-4;

/// Draws a view, leaving `margins` free of what it is fitted to.
pub(crate) fn shoot(
    scene: &Scene,
    view: &View,
    margins: Margins,
    engine: &Engine,
) -> Result<Shot, RenderError> {
    let axes = view.camera.axes();
    let all = solids(scene, |_| true);
    let everything = Bounds::of(outline(&all, &[Vector::x(), Vector::y(), Vector::z()]));
    let everything = everything.unwrap_or(Bounds { min: Point::origin(), max: Point::origin() });
    let near = match view.fit {
        Fit::Cell => None,
        Fit::Part => scene.part().map(|b| widened(b, 0.06)),
        Fit::Box(b) => Some(b),
    };
    let projection = match near {
        None => Projection::fit(axes, outline(&all, &axes), view.size_px, margins),
        Some(b) => Projection::fit(axes, b.corners().into_iter(), view.size_px, margins),
    };
    let thin_m = 0.5 * THINNEST_PX / projection.px_per_m;
    let glass = |id: HitId| glass_of(scene, view, id).is_some();
    // from above the arm covers the part, be it of glass
    let above = |id: HitId| {
        let HitId::Body(i) = id else { return false };
        view.ghost_arm && view.camera == Camera::Top && is_ghost(scene, i)
    };
    let solid = Things::new(scene, engine, thin_m, |id| !glass(id));
    let clear = Things::new(scene, engine, thin_m, |id| glass(id) && !above(id));
    let fine = projection.finer(FINE);
    let mut front = solid.capture(engine, &fine)?;
    let pane = match clear.solids.capsules.is_empty() && clear.solids.triangles.is_empty() {
        true => None,
        false => Some(clear.capture(engine, &fine)?),
    };
    let lines = Scene { strands: scene.planned.clone(), ..Scene::default() };
    let planned = match lines.strands.is_empty() {
        true => None,
        false => {
            let thin_m = 0.5 * PLANNED_PX / projection.px_per_m;
            Some(Things::new(&lines, engine, thin_m, |_| true).capture(engine, &fine)?)
        }
    };
    let lit = near.map_or(everything, |b| widened(b, 0.5));
    let light = Light::new(&projection, &lit, &solid, engine)?;
    let floor = Floor::new(&everything, &projection);
    if let Some(floor) = &floor {
        floor.lay(&mut front);
    }
    let palette = Palette::new(scene);
    let shader = Shader { scene, view, fine, palette, light, floor };
    let layers = Layers { front: &front, pane: pane.as_ref(), planned: planned.as_ref() };
    Ok(Shot { image: shader.image(&layers), projection, seen: layers.seen(scene) })
}

fn widened(b: Bounds, part: f64) -> Bounds {
    let by = Vector::repeat(b.size().max() * part + 1e-3);
    Bounds { min: b.min - by, max: b.max + by }
}

/// How clear a thing is drawn, if it is.
fn glass_of(scene: &Scene, view: &View, id: HitId) -> Option<f32> {
    let HitId::Body(i) = id else { return None };
    let body = scene.bodies.get(i)?;
    match body.kind {
        _ if body.highlighted => None,
        BodyKind::Obstacle => Some(OBSTACLE_GLASS),
        _ if view.ghost_arm && is_ghost(scene, i) => Some(GHOST_GLASS),
        _ => None,
    }
}

/// Whether a body may be drawn as of glass so that it does not hide the part.
pub(crate) fn is_ghost(scene: &Scene, body: usize) -> bool {
    scene.bodies.get(body).is_some_and(|body| {
        !body.highlighted
            && matches!(body.kind, BodyKind::Arm | BodyKind::OtherArm | BodyKind::Tool)
    })
}

/// Whether a pixel and the samples about it show one smooth surface, so that one sample stands for all.
fn whole(layer: &Layer, x: i64, y: i64) -> bool {
    let n = i64::from(FINE);
    let here = layer.at(x, y);
    (-1..=n).flat_map(|j| (-1..=n).map(move |i| (x + i, y + j))).all(|(i, j)| {
        let there = layer.at(i, j);
        let bend = (there.normal[0] - here.normal[0]).hypot(there.normal[1] - here.normal[1]);
        there.id == here.id && bend < 0.1
    })
}

/// The ground: a plane below everything that fades out around the cell.
struct Floor {
    z_m: f64,
    middle: Point,
    radius_m: f64,
}

impl Floor {
    /// None where the eye does not look down on it.
    fn new(all: &Bounds, view: &Projection) -> Option<Floor> {
        let radius_m = all.size().xy().norm().max(0.2);
        (view.forward.z < -0.05).then(|| Floor { z_m: all.min.z, middle: all.centre(), radius_m })
    }

    /// Puts the floor where the layer is empty.
    fn lay(&self, layer: &mut Layer) {
        let view = layer.projection;
        let width = view.size_px.0 as usize;
        let normal = [view.right.z as f32, view.up.z as f32];
        layer.samples.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            for (x, sample) in row.iter_mut().enumerate().filter(|(_, s)| s.id == NOTHING) {
                let at = view.unproject(x as f64 + 0.5, y as f64 + 0.5, 0.0);
                let depth_m = ((self.z_m - at.z) / view.forward.z) as f32;
                *sample = Sample { id: FLOOR, normal, depth_m };
            }
        });
    }
}

/// What is seen of a view, each by itself.
struct Layers<'a> {
    /// Solid things and the floor.
    front: &'a Layer,
    /// Things of glass.
    pane: Option<&'a Layer>,
    /// Strands still to come.
    planned: Option<&'a Layer>,
}

impl Layers<'_> {
    /// What is seen of a scene. O(samples).
    fn seen(&self, scene: &Scene) -> BTreeSet<Seen> {
        let (mut bed, mut bodies, mut concerned) = (0, vec![0; scene.bodies.len()], 0);
        let any_strand = scene.strands.iter().any(|strand| strand.highlighted);
        for layer in [Some(self.front), self.pane].into_iter().flatten() {
            for sample in &layer.samples {
                match thing(sample.id) {
                    Some(HitId::Bed) => bed += 1,
                    Some(HitId::Body(i)) => bodies[i] += 1,
                    Some(HitId::Strand(i)) if any_strand && scene.strands[i].highlighted => {
                        concerned += 1;
                    }
                    Some(HitId::Strand(_)) | None => {}
                }
            }
        }
        let mut kinds: BTreeMap<BodyKind, usize> = BTreeMap::from([(BodyKind::Bed, bed)]);
        for (body, many) in scene.bodies.iter().zip(bodies) {
            *kinds.entry(body.kind).or_default() += many;
            concerned += if body.highlighted { many } else { 0 };
        }
        let least = SEEN_SHARE * self.front.samples.len() as f64;
        let enough = |many: usize| many as f64 >= least;
        let mut seen: BTreeSet<Seen> = kinds
            .into_iter()
            .filter(|(_, many)| enough(*many))
            .map(|it| Seen::Kind(it.0))
            .collect();
        seen.extend(enough(concerned).then_some(Seen::Concerned));
        let to_come = |layer: &Layer| layer.samples.iter().any(|it| thing(it.id).is_some());
        seen.extend(self.planned.filter(|layer| to_come(layer)).map(|_| Seen::ToCome));
        seen
    }
}

struct Shader<'a> {
    scene: &'a Scene,
    view: &'a View,
    fine: Projection,
    palette: Palette,
    light: Light,
    floor: Option<Floor>,
}

impl Shader<'_> {
    fn image(&self, layers: &Layers<'_>) -> RgbaImage {
        let (width, height) = self.view.size_px;
        let mut image = RgbaImage::new(width, height);
        let row_bytes = 4 * width as usize;
        image.par_chunks_mut(row_bytes).enumerate().for_each(|(y, row)| {
            for (x, pixel) in row.chunks_exact_mut(4).enumerate() {
                let [r, g, b] = bytes(self.pixel(x as i64, y as i64, layers));
                pixel.copy_from_slice(&Rgba([r, g, b, 255]).0);
            }
        });
        image
    }

    /// Mean of the samples of a pixel.
    fn pixel(&self, x: i64, y: i64, layers: &Layers<'_>) -> Rgb {
        let n = i64::from(FINE);
        let front = layers.front;
        let (x, y) = (x * n, y * n);
        let open = (1.0 - occlusion(front, x, y)) * edl::open(front, x, y);
        let even = |layer: Option<&Layer>| layer.is_none_or(|layer| whole(layer, x, y));
        if even(layers.pane) && even(layers.planned) && whole(front, x, y) {
            return self.seen(x, y, layers, open);
        }
        let mut sum = [0.0; 3];
        for (x, y) in (0..n).flat_map(|j| (0..n).map(move |i| (x + i, y + j))) {
            let rgb = self.seen(x, y, layers, open);
            sum = std::array::from_fn(|i| sum[i] + rgb[i]);
        }
        scaled(sum, 1.0 / (FINE * FINE) as f32)
    }

    /// One sample of all layers.
    fn seen(&self, x: i64, y: i64, layers: &Layers<'_>, open: f32) -> Rgb {
        let front = layers.front.at(x, y);
        let mut rgb = self.sample(x, y, layers.front, open);
        if let Some(planned) = layers.planned.map(|planned| planned.at(x, y))
            && planned.id != NOTHING
            && planned.depth_m < front.depth_m
        {
            rgb = mix(rgb, hex(PLANNED), PLANNED_COVER);
        }
        match layers.pane {
            None => rgb,
            Some(pane) => self.through(x, y, pane, front, rgb),
        }
    }

    fn sample(&self, x: i64, y: i64, layer: &Layer, open: f32) -> Rgb {
        let sample = layer.at(x, y);
        let sky = self.sky(y);
        if sample.id == NOTHING {
            return sky;
        }
        let depth = f64::from(sample.depth_m);
        let at = self.fine.unproject(x as f64 + 0.5, y as f64 + 0.5, depth);
        let normal = self.normal(sample);
        if sample.id == FLOOR {
            return self.ground(at, sky, open);
        }
        let mut base = self.palette.of(sample.id);
        if let (Some(HitId::Bed), Some(bed)) = (thing(sample.id), &self.scene.bed) {
            base = self.plate(base, bed, at, &normal);
        }
        let shine = if matches!(thing(sample.id), Some(HitId::Bed)) { 0.0 } else { 0.10 };
        let lit = toned(self.light.on(base, at, &normal, &self.fine.forward, open, shine));
        self.outlined(lit, x, y, layer)
    }

    /// World normal of a sample.
    fn normal(&self, sample: &Sample) -> Vector {
        let [r, u, f] = sample.normal_in_view().map(f64::from);
        self.fine.right * r + self.fine.up * u + self.fine.forward * f
    }

    fn sky(&self, y: i64) -> Rgb {
        let t = y as f32 / self.fine.size_px.1 as f32;
        mix(hex(SKY.0), hex(SKY.1), t)
    }

    /// The floor: sky with shadow and lines, both fading with distance.
    fn ground(&self, at: Point, sky: Rgb, open: f32) -> Rgb {
        let Some(floor) = &self.floor else { return sky };
        let away = ((at - floor.middle).xy().norm() / floor.radius_m - 0.35) / 0.75;
        let near = 1.0 - away.clamp(0.0, 1.0) as f32;
        let near = near * near * (3.0 - 2.0 * near);
        let dark = 1.0 - 0.34 * (1.0 - self.light.reach(at, &Vector::z()) * (0.35 + 0.65 * open));
        let line = self.lines(at, &Vector::z(), [Vector::x(), Vector::y()], &Point::origin(), 0.1);
        let rgb = mix(scaled(sky, 0.97), hex(0x9AA7B4), 0.5 * line);
        mix(sky, scaled(rgb, dark), near)
    }

    /// The printed plate with its lines.
    fn plate(&self, base: Rgb, bed: &BedShape, at: Point, normal: &Vector) -> Rgb {
        let [u, v, up] = [Vector::x(), Vector::y(), Vector::z()].map(|a| bed.pose * a);
        if normal.dot(&up) < 0.99 {
            return base;
        }
        let origin = Point::from(bed.pose.translation.vector);
        mix(base, hex(0x5F6E7D), 0.55 * self.lines(at, &up, [u, v], &origin, 0.01))
    }

    /// How much a grid line covers a point of a plane: lines every 10, 100 or 1000 mm, as the scale
    /// allows and not finer than `finest_m`, each tenth one stronger; one pixel wide on the screen.
    fn lines(
        &self,
        at: Point,
        normal: &Vector,
        axes: [Vector; 2],
        origin: &Point,
        finest_m: f64,
    ) -> f32 {
        let px_per_m = self.fine.px_per_m / f64::from(FINE);
        let into = normal.dot(&self.fine.forward);
        let minor = [0.01, 0.1, 1.0].into_iter().find(|s| *s >= finest_m && s * px_per_m >= 11.0);
        let Some(minor_m) = minor.filter(|_| into.abs() > 0.05) else { return 0.0 };
        let mut cover: f64 = 0.0;
        for axis in axes {
            // metres along the axis for a metre to the right, and up, on the screen
            let slide =
                |side: &Vector| (side - self.fine.forward * (normal.dot(side) / into)).dot(&axis);
            let slope = slide(&self.fine.right).hypot(slide(&self.fine.up)).max(1e-9);
            let along = (at - origin).dot(&axis);
            for (every_m, strength) in [(minor_m, 0.42), (10.0 * minor_m, 1.0)] {
                let off = (along / every_m - (along / every_m).round()).abs() * every_m;
                let off_px = off / slope * px_per_m;
                cover = cover.max(strength * (1.1 - off_px).clamp(0.0, 1.0));
            }
        }
        cover as f32
    }

    /// Darkens the rim of a thing against what lies behind it.
    fn outlined(&self, rgb: Rgb, x: i64, y: i64, layer: &Layer) -> Rgb {
        let here = layer.at(x, y);
        let highlighted = match thing(here.id) {
            Some(HitId::Strand(i)) => self.scene.strands.get(i).is_some_and(|s| s.highlighted),
            Some(HitId::Body(i)) => self.scene.bodies.get(i).is_some_and(|b| b.highlighted),
            _ => false,
        };
        // samples: a wide rim calls for attention, a thin one only parts things
        let step = if highlighted { 3 } else { 1 };
        let rim = [(-step, 0), (step, 0), (0, -step), (0, step)].into_iter().any(|(dx, dy)| {
            let there = layer.at(x + dx, y + dy);
            there.id != here.id && there.depth_m > here.depth_m + self.seam_m(here.id, there.id)
        });
        match (rim, highlighted) {
            (false, _) => rgb,
            (true, true) => hex(HIGHLIGHT),
            (true, false) => scaled(rgb, 0.38),
        }
    }

    /// Two pieces of one strand that follow each other in other colours have no rim between them, but where one passes
    /// behind the other by more than its radius.
    fn seam_m(&self, a: u32, b: u32) -> f32 {
        let (Some(HitId::Strand(a)), Some(HitId::Strand(b))) = (thing(a), thing(b)) else {
            return 0.0;
        };
        let pieces = [a.min(b), a.max(b)].map(|i| self.scene.strands.get(i));
        match pieces {
            [Some(first), Some(second)]
                if a.abs_diff(b) == 1 && first.points.last() == second.points.first() =>
            {
                first.radius_m as f32
            }
            _ => 0.0,
        }
    }

    /// A clear thing over what is behind it.
    fn through(&self, x: i64, y: i64, pane: &Layer, behind: &Sample, rgb: Rgb) -> Rgb {
        let sample = pane.at(x, y);
        let Some(id) = thing(sample.id).filter(|_| sample.depth_m < behind.depth_m) else {
            return rgb;
        };
        let Some(clear) = glass_of(self.scene, self.view, id) else { return rgb };
        let normal = self.normal(sample);
        let facing = normal.dot(&self.fine.forward).abs() as f32;
        let lit = scaled(self.palette.of(sample.id), 0.55 + 0.45 * normal.z.max(0.0) as f32);
        // glass is denser where one looks along it
        let clear = clear * (0.55 + 0.45 * facing.min(1.0));
        self.outlined(mix(lit, rgb, clear), x, y, pane)
    }
}
