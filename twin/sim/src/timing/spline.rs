//! A curve with continuous second derivative through samples.

use crate::kinematics::Posture;

/// Second derivatives at the samples of the cubic spline through `(s, q)`, one posture per sample.
///
/// ```text
/// h₋ M₋ + 2 (h₋ + h₊) M + h₊ M₊ = 6 ((q₊ − q)/h₊ − (q − q₋)/h₋)
/// ```
///
/// The slope at either end is that of the polynomial through the four samples there (fewer if
/// there are fewer), so lines and parabolas come back as such. `s` grows strictly.
pub(super) fn second_derivatives(s: &[f64], q: &[Posture]) -> Vec<Posture> {
    let n = s.len();
    let dof = q.first().map_or(0, |q| q.len());
    let mut out = vec![Posture::zeros(dof); n];
    if n < 3 {
        return out;
    }
    let near = n.min(4);
    let (first, last) = (weights(&s[..near], s[0]), weights(&s[n - near..], s[n - 1]));
    let mut diagonal = vec![0.0; n];
    let mut right = vec![0.0; n];
    for joint in 0..dof {
        let rise = |k: usize| (q[k + 1][joint] - q[k][joint]) / (s[k + 1] - s[k]);
        // Slopes against the first rise, so that a straight line gives zeros and not rounding.
        let slope = |weights: &[f64], at: usize, base: f64| {
            let left = q[at][joint];
            let rest =
                |(k, w): (usize, &f64)| w * (q[at + k][joint] - left - base * (s[at + k] - s[at]));
            weights.iter().enumerate().map(rest).sum::<f64>()
        };
        let base_end = rise(n - 2);
        let (h_first, h_last) = (s[1] - s[0], s[n - 1] - s[n - 2]);
        diagonal[0] = 2.0 * h_first;
        right[0] = -6.0 * slope(&first, 0, rise(0));
        for k in 1..n {
            let before = s[k] - s[k - 1];
            let (own, wanted) = if k + 1 < n {
                (2.0 * (s[k + 1] - s[k - 1]), 6.0 * (rise(k) - rise(k - 1)))
            } else {
                (2.0 * h_last, 6.0 * slope(&last, n - near, base_end))
            };
            let share = before / diagonal[k - 1];
            diagonal[k] = own - share * before;
            right[k] = wanted - share * right[k - 1];
        }
        out[n - 1][joint] = right[n - 1] / diagonal[n - 1];
        for k in (0..n - 1).rev() {
            out[k][joint] = (right[k] - (s[k + 1] - s[k]) * out[k + 1][joint]) / diagonal[k];
        }
    }
    out
}

/// Weights of the samples at `s` in the derivative at `at`, one of them, of the polynomial through
/// all.
fn weights(s: &[f64], at: f64) -> Vec<f64> {
    let weight = |k: usize| {
        let others = || (0..s.len()).filter(move |&other| other != k);
        let below: f64 = others().map(|other| s[k] - s[other]).product();
        let term = |left: usize| {
            others().filter(|&other| other != left).map(|other| at - s[other]).product::<f64>()
        };
        others().map(term).sum::<f64>() / below
    };
    (0..s.len()).map(weight).collect()
}
