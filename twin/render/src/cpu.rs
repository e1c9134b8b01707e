//! A layer from rays.

use crate::layer::{NOTHING, Sample, code};
use crate::view::Projection;
use rayon::prelude::*;
use sim::scene::cast::Caster;

/// Every second sample of every second row is cast first; between four that lie on one smooth surface
/// the rest follow from them.
const STRIDE: u32 = 2;
/// Normals that differ by less are one surface.
const SAME_NORMAL: f32 = 0.06;
/// Depth per way across that may change between corners: over two samples a straight line then misses
/// the surface by at most `2 * 0.1 / 8` samples along each direction.
const SAME_SLOPE: f32 = 0.1;
/// What the corners may be off one plane, samples.
const FLAT_SAMPLES: f32 = 0.1;

/// A ray through the middle of every sample that its neighbours leave open.
pub(crate) fn capture(caster: &Caster, view: &Projection, near_m: f64) -> Vec<Sample> {
    let (width, height) = view.size_px;
    let ray = |x: u32, y: u32| {
        let from = view.unproject(f64::from(x) + 0.5, f64::from(y) + 0.5, near_m);
        caster.cast(from, view.forward).map_or(Sample::EMPTY, |hit| Sample {
            id: code(hit.what),
            normal: [hit.normal.dot(&view.right) as f32, hit.normal.dot(&view.up) as f32],
            depth_m: (hit.distance_m + near_m) as f32,
        })
    };
    let (columns, rows) = (width.div_ceil(STRIDE), height.div_ceil(STRIDE));
    let coarse: Vec<Sample> = (0..columns * rows)
        .into_par_iter()
        .map(|i| ray(i % columns * STRIDE, i / columns * STRIDE))
        .collect();
    let flat_m = FLAT_SAMPLES * (1.0 / view.px_per_m) as f32;
    let fine = |x: u32, y: u32| {
        let (i, j) = (x / STRIDE, y / STRIDE);
        let (s, t) = (x % STRIDE, y % STRIDE);
        let at = |i: u32, j: u32| coarse[(j * columns + i) as usize];
        if s == 0 && t == 0 {
            return at(i, j);
        }
        if i + 1 >= columns || j + 1 >= rows {
            return ray(x, y);
        }
        let part = |n: u32| n as f32 / STRIDE as f32;
        let corners = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
        between(corners, part(s), part(t), flat_m).unwrap_or_else(|| ray(x, y))
    };
    (0..width * height).into_par_iter().map(|i| fine(i % width, i / width)).collect()
}

/// The sample at a part of the way between four corners, if they lie on one smooth surface.
fn between(corners: [Sample; 4], s: f32, t: f32, flat_m: f32) -> Option<Sample> {
    let [a, b, c, d] = corners;
    if corners.iter().any(|k| k.id != a.id) {
        return None;
    }
    if a.id == NOTHING {
        return Some(Sample::EMPTY);
    }
    let apart = |k: &Sample| (k.normal[0] - a.normal[0]).hypot(k.normal[1] - a.normal[1]);
    let slope = |k: &Sample| {
        let [x, y, z] = k.normal_in_view();
        [x / z, y / z]
    };
    let [x, y] = slope(&a);
    let steady = |k: &Sample| {
        let [kx, ky] = slope(k);
        (kx - x).hypot(ky - y) < SAME_SLOPE
    };
    let bent = (a.depth_m + d.depth_m - b.depth_m - c.depth_m).abs();
    let smooth = |k: &Sample| apart(k) < SAME_NORMAL && steady(k);
    if !corners.iter().all(smooth) || bent > flat_m {
        return None;
    }
    let mean = |f: fn(&Sample) -> f32| {
        let (top, bottom) = (f(&a) * (1.0 - s) + f(&b) * s, f(&c) * (1.0 - s) + f(&d) * s);
        top * (1.0 - t) + bottom * t
    };
    let normal = [mean(|k| k.normal[0]), mean(|k| k.normal[1])];
    Some(Sample { id: a.id, normal, depth_m: mean(|k| k.depth_m) })
}
