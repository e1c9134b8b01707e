//! Tool and arm against the deposit.

use super::zone::{self, Piece};
use super::{Look, Now};
use crate::clearance::Body;
use crate::finding::{Code, Phase};
use crate::pose::{Point, Pose, Vector};

impl Look<'_> {
    /// Nozzle and other tool parts against earlier strands and the strand in progress.
    pub(super) fn tool_and_strands(&mut self, now: &Now) {
        let bodies = self.bodies;
        let part_from_tool = now.part_from_world * now.world_from_tool;
        for tool in &bodies.tool {
            let code = if tool.nozzle { Code::C201 } else { Code::C202 };
            self.body_and_strands(&tool.body, &part_from_tool, tool.nozzle, code, now);
        }
    }

    /// Arm links against all that is printed so far.
    pub(super) fn arm_and_strands(&mut self, now: &Now) {
        let bodies = self.bodies;
        for link in &bodies.links {
            let world_from_carrier =
                link.carrier.map_or_else(Pose::identity, |joint| now.carriers[joint]);
            let part_from_link = now.part_from_world * world_from_carrier * link.carrier_from_link;
            self.body_and_strands(&link.body, &part_from_link, false, Code::C203, now);
        }
    }

    fn body_and_strands(&mut self, body: &Body, pose: &Pose, nozzle: bool, code: Code, now: &Now) {
        let centre = pose * body.centre;
        let reach_m = body.radius_m + self.horizon_m;
        let out_of_reach = |(low, high): (Point, Point)| {
            let nearest = centre.sup(&low).inf(&high);
            (nearest - centre).norm() > reach_m
        };
        if self.deposit.bounds().is_none_or(out_of_reach) {
            return;
        }
        let reach = Vector::repeat(reach_m);
        let mut near = std::mem::take(&mut self.near);
        let deposit = self.deposit;
        deposit.near(centre - reach, centre + reach, &mut near);
        let mut pieces: Vec<Piece> = Vec::new();
        let mut zones: Vec<Point> = Vec::new();
        // One clearance per strand, so that each is judged and told once.
        let of_strand = |index: &u32| deposit.segments[*index as usize].order;
        for group in near.chunk_by(|a, b| of_strand(a) == of_strand(b)) {
            let order = of_strand(&group[0]);
            let in_progress = order == self.leg.printed && self.leg.phase == Phase::Print;
            if order > self.leg.printed || (order == self.leg.printed && !in_progress) {
                continue;
            }
            self.zones(order, in_progress, nozzle, now, &mut zones);
            let mut least = f64::INFINITY;
            for &index in group {
                let segment = &deposit.segments[index as usize];
                let Some(whole) = printed_so_far(segment, in_progress, now.at_m) else { continue };
                zone::outside(whole, &zones, self.job.limits.touch_zone_m, &mut pieces);
                for piece in &pieces {
                    least = least.min(body.to_bead(pose, piece, segment.radius_m, self.horizon_m));
                }
            }
            if least <= self.horizon_m {
                let strand = &self.job.strands[deposit.strands[order].strand];
                let code = if in_progress && code != Code::C203 { Code::C204 } else { code };
                self.measured(
                    code,
                    least,
                    self.job.limits.clearance_m,
                    [&body.name, &strand.id],
                    now,
                );
            }
        }
        self.near = near;
    }

    /// Centres of the touch zones on the strand of this order.
    fn zones(
        &self,
        order: usize,
        in_progress: bool,
        nozzle: bool,
        now: &Now,
        zones: &mut Vec<Point>,
    ) {
        zones.clear();
        if in_progress {
            // The strand leaves the nozzle here; every part of the tool sees it come.
            zones.push(now.tip);
        } else if nozzle {
            let concerned =
                self.zone_contacts.iter().filter(|contact| contact.orders.contains(&order));
            zones.extend(concerned.map(|contact| contact.middle()));
            // The strand just finished may be touched where the nozzle leaves it.
            if order + 1 == self.leg.printed {
                zones.extend(self.left);
            }
        }
    }
}

/// The part of a segment that is there when the nozzle stands at `at_m` of its strand.
fn printed_so_far(
    segment: &crate::deposit::Segment,
    in_progress: bool,
    at_m: f64,
) -> Option<Piece> {
    if !in_progress || segment.at_m[1] <= at_m {
        return Some(segment.ends);
    }
    if segment.at_m[0] >= at_m {
        return None;
    }
    let share = (at_m - segment.at_m[0]) / (segment.at_m[1] - segment.at_m[0]);
    Some([segment.ends[0], segment.ends[0] + (segment.ends[1] - segment.ends[0]) * share])
}
