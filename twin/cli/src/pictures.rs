//! The pictures of a check: what is drawn, by whom, and where it goes.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use image::RgbaImage;
use render::{Camera, DrawnBy, Fit, Picture, Studio, Task, View};
use sim::film::{Film, FilmStrand, Look, Player, Quantity};
use sim::finding::{Family, Finding};
use sim::motion::{Across, spin_map};
use sim::preflight::{Preflight, deformed, fallen};
use sim::scene::Scene;

use crate::files;

/// Width and height of the cell's picture, px.
const CELL_PX: (u32, u32) = (1600, 900);
/// Of a row of moments: they may lie below each other.
const ROW_PX: (u32, u32) = (1600, 1100);
/// Of a finding from near by.
const FINDING_PX: (u32, u32) = (800, 500);
/// Of a picture of the film strip.
const STRIP_PX: (u32, u32) = (480, 300);
/// Findings drawn from near by: the first of each code, then more.
const FINDINGS_MAX: usize = 6;
/// Pictures of the film strip.
const STRIP: usize = 8;
/// Strands with a spin map, and its size.
const MAPS_MAX: usize = 2;
const MAP_PX: (u32, u32) = (1000, 560);

/// What a picture shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Shows {
    /// The cell and the part when all is printed.
    Sheet,
    /// A finding, by its place in the report.
    Finding(usize),
    /// The frame as it moves while it grows.
    Frame,
    /// What falls where a stage fails.
    Collapse,
    /// The part at a time, s.
    Moment(f64),
    /// The orientations that a strand of the job could have had.
    SpinMap(usize),
}

/// A picture that was drawn.
pub(crate) struct Shot {
    pub(crate) shows: Shows,
    /// In a few words.
    pub(crate) words: String,
    pub(crate) rgba: RgbaImage,
    /// The file it stands in by itself, if it does.
    pub(crate) path: Option<PathBuf>,
}

/// All pictures of a check.
pub(crate) struct Album {
    pub(crate) shots: Vec<Shot>,
    /// Who drew, each once: where a driver fails on the way there is a second.
    pub(crate) drawn_by: Vec<String>,
    /// Why the graphics card did not draw where it was asked.
    pub(crate) fell_back: Option<String>,
    /// Why something was not drawn.
    pub(crate) missing: Option<String>,
}

impl Album {
    /// Draws everything worth a look; each picture is in its file before the next is begun.
    pub(crate) fn of(checked: &Preflight, film: &Film, out: &Path, studio: &mut Studio) -> Album {
        let mut album =
            Album { shots: Vec::new(), drawn_by: Vec::new(), fell_back: None, missing: None };
        for (shows, words, task) in wanted(checked, film) {
            let done = studio
                .draw(&task)
                .map_err(|error| error.to_string())
                .and_then(|picture| album.keep(shows, words, picture, film, out));
            if let Err(why) = done {
                album.missing.get_or_insert(why);
            }
        }
        album.spin_maps(checked);
        album
    }

    /// Maps of the first strands that the arm has trouble with: they show whether there is another way.
    fn spin_maps(&mut self, checked: &Preflight) {
        for strand in troubled(checked) {
            let id = &checked.job().strands[strand].id;
            let Some(map) = spin_map(&checked.map_of(), strand, Across::Spin) else { continue };
            match render::spin_map(&map, &format!("strand {id}"), MAP_PX) {
                Ok(rgba) => {
                    let words = format!("orientations of the tool along strand {id}");
                    self.shots.push(Shot {
                        shows: Shows::SpinMap(strand),
                        words,
                        rgba,
                        path: None,
                    });
                }
                Err(error) => drop(self.missing.get_or_insert(error.to_string())),
            }
        }
    }

    fn keep(
        &mut self,
        shows: Shows,
        words: String,
        picture: Picture,
        film: &Film,
        out: &Path,
    ) -> Result<(), String> {
        let drawn_by = picture.drawn_by.to_string();
        if !self.drawn_by.contains(&drawn_by) {
            self.drawn_by.push(drawn_by);
        }
        if let DrawnBy::Cpu { because: Some(why) } = &picture.drawn_by {
            self.fell_back.get_or_insert_with(|| why.clone());
        }
        let path = file_name(shows, film).map(|name| out.join(name));
        if let Some(path) = &path {
            write_png(&picture.rgba, path)?;
        }
        self.shots.push(Shot { shows, words, rgba: picture.rgba, path });
        Ok(())
    }
}

/// The file of a picture in the folder of the answer.
fn file_name(shows: Shows, film: &Film) -> Option<String> {
    match shows {
        Shows::Sheet => Some("picture.png".to_owned()),
        Shows::Frame => Some("frame.png".to_owned()),
        Shows::Collapse => Some("collapse.png".to_owned()),
        Shows::Finding(index) => {
            Some(format!("finding-{}-{}.png", index + 1, film.findings[index].code))
        }
        Shows::Moment(_) | Shows::SpinMap(_) => None,
    }
}

/// The first strands with a finding on reach or motion.
fn troubled(checked: &Preflight) -> Vec<usize> {
    let mut strands: Vec<usize> = Vec::new();
    let of_reach = |f: &&Finding| f.code.family() == Family::Reach;
    for strand in checked.findings().iter().filter(of_reach).filter_map(|f| f.site.strand) {
        if strands.len() < MAPS_MAX && !strands.contains(&strand) {
            strands.push(strand);
        }
    }
    strands
}

/// Whether a file of the answer's folder is a picture of an earlier check.
pub(crate) fn is_ours(name: &str) -> bool {
    ["picture.png", "frame.png", "collapse.png"].contains(&name)
        || (name.starts_with("finding-") && name.ends_with(".png"))
}

/// Everything to draw, the most important first.
fn wanted(checked: &Preflight, film: &Film) -> Vec<(Shows, String, Task)> {
    let player = Player::new(checked);
    let mut all = Vec::new();
    let scene = finished(film, &player, Some(film.most_telling()));
    let sheet = Task::Sheet { scene: Box::new(scene), size_px: CELL_PX };
    all.push((Shows::Sheet, "the cell, and the part when all is printed".to_owned(), sheet));
    for index in pictured(film) {
        let (words, scene) = finding_scene(film, &player, index);
        let task = Task::CloseUp { scene: Box::new(scene), size_px: FINDING_PX };
        all.push((Shows::Finding(index), words, task));
    }
    let row = |row| Task::Row { row: Box::new(row), size_px: ROW_PX };
    all.extend(deformed(checked).map(|made| {
        (Shows::Frame, "the frame under its weight as it grows".to_owned(), row(made))
    }));
    all.extend(fallen(checked).map(|made| {
        (Shows::Collapse, "what falls where a stage fails (illustration)".to_owned(), row(made))
    }));
    for time_s in strip_times(film) {
        let look = Look { colour: Some(Quantity::Order), planned: true, ..Look::default() };
        let scene = film.scene(&player.frame_at(time_s), &look);
        let view =
            View { size_px: STRIP_PX, camera: Camera::Isometric, fit: Fit::Part, ghost_arm: true };
        let words = format!("the part after {time_s:.1} s");
        let scene = Scene { title: format!("{time_s:.1} s"), ..scene };
        all.push((Shows::Moment(time_s), words, Task::View { scene: Box::new(scene), view }));
    }
    all
}

/// When the last strand is done, s.
pub(crate) fn done_s(film: &Film) -> f64 {
    film.strands.iter().filter_map(FilmStrand::done_s).fold(0.0, f64::max)
}

/// The cell with all that is printed at the end of the last strand.
pub(crate) fn finished(film: &Film, player: &Player<'_>, colour: Option<Quantity>) -> Scene {
    let look = Look { colour, marks: true, ..Look::default() };
    film.scene(&player.frame_at(done_s(film)), &look)
}

/// Findings that have a place, one of each code before a second of any.
fn pictured(film: &Film) -> Vec<usize> {
    let with_place = film.one_of_each_code_first(|finding| finding.at.is_some());
    let mut chosen: Vec<usize> = with_place.take(FINDINGS_MAX).collect();
    chosen.sort_unstable();
    chosen
}

/// A finding at its time, with its numbers.
pub(crate) fn finding_scene(film: &Film, player: &Player<'_>, index: usize) -> (String, Scene) {
    let finding = &film.findings[index];
    let time_s = finding.time_s.unwrap_or_else(|| done_s(film));
    let look = Look { finding: Some(index), planned: true, ..Look::default() };
    let scene = film.scene(&player.frame_at(time_s), &look);
    let severity = finding.severity.word();
    let strand = finding.strand.and_then(|order| film.strands.get(order));
    let strand = strand.map_or_else(String::new, |strand| format!(", strand {}", strand.id));
    let words = format!("{} {severity}: {}{strand}, at {time_s:.2} s", finding.code, finding.words);
    (words.clone(), Scene { title: words, ..scene })
}

/// Times of the film strip, evenly over what is printed.
fn strip_times(film: &Film) -> Vec<f64> {
    let laid: Vec<f64> = film.strands.iter().flat_map(|s| s.time_s.iter().copied()).collect();
    let Some(last) = laid.len().checked_sub(1) else { return Vec::new() };
    let mut times: Vec<f64> = (1..=STRIP).map(|k| laid[last * k / STRIP]).collect();
    times.dedup();
    times
}

/// Writes a PNG whole or not at all.
pub(crate) fn write_png(rgba: &RgbaImage, path: &Path) -> Result<(), String> {
    files::write_whole(path, &png(rgba)?).map_err(|refusal| refusal.sentences())
}

/// Bytes of a PNG.
pub(crate) fn png(rgba: &RgbaImage) -> Result<Vec<u8>, String> {
    let mut png = Cursor::new(Vec::new());
    rgba.write_to(&mut png, image::ImageFormat::Png).map_err(|error| error.to_string())?;
    Ok(png.into_inner())
}

/// Bytes of a JPEG, for pages.
pub(crate) fn jpeg(rgba: &RgbaImage) -> Vec<u8> {
    let mut bytes = Vec::new();
    let rgb = image::DynamicImage::ImageRgba8(rgba.clone()).into_rgb8();
    let encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 84);
    // writing to memory fails for no picture we draw; a page without one is still whole
    if rgb.write_with_encoder(encoder).is_err() {
        bytes.clear();
    }
    bytes
}
