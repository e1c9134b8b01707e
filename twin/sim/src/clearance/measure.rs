//! Covered clearance of pairs along one path: bodies against bodies, bodies against strands.

use std::collections::BTreeMap;

use super::space::{Kind, Named, Space, Thing};
use super::sweep::{Asked, Covered, Look, least, middle};
use super::touch::{Ground, Touch};
use super::track::{Instant, Rider, Track};
use super::zone;
use crate::deposit::Segment;
use crate::pose::{Point, Pose};

/// Strands are told apart along stretches on which a body moves no more than this, m.
const BROAD_M: f64 = 10e-3;

/// A sphere that the whole part lies in, about any place of a cell, m.
const ALL_M: f64 = 1e3;

/// Segments that may come near on a stretch of the path.
type Stretch = ([f64; 2], Vec<u32>);

/// One path in a space, and what may touch along it.
pub(crate) struct Measure<'a> {
    space: &'a Space<'a>,
    track: &'a Track<'a>,
    touch: &'a Touch,
    /// Strands that are there.
    printed: usize,
}

impl<'a> Measure<'a> {
    pub(crate) fn new(
        space: &'a Space<'a>,
        track: &'a Track<'a>,
        touch: &'a Touch,
        printed: usize,
    ) -> Self {
        Self { space, track, touch, printed }
    }

    /// Tells every pair that comes within the horizon, until `told` has heard enough.
    pub(crate) fn each<S>(
        &self,
        asked: impl Fn(&S) -> Asked,
        state: &mut S,
        mut told: impl FnMut(&mut S, (usize, Named), Covered) -> bool,
    ) {
        for &thing in &self.space.against_deposit {
            for (order, covered) in self.strands(thing, |_| asked(state)) {
                if !told(state, (thing, Named::Strand(order)), covered) {
                    return;
                }
            }
        }
        for &pair in &self.space.pairs {
            if let Some(covered) = self.pair(pair, &asked(state))
                && !told(state, (pair[0], Named::Thing(pair[1])), covered)
            {
                return;
            }
        }
    }

    /// Smallest clearance of two bodies, with what they may press added where they may touch.
    pub(crate) fn pair(&self, [a, b]: [usize; 2], asked: &Asked) -> Option<Covered> {
        let (one, two) = (&self.space.things[a], &self.space.things[b]);
        if self.is_gone(one) || self.is_gone(two) {
            return None;
        }
        let starts = vec![([0.0, self.track.end()], ())];
        least(asked, starts, |range, (), cutoff_m| {
            let now = self.track.at(middle(range));
            let moved_m = self.track.moves_m(&one.rider, &two.rider, &now, range);
            let [pose, other] =
                [one, two].map(|thing| now.carrier(thing.rider.carrier) * thing.carrier_from_body);
            let reach_m = cutoff_m + moved_m;
            let clearance_m = one.body.to_body(&pose, two.body, &other, reach_m);
            let ground = self.ground(one, two);
            let found_m = if clearance_m > reach_m {
                f64::INFINITY
            } else {
                clearance_m + self.allowed_m(ground, &now, None)
            };
            let low_m = clearance_m - moved_m + self.allowed_m(ground, &now, Some(range));
            Look { found_m, low_m, keep: () }
        })
    }

    /// What the clearance of two bodies is made up by at `u`, m: zero, or where nozzle and ground
    /// may touch, the full clearance and the depth they may press.
    pub(crate) fn allowance_m(&self, [a, b]: [usize; 2], u: f64) -> f64 {
        let things = &self.space.things;
        self.allowed_m(self.ground(&things[a], &things[b]), &self.track.at(u), None)
    }

    fn ground(&self, one: &Thing<'_>, two: &Thing<'_>) -> &'a Ground {
        match (one.kind, two.kind) {
            (Kind::Nozzle, Kind::Bed) => &self.touch.bed,
            (Kind::Nozzle, Kind::Form(_)) => &self.touch.form,
            _ => &Ground::No,
        }
    }

    /// Allowance now, or the least of it over a range.
    fn allowed_m(&self, ground: &Ground, now: &Instant, range: Option<[f64; 2]>) -> f64 {
        let limits = &self.space.job.limits;
        let may_touch = match ground {
            Ground::No => false,
            Ground::All => true,
            Ground::Near(places) if places.is_empty() => false,
            Ground::Near(places) => {
                let tip = self.tip(now);
                let moved_m = range.map_or(0.0, |range| self.tip_moves_m(now, range));
                let zone_m = limits.touch_zone_m - moved_m;
                places.iter().any(|place| (place - tip).norm() <= zone_m)
            }
        };
        if may_touch { limits.clearance_m + self.touch.press_m } else { 0.0 }
    }

    fn is_gone(&self, thing: &Thing<'_>) -> bool {
        matches!(thing.kind, Kind::Form(form) if self.touch.gone.contains(&form))
    }

    /// The orifice in part axes.
    pub(crate) fn tip(&self, now: &Instant) -> Point {
        let orifice = self.space.orifice();
        self.part_from_world(now) * (now.carrier(orifice.carrier) * orifice.centre)
    }

    fn tip_moves_m(&self, now: &Instant, range: [f64; 2]) -> f64 {
        let centre = Point::origin();
        let part = Rider { carrier: self.space.part_carrier, centre, radius_m: ALL_M };
        self.track.moves_m(&self.space.orifice(), &part, now, range)
    }

    fn part_from_world(&self, now: &Instant) -> Pose {
        (now.carrier(self.space.part_carrier) * self.space.carrier_from_part).inverse()
    }

    fn part_from(&self, thing: &Thing<'_>, now: &Instant) -> Pose {
        self.part_from_world(now) * now.carrier(thing.rider.carrier) * thing.carrier_from_body
    }

    /// Smallest clearance of a body to each strand that comes within the horizon, by printing order.
    pub(crate) fn strands(
        &self,
        thing: usize,
        asked: impl Fn(usize) -> Asked,
    ) -> Vec<(usize, Covered)> {
        let thing = &self.space.things[thing];
        let Some(part) = self.space.deposit_rider() else { return Vec::new() };
        if part.carrier == thing.rider.carrier {
            return Vec::new();
        }
        let horizon_m = asked(self.printed).horizon_m;
        let mut by_order = BTreeMap::new();
        self.broad(thing, &part, horizon_m, [0.0, self.track.end()], None, &mut by_order);
        let mut told = Vec::new();
        for (order, stretches) in by_order {
            if let Some(covered) = self.strand(thing, &part, order, stretches, &asked(order)) {
                told.push((order, covered));
            }
        }
        told
    }

    /// Smallest clearance of a body to the whole deposit, with the order of the strand it was found
    /// at: as [`Self::strands`], where only the least of all is asked for.
    pub(crate) fn deposit(&self, index: usize, asked: &Asked) -> Option<(usize, Covered)> {
        let thing = &self.space.things[index];
        let part = self.space.deposit_rider()?;
        let n_printed = self.printed + usize::from(self.touch.extrudes);
        let n_segments = self.space.beads.segments_of(n_printed);
        if part.carrier == thing.rider.carrier || n_segments == 0 {
            return None;
        }
        let is_nozzle = thing.kind == Kind::Nozzle;
        if self.touch.extrudes || (is_nozzle && !self.touch.strands.is_empty()) {
            let all = self.strands(index, |_| *asked);
            return all.into_iter().min_by(|a, b| a.1.found_m.total_cmp(&b.1.found_m));
        }
        let mut found = (f64::INFINITY, 0);
        let covered = least(asked, vec![([0.0, self.track.end()], ())], |range, (), cutoff_m| {
            let now = self.track.at(middle(range));
            let moved_m = self.track.moves_m(&thing.rider, &part, &now, range);
            let pose = self.part_from(thing, &now);
            let reach_m = cutoff_m + moved_m;
            match self.space.beads.nearest(thing.body, &pose, n_segments, reach_m) {
                None => Look { found_m: f64::INFINITY, low_m: cutoff_m, keep: () },
                Some(near) => {
                    if near.clearance_m < found.0 {
                        let order = self.space.deposit.segments[near.segment].order;
                        found = (near.clearance_m, order);
                    }
                    let low_m = near.clearance_m - moved_m;
                    Look { found_m: near.clearance_m, low_m, keep: () }
                }
            }
        })?;
        Some((found.1, covered))
    }

    /// Which strands may come near on which stretch of the path.
    fn broad(
        &self,
        thing: &Thing<'_>,
        part: &Rider,
        horizon_m: f64,
        range: [f64; 2],
        within: Option<&[u32]>,
        by_order: &mut BTreeMap<usize, Vec<Stretch>>,
    ) {
        let deposit = self.space.deposit;
        let now = self.track.at(middle(range));
        let moved_m = self.track.moves_m(&thing.rider, part, &now, range);
        let centre = self.part_from(thing, &now) * thing.body.centre;
        let reach_m = thing.body.radius_m + horizon_m + moved_m;
        let far =
            |(low, high): (Point, Point)| (centre.sup(&low).inf(&high) - centre).norm() > reach_m;
        if deposit.bounds().is_none_or(far) {
            return;
        }
        let mut near = Vec::new();
        match within {
            Some(list) => near.extend_from_slice(list),
            None => {
                let n_printed = self.printed + usize::from(self.touch.extrudes);
                let n_segments = self.space.beads.segments_of(n_printed);
                let pose = self.part_from(thing, &now);
                let within_m = horizon_m + moved_m;
                self.space.beads.within(thing.body, &pose, n_segments, within_m, &mut near);
            }
        }
        near.retain(|&index| {
            let segment = &deposit.segments[index as usize];
            to_piece(&centre, &segment.ends) <= reach_m + segment.radius_m
        });
        if near.is_empty() {
            return;
        }
        if moved_m > BROAD_M {
            let split = super::sweep::split(range);
            for half in [[range[0], split], [split, range[1]]] {
                self.broad(thing, part, horizon_m, half, Some(&near), by_order);
            }
            return;
        }
        let order_of = |index: u32| deposit.segments[index as usize].order;
        for group in near.chunk_by(|&a, &b| order_of(a) == order_of(b)) {
            by_order.entry(order_of(group[0])).or_default().push((range, group.to_vec()));
        }
    }

    fn in_progress(&self, order: usize) -> bool {
        self.touch.extrudes && order == self.printed
    }

    fn strand(
        &self,
        thing: &Thing<'_>,
        part: &Rider,
        order: usize,
        stretches: Vec<Stretch>,
        asked: &Asked,
    ) -> Option<Covered> {
        let none = Vec::new();
        let is_nozzle = thing.kind == Kind::Nozzle;
        let zones = self.touch.strands.get(&order).filter(|_| is_nozzle).unwrap_or(&none);
        least(asked, stretches, |range, near: &Vec<u32>, cutoff_m| {
            let now = self.track.at(middle(range));
            let moved_m = self.track.moves_m(&thing.rider, part, &now, range);
            let pose = self.part_from(thing, &now);
            let reach_m = cutoff_m + moved_m;
            if self.in_progress(order) {
                self.growing(thing, near, &now, range, (&pose, moved_m, reach_m))
            } else {
                let zone_m = self.space.job.limits.touch_zone_m;
                let (least_m, keep) =
                    self.beads(thing, near, &pose, reach_m, (zones, zone_m), f64::INFINITY);
                Look { found_m: least_m, low_m: least_m - moved_m, keep }
            }
        })
    }

    /// A look at the strand in progress: it grows along the range, and the touch zone moves. Over
    /// the range all is there that is at its end, and only that may be touched which always may.
    fn growing(
        &self,
        thing: &Thing<'_>,
        near: &[u32],
        now: &Instant,
        range: [f64; 2],
        (pose, moved_m, reach_m): (&Pose, f64, f64),
    ) -> Look<Vec<u32>> {
        let tip = [self.tip(now)];
        let zone_m = self.space.job.limits.touch_zone_m;
        let always_m = zone_m - self.tip_moves_m(now, range);
        let zones: &[Point] = if always_m > 0.0 { &tip } else { &[] };
        let end_m = self.track.at_m(range[1]).max(self.track.at_m(range[0]));
        let (least_m, keep) = self.beads(thing, near, pose, reach_m, (zones, always_m), end_m);
        let at_m = self.track.at_m(now.u);
        let (found_m, _) = self.beads(thing, &keep, pose, reach_m, (&tip, zone_m), at_m);
        Look { found_m, low_m: least_m - moved_m, keep }
    }

    /// Least clearance to what of these segments is printed up to `at_m` and lies outside the zones,
    /// and the segments within reach.
    fn beads(
        &self,
        thing: &Thing<'_>,
        near: &[u32],
        pose: &Pose,
        reach_m: f64,
        (zones, zone_m): (&[Point], f64),
        at_m: f64,
    ) -> (f64, Vec<u32>) {
        let centre = pose * thing.body.centre;
        let mut least_m = f64::INFINITY;
        let mut pieces = Vec::new();
        let mut keep = Vec::with_capacity(near.len());
        for &index in near {
            let segment = &self.space.deposit.segments[index as usize];
            let sphere_m = to_piece(&centre, &segment.ends) - thing.body.radius_m;
            if sphere_m - segment.radius_m > reach_m {
                continue;
            }
            let Some(whole) = printed_so_far(segment, at_m) else { continue };
            zone::outside(whole, zones, zone_m, &mut pieces);
            let clearance_m = pieces
                .iter()
                .map(|piece| thing.body.to_bead(pose, piece, segment.radius_m, reach_m))
                .fold(f64::INFINITY, f64::min);
            if clearance_m <= reach_m {
                keep.push(index);
                least_m = least_m.min(clearance_m);
            }
        }
        (least_m, keep)
    }
}

/// The part of a segment that is there when the nozzle stands at `at_m` of its strand.
fn printed_so_far(segment: &Segment, at_m: f64) -> Option<zone::Piece> {
    if segment.at_m[1] <= at_m {
        return Some(segment.ends);
    }
    if segment.at_m[0] >= at_m {
        return None;
    }
    let share = (at_m - segment.at_m[0]) / (segment.at_m[1] - segment.at_m[0]);
    Some([segment.ends[0], segment.ends[0] + (segment.ends[1] - segment.ends[0]) * share])
}

fn to_piece(point: &Point, piece: &zone::Piece) -> f64 {
    let along = piece[1] - piece[0];
    let share = ((point - piece[0]).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE))
        .clamp(0.0, 1.0);
    (point - (piece[0] + along * share)).norm()
}
