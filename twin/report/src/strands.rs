//! What became of a strand along its length and with age.

use sim::cell::Job;
use sim::deposit::Printed;
use sim::film;
use sim::preflight::StrandResult;
use sim::process::feed::sphere_diameter_m;

use crate::fill::number;
use crate::results::Ageing;

/// Ages are told until this many times the set time.
const SET_TIMES: f64 = 3.0;
/// Points told of a centreline.
const POINTS: usize = 65;

/// Thinnest and widest bead over what was asked, away from the ends.
pub(crate) fn bead_share(job: &Job, result: &StrandResult) -> Option<[f64; 2]> {
    let shares = result
        .steady_beads(job)
        .map(|at| at.bead.hot_m / at.asked_m)
        .filter(|share| share.is_finite());
    shares.fold(None, |ends: Option<[f64; 2]>, share| {
        let [low, high] = ends.unwrap_or([share, share]);
        Some([low.min(share), high.max(share)])
    })
}

/// Balls of what comes out at rest, diameters.
pub(crate) fn blobs_m(result: &StrandResult) -> [Option<f64>; 3] {
    let blobs = result.fed.blobs;
    [blobs.start_m3, blobs.end_m3, blobs.ooze_m3].map(|volume| number(sphere_diameter_m(volume)))
}

/// A section against its age.
pub(crate) fn ageing(job: &Job, result: &StrandResult) -> Ageing {
    let told = film::ageing(job, result, SET_TIMES);
    let numbers = |column: &[f64]| column.iter().map(|&value| number(value)).collect();
    Ageing {
        temperature_k: numbers(&told.temperature_k),
        core_k: numbers(&told.core_k),
        cure: numbers(&told.cure),
        modulus_pa: numbers(&told.modulus_pa),
        age_s: told.age_s,
    }
}

/// The line as printed, at most [`POINTS`] of its points, both ends among them.
pub(crate) fn centreline_m(printed: &Printed) -> Vec<[f64; 3]> {
    let points = &printed.as_printed;
    let told = points.len().min(POINTS);
    let last = points.len().saturating_sub(1);
    let index = |k: usize| if told > 1 { k * last / (told - 1) } else { 0 };
    (0..told).map(|k| points[index(k)].coords.into()).collect()
}
