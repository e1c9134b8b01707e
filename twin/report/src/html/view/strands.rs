//! Strands as runs of points with times and values.

use super::blob::Blob;
use super::grid::Grid;
use serde_json::{Value, json};
use sim::film::{Ageing, Film, FilmStrand, Painted, Quantity};
use sim::pose::{Point, is_finite_point};
use std::collections::BTreeMap;

/// A value at the high end of its scale; codes above are no places on the scale.
pub(super) const TOP: u16 = 65_000;
/// Below the scale.
pub(super) const UNDER: u16 = 65_533;
/// Above the scale.
pub(super) const OVER: u16 = 65_534;
/// Not known.
pub(super) const UNKNOWN: u16 = 65_535;
/// Tables of age at most; strands beyond them have no temperature and cure.
const AGEINGS_MAX: usize = 2048;

/// Which points of which strands are told.
#[derive(Debug, Clone)]
pub(super) struct Kept {
    /// Place in the film and numbers of the points.
    pub(super) strands: Vec<(usize, Vec<usize>)>,
}

impl Kept {
    /// Everything that is finite; a strand needs two points.
    pub(super) fn all(film: &Film) -> Kept {
        let strands = film.strands.iter().enumerate().map(|(order, strand)| {
            let sound = |&k: &usize| {
                strand.planned.get(k).is_some_and(is_finite_point)
                    && is_finite_point(&strand.points[k])
                    && strand.time_s.get(k).is_some_and(|time_s| time_s.is_finite())
            };
            (order, (0..strand.points.len()).filter(sound).collect::<Vec<_>>())
        });
        let sound = |(order, points): &(usize, Vec<usize>)| {
            points.len() > 1 && film.strands[*order].radius_m.is_finite()
        };
        Kept { strands: strands.filter(sound).collect() }
    }

    pub(super) fn points(&self) -> usize {
        self.strands.iter().map(|(_, points)| points.len()).sum()
    }

    pub(super) fn segments(&self) -> usize {
        self.points() - self.strands.len()
    }

    /// Room they take with the values that the film has.
    pub(super) fn bytes(&self, film: &Film) -> usize {
        let values =
            |of: &str| film.painted.iter().filter(|it| source(it.quantity) == of).count() * 2;
        self.points() * (POINT_BYTES + values("segment"))
            + self.strands.len() * (STRAND_BYTES + values("strand"))
    }
}

/// Place, time and way to the planned place.
const POINT_BYTES: usize = 6 + 2 + 3;
/// Number of points, place in the film, birth, span, radius, way's unit, and table of age.
const STRAND_BYTES: usize = 4 + 4 + 8 + 4 + 4 + 4 + 2;

/// Place of a value on its scale.
pub(super) fn level(painted: &Painted, value: Option<f64>) -> u16 {
    let Some(value) = value.map(|value| painted.quantity.on_screen(value)) else {
        return UNKNOWN;
    };
    let scale = &painted.scale;
    match value {
        v if !v.is_finite() => UNKNOWN,
        v if v > scale.high => OVER,
        v if v < scale.low => UNDER,
        v => ((v - scale.low) / (scale.high - scale.low) * f64::from(TOP)).round() as u16,
    }
}

/// Writes what is kept. The heading: the box of all places.
pub(super) fn write(film: &Film, kept: &Kept, blob: &mut Blob) -> Value {
    let each =
        || kept.strands.iter().map(|(order, points)| (&film.strands[*order], *order, points));
    let places = each().flat_map(|(strand, _, points)| points.iter().map(|&k| strand.points[k]));
    let grid = Grid::about(places.clone());
    blob.u32s("strand_points", each().map(|(_, _, points)| points.len() as u32));
    blob.u32s("strand_order", each().map(|(_, order, _)| order as u32));
    blob.f32s("strand_radius", each().map(|(strand, ..)| strand.radius_m));
    blob.u16s("point_at", places.flat_map(|place| grid.code(&place)));
    times(film, kept, blob);
    planned(film, kept, blob);
    values(film, kept, blob);
    let ageing = ageings(film, kept, blob);
    json!({ "box": grid.told(), "ageing": ageing })
}

/// Birth, span and the share of it at every point.
fn times(film: &Film, kept: &Kept, blob: &mut Blob) {
    let each = || kept.strands.iter().map(|(order, points)| (&film.strands[*order], points));
    let ends = |(strand, points): (&FilmStrand, &Vec<usize>)| {
        [points[0], points[points.len() - 1]].map(|k| strand.time_s[k])
    };
    blob.f64s("strand_born", each().map(|both| ends(both)[0]));
    blob.f32s("strand_span", each().map(|both| ends(both)[1] - ends(both)[0]));
    let shares = each().flat_map(|(strand, points)| {
        let [born_s, done_s] = ends((strand, points));
        points.iter().map(move |&k| {
            let share = (strand.time_s[k] - born_s) / (done_s - born_s);
            // no span, no share: the cast makes 0 of NaN
            (share * 65535.0).round() as u16
        })
    });
    blob.u16s("point_when", shares);
}

/// From as printed to as planned, in steps of each strand.
fn planned(film: &Film, kept: &Kept, blob: &mut Blob) {
    let each = kept.strands.iter().map(|(order, points)| {
        let strand = &film.strands[*order];
        let ways = points.iter().map(|&k| strand.planned[k] - strand.points[k]);
        (ways.clone(), ways.fold(0.0, |most: f64, way| most.max(way.amax())) / 127.0)
    });
    let each: Vec<_> = each.collect();
    blob.f32s("strand_way", each.iter().map(|(_, step_m)| *step_m));
    let codes = each.into_iter().flat_map(|(ways, step_m)| {
        ways.flat_map(move |way| {
            let code = |x: f64| if step_m > 0.0 { (x / step_m).round() as i8 } else { 0 };
            [code(way.x), code(way.y), code(way.z)]
        })
    });
    blob.i8s("point_way", codes);
}

/// Values that do not change with time, of each strand or of each segment by its first point.
fn values(film: &Film, kept: &Kept, blob: &mut Blob) {
    for painted in &film.painted {
        let quantity = painted.quantity;
        match source(quantity) {
            "strand" => {
                let value = |(order, _): &(usize, Vec<usize>)| {
                    level(painted, film.strands[*order].value(*order, 0, quantity, film.total_s))
                };
                blob.u16s(quantity.word(), kept.strands.iter().map(value));
            }
            "segment" => {
                let value = |order: usize, k: usize| {
                    level(painted, film.strands[order].value(order, k, quantity, film.total_s))
                };
                let all = kept
                    .strands
                    .iter()
                    .flat_map(|(order, points)| points.iter().map(move |&k| value(*order, k)));
                blob.u16s(quantity.word(), all);
            }
            _ => {}
        }
    }
}

/// Where the viewer finds a quantity.
pub(super) fn source(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Order => "order",
        Quantity::Age => "age",
        Quantity::Temperature | Quantity::Cure => "ageing",
        Quantity::BeadWidth | Quantity::Speed | Quantity::Displacement | Quantity::Utilisation => {
            "segment"
        }
        Quantity::Sag | Quantity::Clearance => "strand",
    }
}

/// Tables of age, each told once, and the number of every strand's. The heading: ages of a table.
fn ageings(film: &Film, kept: &Kept, blob: &mut Blob) -> Value {
    let painted: Vec<&Painted> =
        film.painted.iter().filter(|painted| source(painted.quantity) == "ageing").collect();
    let mut known: BTreeMap<Vec<u8>, u16> = BTreeMap::new();
    let mut tables: Vec<Table> = Vec::new();
    let numbers: Vec<u16> = kept
        .strands
        .iter()
        .map(|(order, _)| {
            let Some(table) = Table::of(&film.strands[*order].ageing, &painted) else {
                return u16::MAX;
            };
            match known.get(&table.key()) {
                Some(number) => *number,
                None if tables.len() >= AGEINGS_MAX => u16::MAX,
                None => {
                    let number = tables.len() as u16;
                    known.insert(table.key(), number);
                    tables.push(table);
                    number
                }
            }
        })
        .collect();
    blob.u16s("strand_ageing", numbers);
    blob.f32s("ageing_last", tables.iter().map(|table| table.last_s));
    for (k, painted) in painted.iter().enumerate() {
        let column = tables.iter().flat_map(|table| table.levels[k].iter().copied());
        blob.u8s(painted.quantity.word(), column);
    }
    json!(AGES)
}

/// Ages of a table, crowded while the strand is young: the k-th of n at `last_s (k / (n - 1))²`.
pub(super) const AGES: usize = 24;

/// Columns of one ageing.
struct Table {
    last_s: f64,
    /// For each quantity: places on its scale in 250 steps, 255 where not known.
    levels: Vec<[u8; AGES]>,
}

impl Table {
    fn of(ageing: &Ageing, painted: &[&Painted]) -> Option<Table> {
        let last_s = ageing.age_s.last().copied().filter(|last_s| last_s.is_finite())?;
        let level_at = |painted: &Painted, k: usize| {
            let age_s = last_s * (k as f64 / (AGES - 1) as f64).powi(2);
            let column = match painted.quantity {
                Quantity::Temperature => &ageing.temperature_k,
                _ => &ageing.cure,
            };
            match level(painted, ageing.at(column, age_s)) {
                UNKNOWN => 255,
                OVER => 250,
                UNDER => 0,
                level => ((u32::from(level) * 250 + u32::from(TOP) / 2) / u32::from(TOP)) as u8,
            }
        };
        let levels = painted.iter().map(|painted| std::array::from_fn(|k| level_at(painted, k)));
        // tables that differ by less than an eye sees are one: ages in steps of 1 %
        let step = 0.01_f64.ln_1p();
        let last_s = if last_s > 0.0 { ((last_s.ln() / step).round() * step).exp() } else { 0.0 };
        Some(Table { last_s, levels: levels.collect() })
    }

    fn key(&self) -> Vec<u8> {
        let ages = self.last_s.to_le_bytes();
        ages.into_iter().chain(self.levels.iter().flatten().copied()).collect()
    }
}

/// The kept points without those that lie within `off_m` of the line between their neighbours; all but the
/// ends of a strand where `off_m` is infinite. O(n).
pub(super) fn thinner(film: &Film, kept: &Kept, off_of: impl Fn(&FilmStrand) -> f64) -> Kept {
    let strands = kept.strands.iter().map(|(order, points)| {
        let strand = &film.strands[*order];
        (*order, straighter(&strand.points, points, off_of(strand)))
    });
    Kept { strands: strands.collect() }
}

/// Points that one line may stand for.
const REACH: usize = 64;

fn straighter(places: &[Point], points: &[usize], off_m: f64) -> Vec<usize> {
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else { return Vec::new() };
    if off_m == f64::INFINITY {
        return vec![first, last];
    }
    let mut out = vec![first];
    let mut from = 0;
    for k in 1..points.len() - 1 {
        let line = [places[points[from]], places[points[k + 1]]];
        let near = (from + 1..=k).all(|j| distance(&line, &places[points[j]]) <= off_m);
        if !near || k - from >= REACH {
            out.push(points[k]);
            from = k;
        }
    }
    out.push(last);
    out
}

/// From a point to a line between two.
fn distance([a, b]: &[Point; 2], p: &Point) -> f64 {
    let (way, to) = (b - a, p - a);
    let share = way.dot(&to) / way.norm_squared();
    let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
    (to - way * share).norm()
}
