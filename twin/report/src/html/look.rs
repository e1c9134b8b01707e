//! How each kind of trace is shown.

use sim::film::TraceOf;

use crate::plots::text::short;

/// From here on a number has no end.
const ENDLESS: f64 = 1e9;

/// How a kind of trace is shown.
pub(super) struct Look {
    pub(super) title: &'static str,
    pub(super) unit: &'static str,
    factor: f64,
    offset: f64,
    /// Whether the limit is a lower one, and the least value the worst.
    pub(super) lower: bool,
    pub(super) note: &'static str,
}

/// Words, unit and side of the limit of a kind of trace.
pub(super) fn look(of: TraceOf) -> Look {
    let plain =
        |title, unit, factor, note| Look { title, unit, factor, offset: 0.0, lower: false, note };
    match of {
        TraceOf::Speed => plain("Speed of the orifice over the part", "mm/s", 1e3, ""),
        TraceOf::Joint(_) => plain("Joints, of their greatest speed", "%", 1e2, ""),
        TraceOf::Clearance => Look {
            lower: true,
            ..plain("Clearance", "mm", 1e3, "Drawn at twice the limit where nothing came nearer.")
        },
        TraceOf::Temperature => Look {
            offset: -273.15,
            ..plain(
                "Temperature of the newest strand",
                "°C",
                1.0,
                "Mean of the section where the strand begins.",
            )
        },
        TraceOf::Cure => {
            plain("Cure of the newest strand", "%", 1e2, "At the surface where the strand begins.")
        }
        TraceOf::Sag => {
            plain("Sag behind the nozzle", "mm", 1e3, "Of each strand, told when it is done.")
        }
        TraceOf::Displacement => {
            plain("Displacement by weight", "mm", 1e3, "Largest of the frame, staged.")
        }
        TraceOf::Buckling => {
            Look { lower: true, ..plain("Buckling factor", "", 1.0, "On the weight of the frame.") }
        }
    }
}

impl Look {
    /// From SI to the unit shown; `None` where it has no end.
    pub(super) fn of(&self, value: f64) -> Option<f64> {
        Some(value)
            .filter(|value| value.abs() < ENDLESS)
            .map(|value| value * self.factor + self.offset)
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
