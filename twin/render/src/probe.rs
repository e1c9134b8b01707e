//! What a view shows as numbers instead of colours: for tests against other ray casters, and for maps of pixels to things.

use crate::layer::{Things, outline, thing};
use crate::process::open;
use crate::view::{Camera, Margins, Projection};
use crate::{Backend, DrawnBy, RenderError};
use sim::scene::Scene;
use sim::scene::solid::HitId;

/// The thing and the depth of every pixel.
#[derive(Debug, Clone)]
pub struct Probe {
    /// Which point of the world falls on which pixel.
    pub projection: Projection,
    /// What is seen, row by row from the upper left.
    pub things: Vec<Option<HitId>>,
    /// From the plane of the projection's centre, m; infinite where nothing is.
    pub depth_m: Vec<f32>,
    /// Who looked.
    pub drawn_by: DrawnBy,
}

/// Looks at a whole scene from a side, one sample a pixel, nothing of glass, strands as thick as they are.
///
/// # Errors
/// As for a picture.
pub fn probe(
    scene: &Scene,
    camera: Camera,
    size_px: (u32, u32),
    backend: Backend,
) -> Result<Probe, RenderError> {
    crate::check_size(size_px)?;
    let engine = open(backend)?;
    let things = Things::new(scene, &engine, 0.0, |_| true);
    let axes = camera.axes();
    let points = outline(&things.solids, &axes);
    let projection = Projection::fit(axes, points, size_px, Margins::default());
    let layer = things.capture(&engine, &projection)?;
    Ok(Probe {
        projection,
        things: layer.samples.iter().map(|sample| thing(sample.id)).collect(),
        depth_m: layer.samples.iter().map(|sample| sample.depth_m).collect(),
        drawn_by: engine.drawn_by(),
    })
}
