//! Closed forms and tables of cooling.

use super::exact::case;
use super::{Case, Check};
use crate::interval::Interval;
use crate::process::heat::{
    Cooling, cooling_rate_per_s, effective_h_w_m2k, forced_h_w_m2k, natural_h_w_m2k,
    radiation_h_w_m2k,
};
use crate::process::shrinkage::cooling_end_miss_m;

/// Diameter mm, then natural, 0.5, 1, 2, 5, 10, 20 m/s, W/(m² K), convection and radiation as printed.
type HeatRow = (f64, [f64; 7]);
const HEAT: [HeatRow; 4] = [
    (0.4, [57.5, 134.0, 180.0, 246.0, 376.0, 524.0, 735.0]),
    (1.27, [27.9, 70.0, 96.0, 133.0, 207.0, 291.0, 412.0]),
    (1.75, [23.5, 59.0, 81.0, 112.0, 176.0, 248.0, 352.0]),
    (3.0, [18.1, 44.0, 61.0, 85.0, 134.0, 190.0, 271.0]),
];
const SPEEDS_M_S: [f64; 7] = [0.0, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0];

pub(super) fn cases() -> Vec<Case> {
    let (surface_k, air_k) = (433.15, 295.15);
    let mut thin = case("NUSSELT-THIN", "heat transfer of a thin strand", 0.2, &[]);
    for (d_mm, row) in HEAT {
        for (air_m_s, theirs) in SPEEDS_M_S.into_iter().zip(row) {
            let ours = match air_m_s > 0.0 {
                true => forced_h_w_m2k(d_mm * 1e-3, surface_k, air_k, air_m_s),
                false => natural_h_w_m2k(d_mm * 1e-3, surface_k, air_k),
            };
            let what = format!("{d_mm} mm, {air_m_s} m/s");
            let ends = [0.8 * theirs, 1.2 * theirs];
            thin.checks.push(Check::band(what, "W/(m² K)", ends, Interval::exact(ours)));
        }
    }
    let radiation = radiation_h_w_m2k(0.92, surface_k, air_k);
    thin.checks.push(Check::band(
        "radiation",
        "W/(m² K)",
        [8.32, 12.48],
        Interval::exact(radiation),
    ));
    let rate = cooling_rate_per_s(100.0, 1040.0, 1950.0, 1.27e-3);
    let lumped = one_rate(rate);
    let effective = effective_h_w_m2k(200.0, 1.27e-3, 0.19);
    let strut = one_rate(cooling_rate_per_s(effective, 1040.0, 1950.0, 1.27e-3));
    vec![
        thin,
        case(
            "COOL-LUMP",
            "time to cool, s",
            1e-3,
            &[("240 to 105 °C", 6.217_752_470, lumped.time_to_s(378.15))],
        ),
        case(
            "ENDPOINT-ABS",
            "miss of the end, mm",
            0.03,
            &[("100 mm", 0.268, 1e3 * cooling_end_miss_m(8.8e-5, 378.15, &strut, 0.1, 0.005, 0.0))],
        ),
    ]
}

/// From 240 °C in air of 22 °C at one rate.
fn one_rate(rate_per_s: f64) -> Cooling {
    Cooling {
        start_k: 513.15,
        air_k: 295.15,
        jet_rate_per_s: rate_per_s,
        jet_until_s: 0.0,
        room_rate_per_s: rate_per_s,
    }
}
