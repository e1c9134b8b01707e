//! What a print would measure.

use crate::process::bead::overfeed_strain;
use crate::process::cure::cure_depth_m;
use crate::process::sag::slack_sag_m;
use crate::process::{Ends, Setting, StrandInput, simulate};

use super::known::Known;

/// A print that is easily made and measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Print {
    /// A short strand that hangs from the nozzle, at the flow of the print; its diameter once set.
    FreeHang {
        /// Bore of the nozzle, m.
        nozzle_diameter_m: f64,
    },
    /// A level strand between two supports; its sag at the middle.
    Bridge(StrandInput),
    /// A level strand held where it begins; how far its end is pulled back.
    Cantilever(StrandInput),
    /// A pool of resin lit from one side; depth of what stays.
    CuredDepth {
        /// Dose at the surface, J/m².
        dose_j_m2: f64,
    },
}

/// A print and what was measured on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// What was printed.
    pub print: Print,
    /// What was measured, m.
    pub value_m: f64,
    /// Standard deviation of the measurement, spread from print to print included, m.
    pub deviation_m: f64,
}

/// What a print measures by the laws of `process`, nominal values, m.
///
/// Bridge: sag behind the nozzle, by slack and of the set strand, added; the slack's strain is that of the
/// flow less the shrinkage plus [`Known::slack`]. Cantilever: the end miss. Free hang: see [`hung_diameter_m`].
/// Swell is that of `known`, ends are those of the print, whatever the strand says. NaN where the
/// material knows no such print.
pub fn predicted_m(print: &Print, known: &Known) -> f64 {
    let printed = |strand: &StrandInput, ends| {
        simulate(&StrandInput { ends, swell: known.swell, ..*strand }, &known.material)
    };
    match print {
        Print::FreeHang { nozzle_diameter_m } => hung_diameter_m(known, *nozzle_diameter_m),
        Print::Bridge(strand) => {
            let out = printed(strand, Ends::BothHeld);
            let strain = overfeed_strain(out.draw_ratio.nominal) - out.free_strain.nominal
                + known.slack.nominal;
            out.sag_nozzle_m.nominal + slack_sag_m(strand.span_m, strain) + out.sag_set_m.nominal
        }
        Print::Cantilever(strand) => printed(strand, Ends::StartHeld).end_miss_m.nominal,
        Print::CuredDepth { dose_j_m2 } => match &known.material.setting {
            Setting::Photopolymer(resin) => cure_depth_m(
                resin.penetration_m.nominal,
                *dose_j_m2,
                resin.critical_exposure_j_m2.nominal,
            ),
            Setting::Thermoplastic(_) | Setting::TwoPart(_) => f64::NAN,
        },
    }
}

/// Diameter of a strand that hung free, once set, m: `D = B D_n (ρ_fresh / ρ_set)^⅓`.
///
/// Nothing holds its length, so what is lost is lost alike in every direction; between nozzle and node it
/// is the square root (`cold_diameter_m`). Thinning by its own weight is left out: a short strand. Ours.
fn hung_diameter_m(known: &Known, nozzle_diameter_m: f64) -> f64 {
    let material = &known.material;
    let kept = match material.setting {
        Setting::TwoPart(_) => 1.0,
        _ => material.fresh_density_kg_m3().nominal / material.density_kg_m3.nominal,
    };
    known.swell.nominal * nozzle_diameter_m * kept.cbrt()
}
