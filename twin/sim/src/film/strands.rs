//! Strands with the time at which every point is laid.

use super::borne::Borne;
use super::{Ageing, Quantity, ageing};
use crate::deposit::Printed;
use crate::finding::Phase;
use crate::motion::Moment;
use crate::pose::Point;
use crate::preflight::{Preflight, StrandResult};

/// Straight pieces are cut so that speed and bead show along them; all cuts of a film together number at most this.
const CUTS_MAX: usize = 24_000;
/// Ages are told until this many times the set time: beyond it a strand is nearly as cold as the air.
const COLD_SET_TIMES: f64 = 40.0;
/// Pieces of one straight stretch.
const PIECES: usize = 16;

/// A strand as it is printed. Values are SI, nominal.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmStrand {
    /// Name in the job.
    pub id: String,
    /// Index in the job.
    pub strand: usize,
    /// As printed, part axes.
    pub points: Vec<Point>,
    /// The same points as planned.
    pub planned: Vec<Point>,
    /// Arc length as planned at each point, m.
    pub at_m: Vec<f64>,
    /// When the orifice passes each point, s; never falling.
    pub time_s: Vec<f64>,
    /// Radius of the set bead, m.
    pub radius_m: f64,
    /// Diameter of the bead as drawn, of each segment, m; the set bead's where nothing is known along it.
    pub bead_m: Vec<f64>,
    /// Speed of the orifice on each segment, m/s.
    pub speed_m_s: Vec<f64>,
    /// Sag behind the nozzle, m.
    pub sag_m: f64,
    /// Least clearance while it is printed, m; infinite where nothing came nearer than twice the limit.
    pub clearance_m: f64,
    /// Displacement of each segment by weight in the last stage that was kept, staged, m; NaN: not solved.
    pub displacement_m: Vec<f64>,
    /// Largest share of strength that each segment's member used while the print grew; NaN: not solved.
    pub utilisation: Vec<f64>,
    /// Temperature and cure against age.
    pub ageing: Ageing,
}

impl FilmStrand {
    /// Number of straight segments.
    pub fn segments(&self) -> usize {
        self.points.len().saturating_sub(1)
    }

    /// When its extrusion begins, s.
    pub fn born_s(&self) -> Option<f64> {
        self.time_s.first().copied()
    }

    /// When it ends, s.
    pub fn done_s(&self) -> Option<f64> {
        self.time_s.last().copied()
    }

    /// How many points are laid by a time, and the place of the nozzle on the segment that is being laid, 0 to 1.
    pub fn laid(&self, time_s: f64) -> (usize, Option<f64>) {
        let times = &self.time_s;
        let laid = times.partition_point(|&at_s| at_s <= time_s);
        if laid == 0 || laid == times.len() {
            return (laid, None);
        }
        let share = (time_s - times[laid - 1]) / (times[laid] - times[laid - 1]);
        (laid, Some(share).filter(|share| *share > 0.0))
    }

    /// A quantity of a segment at a time, SI; `None` where it is not known. `order` is the strand's place in the film.
    pub fn value(
        &self,
        order: usize,
        segment: usize,
        quantity: Quantity,
        time_s: f64,
    ) -> Option<f64> {
        let age_s = || {
            let [from, to] = [self.time_s.get(segment)?, self.time_s.get(segment + 1)?];
            Some((time_s - 0.5 * (from + to)).max(0.0))
        };
        let value = match quantity {
            Quantity::Sag => self.sag_m,
            Quantity::Order => (order + 1) as f64,
            Quantity::Age => age_s()?,
            Quantity::Temperature => self.ageing.at(&self.ageing.temperature_k, age_s()?)?,
            Quantity::Cure => self.ageing.at(&self.ageing.cure, age_s()?)?,
            Quantity::BeadWidth => *self.bead_m.get(segment)?,
            Quantity::Displacement => *self.displacement_m.get(segment)?,
            Quantity::Utilisation => *self.utilisation.get(segment)?,
            Quantity::Clearance => self.clearance_m,
            Quantity::Speed => *self.speed_m_s.get(segment)?,
        };
        value.is_finite().then_some(value)
    }
}

/// All strands, in printing order.
pub(super) fn strands(preflight: &Preflight) -> Vec<FilmStrand> {
    let printed = &preflight.deposit.strands;
    let straight: usize = printed.iter().map(|strand| strand.at_m.len().saturating_sub(1)).sum();
    let pieces = (CUTS_MAX / straight.max(1)).clamp(1, PIECES);
    let passes = passes(preflight);
    let clearances = clearances(preflight);
    let borne = Borne::new(preflight);
    let made = printed.iter().zip(&preflight.strands).enumerate();
    made.map(|(order, (printed, result))| {
        let (at_m, points, planned) = cut(printed, pieces);
        let time_s = times(printed, &passes[printed.strand], &at_m);
        let (displacement_m, utilisation) = borne.along(order, &at_m);
        FilmStrand {
            id: preflight.job().strands[printed.strand].id.clone(),
            strand: printed.strand,
            bead_m: beads(result, printed, &at_m),
            speed_m_s: speeds(&at_m, &time_s),
            points,
            planned,
            at_m,
            time_s,
            radius_m: printed.radius_m,
            sag_m: result.outcome.sag_nozzle_m.nominal,
            clearance_m: clearances[printed.strand],
            displacement_m,
            utilisation,
            ageing: ageing(preflight.job(), result, COLD_SET_TIMES),
        }
    })
    .collect()
}

/// Each straight stretch in `pieces`.
fn cut(printed: &Printed, pieces: usize) -> (Vec<f64>, Vec<Point>, Vec<Point>) {
    let n = printed.at_m.len();
    let mut out = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..n {
        let many = if k + 1 < n { pieces } else { 1 };
        let next = (k + 1).min(n - 1);
        for piece in 0..many {
            let share = piece as f64 / many as f64;
            let between = |points: &[Point]| points[k] + (points[next] - points[k]) * share;
            out.0.push(printed.at_m[k] + (printed.at_m[next] - printed.at_m[k]) * share);
            out.1.push(between(&printed.as_printed));
            out.2.push(between(&printed.as_planned));
        }
    }
    out
}

/// Moments of extrusion of each strand of the job.
fn passes(preflight: &Preflight) -> Vec<Vec<Moment>> {
    let mut passes: Vec<Vec<Moment>> = vec![Vec::new(); preflight.job().strands.len()];
    for leg in preflight.motion.legs.iter().filter(|leg| leg.phase == Phase::Print) {
        if let Some(strand) = leg.strand {
            passes[strand].extend_from_slice(&leg.moments);
        }
    }
    passes
}

/// When the orifice passes arc lengths; evenly from birth to end where it never does.
fn times(printed: &Printed, pass: &[Moment], at_m: &[f64]) -> Vec<f64> {
    let mut k = 0;
    let mut last_s = f64::NEG_INFINITY;
    let mut at = |at_m: f64| {
        while k + 1 < pass.len() && pass[k + 1].at_m < at_m {
            k += 1;
        }
        let time_s = match pass.get(k..k + 2) {
            Some([from, to]) if to.at_m > from.at_m => {
                let share = ((at_m - from.at_m) / (to.at_m - from.at_m)).clamp(0.0, 1.0);
                from.time_s + (to.time_s - from.time_s) * share
            }
            Some([from, _]) => from.time_s,
            _ => printed.even_time_s(at_m),
        };
        last_s = last_s.max(time_s);
        last_s
    };
    at_m.iter().map(|&at_m| at(at_m)).collect()
}

fn speeds(at_m: &[f64], time_s: &[f64]) -> Vec<f64> {
    let both = at_m.windows(2).zip(time_s.windows(2));
    both.map(|(at, time)| {
        let taken_s = time[1] - time[0];
        if taken_s > 0.0 { (at[1] - at[0]) / taken_s } else { f64::NAN }
    })
    .collect()
}

/// Bead as drawn at the middle of each segment: that of the stretch it lies in.
fn beads(result: &StrandResult, printed: &Printed, at_m: &[f64]) -> Vec<f64> {
    let beads = &result.fed.beads;
    let nearest = |middle_m: f64| {
        let k = beads.partition_point(|bead| bead.at_m < middle_m);
        let near = [k.checked_sub(1), Some(k)].into_iter().flatten().filter_map(|k| beads.get(k));
        let off = |at_m: f64| (at_m - middle_m).abs();
        let near = near.min_by(|a, b| off(a.at_m).total_cmp(&off(b.at_m)));
        near.map_or(2.0 * printed.radius_m, |bead| bead.bead.hot_m)
    };
    at_m.windows(2).map(|pair| nearest(0.5 * (pair[0] + pair[1]))).collect()
}

/// Least clearance on the legs of each strand of the job but transits.
fn clearances(preflight: &Preflight) -> Vec<f64> {
    let mut least = vec![f64::INFINITY; preflight.job().strands.len()];
    for (leg, clearance_m) in preflight.motion.legs.iter().zip(&preflight.clearance_by_leg_m) {
        if let (Some(strand), Some(clearance_m)) = (leg.strand, clearance_m)
            && leg.phase != Phase::Transit
        {
            least[strand] = least[strand].min(*clearance_m);
        }
    }
    least
}
