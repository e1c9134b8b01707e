//! The nozzle's way as light sees it.

use crate::process::course::Course;
use crate::process::dose::{Segment, segments};
use crate::process::lights::Station;

/// Most segments light is summed on; longer strands are cut more coarsely.
const MOST_SEGMENTS: usize = 240;

/// The nozzle's way as the light laws want it, at most [`MOST_SEGMENTS`] steps along the strand, and what it travels
/// past the end.
pub(super) fn stations(course: &Course, length_m: f64) -> Vec<Station> {
    let every = course.stations.len().div_ceil(MOST_SEGMENTS).max(1);
    let last = course.stations.len() - 1;
    course
        .stations
        .iter()
        .enumerate()
        .filter(|(k, station)| {
            k % every == 0 || *k == last || (station.at_m - length_m).abs() < 1e-9
        })
        .map(|(_, station)| Station {
            time_s: station.time_s,
            point: station.point,
            part_from_tool: station.part_from_tool,
            part_from_room: station.part_from_room,
        })
        .collect()
}

/// Segments of the strand itself, without what the nozzle travels past its end.
pub(super) fn own_segments(stations: &[Station], length_m: f64, course: &Course) -> Vec<Segment> {
    let end_s = course.time_at_s(length_m) + 1e-9;
    let mut own = segments(stations);
    own.retain(|segment| segment.born_s < end_s);
    own
}

/// Middle of each segment along the strand, m.
pub(super) fn middles(stations: &[Station], length_m: f64, n: usize) -> Vec<f64> {
    let mut at_m = 0.0;
    let mut middles = Vec::with_capacity(n);
    for pair in stations.windows(2).take(n) {
        let step_m = (pair[1].point - pair[0].point).norm();
        middles.push((at_m + 0.5 * step_m).min(length_m));
        at_m += step_m;
    }
    middles
}

/// The same way once more, at a steady speed, after the first pass.
pub(super) fn second_pass(stations: &[Station], course: &Course, speed_m_s: f64) -> Vec<Station> {
    let mut time_s = stations.last().map_or(0.0, |last| last.time_s) + course.dwell_s;
    let mut again = Vec::with_capacity(stations.len());
    for (k, station) in stations.iter().enumerate() {
        if k > 0 {
            time_s += (station.point - stations[k - 1].point).norm() / speed_m_s;
        }
        again.push(Station { time_s, ..*station });
    }
    again
}
