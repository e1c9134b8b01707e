//! Jerk limits: the law without them, made gentler and wider, and then its running mean.
//!
//! The running mean over `T` turns a step of acceleration by `Δa` into a ramp of jerk `Δa/T`. So with
//! accelerations up to `J T`, and neither a peak nor a valley of speed shorter than `T`, jerk stays
//! within `J`. On a straight line between rests this is the seven-segment S-curve, and the shortest
//! one for `T = min(A/J, √(V/J), ∛(L/2J))`.
//!
//! The mean at a place takes in speeds over a way of `v T` about it, so ceilings are widened by half
//! of that to both sides; that also makes every valley as long as `T`.

use std::cmp::Ordering;

use super::course::Piece;
use super::grid::{Grid, Node};
use super::limits::Bounds;
use super::phase::{Allowance, sweep};
use super::profile::Profile;

/// Windows tried between the shortest and the longest that can be best.
const TRIED: usize = 8;

/// What the law before smoothing may use; shares per cell, lowered where limits were exceeded.
#[derive(Debug, Clone)]
pub(super) struct Shares {
    /// Of speeds.
    pub(super) slow: Vec<f64>,
    /// Of joint acceleration and torque.
    pub(super) soft: Vec<f64>,
    /// Of jerk.
    pub(super) gentle: Vec<f64>,
}

impl Shares {
    pub(super) fn all(n: usize) -> Self {
        Self { slow: vec![1.0; n], soft: vec![1.0; n], gentle: vec![1.0; n] }
    }
}

/// The law before smoothing, as `(s, ṡ²)`, for a running mean over `window_s` (0: none).
///
/// `speeds` are guesses of ds/dt in the cells, for the jerk that the path itself takes.
pub(super) fn base(
    grid: &Grid,
    bounds: &Bounds,
    shares: &Shares,
    window_s: f64,
    speeds: &[f64],
) -> Vec<(f64, f64)> {
    let own = |k: usize| {
        let cell = &grid.cells[k];
        cell.ceiling.min(cell.jerk_speed * shares.gentle[k].cbrt()) * shares.slow[k]
    };
    let ramp = |k: usize| {
        if window_s == 0.0 {
            return bounds.ramp;
        }
        let jerk = shares.gentle[k] * grid.cells[k].jerk(speeds[k], window_s, bounds);
        bounds.ramp.min(jerk * window_s)
    };
    let n = grid.cells.len();
    let mut allowance = Allowance {
        speed: (0..n).map(own).collect(),
        ramp: (0..n).map(ramp).collect(),
        slow: shares.slow.clone(),
        soft: shares.soft.clone(),
    };
    if window_s > 0.0 {
        widen(grid, &mut allowance, window_s);
    }
    let x = sweep(grid, &allowance);
    let points = sharpen(grid, &allowance, &x);
    if window_s > 0.0 { level_peaks(&points, window_s) } else { points }
}

/// Speeds in the middle of the cells.
pub(super) fn speeds(grid: &Grid, profile: &Profile) -> Vec<f64> {
    let mut step = 0;
    let middle = |k: usize| grid.nodes[k].s + grid.cells[k].width / 2.0;
    let speed = |k: usize| {
        let s = middle(k);
        while profile.steps.get(step + 1).is_some_and(|next| next.s <= s) {
            step += 1;
        }
        let (from, to) = (&profile.steps[step], profile.steps.get(step + 1));
        to.map_or(from.v, |to| from.v.max(to.v))
    };
    (0..grid.cells.len()).map(speed).collect()
}

/// The best window, s; 0 where nothing that moves has a limit of jerk.
pub(super) fn window(grid: &Grid, bounds: &Bounds, shares: &Shares, speeds: &[f64]) -> f64 {
    let length = grid.nodes[grid.cells.len()].s - grid.nodes[0].s;
    let (mut shortest, mut longest) = (f64::INFINITY, 0.0_f64);
    for (k, cell) in grid.cells.iter().enumerate() {
        let jerk = cell.jerk(0.0, 0.0, bounds);
        if jerk.is_infinite() {
            continue;
        }
        let ramp = (0..grid.dof)
            .map(|j| bounds.acceleration[j] / cell.d[j][0])
            .fold(bounds.ramp, f64::min);
        let speed = allowed(grid, k, 1.0, 1.0).min(cell.jerk_speed);
        let own = (ramp / jerk).min((speed / jerk).sqrt()).min((length / (2.0 * jerk)).cbrt());
        shortest = shortest.min(own);
        longest = longest.max(own);
    }
    if longest == 0.0 {
        return 0.0;
    }
    let duration = |window_s: f64| {
        let points = base(grid, bounds, shares, window_s, speeds);
        Profile::from_phase(&points).map_or(f64::INFINITY, |law| law.duration() + window_s)
    };
    // A straight line has one best window and needs no search.
    let ratio = (longest / shortest).ln();
    if ratio < 1e-9 {
        return longest;
    }
    let candidate = |k: usize| shortest * (ratio * k as f64 / (TRIED - 1) as f64).exp();
    let mut best = (f64::INFINITY, longest);
    for window_s in (0..TRIED).map(candidate) {
        let time_s = duration(window_s);
        if time_s < best.0 {
            best = (time_s, window_s);
        }
    }
    best.1
}

/// Where asked speeds, widened for `window_s`, begin and end.
pub(super) fn cuts(pieces: &[Piece], window_s: f64) -> Vec<f64> {
    let cut = |pair: &[Piece]| {
        let (before, after) = (pair[0].ceiling, pair[1].ceiling);
        let reach = before.min(after) * window_s / 2.0;
        match before.total_cmp(&after) {
            Ordering::Less => Some(pair[0].to + reach),
            Ordering::Greater => Some(pair[0].to - reach),
            Ordering::Equal => None,
        }
    };
    let mut cuts: Vec<f64> = pieces.windows(2).filter_map(cut).collect();
    cuts.sort_by(f64::total_cmp);
    cuts
}

/// Largest ds/dt in a cell at constant speed.
fn allowed(grid: &Grid, k: usize, slow: f64, soft: f64) -> f64 {
    let cell = &grid.cells[k];
    let mut speed = cell.ceiling.min(slow * cell.speed);
    for node in &grid.nodes[k..=k + 1] {
        speed = speed.min(slow * node.speed);
        for row in &node.rows[..node.n_rows] {
            let bound = if row.b > 0.0 { row.high } else { row.low };
            if row.b != 0.0 {
                speed = speed.min((soft * bound / row.b).sqrt());
            }
        }
    }
    speed
}

/// Lowers speeds to what is allowed within half of what is passed in `window_s`.
fn widen(grid: &Grid, allowance: &mut Allowance, window_s: f64) {
    let n = grid.cells.len();
    let cap =
        |k: usize| allowed(grid, k, allowance.slow[k], allowance.soft[k]).min(allowance.speed[k]);
    let caps: Vec<f64> = (0..n).map(cap).collect();
    for (k, &cap) in caps.iter().enumerate().filter(|(_, cap)| cap.is_finite()) {
        let reach = cap * window_s / 2.0;
        // A slower cell that reaches as far does the rest.
        let done = |other: usize, way: f64| {
            let own = caps[other];
            way >= reach || (own <= cap && way + own * window_s / 2.0 >= reach)
        };
        for other in k + 1..n {
            let way = grid.nodes[other].s - grid.nodes[k + 1].s;
            if done(other, way) {
                break;
            }
            allowance.speed[other] = allowance.speed[other].min(cap);
        }
        for other in (0..k).rev() {
            let way = grid.nodes[k].s - grid.nodes[other + 1].s;
            if done(other, way) {
                break;
            }
            allowance.speed[other] = allowance.speed[other].min(cap);
        }
    }
}

/// What a law with one acceleration per cell leaves unused: where limits allow, it speeds up from
/// the start of a cell and slows down to its end as fast as can be, with the asked speed in
/// between. On a straight line the trapezoid is then exact.
fn sharpen(grid: &Grid, allowance: &Allowance, x: &[f64]) -> Vec<(f64, f64)> {
    let n = grid.cells.len();
    let mut points = Vec::with_capacity(n + 9);
    for k in 0..n {
        let (start, width) = (grid.nodes[k].s, grid.cells[k].width);
        points.push((start, x[k]));
        let own = (x[k + 1] - x[k]) / (2.0 * width);
        let (_, left) = accelerations(&grid.nodes[k], allowance, k, x[k]);
        let (right, _) = accelerations(&grid.nodes[k + 1], allowance, k, x[k + 1]);
        let margin = 1e-9 * (left.abs() + right.abs());
        if !(left.is_finite() && right.is_finite() && left > own + margin && own > right + margin) {
            continue;
        }
        let speed = grid.nodes[k].speed.min(grid.nodes[k + 1].speed).min(grid.cells[k].speed);
        let lid = allowance.speed[k].min(allowance.slow[k] * speed).min(1e100).powi(2);
        let meet = (x[k + 1] - x[k] - 2.0 * right * width) / (2.0 * (left - right));
        let top = (x[k] + 2.0 * left * meet).min(lid);
        let fits = |node: usize, u: f64| {
            let (low, high) = accelerations(&grid.nodes[node], allowance, k, top);
            u >= low - margin && u <= high + margin
        };
        if top < x[k].max(x[k + 1]) || !(fits(k, left) && fits(k + 1, right)) {
            continue;
        }
        // Where the top is the asked speed it is reached early and left late.
        let sliver = 1e-9 * width;
        let up = if left > 0.0 { (top - x[k]) / (2.0 * left) } else { meet };
        let down = if right < 0.0 { width + (top - x[k + 1]) / (2.0 * right) } else { meet };
        if up > sliver && up < width - sliver {
            points.push((start + up, top));
        }
        if down > up.max(0.0) + sliver && down < width - sliver {
            points.push((start + down, top));
        }
    }
    points.push((grid.nodes[n].s, x[n]));
    points
}

/// Least and largest `s̈` at a node with `x`, by the shares of `cell`.
fn accelerations(node: &Node, allowance: &Allowance, cell: usize, x: f64) -> (f64, f64) {
    let (mut low, mut high) = (-allowance.ramp[cell], allowance.ramp[cell]);
    let soft = allowance.soft[cell];
    for row in &node.rows[..node.n_rows] {
        let ends = [soft * row.low, soft * row.high].map(|bound| (bound - row.b * x) / row.a);
        if ends[0].is_finite() && ends[1].is_finite() {
            low = low.max(ends[0].min(ends[1]));
            high = high.min(ends[0].max(ends[1]));
        }
    }
    (low, high)
}

/// Flattens every peak until it lasts `window_s`.
fn level_peaks(points: &[(f64, f64)], window_s: f64) -> Vec<(f64, f64)> {
    let mut cuts: Vec<Cut> = Vec::new();
    for k in 1..points.len().saturating_sub(1) {
        let rises = points[k].1 > points[k - 1].1;
        if !(rises && points[k].1 >= points[k + 1].1) {
            continue;
        }
        let Some(cut) = cut(points, k, window_s) else { continue };
        while cuts.last().is_some_and(|last| last.from >= cut.from && last.to <= cut.to) {
            cuts.pop();
        }
        if cuts.last().is_none_or(|last| last.to <= cut.from) {
            cuts.push(cut);
        }
    }
    let mut out = Vec::with_capacity(points.len() + 2 * cuts.len());
    let mut rest = points.iter().peekable();
    for cut in &cuts {
        while let Some(point) = rest.next_if(|point| point.0 < cut.from) {
            out.push(*point);
        }
        while rest.next_if(|point| point.0 <= cut.to).is_some() {}
        out.extend([(cut.from, cut.level), (cut.to, cut.level)]);
    }
    out.extend(rest);
    out.dedup_by(|later, earlier| later.0 <= earlier.0);
    out
}

/// `ṡ²` is at most `level` here.
struct Cut {
    from: f64,
    to: f64,
    level: f64,
}

/// What to take off the peak at `k`: the level at which the stretch above it lasts `window_s`.
fn cut(points: &[(f64, f64)], k: usize, window_s: f64) -> Option<Cut> {
    let x = |index: usize| points[index].1;
    let (mut left, mut right, mut level) = (k, k, x(k));
    // Where the stretch grows into a higher peak only this side of the saddle is cut.
    let (mut saddle_left, mut saddle_right) = (None, None);
    let crossing = |inner: usize, outer: usize, level: f64| {
        let ((s, x), (s_out, x_out)) = (points[inner], points[outer]);
        s + (s_out - s) * ((x - level) / (x - x_out)).clamp(0.0, 1.0)
    };
    loop {
        while left > 0 && x(left - 1) >= level {
            if x(left - 1) > level && saddle_left.is_none_or(|(_, x)| x > level) {
                saddle_left = Some(points[left]);
            }
            left -= 1;
        }
        while right + 1 < points.len() && x(right + 1) >= level {
            if x(right + 1) > level && saddle_right.is_none_or(|(_, x)| x > level) {
                saddle_right = Some(points[right]);
            }
            right += 1;
        }
        if left == 0 || right + 1 == points.len() {
            return None;
        }
        let ends =
            |level: f64| (crossing(left, left - 1, level), crossing(right, right + 1, level));
        let lasts = |level: f64| {
            let (from, to) = ends(level);
            to - from >= window_s * level.sqrt()
        };
        let next = x(left - 1).max(x(right + 1));
        if lasts(level) || lasts(next) {
            let (mut low, mut high) = (next, level);
            if lasts(level) {
                low = level;
            }
            while high - low > 1e-14 * high {
                let middle = (low + high) / 2.0;
                if middle <= low || middle >= high {
                    break;
                }
                if lasts(middle) { low = middle } else { high = middle }
            }
            let (from, to) = ends(low);
            // Below the saddle the higher peak is cut with it.
            let side = |saddle: Option<(f64, f64)>, end: f64| {
                saddle.filter(|(_, x)| *x <= low).map_or(end, |(s, _)| s)
            };
            let (from, to) = (side(saddle_left, from), side(saddle_right, to));
            return (low < x(k)).then_some(Cut { from, to, level: low });
        }
        level = next;
    }
}
