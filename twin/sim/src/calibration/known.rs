//! The numbers that can be calibrated, and where they live.

use crate::interval::Interval;
use crate::process::{Material, Setting};

/// A number that measured prints can tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Parameter {
    /// Viscosity and cooling as one lump: sag goes with `τ⁵/η`, so a bridge cannot tell them apart.
    /// Thermoplastic: true viscosity over the fit's. Two-part: viscosity, Pa s.
    Viscosity,
    /// Strain by which a held strand is longer than flow and shrinkage say.
    Slack,
    /// Thermoplastic: linear expansion, 1/K. Resins: linear shrinkage after the gel point.
    Shrinkage,
    /// Penetration depth of the light, m.
    Penetration,
    /// Critical exposure, J/m².
    CriticalExposure,
    /// Diameter of a free strand over that of the bore.
    Swell,
}

impl Parameter {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Viscosity,
        Self::Slack,
        Self::Shrinkage,
        Self::Penetration,
        Self::CriticalExposure,
        Self::Swell,
    ];
}

/// What is known of material and extruder, each number with its range.
#[derive(Debug, Clone, PartialEq)]
pub struct Known {
    /// The material.
    pub material: Material,
    /// Diameter of a free strand over that of the bore.
    pub swell: Interval,
    /// Strain by which a held strand is longer than flow and shrinkage say.
    pub slack: Interval,
}

impl Known {
    /// A parameter; `None` where the material has no such number.
    pub fn get(&self, parameter: Parameter) -> Option<Interval> {
        // `place` wants to write; the copy is a handful of numbers and a name.
        self.clone().place(parameter).copied()
    }

    /// The same with another number; unchanged where the material has none such.
    #[must_use]
    pub fn with(mut self, parameter: Parameter, number: Interval) -> Self {
        if let Some(place) = self.place(parameter) {
            *place = number;
        }
        self
    }

    fn place(&mut self, parameter: Parameter) -> Option<&mut Interval> {
        let material = &mut self.material;
        match (parameter, &mut material.setting) {
            (Parameter::Slack, _) => Some(&mut self.slack),
            (Parameter::Swell, _) => Some(&mut self.swell),
            (Parameter::Viscosity, Setting::Thermoplastic(it)) => Some(&mut it.viscosity.factor),
            (Parameter::Viscosity, Setting::TwoPart(it)) => Some(&mut it.viscosity_pa_s),
            (Parameter::Shrinkage, Setting::Thermoplastic(_)) => Some(&mut material.cte_per_k),
            (Parameter::Shrinkage, Setting::Photopolymer(it)) => Some(&mut it.linear_shrinkage),
            (Parameter::Shrinkage, Setting::TwoPart(it)) => Some(&mut it.linear_shrinkage),
            (Parameter::Penetration, Setting::Photopolymer(it)) => Some(&mut it.penetration_m),
            (Parameter::CriticalExposure, Setting::Photopolymer(it)) => {
                Some(&mut it.critical_exposure_j_m2)
            }
            _ => None,
        }
    }
}
