//! How slowly a strand must be printed for its sag behind the nozzle to keep its limit: tried, not extrapolated.

use super::making::{Rod, StrandResult};
use crate::cell::{Flow, Job};
use crate::interval::Interval;
use crate::process::{self, Heats, StrandInput};

/// Speeds that are tried.
const TRIES: usize = 5;
/// Sag that goes with less than this power of speed is not mended by it.
const LEAST_POWER: f64 = 0.3;
/// Slower than this share of the asked speed is no advice.
const LEAST_SHARE: f64 = 0.05;

/// The share of its speed at which the sag (its high end, if only that is past the limit) is inside the limit; `None` where
/// speed alone does not mend it.
///
/// From one try to the next by the power of speed that the last one showed. The closed form's fourth power is that of a
/// strand much longer than its soft stretch at a fixed set time; where stretching holds or the span is short it is less.
pub(super) fn slow_enough(job: &Job, result: &StrandResult, limit_m: f64) -> Option<f64> {
    let by_nominal = result.outcome.sag_nozzle_m.nominal > limit_m;
    let pick = |sag: Interval| if by_nominal { sag.nominal } else { sag.high };
    let now_m = pick(result.outcome.sag_nozzle_m);
    let mut power = 4.0;
    for _ in 0..TRIES {
        let share = 0.995 * (limit_m / now_m).powf(1.0 / power);
        if !(share > LEAST_SHARE) {
            return None;
        }
        let sag_m = pick(sag_at(job, result, share));
        if sag_m <= limit_m {
            return Some(share);
        }
        power = (0.9 * (sag_m / now_m).ln() / share.ln()).min(0.9 * power);
        if !(power > LEAST_POWER) {
            return None;
        }
    }
    None
}

/// The sag of the same strand at a share of its speed, m; flow goes along where the job asks for a diameter.
fn sag_at(job: &Job, result: &StrandResult, share: f64) -> Interval {
    let flow = match job.strands[result.strand].settings.flow {
        Flow::Diameter(_) => share,
        Flow::Rate(_) => 1.0,
    };
    let input = StrandInput {
        speed_m_s: result.input.speed_m_s * share,
        flow_m3_s: result.input.flow_m3_s * flow,
        ..result.input
    };
    let course = result.course.clone().slowed(share);
    let heats = Heats::new(&input, &job.material);
    let mut outcome = process::simulate_with(&input, &job.material, &heats);
    let rod =
        Rod { input: &input, course: &course, job, heats: &heats, stretch_m: result.stretch_m };
    rod.replaces(&mut outcome);
    outcome.sag_nozzle_m
}
