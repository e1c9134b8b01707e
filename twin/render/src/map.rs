//! The spin map as a picture: path position across, angle upwards, colours for what fails, and the
//! chosen path as a line.

use crate::canvas::{At, border, line, rect};
use crate::overlay::legend::ticks;
use crate::overlay::unit;
use crate::paint::{FAINT, INK};
use crate::text::{Anchor, Ink, Pen};
use crate::{RenderError, check_size};
use image::{Rgba, RgbaImage};
use sim::motion::{Across, MapState, SpinMap};

/// Colours of pairs that come too near; more pairs than colours share the last.
const HITS: [u32; 6] = [0xDC2626, 0xF472B6, 0x7F1D1D, 0xFB923C, 0x9F1239, 0xA16207];
const PATH: u32 = 0x1D4ED8;

/// Draws a map under a title; `size_px` as for any picture.
///
/// # Errors
/// A size that cannot be drawn.
pub fn spin_map(map: &SpinMap, title: &str, size_px: (u32, u32)) -> Result<RgbaImage, RenderError> {
    check_size(size_px)?;
    let pen = Pen::new()?;
    let u = unit(size_px);
    let (width, height) = (size_px.0 as f32, size_px.1 as f32);
    let mut image = RgbaImage::from_pixel(size_px.0, size_px.1, Rgba([255; 4]));
    let ink = Ink { size: 27.0 * u, rgb: INK, halo: 0.0 };
    let text = pen.cut(title, ink.size, width - 40.0 * u);
    pen.write(&mut image, [20.0 * u, 34.0 * u], Anchor::Left, ink, &text);
    let key = 330.0 * u;
    let field = Field {
        map,
        low: [96.0 * u, 72.0 * u],
        size: [width - key - 130.0 * u, height - 160.0 * u],
    };
    field.cells(&mut image);
    field.path(&mut image, u);
    field.axes(&mut image, &pen, u);
    legend(&mut image, &pen, map, [field.low[0] + field.size[0] + 34.0 * u, field.low[1]], key, u);
    rect(&mut image, [0.0, 0.0], [width, 4.0 * u], INK, 1.0);
    Ok(image)
}

/// The coloured box.
struct Field<'a> {
    map: &'a SpinMap,
    low: At,
    size: At,
}

impl Field<'_> {
    fn columns(&self) -> usize {
        self.map.at_m.len().max(1)
    }

    /// Half the distance of two rows, rad.
    fn half_row(&self) -> f64 {
        let angles = &self.map.angles_rad;
        if angles.len() > 1 { (angles[1] - angles[0]) / 2.0 } else { 0.5 }
    }

    /// Lowest and highest angle of the box.
    fn range(&self) -> [f64; 2] {
        let angles = &self.map.angles_rad;
        let ends = [angles.first(), angles.last()].map(|a| a.copied().unwrap_or(0.0));
        [ends[0] - self.half_row(), ends[1] + self.half_row()]
    }

    fn length_m(&self) -> f64 {
        self.map.at_m.last().copied().unwrap_or(0.0).max(1e-9)
    }

    fn x(&self, at_m: f64) -> f32 {
        self.low[0] + self.size[0] * (at_m / self.length_m()).clamp(0.0, 1.0) as f32
    }

    fn y(&self, angle_rad: f64) -> f32 {
        let [from, to] = self.range();
        let share = ((angle_rad - from) / (to - from)).clamp(0.0, 1.0);
        self.low[1] + self.size[1] * (1.0 - share as f32)
    }

    /// Every cell reaches half way to its neighbours.
    fn cells(&self, image: &mut RgbaImage) {
        let at = &self.map.at_m;
        let edge = |k: usize| match k {
            0 => 0.0,
            _ if k >= at.len() => self.length_m(),
            _ => (at[k - 1] + at[k]) / 2.0,
        };
        for (row, &angle) in self.map.angles_rad.iter().enumerate() {
            let (top, bottom) = (self.y(angle + self.half_row()), self.y(angle - self.half_row()));
            for column in 0..self.columns() {
                let Some(state) = self.map.states.get(row * self.columns() + column) else {
                    return;
                };
                let (left, right) = (self.x(edge(column)), self.x(edge(column + 1)));
                let low = [left.round(), top.round()];
                let size = [right.round() - low[0], bottom.round() - low[1]];
                rect(image, low, size, colour(*state), 1.0);
            }
        }
    }

    /// The chosen path; it leaves at one edge and comes in at the other where it passes half a turn.
    fn path(&self, image: &mut RgbaImage, u: f32) {
        let [from, to] = self.range();
        let places: Vec<At> =
            self.map.chosen.iter().map(|&(s, a)| [self.x(s), self.y(a)]).collect();
        for (rgb, width) in [(0xFFFFFF, 7.0 * u), (PATH, 3.5 * u)] {
            for (pair, angles) in places.windows(2).zip(self.map.chosen.windows(2)) {
                if (angles[1].1 - angles[0].1).abs() < (to - from) / 2.0 {
                    line(image, pair[0], pair[1], width, rgb, 1.0);
                }
            }
        }
    }

    fn axes(&self, image: &mut RgbaImage, pen: &Pen, u: f32) {
        border(image, self.low.map(f32::round), self.size.map(f32::round), FAINT, u.max(1.0));
        let ink = Ink { size: 18.0 * u, rgb: INK, halo: 0.0 };
        let bottom = self.low[1] + self.size[1];
        for (mm, text) in ticks(0.0, self.length_m() * 1e3) {
            let x = self.x(mm / 1e3);
            line(image, [x, bottom], [x, bottom + 6.0 * u], 1.4 * u, FAINT, 1.0);
            pen.write(image, [x, bottom + 20.0 * u], Anchor::Centre, ink, &text);
        }
        let [from, to] = self.range().map(f64::to_degrees);
        let step = if to - from > 200.0 { 60.0 } else { 20.0 };
        let first = (from / step).ceil() as i64;
        for degrees in (first..).map(|k| k as f64 * step).take_while(|&degrees| degrees <= to) {
            let y = self.y(degrees.to_radians());
            line(image, [self.low[0] - 6.0 * u, y], [self.low[0], y], 1.4 * u, FAINT, 1.0);
            let text = format!("{degrees:.0}°");
            pen.write(image, [self.low[0] - 11.0 * u, y], Anchor::Right, ink, &text);
        }
        let (across, up) = (self.low[0] + self.size[0] / 2.0, 52.0 * u);
        let caption = Ink { size: 18.0 * u, rgb: FAINT, halo: 0.0 };
        pen.write(image, [across, bottom + up], Anchor::Centre, caption, "along the strand, mm");
        let at = [20.0 * u, self.low[1] - 14.0 * u];
        pen.write(image, at, Anchor::Left, caption, axis_title(self.map.across));
    }
}

fn axis_title(across: Across) -> &'static str {
    match across {
        Across::Spin => "spin about the nozzle's axis, from the bed's x",
        Across::Tilt => "lean of the nozzle in the plane of travel, positive: it trails",
        Across::Elbow => "elbow angle about the line shoulder – wrist",
    }
}

/// What every colour means, with the share of the map it takes; only what is in the map.
fn legend(image: &mut RgbaImage, pen: &Pen, map: &SpinMap, at: At, room: f32, u: f32) {
    let mut y = at[1] + 10.0 * u;
    let mut entry = |image: &mut RgbaImage, rgb: u32, text: &str, path: bool| {
        if path {
            line(image, [at[0], y], [at[0] + 18.0 * u, y], 3.5 * u, rgb, 1.0);
        } else {
            rect(image, [at[0], y - 8.0 * u], [18.0 * u, 16.0 * u], rgb, 1.0);
            border(image, [at[0], y - 8.0 * u], [18.0 * u, 16.0 * u], FAINT, u.max(1.0));
        }
        let ink = Ink { size: 18.0 * u, rgb: INK, halo: 0.0 };
        let text = pen.cut(text, ink.size, room - 34.0 * u);
        pen.write(image, [at[0] + 28.0 * u, y], Anchor::Left, ink, &text);
        y += 27.0 * u;
    };
    entry(image, PATH, "chosen path", true);
    let states = [
        MapState::Clear,
        MapState::NearSingular,
        MapState::Unreached,
        MapState::Stop,
        MapState::Singular,
        MapState::Fast,
    ];
    let hits = (0..map.pairs.len()).map(MapState::Hits);
    let n_all = map.states.len().max(1);
    let mut all: Vec<(usize, MapState)> = states
        .into_iter()
        .chain(hits)
        .map(|state| (map.states.iter().filter(|s| **s == state).count(), state))
        .filter(|(count, _)| *count > 0)
        .collect();
    all.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
    // What is clear stands first, whatever its share.
    all.sort_by_key(|(_, state)| !matches!(state, MapState::Clear | MapState::NearSingular));
    let n_told = 22.min(all.len());
    for (count, state) in &all[..n_told] {
        let share = 100.0 * *count as f64 / n_all as f64;
        entry(image, colour(*state), &format!("{share:.0} % {}", words(map, *state)), false);
    }
    if all.len() > n_told {
        entry(image, HITS[HITS.len() - 1], &format!("{} more pairs", all.len() - n_told), false);
    }
}

fn words(map: &SpinMap, state: MapState) -> String {
    match state {
        MapState::Clear => "clear".to_owned(),
        MapState::NearSingular => "clear, near a singularity".to_owned(),
        MapState::Unreached => "out of reach".to_owned(),
        MapState::Stop => "joint at its stop".to_owned(),
        MapState::Singular => "singular".to_owned(),
        MapState::Fast => "joint too fast".to_owned(),
        MapState::Hits(pair) => {
            let names = map.pairs.get(pair);
            names.map_or_else(String::new, |[a, b]| format!("{a} too near {b}"))
        }
    }
}

fn colour(state: MapState) -> u32 {
    match state {
        MapState::Clear => 0xFFFFFF,
        MapState::NearSingular => 0xFEF3C7,
        MapState::Unreached => 0x4B5563,
        MapState::Stop => 0x9CA3AF,
        MapState::Singular => 0xC4B5FD,
        MapState::Fast => 0xFDE047,
        MapState::Hits(pair) => HITS[pair.min(HITS.len() - 1)],
    }
}
