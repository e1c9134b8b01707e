//! What carries lamps and shades, when lamps are on, and where all of it is at an instant, seen from the part.

use nalgebra::Translation3;

use crate::pose::{Point, Pose, Vector};

use super::lamp::Lamp;
use super::shade::{Shade, to_line_m2};

/// What a lamp or a shade is fixed to, whose axes it is given in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Carrier {
    /// The nozzle: origin in the orifice, z the way the strand leaves.
    Tool,
    /// The cell.
    Room,
    /// The part, or the bed under it.
    Part,
}

/// Lamps that are switched together.
#[derive(Debug, Clone, PartialEq)]
pub struct LampSet {
    /// What carries them.
    pub carrier: Carrier,
    /// The lamps, in its axes.
    pub lamps: Vec<Lamp>,
    /// From when to when they are on, s; [`ALWAYS`] for all the time.
    pub on_s: Vec<[f64; 2]>,
}

/// On all the time.
pub const ALWAYS: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// All lamps, and all that stands in their way.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lights {
    /// Sets of lamps.
    pub sets: Vec<LampSet>,
    /// Opaque things, each in the axes of its carrier. They shade every lamp.
    pub shades: Vec<(Carrier, Shade)>,
}

/// Where the nozzle is at an instant of its run, seen from the part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Instant, s; never falls along the run.
    pub time_s: f64,
    /// Point of the strand that leaves the nozzle now, in part axes, m.
    pub point: Point,
    /// Nozzle seen from the part.
    pub part_from_tool: Pose,
    /// Cell seen from the part: moves where the bed is on the flange, rests where the tool is.
    pub part_from_room: Pose,
}

impl Station {
    /// Between this and the next; offsets on a straight line, turns on the shortest arc.
    pub(super) fn towards(&self, next: &Self, share: f64) -> Self {
        Self {
            time_s: self.time_s + (next.time_s - self.time_s) * share,
            point: self.point + (next.point - self.point) * share,
            part_from_tool: between(&self.part_from_tool, &next.part_from_tool, share),
            part_from_room: between(&self.part_from_room, &next.part_from_room, share),
        }
    }

    pub(super) fn part_from(&self, carrier: Carrier) -> Pose {
        match carrier {
            Carrier::Tool => self.part_from_tool,
            Carrier::Room => self.part_from_room,
            Carrier::Part => Pose::identity(),
        }
    }
}

fn between(a: &Pose, b: &Pose, share: f64) -> Pose {
    let offset = a.translation.vector.lerp(&b.translation.vector, share);
    // None at half a turn apart, where no arc is the shortest: the earlier one holds.
    let turn = a.rotation.try_slerp(&b.rotation, share, 1e-9).unwrap_or(a.rotation);
    Pose::from_parts(Translation3::from(offset), turn)
}

/// The lamps that are on and the shades at an instant, in part axes.
#[derive(Debug, Clone, Default)]
pub(super) struct Scene {
    pub(super) lamps: Vec<SeenLamp>,
    /// Tool, room and part seen from the part.
    pub(super) part_from: [Pose; 3],
    /// Which sets are on, a bit each, of the first 64.
    pub(super) lit: u64,
    shades: Vec<(Shade, Point, f64)>,
}

/// A lamp and the cosine beyond which its light is left out.
#[derive(Debug, Clone, Copy)]
pub(super) struct SeenLamp {
    pub(super) lamp: Lamp,
    pub(super) least_cosine: f64,
}

/// Share of a lamp's peak below which its light is left out.
pub(super) const LEAST_SHARE: f64 = 1e-4;

impl Lights {
    /// Instants at which a set is switched, s.
    pub(super) fn switch_times_s(&self) -> impl Iterator<Item = f64> {
        self.sets.iter().flat_map(|set| &set.on_s).flatten().copied().filter(|t| t.is_finite())
    }

    /// The scene at a station; `lit_at_s` says which sets are on.
    pub(super) fn scene(&self, station: &Station, lit_at_s: f64) -> Scene {
        let mut lamps = Vec::new();
        let mut lit = 0;
        for (index, set) in self.sets.iter().enumerate() {
            if set.on_s.iter().any(|on| on[0] <= lit_at_s && lit_at_s <= on[1]) {
                let pose = station.part_from(set.carrier);
                lit |= 1 << (index % 64);
                lamps.extend(set.lamps.iter().map(|lamp| SeenLamp {
                    lamp: lamp.moved(&pose),
                    least_cosine: lamp.cosine_at_share(LEAST_SHARE).max(0.0),
                }));
            }
        }
        let shades = if lamps.is_empty() { &[][..] } else { &self.shades[..] };
        let shades = shades
            .iter()
            .map(|(carrier, shade)| {
                let shade = shade.moved(&station.part_from(*carrier));
                let (centre, radius_m) = shade.ball();
                (shade, centre, radius_m)
            })
            .collect();
        let part_from = [Carrier::Tool, Carrier::Room, Carrier::Part];
        Scene { lamps, part_from: part_from.map(|c| station.part_from(c)), lit, shades }
    }
}

impl Scene {
    /// Which shades may stand between a lamp and a ball, a bit each (all from the 64th on share the last).
    ///
    /// Exact tests only where this says so.
    pub(super) fn near_shades(&self, lamp: Point, centre: Point, radius_m: f64) -> u64 {
        let near = |(_, at, size_m): &(Shade, Point, f64)| {
            let room = size_m + radius_m;
            to_line_m2(*at, lamp, centre) < room * room
        };
        let bits = self.shades.iter().enumerate().filter(|(_, shade)| near(shade));
        bits.fold(0, |bits, (i, _)| bits | 1 << i.min(63))
    }

    /// Whether one of the shades marked stands between a lamp and a point.
    pub(super) fn is_blocked(&self, marked: u64, lamp: Point, point: Point) -> bool {
        let mut shades = self.shades.iter().enumerate();
        shades.any(|(i, (shade, ..))| marked >> i.min(63) & 1 == 1 && shade.blocks(lamp, point))
    }

    /// Whether a ball may receive more than `floor_w_m2` from any lamp.
    ///
    /// Never no where it does: nearest point and best angle are taken apart. `slack_m` and `slack_rad` are how
    /// far the lamps may move or turn about this instant.
    pub(super) fn reaches(
        &self,
        centre: Point,
        radius_m: f64,
        slack_m: f64,
        slack_rad: f64,
        floor_w_m2: f64,
    ) -> bool {
        self.lamps.iter().any(|seen| {
            let ray: Vector = centre - seen.lamp.at;
            let (distance_m, radius_m) = (ray.norm(), radius_m + slack_m);
            let nearest_m = distance_m - radius_m;
            // Not a number, or inside: look closer.
            if !(nearest_m > 0.0) {
                return true;
            }
            let off = (seen.lamp.along.dot(&ray) / distance_m).clamp(-1.0, 1.0).acos();
            let off = off - (radius_m / distance_m).asin() - slack_rad;
            let cosine = off.max(0.0).cos();
            cosine >= seen.least_cosine
                && seen.lamp.intensity_w_sr(cosine) > floor_w_m2 * nearest_m * nearest_m
        })
    }
}
