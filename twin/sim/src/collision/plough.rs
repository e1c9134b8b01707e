//! C208: a bead laid through an earlier one.
//!
//! The orifice follows the axis of the bead it lays. Beads laid one above the other have their axes about a
//! bead apart and the orifice passes over the earlier one. Where its path comes nearer to the
//! earlier axis than that bead's radius, the orifice runs under its surface: a little of it is pressing
//! one bead into the other, half the radius is ploughing.
//!
//! ```text
//! depth = (r − d) / r        r: radius of the earlier bead
//!                            d: orifice's path (as planned) – earlier axis (as printed)
//! ```
//!
//! At its ends a strand may be joined to whatever is there: places within the touch zone of an end of
//! either strand are left out.

use std::collections::BTreeMap;

use crate::cell::Job;
use crate::clearance::{Piece, outside};
use crate::deposit::{Deposit, Segment, closest};
use crate::finding::{Check, Code, Findings, Phase, Site, Words};
use crate::interval::Interval;
use crate::pose::{Point, Vector};

/// Share of the earlier bead's radius that the orifice may run under its surface: a quarter of the
/// diameter, of which heat and pressure of the nozzle make a joint. Ours; no measurement found.
const DEPTH_SHARE: f64 = 0.5;

/// Where the orifice is deepest in one earlier strand.
struct Deepest {
    earlier: usize,
    share: f64,
    at_m: f64,
    point: Point,
}

/// Judges every strand that was printed against those before it.
pub(super) fn check(job: &Job, deposit: &Deposit, findings: &mut Findings) {
    for (order, printed) in deposit.strands.iter().enumerate() {
        for deepest in through(job, deposit, order) {
            let (id, other) =
                (&job.strands[printed.strand].id, deposit.strands[deepest.earlier].strand);
            let earlier = job.strands[other].id.as_str();
            let site = Site::strand(printed.strand, deepest.at_m)
                .during(Phase::Print)
                .at(deepest.point)
                .between(["nozzle", earlier]);
            let check = Check {
                code: Code::C208,
                measured: Interval::exact(deepest.share),
                limit: DEPTH_SHARE,
                warn_limit: None,
                site,
                time_s: Some(printed.even_time_s(deepest.at_m)),
            };
            findings.check(check, || Words {
                message: format!(
                    "strand `{id}` runs through `{earlier}` at {:.1} mm, {:.0} % of its radius deep",
                    deepest.at_m * 1e3,
                    deepest.share * 100.0
                ),
                hint: format!(
                    "lead `{id}` over `{earlier}` with the axes about a bead apart, or end one of them there"
                ),
            });
        }
    }
}

/// Where the orifice is deepest in each earlier strand, and in this one's own earlier part.
fn through(job: &Job, deposit: &Deposit, order: usize) -> Vec<Deepest> {
    let (strand, zone_m) = (&deposit.strands[order], job.limits.touch_zone_m);
    let mut deepest: BTreeMap<usize, Deepest> = BTreeMap::new();
    let mut near = Vec::new();
    let mut pieces = Vec::new();
    for k in 1..strand.as_planned.len() {
        let path = [strand.as_planned[k - 1], strand.as_planned[k]];
        let reach = Vector::repeat(strand.radius_m);
        let (low, high) = (path[0].inf(&path[1]) - reach, path[0].sup(&path[1]) + reach);
        deposit.near(low, high, &mut near);
        for &index in &near {
            let earlier = &deposit.segments[index as usize];
            let ends = joints(deposit, [order, earlier.order]);
            for (path, bead) in there(path, strand.at_m[k - 1], order, earlier, zone_m) {
                outside(path, &ends, zone_m, &mut pieces);
                for piece in &pieces {
                    let [s, t] = closest(piece, &bead);
                    let point = piece[0] + (piece[1] - piece[0]) * s;
                    let other = bead[0] + (bead[1] - bead[0]) * t;
                    let share = (earlier.radius_m - (point - other).norm()) / earlier.radius_m;
                    let at_m = strand.at_m[k - 1] + (point - strand.as_planned[k - 1]).norm();
                    let known = deepest.get(&earlier.order).map_or(0.0, |known| known.share);
                    if share > known {
                        let here = Deepest { earlier: earlier.order, share, at_m, point };
                        deepest.insert(earlier.order, here);
                    }
                }
            }
        }
    }
    deepest.into_values().collect()
}

/// Most pieces that a segment's path is cut into.
const PIECES_MAX: f64 = 1000.0;

/// A piece of the orifice's path, with the part of a bead that is there by then.
///
/// All of an earlier strand. Of its own, what lies two zones behind the orifice or more, so that a corner is no crossing: the
/// path, which begins at arc length `from_m`, is cut into pieces as long as a zone, and the bead into what is so far behind
/// where each of them begins.
fn there(
    path: Piece,
    from_m: f64,
    order: usize,
    bead: &Segment,
    zone_m: f64,
) -> Vec<(Piece, Piece)> {
    if bead.order != order {
        return if bead.order < order { vec![(path, bead.ends)] } else { Vec::new() };
    }
    let length_m = (path[1] - path[0]).norm();
    let [begins_m, ends_m] = bead.at_m;
    if ends_m <= from_m - 2.0 * zone_m {
        return vec![(path, bead.ends)];
    }
    if begins_m >= from_m + length_m - 2.0 * zone_m {
        return Vec::new();
    }
    let count = (length_m / zone_m).ceil().clamp(1.0, PIECES_MAX);
    let on = |ends: &Piece, share: f64| ends[0] + (ends[1] - ends[0]) * share;
    let pieces = (0..count as usize).filter_map(|k| {
        let [first, last] = [k, k + 1].map(|k| k as f64 / count);
        let behind_m = from_m + length_m * first - 2.0 * zone_m;
        let share = ((behind_m - begins_m) / (ends_m - begins_m)).min(1.0);
        let part = [bead.ends[0], on(&bead.ends, share)];
        (share > 0.0).then(|| ([on(&path, first), on(&path, last)], part))
    });
    pieces.collect()
}

/// The ends of two strands.
fn joints(deposit: &Deposit, orders: [usize; 2]) -> Vec<Point> {
    let ends = |order: usize| {
        let points = &deposit.strands[order].as_printed;
        points.first().into_iter().chain(points.last())
    };
    orders.into_iter().flat_map(ends).copied().collect()
}
