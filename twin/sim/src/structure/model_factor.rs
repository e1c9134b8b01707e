//! How far predicted loads at first yield are to be trusted.

use crate::interval::Interval;

/// Mean of measured over predicted initial yield: planar 1.017, 0.792; shells 0.891, 0.642, 0.754, 0.530.
const MEAN: f64 = 0.77;
/// Its coefficient of variation over those six.
const VARIATION: f64 = 0.23;
/// Of the standard normal distribution, at 95 %.
const AT_95: f64 = 1.644_853_626_951_472_2;

/// Measured over predicted load at first yield of frames printed of thermoplastic: mean, and 5 and 95 % of a lognormal
/// distribution of that mean and variation,
///
/// ```text
/// s² = ln(1 + V²)      5 %, 95 %: m/√(1 + V²) exp(∓1.645 s)
/// ```
///
/// Six tests of two papers by one group, in ABS and PLA (Tam & Mueller; structures.md section 4.4). Whether it holds for other
/// materials is not known.
pub fn model_factor() -> Interval {
    let spread = (1.0 + VARIATION * VARIATION).ln().sqrt();
    let median = MEAN / (1.0 + VARIATION * VARIATION).sqrt();
    Interval::new(MEAN, median * (-AT_95 * spread).exp(), median * (AT_95 * spread).exp())
}

#[cfg(test)]
mod tests {
    use super::model_factor;

    /// The mean and spread are those of the six tests, the 5 % fractile the one printed with them.
    #[test]
    fn six_tests_of_two_papers() {
        let six: [f64; 6] = [0.891, 0.642, 0.754, 0.530, 1.017, 0.792];
        let mean = six.iter().sum::<f64>() / 6.0;
        let square: f64 = six.iter().map(|x| (x - mean).powi(2)).sum();
        let factor = model_factor();
        assert!((factor.nominal - mean).abs() < 0.005, "{mean}");
        let variation = (square / 5.0).sqrt() / mean;
        assert!((variation - 0.23).abs() < 0.01, "{variation}");
        assert!((factor.low - 0.52).abs() < 0.005 && factor.high > 1.0);
    }
}
