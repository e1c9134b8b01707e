//! Pictures one after another as one file.

use image::RgbaImage;
use image::codecs::gif::{GifEncoder, Repeat};
use image::{Delay, Frame};
use std::io::{self, Write};

/// An animated PNG that plays for ever: all colours, shown by browsers.
///
/// # Errors
/// Frames of different sizes, none at all, or an output that cannot be written.
pub fn apng(frames: &[RgbaImage], frame_s: f64, output: impl Write) -> io::Result<()> {
    let invalid = |error: png::EncodingError| io::Error::other(error.to_string());
    let (width, height) = size(frames)?;
    let mut encoder = png::Encoder::new(output, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_animated(frames.len() as u32, 0).map_err(invalid)?;
    encoder.set_frame_delay(milliseconds(frame_s), 1000).map_err(invalid)?;
    let mut writer = encoder.write_header().map_err(invalid)?;
    for frame in frames {
        let rgb: Vec<u8> = frame.pixels().flat_map(|p| [p[0], p[1], p[2]]).collect();
        writer.write_image_data(&rgb).map_err(invalid)?;
    }
    writer.finish().map_err(invalid)
}

/// An animated GIF that plays for ever: 256 colours a frame, shown everywhere.
///
/// # Errors
/// As for [`apng`].
pub fn gif(frames: &[RgbaImage], frame_s: f64, output: impl Write) -> io::Result<()> {
    size(frames)?;
    let invalid = |error: image::ImageError| io::Error::other(error.to_string());
    let mut encoder = GifEncoder::new_with_speed(output, 10);
    encoder.set_repeat(Repeat::Infinite).map_err(invalid)?;
    for frame in frames {
        let delay = Delay::from_numer_denom_ms(u32::from(milliseconds(frame_s)), 1);
        let frame = Frame::from_parts(frame.clone(), 0, 0, delay);
        encoder.encode_frame(frame).map_err(invalid)?;
    }
    Ok(())
}

fn milliseconds(frame_s: f64) -> u16 {
    (frame_s * 1e3).round().clamp(20.0, 60_000.0) as u16
}

/// The one size of all frames.
fn size(frames: &[RgbaImage]) -> io::Result<(u32, u32)> {
    let first = frames.first().map(RgbaImage::dimensions);
    first.filter(|first| frames.iter().all(|frame| frame.dimensions() == *first)).ok_or_else(|| {
        io::Error::new(io::ErrorKind::InvalidInput, "frames of one size, at least one")
    })
}
