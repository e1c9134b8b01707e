//! Eye-dome lighting: what lies behind something near it on the screen is darker (Boucheny 2009).

use crate::layer::Layer;
use crate::shade::FINE;

/// Neighbours are asked this far off, px of the picture.
const RINGS_PX: [f32; 2] = [1.5, 4.0];
/// A step in depth beyond this many px counts no more.
const STEP_MAX_PX: f32 = 40.0;
const STRENGTH: f32 = 0.22;

/// Part of the light that is left, 0 to 1.
///
/// ```text
/// open = exp(−k · mean ln(1 + max(0, z − zₙ) · s))     s px per metre, 8 neighbours on two rings
/// ```
///
/// A wire lattice has hardly any surface for obscurance to work on: steps in depth part its strands.
pub(super) fn open(layer: &Layer, x: i64, y: i64) -> f32 {
    let here = layer.at(x, y);
    if here.depth_m.is_infinite() {
        return 1.0;
    }
    let px_per_m = layer.projection.px_per_m as f32 / FINE as f32;
    let mut sum = 0.0;
    for ring in RINGS_PX {
        let reach = ring * FINE as f32;
        for k in 0..8 {
            let (sin, cos) = (std::f32::consts::FRAC_PI_4 * k as f32).sin_cos();
            let there =
                layer.at(x + (cos * reach).round() as i64, y + (sin * reach).round() as i64);
            let step_px = ((here.depth_m - there.depth_m) * px_per_m).clamp(0.0, STEP_MAX_PX);
            // a slope that rises evenly is no step
            sum += (step_px - 2.0 * ring).max(0.0).ln_1p();
        }
    }
    (-STRENGTH * sum / (8.0 * RINGS_PX.len() as f32)).exp()
}
