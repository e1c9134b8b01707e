//! A strand through printing and what comes after.

use super::ends::{Place, Redundants, stands};
use super::sections::{Piece, Section, cut};
use super::step::{Interval, Room, step};
use super::{Hold, RodError, RodOutcome, Strand};

/// Prints a strand and lets it sag until its phases are over.
///
/// Two Gauss sections to a piece, one step to a piece while printing, then steps that lengthen evenly with time
/// (`t = T (k/K)²`) in each phase. Second order in pieces and steps. Cost: every step goes once over the
/// sections born, so `n` pieces and `K` steps to a phase cost `n (n + 1) + 2 n K` updates
/// ([`RodOutcome::updates`]). Range: slopes small, soft zone of three diameters or more and of four sections or
/// more, sag below 1.3 diameters where both ends are held (`super::stretch`), below 0.3 of the span elsewhere
/// (`super::corotational`). Cases VISC-*, EEFF-FROZEN.
///
/// # Errors
/// [`RodError::Input`] for numbers that mean nothing, [`RodError::Falls`] where nothing holds it.
pub fn print_strand(strand: &Strand) -> Result<RodOutcome, RodError> {
    check(strand)?;
    let (pieces, mut sections) = cut(strand);
    let mut run = Run {
        strand,
        pieces: &pieces,
        sections: &mut sections,
        place: Place::default(),
        room: Room::default(),
        shape: vec![([0.0; 2], [0.0; 2]); pieces.len() + 1],
        greatest_m: vec![0.0; pieces.len() + 1],
        steps: 0,
        updates: 0,
        last: Redundants::default(),
    };
    for (i, piece) in pieces.iter().enumerate() {
        let time = Interval {
            from_s: piece.from_s,
            to_s: piece.to_s,
            from_m: piece.from_m,
            to_m: piece.to_m,
        };
        run.step(i + 1, &time, strand.printing);
    }
    let sag_printing_m = run.sag_m();
    let mut begin_s = pieces.last().map_or(0.0, |p| p.to_s);
    let rigid_s = begin_s + strand.ageing.rigid_s;
    for phase in strand.after {
        let end_s = (begin_s + phase.duration_s).min(rigid_s.max(begin_s));
        run.wait(phase.hold, begin_s, end_s);
        begin_s = end_s;
    }
    Ok(run.outcome(sag_printing_m))
}

fn check(strand: &Strand) -> Result<(), RodError> {
    let finite = |x: f64| x.is_finite();
    for e in strand.elements {
        let sound = e.length_m >= 0.0
            && e.printing_s > 0.0
            && e.area_m2 > 0.0
            && e.inertia_m4 > 0.0
            && [e.length_m, e.printing_s, e.area_m2, e.inertia_m4, e.line_mass_kg_m].map(finite)
                == [true; 5]
            && e.axes.across.iter().flatten().chain(&e.axes.along).all(|x| x.is_finite());
        if !sound {
            return Err(RodError::Input);
        }
    }
    let waits = strand.after.iter().all(|p| p.duration_s >= 0.0);
    let first = strand.elements.first().is_some_and(|e| e.length_m > 0.0);
    if !waits || !first || !(strand.ageing.rigid_s >= 0.0) || !strand.ageing.rigid_s.is_finite() {
        return Err(RodError::Input);
    }
    stands(strand.printing)?;
    strand.after.iter().try_for_each(|phase| stands(phase.hold))
}

struct Run<'a> {
    strand: &'a Strand<'a>,
    pieces: &'a [Piece],
    sections: &'a mut [Section],
    place: Place,
    room: Room,
    /// Offset and slope at the boundaries of pieces.
    shape: Vec<([f64; 2], [f64; 2])>,
    greatest_m: Vec<f64>,
    steps: usize,
    updates: usize,
    last: Redundants,
}

impl Run<'_> {
    fn step(&mut self, count: usize, time: &Interval, hold: Hold) {
        let (pieces, born) = (&self.pieces[..count], &mut self.sections[..2 * count]);
        self.last = step(self.strand, pieces, born, time, hold, &mut self.place, &mut self.room);
        self.steps += 1;
        self.updates += born.len();
        let (mut offset, mut slope) = (self.place.far, self.place.far_slope);
        self.shape[0] = (offset, slope);
        self.greatest_m[0] = self.greatest_m[0].max(offset[0].hypot(offset[1]));
        for (i, piece) in pieces.iter().enumerate() {
            for k in 0..2 {
                offset[k] += slope[k] * (piece.to_m - piece.from_m);
                for section in &born[2 * i..2 * i + 2] {
                    let turn = section.weight_m * section.curvature[k];
                    offset[k] += turn * (piece.to_m - section.at_m);
                    slope[k] += turn;
                }
            }
            self.shape[i + 1] = (offset, slope);
            let offset_m = (offset[0] * offset[0] + offset[1] * offset[1]).sqrt();
            // a maximum that keeps what is not a number
            if !(offset_m <= self.greatest_m[i + 1]) {
                self.greatest_m[i + 1] = offset_m;
            }
        }
    }

    /// A phase after printing: held where it is.
    fn wait(&mut self, hold: Hold, begin_s: f64, end_s: f64) {
        self.room.before = None;
        let count = self.strand.fineness.steps.clamp(1, 4096);
        let length_m = self.pieces.last().map_or(0.0, |p| p.to_m);
        let at = |k: u32| begin_s + (end_s - begin_s) * (f64::from(k) / f64::from(count)).powi(2);
        if !(end_s > begin_s) && self.strand.ageing.modulus_pa.is_none() {
            return;
        }
        for k in 0..count {
            let time =
                Interval { from_s: at(k), to_s: at(k + 1), from_m: length_m, to_m: length_m };
            self.step(self.pieces.len(), &time, hold);
            if !(end_s > begin_s) {
                return; // all rigid: one step to spring
            }
        }
    }

    fn sag_m(&self) -> f64 {
        self.greatest_m.iter().fold(0.0, |a, b| if *b <= a { a } else { *b })
    }

    fn outcome(self, sag_printing_m: f64) -> RodOutcome {
        let sag_nozzle_m = self.sag_m();
        let cuts = self.strand.fineness.cuts.clamp(1, 64) as usize;
        let every = |i: usize| i * cuts;
        let nodes = self.strand.elements.len() + 1;
        let mut along_m = vec![self.place.far_along; nodes];
        let mut thinning = Vec::with_capacity(nodes - 1);
        for i in 1..nodes {
            let inside = &self.sections[2 * every(i - 1)..2 * every(i)];
            let longer: f64 = inside.iter().map(|s| s.weight_m * s.strain).sum();
            let mean = inside.iter().map(|s| s.strain).sum::<f64>() / inside.len() as f64;
            along_m[i] = along_m[i - 1] + longer;
            thinning.push((1.0 + mean).max(0.0).powf(-0.5));
        }
        RodOutcome {
            offset_m: (0..nodes).map(|i| self.shape[every(i)].0).collect(),
            slope: (0..nodes).map(|i| self.shape[every(i)].1).collect(),
            greatest_m: (0..nodes).map(|i| self.greatest_m[every(i)]).collect(),
            sag_nozzle_m,
            sag_printing_m,
            along_m,
            thinning,
            moment_n_m: self.last.moment,
            steps: self.steps,
            updates: self.updates,
        }
    }
}
