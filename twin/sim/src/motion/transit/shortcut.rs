//! A way made shorter and its corners rounded; every move of it stays one that was found clear.

use super::ask::Ask;
use super::metric::Metric;
use super::random::Random;
use crate::kinematics::Posture;

/// Shortcuts that gain less than this share of the way are not worth a question.
const GAIN: f64 = 1e-3;
/// Moves that a rounded corner is made of.
const CHORDS: usize = 6;

/// Shortens a clear way by at most `checks_max` questions.
///
/// First corners are skipped, from the far end; then pieces between two places drawn on the way are
/// made straight. Each replacement is a move found clear and is shorter by the metric.
pub(super) fn shorten(
    ask: &mut Ask<'_>,
    metric: &Metric,
    random: &mut Random,
    way: Vec<Posture>,
    checks_max: usize,
) -> Vec<Posture> {
    let stop = ask.n_checks + checks_max;
    let mut way = skip_corners(ask, way, ask.n_checks + checks_max / 2);
    // The trials that gain too little to be asked for end it as well.
    for _ in 0..4 * checks_max {
        if way.len() < 3 || ask.n_checks >= stop {
            break;
        }
        let lengths: Vec<f64> =
            way.windows(2).map(|pair| metric.length(&pair[0], &pair[1])).collect();
        let total_m: f64 = lengths.iter().sum();
        let (a, b) = (random.share() * total_m, random.share() * total_m);
        let (first, from) = place(&way, &lengths, a.min(b));
        let (last, to) = place(&way, &lengths, a.max(b));
        let gained_m = (a - b).abs() - metric.length(&from, &to);
        if first == last || gained_m < GAIN * total_m || ask.clear(&from, &to).is_err() {
            continue;
        }
        way.splice(first + 1..=last, [from, to]);
    }
    way
}

/// From every posture to the furthest that it can be joined with.
fn skip_corners(ask: &mut Ask<'_>, way: Vec<Posture>, stop: usize) -> Vec<Posture> {
    let Some(&first) = way.first() else { return way };
    let mut short = vec![first];
    let mut at = 0;
    while at + 1 < way.len() {
        let mut next = way.len() - 1;
        while next > at + 1 && (ask.n_checks >= stop || ask.clear(&way[at], &way[next]).is_err()) {
            next -= 1;
        }
        short.push(way[next]);
        at = next;
    }
    short
}

/// The move that holds this length of the way, and the posture there.
fn place(way: &[Posture], lengths: &[f64], at_m: f64) -> (usize, Posture) {
    let mut rest_m = at_m;
    for (k, &length_m) in lengths.iter().enumerate() {
        if rest_m <= length_m || k + 1 == lengths.len() {
            let share = if length_m > 0.0 { (rest_m / length_m).min(1.0) } else { 0.0 };
            return (k, way[k].toward(&way[k + 1], share));
        }
        rest_m -= length_m;
    }
    (0, way[0])
}

/// Rounds the corners of a clear way by parabolas, as wide as stays clear.
///
/// ```text
/// q(t) = (1−t)² a + 2 t (1−t) v + t² b        a, b on the two moves, equally far from the corner v
/// ```
///
/// Each parabola is a polygon of [`CHORDS`] moves that were found clear; what is left of the old
/// moves is part of them. Four widths are tried, the first as wide as half the shorter move; a corner close to an obstacle
/// may stay as it is.
pub(super) fn round(ask: &mut Ask<'_>, metric: &Metric, way: &[Posture]) -> Vec<Posture> {
    let Some((&first, &last)) = way.first().zip(way.last()) else { return Vec::new() };
    let mut rounded = vec![first];
    for corner in way.windows(3) {
        let [before, at, after] = [corner[0], corner[1], corner[2]];
        let (in_m, out_m) = (metric.length(&before, &at), metric.length(&at, &after));
        // A move that goes nowhere has no direction to leave a corner by.
        if in_m.min(out_m) < 1e-9 {
            rounded.push(at);
            continue;
        }
        let blend = [0.5, 0.25, 0.1, 0.03].into_iter().find_map(|width| {
            let width_m = width * in_m.min(out_m);
            let from = at.toward(&before, width_m / in_m);
            let to = at.toward(&after, width_m / out_m);
            let chords = parabola(&from, &at, &to);
            ask.way(&chords).is_ok().then_some(chords)
        });
        let chords = blend.unwrap_or_else(|| vec![at]);
        // Two corners that share a short move may meet in its middle.
        let doubled = metric.length(&rounded[rounded.len() - 1], &chords[0]) < 1e-9;
        rounded.extend(&chords[usize::from(doubled)..]);
    }
    if way.len() > 1 {
        rounded.push(last);
    }
    rounded
}

fn parabola(from: &Posture, corner: &Posture, to: &Posture) -> Vec<Posture> {
    let at = |k: usize| {
        let t = k as f64 / CHORDS as f64;
        from.toward(corner, t).toward(&corner.toward(to, t), t)
    };
    (0..=CHORDS).map(at).collect()
}
