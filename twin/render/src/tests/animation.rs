//! Short films, read back by other code.

use crate::{apng, gif};
use image::AnimationDecoder as _;
use image::codecs::{gif::GifDecoder, png::PngDecoder};
use image::{Rgba, RgbaImage};
use std::io::Cursor;

fn frames() -> Vec<RgbaImage> {
    [[200, 40, 40, 255], [40, 200, 40, 255], [40, 40, 200, 255]]
        .map(|rgba| RgbaImage::from_pixel(32, 20, Rgba(rgba)))
        .to_vec()
}

#[test]
fn an_animated_png_holds_every_frame() {
    let mut bytes = Vec::new();
    apng(&frames(), 0.08, &mut bytes).expect("written");
    let decoder = PngDecoder::new(Cursor::new(bytes)).expect("a PNG").apng().expect("animated");
    let read = decoder.into_frames().collect_frames().expect("whole");
    assert_eq!(read.len(), 3);
    for (frame, wanted) in read.iter().zip(frames()) {
        assert!(*frame.buffer() == wanted);
        assert_eq!(frame.delay().numer_denom_ms(), (80, 1));
    }
}

#[test]
fn a_gif_holds_every_frame() {
    let mut bytes = Vec::new();
    gif(&frames(), 0.08, &mut bytes).expect("written");
    let read = GifDecoder::new(Cursor::new(bytes)).expect("a GIF").into_frames();
    let read = read.collect_frames().expect("whole");
    assert_eq!(read.len(), 3);
    for (frame, wanted) in read.iter().zip(frames()) {
        let off = |a: &Rgba<u8>, b: &Rgba<u8>| (0..3).map(|c| a[c].abs_diff(b[c])).max();
        let most =
            frame.buffer().pixels().zip(wanted.pixels()).filter_map(|(a, b)| off(a, b)).max();
        assert!(most <= Some(4), "256 colours are enough for one: {most:?}");
    }
}

#[test]
fn frames_of_two_sizes_or_none_are_refused() {
    let mut odd = frames();
    odd[1] = RgbaImage::new(31, 20);
    for frames in [odd, Vec::new()] {
        assert!(apng(&frames, 0.1, Vec::new()).is_err());
        assert!(gif(&frames, 0.1, Vec::new()).is_err());
    }
}
