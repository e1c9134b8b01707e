//! The centreline as printed, from the side and from above.

use super::axis::{Axis, ends};
use super::chart::{Chart, Words};
use super::text::{Scale, short};
use crate::results::Strand;

const HEIGHT: f64 = 150.0;
/// Most points drawn.
const POINTS: usize = 130;
/// A chord that is less than this share of what the line fills is none.
const CHORD: f64 = 0.1;
/// Deviations below this share of what the line fills are drawn larger.
const TINY: f64 = 0.05;
/// Deviations drawn larger fill this share.
const SHOWN: f64 = 0.15;
/// Smaller deviations are not told from straight, mm.
const STRAIGHT_MM: f64 = 1e-4;
/// Largest factor.
const FACTOR: f64 = 1000.0;
/// Empty rim round the line, as a share of the field.
const RIM: f64 = 0.06;

type Flat = [f64; 2];

/// Both views, each with its caption.
pub(super) fn views(strand: &Strand, id: &str) -> String {
    let points = points_mm(strand);
    let [Some(first), Some(last)] = [points.first(), points.last()] else { return String::new() };
    let (mut across, mut along) = ([0.0, 1.0], [1.0, 0.0]);
    let chord = [last[0] - first[0], last[1] - first[1]];
    let length = chord[0].hypot(chord[1]);
    let by_chord = length > CHORD * fill(&points.iter().map(|p| [p[0], p[1]]).collect::<Vec<_>>());
    if by_chord {
        along = [chord[0] / length, chord[1] / length];
        across = [-along[1], along[0]];
    }
    let part = |p: &[f64; 3], axis: Flat| (p[0] - first[0]) * axis[0] + (p[1] - first[1]) * axis[1];
    let side: Vec<Flat> = points.iter().map(|p| [part(p, along), p[2]]).collect();
    let above: Vec<Flat> = points.iter().map(|p| [part(p, along), part(p, across)]).collect();
    let along = if by_chord { "along the chord, mm" } else { "x from the start, mm" };
    let across = if by_chord { "across the chord, mm" } else { "y from the start, mm" };
    let plane = if by_chord { "the upright plane of its chord" } else { "the plane of x and z" };
    let seen = format!("The centreline as printed, from the side, in {plane}");
    view(&side, [along, "height, mm"], &format!("{id}-side"), &seen)
        + &view(
            &above,
            [along, across],
            &format!("{id}-above"),
            "The centreline as printed, from above",
        )
}

/// Finite points, mm, at most [`POINTS`], both ends among them.
fn points_mm(strand: &Strand) -> Vec<[f64; 3]> {
    let mm = |point: &[f64; 3]| {
        let [x, y, z] = point.map(|m| Scale::MILLIMETRE.of(Some(m)));
        Some([x?, y?, z?])
    };
    let all: Vec<[f64; 3]> = strand.centreline_m.iter().filter_map(mm).collect();
    let told = all.len().min(POINTS);
    let last = all.len().saturating_sub(1);
    (0..told).map(|k| all[if told > 1 { k * last / (told - 1) } else { 0 }]).collect()
}

/// Longer side of the box the line fills.
fn fill(points: &[Flat]) -> f64 {
    let side = |k: usize| ends(points.iter().map(|p| p[k])).map_or(0.0, |[low, high]| high - low);
    side(0).max(side(1))
}

/// Straight line between the ends, and how far the points lie off it, to the left.
struct Chord {
    start: Flat,
    along: Flat,
    length: f64,
}

impl Chord {
    fn of(points: &[Flat]) -> Option<Self> {
        let (start, end) = (*points.first()?, *points.last()?);
        let way = [end[0] - start[0], end[1] - start[1]];
        let length = way[0].hypot(way[1]);
        (length > CHORD * fill(points) && length > 0.0).then(|| Self {
            start,
            along: way.map(|part| part / length),
            length,
        })
    }

    /// Along and off the chord.
    fn parts(&self, point: Flat) -> Flat {
        let [x, y] = [point[0] - self.start[0], point[1] - self.start[1]];
        [x * self.along[0] + y * self.along[1], y * self.along[0] - x * self.along[1]]
    }

    fn point(&self, [along, off]: Flat) -> Flat {
        [
            self.start[0] + along * self.along[0] - off * self.along[1],
            self.start[1] + along * self.along[1] + off * self.along[0],
        ]
    }
}

fn view(points: &[Flat], names: [&str; 2], id: &str, title: &str) -> String {
    let chord = Chord::of(points);
    let offs = || chord.iter().flat_map(|chord| points.iter().map(move |&p| chord.parts(p)[1]));
    let most = offs().fold(0.0, |most: f64, off| most.max(off.abs()));
    let factor = chord.as_ref().map_or(1.0, |_| factor(most, fill(points)));
    let drawn: Vec<Flat> = match &chord {
        Some(chord) if factor > 1.0 => points
            .iter()
            .map(|&p| {
                let [along, off] = chord.parts(p);
                chord.point([along, factor * off])
            })
            .collect(),
        _ => points.to_vec(),
    };
    let straight: Vec<Flat> =
        chord.iter().flat_map(|chord| [0.0, chord.length].map(|s| chord.point([s, 0.0]))).collect();
    let [x, y] = equal(drawn.iter().chain(&straight).copied());
    let mut chart = Chart::new(x, y, names, HEIGHT);
    let line = |points: &[Flat]| points.iter().map(|p| (p[0], Some(p[1]))).collect::<Vec<_>>();
    chart.line("chord", &line(&straight));
    chart.line("one", &line(&drawn));
    if let Some(start) = drawn.first() {
        chart.line("start", &line(&[*start]));
    }
    let desc = describe(chord.is_some(), most, factor);
    let svg = chart.finish(&Words { id, title, desc: &desc });
    format!("<figure>{svg}<figcaption>{title}. {desc}</figcaption></figure>")
}

fn describe(has_chord: bool, most: f64, factor: f64) -> String {
    let ends = "Equal scales; the dot is its start.";
    match (has_chord, most > STRAIGHT_MM, factor > 1.0) {
        (false, _, _) => ends.to_owned(),
        (_, false, _) => format!("Straight as seen from here. {ends}"),
        (_, _, true) => format!(
            "Up to {} mm off its chord (dashed), drawn {factor:.0} times as large. {ends}",
            short(most)
        ),
        _ => format!("Up to {} mm off its chord (dashed). {ends}", short(most)),
    }
}

/// 1, 2, 5, 10 … by which a deviation is drawn larger, so that it can be seen.
fn factor(most: f64, fill: f64) -> f64 {
    if most <= STRAIGHT_MM || most >= TINY * fill {
        return 1.0;
    }
    let wanted = (SHOWN * fill / most).min(FACTOR);
    let power = 10f64.powf(wanted.log10().floor());
    let round = [5.0, 2.0, 1.0].into_iter().find(|round| round * power <= wanted);
    round.unwrap_or(1.0) * power
}

/// Axes of one scale that hold all points in the middle of the field.
fn equal(points: impl Iterator<Item = Flat> + Clone) -> [Axis; 2] {
    let [wide, high] = Chart::field(HEIGHT);
    let over = |k: usize| ends(points.clone().map(|p| p[k])).unwrap_or([0.0, 0.0]);
    let [x, y] = [over(0), over(1)];
    let scale = ((x[1] - x[0]) / wide).max((y[1] - y[0]) / high) / (1.0 - 2.0 * RIM);
    let scale = if scale > 1e-6 { scale } else { 1.0 / wide };
    let axis = |[low, high]: [f64; 2], field: f64| {
        let middle = 0.5 * (low + high);
        let half = 0.5 * scale * field;
        Axis::within(middle - half, middle + half, (field / 30.0) as usize)
    };
    [axis(x, wide), axis(y, high)]
}
