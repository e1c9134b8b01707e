//! What a segment receives depends on where it lies as the lamps see it: where the strand has the same shape
//! behind the nozzle as a moment ago, it need not be summed again.

use std::collections::HashMap;

use crate::pose::Vector;

use super::dose::Segment;
use super::irradiance::Irradiance;
use super::lights::{Carrier, Lights, Scene};

/// How alike two places must be, m and in directions: a thousandth of a per cent of what light there is.
const ALIKE: f64 = 1e-9;
/// Most places kept.
const MOST: usize = 20_000;

/// Irradiances by how many stations a segment is behind the nozzle and which instant of the step it is.
pub(super) struct Memo {
    /// What carries all lamps and shades; none where it is not one thing.
    carrier: Option<Carrier>,
    kept: HashMap<(usize, usize), Kept>,
}

struct Kept {
    place: [Vector; 3],
    lit: u64,
    irradiance: Irradiance,
}

impl Memo {
    pub(super) fn new(lights: &Lights) -> Self {
        let mut carriers =
            lights.sets.iter().map(|s| s.carrier).chain(lights.shades.iter().map(|s| s.0));
        let first = carriers.next();
        let carrier = first.filter(|first| carriers.all(|other| other == *first));
        // More sets than marks: no memory rather than a wrong one.
        let carrier = carrier.filter(|_| lights.sets.len() <= 64);
        Self { carrier, kept: HashMap::new() }
    }

    /// Fills `now` from memory, or by `fill`, and remembers it.
    pub(super) fn look(
        &mut self,
        key: (usize, usize),
        scene: &Scene,
        segment: &Segment,
        now: &mut Irradiance,
        fill: impl FnOnce(&mut Irradiance),
    ) {
        let Some(carrier) = self.carrier else { return fill(now) };
        let part_from = &scene.part_from[carrier as usize];
        let place = [
            part_from.inverse_transform_point(&segment.middle).coords,
            part_from.inverse_transform_vector(&segment.tangent),
            part_from.inverse_transform_vector(&segment.across),
        ];
        let alike = |kept: &&Kept| {
            let near = |(a, b): (&Vector, &Vector)| (a - b).amax() < ALIKE;
            kept.lit == scene.lit && kept.place.iter().zip(&place).all(near)
        };
        if let Some(kept) = self.kept.get(&key).filter(alike) {
            now.copy(&kept.irradiance);
            return;
        }
        fill(now);
        if self.kept.len() >= MOST {
            self.kept.clear();
        }
        self.kept.insert(key, Kept { place, lit: scene.lit, irradiance: now.clone() });
    }
}
