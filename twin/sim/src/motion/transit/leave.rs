//! Approach and retract: a straight way of the nozzle off a strand, or onto it backwards.

use std::f64::consts::TAU;

use super::ask::{Ask, Free};
use super::reason::{End, Reason};
use crate::cell::Job;
use crate::clearance::Blocked;
use crate::kinematics::Posture;
use crate::motion::between;
use crate::pose::{Point, Vector};

/// Angles to the axis that are tried, rad, and directions at each.
const TILTS_DEG: [f64; 4] = [15.0, 30.0, 45.0, 60.0];
const N_AROUND: usize = 8;

/// Where the nozzle leaves the strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Place {
    /// Part axes.
    pub(crate) point: Point,
    /// Nozzle axis in part axes, out of the nozzle.
    pub(crate) nozzle: Vector,
    /// Posture there.
    pub(crate) q: Posture,
}

/// A straight way off a strand.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Leaving {
    /// Postures from the strand outwards, that on the strand first.
    pub(crate) way: Vec<Posture>,
    /// Where it leads, unit, part axes.
    pub(crate) direction: Vector,
    /// Angle to the nozzle's axis, rad; zero: as asked.
    pub(crate) tilt_rad: f64,
    /// How long it is, m; shorter than asked where reach or room end.
    pub(crate) length_m: f64,
    /// Clearance that it keeps from its first step on, m; zero where no direction was found.
    pub(crate) keeps_m: f64,
    /// What is in the way along the nozzle's axis where no direction was found.
    pub(crate) reason: Option<Reason>,
}

/// Chooses how to leave a strand by `length_m`.
///
/// Along the nozzle's axis, as asked, keeping twice the limit or at least the limit; where neither
/// can be had, the first clear of: away from the strands that meet there (`away`), straight up, a fan
/// about the axis, all up to 60° from it; where none is clear over the whole length, the one that is
/// clear furthest. The tool does not turn. Where the nozzle on the strand is itself too near
/// something, which is the print's own finding, the way is judged from its first step on.
pub(crate) fn leave(
    job: &Job,
    place: &Place,
    length_m: f64,
    away: impl FnOnce() -> Option<Vector>,
    free: &Free<'_>,
) -> Leaving {
    let limit_m = job.limits.clearance_m;
    let Place { point, nozzle, q } = *place;
    let mut ask = Ask::new(free, limit_m);
    // What the print itself keeps here bounds what the first step can be asked to keep.
    let stands_m = [2.0 * limit_m, limit_m].into_iter().find(|&need_m| {
        ask.need_m = need_m;
        ask.clear(&q, &q).is_ok()
    });
    let asked = between::line(job, point, nozzle, -nozzle, &q, length_m);
    let on_strand = Way { direction: -nozzle, tilt_rad: 0.0, way: asked };
    let mut n_clear = 0;
    for need_m in [2.0 * limit_m, limit_m] {
        ask.need_m = need_m;
        n_clear = on_strand.n_clear(&mut ask, &q, stands_m);
        if n_clear == on_strand.way.len() {
            return on_strand.taken(&q, length_m, need_m);
        }
    }
    let full = on_strand.way.len();
    let mut best = (n_clear, on_strand.clone());
    for (tilt_rad, direction) in directions(job, nozzle, away()) {
        let way = between::line(job, point, nozzle, direction, &q, length_m);
        let other = Way { direction, tilt_rad, way };
        let n_clear = other.n_clear(&mut ask, &q, stands_m);
        if n_clear > best.0 {
            best = (n_clear, other);
        }
        if best.0 >= full {
            break;
        }
    }
    let (n_clear, mut best) = best;
    if n_clear == 0 {
        let reason = on_strand.blocked(&mut ask, &q, stands_m);
        let keeps_m = if reason.is_some() { 0.0 } else { limit_m };
        return Leaving { reason, ..on_strand.taken(&q, length_m, keeps_m) };
    }
    let share = n_clear as f64 / full.max(best.way.len()) as f64;
    best.way.truncate(n_clear);
    best.taken(&q, length_m * share, limit_m)
}

/// A direction and the postures along it, without the first.
#[derive(Clone)]
struct Way {
    direction: Vector,
    tilt_rad: f64,
    way: Vec<Posture>,
}

impl Way {
    /// How many steps from the strand are clear.
    fn n_clear(&self, ask: &mut Ask<'_>, on_strand: &Posture, stands_m: Option<f64>) -> usize {
        let mut before = *on_strand;
        let mut n_clear = 0;
        for q in &self.way {
            let answer = if n_clear == 0 {
                first_step(ask, on_strand, q, stands_m)
            } else {
                ask.clear(&before, q)
            };
            if answer.is_err() {
                break;
            }
            n_clear += 1;
            before = *q;
        }
        n_clear
    }

    /// What stops the first step, and where.
    fn blocked(
        &self,
        ask: &mut Ask<'_>,
        on_strand: &Posture,
        stands_m: Option<f64>,
    ) -> Option<Reason> {
        let first = self.way.first()?;
        let blocked = first_step(ask, on_strand, first, stands_m).err()?;
        let share = if stands_m.is_some() { blocked.share } else { 1.0 };
        let q = on_strand.toward(first, share);
        Some(Reason::of_end(End::Strand, blocked, q, ask.need_m))
    }

    fn taken(self, on_strand: &Posture, length_m: f64, keeps_m: f64) -> Leaving {
        let Self { direction, tilt_rad, way: outwards } = self;
        let mut way = vec![*on_strand];
        way.extend(outwards);
        Leaving { way, direction, tilt_rad, length_m, keeps_m, reason: None }
    }
}

/// The first step keeps what the print itself keeps on the strand, if that is less than asked; if
/// that is nothing, only where it ends is asked for.
fn first_step(
    ask: &mut Ask<'_>,
    on_strand: &Posture,
    to: &Posture,
    stands_m: Option<f64>,
) -> Result<(), Blocked> {
    let need_m = ask.need_m;
    ask.need_m = stands_m.map_or(need_m, |stands_m| stands_m.min(need_m));
    let answer = ask.clear(if stands_m.is_some() { on_strand } else { to }, to);
    ask.need_m = need_m;
    answer
}

/// Directions to leave by, with their angle to the nozzle's axis, by rank: away from what meets
/// there, straight up, then the fan from the axis outwards. None leads further than the fan's
/// widest angle from the axis.
fn directions(job: &Job, nozzle: Vector, away: Option<Vector>) -> Vec<(f64, Vector)> {
    let axis = -nozzle;
    let widest_rad = TILTS_DEG[TILTS_DEG.len() - 1].to_radians() + 1e-9;
    let chosen = [away, Some(between::up(job))].into_iter().flatten();
    let tilted = chosen.map(|direction| (direction.angle(&axis), direction));
    let mut directions: Vec<(f64, Vector)> =
        tilted.filter(|(tilt_rad, _)| (1e-6..=widest_rad).contains(tilt_rad)).collect();
    let across = away.map(|away| away - axis * away.dot(&axis)).and_then(|v| v.try_normalize(1e-6));
    // The fan begins on the side that leads away.
    let one = across.unwrap_or_else(|| square_to(&axis));
    let other = axis.cross(&one);
    for tilt_deg in TILTS_DEG {
        let tilt_rad = tilt_deg.to_radians();
        for k in 0..N_AROUND {
            let around = TAU * k as f64 / N_AROUND as f64;
            let side = one * around.cos() + other * around.sin();
            directions.push((tilt_rad, axis * tilt_rad.cos() + side * tilt_rad.sin()));
        }
    }
    directions
}

/// A unit vector square to a unit vector.
fn square_to(axis: &Vector) -> Vector {
    let least = if axis.x.abs() < 0.9 { Vector::x() } else { Vector::y() };
    axis.cross(&least).normalize()
}

/// Away from all strands of `order` that pass within the touch zone of a place: against the sum of
/// the directions in which they lead off it; `None` where they cancel out or there are none.
pub(crate) fn away_from(job: &Job, order: &[usize], point: Point) -> Option<Vector> {
    let zone_m = job.limits.touch_zone_m;
    let mut sum = Vector::zeros();
    for &strand in order {
        for pair in job.strands[strand].points.windows(2) {
            for (near, far) in [(pair[0], pair[1]), (pair[1], pair[0])] {
                if (near - point).norm() <= zone_m {
                    sum += (far - near).try_normalize(1e-9).unwrap_or_else(Vector::zeros);
                }
            }
        }
    }
    (-sum).try_normalize(1e-3)
}
