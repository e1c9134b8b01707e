//! What the frame does to each place of a strand: how far its weight moves it, and how much of its strength it used.

use crate::growth::Growth;
use crate::preflight::Preflight;
use crate::structure::displacement_along;

/// The frame's members by strand.
pub(super) struct Borne<'a> {
    growth: &'a Growth,
    /// By printing order: members with a bead, as they follow each other along the strand.
    members: Vec<Vec<usize>>,
}

impl<'a> Borne<'a> {
    pub(super) fn new(preflight: &'a Preflight) -> Self {
        let growth = &preflight.growth;
        let mut members = vec![Vec::new(); preflight.deposit.strands.len()];
        let both = growth.built.member_order.iter().zip(&growth.built.is_link).enumerate();
        for (member, (&order, _)) in both.filter(|(_, (_, is_link))| !**is_link) {
            members[order].push(member);
        }
        Self { growth, members }
    }

    /// Displacement by weight, m, and largest share of strength used, in the middle of each piece between arc lengths;
    /// NaN where nothing was solved.
    pub(super) fn along(&self, order: usize, at_m: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let middles = at_m.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        middles.map(|middle_m| self.at(order, middle_m)).unzip()
    }

    fn at(&self, order: usize, at_m: f64) -> (f64, f64) {
        let Growth { built, shown, .. } = self.growth;
        let members = &self.members[order];
        let after = members.partition_point(|&member| built.member_at_m[member][1] < at_m);
        let Some(&member) = members.get(after).or(members.last()) else {
            return (f64::NAN, f64::NAN);
        };
        let moved = || {
            let stage = shown.stages.last().filter(|stage| member < stage.born)?;
            let ends = built.frame.members()[member].ends;
            let [first, last] = ends.map(|node| stage.staged.get(node).copied());
            let [from_m, to_m] = built.member_at_m[member];
            let share = ((at_m - from_m) / (to_m - from_m)).clamp(0.0, 1.0);
            let places = ends.map(|node| built.frame.nodes()[node]);
            Some(displacement_along(places, [first?, last?], share).norm())
        };
        let used = shown.used.get(member).copied();
        (moved().unwrap_or(f64::NAN), used.unwrap_or(f64::NAN))
    }
}
