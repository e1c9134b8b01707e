//! Tasks and answers as framed bytes.

use super::wire::{Reader, Writer};
use crate::task::Task;
use crate::view::{Camera, Fit, Projection, View};
use crate::{Backend, DrawnBy, Picture, RenderError};
use image::RgbaImage;
use std::io::{self, Read, Write};

/// In front of every message: what else a program may have printed is passed over.
const MARK: &[u8; 8] = b"\x1etwin\x1edr";
/// What may be passed over, bytes.
const NOISE_MAX: usize = 1 << 16;
/// Largest message, bytes.
const MESSAGE_MAX: u64 = 2 << 30;

/// Writes a message with its frame.
pub(super) fn write(output: &mut impl Write, message: &[u8]) -> io::Result<()> {
    output.write_all(MARK)?;
    output.write_all(&(message.len() as u64).to_le_bytes())?;
    output.write_all(message)?;
    output.flush()
}

/// The next message; `None` at the end.
pub(super) fn read(input: &mut impl Read) -> io::Result<Option<Vec<u8>>> {
    let invalid = |text| Err(io::Error::new(io::ErrorKind::InvalidData, text));
    let mut seen = [0_u8; MARK.len()];
    let mut passed = 0;
    while &seen != MARK {
        let mut byte = [0];
        if input.read(&mut byte)? == 0 {
            return Ok(None);
        }
        seen.rotate_left(1);
        seen[MARK.len() - 1] = byte[0];
        passed += 1;
        if passed > NOISE_MAX {
            return invalid("no message");
        }
    }
    let mut length = [0; 8];
    input.read_exact(&mut length)?;
    let length = u64::from_le_bytes(length);
    if length > MESSAGE_MAX {
        return invalid("too long a message");
    }
    let mut message = Vec::new();
    input.take(length).read_to_end(&mut message)?;
    if message.len() as u64 == length { Ok(Some(message)) } else { invalid("half a message") }
}

const BACKENDS: [Backend; 3] = [Backend::Auto, Backend::Gpu, Backend::Cpu];

/// A task for the child.
pub(super) fn asked(backend: Backend, task: &Task) -> Vec<u8> {
    let mut to = Writer::default();
    to.count(BACKENDS.iter().position(|&known| known == backend).unwrap_or(0));
    let size = |to: &mut Writer, size_px: &(u32, u32)| {
        to.count(size_px.0 as usize);
        to.count(size_px.1 as usize);
    };
    match task {
        Task::Sheet { scene, size_px } => {
            to.count(0);
            to.scene(scene);
            size(&mut to, size_px);
        }
        Task::Row { row, size_px } => {
            to.count(1);
            to.row(row);
            size(&mut to, size_px);
        }
        Task::View { scene, view } => {
            to.count(2);
            to.scene(scene);
            size(&mut to, &view.size_px);
            camera(&mut to, &view.camera);
            fit(&mut to, &view.fit);
            to.count(usize::from(view.ghost_arm));
        }
        Task::CloseUp { scene, size_px } => {
            to.count(3);
            to.scene(scene);
            size(&mut to, size_px);
        }
    }
    to.0
}

fn camera(to: &mut Writer, camera: &Camera) {
    match camera {
        Camera::Isometric => to.count(0),
        Camera::Front => to.count(1),
        Camera::Side => to.count(2),
        Camera::Top => to.count(3),
        Camera::Orbit { azimuth_deg, elevation_deg } => {
            to.count(4);
            to.number(*azimuth_deg);
            to.number(*elevation_deg);
        }
    }
}

fn fit(to: &mut Writer, fit: &Fit) {
    match fit {
        Fit::Cell => to.count(0),
        Fit::Part => to.count(1),
        Fit::Box(bounds) => {
            to.count(2);
            to.point(&bounds.min);
            to.point(&bounds.max);
        }
    }
}

/// The task of a message.
pub(super) fn task(bytes: &[u8]) -> Option<(Backend, Task)> {
    let mut from = Reader(bytes);
    let size = |from: &mut Reader| Some((from.count()? as u32, from.count()? as u32));
    let backend = *BACKENDS.get(from.count()?)?;
    let task = match from.count()? {
        0 => Task::Sheet { scene: Box::new(from.scene()?), size_px: size(&mut from)? },
        1 => Task::Row { row: Box::new(from.row()?), size_px: size(&mut from)? },
        2 => {
            let (scene, size_px) = (Box::new(from.scene()?), size(&mut from)?);
            let camera = match from.count()? {
                0 => Camera::Isometric,
                1 => Camera::Front,
                2 => Camera::Side,
                3 => Camera::Top,
                4 => Camera::Orbit { azimuth_deg: from.number()?, elevation_deg: from.number()? },
                _ => return None,
            };
            let fit = match from.count()? {
                0 => Fit::Cell,
                1 => Fit::Part,
                2 => Fit::Box(sim::scene::Bounds { min: from.point()?, max: from.point()? }),
                _ => return None,
            };
            Task::View { scene, view: View { size_px, camera, fit, ghost_arm: from.flag()? } }
        }
        3 => Task::CloseUp { scene: Box::new(from.scene()?), size_px: size(&mut from)? },
        _ => return None,
    };
    from.0.is_empty().then_some((backend, task))
}

/// The child's answer.
pub(super) fn answer(drawn: &Result<Picture, RenderError>) -> Vec<u8> {
    let mut to = Writer::default();
    let picture = match drawn {
        Ok(picture) => picture,
        Err(error) => {
            let (kind, text) = match error {
                RenderError::NoAdapter(why) => (1, why.clone()),
                RenderError::Gpu(why) => (2, why.clone()),
                RenderError::Size { width, height } => (3, format!("{width} {height}")),
                RenderError::Font => (4, String::new()),
                RenderError::Process(why) => (5, why.clone()),
            };
            to.count(kind);
            to.text(&text);
            return to.0;
        }
    };
    to.count(0);
    to.count(picture.rgba.width() as usize);
    to.count(picture.rgba.height() as usize);
    to.bytes(picture.rgba.as_raw());
    match &picture.drawn_by {
        DrawnBy::Gpu { adapter, driver } => {
            to.count(0);
            to.text(adapter);
            to.text(driver);
        }
        DrawnBy::Cpu { because } => {
            to.count(1);
            to.maybe(because.as_ref(), |to, why| to.text(why));
        }
    }
    to.list(&picture.views, |to, ((x, y), view)| {
        to.count(*x as usize);
        to.count(*y as usize);
        projection(to, view);
    });
    to.0
}

fn projection(to: &mut Writer, view: &Projection) {
    to.point(&view.centre);
    for axis in [&view.right, &view.up, &view.forward] {
        to.vector(axis);
    }
    for value in [view.centre_px[0], view.centre_px[1], view.px_per_m] {
        to.number(value);
    }
    to.count(view.size_px.0 as usize);
    to.count(view.size_px.1 as usize);
}

/// What the child has answered.
pub(super) fn answered(bytes: &[u8]) -> Option<Result<Picture, RenderError>> {
    let mut from = Reader(bytes);
    let kind = from.count()?;
    if kind != 0 {
        let text = from.text()?;
        return Some(Err(match kind {
            1 => RenderError::NoAdapter(text),
            2 => RenderError::Gpu(text),
            3 => {
                let (width, height) = text.split_once(' ')?;
                RenderError::Size { width: width.parse().ok()?, height: height.parse().ok()? }
            }
            4 => RenderError::Font,
            5 => RenderError::Process(text),
            _ => return None,
        }));
    }
    let (width, height) = (from.count()? as u32, from.count()? as u32);
    let rgba = RgbaImage::from_raw(width, height, from.bytes()?.to_vec())?;
    let drawn_by = match from.count()? {
        0 => DrawnBy::Gpu { adapter: from.text()?, driver: from.text()? },
        1 => DrawnBy::Cpu { because: from.maybe(Reader::text)? },
        _ => return None,
    };
    let views = from.list(|from| {
        let at = (from.count()? as u32, from.count()? as u32);
        let view = Projection {
            centre: from.point()?,
            right: from.vector()?,
            up: from.vector()?,
            forward: from.vector()?,
            centre_px: [from.number()?, from.number()?],
            px_per_m: from.number()?,
            size_px: (from.count()? as u32, from.count()? as u32),
        };
        Some((at, view))
    })?;
    Some(Ok(Picture { rgba, drawn_by, views }))
}
