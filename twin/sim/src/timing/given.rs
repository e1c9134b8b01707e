//! A law whose times are given.

use super::course::Course;
use super::law::Law;
use super::limits::{Bounds, Limits};
use super::profile::{Profile, Step};
use super::{Fault, Station};

/// The law that passes the stations at the `times` given (s, one per station, not falling), and what
/// it asks of the arm: shares above one in [`Law::passings`] are limits exceeded.
///
/// Between stations `s(t)` is the cubic that neither overshoots nor turns back, with the speed at a
/// station from the mean speeds `w` before and after it over the times `h`:
///
/// ```text
/// v = (α/w₋ + (1 − α)/w₊)⁻¹,   α = (h₋ + 2 h₊) / (3 (h₋ + h₊));   0 at stops and where it waits
/// ```
///
/// Start and end are as fast as the stretch beside them unless they are stops: given times seldom
/// leave room for a ramp. Accelerations jump at stations. Corners are passed as the times say; they
/// are rounded by `limits.blend_m`, and one that is not (0, or too near to another) has its jump of
/// joint speeds left out of the accelerations.
///
/// Source: F. N. Fritsch, J. Butland, "A method for constructing local monotone piecewise cubic
/// interpolants", SIAM J. Sci. Stat. Comput. 5(2), 1984.
pub fn follow_times(stations: &[Station], times: &[f64], limits: &Limits) -> Result<Law, Fault> {
    let bounds = Bounds::new(limits, false)?;
    let course = Course::new(stations, bounds.dof, limits.blend_m)?;
    check(stations, times)?;
    let n = stations.len();
    let span = |k: usize| times[k + 1] - times[k];
    let mean =
        |k: usize| if span(k) > 0.0 { (stations[k + 1].s - stations[k].s) / span(k) } else { 0.0 };
    // Stations that share place and time count as one: the mean speed beside them is further on.
    let moves = |k: &usize| span(*k) > 0.0;
    let speed = |k: usize| {
        let (before, after) = ((0..k).rev().find(moves), (k..n - 1).find(moves));
        match (before, after) {
            _ if stations[k].stop => 0.0,
            (Some(b), Some(a)) => {
                let (w, w_next) = (mean(b), mean(a));
                if w <= 0.0 || w_next <= 0.0 {
                    return 0.0;
                }
                let alpha = (span(b) + 2.0 * span(a)) / (3.0 * (span(b) + span(a)));
                1.0 / (alpha / w + (1.0 - alpha) / w_next)
            }
            (Some(one), None) | (None, Some(one)) => mean(one),
            (None, None) => 0.0,
        }
    };
    let speeds: Vec<f64> = (0..n).map(speed).collect();
    let start = times[0];
    let mut steps = Vec::with_capacity(n);
    for k in (0..n - 1).filter(moves) {
        let (h, w) = (span(k), mean(k));
        let (v, v_next) = (speeds[k], speeds[k + 1]);
        let a = (6.0 * w - 4.0 * v - 2.0 * v_next) / h;
        let j = (6.0 * (v + v_next) - 12.0 * w) / (h * h);
        steps.push(Step { t: times[k] - start, s: stations[k].s, v, a, j });
    }
    let (t, s) = (times[n - 1] - start, stations[n - 1].s);
    steps.push(Step { t, s, v: speeds[n - 1], a: 0.0, j: 0.0 });
    let boundaries = course.pieces.iter().map(|piece| piece.to);
    let profile = Profile { steps }.cut_at(boundaries);
    let times: Vec<f64> = times.iter().map(|time| time - start).collect();
    Ok(Law::with_times(&times, course, profile, &bounds))
}

/// One finite time per station, none before another, and none without time for its way.
fn check(stations: &[Station], times: &[f64]) -> Result<(), Fault> {
    let n = stations.len();
    if times.len() != n {
        return Err(Fault::Times { station: times.len().min(n - 1) });
    }
    for (station, time) in times.iter().enumerate() {
        let before = station.max(1) - 1;
        let span = time - times[before];
        let way = stations[station].s - stations[before].s;
        if !time.is_finite() || span < 0.0 || (span == 0.0 && way > 0.0) {
            return Err(Fault::Times { station });
        }
    }
    Ok(())
}
