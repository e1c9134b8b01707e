//! Tool, arm and moving bed against bed, forms, fixtures and the arm itself.

use super::{Apart, Look, Now};
use crate::cell::{Join, Mode, On};
use crate::clearance::{Body, LinkBody};
use crate::finding::{Code, Phase};
use crate::pose::{Point, Pose};

/// A body and its pose in world axes.
type Placed<'a> = (&'a Body, Pose);

impl<'a> Look<'a> {
    /// Tool parts against bed, forms and fixtures.
    pub(super) fn tool_and_fixtures(&mut self, now: &Now) {
        let (on_bed, on_form) = (self.may_touch_bed(now), self.may_touch_form(now));
        let tool_moves = self.job.cell.mode == Mode::ToolOnFlange;
        for tool in &self.bodies.tool {
            let part = (&tool.body, now.world_from_tool);
            self.pair(Code::C205, part, self.bed(now), tool.nozzle && on_bed, now);
            for form in self.forms(now) {
                self.pair(Code::C205, part, form, tool.nozzle && on_form, now);
            }
            for obstacle in self.obstacles().filter(|_| tool_moves) {
                self.pair(Code::C205, part, obstacle, false, now);
            }
        }
    }

    /// Arm links, and the bed if it rides on the arm, against what stands still.
    pub(super) fn arm_and_fixtures(&mut self, now: &Now) {
        let bed_rides = self.job.cell.mode == Mode::BedOnFlange;
        for link in self.bodies.links.iter().filter(|link| link.carrier.is_some()) {
            let link = (&link.body, link_pose(link, now));
            if !bed_rides {
                self.pair(Code::C205, link, self.bed(now), false, now);
                for form in self.forms(now) {
                    self.pair(Code::C205, link, form, false, now);
                }
            }
            for obstacle in self.obstacles() {
                self.pair(Code::C205, link, obstacle, false, now);
            }
        }
        for obstacle in self.obstacles().filter(|_| bed_rides) {
            self.pair(Code::C205, self.bed(now), obstacle, false, now);
        }
    }

    /// Links against links, and tool (or the bed that rides) against links.
    pub(super) fn arm_and_itself(&mut self, now: &Now) {
        let bodies = self.bodies;
        for &[i, j] in &bodies.link_pairs {
            let placed = |k: usize| (&bodies.links[k].body, link_pose(&bodies.links[k], now));
            self.pair(Code::C206, placed(i), placed(j), false, now);
        }
        let bed_rides = self.job.cell.mode == Mode::BedOnFlange;
        for (index, link) in bodies.links.iter().enumerate() {
            let off_flange = bodies.links_off_flange.contains(&index);
            let link = (&link.body, link_pose(link, now));
            for tool in bodies.tool.iter().filter(|_| bed_rides || off_flange) {
                self.pair(Code::C206, (&tool.body, now.world_from_tool), link, false, now);
            }
            if bed_rides && off_flange {
                self.pair(Code::C206, self.bed(now), link, false, now);
            }
        }
    }

    fn bed(&self, now: &Now) -> Placed<'a> {
        (&self.bodies.bed, now.world_from_bed)
    }

    fn forms(&self, now: &Now) -> impl Iterator<Item = Placed<'a>> + use<'a> {
        let world_from_part = now.part_from_world.inverse();
        self.bodies.forms.iter().map(move |form| (form, world_from_part))
    }

    fn obstacles(&self) -> impl Iterator<Item = Placed<'a>> + use<'a> {
        self.bodies.obstacles.iter().map(|obstacle| (obstacle, Pose::identity()))
    }

    /// Measures two bodies. Those that may touch may press into each other by half a bead.
    fn pair(&mut self, code: Code, one: Placed<'a>, two: Placed<'a>, may_touch: bool, now: &Now) {
        let ((body, pose), (other, other_pose)) = (one, two);
        // Bodies live as long as the look does: their addresses tell them apart, names need not.
        let key = (std::ptr::from_ref(body) as usize, std::ptr::from_ref(other) as usize);
        let still_apart = self.apart.get(&key).is_some_and(|known| {
            let moved_m =
                body.moved(&known.pose, &pose) + other.moved(&known.other_pose, &other_pose);
            known.clearance_m - moved_m > self.horizon_m
        });
        if still_apart {
            return;
        }
        let clearance_m = body.to_body(&pose, other, &other_pose, self.horizon_m);
        if clearance_m > self.horizon_m {
            self.apart.insert(key, Apart { clearance_m, pose, other_pose });
            return;
        }
        let limit_m = if may_touch { -self.half_bead_m } else { self.job.limits.clearance_m };
        self.measured(code, clearance_m, limit_m, [&body.name, &other.name], now);
    }

    /// Whether the nozzle works on the bed here: its strand lies on it, or ends on it nearby.
    fn may_touch_bed(&self, now: &Now) -> bool {
        let Some(strand) = self.leg.strand.map(|strand| &self.job.strands[strand]) else {
            return false;
        };
        if self.leg.phase == Phase::Transit {
            return false;
        }
        let ends =
            [(strand.start.join, strand.points.first()), (strand.end.join, strand.points.last())];
        let low_m = 2.0 * self.half_bead_m;
        let grounded = |(join, point): (Option<Join>, Option<&Point>)| {
            point.is_some_and(|point| {
                let touches = match join {
                    Some(join) => join == Join::Bed,
                    None => (self.job.bed_from_part * point).z <= low_m,
                };
                touches && (point - now.tip).norm() <= self.reach_of_touch_m()
            })
        };
        strand.on == On::Bed || ends.into_iter().any(grounded)
    }

    fn may_touch_form(&self, now: &Now) -> bool {
        let Some(strand) = self.leg.strand.map(|strand| &self.job.strands[strand]) else {
            return false;
        };
        let near_end = |join: Option<Join>, point: Option<&Point>| {
            matches!(join, Some(Join::Form(_)))
                && point.is_some_and(|point| (point - now.tip).norm() <= self.reach_of_touch_m())
        };
        self.leg.phase != Phase::Transit
            && (matches!(strand.on, On::Form(_))
                || near_end(strand.start.join, strand.points.first())
                || near_end(strand.end.join, strand.points.last()))
    }

    fn reach_of_touch_m(&self) -> f64 {
        self.job.limits.touch_zone_m
    }
}

fn link_pose(link: &LinkBody, now: &Now) -> Pose {
    link.carrier.map_or_else(Pose::identity, |joint| now.carriers[joint]) * link.carrier_from_link
}
