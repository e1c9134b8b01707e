//! Dose of light on the surface of each segment of a strand while nozzle, strand and bed move.

use crate::pose::{Point, Vector};

use super::lights::{Lights, Station};
use super::sweep;

/// Azimuths round a segment at which dose is kept, unless told: odd and prime to common rings.
///
/// Eight lamps make a ripple of period 45° round the strand; eight azimuths see only one phase of it and
/// miss the mean by 3 to 5 %, nine miss it by 0.05 %.
pub const AZIMUTHS: usize = 9;

/// A segment of a strand that has left the nozzle, in part axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Its middle, m.
    pub middle: Point,
    /// Along it, of unit length.
    pub tangent: Vector,
    /// Direction of the first azimuth, of unit length and across the tangent; the others follow by the right
    /// hand about the tangent.
    pub across: Vector,
    /// When its middle left the nozzle, s.
    pub born_s: f64,
}

/// The segments between the stations of a strand, one fewer than stations.
///
/// The first azimuth is turned towards the tool's x axis at birth, so that moving everything together
/// changes nothing. A segment of no length takes the tool's z axis for its tangent.
pub fn segments(stations: &[Station]) -> Vec<Segment> {
    let segment = |pair: &[Station]| {
        let half = pair[0].towards(&pair[1], 0.5);
        let [x, y, z] = [Vector::x(), Vector::y(), Vector::z()].map(|v| half.part_from_tool * v);
        let chord = pair[1].point - pair[0].point;
        let tangent = chord.try_normalize(1e-12).unwrap_or(z);
        let hint = if tangent.dot(&x).abs() < 0.9 { x } else { y };
        let across = hint - tangent * tangent.dot(&hint);
        let across = across.try_normalize(1e-12).unwrap_or(y);
        Segment { middle: half.point, tangent, across, born_s: half.time_s }
    };
    stations.windows(2).map(segment).collect()
}

/// What lights a strand: the run of the nozzle past it, and the lamps.
#[derive(Debug, Clone, Copy)]
pub struct Run<'a> {
    /// The nozzle's run; at least one station.
    pub stations: &'a [Station],
    /// How long everything rests at the last station, s.
    pub dwell_s: f64,
    /// Lamps and shades.
    pub lights: &'a Lights,
}

/// Round strand and what it takes to set it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strand {
    /// Radius, m.
    pub radius_m: f64,
    /// Critical exposure, J/m².
    pub critical_j_m2: f64,
    /// Azimuths to keep, 3 to 64; [`AZIMUTHS`] where nothing speaks against it.
    pub azimuths: usize,
}

/// Light a segment has received.
#[derive(Debug, Clone, PartialEq)]
pub struct SegmentDose {
    /// Dose on the surface at each azimuth, J/m², by the cosine law.
    pub surface_j_m2: Vec<f64>,
    /// The same light as parallel beams from each azimuth, J/m² across the beam and square to the strand.
    ///
    /// A lamp between two azimuths is shared between them. What `through` sends through the section.
    pub beam_j_m2: Vec<f64>,
    /// Age at which every azimuth has reached the critical exposure, s; infinite if one never does.
    pub gel_s: f64,
    /// Age at which the mean over the azimuths has, s.
    pub mean_gel_s: f64,
    /// Greatest mean irradiance it saw, W/m².
    pub peak_w_m2: f64,
}

impl SegmentDose {
    /// A segment in the dark.
    pub fn dark(azimuths: usize) -> Self {
        let azimuths = azimuths.clamp(3, 64);
        Self {
            surface_j_m2: vec![0.0; azimuths],
            beam_j_m2: vec![0.0; azimuths],
            gel_s: f64::INFINITY,
            mean_gel_s: f64::INFINITY,
            peak_w_m2: 0.0,
        }
    }

    /// Mean over the azimuths, J/m².
    pub fn mean_j_m2(&self) -> f64 {
        mean(&self.surface_j_m2)
    }

    /// Dose on the least-lit azimuth, J/m².
    pub fn least_j_m2(&self) -> f64 {
        least(&self.surface_j_m2)
    }

    /// How long it was lit, s: mean dose over greatest mean irradiance; zero in the dark.
    pub fn lit_s(&self) -> f64 {
        if self.peak_w_m2 > 0.0 { self.mean_j_m2() / self.peak_w_m2 } else { 0.0 }
    }
}

/// Dose on each segment from a run, J/m².
///
/// `H(ψ) = ∫ Σ J(θ)/r² max(0, cos) dt` at points of the true surface; shades block, and the strand blocks its
/// own far side, but not other segments (give those as shades). Light below 1e-4 of the peak, of each
/// lamp's axis and of the greatest irradiance at the nozzle, is left out; so is light thrown back by the bed
/// (see [`bed_light`](super::bed_light)). A segment starts at its birth: what was lit before is nought.
///
/// Time is cut so that the lamps move by at most 0.4 of the lobe's standard width at a step; a step is looked at
/// three times (Gauss) where it is bright, and in sixteen pieces at birth, where an edge of shade passes and
/// where the surface gels. Within 1 % of a dense ray sum on each azimuth, 0.3 % in the mean; 2 % where the run
/// ends while a segment has seen a millimetre of light.
///
/// Cost: a tree of boxes finds the segments in reach at each step, so `n` stations cost `n log n` plus `n` times
/// the segments in reach, times lamps and azimuths; not `n²`. Where lamps and shades all stand on one carrier and
/// the strand has the same shape behind the nozzle as a moment ago (straight, round, screw, evenly spaced
/// stations), the irradiance is remembered and not summed again.
///
/// A second run over the same segments adds its dose to what is there: [`add_run`].
pub fn strand_dose(run: &Run, strand: &Strand) -> Vec<SegmentDose> {
    let segments = segments(run.stations);
    let mut doses = vec![SegmentDose::dark(strand.azimuths); segments.len()];
    add_run(&segments, &mut doses, run, strand);
    doses
}

/// Adds the dose of another run to segments that are there already; returns how many pairs of segment and
/// instant were looked at.
///
/// Doses of another count of azimuths, or fewer doses than segments, are left as they are. Runs are added in
/// order of time, so that the ages at gel are the first.
pub fn add_run(
    segments: &[Segment],
    doses: &mut [SegmentDose],
    run: &Run,
    strand: &Strand,
) -> usize {
    sweep::sweep(segments, doses, run, strand)
}

pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

pub(super) fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}
