//! Text and numbers for a page: nothing of a job's text is ever markup.

pub(crate) use crate::quantity::counted;
use crate::quantity::digits;
use crate::results::Range;

/// Longest id told, characters.
pub(crate) const LONGEST_ID: usize = 60;
/// Longest sentence told, characters.
pub(crate) const LONGEST_SENTENCE: usize = 400;
/// From here on, in the unit of a plot, a number has no end: `sim` caps what never comes to rest.
const ENDLESS: f64 = 1e9;
/// Smaller than this, in the unit of a plot, is zero.
const NOTHING: f64 = 1e-9;

/// Text as XML wants it, clipped and [`cleaned`].
pub(crate) fn escaped(text: &str, longest: usize) -> String {
    let mut out = String::with_capacity(text.len().min(longest) + 8);
    for c in cleaned(text, longest).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c => out.push(c),
        }
    }
    out
}

/// Text clipped; control characters, those that turn the direction of writing and those that XML has not become
/// U+FFFD. Not markup yet.
pub(crate) fn cleaned(text: &str, longest: usize) -> String {
    let bad = |c: char| c.is_control() || turns(c) || matches!(c, '\u{fffe}' | '\u{ffff}');
    let shown = text.chars().take(longest).map(|c| if bad(c) { '\u{fffd}' } else { c });
    let more = text.chars().nth(longest).map(|_| '…');
    shown.chain(more).collect()
}

/// Marks that turn the direction of writing, or break lines where no line feed stands.
fn turns(c: char) -> bool {
    matches!(c, '\u{200e}' | '\u{200f}' | '\u{feff}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Unit of a plot and what a number in SI is multiplied with to be in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scale {
    /// As written behind a number, without a space; empty for a ratio.
    pub(crate) sign: &'static str,
    factor: f64,
    /// SI values from here on have no end.
    endless: f64,
}

impl Scale {
    /// From m.
    pub(crate) const MILLIMETRE: Self = Self { sign: "mm", factor: 1e3, endless: 1e3 };
    /// From m/s.
    pub(crate) const MILLIMETRE_PER_S: Self = Self { sign: "mm/s", factor: 1e3, endless: 1e6 };
    /// From s.
    pub(crate) const SECOND: Self = Self { sign: "s", factor: 1.0, endless: ENDLESS };
    /// From N.
    pub(crate) const NEWTON: Self = Self { sign: "N", factor: 1.0, endless: ENDLESS };
    /// From a share.
    pub(crate) const PERCENT: Self = Self { sign: "%", factor: 1e2, endless: 1e6 };
    /// From Pa.
    pub(crate) const MEGAPASCAL: Self = Self { sign: "MPa", factor: 1e-6, endless: 1e15 };
    /// A ratio.
    pub(crate) const PLAIN: Self = Self { sign: "", factor: 1.0, endless: ENDLESS };

    /// In this unit; `None` where it has no end or is no number.
    pub(crate) fn of(self, value: Option<f64>) -> Option<f64> {
        let value = value.filter(|value| value.abs() < self.endless)? * self.factor;
        Some(if value.abs() < NOTHING { 0.0 } else { value })
    }

    /// Nominal, low and high in this unit.
    pub(crate) fn of_range(self, range: &Range) -> [Option<f64>; 3] {
        [range.value, range.low, range.high].map(|value| self.of(value))
    }

    /// What stands at an axis.
    pub(crate) fn axis_name(self) -> &'static str {
        if self.sign.is_empty() { "ratio" } else { self.sign }
    }

    /// A number already in this unit, with it.
    pub(crate) fn with_sign(self, value: f64) -> String {
        let bare = self.bare(value);
        if self.sign.is_empty() { bare } else { format!("{bare} {}", self.sign) }
    }

    /// A number already in this unit; less than a micrometre is told in words.
    fn bare(self, value: f64) -> String {
        match value != 0.0 && value.abs() < 9.5e-4 && self.sign == "mm" {
            true => "below 0.001".to_owned(),
            false => short(value),
        }
    }

    /// `1.20 mm`.
    pub(crate) fn show(self, value: Option<f64>) -> String {
        self.of(value).map_or_else(|| "no end".to_owned(), |value| self.with_sign(value))
    }

    /// `1.20 mm (0.90 to 1.50)`; the range is left out where it is a point on the page.
    pub(crate) fn show_range(self, range: &Range) -> String {
        let end =
            |value| self.of(value).map_or_else(|| "no end".to_owned(), |value| self.bare(value));
        let [low, high] = [end(range.low), end(range.high)];
        let nominal = self.show(range.value);
        if low == high { nominal } else { format!("{nominal} ({low} to {high})") }
    }
}

/// Three significant digits; powers of ten where there would be more than five.
pub(crate) fn short(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if (9.5e-4..99_999.5).contains(&size) => digits(value),
        size if size.is_finite() => power(value, 1),
        _ => "no end".to_owned(),
    }
}

/// `2.5·10⁻⁵`.
pub(crate) fn power(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$e}");
    let Some((mantissa, exponent)) = text.split_once('e') else { return text };
    let mantissa = if mantissa.contains('.') {
        mantissa.trim_end_matches('0').trim_end_matches('.')
    } else {
        mantissa
    };
    let raised: String = exponent
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            c => c.to_digit(10).map_or(c, |d| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(d as usize).unwrap_or(c)),
        })
        .collect();
    match mantissa {
        "1" => format!("10{raised}"),
        "-1" => format!("-10{raised}"),
        _ => format!("{mantissa}·10{raised}"),
    }
}
