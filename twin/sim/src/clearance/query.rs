//! What planners ask of a space: is this posture clear, is this move.

use super::measure::Measure;
use super::space::{Named, Space};
use super::sweep::{Asked, Covered};
use super::touch::Touch;
use crate::kinematics::Posture;

/// The nearest pair at one posture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Closest {
    /// Clearance, m; negative: overlap. Where nozzle and ground may touch, the depth they may
    /// press and the full clearance are added.
    pub(crate) clearance_m: f64,
    /// The two, the first by its index in [`Space::things`]; `None` where nothing is within reach.
    pub(crate) pair: Option<(usize, Named)>,
}

/// Why a move is not clear.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Blocked {
    /// Share of the move at which the clearance was found.
    pub(crate) share: f64,
    /// Clearance there, m.
    pub(crate) clearance_m: f64,
    /// The two bodies by name.
    pub(crate) pair: [String; 2],
}

impl Space<'_> {
    /// Least clearance of all pairs that may not touch, at one posture; nothing beyond `beyond_m`
    /// is told. `printed` strands are there; one that is being extruded is not.
    pub(crate) fn posture(
        &self,
        q: &Posture,
        printed: usize,
        touch: &Touch,
        beyond_m: f64,
    ) -> Closest {
        let track = self.track(vec![*q], Vec::new());
        let measure = Measure::new(self, &track, touch, printed);
        let mut closest = Closest { clearance_m: beyond_m, pair: None };
        let tell = |closest: &mut Closest, pair: (usize, Named), covered: Option<Covered>| {
            if let Some(covered) = covered.filter(|it| it.found_m < closest.clearance_m) {
                *closest = Closest { clearance_m: covered.found_m, pair: Some(pair) };
            }
        };
        for &thing in &self.against_deposit {
            let asked = ask(closest.clearance_m, f64::NEG_INFINITY);
            if let Some((strand, covered)) = measure.deposit(thing, &asked) {
                tell(&mut closest, (thing, Named::Strand(strand)), Some(covered));
            }
        }
        for &pair in &self.pairs {
            let asked = ask(closest.clearance_m, f64::NEG_INFINITY);
            tell(&mut closest, (pair[0], Named::Thing(pair[1])), measure.pair(pair, &asked));
        }
        closest
    }

    /// Whether all pairs that may not touch keep `need_m` over a whole straight move in joint space.
    ///
    /// # Errors
    /// The first place found where some pair does not.
    pub(crate) fn move_is_clear(
        &self,
        a: &Posture,
        b: &Posture,
        printed: usize,
        touch: &Touch,
        need_m: f64,
    ) -> Result<(), Blocked> {
        let track = self.track(vec![*a, *b], Vec::new());
        let measure = Measure::new(self, &track, touch, printed);
        let asked = ask(need_m, need_m);
        let too_near = |covered: &Covered| covered.found_m < need_m;
        let strand = |&thing: &usize| {
            let (order, covered) = measure.deposit(thing, &asked)?;
            too_near(&covered).then_some((thing, Named::Strand(order), covered))
        };
        let thing = |&pair: &[usize; 2]| {
            let covered = measure.pair(pair, &asked).filter(too_near)?;
            Some((pair[0], Named::Thing(pair[1]), covered))
        };
        let strands = self.against_deposit.iter().filter_map(strand);
        match strands.chain(self.pairs.iter().filter_map(thing)).next() {
            None => Ok(()),
            Some((thing, other, covered)) => Err(Blocked {
                share: covered.u,
                clearance_m: covered.found_m,
                pair: [self.things[thing].body.name.clone(), self.name(other).to_owned()],
            }),
        }
    }
}

fn ask(horizon_m: f64, enough_m: f64) -> Asked {
    Asked { horizon_m, judged_at_m: [f64::INFINITY; 2], enough_m }
}
