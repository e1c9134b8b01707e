//! Lines, boxes and discs on a finished picture, smoothed at their edges.

use image::RgbaImage;

/// A place on the picture from its upper left corner, px.
pub(crate) type At = [f32; 2];

/// Lays a colour over a pixel; nothing happens outside.
///
/// In sRGB and not in linear light: dark letters on white would come out thin.
pub(crate) fn blend(image: &mut RgbaImage, x: i64, y: i64, rgb: [u8; 3], cover: f32) {
    let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else { return };
    if let Some(pixel) = image.get_pixel_mut_checked(x, y).filter(|_| cover > 0.0) {
        let cover = cover.min(1.0);
        for (below, over) in pixel.0.iter_mut().zip(rgb) {
            let (b, o) = (f32::from(*below), f32::from(over));
            *below = (b + (o - b) * cover).round() as u8;
        }
    }
}

/// The bytes of a hex number.
pub(crate) fn split(rgb: u32) -> [u8; 3] {
    let [_, r, g, b] = rgb.to_be_bytes();
    [r, g, b]
}

/// Covers every pixel by how far it lies inside a shape, given the distance to its edge, px.
fn fill(
    image: &mut RgbaImage,
    low: At,
    high: At,
    rgb: u32,
    alpha: f32,
    inside: impl Fn(At) -> f32,
) {
    let rgb = split(rgb);
    let (w, h) = (i64::from(image.width()), i64::from(image.height()));
    let from = |v: f32| (v.floor() as i64 - 1).max(0);
    let to = |v: f32, end: i64| (v.ceil() as i64 + 1).min(end);
    for y in from(low[1])..to(high[1], h) {
        for x in from(low[0])..to(high[0], w) {
            let depth = inside([x as f32 + 0.5, y as f32 + 0.5]);
            blend(image, x, y, rgb, alpha * (depth + 0.5).clamp(0.0, 1.0));
        }
    }
}

/// A filled box.
pub(crate) fn rect(image: &mut RgbaImage, low: At, size: At, rgb: u32, alpha: f32) {
    let high = [low[0] + size[0], low[1] + size[1]];
    fill(image, low, high, rgb, alpha, |[x, y]| {
        (x - low[0]).min(high[0] - x).min(y - low[1]).min(high[1] - y)
    });
}

/// The rim of a box.
pub(crate) fn border(image: &mut RgbaImage, low: At, size: At, rgb: u32, width: f32) {
    let [x, y] = low;
    let [w, h] = size;
    rect(image, low, [w, width], rgb, 1.0);
    rect(image, [x, y + h - width], [w, width], rgb, 1.0);
    rect(image, low, [width, h], rgb, 1.0);
    rect(image, [x + w - width, y], [width, h], rgb, 1.0);
}

/// A line with round ends.
pub(crate) fn line(image: &mut RgbaImage, a: At, b: At, width: f32, rgb: u32, alpha: f32) {
    let r = width / 2.0;
    let low = [a[0].min(b[0]) - r, a[1].min(b[1]) - r];
    let high = [a[0].max(b[0]) + r, a[1].max(b[1]) + r];
    let d = [b[0] - a[0], b[1] - a[1]];
    let len2 = d[0] * d[0] + d[1] * d[1];
    fill(image, low, high, rgb, alpha, |p| {
        let q = [p[0] - a[0], p[1] - a[1]];
        let t = if len2 > 0.0 { ((q[0] * d[0] + q[1] * d[1]) / len2).clamp(0.0, 1.0) } else { 0.0 };
        r - (q[0] - t * d[0]).hypot(q[1] - t * d[1])
    });
}

/// A filled triangle; corners in any order.
pub(crate) fn triangle(image: &mut RgbaImage, [a, b, c]: [At; 3], rgb: u32) {
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let (b, c) = if area < 0.0 { (c, b) } else { (b, c) };
    let pick = |f: fn(f32, f32) -> f32, i: usize| f(f(a[i], b[i]), c[i]);
    let low = [pick(f32::min, 0), pick(f32::min, 1)];
    let high = [pick(f32::max, 0), pick(f32::max, 1)];
    let edge = |p: At, s: At, e: At| {
        let d = [e[0] - s[0], e[1] - s[1]];
        (d[0] * (p[1] - s[1]) - d[1] * (p[0] - s[0])) / d[0].hypot(d[1]).max(1e-6)
    };
    fill(image, low, high, rgb, 1.0, |p| edge(p, a, b).min(edge(p, b, c)).min(edge(p, c, a)));
}

/// A ring, or a disc where the width is the radius.
pub(crate) fn ring(image: &mut RgbaImage, at: At, radius: f32, width: f32, rgb: u32) {
    let low = [at[0] - radius, at[1] - radius];
    let high = [at[0] + radius, at[1] + radius];
    fill(image, low, high, rgb, 1.0, |[x, y]| {
        let d = (x - at[0]).hypot(y - at[1]);
        (radius - d).min(d - (radius - width) + f32::from(u8::from(width >= radius)) * radius)
    });
}
