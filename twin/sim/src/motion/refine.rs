//! Turns that are not stuck on the fan: a search by ever smaller steps about the way up the ladder.
//!
//! First the whole strand is turned at once, then each post by itself; a step is kept if the sum of what
//! the ladder weighs gets less. Branches are kept. It ends on the last step of [`STEPS_DEG`], not at a
//! minimum.

use super::climb::Clearance;
use super::cost::Step;
use super::ladder;
use super::place::{Course, Turn};
use super::walk::Post;
use crate::cell::Spin;
use crate::kinematics::{Posture, Solution, Solver};

/// Steps tried, each both ways: half a cell of the fan and on down.
const STEPS_DEG: [f64; 4] = [7.5, 3.75, 1.875, 0.9375];
/// A joint that has to turn further than this for a step has gone another way, rad.
const FAR_RAD: f64 = 0.7;
/// Dislike of a change of turn between posts, per rad².
const UNEVEN: f64 = 0.2;

/// Makes the posts of a strand cheaper, one small turn at a time.
pub(super) fn refine(
    course: &Course<'_>,
    posts: &mut [Post],
    from: &Posture,
    clearance: Option<Clearance<'_>>,
) {
    let free = free(course);
    if free.is_empty() || posts.is_empty() || course.costs.searched() {
        return;
    }
    let pairs = posts.windows(2);
    let steps = pairs.map(|pair| ladder::step(course, pair[0].sample, pair[1].sample)).collect();
    let mut this = Refine { course, from, clearance, steps, solutions: Vec::new() };
    let mut costs: Vec<Own> = posts.iter().map(|post| this.own(post)).collect();
    for step_deg in STEPS_DEG {
        let before: Vec<(Post, Own)> = posts.iter().copied().zip(costs.iter().copied()).collect();
        for &entry in &free {
            for step_rad in [step_deg.to_radians(), -step_deg.to_radians()] {
                this.all(posts, &mut costs, entry, step_rad);
                for k in 0..posts.len() {
                    this.one(posts, &mut costs, k, entry, step_rad);
                }
            }
        }
        // Posts that were clear of everything are looked at once per step, not at every try.
        for (k, (post, own)) in before.into_iter().enumerate() {
            if costs[k].near == 0.0 && posts[k].turn != post.turn && this.near(&posts[k]) > 0.0 {
                (posts[k], costs[k]) = (post, own);
            }
        }
    }
}

/// Dislike of one post by itself.
#[derive(Debug, Clone, Copy)]
struct Own {
    posture: f64,
    near: f64,
}

/// The entries of a turn that the job and the arm leave free.
fn free(course: &Course<'_>) -> Vec<usize> {
    let (orientation, solver) = (course.orientation(), &course.job.cell.robot.arm.solver);
    if matches!(solver, Solver::Cartesian(_)) {
        return Vec::new();
    }
    let mut free = Vec::new();
    free.extend((orientation.spin == Spin::Free).then_some(Turn::SPIN));
    if orientation.tilt_free_rad > 0.0 {
        free.extend([Turn::LEAN, Turn::LEAN + 1]);
    }
    free.extend(matches!(solver, Solver::Srs(_)).then_some(Turn::ELBOW));
    free
}

struct Refine<'a> {
    course: &'a Course<'a>,
    from: &'a Posture,
    clearance: Option<Clearance<'a>>,
    /// Between neighbouring posts.
    steps: Vec<Step>,
    solutions: Vec<Solution>,
}

impl Refine<'_> {
    fn own(&self, post: &Post) -> Own {
        Own { posture: self.course.costs.posture(&post.q), near: self.near(post) }
    }

    fn near(&self, post: &Post) -> f64 {
        let place = &self.course.path.samples[post.sample];
        self.clearance.map_or(0.0, |look| self.course.costs.clearance(look(place, &post.q)))
    }

    /// Cost of the ways to and from post `k`.
    fn ways(&self, posts: &[Post], k: usize) -> f64 {
        let before = match k {
            0 => self.course.costs.travel(self.from, &posts[0].q),
            _ => self.way(&posts[k - 1], &posts[k], &self.steps[k - 1]),
        };
        let after = posts.get(k + 1).map(|next| self.way(&posts[k], next, &self.steps[k]));
        before + after.unwrap_or(0.0)
    }

    fn way(&self, from: &Post, to: &Post, step: &Step) -> f64 {
        if !self.course.costs.keeps((&from.q, from.branch), (&to.q, to.branch)) {
            return super::cost::FLIP_COST;
        }
        let [apart_rad, turn_rad] = from.turn.apart(&to.turn);
        self.course.costs.step(&from.q, &to.q, turn_rad, step) + UNEVEN * apart_rad * apart_rad
    }

    fn total(&self, posts: &[Post], costs: &[Own]) -> f64 {
        let ways = (1..posts.len()).map(|k| self.way(&posts[k - 1], &posts[k], &self.steps[k - 1]));
        costs.iter().map(|own| own.posture + own.near).sum::<f64>()
            + ways.sum::<f64>()
            + self.course.costs.travel(self.from, &posts[0].q)
    }

    /// The post turned by a step, on the same branch.
    fn turned(&mut self, post: &Post, entry: usize, step_rad: f64) -> Option<Post> {
        let mut turn = post.turn;
        turn.0[entry] += step_rad;
        let pose = self.course.pose(&self.course.path.samples[post.sample], &turn)?;
        let solution = self.course.near(&pose, &turn, &post.q, &mut self.solutions)?;
        let q = self.course.costs.unwound(&post.q, &solution.q);
        let same = solution.branch == post.branch && q.distance(&post.q) <= FAR_RAD;
        same.then_some(Post { turn, q, ..*post })
    }

    fn one(
        &mut self,
        posts: &mut [Post],
        costs: &mut [Own],
        k: usize,
        entry: usize,
        step_rad: f64,
    ) {
        let (old, Own { posture, near }) = (posts[k], costs[k]);
        let old_cost = posture + near + self.ways(posts, k);
        let Some(new) = self.turned(&old, entry, step_rad) else { return };
        posts[k] = new;
        let mut own = Own { posture: self.course.costs.posture(&new.q), near: 0.0 };
        let ways = self.ways(posts, k);
        // Clearance last: it is the dearest to compute.
        if near > 0.0 && own.posture + ways < old_cost {
            own.near = self.near(&new);
        }
        if own.posture + own.near + ways < old_cost {
            costs[k] = own;
        } else {
            posts[k] = old;
        }
    }

    fn all(&mut self, posts: &mut [Post], costs: &mut Vec<Own>, entry: usize, step_rad: f64) {
        let turned: Option<Vec<Post>> =
            posts.iter().map(|post| self.turned(post, entry, step_rad)).collect();
        let Some(turned) = turned else { return };
        let old = self.total(posts, costs);
        let posture = |post: &Post| self.course.costs.posture(&post.q);
        let mut own: Vec<Own> =
            turned.iter().map(|post| Own { posture: posture(post), near: 0.0 }).collect();
        if self.total(&turned, &own) >= old {
            return;
        }
        for ((own, post), before) in own.iter_mut().zip(&turned).zip(&*costs) {
            if before.near > 0.0 {
                own.near = self.near(post);
            }
        }
        if self.total(&turned, &own) < old {
            posts.copy_from_slice(&turned);
            *costs = own;
        }
    }
}
