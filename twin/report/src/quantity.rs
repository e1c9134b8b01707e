//! Numbers as people read them: mm, degrees, percent, h:mm:ss.

pub(crate) use sim::finding::counted;
use sim::finding::{Bound, Code};

use crate::parts::Finding;
use crate::results::Range;

/// Unit of a number on a screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Unit {
    /// Given in m.
    Millimetre,
    /// Given in m.
    Metre,
    /// Given in rad.
    Degree,
    /// Given as a share.
    Percent,
    /// Given in kg.
    Kilogram,
    /// Given in kg.
    Gram,
    /// Given in s.
    Second,
    /// Given in N.
    Newton,
    /// A ratio.
    Plain,
}

impl Unit {
    /// What a finding of this code and SI unit is shown in.
    pub(crate) fn of(code: &str, si: &str) -> Self {
        match (code, si) {
            ("R105" | "R106" | "R108" | "E502", _) => Self::Percent,
            (_, "m") => Self::Millimetre,
            (_, "rad") => Self::Degree,
            (_, "kg") => Self::Kilogram,
            (_, "s") => Self::Second,
            (_, "N") => Self::Newton,
            _ => Self::Plain,
        }
    }

    fn scale(self) -> f64 {
        match self {
            Self::Millimetre | Self::Gram => 1e3,
            Self::Degree => 180.0 / std::f64::consts::PI,
            Self::Percent => 1e2,
            Self::Metre | Self::Kilogram | Self::Second | Self::Newton | Self::Plain => 1.0,
        }
    }

    fn sign(self) -> &'static str {
        match self {
            Self::Millimetre => " mm",
            Self::Degree => "°",
            Self::Percent => " %",
            Self::Metre => " m",
            Self::Kilogram => " kg",
            Self::Gram => " g",
            Self::Second => " s",
            Self::Newton => " N",
            Self::Plain => "",
        }
    }

    /// The number without its unit; values at the caps of `sim` have no end.
    fn bare(self, value: Option<f64>) -> String {
        let endless = match self {
            Self::Millimetre => 1e3,
            _ => 1e9,
        };
        match value {
            Some(value) if value.abs() < endless => digits(value * self.scale()),
            _ => "no end".to_owned(),
        }
    }

    /// The number with its unit.
    pub(crate) fn show(self, value: Option<f64>) -> String {
        let bare = self.bare(value);
        if bare == "no end" { bare } else { bare + self.sign() }
    }

    /// `1.20 mm (0.90 to 1.50)`; the range is left out where it is a point on the screen.
    pub(crate) fn show_range(self, range: &Range) -> String {
        let [low, high] = [self.bare(range.low), self.bare(range.high)];
        let nominal = self.show(range.value);
        if low == high { nominal } else { format!("{nominal} ({low} to {high})") }
    }
}

/// Three significant digits, at most three decimals.
pub(crate) fn digits(value: f64) -> String {
    let decimals = match value.abs() {
        size if size >= 99.95 => 0,
        size if size >= 9.995 => 1,
        size if size >= 0.0995 || size == 0.0 => 2,
        _ => 3,
    };
    let text = format!("{value:.decimals$}");
    // Rounding may leave a zero with a sign.
    let is_zero = text.starts_with('-') && text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if is_zero { text[1..].to_owned() } else { text }
}

/// h:mm:ss, to the nearest second.
pub(crate) fn clock(time_s: Option<f64>) -> String {
    let Some(time_s) = time_s else { return "?".to_owned() };
    let whole = time_s.round().max(0.0) as u64;
    format!("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60)
}

/// What was found, in numbers: [`against`] and how many places it stands for.
pub(crate) fn found(finding: &Finding) -> Option<String> {
    match (against(finding), finding.count) {
        (Some(against), 0 | 1) => Some(against),
        (Some(against), count) => Some(format!("{against}; worst of {count}")),
        (None, 0 | 1) => None,
        (None, count) => Some(format!("{count} times")),
    }
}

/// What was measured and what it was held against; `None` for things that must not happen.
pub(crate) fn against(finding: &Finding) -> Option<String> {
    let bound = Code::from_name(&finding.code).map_or(Bound::Upper, Code::bound);
    let word = match bound {
        Bound::Upper => "at most",
        Bound::Lower => "at least",
        Bound::Forbidden => return None,
    };
    let unit = Unit::of(&finding.code, &finding.unit);
    let range = Range { value: finding.measured, low: finding.low, high: finding.high };
    Some(format!("{}, {word} {}", unit.show_range(&range), unit.show(finding.limit)))
}
