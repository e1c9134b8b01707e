//! How much a strand shortens.

use super::strand::{of_resin, strand};
use super::{Case, Check, Kind, Library, number};
use crate::interval::Interval;
use crate::process::shrinkage::free_strain;
use crate::process::{Ends, Material, StrandInput, simulate};

pub(super) fn cases(library: &Library<'_>) -> Vec<Case> {
    vec![vol_shrink(library.resin), endpoint_order(library)]
}

fn vol_shrink(material: &Material) -> Case {
    let gel = of_resin(material, |resin| resin.gel_density_kg_m3);
    let set = material.density_kg_m3;
    let shrinks = |gel: f64, set: f64| 100.0 * (1.0 - gel / set);
    let all = Interval::new(
        shrinks(gel.nominal, set.nominal),
        shrinks(gel.high, set.low),
        shrinks(gel.low, set.high),
    );
    let after_gel = free_strain(material, super::strand::ROOM_K).scaled(300.0);
    // 5 % of silica by weight (2200 kg/m³) takes this share of the volume and does not shrink
    let silica = 0.05 * gel.nominal / 2200.0;
    let why = format!(
        "ours is one minus gel over set density, {} and {} kg/m³, one derived and one from memory: {} %, and their ends \
         alone make it {} to {} %. 5 % of silica takes theirs down to {} to {} %, still above. Only the part after the \
         gel point strains a strand, and that is its own number",
        number(gel.nominal),
        number(set.nominal),
        number(all.nominal),
        number(all.low),
        number(all.high),
        number(7.28 * (1.0 - silica)),
        number(11.2 * (1.0 - silica))
    );
    Case {
        id: "VOL-SHRINK",
        kind: Kind::Published,
        title: "volume that model resins lose as they cure",
        source: "Polymers 2025, 17(5):610 (abstract): nine resins",
        checks: vec![
            Check::band("loss of volume from gel to set", "%", [7.28, 11.2], all).outside(why),
            Check::words(
                "three times the linear shrinkage past the gel point",
                "less than all of it, 11.2 %",
                format!(
                    "{} % ({} to {})",
                    number(after_gel.nominal),
                    number(after_gel.low),
                    number(after_gel.high)
                ),
                after_gel.high < 11.2,
            ),
        ],
        note: String::new(),
    }
}

fn endpoint_order(library: &Library<'_>) -> Case {
    let materials = [library.abs, library.pla, library.pla_carbon];
    let out = |v_mm_s: f64, jet_m_s: f64| {
        let free = strand(1.27e-3, v_mm_s * 1e-3, 0.1, jet_m_s);
        materials.map(|material| simulate(&StrandInput { ends: Ends::StartHeld, ..free }, material))
    };
    let order = |what: String, ours: [Interval; 3]| {
        let [abs, pla, carbon] = ours.map(|of| of.nominal * 1e3);
        Check::words(
            what,
            "ABS > PLA > PLA + carbon",
            format!("{}, {}, {} mm", number(abs), number(pla), number(carbon)),
            abs > pla && pla > carbon,
        )
    };
    let mut checks: Vec<Check> = [(2.0, 0.0), (5.0, 0.0), (5.0, 5.0), (10.0, 20.0)]
        .into_iter()
        .map(|(v_mm_s, jet_m_s)| {
            let what = format!("miss of the end, {v_mm_s} mm/s, air {jet_m_s} m/s");
            order(what, out(v_mm_s, jet_m_s).map(|of| of.end_miss_m))
        })
        .collect();
    let typical = out(5.0, 5.0);
    let set = typical.each_ref().map(|of| of.sag_set_m);
    checks.push(order("drop of the set strand".to_owned(), set));
    let ends = typical.each_ref().map(|of| {
        format!("{} to {}", number(of.end_miss_m.low * 1e3), number(of.end_miss_m.high * 1e3))
    });
    let soft = typical.each_ref().map(|of| number(of.sag_nozzle_m.nominal * 1e3));
    Case {
        id: "ENDPOINT-ORDER",
        kind: Kind::Paper,
        title: "which material misses its end point most",
        source: "Yu et al. 2016, ACADIA",
        checks,
        note: format!(
            "100 mm of 1.27 mm, end free. By nominal values: the ranges overlap (at 5 mm/s under 5 m/s {} mm), and the \
             expansion of PLA + carbon is from memory. The paper tells shrinkage and self-weight together; the sag of the \
             soft end, {} mm, has another order by viscosities that are known to a factor 3 or worse",
            ends.join(", "),
            soft.join(", ")
        ),
    }
}
