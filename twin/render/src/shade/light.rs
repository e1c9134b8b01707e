//! One key light with a shadow, a sky above and a lamp at the eye.

use crate::layer::{Layer, Things, square_view};
use crate::paint::{Rgb, scaled};
use crate::view::Projection;
use crate::{Engine, RenderError};
use sim::pose::{Point, Vector};
use sim::scene::Bounds;

/// Edge of the shadow's layer for the two engines, px, of a picture this wide or wider: rays are dearer.
const SHADOW_PX: (u32, u32) = (2048, 1024);
const FULL_WIDTH_PX: u32 = 1280;
/// Rings of neighbours that are asked whether they stand in the way of the sky, px of the picture.
const RINGS_PX: [f32; 3] = [3.0, 8.0, 18.0];

/// The key light and what it reaches.
pub(super) struct Light {
    towards: Vector,
    shadow: Layer,
}

impl Light {
    /// From the upper left of the eye; the shadow covers `lit`.
    pub(super) fn new(
        view: &Projection,
        lit: &Bounds,
        things: &Things,
        engine: &Engine,
    ) -> Result<Light, RenderError> {
        let level = Vector::new(view.forward.x, view.forward.y, 0.0);
        let towards = (Vector::z() - view.right * 0.55 - level * 0.45).normalize();
        let forward = -towards;
        let right = forward.cross(&view.up).normalize();
        let axes = [right, right.cross(&forward), forward];
        let side = match engine {
            Engine::Gpu(_) => SHADOW_PX.0,
            Engine::Cpu { .. } => SHADOW_PX.1,
        };
        // a small picture does not show a fine shadow
        let side = side * view.size_px.0.clamp(FULL_WIDTH_PX / 4, FULL_WIDTH_PX) / FULL_WIDTH_PX;
        let shadow = things.capture(engine, &square_view(axes, &lit.corners(), side))?;
        Ok(Light { towards, shadow })
    }

    /// Part of the key light that arrives at a point, 0 to 1: mean over 3x3 samples of the shadow.
    pub(super) fn reach(&self, at: Point, normal: &Vector) -> f32 {
        let view = &self.shadow.projection;
        let texel_m = 1.0 / view.px_per_m;
        // off the surface by more than a texel's slope, or it would shade itself
        let [x, y, depth] = view.project(at + normal * (2.0 * texel_m));
        let (w, h) = (f64::from(view.size_px.0), f64::from(view.size_px.1));
        if !(x >= 0.0 && y >= 0.0 && x < w && y < h) {
            return 1.0;
        }
        let nearest = (depth - 1.5 * texel_m) as f32;
        let mut open = 0.0;
        for (dx, dy) in (-1..=1).flat_map(|j| (-1..=1).map(move |i| (i, j))) {
            let there = self.shadow.at(x as i64 + dx, y as i64 + dy);
            open += f32::from(u8::from(there.depth_m > nearest));
        }
        open / 9.0
    }

    /// A matt surface with a little shine under all lights.
    pub(super) fn on(
        &self,
        base: Rgb,
        at: Point,
        normal: &Vector,
        forward: &Vector,
        open: f32,
        shine: f32,
    ) -> Rgb {
        let key = normal.dot(&self.towards).max(0.0) as f32;
        let key = if key > 0.0 { key * self.reach(at, normal) } else { 0.0 };
        let sky = 0.36 + 0.14 * normal.z as f32;
        let lamp = 0.14 * (-normal.dot(forward)).max(0.0) as f32;
        let half = (self.towards - forward).normalize();
        let gloss = shine * key * (normal.dot(&half).max(0.0) as f32).powi(24);
        let lit = scaled(base, 0.60 * key + (sky + lamp) * (0.25 + 0.75 * open));
        lit.map(|c| c + gloss)
    }
}

/// How much neighbours on the screen stand above the tangent plane of a sample, 0 to 1.
///
/// Screen-space obscurance: eight directions on three rings, each height taken against its distance
/// and faded where the neighbour is far in front, since that is another thing.
pub(super) fn occlusion(layer: &Layer, x: i64, y: i64) -> f32 {
    let here = layer.at(x, y);
    if here.depth_m.is_infinite() {
        return 0.0;
    }
    let m_per_px = (1.0 / layer.projection.px_per_m) as f32;
    let [nx, ny, nz] = here.normal_in_view();
    let facing = -nz.min(-0.05);
    let mut blocked = 0.0;
    for ring in RINGS_PX {
        let reach = ring * super::FINE as f32;
        for k in 0..8 {
            let (sin, cos) = (std::f32::consts::FRAC_PI_4 * (k as f32 + ring)).sin_cos();
            let (dx, dy) = ((cos * reach).round(), (sin * reach).round());
            let there = layer.at(x + dx as i64, y + dy as i64);
            if there.depth_m.is_infinite() {
                continue;
            }
            // depth of the tangent plane there; y runs down on the screen and up in the view
            let plane = here.depth_m + (nx * dx - ny * dy) * m_per_px / facing;
            let height = (plane - there.depth_m) * facing / (reach * m_per_px);
            let fade = 1.0 / (1.0 + (height / 2.5).powi(2));
            blocked += (height - 0.08).clamp(0.0, 1.0) * fade;
        }
    }
    (1.1 * blocked / (8.0 * RINGS_PX.len() as f32)).min(0.85)
}
