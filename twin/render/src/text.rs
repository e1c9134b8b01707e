//! Letters, in the font that is embedded in the program (Inter, SIL Open Font License 1.1).

use crate::RenderError;
use crate::canvas::{At, blend, split};
use ab_glyph::{Font, FontRef, Glyph, ScaleFont, point};
use image::RgbaImage;

/// The font, ready to write.
pub(crate) struct Pen {
    font: FontRef<'static>,
}

/// Where a text stands about its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Left,
    Centre,
    Right,
}

/// How a text looks.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ink {
    /// Height of a line, px.
    pub(crate) size: f32,
    /// Colour.
    pub(crate) rgb: u32,
    /// Width of a white rim, px; 0 for none.
    pub(crate) halo: f32,
}

impl Pen {
    pub(crate) fn new() -> Result<Pen, RenderError> {
        let font = FontRef::try_from_slice(include_bytes!("../font/Inter-Regular.otf"));
        Ok(Pen { font: font.map_err(|_| RenderError::Font)? })
    }

    /// Length of a text, px.
    pub(crate) fn width(&self, text: &str, size: f32) -> f32 {
        self.lay(text, size).1
    }

    /// The text, cut with an ellipsis where it is longer than `room`, px.
    pub(crate) fn cut(&self, text: &str, size: f32, room: f32) -> String {
        if self.width(text, size) <= room {
            return text.to_owned();
        }
        let mut short: String = text.chars().take(400).collect();
        while !short.is_empty() && self.width(&format!("{short}…"), size) > room {
            short.pop();
        }
        format!("{}…", short.trim_end())
    }

    /// Writes one line whose middle of the small letters is at the height of `at`.
    pub(crate) fn write(
        &self,
        image: &mut RgbaImage,
        at: At,
        anchor: Anchor,
        ink: Ink,
        text: &str,
    ) {
        let (glyphs, width) = self.lay(text, ink.size);
        let left = match anchor {
            Anchor::Left => at[0],
            Anchor::Centre => at[0] - width / 2.0,
            Anchor::Right => at[0] - width,
        };
        let base = at[1] + 0.30 * ink.size;
        if ink.halo > 0.0 {
            for k in 0..12 {
                let (sin, cos) = (std::f32::consts::TAU * k as f32 / 12.0).sin_cos();
                let by = [left + ink.halo * cos, base + ink.halo * sin];
                self.put(image, &glyphs, by, 0xFFFFFF, 0.55);
            }
        }
        self.put(image, &glyphs, [left, base], ink.rgb, 1.0);
    }

    /// Glyphs on a base line at the origin, and the length of the line.
    fn lay(&self, text: &str, size: f32) -> (Vec<Glyph>, f32) {
        let font = self.font.as_scaled(size);
        let mut x = 0.0;
        let mut last = None;
        let mut glyphs = Vec::new();
        for c in text.chars().map(|c| if c.is_control() { ' ' } else { c }) {
            let id = font.glyph_id(c);
            if let Some(last) = last {
                x += font.kern(last, id);
            }
            glyphs.push(id.with_scale_and_position(size, point(x, 0.0)));
            x += font.h_advance(id);
            last = Some(id);
        }
        (glyphs, x)
    }

    fn put(&self, image: &mut RgbaImage, glyphs: &[Glyph], by: At, rgb: u32, alpha: f32) {
        let rgb = split(rgb);
        for glyph in glyphs {
            let mut glyph = glyph.clone();
            glyph.position.x += by[0];
            glyph.position.y += by[1];
            if let Some(outline) = self.font.outline_glyph(glyph) {
                let corner = outline.px_bounds().min;
                outline.draw(|x, y, cover| {
                    let (x, y) = (corner.x as i64 + i64::from(x), corner.y as i64 + i64::from(y));
                    blend(image, x, y, rgb, cover * alpha);
                });
            }
        }
    }
}
