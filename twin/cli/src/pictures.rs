//! The pictures of a check.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use render::{Backend, Picture, RenderError};
use sim::film::{Film, Look, Player, Quantity};
use sim::preflight::{Preflight, deformed, fallen};
use sim::scene::Scene;

use crate::files;

/// Width and height of the cell's picture, px.
const CELL_PX: (u32, u32) = (1600, 900);
/// Of a row of moments: they may lie below each other.
const ROW_PX: (u32, u32) = (1600, 1100);

/// Every picture there may be: what it is, and its file. The first is always there.
pub(crate) const NAMES: [(&str, &str); 3] =
    [("picture", "picture.png"), ("frame", "frame.png"), ("collapse", "collapse.png")];

/// What was drawn.
pub(crate) struct Drawn {
    /// What each picture is, and where.
    pub(crate) pictures: Vec<(&'static str, PathBuf)>,
    /// Who drew.
    pub(crate) drawn_by: String,
}

/// Draws the cell, the deformed frame where it moves, and what falls where a stage fails.
pub(crate) fn draw(checked: &Preflight, out: &Path, backend: Backend) -> Result<Drawn, String> {
    let row = |row| render::row(&row, ROW_PX, backend);
    let made: [Option<Result<Picture, RenderError>>; 3] = [
        Some(render::sheet(&finished(checked), CELL_PX, backend)),
        deformed(checked).map(row),
        fallen(checked).map(row),
    ];
    let mut drawn = Drawn { pictures: Vec::new(), drawn_by: String::new() };
    for ((what, file), picture) in NAMES.into_iter().zip(made) {
        let Some(picture) = picture.transpose().map_err(|error| error.to_string())? else {
            continue;
        };
        let path = out.join(file);
        write(&picture, &path)?;
        if drawn.pictures.is_empty() {
            drawn.drawn_by = picture.drawn_by.to_string();
        }
        drawn.pictures.push((what, path));
    }
    Ok(drawn)
}

fn write(picture: &Picture, path: &Path) -> Result<(), String> {
    let mut png = Cursor::new(Vec::new());
    let made = picture.rgba.write_to(&mut png, image::ImageFormat::Png);
    made.map_err(|error| error.to_string())?;
    files::write_whole(path, &png.into_inner()).map_err(|refusal| {
        refusal.diagnostics.into_iter().map(|problem| problem.message).collect::<String>()
    })
}

/// The cell with all that is printed at the end of the last strand, strands coloured by the sag behind the nozzle.
fn finished(checked: &Preflight) -> Scene {
    let film = Film::new(checked);
    let done_s = film.strands.iter().filter_map(sim::film::FilmStrand::done_s).fold(0.0, f64::max);
    let look = Look { colour: Some(Quantity::Sag), marks: true, ..Look::default() };
    film.scene(&Player::new(checked).frame_at(done_s), &look)
}
