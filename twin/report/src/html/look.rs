//! How each kind of trace is shown.

use sim::film::TraceOf;

use crate::plots::text::short;

/// From here on a number has no end.
const ENDLESS: f64 = 1e9;

/// How a kind of trace is shown.
pub(super) struct Look {
    of: TraceOf,
    pub(super) title: &'static str,
    pub(super) unit: &'static str,
    /// Whether the limit is a lower one, and the least value the worst.
    pub(super) lower: bool,
    pub(super) note: &'static str,
}

/// Words, unit and side of the limit of a kind of trace.
pub(super) fn look(of: TraceOf) -> Look {
    let (title, note) = match of {
        TraceOf::Speed => ("Speed of the orifice over the part", ""),
        TraceOf::Joint(_) => ("Joints, of their greatest speed", ""),
        TraceOf::Clearance => ("Clearance", "Drawn at twice the limit where nothing came nearer."),
        TraceOf::Temperature => {
            ("Temperature of the newest strand", "Mean of the section where the strand begins.")
        }
        TraceOf::Cure => ("Cure of the newest strand", "At the surface where the strand begins."),
        TraceOf::Sag => ("Sag behind the nozzle", "Of each strand, told when it is done."),
        TraceOf::Displacement => ("Displacement by weight", "Largest of the frame, staged."),
        TraceOf::Buckling => ("Buckling factor", "On the weight of the frame."),
    };
    let lower = matches!(of, TraceOf::Clearance | TraceOf::Buckling);
    Look { of, title, unit: of.unit(), lower, note }
}

impl Look {
    /// From SI to the unit shown; `None` where it has no end.
    pub(super) fn of(&self, value: f64) -> Option<f64> {
        Some(value).filter(|value| value.abs() < ENDLESS).map(|value| self.of.on_screen(value))
    }

    /// A number in the unit shown, with it.
    pub(super) fn told(&self, value: f64) -> String {
        if self.unit.is_empty() { short(value) } else { format!("{} {}", short(value), self.unit) }
    }

    /// `at most 1.00 mm`.
    pub(super) fn limit(&self, limit: f64) -> String {
        format!("{} {}", if self.lower { "at least" } else { "at most" }, self.told(limit))
    }
}
