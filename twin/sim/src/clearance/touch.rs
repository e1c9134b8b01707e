//! What may touch what, and when. All of it is stated in the cell file (`touch_zone_mm`) and the job
//! (`on`, `join`), and nothing else may.
//!
//! | pair | may touch |
//! |---|---|
//! | nozzle – earlier strand | the strand within the touch zone of a place where the strand being printed touches it; on retract also of the place where the nozzle leaves it |
//! | any tool part – strand in progress | the strand within the touch zone of the orifice |
//! | nozzle – what stands at the ends of a move that the job gives | as on the retract from the strand it leaves and the approach to the one it leads to |
//! | nozzle – bed, form | a strand that lies on it: everywhere; one joined to it: the orifice within the touch zone of that end |
//!
//! Nozzle and bed or form that may touch may press into each other by half a bead. In transit
//! nothing may touch.

use std::collections::BTreeMap;

use crate::cell::{Job, Join, On};
use crate::deposit::{Contact, Deposit};
use crate::pose::Point;

/// Where the nozzle may touch bed or form.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) enum Ground {
    /// Nowhere.
    #[default]
    No,
    /// While the orifice is within the touch zone of one of these places, part axes.
    Near(Vec<Point>),
    /// Everywhere.
    All,
}

impl Ground {
    fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::No, ground) | (ground, Self::No) => ground,
            (Self::All, _) | (_, Self::All) => Self::All,
            (Self::Near(mut places), Self::Near(more)) => {
                places.extend(more);
                Self::Near(places)
            }
        }
    }
}

/// What may touch during one move.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Touch {
    /// Places, part axes, about which the nozzle may touch strands, by their printing order.
    pub(crate) strands: BTreeMap<usize, Vec<Point>>,
    /// The strand of order `printed` is being extruded: as much of it is there as the path says.
    pub(crate) extrudes: bool,
    /// Nozzle on bed.
    pub(crate) bed: Ground,
    /// Nozzle on forms.
    pub(crate) form: Ground,
    /// How deep the nozzle may press into bed or form where it may touch them, m.
    pub(crate) press_m: f64,
    /// Forms that are no longer there.
    pub(crate) gone: Vec<usize>,
}

impl Touch {
    /// Transit: nothing may touch.
    pub(crate) fn nothing() -> Self {
        Self::default()
    }

    /// Approach, print (`extrudes`) or retract of the strand of this printing order. `contacts`
    /// are those of this strand, or of all.
    pub(crate) fn strand<'c>(
        job: &Job,
        deposit: &Deposit,
        order: usize,
        contacts: impl IntoIterator<Item = &'c Contact>,
        extrudes: bool,
    ) -> Self {
        let mut strands: BTreeMap<usize, Vec<Point>> = BTreeMap::new();
        for contact in contacts {
            let [a, b] = contact.orders;
            if a == order || b == order {
                for each in [a, b] {
                    strands.entry(each).or_default().push(contact.middle());
                }
            }
        }
        let printed = &deposit.strands[order];
        let strand = &job.strands[printed.strand];
        let press_m = printed.radius_m;
        let ends =
            [(strand.start.join, strand.points.first()), (strand.end.join, strand.points.last())];
        let on_bed = |join: Option<Join>, point: &Point| match join {
            Some(join) => join == Join::Bed,
            None => (job.bed_from_part * point).z <= 2.0 * press_m,
        };
        let on_form = |join: Option<Join>, _: &Point| matches!(join, Some(Join::Form(_)));
        let near = |holds: &dyn Fn(Option<Join>, &Point) -> bool| {
            let places = ends.iter().filter_map(|(join, point)| point.map(|point| (*join, point)));
            Ground::Near(places.filter(|(j, p)| holds(*j, p)).map(|(_, p)| *p).collect())
        };
        let bed = if strand.on == On::Bed { Ground::All } else { near(&on_bed) };
        let form = if matches!(strand.on, On::Form(_)) { Ground::All } else { near(&on_form) };
        Self { strands, extrudes, bed, form, press_m, gone: Vec::new() }
    }

    /// The same, on retract from `left`, where the nozzle leaves the strand of this order.
    #[must_use]
    pub(crate) fn leaving(mut self, order: usize, left: Point) -> Self {
        self.strands.entry(order).or_default().push(left);
        self
    }

    /// The same where bed and form may only be touched near these places.
    #[must_use]
    pub(crate) fn only_near(mut self, places: &[Point]) -> Self {
        for ground in [&mut self.bed, &mut self.form] {
            if *ground == Ground::All {
                *ground = Ground::Near(places.to_vec());
            }
        }
        self
    }

    /// What may touch by either.
    #[must_use]
    pub(crate) fn and(mut self, other: Self) -> Self {
        for (order, places) in other.strands {
            self.strands.entry(order).or_default().extend(places);
        }
        self.bed = self.bed.and(other.bed);
        self.form = self.form.and(other.form);
        self.press_m = self.press_m.max(other.press_m);
        self.gone.extend(other.gone);
        self
    }

    /// The same without these forms.
    #[must_use]
    pub(crate) fn without(mut self, gone: Vec<usize>) -> Self {
        self.gone = gone;
        self
    }
}
