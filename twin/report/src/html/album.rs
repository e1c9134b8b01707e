//! The pictures that fit into the page.

use super::base64;
use super::sentence;

/// A picture to embed, as the bytes of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct EmbeddedPicture {
    /// What it shows.
    pub kind: PictureKind,
    /// The same in words, for who does not see it.
    pub alt: String,
    /// `image/png` or `image/jpeg`.
    pub mime: &'static str,
    /// The file.
    pub bytes: Vec<u8>,
}

/// What a picture shows.
#[derive(Debug, Clone, PartialEq)]
pub enum PictureKind {
    /// The part in its cell, finished.
    Hero,
    /// The job at a time.
    Strip {
        /// When, s.
        time_s: f64,
    },
    /// A finding from near.
    Finding {
        /// Its place in [`crate::Report::findings`].
        index: usize,
    },
    /// The frame, bent.
    Frame,
    /// How the part collapses.
    Collapse,
    /// Which orientations a strand could have been printed in.
    SpinMap {
        /// Its name.
        strand: String,
    },
}

/// Pictures of the strip that stay before pictures of findings go.
const STRIP_MIN: usize = 6;

/// What is shown, and how much is not.
#[derive(Debug, Default)]
pub(super) struct Album<'a> {
    shown: Vec<&'a EmbeddedPicture>,
    /// Pictures that did not fit.
    pub(super) left_out: usize,
    /// Bytes of those that did, as in their files.
    pub(super) bytes: usize,
}

impl<'a> Album<'a> {
    /// Those that fit: the film strip gets coarser first, then findings far down the list lose theirs, then the strip goes.
    pub(super) fn within(pictures: &'a [EmbeddedPicture], budget_bytes: usize) -> Self {
        let mut strip: Vec<&EmbeddedPicture> =
            pictures.iter().filter(|picture| strip_time_s(picture).is_some()).collect();
        strip.sort_by(|a, b| {
            strip_time_s(a).unwrap_or(0.0).total_cmp(&strip_time_s(b).unwrap_or(0.0))
        });
        let mut other: Vec<&EmbeddedPicture> =
            pictures.iter().filter(|picture| strip_time_s(picture).is_none()).collect();
        other.sort_by_key(|picture| rank(&picture.kind));
        let size =
            |some: &[&EmbeddedPicture]| some.iter().map(|picture| cost(picture)).sum::<usize>();
        let mut other_size = size(&other);
        while strip.len() > STRIP_MIN && size(&strip) + other_size > budget_bytes {
            strip = every_second(&strip);
        }
        let is_hero = |picture: &EmbeddedPicture| picture.kind == PictureKind::Hero;
        while size(&strip) + other_size > budget_bytes {
            let gone = if other.last().is_some_and(|last| !is_hero(last)) || strip.is_empty() {
                other.pop()
            } else {
                strip.pop()
            };
            match gone {
                Some(gone) if strip_time_s(gone).is_none() => other_size -= cost(gone),
                Some(_) => {}
                None => break,
            }
        }
        let shown: Vec<&EmbeddedPicture> = other.into_iter().chain(strip).collect();
        let bytes = shown.iter().map(|picture| picture.bytes.len()).sum();
        Self { left_out: pictures.len() - shown.len(), shown, bytes }
    }

    /// How many are shown.
    pub(super) fn len(&self) -> usize {
        self.shown.len()
    }

    /// The first of a kind.
    pub(super) fn first(&self, kind: &PictureKind) -> Option<&'a EmbeddedPicture> {
        self.shown.iter().copied().find(|picture| picture.kind == *kind)
    }

    /// The film strip in order of time.
    pub(super) fn strip(&self) -> impl Iterator<Item = (f64, &'a EmbeddedPicture)> {
        self.shown.iter().filter_map(|picture| Some((strip_time_s(picture)?, *picture)))
    }

    /// Spin maps with the strand's name.
    pub(super) fn spin_maps(&self) -> impl Iterator<Item = (&'a str, &'a EmbeddedPicture)> {
        self.shown.iter().filter_map(|picture| match &picture.kind {
            PictureKind::SpinMap { strand } => Some((strand.as_str(), *picture)),
            _ => None,
        })
    }
}

/// From the end, so that the finished part stays.
fn every_second<'a>(strip: &[&'a EmbeddedPicture]) -> Vec<&'a EmbeddedPicture> {
    let last = strip.len() - 1;
    strip
        .iter()
        .enumerate()
        .filter(|(k, _)| (last - k).is_multiple_of(2))
        .map(|(_, it)| *it)
        .collect()
}

impl EmbeddedPicture {
    /// The element, with the picture in it.
    pub(super) fn img(&self) -> String {
        // only these two: whatever else it claims to be is not shown as such
        let mime = if self.mime == "image/jpeg" { "image/jpeg" } else { "image/png" };
        format!(
            "<img alt=\"{}\" src=\"data:{mime};base64,{}\"/>",
            sentence(&self.alt),
            base64::encode(&self.bytes)
        )
    }
}

fn strip_time_s(picture: &EmbeddedPicture) -> Option<f64> {
    match picture.kind {
        PictureKind::Strip { time_s } if time_s.is_finite() => Some(time_s),
        PictureKind::Strip { .. } => Some(0.0),
        _ => None,
    }
}

/// What goes last has the lowest rank.
fn rank(kind: &PictureKind) -> usize {
    match kind {
        PictureKind::Hero => 0,
        PictureKind::Frame => 1,
        PictureKind::Collapse => 2,
        PictureKind::Finding { index } => index.saturating_add(4),
        PictureKind::Strip { .. } | PictureKind::SpinMap { .. } => 3,
    }
}

/// Bytes it adds to the page, with its frame.
fn cost(picture: &EmbeddedPicture) -> usize {
    base64::length(picture.bytes.len()) + 4 * picture.alt.len().min(2000) + 400
}
