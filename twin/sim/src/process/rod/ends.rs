//! What the ends carry: the redundants of one step.

use super::sections::Load;
use super::{End, Hold, RodError};

/// Moment and shear at the near end, in both directions, and the pull there.
#[derive(Clone, Copy, Default, Debug)]
pub(super) struct Redundants {
    pub(super) moment: [f64; 2],
    pub(super) shear: [f64; 2],
    pub(super) pull: f64,
}

/// Place and slope of both ends, in both directions, and how much longer the strand is.
#[derive(Clone, Copy, Default, Debug)]
pub(super) struct Place {
    pub(super) far: [f64; 2],
    pub(super) far_slope: [f64; 2],
    pub(super) near: [f64; 2],
    pub(super) near_slope: [f64; 2],
    pub(super) far_along: f64,
    pub(super) near_along: f64,
}

/// A sum over sections that is linear in the redundants.
#[derive(Clone, Copy, Default, Debug)]
pub(super) struct Sum {
    pub(super) constant: [f64; 2],
    pub(super) by_moment: f64,
    pub(super) by_shear: f64,
}

/// `∫ κ`, `∫ κ (X − s)` and `∫ ε`, at the end of a step.
#[derive(Clone, Copy, Default, Debug)]
pub(super) struct Sums {
    pub(super) turn: Sum,
    pub(super) drop: Sum,
    pub(super) stretch: f64,
    pub(super) stretch_by_pull: f64,
}

/// Whether the redundants follow from equilibrium alone.
pub(super) fn determinate(hold: Hold) -> bool {
    hold.far == End::Free
        || hold.near == End::Free
        || hold.far == hold.near && hold.near == End::Hinged
}

/// Whether both ends are held along the strand.
pub(super) fn both_held(hold: Hold) -> bool {
    hold.far != End::Free && hold.near != End::Free
}

/// Whether what holds it holds it.
pub(super) fn stands(hold: Hold) -> Result<(), RodError> {
    use End::{Clamped, Free, Hinged};
    match (hold.far, hold.near) {
        (Clamped, _) | (_, Clamped) | (Hinged, Hinged) => Ok(()),
        (Free | Hinged, Free) | (Free, Hinged) => Err(RodError::Falls),
    }
}

/// Redundants by equilibrium; `load` is that on the far end. Zero where they do not follow from it.
pub(super) fn by_equilibrium(hold: Hold, load: &Load, length_m: f64) -> Redundants {
    let mut out = Redundants::default();
    if hold.far == End::Free {
        out.shear = load.shear.map(|q| -q);
        out.moment = std::array::from_fn(|i| load.shear[i] * length_m - load.moment[i]);
        out.pull = -load.pull;
    } else if determinate(hold) && hold.near == End::Hinged && length_m > 0.0 {
        out.shear = load.moment.map(|m| -m / length_m);
    }
    out
}

/// Redundants by which the ends are at the end of the step where they are held.
pub(super) fn by_place(
    hold: Hold,
    sums: &Sums,
    place: &Place,
    load: &Load,
    mid_m: f64,
    length_m: f64,
) -> Redundants {
    let mut out = by_equilibrium(hold, load, mid_m);
    if both_held(hold) {
        let wanted = place.near_along - place.far_along - sums.stretch;
        out.pull = divide(wanted, sums.stretch_by_pull);
    }
    if determinate(hold) {
        return out;
    }
    let (turn, drop) = (&sums.turn, &sums.drop);
    for i in 0..2 {
        let turn_wanted = place.near_slope[i] - place.far_slope[i] - turn.constant[i];
        let drop_wanted =
            place.near[i] - place.far[i] - place.far_slope[i] * length_m - drop.constant[i];
        let (moment, shear) = if hold.near == End::Hinged {
            (0.0, divide(drop_wanted, drop.by_shear))
        } else if hold.far == End::Clamped {
            solve(
                [[turn.by_moment, turn.by_shear], [drop.by_moment, drop.by_shear]],
                [turn_wanted, drop_wanted],
            )
        } else {
            // far end hinged: no moment there, and ∫ κ s from the place of the near end
            let back = |turn: f64, drop: f64| length_m * turn - drop;
            solve(
                [
                    [1.0, mid_m],
                    [back(turn.by_moment, drop.by_moment), back(turn.by_shear, drop.by_shear)],
                ],
                [
                    -load.moment[i],
                    place.far[i] + place.near_slope[i] * length_m
                        - place.near[i]
                        - back(turn.constant[i], drop.constant[i]),
                ],
            )
        };
        out.moment[i] = moment;
        out.shear[i] = shear;
    }
    out
}

/// Place of the ends that are not held, from the sums over the sections as they now are.
pub(super) fn settle(hold: Hold, turn: [f64; 2], drop: [f64; 2], length_m: f64, place: &mut Place) {
    for i in 0..2 {
        match (hold.far, hold.near) {
            (End::Free, _) => {
                place.far_slope[i] = place.near_slope[i] - turn[i];
                place.far[i] = place.near[i] - place.far_slope[i] * length_m - drop[i];
            }
            (End::Hinged, End::Clamped) => place.far_slope[i] = place.near_slope[i] - turn[i],
            (End::Hinged, _) => {
                place.far_slope[i] = divide(place.near[i] - place.far[i] - drop[i], length_m);
            }
            (End::Clamped, _) => {}
        }
        if hold.far != End::Free && hold.near == End::Free {
            place.near[i] = place.far[i] + place.far_slope[i] * length_m + drop[i];
        }
        if hold.near != End::Clamped {
            place.near_slope[i] = place.far_slope[i] + turn[i];
        }
    }
}

/// Two equations; where they are one (a single section flows), the second alone by its shear.
fn solve(a: [[f64; 2]; 2], b: [f64; 2]) -> (f64, f64) {
    let (down, up) = (a[0][0] * a[1][1], a[0][1] * a[1][0]);
    let determinant = down - up;
    if determinant.abs() <= 1e-13 * (down.abs() + up.abs()) {
        return (0.0, divide(b[1], a[1][1]));
    }
    (
        (b[0] * a[1][1] - b[1] * a[0][1]) / determinant,
        (a[0][0] * b[1] - a[1][0] * b[0]) / determinant,
    )
}

/// Zero where there is nothing to divide by: all is rigid.
fn divide(by: f64, what: f64) -> f64 {
    if what.abs() < f64::MIN_POSITIVE { 0.0 } else { by / what }
}
