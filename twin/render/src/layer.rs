//! What is seen at every sample: the thing, its depth and its normal.

use crate::view::{Margins, Projection};
use crate::{Engine, RenderError, cpu};
use sim::pose::{Point, Vector};
use sim::scene::Scene;
use sim::scene::cast::Caster;
use sim::scene::solid::{HitId, Solids, solids};

/// One sample, laid out as the shader writes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sample {
    /// [`code`] of the thing, or [`NOTHING`] or [`FLOOR`].
    pub(crate) id: u32,
    /// Normal along the view's right and up; its part towards the eye follows from its length.
    pub(crate) normal: [f32; 2],
    /// From the plane of the projection's centre, m; infinite where nothing is.
    pub(crate) depth_m: f32,
}

/// No thing at all.
pub(crate) const NOTHING: u32 = 0;
/// The floor, which has no end.
pub(crate) const FLOOR: u32 = 1;
const BED: u32 = 2;
const BODIES: u32 = 3;
const STRANDS: u32 = 1 << 31;

/// Number of a thing in a layer.
pub(crate) fn code(id: HitId) -> u32 {
    match id {
        HitId::Bed => BED,
        HitId::Body(i) => BODIES + i as u32,
        HitId::Strand(i) => STRANDS | i as u32,
    }
}

/// Thing of a number.
pub(crate) fn thing(code: u32) -> Option<HitId> {
    match code {
        NOTHING | FLOOR => None,
        BED => Some(HitId::Bed),
        c if c & STRANDS != 0 => Some(HitId::Strand((c & !STRANDS) as usize)),
        c => Some(HitId::Body((c - BODIES) as usize)),
    }
}

impl Sample {
    pub(crate) const EMPTY: Sample =
        Sample { id: NOTHING, normal: [0.0; 2], depth_m: f32::INFINITY };

    /// Normal along right, up and depth; it looks at the eye.
    pub(crate) fn normal_in_view(&self) -> [f32; 3] {
        let [x, y] = self.normal;
        [x, y, -(1.0 - x * x - y * y).max(0.0).sqrt()]
    }
}

/// All samples of a view, row by row from the upper left.
pub(crate) struct Layer {
    pub(crate) projection: Projection,
    pub(crate) samples: Vec<Sample>,
}

impl Layer {
    /// Sample at a place; the nearest one where the place is outside.
    pub(crate) fn at(&self, x: i64, y: i64) -> &Sample {
        let (w, h) = self.projection.size_px;
        let x = x.clamp(0, i64::from(w) - 1) as usize;
        let y = y.clamp(0, i64::from(h) - 1) as usize;
        &self.samples[y * w as usize + x]
    }
}

/// Primitives of a part of the scene, ready for an engine.
pub(crate) struct Things {
    pub(crate) solids: Solids,
    caster: Option<Caster>,
}

impl Things {
    /// Those that `keep` wants; strands at least `thin_m` in radius, so that none falls between samples.
    pub(crate) fn new(
        scene: &Scene,
        engine: &Engine,
        thin_m: f64,
        keep: impl Fn(HitId) -> bool,
    ) -> Things {
        let mut solids = solids(scene, keep);
        for c in solids.capsules.iter_mut().filter(|c| matches!(c.id, HitId::Strand(_))) {
            c.radius_m = c.radius_m.max(thin_m);
        }
        let caster = match engine {
            Engine::Gpu(_) => None,
            Engine::Cpu { .. } => Some(Caster::of(solids.clone())),
        };
        Things { solids, caster }
    }

    /// Captures a view of them.
    pub(crate) fn capture(&self, engine: &Engine, view: &Projection) -> Result<Layer, RenderError> {
        let (near_m, far_m) = depth_range(&self.solids, view);
        let samples = match (engine, &self.caster) {
            (Engine::Gpu(gpu), _) => gpu.capture(&self.solids, view, near_m, far_m)?,
            (Engine::Cpu { .. }, Some(caster)) => cpu::capture(caster, view, near_m),
            (Engine::Cpu { .. }, None) => {
                cpu::capture(&Caster::of(self.solids.clone()), view, near_m)
            }
        };
        Ok(Layer { projection: *view, samples })
    }
}

/// Points whose projection bounds that of the primitives, for any axes.
pub(crate) fn outline<'a>(
    solids: &'a Solids,
    axes: &[Vector; 3],
) -> impl Iterator<Item = Point> + Clone + 'a {
    let [right, up, forward] = *axes;
    let ends = solids.capsules.iter().flat_map(move |c| {
        let r = (right + up + forward) * c.radius_m;
        [c.a - r, c.a + r, c.b - r, c.b + r]
    });
    ends.chain(solids.triangles.iter().flat_map(|t| t.points))
}

/// Depths between which all primitives lie, with a little room.
fn depth_range(solids: &Solids, view: &Projection) -> (f64, f64) {
    let axes = [view.right, view.up, view.forward];
    let depths = outline(solids, &axes).map(|p| view.in_view(p).z);
    let (low, high) =
        depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), d| (l.min(d), h.max(d)));
    if low > high {
        return (-1.0, 1.0);
    }
    let room = 0.01 * (high - low) + 1e-3;
    (low - room, high + room)
}

/// A view along `axes` that holds all `points`, for the light.
pub(crate) fn square_view(axes: [Vector; 3], points: &[Point], side_px: u32) -> Projection {
    let edge = 4.0;
    let margins = Margins { left: edge, top: edge, right: edge, bottom: edge };
    Projection::fit(axes, points.iter().copied(), (side_px, side_px), margins)
}
