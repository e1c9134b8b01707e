//! The material with what was fitted, as the text of a file.

use sim::calibration::{Fitted, Parameter};
use sim::process::Setting;
use slam::Source;
use slam::material_file::{self, Change, rewritten};

use super::{Calibrated, table};
use crate::names::clipped;
use crate::refusal::Refusal;

/// The material's text with the fitted numbers in it, and above it how they came about.
///
/// # Errors
/// Where the text written would not read back.
pub(super) fn material(done: &Calibrated) -> Result<String, Refusal> {
    let from = clipped(&done.measured.name);
    let changes: Vec<Change> =
        done.fit.parameters.iter().filter_map(|it| change(it, done, &from)).collect();
    let broken = || {
        Refusal::whole(&done.material.name, "the fitted numbers make no material")
            .hint("a print is far from what the material can do; see the table")
    };
    let text = rewritten(&done.material, &changes).ok_or_else(broken)?;
    let mut whole = format!("# Fitted by `twin calibrate` to the prints of {from}:\n#\n");
    for line in table::lines(done) {
        let line = format!("# {line}");
        whole.push_str(line.trim_end());
        whole.push('\n');
    }
    whole.push_str("#\n");
    whole.push_str(&text);
    let written = Source::new(&done.material.name, whole);
    match material_file::parse(&written) {
        Ok(_) => Ok(written.text),
        Err(problems) => Err(broken().hint(problems[0].message.clone())),
    }
}

/// What a fitted number changes in the material's text; nothing where it is not the material's or not informed.
fn change(it: &Fitted, done: &Calibrated, from: &str) -> Option<Change> {
    if !it.informed {
        return None;
    }
    let after = it.after;
    let range = vec![("value", after.nominal), ("low", after.low), ("high", after.high)];
    let (table, numbers) = match (it.parameter, &done.fit.known.material.setting) {
        (Parameter::Viscosity, Setting::Thermoplastic(plastic)) => (
            vec!["setting", "thermoplastic", "viscosity"],
            vec![
                ("d1_pa_s", plastic.viscosity.d1_pa_s * after.nominal),
                ("factor_low", after.low / after.nominal),
                ("factor_high", after.high / after.nominal),
            ],
        ),
        (Parameter::Viscosity, _) => (vec!["setting", "two-part", "viscosity_pa_s"], range),
        (Parameter::Shrinkage, Setting::Thermoplastic(_)) => (vec!["cte_per_k"], range),
        (Parameter::Shrinkage, Setting::Photopolymer(_)) => {
            (vec!["setting", "photopolymer", "linear_shrinkage"], range)
        }
        (Parameter::Shrinkage, Setting::TwoPart(_)) => {
            (vec!["setting", "two-part", "linear_shrinkage"], range)
        }
        (Parameter::Penetration, _) => (vec!["setting", "photopolymer", "penetration_m"], range),
        (Parameter::CriticalExposure, _) => {
            (vec!["setting", "photopolymer", "critical_exposure_j_m2"], range)
        }
        (Parameter::Slack | Parameter::Swell, _) => return None,
    };
    Some(Change { table, numbers, source: format!("twin calibrate of {from}") })
}
