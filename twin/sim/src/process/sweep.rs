//! The run of the nozzle past a strand, cut into steps, and the segments in reach of the lamps at each.

use crate::pose::Point;

use super::dose::{Run, Segment, SegmentDose, Strand, mean};
use super::irradiance::{Azimuths, Irradiance};
use super::lamp::{Lamp, Lobe};
use super::lights::{LEAST_SHARE, LampSet, Lights, Station};
use super::memo::Memo;
use super::reach::Tree;
use super::steps::{EARLY, END, FINE, INSTANTS, LATE, MIDDLE, PIECES, Step, spans};

/// Share of the greatest irradiance so far above which a step is looked at thrice.
const BRIGHT: f64 = 0.1;
/// Most steps between two stations.
const MOST_STEPS: f64 = 256.0;
/// Step of the lamps, in standard widths of the lobe.
const STEP_WIDTHS: f64 = 0.4;
/// Lobe widths before the end of the run from which steps are finer: segments born there see little light beyond the edges
/// of shadows, and a step's error is a greater part of it.
const LAST_WIDTHS: f64 = 2.0;
/// How much finer.
const LAST_FINER: f64 = 8.0;

/// See [`add_run`](super::dose::add_run).
pub(super) fn sweep(
    segments: &[Segment],
    doses: &mut [SegmentDose],
    run: &Run,
    strand: &Strand,
) -> usize {
    let azimuths = strand.azimuths.clamp(3, 64);
    let fits = |dose: &SegmentDose| {
        dose.surface_j_m2.len() == azimuths && dose.beam_j_m2.len() == azimuths
    };
    let radius_m = strand.radius_m;
    let ready = !segments.is_empty() && doses.len() >= segments.len() && doses.iter().all(fits);
    if !ready || run.stations.is_empty() || !(radius_m > 0.0) {
        return 0;
    }
    let tree = Tree::over(segments);
    let grain = Grain::of(run);
    let mut sweep = Sweep::new(segments, azimuths, strand, run.lights);
    let mut reached = Vec::new();
    for (number, pair) in spans(run).iter().enumerate() {
        let (count, slack_m, slack_rad) = grain.steps(pair, run);
        for i in 0..count {
            let cut = |i: usize| pair[0].towards(&pair[1], i as f64 / count as f64);
            let mut step = Step::new([cut(i), cut(i + 1)], (number, i), run.lights);
            if step.middle.lamps.is_empty() {
                continue;
            }
            let until_s = step.ends[1].time_s;
            let lit = |centre: Point, size_m: f64, born_s: f64| {
                let size_m = size_m + radius_m;
                born_s < until_s
                    && step.middle.reaches(centre, size_m, slack_m, slack_rad, grain.floor_w_m2)
            };
            reached.clear();
            tree.walk(&lit, &mut reached);
            for &index in &reached {
                sweep.add(index, &mut doses[index], &mut step);
            }
        }
    }
    sweep.looks
}

/// A strand being lit.
struct Sweep<'a> {
    segments: &'a [Segment],
    round: Azimuths,
    strand: &'a Strand,
    now: Irradiance,
    spare: Irradiance,
    memo: Memo,
    /// What was hidden from each segment when it was last looked at.
    hidden: Vec<u64>,
    looks: usize,
}

impl<'a> Sweep<'a> {
    fn new(segments: &'a [Segment], azimuths: usize, strand: &'a Strand, lights: &Lights) -> Self {
        Self {
            segments,
            round: Azimuths::new(azimuths),
            strand,
            now: Irradiance::dark(azimuths),
            spare: Irradiance::dark(azimuths),
            memo: Memo::new(lights),
            hidden: vec![0; segments.len()],
            looks: 0,
        }
    }

    fn look(&mut self, index: usize, step: &mut Step, instant: usize) {
        self.looks += 1;
        let (round, radius_m) = (&self.round, self.strand.radius_m);
        let segment = &self.segments[index];
        // How far behind the nozzle, and which instant: the same for a strand of even shape.
        let (number, part) = step.place;
        let key = (number.wrapping_sub(index), part * INSTANTS + instant);
        let scene = step.scene_at(instant);
        self.memo.look(key, scene, segment, &mut self.now, |now| {
            now.fill(scene, segment, round, radius_m);
        });
    }

    /// Adds a step to a segment: by three instants where it is bright and one where it is not, or in finer
    /// pieces where the segment is born, gels or meets the edge of a shadow.
    fn add(&mut self, index: usize, dose: &mut SegmentDose, step: &mut Step) {
        let born_s = self.segments[index].born_s;
        let [from_s, until_s] = [step.ends[0].time_s, step.ends[1].time_s];
        if born_s >= until_s {
            return;
        }
        let mut after = 0;
        self.look(index, step, MIDDLE);
        if self.now.near_shade {
            // The middle is wanted again: it steps aside while the end is looked at.
            std::mem::swap(&mut self.now, &mut self.spare);
            self.look(index, step, END);
            after = self.now.hidden;
            std::mem::swap(&mut self.now, &mut self.spare);
        }
        let same = self.hidden[index] == self.now.hidden && after == self.now.hidden;
        self.hidden[index] = after;
        let (span_s, age_s) = (until_s - from_s, from_s - born_s);
        if age_s >= 0.0 && same && !self.gels(dose, span_s) {
            if mean(&self.now.surface) < BRIGHT * dose.peak_w_m2 {
                self.take(dose, age_s, span_s);
                return;
            }
            self.take(dose, age_s, span_s * 8.0 / 18.0);
            for instant in [EARLY, LATE] {
                self.look(index, step, instant);
                self.take(dose, age_s, span_s * 5.0 / 18.0);
            }
            return;
        }
        let piece_s = span_s / FINE as f64;
        for i in 0..FINE {
            let start_s = (from_s + piece_s * i as f64).max(born_s);
            let stop_s = from_s + piece_s * (i + 1) as f64;
            if start_s < stop_s {
                self.look(index, step, PIECES + i);
                self.take(dose, start_s - born_s, stop_s - start_s);
            }
        }
    }

    /// Whether the surface gels within a time at the irradiance there is now.
    fn gels(&self, dose: &SegmentDose, span_s: f64) -> bool {
        (dose.gel_s.is_infinite() && self.wait_s(dose) <= span_s)
            || (dose.mean_gel_s.is_infinite() && self.mean_wait_s(dose) <= span_s)
    }

    /// How long until the last azimuth reaches the critical exposure at this irradiance, s.
    fn wait_s(&self, dose: &SegmentDose) -> f64 {
        let pairs = dose.surface_j_m2.iter().zip(&self.now.surface);
        pairs.map(|(had, gets)| self.wait_of_s(*had, *gets)).fold(0.0, f64::max)
    }

    fn mean_wait_s(&self, dose: &SegmentDose) -> f64 {
        self.wait_of_s(dose.mean_j_m2(), mean(&self.now.surface))
    }

    fn wait_of_s(&self, had_j_m2: f64, gets_w_m2: f64) -> f64 {
        let missing = self.strand.critical_j_m2 - had_j_m2;
        // Not a number counts as never.
        match (missing <= 0.0, gets_w_m2 > 0.0) {
            (true, _) => 0.0,
            (false, true) if missing.is_finite() => missing / gets_w_m2,
            _ => f64::INFINITY,
        }
    }

    fn take(&self, dose: &mut SegmentDose, age_s: f64, span_s: f64) {
        if dose.gel_s.is_infinite() {
            let wait_s = self.wait_s(dose);
            dose.gel_s = if wait_s <= span_s { age_s + wait_s } else { f64::INFINITY };
        }
        if dose.mean_gel_s.is_infinite() {
            let wait_s = self.mean_wait_s(dose);
            dose.mean_gel_s = if wait_s <= span_s { age_s + wait_s } else { f64::INFINITY };
        }
        dose.peak_w_m2 = dose.peak_w_m2.max(mean(&self.now.surface));
        for (had, gets) in dose.surface_j_m2.iter_mut().zip(&self.now.surface) {
            *had += gets * span_s;
        }
        for (had, gets) in dose.beam_j_m2.iter_mut().zip(&self.now.beam) {
            *had += gets * span_s;
        }
    }
}

/// How fine to cut, and where to stop looking.
struct Grain {
    /// Irradiance below which a lamp is left out, W/m².
    floor_w_m2: f64,
    /// Standard width of the lobe at the nozzle, m, least over the lamps of each set.
    widths_m: Vec<f64>,
    /// From the carrier's origin to the farthest lamp, m, for each set.
    arms_m: Vec<f64>,
}

impl Grain {
    fn of(run: &Run) -> Self {
        let mut grain = Self { floor_w_m2: 0.0, widths_m: vec![], arms_m: vec![] };
        let mut most: f64 = 0.0;
        for set in &run.lights.sets {
            let mut width_m = f64::INFINITY;
            for station in run.stations {
                let pose = station.part_from(set.carrier);
                for lamp in &set.lamps {
                    let distance_m = (pose * lamp.at - station.point).norm();
                    width_m = width_m.min(distance_m * spread_rad(lamp));
                    most = most.max(lamp.peak_w_sr / (distance_m * distance_m));
                }
            }
            grain.widths_m.push(width_m);
            let arm_m = |lamp: &Lamp| lamp.at.coords.norm();
            grain.arms_m.push(set.lamps.iter().map(arm_m).fold(0.0, f64::max));
        }
        grain.floor_w_m2 = LEAST_SHARE * most;
        grain
    }

    /// How many steps a span takes, and how far lamps move (m) and turn (rad) in one.
    fn steps(&self, span: &[Station; 2], run: &Run) -> (usize, f64, f64) {
        let (mut count, mut most_m, mut most_rad): (f64, f64, f64) = (1.0, 0.0, 0.0);
        let sizes = self.widths_m.iter().zip(&self.arms_m);
        let left_m = run.stations.last().map_or(0.0, |last| (last.point - span[1].point).norm());
        for (set, (width_m, arm_m)) in run.lights.sets.iter().zip(sizes) {
            let (moved_m, turned_rad) = carried(set, span);
            let moved_m = moved_m + turned_rad * arm_m;
            let finer = if left_m < LAST_WIDTHS * width_m { LAST_FINER } else { 1.0 };
            let steps = (finer * moved_m / (STEP_WIDTHS * width_m)).ceil();
            count = count.max(steps);
            (most_m, most_rad) = (most_m.max(moved_m), most_rad.max(turned_rad));
        }
        let count = count.clamp(1.0, MOST_STEPS);
        (count as usize, most_m / count, most_rad / count)
    }
}

/// How far a carrier's origin moves and how far it turns over a span, seen from the part.
fn carried(set: &LampSet, span: &[Station; 2]) -> (f64, f64) {
    let [a, b] = [span[0].part_from(set.carrier), span[1].part_from(set.carrier)];
    let moved = a.translation.vector - b.translation.vector;
    (moved.norm(), a.rotation.angle_to(&b.rotation))
}

/// Standard width of a lobe, rad.
fn spread_rad(lamp: &Lamp) -> f64 {
    match lamp.lobe {
        Lobe::Gaussian => 0.5 * lamp.full_angle_rad.abs() / (2.0 * std::f64::consts::LN_2).sqrt(),
        Lobe::Lambert(power) => 1.0 / power.max(1.0).sqrt(),
    }
}
