//! `twin render`: one picture, or a short film, of a job.

use std::path::{Path, PathBuf};

use image::RgbaImage;
use render::{Camera, Fit, Picture, Studio, Task, View};
use sim::film::{Film, Look, Player, Quantity};
use sim::preflight::{Preflight, deformed, fallen, preflight};
use sim::scene::Scene;

use crate::library::{Library, LibraryArgs};
use crate::load;
use crate::pictures::{done_s, finding_scene, write_png};
use crate::refusal::{Failure, Refusal};
use crate::screen::Screen;
use crate::{FEASIBLE, files, targets};

/// Frames of a film if none are asked for.
const FRAMES: u16 = 48;
/// How long a frame of a film is shown, s.
const FRAME_S: f64 = 0.08;

/// Draw a job from a side, at a time, coloured by what you like
///
/// `turntable` and `build` are short films: an animated PNG, or a GIF where the file is called so.
#[derive(Debug, clap::Args)]
pub(crate) struct Render {
    /// Job to draw
    #[arg(value_name = "JOB.slam")]
    job: PathBuf,
    /// sheet, hero, part, top, front, side, finding:N, frame, collapse, turntable or build
    #[arg(long, value_name = "VIEW", default_value = "hero", value_parser = view_of)]
    view: Shown,
    /// When: seconds, percent of the program (50%) or `end`, when the last strand is done
    #[arg(long, value_name = "WHEN", default_value = "end", value_parser = when_of, allow_hyphen_values = true)]
    at: When,
    /// Colour of the strands: sag, order, age, temperature, cure, bead, displacement, utilisation,
    /// clearance, speed or none
    #[arg(long, value_name = "QUANTITY", default_value = "sag", value_parser = colour_of)]
    colour: Colour,
    /// Width and height in pixels, 240 to 4096 each
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size_of)]
    size: (u32, u32),
    /// Frames of a film
    #[arg(long, value_name = "N", default_value_t = FRAMES, value_parser = clap::value_parser!(u16).range(2..=600))]
    frames: u16,
    /// File to write
    #[arg(short, long, value_name = "FILE.png", default_value = "render.png")]
    output: PathBuf,
    /// Draw with rays on the processor, also where there is a graphics card
    #[arg(long)]
    cpu: bool,
    #[command(flatten)]
    library: LibraryArgs,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Shown {
    Sheet,
    From(Camera, Fit),
    Finding(usize),
    Frame,
    Collapse,
    Turntable,
    Build,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum When {
    Seconds(f64),
    Percent(f64),
    End,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Colour(Option<Quantity>);

impl Render {
    pub(crate) fn run(self, screen: &mut Screen<'_>) -> Result<u8, Failure> {
        let library = Library::open(&self.library)?;
        let loaded = load::job(&self.job, &library, screen)?;
        let name = loaded.source.name.clone();
        let is_film = matches!(self.view, Shown::Turntable | Shown::Build);
        targets::ends_in(&self.output, if is_film { &["png", "apng", "gif"] } else { &["png"] })?;
        targets::claim([self.output.as_path()], load::paths(&loaded.inputs))?;
        let checked =
            preflight(loaded.job, |_| {}).map_err(|error| Refusal::unsolved(&name, &error))?;
        let film = Film::new(&checked);
        if let When::Seconds(asked_s) = self.at
            && asked_s > film.total_s
        {
            let message = format!("the program ends at {:.1} s, before {asked_s} s", film.total_s);
            return Err(Refusal::whole("--at", message)
                .hint("give a time in it, or `--at end`")
                .into());
        }
        let backend = if self.cpu { render::Backend::Cpu } else { render::Backend::Auto };
        let mut studio = Studio::new(backend, screen.drawer.clone());
        let mut draw = |task: Task| {
            studio.draw(&task).map_err(|error| {
                Refusal::whole(&name, format!("the picture was not drawn: {error}")).hint(
                    "`twin doctor` says what this machine can draw; `--cpu` needs no graphics card",
                )
            })
        };
        let player = Player::new(&checked);
        let drawn_by = match self.view {
            Shown::Turntable | Shown::Build => {
                let pictures: Result<Vec<Picture>, Refusal> =
                    self.film_tasks(&film, &player).map(&mut draw).collect();
                let pictures = pictures?;
                let drawn_by = pictures.first().map(|picture| picture.drawn_by.to_string());
                let frames = pictures.into_iter().map(|picture| picture.rgba).collect::<Vec<_>>();
                write_film(&frames, &self.output)?;
                drawn_by.unwrap_or_default()
            }
            _ => {
                let picture = draw(self.task(&checked, &film, &player, &name)?)?;
                write_png(&picture.rgba, &self.output)
                    .map_err(|why| Refusal::whole(self.output.display().to_string(), why))?;
                picture.drawn_by.to_string()
            }
        };
        writeln!(screen.out, "picture  {} (drawn by {drawn_by})", self.output.display())?;
        Ok(FEASIBLE)
    }

    fn task(
        &self,
        checked: &Preflight,
        film: &Film,
        player: &Player<'_>,
        name: &str,
    ) -> Result<Task, Refusal> {
        let row = |row, what: &str| match row {
            Some(row) => Ok(Task::Row { row: Box::new(row), size_px: self.size }),
            None => Err(Refusal::whole(name, format!("there is nothing to show: {what}"))),
        };
        Ok(match self.view {
            Shown::Sheet => Task::Sheet {
                scene: Box::new(self.scene(film, player, self.time_s(film), true)),
                size_px: self.size,
            },
            Shown::Finding(number) => {
                let index = self.finding(film, number, name)?;
                let (_, scene) = finding_scene(film, player, index);
                Task::CloseUp { scene: Box::new(scene), size_px: self.size }
            }
            Shown::Frame => row(deformed(checked), "the frame does not move")?,
            Shown::Collapse => row(fallen(checked), "no stage fails")?,
            Shown::From(camera, fit) => {
                let scene = self.scene(film, player, self.time_s(film), true);
                self.view(scene, camera, fit)
            }
            Shown::Turntable | Shown::Build => unreachable!("these are films"),
        })
    }

    fn finding(&self, film: &Film, number: usize, name: &str) -> Result<usize, Refusal> {
        let there = film.findings.len();
        let refused = |why: String| Err(Refusal::whole(name, why));
        match number.checked_sub(1).and_then(|index| Some((index, film.findings.get(index)?))) {
            None if there == 0 => refused("the twin found nothing to look at".to_owned()),
            None => refused(format!(
                "there is no finding {number}; they are numbered from 1 to {there}"
            )),
            Some((_, finding)) if finding.at.is_none() => {
                refused(format!("finding {number} ({}) has no place to look at", finding.code))
            }
            Some((index, _)) => Ok(index),
        }
    }

    fn time_s(&self, film: &Film) -> f64 {
        match self.at {
            When::Seconds(time_s) => time_s,
            When::Percent(percent) => film.total_s * percent / 100.0,
            When::End => done_s(film),
        }
    }

    fn scene(&self, film: &Film, player: &Player<'_>, time_s: f64, marks: bool) -> Scene {
        let look = Look { colour: self.colour.0, planned: true, marks, finding: None };
        let scene = film.scene(&player.frame_at(time_s), &look);
        Scene { title: format!("{} – {time_s:.1} s", scene.title), ..scene }
    }

    fn view(&self, scene: Scene, camera: Camera, fit: Fit) -> Task {
        let ghost_arm = fit != Fit::Cell;
        let view = View { size_px: self.size, camera, fit, ghost_arm };
        Task::View { scene: Box::new(scene), view }
    }

    /// The pictures of a film, made as they are drawn.
    fn film_tasks<'a>(
        &'a self,
        film: &'a Film,
        player: &'a Player<'_>,
    ) -> impl Iterator<Item = Task> + 'a {
        (0..self.frames).map(move |k| {
            let share = f64::from(k) / f64::from(self.frames);
            match self.view {
                Shown::Build => {
                    let first_s =
                        film.strands.first().and_then(sim::film::FilmStrand::born_s).unwrap_or(0.0);
                    let share = f64::from(k) / f64::from(self.frames - 1);
                    let time_s = first_s + (done_s(film) - first_s) * share;
                    let scene = self.scene(film, player, time_s, false);
                    self.view(scene, Camera::Isometric, Fit::Part)
                }
                _ => {
                    let scene = self.scene(film, player, self.time_s(film), false);
                    let azimuth_deg = -50.0 + 360.0 * share;
                    let camera = Camera::Orbit { azimuth_deg, elevation_deg: 28.0 };
                    self.view(scene, camera, Fit::Part)
                }
            }
        })
    }
}

/// An animated PNG, or a GIF where the file is called so.
fn write_film(frames: &[RgbaImage], path: &Path) -> Result<(), Refusal> {
    let mut bytes = Vec::new();
    let is_gif = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gif"));
    let made = match is_gif {
        true => render::gif(frames, FRAME_S, &mut bytes),
        false => render::apng(frames, FRAME_S, &mut bytes),
    };
    made.map_err(|error| Refusal::whole(path.display().to_string(), error.to_string()))?;
    files::write_whole(path, &bytes)
}

fn view_of(text: &str) -> Result<Shown, String> {
    Ok(match text {
        "sheet" => Shown::Sheet,
        "hero" => Shown::From(Camera::Isometric, Fit::Cell),
        "part" => Shown::From(Camera::Isometric, Fit::Part),
        "top" => Shown::From(Camera::Top, Fit::Part),
        "front" => Shown::From(Camera::Front, Fit::Part),
        "side" => Shown::From(Camera::Side, Fit::Part),
        "frame" => Shown::Frame,
        "collapse" => Shown::Collapse,
        "turntable" => Shown::Turntable,
        "build" => Shown::Build,
        other => match other.strip_prefix("finding:").and_then(|n| n.parse().ok()) {
            Some(number) => Shown::Finding(number),
            None => {
                let known = "sheet, hero, part, top, front, side, finding:N, frame, collapse, turntable, build";
                return Err(format!("views are {known}"));
            }
        },
    })
}

fn when_of(text: &str) -> Result<When, String> {
    let number = |text: &str| text.parse::<f64>().ok().filter(|n| n.is_finite() && *n >= 0.0);
    let when = match text.strip_suffix('%') {
        _ if text == "end" => Some(When::End),
        Some(percent) => number(percent).filter(|p| *p <= 100.0).map(When::Percent),
        None => number(text.strip_suffix('s').unwrap_or(text)).map(When::Seconds),
    };
    when.ok_or_else(|| "give seconds (12.5), percent of the program (50%) or `end`".to_owned())
}

fn colour_of(text: &str) -> Result<Colour, String> {
    if text == "none" {
        return Ok(Colour(None));
    }
    let found = Quantity::ALL.into_iter().find(|quantity| quantity.word() == text);
    found.map(|quantity| Colour(Some(quantity))).ok_or_else(|| {
        let known: Vec<&str> = Quantity::ALL.into_iter().map(Quantity::word).collect();
        format!("strands are coloured by {} or none", known.join(", "))
    })
}

fn size_of(text: &str) -> Result<(u32, u32), String> {
    let parsed = text.split_once('x').and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    let fits = |n: u32| (render::MIN_PX..=render::MAX_PX).contains(&n);
    parsed.filter(|(w, h)| fits(*w) && fits(*h)).ok_or_else(|| {
        format!("give width and height from {} to {}, as 1280x720", render::MIN_PX, render::MAX_PX)
    })
}
