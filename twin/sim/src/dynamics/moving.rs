//! Speed and acceleration of a motion given as places in time.

use nalgebra::{Matrix3, Vector3};

use super::model::{JointVector, State};

/// A state at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timed {
    /// Time, s.
    pub t_s: f64,
    /// Where the arm is and how it moves.
    pub state: State,
}

/// Fewest samples of a fit: two on each side.
const FIT: usize = 5;

/// Speed and acceleration at every sample, each from the parabola that fits its neighbourhood best:
/// all samples within `half_window_s`, at least the [`FIT`] nearest. A sample no later than the one
/// before it is left out.
///
/// Law: least squares of `q ≈ c₀ + c₁ τ + c₂ τ²`; `q̇ = c₁`, `q̈ = 2 c₂`. The joint value is
/// the sample's own. Exact for motions of constant acceleration; where the acceleration jumps it is
/// smoothed over the window, so a peak shorter than that is told too low.
pub fn differentiate(samples: &[(f64, JointVector)], half_window_s: f64) -> Vec<Timed> {
    let mut kept: Vec<(f64, JointVector)> = Vec::with_capacity(samples.len());
    for &(t_s, q) in samples {
        if t_s.is_finite() && kept.last().is_none_or(|&(last, _)| t_s > last) {
            kept.push((t_s, q));
        }
    }
    let (mut first, mut past) = (0, 0);
    let mut moments = Vec::with_capacity(kept.len());
    for (index, &(t_s, q)) in kept.iter().enumerate() {
        while kept[first].0 < t_s - half_window_s {
            first += 1;
        }
        past = past.max(index + 1);
        while past < kept.len() && kept[past].0 <= t_s + half_window_s {
            past += 1;
        }
        // Two on each side; at the ends of the motion what is missing there comes from inside.
        let low = first.min(index.saturating_sub(FIT / 2)).min(kept.len().saturating_sub(FIT));
        let high = past.max((index + FIT / 2 + 1).max(FIT).min(kept.len()));
        let (qd, qdd) = fit(&kept[low..high], t_s, q.len());
        moments.push(Timed { t_s, state: State { q, qd, qdd } });
    }
    moments
}

/// Speed and acceleration at `t_s` of the parabola nearest to the samples; of the line through two.
fn fit(samples: &[(f64, JointVector)], t_s: f64, dof: usize) -> (JointVector, JointVector) {
    let mut rates = (JointVector::zeros(dof), JointVector::zeros(dof));
    let longest = samples.iter().map(|(t, _)| (t - t_s).abs()).fold(0.0, f64::max);
    if !(longest > 0.0) {
        return rates;
    }
    let powers = |t: f64| {
        let tau = (t - t_s) / longest;
        Vector3::new(1.0, tau, if samples.len() > 2 { tau * tau } else { 0.0 })
    };
    let mut normal: Matrix3<f64> =
        samples.iter().map(|&(t, _)| powers(t) * powers(t).transpose()).sum();
    if samples.len() <= 2 {
        normal[(2, 2)] = 1.0;
    }
    let Some(factors) = normal.cholesky() else { return rates };
    for joint in 0..dof {
        // Differences from the first sample keep the digits of slow motions.
        let zero = samples[0].1[joint];
        let sides: Vector3<f64> = samples.iter().map(|(t, q)| powers(*t) * (q[joint] - zero)).sum();
        let law = factors.solve(&sides);
        rates.0[joint] = law[1] / longest;
        rates.1[joint] = 2.0 * law[2] / (longest * longest);
    }
    rates
}

/// Where a motion is at a time: cubic Hermite between its moments, standing still before and after.
pub fn at_time(motion: &[Timed], t_s: f64) -> Option<State> {
    let (first, last) = (motion.first()?, motion.last()?);
    if !(t_s > first.t_s) {
        return Some(State::at_rest(&first.state.q));
    }
    if t_s >= last.t_s {
        return Some(State::at_rest(&last.state.q));
    }
    let next = motion.partition_point(|moment| moment.t_s <= t_s).clamp(1, motion.len() - 1);
    let (from, to) = (&motion[next - 1], &motion[next]);
    let span = to.t_s - from.t_s;
    let u = (t_s - from.t_s) / span;
    let mut state = from.state;
    for joint in 0..state.q.len() {
        let (q0, q1) = (from.state.q[joint], to.state.q[joint]);
        let (m0, m1) = (from.state.qd[joint] * span, to.state.qd[joint] * span);
        let rise = q1 - q0;
        let (square, cube) = (3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise);
        state.q[joint] = q0 + u * (m0 + u * (square + u * cube));
        state.qd[joint] = (m0 + u * (2.0 * square + 3.0 * u * cube)) / span;
        state.qdd[joint] = (2.0 * square + 6.0 * u * cube) / (span * span);
    }
    Some(state)
}
