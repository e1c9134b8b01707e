//! Strands as curves by arc length, with the nozzle's axis, speed and flow at each place.
//!
//! Everything is in part axes. Between points a strand is straight.

mod direction;
#[cfg(test)]
mod tests;

pub use direction::{Forms, tilted};

use crate::cell::{Follow, Job, Strand};
use crate::pose::{Point, Vector};

/// Largest distance between samples of a strand, m. Joint path and clearance are looked at
/// there; `motion` and `collision` state what they do in between.
pub const STEP_M: f64 = 4e-3;

/// Turn of the polyline at a vertex beyond which the vertex itself is a sample, rad.
const CORNER_RAD: f64 = 0.02;

/// One place on a strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Arc length from the start, m; beyond the strand's length in the overrun.
    pub at_m: f64,
    /// Place of the nozzle's orifice.
    pub point: Point,
    /// Direction of travel, unit.
    pub tangent: Vector,
    /// Nozzle axis, unit, out of the nozzle.
    pub nozzle: Vector,
    /// Asked TCP speed, m/s.
    pub speed_m_s: f64,
    /// Flow the extruder is told, m³/s; zero in the overrun.
    pub flow_m3_s: f64,
    /// Whether a vertex of the strand stands here.
    pub vertex: bool,
}

/// A strand, sampled.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// Index of the strand in the job.
    pub strand: usize,
    /// Length of what is extruded, m.
    pub length_m: f64,
    /// The samples, by arc length; the last ones may lie in the overrun.
    pub samples: Vec<Sample>,
}

/// All strands of a job, sampled; in the job's order.
pub fn paths(job: &Job) -> Vec<Path> {
    let up = job.bed_from_part.inverse_transform_vector(&Vector::z());
    let bed_x = job.bed_from_part.inverse_transform_vector(&Vector::x());
    let forms = direction::Forms::new(&job.forms, up);
    job.strands
        .iter()
        .enumerate()
        .map(|(index, strand)| {
            path(index, strand, &direction::Surroundings { up, bed_x, forms: &forms })
        })
        .collect()
}

fn path(index: usize, strand: &Strand, around: &direction::Surroundings<'_>) -> Path {
    let stations = stations(&strand.points);
    let length_m = stations.last().copied().unwrap_or(0.0);
    let nozzle = vertex_directions(strand, around);
    let mut samples = Vec::new();
    let places = sample_places(strand, &stations);
    let mut segment = 0;
    for at_m in places {
        while segment + 2 < stations.len() && at_m > stations[segment + 1] {
            segment += 1;
        }
        let (a, b) = (strand.points[segment], strand.points[segment + 1]);
        let share = ((at_m - stations[segment]) / (stations[segment + 1] - stations[segment]))
            .clamp(0.0, 1.0);
        let (speed_m_s, flow_m3_s) = speed_and_flow(strand, &stations, at_m);
        samples.push(Sample {
            at_m,
            point: a + (b - a) * share,
            tangent: (b - a).normalize(),
            nozzle: nozzle_between(&nozzle[segment], &nozzle[segment + 1], share),
            speed_m_s,
            flow_m3_s,
            vertex: stations.binary_search_by(|station| station.total_cmp(&at_m)).is_ok(),
        });
    }
    add_overrun(&mut samples, strand.settings.overrun_m);
    Path { strand: index, length_m, samples }
}

/// Arc length at each vertex, m.
pub fn stations(points: &[Point]) -> Vec<f64> {
    let mut at_m = 0.0;
    let mut stations = vec![0.0];
    for pair in points.windows(2) {
        at_m += (pair[1] - pair[0]).norm();
        stations.push(at_m);
    }
    stations
}

/// Arc lengths of the samples: ends, corners, changes of the profile, evenly in between. Where the
/// strand brings joint rows or times, which belong to vertices, every vertex is a sample.
fn sample_places(strand: &Strand, stations: &[f64]) -> Vec<f64> {
    let every_vertex = strand.joints.is_some() || strand.times_s.is_some();
    let points = &strand.points;
    let is_corner = |k: usize| {
        let (before, after) = (points[k] - points[k - 1], points[k + 1] - points[k]);
        every_vertex || before.angle(&after) > CORNER_RAD
    };
    let length_m = stations.last().copied().unwrap_or(0.0);
    let corners = (1..points.len().saturating_sub(1)).filter(|&k| is_corner(k));
    let changes = strand.profile.iter().map(|point| point.at_m);
    let mut marks: Vec<f64> = corners.map(|k| stations[k]).chain(changes).collect();
    marks.retain(|&at_m| at_m > 0.0 && at_m < length_m);
    marks.extend([0.0, length_m]);
    marks.sort_by(f64::total_cmp);
    let mut places = vec![0.0];
    let marks = if every_vertex { marks } else { thin_out(marks) };
    for pair in marks.windows(2).filter(|pair| pair[1] > pair[0]) {
        let n_steps = ((pair[1] - pair[0]) / STEP_M).ceil().max(1.0) as usize;
        let step_m = (pair[1] - pair[0]) / n_steps as f64;
        places.extend((1..n_steps).map(|k| pair[0] + step_m * k as f64));
        places.push(pair[1]);
    }
    places
}

/// Drops marks nearer than a quarter step to the one before, keeping both ends: a finely drawn
/// curve has a corner at every vertex and needs no sample at each.
fn thin_out(marks: Vec<f64>) -> Vec<f64> {
    let n_marks = marks.len();
    let mut kept: Vec<f64> = Vec::with_capacity(n_marks);
    for (k, at_m) in marks.into_iter().enumerate() {
        let far = kept.last().is_none_or(|last| at_m - last >= STEP_M / 4.0);
        if far || k + 1 == n_marks {
            kept.push(at_m);
        }
    }
    kept
}

/// Direction between two, turning evenly; opposite ones have no way between them, so the first
/// is kept until the second is reached.
fn nozzle_between(from: &Vector, to: &Vector, share: f64) -> Vector {
    let mixed = from.lerp(to, share);
    if mixed.norm() > 1e-6 { mixed.normalize() } else { *from }
}

/// Speed and flow from `at_m` on. Given times decide the speed; the extruder is told what it would
/// be told at the asked one.
fn speed_and_flow(strand: &Strand, stations: &[f64], at_m: f64) -> (f64, f64) {
    let (mut speed_m_s, flow_m3_s) = strand.asked(at_m);
    if let Some(times_s) = &strand.times_s {
        let after = stations.partition_point(|&station| station <= at_m);
        let k = after.clamp(1, stations.len() - 1);
        speed_m_s = (stations[k] - stations[k - 1]) / (times_s[k] - times_s[k - 1]);
    }
    (speed_m_s, flow_m3_s)
}

/// Nozzle axis at each vertex; at an inner vertex the tangent is the mean of both sides.
fn vertex_directions(strand: &Strand, around: &direction::Surroundings<'_>) -> Vec<Vector> {
    if let (Follow::Given, Some(directions)) =
        (strand.settings.orientation.follow, &strand.directions)
    {
        return directions.clone();
    }
    let points = &strand.points;
    let side = |k: usize| (points[k + 1] - points[k]).normalize();
    let last = points.len() - 1;
    (0..points.len())
        .map(|k| {
            let tangent = match k {
                0 => side(0),
                _ if k == last => side(last - 1),
                _ => {
                    let mean = side(k - 1) + side(k);
                    if mean.norm() > 1e-6 { mean.normalize() } else { side(k) }
                }
            };
            around.nozzle_axis(strand, points[k], tangent)
        })
        .collect()
}

fn add_overrun(samples: &mut Vec<Sample>, overrun_m: f64) {
    let Some(&last) = samples.last() else { return };
    if overrun_m <= 0.0 {
        return;
    }
    let n_steps = (overrun_m / STEP_M).ceil() as usize;
    samples.extend((1..=n_steps).map(|k| {
        let further_m = overrun_m * k as f64 / n_steps as f64;
        Sample {
            at_m: last.at_m + further_m,
            point: last.point + last.tangent * further_m,
            flow_m3_s: 0.0,
            vertex: false,
            ..last
        }
    }));
}
