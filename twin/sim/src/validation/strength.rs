//! Strength across bonds.

use super::{Case, Check, Kind, Library, number};
use crate::interval::Interval;

pub(super) fn cases(library: &Library<'_>) -> Vec<Case> {
    // one line to swap for a law of healing
    let bond = library.abs.bond_fraction;
    vec![aniso_table(bond), layer_xz(bond), heal_r2(), dob_range(bond)]
}

/// Source, and strength across over strength along.
const ACROSS: [(&str, f64); 6] = [
    ("Rodriguez", 0.56),
    ("Ahn", 0.57),
    ("Ziemian", 0.56),
    ("Tam & Mueller", 0.55),
    ("Torrado, between layers", 0.50),
    ("Alaimo, in plane", 0.60),
];

fn aniso_table(bond: Interval) -> Case {
    let check = |&(name, theirs): &(&str, f64)| {
        // the table's two digits carry rounding: 0.60 - 0.56 is 0.04
        let around = [theirs - 0.04 - 1e-9, theirs + 0.04 + 1e-9];
        let check = Check::band(format!("ABS, {name}"), "", around, bond);
        if check.holds() == Some(false) {
            check.outside(format!(
                "{name} has {theirs}, the low end of what was found and between layers; the library's {} is the middle \
                 of four others and its low end {} is within 0.04 of it",
                number(bond.nominal),
                number(bond.low)
            ))
        } else {
            check
        }
    };
    let mut checks: Vec<Check> = ACROSS.iter().map(check).collect();
    checks.push(Check::missing("ULTEM, Bagsik", "0.64", "ULTEM is not in the library"));
    Case {
        id: "ANISO-TABLE",
        kind: Kind::Paper,
        title: "strength across strands over strength along them",
        source: "Tam & Mueller 2017, table 1; Kirkman et al. 2019, 2.2",
        checks,
        note: "the library's fraction was read off these: consistent, no prediction".to_owned(),
    }
}

fn layer_xz(bond: Interval) -> Case {
    let ours = bond.map(|fraction| 1.0 / fraction);
    let (ultimate, first) = (3.5, 4.7);
    let why = |ratio: f64| {
        format!(
            "{ratio} needs, besides a bond fraction of {}, that bonds carry on {} of the section only",
            number(bond.nominal),
            number(1.0 / (ratio * bond.nominal))
        )
    };
    Case {
        id: "LAYER-XZ",
        kind: Kind::Paper,
        title: "aligned beam over one that fails between layers",
        source: "Tam & Mueller 2017, table 5",
        checks: vec![
            Check::band("ratio of ultimate loads", "", [0.75 * ultimate, 1.25 * ultimate], ours)
                .outside(why(ultimate)),
            Check::band("ratio of yield loads", "", [0.75 * first, 1.25 * first], ours).outside(why(first)),
        ],
        note: "ours is a bar in tension, across its bonds against along its strands. A neck narrower than its strand, or \
               notches, would close the gap; the paper prints no neck width, and its SLAM-XZ weighs a tenth more than its \
               volume of ABS can (54.2 g, 46 867 mm³)"
            .to_owned(),
    }
}

fn heal_r2() -> Case {
    Case {
        id: "HEAL-R2",
        kind: Kind::Published,
        title: "a diffusion integral against measured strength between layers",
        source: "Coogan & Kazmer, Healing simulation for bond strength prediction of FDM (abstract)",
        checks: vec![Check::missing(
            "share of the scatter explained",
            "0.795",
            "it takes their temperatures and strengths, which the abstract does not print",
        )],
        note: String::new(),
    }
}

fn dob_range(bond: Interval) -> Case {
    Case {
        id: "DOB-RANGE",
        kind: Kind::Published,
        title: "degree of bonding reached in ABS, shear between layers",
        source: "Roy, thesis, University of British Columbia 1.0452040 (abstract)",
        checks: vec![Check::band("bond over strand", "", [0.39, 0.86], bond)],
        note: "ours the library's fraction, which knows neither temperature nor time".to_owned(),
    }
}
