//! Principal stress lines through a field of tensors.

use super::field::Tensor;

/// Steps one way from a seed, over the region's half way round in steps; enough for any line that
/// does not turn in circles.
const TURNS: f64 = 4.0;
/// Halvings that put the end of a line on the edge.
const HALVINGS: usize = 50;
/// Two principal stresses this near each other, over the larger, have no directions.
const DEGENERATE: f64 = 1e-9;

/// Which of the two principal directions a line follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Family {
    /// The larger principal stress: mostly tension.
    Larger,
    /// The smaller: mostly compression.
    Smaller,
}

/// A rectangle lines stay in: low and high corner, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Region {
    pub(super) low_m: [f64; 2],
    pub(super) high_m: [f64; 2],
}

impl Region {
    pub(super) fn holds(&self, at: [f64; 2]) -> bool {
        (0..2).all(|axis| (self.low_m[axis]..=self.high_m[axis]).contains(&at[axis]))
    }
}

/// Unit vector along a family at a tensor, in no particular sense: `tan 2θ = 2τ/(σx - σy)` for the
/// larger stress, across it for the smaller. `None` where the two are equal.
pub(super) fn direction([sx, sy, shear]: Tensor, family: Family) -> Option<[f64; 2]> {
    let (half, size) = (0.5 * (sx - sy), sx.abs().max(sy.abs()).max(shear.abs()));
    // also false for what is not a number
    if !(half.hypot(shear) > DEGENERATE * size) {
        return None;
    }
    let (sin, cos) = (0.5 * shear.atan2(half)).sin_cos();
    Some(match family {
        Family::Larger => [cos, sin],
        Family::Smaller => [-sin, cos],
    })
}

/// The line of a family through a seed, from edge to edge: RK4 of the interpolated tensor's own
/// direction, its sense kept from step to step. Ends on the region's edge, where the two stresses are
/// equal, or where it comes back to its seed. Fourth order in the step for a smooth field.
pub(super) fn trace(
    stress: &dyn Fn([f64; 2]) -> Tensor,
    region: &Region,
    seed: [f64; 2],
    family: Family,
    step_m: f64,
) -> Vec<[f64; 2]> {
    let Some(first) = direction(stress(seed), family).filter(|_| region.holds(seed)) else {
        return Vec::new();
    };
    let along = |at: [f64; 2], near: [f64; 2]| {
        let [x, y] = direction(stress(at), family)?;
        let sense = if x * near[0] + y * near[1] < 0.0 { -1.0 } else { 1.0 };
        Some([sense * x, sense * y])
    };
    let ahead = walk(&along, region, seed, first, step_m);
    if ahead.closed {
        return ahead.points;
    }
    let mut line = walk(&along, region, seed, [-first[0], -first[1]], step_m).points;
    line.reverse();
    line.extend(ahead.points.into_iter().skip(1));
    line
}

struct Walk {
    points: Vec<[f64; 2]>,
    closed: bool,
}

/// Direction at a place, in the sense nearest to another.
type Along<'a> = dyn Fn([f64; 2], [f64; 2]) -> Option<[f64; 2]> + 'a;

fn walk(along: &Along, region: &Region, seed: [f64; 2], first: [f64; 2], step_m: f64) -> Walk {
    let mut walk = Walk { points: vec![seed], closed: false };
    let half_way_m: f64 = (0..2).map(|axis| region.high_m[axis] - region.low_m[axis]).sum();
    let steps = TURNS * half_way_m / step_m;
    if !(steps.is_finite() && steps >= 1.0) {
        return walk;
    }
    let (mut at, mut sense) = (seed, first);
    for count in 0..steps as usize {
        let Some(next) = rk4(along, at, sense, step_m) else { break };
        if !region.holds(next) {
            walk.points.push(on_the_edge(along, region, at, sense, step_m));
            break;
        }
        walk.points.push(next);
        if count > 4 && distance(next, seed) < 0.5 * step_m {
            walk.closed = true;
            break;
        }
        let Some(turned) = along(next, sense) else { break };
        (at, sense) = (next, turned);
    }
    walk
}

/// The last point inside of the step that leaves.
fn on_the_edge(
    along: &Along,
    region: &Region,
    at: [f64; 2],
    sense: [f64; 2],
    step_m: f64,
) -> [f64; 2] {
    let (mut inside, mut low, mut high) = (at, 0.0, step_m);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        match rk4(along, at, sense, middle) {
            Some(there) if region.holds(there) => (inside, low) = (there, middle),
            _ => high = middle,
        }
    }
    inside
}

fn rk4(along: &Along, at: [f64; 2], sense: [f64; 2], step_m: f64) -> Option<[f64; 2]> {
    let moved =
        |by: [f64; 2], part: f64| [at[0] + part * step_m * by[0], at[1] + part * step_m * by[1]];
    let one = along(at, sense)?;
    let two = along(moved(one, 0.5), one)?;
    let three = along(moved(two, 0.5), two)?;
    let four = along(moved(three, 1.0), three)?;
    let mean = [0, 1].map(|k| (one[k] + 2.0 * two[k] + 2.0 * three[k] + four[k]) / 6.0);
    Some(moved(mean, 1.0))
}

pub(super) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
