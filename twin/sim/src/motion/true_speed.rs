//! The speed the orifice really has along a strand.

use super::{Motion, Station, between};
use crate::cell::{Interpolation, Job};
use crate::pose::{Point, Vector};
use crate::timing::Law;
use crate::toolpath::Path;

/// The strands with the speed of every sample replaced by the true one until the next sample.
pub fn as_moved(paths: &[Path], motion: &Motion) -> Vec<Path> {
    let mut moved = paths.to_vec();
    for path in &mut moved {
        let speeds_m_s = motion.speeds_m_s.get(path.strand);
        for (sample, &speed_m_s) in path.samples.iter_mut().zip(speeds_m_s.into_iter().flatten()) {
            sample.speed_m_s = speed_m_s;
        }
    }
    moved
}

/// Speed of the orifice in part axes, m/s.
///
/// ```text
/// v = |J_v q̇ + (J_ω q̇) × (p − t)|
/// ```
///
/// with `p` the orifice, `t` the tip and `J` its Jacobian: whichever of tool and part rides on the
/// tip, `p` counts as a point of that.
pub fn orifice_speed(job: &Job, q: &[f64], speed: &[f64]) -> f64 {
    let chain = &job.cell.robot.arm.chain;
    let tip = chain.forward(q);
    let twist = chain.jacobian(q) * nalgebra::DVector::from_column_slice(speed);
    let linear = Vector::new(twist[0], twist[1], twist[2]);
    let angular = Vector::new(twist[3], twist[4], twist[5]);
    let arm = job.cell.world_from_tool(&tip).translation.vector - tip.translation.vector;
    (linear + angular.cross(&arm)).norm()
}

/// The true speed half way between every sample and the next, by a time law over the arc length;
/// the asked one where it has none. A controller that moves in lines goes at `ds/dt`; of joints that
/// turn evenly the Jacobian tells.
pub(super) fn by_law(job: &Job, law: &Law, path: &Path) -> Vec<f64> {
    let settings = &job.strands[path.strand].settings;
    let in_lines = settings.interpolation == Interpolation::Linear;
    let samples = &path.samples;
    let speed = |k: usize| {
        let (from, to) = if k + 1 < samples.len() { (k, k + 1) } else { (k.saturating_sub(1), k) };
        let state = law.at(law.time_at((samples[from].at_m + samples[to].at_m) / 2.0));
        let speed_m_s =
            if in_lines { state.path[1] } else { orifice_speed(job, &state.q, &state.speed) };
        if speed_m_s > 0.0 { speed_m_s } else { samples[k].speed_m_s }
    };
    (0..samples.len()).map(speed).collect()
}

/// The same by the times of stations: way of the orifice, as chords between stations, over time.
pub(super) fn by_times(job: &Job, stations: &[Station], at_s: &[f64], path: &Path) -> Vec<f64> {
    let mut way_m = 0.0;
    let mut before: Option<Point> = None;
    let mark_of = |(station, &time_s): (&Station, &f64)| {
        let (point, _) = between::nozzle_at(job, &station.q);
        way_m += before.map_or(0.0, |before| nalgebra::distance(&before, &point));
        before = Some(point);
        [station.at_m, way_m, time_s]
    };
    let marks: Vec<[f64; 3]> = stations.iter().zip(at_s).map(mark_of).collect();
    let samples = &path.samples;
    let speed = |k: usize| {
        let (from, to) = if k + 1 < samples.len() { (k, k + 1) } else { (k.saturating_sub(1), k) };
        let ends = mark(&marks, samples[from].at_m).zip(mark(&marks, samples[to].at_m));
        let speed_m_s = ends.map(|([way, time], [next, later])| (next - way) / (later - time));
        let told = speed_m_s.filter(|speed| speed.is_finite() && *speed > 0.0);
        told.unwrap_or(samples[k].speed_m_s)
    };
    (0..samples.len()).map(speed).collect()
}

/// Way and time at an arc length, even between stations; `None` outside of them.
fn mark(marks: &[[f64; 3]], at_m: f64) -> Option<[f64; 2]> {
    let k = marks.partition_point(|mark| mark[0] < at_m - 1e-12);
    let after = marks.get(k)?;
    if (after[0] - at_m).abs() <= 1e-12 {
        return Some([after[1], after[2]]);
    }
    let before = marks.get(k.checked_sub(1)?)?;
    let share = (at_m - before[0]) / (after[0] - before[0]);
    Some([1, 2].map(|column| before[column] + (after[column] - before[column]) * share))
}
