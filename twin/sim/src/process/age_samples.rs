//! A history as samples against age, taken as straight between them.
//!
//! A sample is `(age in s, value)`, ages rising. What is not finite or out of order contributes nothing.

/// Most pieces one stretch between two samples is cut into.
const MOST_PIECES: f64 = 64.0;

/// Value of a history at an age; before the first sample and after the last it is theirs.
///
/// Not a number where there is no sample. `O(log n)`.
pub fn at_age(samples: &[(f64, f64)], age_s: f64) -> f64 {
    let after = samples.partition_point(|sample| sample.0 <= age_s);
    let (Some(&from), Some(&to)) = (samples.get(after.saturating_sub(1)), samples.get(after))
    else {
        return samples.last().map_or(f64::NAN, |sample| sample.1);
    };
    if after == 0 {
        return from.1;
    }
    from.1 + (to.1 - from.1) * (age_s - from.0) / (to.0 - from.0)
}

/// `∫ f dx` by three Gauss points on each of `pieces` equal pieces; exact for a polynomial of degree five.
///
/// Error `O(pieces⁻⁶)` where `f` is smooth, `O(pieces⁻²)` where its slope jumps.
pub fn gauss(from: f64, to: f64, pieces: usize, f: impl Fn(f64) -> f64) -> f64 {
    let step = (to - from) / pieces.max(1) as f64;
    let aside = 0.5 * step * 0.6_f64.sqrt();
    let mut sum = 0.0;
    for i in 0..pieces.max(1) {
        let middle = from + step * (i as f64 + 0.5);
        sum += 8.0 * f(middle) + 5.0 * (f(middle - aside) + f(middle + aside));
    }
    sum * step / 18.0
}

/// `∫ rate(value) da` over the time in which the value lies above a bound.
///
/// The stretch in which a straight line crosses the bound is cut there. A stretch is cut into one piece for
/// each e-fold of the rate, at most 64, three Gauss points each, so that rates as steep as those of
/// Arrhenius are met within 1e-6; what is left is the error of the straight line, second order in the
/// spacing of the samples. `rate` must be finite or infinite and not negative. `O(n)`.
pub fn integral_above(samples: &[(f64, f64)], bound: f64, rate: impl Fn(f64) -> f64) -> f64 {
    let mut sum = 0.0;
    for pair in samples.windows(2) {
        let ((from_s, from), (to_s, to)) = (pair[0], pair[1]);
        let (low, high) = (from.min(to), from.max(to));
        let whole_s = to_s - from_s;
        if !(high > bound && whole_s > 0.0) {
            continue;
        }
        let hot_low = low.max(bound);
        let hot_s = if high > low { whole_s * (high - hot_low) / (high - low) } else { whole_s };
        let folds = (rate(high) / rate(hot_low)).ln().abs();
        let pieces = if folds <= MOST_PIECES { folds.ceil().max(1.0) } else { MOST_PIECES };
        let mean = gauss(0.0, 1.0, pieces as usize, |x| rate(hot_low + x * (high - hot_low)));
        let part = hot_s * mean;
        if !part.is_nan() {
            sum += part;
        }
    }
    sum
}

/// Time in which the value lies above a bound, s.
pub fn time_above_s(samples: &[(f64, f64)], bound: f64) -> f64 {
    integral_above(samples, bound, |_| 1.0)
}

#[cfg(test)]
mod tests;
