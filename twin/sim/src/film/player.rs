//! Where everything is at any time.

use crate::motion::{Leg, Moment};
use crate::pose::{Point, Pose};
use crate::preflight::Preflight;

/// Finds postures and poses of a film's movers at any time.
#[derive(Debug, Clone)]
pub struct Player<'a> {
    preflight: &'a Preflight,
    /// Legs that have moments, in order of time.
    legs: Vec<&'a Leg>,
}

/// One instant of a film.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// When, s.
    pub time_s: f64,
    /// Joint values, rad or m.
    pub posture: Vec<f64>,
    /// `world_from_mover` of every entry of [`Film::movers`](super::Film::movers).
    pub world_from_mover: Vec<Pose>,
}

impl<'a> Player<'a> {
    /// A player of a checked job.
    pub fn new(preflight: &'a Preflight) -> Self {
        let legs = preflight.motion.legs.iter().filter(|leg| !leg.moments.is_empty()).collect();
        Self { preflight, legs }
    }

    /// The arm's posture, joints turning evenly between moments: at rest in the first before the program and in the last
    /// after it, home where nothing moves. O(log n).
    pub fn posture_at(&self, time_s: f64) -> Vec<f64> {
        let begun = self.legs.partition_point(|leg| leg.moments[0].time_s <= time_s);
        let Some(leg) = self.legs.get(begun.saturating_sub(1)) else {
            return self.preflight.job().cell.home.clone();
        };
        let k = leg.moments.partition_point(|moment| moment.time_s <= time_s);
        if k == 0 || k == leg.moments.len() {
            return leg.moments[k.saturating_sub(1)].q.to_vec();
        }
        let [from, to] = [&leg.moments[k - 1], &leg.moments[k]];
        let share = (time_s - from.time_s) / (to.time_s - from.time_s);
        from.q.toward(&to.q, share).to_vec()
    }

    /// Everything at a time.
    pub fn frame_at(&self, time_s: f64) -> Frame {
        self.frame_of(time_s, self.posture_at(time_s))
    }

    pub(super) fn frame_of(&self, time_s: f64, posture: Vec<f64>) -> Frame {
        let job = self.preflight.job();
        let cell = &job.cell;
        let chain = &cell.robot.arm.chain;
        let mut carriers = Vec::new();
        chain.link_poses(&posture, &mut carriers);
        let world_from_tip = chain.forward(&posture);
        let world_from_bed = cell.world_from_bed(&world_from_tip);
        let mut world_from_mover = vec![Pose::identity()];
        world_from_mover.extend(carriers);
        world_from_mover.extend([
            cell.world_from_tool(&world_from_tip),
            world_from_bed,
            world_from_bed * job.bed_from_part,
        ]);
        Frame { time_s, posture, world_from_mover }
    }

    /// Times of at most about `most` frames that a film can be shown by: all moments where there is room for them, else
    /// those between which the joints turn by about as much each; start and end of every leg are among them as long as they fit.
    ///
    /// O(n) in moments.
    pub fn key_times(&self, most: usize) -> Vec<f64> {
        let all: Vec<&Moment> = self.legs.iter().flat_map(|leg| &leg.moments).collect();
        if all.len() <= most {
            return ascending(all.iter().map(|moment| moment.time_s));
        }
        let room = most.saturating_sub(2 * self.legs.len()).max(most / 2).max(2);
        let way = |pair: &[&Moment]| pair[0].q.distance(&pair[1].q);
        let total: f64 = all.windows(2).map(way).sum();
        let step = total / room as f64;
        let mut gone = 0.0;
        let mut due = 0.0;
        let mut times: Vec<f64> = Vec::with_capacity(most);
        for pair in all.windows(2) {
            if gone >= due {
                times.push(pair[0].time_s);
                due = gone + step;
            }
            gone += way(pair);
        }
        let ends = self.legs.iter().flat_map(|leg| [leg.moments.first(), leg.moments.last()]);
        if times.len() + 2 * self.legs.len() <= most {
            times.extend(ends.flatten().map(|moment| moment.time_s));
        }
        times.extend(all.last().map(|moment| moment.time_s));
        ascending(times.into_iter())
    }

    /// The orifice in part axes at a frame.
    pub fn orifice(frame: &Frame) -> Point {
        let n = frame.world_from_mover.len();
        let [tool, part] = [n - 3, n - 1].map(|at| frame.world_from_mover[at]);
        part.inverse_transform_point(&Point::from(tool.translation.vector))
    }
}

fn ascending(times: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut times: Vec<f64> = times.collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}
