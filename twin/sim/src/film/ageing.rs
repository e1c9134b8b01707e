//! A section against its age.

use crate::cell::Job;
use crate::preflight::StrandResult;
use crate::process::History;

/// Ages told of a strand.
const AGES: usize = 24;

/// A section against its age, nominal values.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ageing {
    /// Ages, s, ascending.
    pub age_s: Vec<f64>,
    /// Mean temperature, K.
    pub temperature_k: Vec<f64>,
    /// Temperature on the axis, K; empty but for thermoplastics.
    pub core_k: Vec<f64>,
    /// Degree of cure at the surface; empty where its kinetics are not known.
    pub cure: Vec<f64>,
    /// Young's modulus, Pa.
    pub modulus_pa: Vec<f64>,
}

/// A section against its age, crowded while it is young, until `set_times` times its set time (and an hour at most).
pub fn ageing(job: &Job, result: &StrandResult, set_times: f64) -> Ageing {
    let (input, material) = (&result.input, &job.material);
    let history = History::new(input, material);
    let cure = result.lit.as_ref().and_then(|lit| lit.cure.as_ref());
    let set_s = result.outcome.set_time_s.nominal;
    let last_s = if set_s.is_finite() { (set_times * set_s).clamp(1.0, 3600.0) } else { 60.0 };
    let age = |k: usize| last_s * (k as f64 / (AGES - 1) as f64).powi(2);
    let age_s: Vec<f64> = (0..AGES).map(age).collect();
    let told = |value: &dyn Fn(f64) -> f64| age_s.iter().map(|&a| value(a)).collect();
    Ageing {
        temperature_k: told(&|a| history.temperature_k(a)),
        core_k: age_s.iter().filter_map(|&a| history.core_k(a)).collect(),
        cure: cure.map_or(Vec::new(), |cure| told(&|a| cure.at(a))),
        modulus_pa: told(&|a| history.modulus_pa(a)),
        age_s,
    }
}

impl Ageing {
    /// One of its columns at an age, straight between the ages told; the first and last value beyond them.
    pub fn at(&self, column: &[f64], age_s: f64) -> Option<f64> {
        let last = column.len().min(self.age_s.len()).checked_sub(1)?;
        let k = self.age_s[..=last].partition_point(|&told_s| told_s < age_s);
        if k == 0 || k > last {
            return column.get(k.min(last)).copied();
        }
        let share = (age_s - self.age_s[k - 1]) / (self.age_s[k] - self.age_s[k - 1]);
        Some(column[k - 1] + (column[k] - column[k - 1]) * share)
    }
}
