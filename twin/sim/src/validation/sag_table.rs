//! What the reference itself computed of sag, with the values of the library.

use super::strand::{GRAVITY_M_S2, ROOM_K, melt, usable_speed_m_s, with_cp_high};
use super::{Case, Check, Kind, Library, number};
use crate::interval::Interval;
use crate::process::heat::{Cooling, cooling_rate_per_s, effective_h_w_m2k};
use crate::process::sag::SoftBeam;
use crate::process::soft::melt_fluidity;
use crate::process::thermal::Heat;
use crate::process::{Material, Thermoplastic};

pub(super) fn cases(library: &Library<'_>) -> Vec<Case> {
    vec![sag_table(library), jets(library)]
}

/// Sag A of the reference's own table, clamped and hinged, at a heat transfer that is given, mm.
fn table_mm(
    material: &Material,
    plastic: &Thermoplastic,
    d_m: f64,
    h: f64,
    v_m_s: f64,
) -> [f64; 2] {
    let density_kg_m3 = plastic.melt_density_kg_m3.nominal;
    let effective = effective_h_w_m2k(h, d_m, material.k_w_mk.nominal);
    let rate = cooling_rate_per_s(effective, density_kg_m3, material.cp_j_kgk.nominal, d_m);
    let cooling = Heat::Lumped(Cooling {
        start_k: plastic.extrusion_k.nominal,
        air_k: ROOM_K,
        jet_rate_per_s: rate,
        jet_until_s: 0.0,
        room_rate_per_s: rate,
    });
    let beam = SoftBeam {
        diameter_m: d_m,
        density_kg_m3,
        across_m_s2: GRAVITY_M_S2,
        speed_m_s: v_m_s,
        span_m: 10.0,
    };
    let fluidity = melt_fluidity(plastic, &cooling);
    [beam.clamped_sag_m(fluidity) * 1e3, beam.hinged_sag_m(fluidity) * 1e3]
}

/// Heat transfer W/(m² K), speed mm/s, clamped and hinged mm, as printed in `process-physics.md` 3.2.
type TableRow = (&'static str, f64, f64, f64, [f64; 2]);
const TABLE: [TableRow; 12] = [
    ("PLA", 1.27, 40.0, 2.0, [1.8, 6.5]),
    ("PLA", 1.27, 100.0, 2.0, [0.02, 0.09]),
    ("PLA", 1.27, 100.0, 5.0, [0.9, 3.4]),
    ("PLA", 1.27, 200.0, 5.0, [0.04, 0.15]),
    ("PLA", 1.27, 200.0, 10.0, [0.7, 2.5]),
    ("PLA", 1.27, 400.0, 10.0, [0.04, 0.16]),
    ("PLA", 3.0, 200.0, 2.0, [0.04, 0.13]),
    ("PLA", 3.0, 200.0, 5.0, [1.4, 5.0]),
    ("PLA", 3.0, 400.0, 5.0, [0.16, 0.6]),
    ("PLA", 3.0, 400.0, 10.0, [2.6, 9.0]),
    ("ABS", 3.0, 400.0, 5.0, [0.09, 0.3]),
    ("ABS", 3.0, 400.0, 10.0, [1.5, 5.0]),
];

fn sag_table(library: &Library<'_>) -> Case {
    let check = |&(name, d_mm, h, v_mm_s, theirs): &TableRow| {
        let material = if name == "ABS" { library.abs } else { library.pla };
        let [clamped, hinged] = match melt(material) {
            Some(plastic) => table_mm(material, plastic, d_mm * 1e-3, h, v_mm_s * 1e-3),
            None => [f64::NAN; 2],
        };
        let what = format!("{name} {d_mm} mm, h {h}, {v_mm_s} mm/s, clamped to hinged");
        let inside = |got: f64, printed: f64| (printed / 3.0..=printed * 3.0).contains(&got);
        let check = Check::words(
            what,
            format!("{}..{} mm", theirs[0], theirs[1]),
            format!("{}..{} mm", number(clamped), number(hinged)),
            inside(clamped, theirs[0]) && inside(hinged, theirs[1]),
        );
        if check.holds() == Some(false) { check.outside(table_why(material)) } else { check }
    };
    Case {
        id: "SAG-TABLE",
        kind: Kind::Reference,
        title: "sag behind the nozzle, the reference's own table",
        source: "process-physics.md 3.2",
        checks: TABLE.iter().map(check).collect(),
        note: "within a factor 3 (ours: what viscosity alone is known to); with the table's own material values the \
               same laws print its digits (test sag_table_of_the_reference)"
            .to_owned(),
    }
}

/// Sag goes with the fifth power of the cooling time, so with that of density times specific heat.
fn table_why(material: &Material) -> String {
    let Some(plastic) = melt(material) else { return String::new() };
    let (cp, density) = (material.cp_j_kgk.nominal, plastic.melt_density_kg_m3.nominal);
    let (table_cp, table_density) =
        if material.name == "abs" { (1950.0, 930.0) } else { (1800.0, 1240.0) };
    let ratio = cp * density / (table_cp * table_density);
    format!(
        "the library's {} has cp {} J/(kg K) and {} kg/m³ as a melt, the table {} and {}: cooling time x {}, and \
         sag goes with its fifth power, x {}",
        material.name,
        number(cp),
        number(density),
        number(table_cp),
        number(table_density),
        number(ratio),
        number(ratio.powi(5))
    )
}

fn jets(library: &Library<'_>) -> Case {
    let mut checks = Vec::new();
    for (name, material) in [("PLA", library.pla), ("ABS", library.abs)] {
        for d_mm in [1.27, 3.0] {
            let at = |jet_m_s| usable_speed_m_s(material, d_mm * 1e-3, jet_m_s).scaled(1e3);
            let (still, weak, strong) = (at(0.0), at(5.0), at(20.0));
            let check =
                Check::band(format!("{name} {d_mm} mm, still air"), "mm/s", [0.0, 2.0], still);
            checks.push(if check.holds() == Some(true) {
                check
            } else {
                check.outside(still_why(name, d_mm, material, still))
            });
            let ours = format!(
                "up to {} mm/s under 5 m/s, {} under 20 m/s",
                number(weak.nominal),
                number(strong.nominal)
            );
            checks.push(Check::words(
                format!("{name} {d_mm} mm, jets of 5 to 20 m/s"),
                "possible at 2 to 10 mm/s",
                ours,
                weak.nominal >= 2.0 && strong.nominal >= 5.0,
            ));
        }
    }
    Case {
        id: "JETS-2-10",
        kind: Kind::Reference,
        title: "jets make free-air printing possible at 2 to 10 mm/s",
        source: "process-physics.md 3.2; issue 4, row 4",
        checks,
        note: "possible: sag behind the nozzle up to half the diameter, span 60 mm, nozzle clamps the slope, jets over all of \
               the soft strand; asked of the weak jet 2 mm/s, of the strong one the middle of the band, 5 mm/s"
            .to_owned(),
    }
}

fn still_why(name: &str, d_mm: f64, material: &Material, still: Interval) -> String {
    let warm = usable_speed_m_s(&with_cp_high(material), d_mm * 1e-3, 0.0).scaled(1e3);
    format!(
        "{name} of {d_mm} mm can do without jets up to {} mm/s by nominal values; at the high end of its specific heat that \
         is {} mm/s, with all inputs adverse {} mm/s: the band is inside what it may be",
        number(still.nominal),
        number(warm.nominal),
        number(still.low)
    )
}
