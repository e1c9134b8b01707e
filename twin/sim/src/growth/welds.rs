//! Contacts between strands as welds of the frame.

use super::Printed;
use crate::interval::Interval;
use crate::pose::{Point, Vector};
use crate::structure::{At, Frame, Weld};

/// What holds two strands together where they touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bond {
    /// Area of the patch of contact, m².
    pub area_m2: f64,
    /// Strength in tension across it, Pa.
    pub tension_pa: Interval,
}

/// A contact as it stands in the frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Joined {
    /// Node of the younger strand.
    pub(super) node: usize,
    pub(super) contact: usize,
    /// Members of the younger side.
    pub(super) through: Vec<(usize, At)>,
}

/// Axes nearer than this share of a radius give no direction from one to the other.
const MEET_SHARE: f64 = 0.2;

/// A patch is given at least this share of the strand's section, or a link without area would leave the frame a
/// mechanism. What so small a patch bears is next to nothing: P310 and S405 tell.
const LEAST_SHARE: f64 = 1e-3;

/// Area of the patch of a contact in the frame, m².
pub(super) fn patch_m2(bond: &Bond, diameter_m: f64) -> f64 {
    bond.area_m2.max(LEAST_SHARE * std::f64::consts::PI * diameter_m * diameter_m / 4.0)
}

/// Shear strength of a patch as part of its tensile strength: `1/√3`, as von Mises has it for a ductile solid; no measured
/// one is known for welds between strands. Ours.
const SHEAR_SHARE: f64 = 0.577_350_269_189_625_8;

/// The welds of a frame and the contact of each.
pub(super) fn welds(
    frame: &Frame,
    printed: &Printed<'_>,
    joined: &[Joined],
) -> (Vec<Weld>, Vec<usize>) {
    let of = |joined: &Joined| {
        let bond = printed.bonds[joined.contact];
        let order = printed.contacts[joined.contact].orders[0];
        Weld {
            node: joined.node,
            through: joined.through.clone(),
            area_m2: patch_m2(&bond, printed.laws[order].diameter_m),
            normal: normal(frame, printed, joined),
            tension_pa: bond.tension_pa.nominal,
            shear_pa: bond.tension_pa.nominal * SHEAR_SHARE,
        }
    };
    (joined.iter().map(of).collect(), joined.iter().map(|joined| joined.contact).collect())
}

/// Across the patch, from the older to the younger strand: along a link; from one axis to the other; where a strand ends
/// on an axis, along the strand; where it runs through one, across both.
fn normal(frame: &Frame, printed: &Printed<'_>, joined: &Joined) -> Vector {
    let along = |member: usize| {
        let [a, b]: [Point; 2] = frame.members()[member].ends.map(|node| frame.nodes()[node]);
        (b - a).normalize()
    };
    let contact = &printed.contacts[joined.contact];
    let apart = contact.points[0] - contact.points[1];
    let radius_m = printed.deposit.strands[contact.orders[0]].radius_m;
    match joined.through[..] {
        [(link, At::Middle)] => -along(link),
        [(member, At::First)] => along(member),
        [(member, At::Last)] => -along(member),
        _ if apart.norm() > MEET_SHARE * radius_m => apart.normalize(),
        _ => {
            let [younger, older] = [0, 1].map(|side| {
                printed.deposit.strands[contact.orders[side]].direction_at(contact.at_m[side])
            });
            let across = younger.cross(&older);
            if across.norm() > 1e-6 { across.normalize() } else { younger }
        }
    }
}
