//! Tool, arm and moving bed against bed, forms, fixtures and the arm itself.

use super::bodies::{Body, LinkBody};
use super::{Apart, Look, Now};
use crate::cell::{Join, Mode, On};
use crate::finding::{Code, Phase};
use crate::pose::{Point, Pose};

impl<'a> Look<'a> {
    /// Tool parts against bed, forms and fixtures.
    pub(super) fn tool_and_fixtures(&mut self, now: &Now) {
        let bodies = self.bodies;
        let world_from_part = now.part_from_world.inverse();
        for tool in &bodies.tool {
            let body = &tool.body;
            let on_bed = tool.nozzle && self.may_touch_bed(now);
            let on_form = tool.nozzle && self.may_touch_form(now);
            self.pair(
                Code::C205,
                body,
                &now.world_from_tool,
                &bodies.bed,
                &now.world_from_bed,
                on_bed,
                now,
            );
            for form in &bodies.forms {
                self.pair(
                    Code::C205,
                    body,
                    &now.world_from_tool,
                    form,
                    &world_from_part,
                    on_form,
                    now,
                );
            }
            if self.job.cell.mode == Mode::ToolOnFlange {
                for obstacle in &bodies.obstacles {
                    self.pair(
                        Code::C205,
                        body,
                        &now.world_from_tool,
                        obstacle,
                        &Pose::identity(),
                        false,
                        now,
                    );
                }
            }
        }
    }

    /// Arm links, and the bed if it rides on the arm, against what stands still.
    pub(super) fn arm_and_fixtures(&mut self, now: &Now) {
        let bodies = self.bodies;
        let world_from_part = now.part_from_world.inverse();
        let bed_rides = self.job.cell.mode == Mode::BedOnFlange;
        for link in bodies.links.iter().filter(|link| link.carrier.is_some()) {
            let pose = link_pose(link, now);
            if !bed_rides {
                self.pair(
                    Code::C205,
                    &link.body,
                    &pose,
                    &bodies.bed,
                    &now.world_from_bed,
                    false,
                    now,
                );
                for form in &bodies.forms {
                    self.pair(Code::C205, &link.body, &pose, form, &world_from_part, false, now);
                }
            }
            for obstacle in &bodies.obstacles {
                self.pair(Code::C205, &link.body, &pose, obstacle, &Pose::identity(), false, now);
            }
        }
        if bed_rides {
            for obstacle in &bodies.obstacles {
                self.pair(
                    Code::C205,
                    &bodies.bed,
                    &now.world_from_bed,
                    obstacle,
                    &Pose::identity(),
                    false,
                    now,
                );
            }
        }
    }

    /// Links against links, and tool (or the bed that rides) against links.
    pub(super) fn arm_and_itself(&mut self, now: &Now) {
        let bodies = self.bodies;
        for &[i, j] in &bodies.link_pairs {
            let (a, b) = (&bodies.links[i], &bodies.links[j]);
            self.pair(
                Code::C206,
                &a.body,
                &link_pose(a, now),
                &b.body,
                &link_pose(b, now),
                false,
                now,
            );
        }
        let bed_rides = self.job.cell.mode == Mode::BedOnFlange;
        for (index, link) in bodies.links.iter().enumerate() {
            let pose = link_pose(link, now);
            if bed_rides || bodies.links_off_flange.contains(&index) {
                for tool in &bodies.tool {
                    self.pair(
                        Code::C206,
                        &tool.body,
                        &now.world_from_tool,
                        &link.body,
                        &pose,
                        false,
                        now,
                    );
                }
            }
            if bed_rides && bodies.links_off_flange.contains(&index) {
                self.pair(
                    Code::C206,
                    &bodies.bed,
                    &now.world_from_bed,
                    &link.body,
                    &pose,
                    false,
                    now,
                );
            }
        }
    }

    /// Measures two bodies. Those that may touch may press into each other by half a bead.
    #[allow(
        clippy::too_many_arguments,
        reason = "two bodies, each with its pose, and how they are judged"
    )]
    fn pair(
        &mut self,
        code: Code,
        body: &'a Body,
        pose: &Pose,
        other: &'a Body,
        other_pose: &Pose,
        may_touch: bool,
        now: &Now,
    ) {
        let known = self.apart.get(&(body.name.as_str(), other.name.as_str()));
        let still_apart = known.is_some_and(|known| {
            let moved_m =
                body.moved(&known.pose, pose) + other.moved(&known.other_pose, other_pose);
            known.clearance_m - moved_m > self.horizon_m
        });
        if still_apart {
            return;
        }
        let clearance_m = body.to_body(pose, other, other_pose, self.horizon_m);
        if clearance_m > self.horizon_m {
            let apart = Apart { clearance_m, pose: *pose, other_pose: *other_pose };
            self.apart.insert((&body.name, &other.name), apart);
            return;
        }
        let limit_m = if may_touch { -self.half_bead_m() } else { self.job.limits.clearance_m };
        self.measured(code, clearance_m, limit_m, [&body.name, &other.name], now);
    }

    fn half_bead_m(&self) -> f64 {
        let printed = self.leg.strand.and_then(|strand| {
            self.deposit.strands.iter().find(|printed| printed.strand == strand)
        });
        printed.map_or(0.0, |printed| printed.radius_m)
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
        let low_m = 2.0 * self.half_bead_m();
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
