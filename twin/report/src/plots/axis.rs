//! Axes with round ticks.

use super::text::power;

/// Narrowest axis, as a share of the greatest number on it: labels keep five digits.
const NARROWEST: f64 = 0.01;
/// More decades than this want a logarithmic axis.
const DECADES: f64 = 2.0;
/// Share of a step that rounding may cost.
const SLACK: f64 = 1e-6;
/// Most ticks of a logarithmic axis.
const LOG_TICKS: i32 = 6;

/// An axis from low to high with the ticks on it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// Whether it is logarithmic; then `low` is positive.
    pub(crate) log: bool,
    pub(crate) ticks: Vec<f64>,
    step: f64,
}

impl Axis {
    /// Over all the finite values, from round number to round number; logarithmic where they are positive
    /// and span more than two decades. About `n` ticks. Nothing to show: 0 to 1.
    pub(crate) fn round(values: impl IntoIterator<Item = f64>, n: usize) -> Self {
        let Some([least, most]) = ends(values) else { return Self::round([0.0, 1.0], n) };
        if least > 0.0 && (most / least).log10() > DECADES {
            return Self::logarithmic(least, most);
        }
        let [least, most] = widened(least, most);
        let step = round_step((most - least) / n.max(1) as f64);
        let [first, last] = [(least / step + SLACK).floor(), (most / step - SLACK).ceil()];
        Self::linear(first * step, last * step, step)
    }

    /// From zero, or less.
    pub(crate) fn from_zero(values: impl IntoIterator<Item = f64>, n: usize) -> Self {
        let values: Vec<f64> = values.into_iter().collect();
        let axis = Self::round(values.iter().copied(), n);
        if axis.log { axis } else { Self::round(values.into_iter().chain([0.0]), n) }
    }

    /// From low to high as they are, with ticks at the round numbers between them.
    pub(crate) fn within(low: f64, high: f64, n: usize) -> Self {
        let [low, high] = ends([low, high]).unwrap_or([0.0, 1.0]);
        let [low, high] = if high - low > 0.0 { [low, high] } else { widened(low, high) };
        Self::linear(low, high, round_step((high - low) / n.max(1) as f64))
    }

    /// Whole numbers from 1 to n, half a place free at either end.
    pub(crate) fn counting(n: usize) -> Self {
        let n = n.max(1) as f64;
        Self::linear(0.5, n + 0.5, round_step(n / 6.0).max(1.0))
    }

    fn linear(low: f64, high: f64, step: f64) -> Self {
        let [first, last] = [(low / step - SLACK).ceil(), (high / step + SLACK).floor()];
        let n = (last - first).clamp(0.0, 40.0) as usize;
        let ticks = (0..=n).map(|k| (first + k as f64) * step).collect();
        Self { low, high, log: false, ticks, step }
    }

    fn logarithmic(least: f64, most: f64) -> Self {
        let [first, last] = [least.log10().floor() as i32, most.log10().ceil() as i32];
        let stride = ((last - first) + LOG_TICKS - 1) / LOG_TICKS;
        let last = first + (last - first + stride - 1) / stride * stride;
        let ticks: Vec<f64> =
            (first..=last).step_by(stride as usize).map(|k| 10f64.powi(k)).collect();
        Self { low: 10f64.powi(first), high: 10f64.powi(last), log: true, ticks, step: 0.0 }
    }

    /// Where a value stands, 0 at the low end to 1 at the high end; what is beyond stands at the end.
    pub(crate) fn share(&self, value: f64) -> f64 {
        let share = match self.log {
            true => (value.max(self.low) / self.low).log10() / (self.high / self.low).log10(),
            false => (value - self.low) / (self.high - self.low),
        };
        if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }
    }

    /// A tick in digits: as many as tell it from the next.
    pub(crate) fn label(&self, tick: f64) -> String {
        let size = self.low.abs().max(self.high.abs());
        if tick == 0.0 {
            return "0".to_owned();
        }
        if self.log {
            return match tick {
                tick if (9e-4..2e4).contains(&tick) => format!("{}", (tick * 1e3).round() / 1e3),
                _ => power(tick, 0),
            };
        }
        let place = (self.step * (1.0 + 1e-9)).log10().floor();
        if (1e-3..1e5).contains(&size) && place >= -4.0 {
            return format!("{tick:.*}", (-place).clamp(0.0, 4.0) as usize);
        }
        let digits = tick.abs().log10().floor() - place;
        power(tick, digits.clamp(0.0, 4.0) as usize)
    }
}

/// Least and greatest of the finite values.
pub(crate) fn ends(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    values.into_iter().filter(|value| value.is_finite()).fold(
        None,
        |ends: Option<[f64; 2]>, value| {
            let [least, most] = ends.unwrap_or([value, value]);
            Some([value.min(least), value.max(most)])
        },
    )
}

/// An axis needs a length, and its labels must differ.
fn widened(least: f64, most: f64) -> [f64; 2] {
    let size = least.abs().max(most.abs());
    let lacking = (NARROWEST * size - (most - least)).max(0.0);
    match size > 0.0 {
        true => [least - 0.5 * lacking, most + 0.5 * lacking],
        false => [0.0, 1.0],
    }
}

/// 1, 2 or 5 times a power of ten, not less than what is asked.
fn round_step(least: f64) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    let times = least / power * (1.0 - 1e-9);
    let times = [1.0, 2.0, 5.0].into_iter().find(|&round| times <= round).unwrap_or(10.0);
    let step = times * power;
    if step.is_finite() && step > 0.0 { step } else { 1.0 }
}
