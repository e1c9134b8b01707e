//! What became of a strand along its length and with age.

use sim::cell::Job;
use sim::deposit::Printed;
use sim::preflight::StrandResult;
use sim::process::History;
use sim::process::feed::sphere_diameter_m;

use crate::fill::number;
use crate::results::Ageing;

/// Ages told of a strand.
const AGES: usize = 24;
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

/// A section against its age, crowded while it is young, until three times its set time.
pub(crate) fn ageing(job: &Job, result: &StrandResult) -> Ageing {
    let (input, material) = (&result.input, &job.material);
    let history = History::new(input, material);
    let cure = result.lit.as_ref().and_then(|lit| lit.cure.as_ref());
    let set_s = result.outcome.set_time_s.nominal;
    let last_s = if set_s.is_finite() { (3.0 * set_s).clamp(1.0, 3600.0) } else { 60.0 };
    let age = |k: usize| last_s * (k as f64 / (AGES - 1) as f64).powi(2);
    let age_s: Vec<f64> = (0..AGES).map(age).collect();
    let told = |value: &dyn Fn(f64) -> f64| age_s.iter().map(|&a| number(value(a))).collect();
    Ageing {
        temperature_k: told(&|a| history.temperature_k(a)),
        core_k: age_s.iter().filter_map(|&a| history.core_k(a)).map(number).collect(),
        cure: cure.map_or(Vec::new(), |cure| told(&|a| cure.at(a))),
        modulus_pa: told(&|a| history.modulus_pa(a)),
        age_s,
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
