//! What strands can be coloured by.

use super::FilmStrand;
use crate::cell::Job;
use crate::process::Setting;
use crate::scene::ColourScale;

/// A number of a place on a strand, at a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// Sag behind the nozzle, m.
    Sag,
    /// Place in the printing order, 1 is the first.
    Order,
    /// Time since it was laid, s.
    Age,
    /// Mean temperature of the section, K.
    Temperature,
    /// Degree of cure at the surface.
    Cure,
    /// Diameter of the bead as drawn, m.
    BeadWidth,
    /// Displacement by the frame's weight once all is printed, staged, m.
    Displacement,
    /// Largest share of its strength that a member used while the print grew.
    Utilisation,
    /// Least clearance while it is printed, m.
    Clearance,
    /// Speed of the orifice, m/s.
    Speed,
}

/// A quantity that a film has, and the scale of its colours in the units of a screen.
#[derive(Debug, Clone, PartialEq)]
pub struct Painted {
    /// The quantity.
    pub quantity: Quantity,
    /// What the colours mean.
    pub scale: ColourScale,
}

impl Quantity {
    /// All of them, the usual one first.
    pub const ALL: [Self; 10] = [
        Self::Sag,
        Self::Order,
        Self::Age,
        Self::Temperature,
        Self::Cure,
        Self::BeadWidth,
        Self::Displacement,
        Self::Utilisation,
        Self::Clearance,
        Self::Speed,
    ];

    /// A word for command lines and links.
    pub fn word(self) -> &'static str {
        match self {
            Self::Sag => "sag",
            Self::Order => "order",
            Self::Age => "age",
            Self::Temperature => "temperature",
            Self::Cure => "cure",
            Self::BeadWidth => "bead",
            Self::Displacement => "displacement",
            Self::Utilisation => "utilisation",
            Self::Clearance => "clearance",
            Self::Speed => "speed",
        }
    }

    /// Heading of a legend.
    pub fn title(self) -> &'static str {
        match self {
            Self::Sag => "sag behind the nozzle",
            Self::Order => "printing order",
            Self::Age => "age",
            Self::Temperature => "mean temperature",
            Self::Cure => "degree of cure",
            Self::BeadWidth => "bead as drawn",
            Self::Displacement => "displacement by weight",
            Self::Utilisation => "strength used at most while it grew",
            Self::Clearance => "least clearance while printed",
            Self::Speed => "speed of the nozzle",
        }
    }

    /// Unit on a screen.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Sag | Self::BeadWidth | Self::Displacement | Self::Clearance => "mm",
            Self::Order => "",
            Self::Age => "s",
            Self::Temperature => "°C",
            Self::Cure | Self::Utilisation => "%",
            Self::Speed => "mm/s",
        }
    }

    /// A value in SI as it stands on a screen.
    pub fn on_screen(self, value: f64) -> f64 {
        match self {
            Self::Sag | Self::BeadWidth | Self::Displacement | Self::Clearance | Self::Speed => {
                value * 1e3
            }
            Self::Order | Self::Age => value,
            Self::Temperature => value - 273.15,
            Self::Cure | Self::Utilisation => value * 100.0,
        }
    }

    /// Whether it changes while the strand lies there.
    pub fn changes_with_time(self) -> bool {
        matches!(self, Self::Age | Self::Temperature | Self::Cure)
    }
}

/// The quantities of which anything is known, with scales over all strands and times.
pub(super) fn painted(job: &Job, strands: &[FilmStrand], total_s: f64) -> Vec<Painted> {
    Quantity::ALL
        .into_iter()
        .filter_map(|quantity| scale(job, strands, total_s, quantity))
        .collect()
}

fn scale(job: &Job, strands: &[FilmStrand], total_s: f64, quantity: Quantity) -> Option<Painted> {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut take = |value: f64| {
        if value.is_finite() {
            (low, high) = (low.min(value), high.max(value));
        }
    };
    for (order, strand) in strands.iter().enumerate() {
        match quantity {
            Quantity::Temperature => strand.ageing.temperature_k.iter().for_each(|&k| take(k)),
            Quantity::Cure => strand.ageing.cure.iter().for_each(|&cure| take(cure)),
            Quantity::Age => strand.time_s.iter().for_each(|&born_s| take(total_s - born_s)),
            _ => (0..strand.segments())
                .filter_map(|k| strand.value(order, k, quantity, total_s))
                .for_each(&mut take),
        }
    }
    let is_thermoplastic = matches!(job.material.setting, Setting::Thermoplastic(_));
    if !(low <= high) || (quantity == Quantity::Temperature && !is_thermoplastic) {
        return None;
    }
    let limits = &job.limits;
    let limit = match quantity {
        Quantity::Sag => Some(limits.sag_m),
        Quantity::Clearance => Some(limits.clearance_m),
        Quantity::Displacement => Some(limits.node_miss_m),
        Quantity::Utilisation => Some(1.0),
        _ => None,
    };
    let (low, high) = match quantity {
        // one finding far off must not make all else one colour
        Quantity::Sag => (0.0, high.clamp(0.1 * limits.sag_m, 2.0 * limits.sag_m)),
        Quantity::Clearance => (low.max(-limits.clearance_m).min(0.0), 2.0 * limits.clearance_m),
        Quantity::Utilisation => (0.0, high.clamp(0.01, 1.5)),
        Quantity::Displacement | Quantity::Age | Quantity::Cure => (0.0, high),
        // what is even must look even
        Quantity::Speed | Quantity::BeadWidth => (low.min(0.8 * high), high),
        _ => (low, high),
    };
    let [low, high] = [low, high].map(|value| quantity.on_screen(value));
    let scale = ColourScale {
        title: quantity.title().to_owned(),
        unit: quantity.unit().to_owned(),
        low,
        high: if high > low { high } else { low + low.abs().max(1.0) * 1e-3 },
        limit: limit.map(|limit| quantity.on_screen(limit)),
    };
    Some(Painted { quantity, scale })
}
