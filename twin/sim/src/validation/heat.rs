//! Cooling of a strand.

use super::strand::{melt, strand};
use super::{Case, Check, Kind, Library};
use crate::interval::Interval;
use crate::process::Material;
use crate::process::history::Corner;
use crate::process::sag::Fluidity;
use crate::process::thermal::cooling;

pub(super) fn cases(library: &Library<'_>) -> Vec<Case> {
    vec![seppala_migler(library.abs), flow_stop_pla(library.pla)]
}

fn seppala_migler(abs: &Material) -> Case {
    let input = strand(0.3e-3, 0.03, 1.0, 0.0);
    let (mut time_s, mut above_k) = (Interval::exact(f64::NAN), f64::NAN);
    if let Some(plastic) = melt(abs) {
        let glass_k = plastic.glass_k.nominal;
        above_k = plastic.extrusion_k.nominal - glass_k;
        time_s =
            Corner::interval(|corner| cooling(&input, abs, plastic, corner).time_to_s(glass_k));
    }
    Case {
        id: "SEPPALA-MIGLER",
        kind: Kind::Published,
        title: "ABS weld line: cooling rate, time above the glass transition",
        source: "Seppala & Migler 2016, Addit. Manuf. 12:71 (abstract)",
        checks: vec![
            Check::band("time above Tg", "s", [0.5, 2.0], time_s),
            Check::band("mean cooling rate down to Tg", "K/s", [50.0, 200.0], time_s.map(|t| above_k / t)),
        ],
        note: "theirs within a factor 2, a layer of 0.3 mm on plastic; ours a 0.3 mm strand in still air: \
               the order of magnitude, not the same body"
            .to_owned(),
    }
}

/// Temperature above which a share of the compliance that is ever frozen in has been, °C.
///
/// `∫ da/3η` is what a bridge held at both ends bends by. Cooling goes with the excess temperature, so the
/// answer knows neither diameter nor air: only viscosity, nozzle and room temperature.
fn arrest_c(material: &Material, share: f64) -> f64 {
    let Some(plastic) = melt(material) else { return f64::NAN };
    let cooling = cooling(&strand(1e-3, 0.005, 1.0, 0.0), material, plastic, Corner::Nominal);
    let viscosity = plastic.viscosity;
    let fluidity =
        |age_s: f64| 1.0 / (3.0 * viscosity.zero_shear_pa_s(cooling.temperature_k(age_s)));
    let rigid_pa_s = 1e14 * viscosity.zero_shear_pa_s(cooling.start_k);
    let end_s = cooling.time_to_s(viscosity.temperature_k(rigid_pa_s));
    let until = |age_s: f64| Fluidity::integrate(fluidity, &[0.0, age_s], 40).moments[0];
    let all = until(end_s);
    let (mut low, mut high) = (0.0, end_s);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if until(middle) < share * all { low = middle } else { high = middle }
    }
    cooling.temperature_k(low) - 273.15
}

fn flow_stop_pla(pla: &Material) -> Case {
    let stop_c = Interval::new(arrest_c(pla, 0.99), arrest_c(pla, 0.95), arrest_c(pla, 0.995));
    Case {
        id: "FLOW-STOP-PLA",
        kind: Kind::Published,
        title: "below which temperature a PLA bridge no longer sags",
        source: "Pricci 2025, Polymers 17(21):2858 (abstract)",
        checks: vec![Check::band("99 % of the compliance is frozen in above", "°C", [140.0, 170.0], stop_c)],
        note: "theirs 150 to 160 °C, 10 K either way; ours from the viscosity alone, at 95 to 99.5 %; the flow \
               arrest in materials/pla is their number and is not used here"
            .to_owned(),
    }
}
