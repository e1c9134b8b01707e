//! Numbers against time.

use super::cell::colour;
use super::tape::{Tape, packing, path};
use crate::RecordError;
use crate::paint;
use rerun::components::InterpolationMode;
use rerun::{EntityPath, Scalars, SeriesLines};
use sim::film::{Film, Trace, TraceOf};

/// Points of one line; of more, the least and the largest of each stretch are kept.
const POINTS_MAX: usize = 20_000;
/// Characters of a joint's name.
const NAME_MAX: usize = 60;

/// A plot: traces that share an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Plot {
    /// Its name in paths.
    pub(super) name: &'static str,
    /// Its heading, with the unit.
    pub(super) title: &'static str,
    /// The tab it stands on.
    pub(super) tab: &'static str,
}

/// The plot of a trace.
pub(super) fn plot_of(of: TraceOf) -> Plot {
    let (name, title, tab) = match of {
        TraceOf::Speed => ("nozzle_speed", "nozzle speed, mm/s", "Motion"),
        TraceOf::Joint(_) => ("joint_speed", "joint speed, % of limit", "Motion"),
        TraceOf::Clearance => ("clearance", "least clearance of the leg, mm", "Motion"),
        TraceOf::Temperature => ("temperature", "newest strand's start, °C", "Process"),
        TraceOf::Cure => ("cure", "newest strand's start, cure %", "Process"),
        TraceOf::Sag => ("sag", "sag behind the nozzle, mm", "Process"),
        TraceOf::Displacement => ("displacement", "displacement by weight, mm", "Structure"),
        TraceOf::Buckling => ("buckling", "buckling factor on weight", "Structure"),
    };
    Plot { name, title, tab }
}

/// All traces, each with a line at its limit.
pub(super) fn plots(tape: &Tape, film: &Film, traces: &[Trace]) -> Result<(), RecordError> {
    for trace in traces {
        let plot = plot_of(trace.of);
        let (name, rgb) = line_of(film, trace.of);
        let at = path(["plots", plot.name, &name]);
        let mode =
            if trace.steps { InterpolationMode::StepAfter } else { InterpolationMode::Linear };
        let style = SeriesLines::new()
            .with_names([name.as_str()])
            .with_colors([colour(rgb)])
            .with_widths([1.6_f32])
            .with_interpolation_mode(mode);
        tape.still(at.clone(), &style)?;
        line(tape, at, &thin(&trace.points), |value| trace.of.on_screen(value))?;
        if let Some(limit) = trace.limit.filter(|limit| limit.is_finite()) {
            let at = path(["plots", plot.name, "limit"]);
            let style = SeriesLines::new()
                .with_names(["limit"])
                .with_colors([colour(paint::severity(sim::scene::MarkSeverity::Error))])
                .with_widths([1.0_f32]);
            tape.still(at.clone(), &style)?;
            let ends = [[0.0, limit], [film.total_s, limit]];
            line(tape, at, &ends, |value| trace.of.on_screen(value))?;
        }
    }
    Ok(())
}

/// A value that is not finite is a row without a value, which ends the line before it.
fn line(
    tape: &Tape,
    at: EntityPath,
    points: &[[f64; 2]],
    on_screen: impl Fn(f64) -> f64,
) -> Result<(), RecordError> {
    let times_s: Vec<f64> = points.iter().map(|point| point[0]).collect();
    let finite = points.iter().map(|point| on_screen(point[1])).filter(|value| value.is_finite());
    let lengths: Vec<usize> =
        points.iter().map(|p| usize::from(on_screen(p[1]).is_finite())).collect();
    let columns = Scalars::new(finite).columns(lengths).map_err(packing)?;
    tape.rows(at, &times_s, columns)
}

/// Name and colour of a line.
fn line_of(film: &Film, of: TraceOf) -> (String, paint::Rgb) {
    // Okabe and Ito: told apart by colour-blind eyes
    const LINES: [paint::Rgb; 7] = [
        [0x56, 0xB4, 0xE9],
        [0xE6, 0x9F, 0x00],
        [0x00, 0x9E, 0x73],
        [0xF0, 0xE4, 0x42],
        [0x00, 0x72, 0xB2],
        [0xD5, 0x5E, 0x00],
        [0xCC, 0x79, 0xA7],
    ];
    match of {
        TraceOf::Joint(index) => {
            let name = film.joints.get(index).map_or("joint", |joint| &joint.name);
            // "limit" is the line of the limit
            let name: String = name.chars().take(NAME_MAX).collect();
            (format!("{} {name}", index + 1), LINES[index % LINES.len()])
        }
        other => (plot_of(other).name.replace('_', " "), LINES[0]),
    }
}

/// At most [`POINTS_MAX`] points: of each stretch the lowest and the highest, in order of time.
fn thin(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    if points.len() <= POINTS_MAX {
        return points.to_vec();
    }
    let each = (2 * points.len()).div_ceil(POINTS_MAX);
    let extremes = points.chunks(each).flat_map(|stretch| {
        let by = |a: &&[f64; 2], b: &&[f64; 2]| a[1].total_cmp(&b[1]);
        let mut two = [stretch.iter().min_by(by), stretch.iter().max_by(by)];
        two.sort_by(|a, b| a.map_or(0.0, |p| p[0]).total_cmp(&b.map_or(0.0, |p| p[0])));
        two.into_iter().flatten().copied()
    });
    extremes.collect()
}
