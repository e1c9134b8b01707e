//! The laws against what others measured, printed or set as a default.
//!
//! One file to a topic, one [`Case`] to a source; `twin validate` prints them. What a source says is
//! typed here with its place; what we say is computed by the laws of `process`, and the mechanics of
//! `structure` where a source tested a frame, with the materials of the library. A number outside its
//! band carries a written reason.

use crate::interval::Interval;
use crate::process::{LightRing, Material};

mod bead;
mod cure;
mod exact;
mod exact_heat;
mod heat;
mod program;
mod sag;
mod sag_table;
mod shrinkage;
mod slam_beam;
mod strand;
mod strength;
#[cfg(test)]
mod tests;

/// What a case may use of the library; nothing of it is typed in here.
#[derive(Debug, Clone, Copy)]
pub struct Library<'a> {
    /// `materials/abs`.
    pub abs: &'a Material,
    /// `materials/pla`.
    pub pla: &'a Material,
    /// `materials/pla-carbon`.
    pub pla_carbon: &'a Material,
    /// `materials/sla-resin-silica`.
    pub resin: &'a Material,
    /// `materials/two-part-acrylic`.
    pub two_part: &'a Material,
    /// The ring of lamps of the nozzle after Kirkman et al.; `None` where its file has none.
    pub ring: Option<LightRing>,
    /// How far a finished frame may give way in the cell that prints polymer in air, m.
    pub deflection_m: f64,
}

/// Where the numbers of a case come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Measured and published, often read as an abstract.
    Published,
    /// One of the papers the project began with.
    Paper,
    /// A default of an existing tool, found by trying.
    Practice,
    /// A table of `process-physics.md`, computed there with other material values.
    Reference,
    /// A closed form or a converged number; a test holds it too.
    Exact,
}

/// One source and what we make of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Its name in `process_validation_cases.json`; of our own making for [`Kind::Reference`].
    pub id: &'static str,
    /// What kind of source.
    pub kind: Kind,
    /// What it is about.
    pub title: &'static str,
    /// Where it is printed.
    pub source: &'static str,
    /// What is compared.
    pub checks: Vec<Check>,
    /// What the agreement is worth: what was assumed, what is not independent. May be empty.
    pub note: String,
}

/// One comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// What is compared.
    pub what: String,
    /// The two sides.
    pub sides: Sides,
    /// Why we are outside; empty where we are not.
    pub why: String,
}

/// The two sides of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub enum Sides {
    /// A number of ours against a band of theirs. Inside is by the nominal value alone.
    Band {
        /// Low end of theirs, tolerance taken in.
        low: f64,
        /// High end of theirs.
        high: f64,
        /// Ours, with the range of its inputs.
        ours: Interval,
        /// Unit of both.
        unit: &'static str,
    },
    /// Something that is so or not: an order, a sign, a range inside another.
    Words {
        /// What they say.
        theirs: String,
        /// What we get.
        ours: String,
        /// Whether it is the same.
        holds: bool,
    },
    /// Nothing of ours stands against it.
    Missing {
        /// What they say.
        theirs: String,
        /// What is missing.
        why: String,
    },
}

/// What a case came to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// All that can be compared is inside.
    Inside,
    /// Something is outside, for these reasons; empty: nobody knows why yet.
    Outside(String),
    /// Nothing can be compared, for these reasons.
    NotComparable(String),
}

impl Check {
    /// A number of ours against the band `low..high` of theirs.
    pub fn band(
        what: impl Into<String>,
        unit: &'static str,
        theirs: [f64; 2],
        ours: Interval,
    ) -> Self {
        let sides = Sides::Band { low: theirs[0], high: theirs[1], ours, unit };
        Self { what: what.into(), sides, why: String::new() }
    }

    /// Something that is so or not.
    pub fn words(
        what: impl Into<String>,
        theirs: impl Into<String>,
        ours: impl Into<String>,
        holds: bool,
    ) -> Self {
        let sides = Sides::Words { theirs: theirs.into(), ours: ours.into(), holds };
        Self { what: what.into(), sides, why: String::new() }
    }

    /// Something that nothing of ours stands against.
    pub fn missing(
        what: impl Into<String>,
        theirs: impl Into<String>,
        why: impl Into<String>,
    ) -> Self {
        let sides = Sides::Missing { theirs: theirs.into(), why: why.into() };
        Self { what: what.into(), sides, why: String::new() }
    }

    /// The same, with the reason why it is outside.
    #[must_use]
    pub fn outside(self, why: impl Into<String>) -> Self {
        Self { why: why.into(), ..self }
    }

    /// Whether ours is inside theirs; `None` where there is nothing to compare.
    pub fn holds(&self) -> Option<bool> {
        match &self.sides {
            Sides::Band { low, high, ours, .. } => Some((*low..=*high).contains(&ours.nominal)),
            Sides::Words { holds, .. } => Some(*holds),
            Sides::Missing { .. } => None,
        }
    }

    /// Their side, for a table.
    pub fn theirs(&self) -> String {
        match &self.sides {
            Sides::Band { low, high, unit, .. } => {
                spaced(format!("{} to {}", number(*low), number(*high)), unit)
            }
            Sides::Words { theirs, .. } | Sides::Missing { theirs, .. } => theirs.clone(),
        }
    }

    /// Our side, for a table.
    pub fn ours(&self) -> String {
        match &self.sides {
            Sides::Band { ours, unit, .. } if ours.low == ours.high => {
                spaced(number(ours.nominal), unit)
            }
            Sides::Band { ours, unit, .. } => {
                let ends = format!("({} to {})", number(ours.low), number(ours.high));
                format!("{} {ends}", spaced(number(ours.nominal), unit))
            }
            Sides::Words { ours, .. } => ours.clone(),
            Sides::Missing { .. } => "nothing to compare".to_owned(),
        }
    }
}

impl Case {
    /// What the case came to: outside if one check is, not comparable if none can be compared.
    pub fn verdict(&self) -> Verdict {
        let failed: Vec<&Check> =
            self.checks.iter().filter(|check| check.holds() == Some(false)).collect();
        if !failed.is_empty() {
            // one that says nothing leaves the whole unexplained
            let silent = failed.iter().any(|check| check.why.is_empty());
            let mut reasons: Vec<&str> = failed.iter().map(|check| check.why.as_str()).collect();
            reasons.dedup();
            return Verdict::Outside(if silent { String::new() } else { reasons.join("; ") });
        }
        if self.checks.iter().any(|check| check.holds().is_some()) {
            return Verdict::Inside;
        }
        let missing = |check: &Check| match &check.sides {
            Sides::Missing { why, .. } => Some(why.clone()),
            _ => None,
        };
        let mut reasons: Vec<String> = self.checks.iter().filter_map(missing).collect();
        reasons.dedup();
        Verdict::NotComparable(reasons.join("; "))
    }

    /// Whether the case is inside, or says why not.
    pub fn is_explained(&self) -> bool {
        match self.verdict() {
            Verdict::Inside => true,
            Verdict::Outside(why) | Verdict::NotComparable(why) => !why.is_empty(),
        }
    }
}

/// All published, paper, practice and reference cases, topic by topic.
///
/// Deterministic; under a second, nearly all of it the frames of `slam_beam`.
pub fn cases(library: &Library<'_>) -> Vec<Case> {
    let topics = [
        heat::cases,
        sag::cases,
        sag_table::cases,
        bead::cases,
        cure::cases,
        shrinkage::cases,
        slam_beam::cases,
        strength::cases,
        program::cases,
    ];
    topics.iter().flat_map(|topic| topic(library)).collect()
}

/// The closed forms and converged numbers that the laws are tested against, those that one call settles.
pub fn exact_cases() -> Vec<Case> {
    exact::cases()
}

/// Three significant digits, whole numbers as they are.
pub(crate) fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let decimals = (2.0 - value.abs().log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

fn spaced(number: String, unit: &str) -> String {
    if unit.is_empty() { number } else { format!("{number} {unit}") }
}
