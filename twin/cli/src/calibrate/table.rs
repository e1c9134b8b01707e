//! What was fitted, for a person.

use sim::calibration::{Fitted, MISFIT_SIGMAS, Parameter, Print};
use sim::interval::Interval;
use sim::process::bead::drawn_diameter_m;
use sim::process::{Setting, StrandInput};

use super::Calibrated;
use crate::refusal::Failure;
use crate::screen::Screen;

pub(super) fn print(done: &Calibrated, screen: &mut Screen<'_>) -> Result<(), Failure> {
    let name = crate::names::clipped(&done.fit.known.material.name);
    writeln!(screen.out, "{name}: {} measured prints\n", done.prints.len())?;
    for line in lines(done) {
        writeln!(screen.out, "{line}")?;
    }
    Ok(())
}

/// Parameters, residuals and the next print, one line each.
pub(super) fn lines(done: &Calibrated) -> Vec<String> {
    let fit = &done.fit;
    let setting = &fit.known.material.setting;
    let mut lines = vec![format!(
        "{:<28} {:>24} {:>10} {:>18} {:>11}",
        "number", "before", "fitted", "90 % interval", "doubt left"
    )];
    lines.extend(fit.parameters.iter().map(|it| number(it, setting)));
    lines.push(String::new());
    lines.push(format!("{:<44} {:>17} {:>12} {:>8}", "print", "measured", "fitted", "off"));
    for (measured, it) in done.prints.iter().zip(&fit.residuals) {
        let told = if it.fits { "" } else { "  DOES NOT FIT" };
        lines.push(format!(
            "{:<44} {:>17} {:>12} {:>8}{told}",
            words(&measured.print),
            format!("{:.3} ± {:.3} mm", measured.value_m * 1e3, measured.deviation_m * 1e3),
            format!("{:.3} mm", it.predicted_m * 1e3),
            format!("{:+.1} sd", it.sigmas),
        ));
    }
    let informed = fit.parameters.iter().filter(|it| it.informed).count();
    lines.push(format!(
        "chi2 {:.1} of {} prints for {informed} numbers; past {MISFIT_SIGMAS} sd a print does not fit",
        fit.chi2,
        done.prints.len()
    ));
    if !fit.arrived {
        lines.push(
            "the search did not arrive: look at the prints before using these numbers".into(),
        );
    }
    lines.push(String::new());
    lines.push(match &fit.next {
        None => "next print: none of the usual ones would tell more".to_owned(),
        Some(next) => format!(
            "next print: {}, {:.3} mm expected; doubt in {} from {:.0} % to {:.0} %",
            words(&next.print),
            next.predicted_m * 1e3,
            name(next.helps, setting),
            next.doubt_now * 100.0,
            next.doubt_then * 100.0
        ),
    });
    lines.extend(for_the_cell(done));
    lines
}

/// What a material's file has no place for.
fn for_the_cell(done: &Calibrated) -> Vec<String> {
    let told = |parameter, text: &str| {
        let it = done.fit.parameters.iter().find(|it| it.parameter == parameter && it.informed)?;
        let Interval { nominal, low, high } = it.after;
        Some(text.replace("{}", &format!("[{nominal:.4}, {low:.4}, {high:.4}]")))
    };
    let swell = told(Parameter::Swell, "for [extruder] of the cell: swell = {}");
    let slack = told(Parameter::Slack, "for the next file of prints: slack = {}");
    swell.into_iter().chain(slack).collect()
}

fn number(it: &Fitted, setting: &Setting) -> String {
    let (scale, digits) = scale(it.parameter, setting);
    let text = |value: f64| format!("{:.digits$}", value * scale);
    let span = |of: Interval| format!("{}..{}", text(of.low), text(of.high));
    let before = format!("{} ({})", text(it.before.nominal), span(it.before));
    let name = name(it.parameter, setting);
    if !it.informed {
        return format!("{name:<28} {before:>24} not informed by these prints");
    }
    let told = if it.past_range { "  past its range" } else { "" };
    format!(
        "{name:<28} {before:>24} {:>10} {:>18} {:>9.0} %{told}",
        text(it.after.nominal),
        span(it.after),
        it.doubt_left * 100.0
    )
}

fn name(parameter: Parameter, setting: &Setting) -> &'static str {
    match (parameter, setting) {
        (Parameter::Viscosity, Setting::TwoPart(_)) => "viscosity, Pa s",
        (Parameter::Viscosity, _) => "viscosity-cooling lump",
        (Parameter::Slack, _) => "slack, %",
        (Parameter::Shrinkage, Setting::Thermoplastic(_)) => "expansion, 1e-6/K",
        (Parameter::Shrinkage, _) => "linear shrinkage, %",
        (Parameter::Penetration, _) => "penetration depth, mm",
        (Parameter::CriticalExposure, _) => "critical exposure, mJ/cm2",
        (Parameter::Swell, _) => "swell",
    }
}

/// Unit of the table over SI, and digits behind the point.
fn scale(parameter: Parameter, setting: &Setting) -> (f64, usize) {
    match (parameter, setting) {
        (Parameter::Viscosity, Setting::TwoPart(_)) => (1.0, 1),
        (Parameter::Viscosity, _) => (1.0, 2),
        (Parameter::Slack, _) => (100.0, 3),
        (Parameter::Shrinkage, Setting::Thermoplastic(_)) => (1e6, 1),
        (Parameter::Shrinkage, _) => (100.0, 2),
        (Parameter::Penetration, _) => (1e3, 3),
        (Parameter::CriticalExposure, _) => (0.1, 2),
        (Parameter::Swell, _) => (1.0, 3),
    }
}

/// A print in words.
fn words(print: &Print) -> String {
    let strand = |kind: &str, it: &StrandInput| {
        format!(
            "{kind} {:.0} mm, {:.1} mm/s, bead {:.2} mm",
            it.span_m * 1e3,
            it.speed_m_s * 1e3,
            drawn_diameter_m(it.flow_m3_s, it.speed_m_s) * 1e3
        )
    };
    match print {
        Print::FreeHang { nozzle_diameter_m } => {
            format!("free hang, nozzle {:.2} mm", nozzle_diameter_m * 1e3)
        }
        Print::Bridge(it) => strand("bridge", it),
        Print::Cantilever(it) => strand("cantilever", it),
        Print::CuredDepth { dose_j_m2 } => format!("cured depth, {:.1} mJ/cm2", dose_j_m2 / 10.0),
    }
}
