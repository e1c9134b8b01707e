//! A number that is not known exactly.

/// Nominal value with the low and high end of what it may be; `low <= nominal <= high`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// What is expected.
    pub nominal: f64,
    /// Low end.
    pub low: f64,
    /// High end.
    pub high: f64,
}

impl Interval {
    /// A number without doubt.
    pub const fn exact(value: f64) -> Self {
        Self { nominal: value, low: value, high: value }
    }

    /// Nominal, and the ends in either order; the nominal is always inside.
    pub fn new(nominal: f64, one: f64, other: f64) -> Self {
        Self { nominal, low: one.min(other).min(nominal), high: one.max(other).max(nominal) }
    }

    /// The same law on nominal, low and high; `law` must be monotone for the ends to be ends.
    #[must_use]
    pub fn map(self, law: impl Fn(f64) -> f64) -> Self {
        Self::new(law(self.nominal), law(self.low), law(self.high))
    }

    /// Sum, ends added to ends.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            nominal: self.nominal + other.nominal,
            low: self.low + other.low,
            high: self.high + other.high,
        }
    }

    /// Both ends and the nominal times a factor.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        self.map(|value| value * factor)
    }
}
