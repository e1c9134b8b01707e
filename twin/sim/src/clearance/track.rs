//! A joint path and bounds on how far bodies move along it relative to each other.
//!
//! Between two postures every joint turns evenly, `q(u) = a + (b − a) (u − k)`. `u` counts postures.

use crate::kinematics::{Chain, JointKind, Posture};
use crate::pose::{Point, Pose, Vector};

/// A joint as clearance sees it.
#[derive(Debug, Clone, Copy)]
struct Joint {
    slides: bool,
    /// Axis in the joint's own axes, unit; a turn about it leaves it where it is.
    axis: Vector,
    /// The entry of `q` that drives it, and how many times faster it goes.
    entry: usize,
    gear: f64,
}

/// A sphere about all points of a body, and the joint the body moves with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rider {
    /// Last joint that moves it; `None`: it stands with the base.
    pub(crate) carrier: Option<usize>,
    /// Centre in the axes of that joint's link (or the base).
    pub(crate) centre: Point,
    /// Radius, m.
    pub(crate) radius_m: f64,
}

/// Where the links are at one place of the path.
#[derive(Debug, Clone)]
pub(crate) struct Instant {
    /// The place.
    pub(crate) u: f64,
    /// Poses of the links in the base, one per joint.
    pub(crate) links: Vec<Pose>,
}

impl Instant {
    /// Pose of what a joint carries.
    pub(crate) fn carrier(&self, carrier: Option<usize>) -> Pose {
        carrier.map_or_else(Pose::identity, |joint| self.links[joint])
    }
}

/// A joint path.
#[derive(Debug, Clone)]
pub(crate) struct Track<'a> {
    chain: &'a Chain,
    joints: Vec<Joint>,
    q: Vec<Posture>,
    /// Arc length on the strand being printed, at each posture, m.
    at_m: Vec<f64>,
    /// Travel of every joint from the start, posture by posture, rad or m.
    travel: Vec<f64>,
}

impl<'a> Track<'a> {
    /// A path through these postures; `at_m` holds the arc length on the strand at each.
    pub(crate) fn new(chain: &'a Chain, q: Vec<Posture>, at_m: Vec<f64>) -> Self {
        let joints = joints(chain);
        let mut travel = vec![0.0; joints.len()];
        for pair in q.windows(2) {
            let last = travel.len() - joints.len();
            for (j, joint) in joints.iter().enumerate() {
                let step = (pair[1][joint.entry] - pair[0][joint.entry]).abs() * joint.gear.abs();
                travel.push(travel[last + j] + step);
            }
        }
        Self { chain, joints, q, at_m, travel }
    }

    /// The last place.
    pub(crate) fn end(&self) -> f64 {
        self.q.len().saturating_sub(1) as f64
    }

    /// The posture before `u`, and the share of the way from it to the next.
    pub(crate) fn step(&self, u: f64) -> (usize, f64) {
        let k = (u.max(0.0) as usize).min(self.q.len().saturating_sub(2));
        (k, (u - k as f64).clamp(0.0, 1.0))
    }

    /// Value between those of two postures.
    pub(crate) fn between(&self, u: f64, value: impl Fn(usize) -> f64) -> f64 {
        let (k, share) = self.step(u);
        if share == 0.0 { value(k) } else { value(k) + (value(k + 1) - value(k)) * share }
    }

    /// Joint values at `u`.
    pub(crate) fn posture(&self, u: f64) -> Posture {
        let (k, share) = self.step(u);
        if share > 0.0 { self.q[k].toward(&self.q[k + 1], share) } else { self.q[k] }
    }

    /// Arc length on the strand being printed at `u`, m.
    pub(crate) fn at_m(&self, u: f64) -> f64 {
        self.between(u, |k| self.at_m.get(k).copied().unwrap_or(0.0))
    }

    /// Where the links are at `u`.
    pub(crate) fn at(&self, u: f64) -> Instant {
        let mut links = Vec::with_capacity(self.joints.len());
        self.chain.link_poses(&self.posture(u), &mut links);
        Instant { u, links }
    }

    fn travel(&self, joint: usize, u: f64) -> f64 {
        self.between(u, |k| self.travel[k * self.joints.len() + joint])
    }

    /// Bound on how far any point of `one` moves relative to `two`, as far as their distance is
    /// concerned, between `now` and any place in `range` about it, m.
    ///
    /// ```text
    /// |d(u) − d(now)| ≤ Σⱼ Δqⱼ · min(Lⱼ(one), Lⱼ(two))          all joints between the two
    /// Lⱼ(body) = distance of its farthest point from axis j now + what joints between move it
    /// ```
    ///
    /// Either body's lever will do: the shortest distance runs along the line between the nearest
    /// points, and a turn of that line about itself does not lengthen it. A sliding joint has
    /// `Lⱼ = 1`. Within one step, where joint speeds are constant, the speed of the bodies now and a
    /// bound on their acceleration give a second bound, tighter where joints work against each other:
    ///
    /// ```text
    /// |Δx| ≤ |ẋ| Δu + K Δu²/2,   K = Σₖ |q̇ₖ| Lₖ (|q̇ₖ| + 2 Σ_{j beyond k} |q̇ⱼ|)
    /// ```
    pub(crate) fn moves_m(&self, one: &Rider, two: &Rider, now: &Instant, range: [f64; 2]) -> f64 {
        let rank = |rider: &Rider| rider.carrier.map_or(0, |joint| joint + 1);
        let (low, high) = if rank(one) <= rank(two) { (one, two) } else { (two, one) };
        let between = rank(low)..rank(high);
        if between.is_empty() || range[1] <= range[0] {
            return 0.0;
        }
        let reach = |to_u: f64| {
            let [from_u, to_u] = [now.u.min(to_u), now.u.max(to_u)];
            let travel = |joint: usize| self.travel(joint, to_u) - self.travel(joint, from_u);
            let outer = self.levers(high, between.clone().rev(), now, &travel);
            let inner = self.levers(low, between.clone(), now, &travel);
            let n = outer.len();
            let sum: f64 = (0..n)
                .map(|k| outer[k].travel * outer[k].lever_m.min(inner[n - 1 - k].lever_m))
                .sum();
            let within_step = to_u <= from_u.floor() + 1.0;
            if !within_step || sum == 0.0 {
                return sum;
            }
            sum.min(displaced_m(&outer, high.radius_m)).min(displaced_m(&inner, low.radius_m))
        };
        reach(range[0]).max(reach(range[1]))
    }

    /// How joints move a body, in order from the body outward.
    fn levers(
        &self,
        rider: &Rider,
        outward: impl Iterator<Item = usize>,
        now: &Instant,
        travel: &impl Fn(usize) -> f64,
    ) -> Vec<Lever> {
        let centre = now.carrier(rider.carrier) * rider.centre;
        let (k, _) = self.step(now.u);
        let next = (k + 1).min(self.q.len() - 1);
        let mut moved_m = 0.0;
        outward
            .map(|index| {
                let joint = &self.joints[index];
                let link = &now.links[index];
                let axis = link.rotation * joint.axis;
                let arm = axis.cross(&(centre - Point::from(link.translation.vector)));
                let signed = (self.q[next][joint.entry] - self.q[k][joint.entry]) * joint.gear;
                let travel = travel(index);
                let lever_m =
                    if joint.slides { 1.0 } else { arm.norm() + rider.radius_m + moved_m };
                moved_m += travel * lever_m;
                let along = travel * signed.signum();
                let (centre, turn) = if joint.slides {
                    (axis * along, Vector::zeros())
                } else {
                    (arm * along, axis * along)
                };
                Lever { lever_m, travel, slides: joint.slides, centre, turn }
            })
            .collect()
    }
}

/// What one joint does to a body over a stretch.
struct Lever {
    /// Bound on the distance of the body's points from the axis; 1 of a sliding joint.
    lever_m: f64,
    /// Its travel, rad or m.
    travel: f64,
    slides: bool,
    /// Motion of the body's centre at the rate of now, m.
    centre: Vector,
    /// Its turn, rad.
    turn: Vector,
}

/// Bound on the displacement of a body's points by the rates of now and what they can change.
fn displaced_m(outward: &[Lever], radius_m: f64) -> f64 {
    let centre: Vector = outward.iter().map(|lever| lever.centre).sum();
    let turn: Vector = outward.iter().map(|lever| lever.turn).sum();
    let mut beyond = 0.0;
    let mut bend_m = 0.0;
    for lever in outward.iter().rev() {
        let own = if lever.slides { 0.0 } else { lever.travel };
        bend_m += lever.travel * lever.lever_m * (own + 2.0 * beyond);
        beyond += own;
    }
    centre.norm() + turn.norm() * radius_m + bend_m / 2.0
}

fn joints(chain: &Chain) -> Vec<Joint> {
    let all = chain.joints();
    let drive = |index: usize| {
        let (mut at, mut gear) = (index, 1.0);
        // A chain without loops ends before it has passed every joint.
        for _ in 0..all.len() {
            let Some(mimic) = all[at].mimic else { break };
            gear *= mimic.multiplier;
            at = mimic.master;
        }
        let entry = chain.axes().iter().position(|axis| axis.joint == at);
        (entry.unwrap_or(0), gear)
    };
    (0..all.len())
        .map(|index| {
            let (entry, gear) = drive(index);
            let slides = all[index].kind == JointKind::Prismatic;
            Joint { slides, axis: all[index].axis, entry, gear }
        })
        .collect()
}
