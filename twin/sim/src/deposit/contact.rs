//! Where as-printed beads touch.

use std::collections::BTreeMap;

use super::{Deposit, Segment};
use crate::pose::{Point, Vector};

/// A place where two strands touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The two strands by printing order, the later one first.
    pub orders: [usize; 2],
    /// Arc length on each, m.
    pub at_m: [f64; 2],
    /// Nearest points of the two axes, part axes.
    pub points: [Point; 2],
}

impl Contact {
    /// Distance of the two axes, m.
    pub fn axes_m(&self) -> f64 {
        (self.points[1] - self.points[0]).norm()
    }

    /// Middle of the contact.
    pub fn middle(&self) -> Point {
        nalgebra::center(&self.points[0], &self.points[1])
    }
}

/// Beads whose axes are nearer than this share of the sum of their radii touch. The tenth above
/// one covers the flattening of a bead that is laid on another.
const TOUCH_SHARE: f64 = 1.1;

/// Contacts of two strands that lie alongside each other are this many diameters apart.
pub const ALONGSIDE_DIAMETERS: f64 = 2.0;

/// All contacts between different strands, by later strand, then earlier, then place.
///
/// Of the places where two strands come near enough, the nearest is taken first, and others only
/// if they are [`ALONGSIDE_DIAMETERS`] away along the later strand: a crossing gives one contact,
/// two strands side by side a row of them. O(n · k), k: segments near a segment. A strand's
/// contact with itself is not looked for.
pub fn contacts(deposit: &Deposit) -> Vec<Contact> {
    let mut all = Vec::new();
    let mut near = Vec::new();
    let mut by_pair: BTreeMap<usize, Vec<Contact>> = BTreeMap::new();
    for segments in deposit.segments.chunk_by(|a, b| a.order == b.order) {
        by_pair.clear();
        for segment in segments {
            touching(deposit, segment, &mut near, &mut by_pair);
        }
        for candidates in by_pair.values_mut() {
            candidates.sort_by(|a, b| {
                a.axes_m().total_cmp(&b.axes_m()).then(a.at_m[0].total_cmp(&b.at_m[0]))
            });
            let spacing_m = ALONGSIDE_DIAMETERS * 2.0 * segments[0].radius_m;
            let mut kept: Vec<Contact> = Vec::new();
            for contact in candidates.iter() {
                let apart_m = |other: &Contact| (other.at_m[0] - contact.at_m[0]).abs();
                if kept.iter().all(|other| apart_m(other) >= spacing_m * (1.0 - 1e-9)) {
                    kept.push(*contact);
                }
            }
            kept.sort_by(|a, b| a.at_m[0].total_cmp(&b.at_m[0]));
            all.append(&mut kept);
        }
    }
    all
}

fn touching(
    deposit: &Deposit,
    segment: &Segment,
    near: &mut Vec<u32>,
    by_pair: &mut BTreeMap<usize, Vec<Contact>>,
) {
    let (low, high) = segment.bounds();
    let reach = Vector::repeat(segment.radius_m);
    deposit.near(low - reach, high + reach, near);
    for &index in near.iter() {
        let other = &deposit.segments[index as usize];
        if other.order >= segment.order {
            continue;
        }
        let [nearest, _] = closest(&segment.ends, &other.ends);
        for share in stations(segment, other, nearest) {
            if let Some(contact) = at(segment, other, share) {
                by_pair.entry(other.order).or_default().push(contact);
            }
        }
    }
}

/// Shares along a piece at which it is looked at: where it is nearest; and if the two lie alongside, from there on both ways as
/// far apart as contacts are. They lie alongside where the gap opens by less from one contact to the next than
/// flattening takes up; at a larger angle they part.
fn stations(segment: &Segment, other: &Segment, nearest: f64) -> impl Iterator<Item = f64> {
    let [own, along] = [segment, other].map(|piece| piece.ends[1] - piece.ends[0]);
    let spacing_m = ALONGSIDE_DIAMETERS * 2.0 * segment.radius_m;
    let opens_m = own.cross(&along).norm() / (own.norm() * along.norm()) * spacing_m;
    let is_alongside = opens_m <= (TOUCH_SHARE - 1.0) * (segment.radius_m + other.radius_m);
    let step = if is_alongside { spacing_m / own.norm() } else { f64::INFINITY };
    // what rounding leaves short of a whole step is one
    let steps = move |room: f64| (room / step + 1e-9).floor().clamp(0.0, 1e6) as usize;
    let back = (1..=steps(nearest)).map(move |k| (nearest - step * k as f64).max(0.0));
    let forth = (1..=steps(1.0 - nearest)).map(move |k| (nearest + step * k as f64).min(1.0));
    std::iter::once(nearest).chain(back).chain(forth)
}

/// The contact at a share along a piece, if the other is near enough there.
fn at(segment: &Segment, other: &Segment, share: f64) -> Option<Contact> {
    let point = |segment: &Segment, share: f64| {
        segment.ends[0] + (segment.ends[1] - segment.ends[0]) * share
    };
    let own = point(segment, share);
    let along = other.ends[1] - other.ends[0];
    let square = along.norm_squared();
    let foot = if square > 0.0 {
        ((own - other.ends[0]).dot(&along) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let points = [own, point(other, foot)];
    if (points[1] - points[0]).norm() > TOUCH_SHARE * (segment.radius_m + other.radius_m) {
        return None;
    }
    let at_m = |segment: &Segment, share: f64| {
        segment.at_m[0] + (segment.at_m[1] - segment.at_m[0]) * share
    };
    Some(Contact {
        orders: [segment.order, other.order],
        at_m: [at_m(segment, share), at_m(other, foot)],
        points,
    })
}

/// Shares along two straight pieces at their nearest points.
///
/// # Source
/// Ericson, Real-Time Collision Detection, 5.1.9, with both pieces clamped.
pub fn closest(first: &[Point; 2], second: &[Point; 2]) -> [f64; 2] {
    let (d1, d2, r) = (first[1] - first[0], second[1] - second[0], first[0] - second[0]);
    let (a, e, f) = (d1.norm_squared(), d2.norm_squared(), d2.dot(&r));
    let c = d1.dot(&r);
    if a <= f64::MIN_POSITIVE || e <= f64::MIN_POSITIVE {
        let s = if a > 0.0 { (-c / a).clamp(0.0, 1.0) } else { 0.0 };
        let t = if e > 0.0 { (f / e).clamp(0.0, 1.0) } else { 0.0 };
        return [s, t];
    }
    let b = d1.dot(&d2);
    let denominator = a * e - b * b;
    let s = if denominator > 1e-12 * a * e {
        ((b * f - c * e) / denominator).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let t = (b * s + f) / e;
    if t < 0.0 {
        [(-c / a).clamp(0.0, 1.0), 0.0]
    } else if t > 1.0 {
        [((b - c) / a).clamp(0.0, 1.0), 1.0]
    } else {
        [s, t]
    }
}
