//! Frames solved by OpenSees, PyNite and numpy (data/frames).

use std::path::PathBuf;

use serde_json::Value;

use super::*;
use crate::structure::{Ask, Solution, Stage, solve, solve_stages};

pub(super) fn own(name: &str) -> Value {
    let path = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/frames"));
    serde_json::from_slice(&std::fs::read(path.join(name)).unwrap()).unwrap()
}

pub(super) fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().flat_map(numbers).collect(),
        other => vec![other.as_f64().unwrap()],
    }
}

pub(super) fn indices(value: &Value) -> Vec<usize> {
    numbers(value).iter().map(|x| *x as usize).collect()
}

/// The frame of a file in mm, N, MPa, as SI.
pub(super) struct Reference {
    pub(super) file: Value,
    pub(super) frame: Frame,
    pub(super) supports: Vec<Support>,
}

pub(super) fn reference(name: &str) -> Reference {
    let file = own(name);
    let nodes = numbers(&file["nodes"])
        .chunks_exact(3)
        .map(|p| Point::new(p[0] * 1e-3, p[1] * 1e-3, p[2] * 1e-3))
        .collect();
    let elastic = Elastic {
        e_pa: file["E"].as_f64().unwrap() * 1e6,
        g_pa: file["G"].as_f64().unwrap() * 1e6,
    };
    let radii = numbers(&file["radius"]);
    let members = indices(&file["members"])
        .chunks_exact(2)
        .zip(radii)
        .map(|(ends, radius_mm)| Member {
            density_kg_m3: file["density"].as_f64().unwrap() * 1e9,
            ..member([ends[0], ends[1]], Section::circle(2e-3 * radius_mm), elastic)
        })
        .collect();
    let supports = clamped(indices(&file["fixed"]));
    Reference { frame: Frame::new(nodes, members).unwrap(), file, supports }
}

impl Reference {
    fn with(&self, change: impl Fn(usize, &Member) -> Member) -> Frame {
        let members = self.frame.members().iter().enumerate().map(|(k, m)| change(k, m)).collect();
        Frame::new(self.frame.nodes().to_vec(), members).unwrap()
    }

    pub(super) fn nodal(&self) -> Vec<NodeLoad> {
        let each = |load: &Value| {
            let six = numbers(&load["load"]);
            NodeLoad {
                node: load["node"].as_u64().unwrap() as usize,
                // N stay, N mm become N m
                load: std::array::from_fn(|k| if k < 3 { six[k] } else { six[k] * 1e-3 }),
            }
        };
        self.file["nodal_loads"].as_array().unwrap().iter().map(each).collect()
    }
}

/// Lengths as mm, moments as N mm, triples alternating: forces and turns need no factor.
pub(super) fn in_mm(six: impl IntoIterator<Item = f64>, scaled_triple: usize) -> Vec<f64> {
    let scale = |(at, x): (usize, f64)| if (at / 3) % 2 == scaled_triple { x * 1e3 } else { x };
    six.into_iter().enumerate().map(scale).collect()
}

/// Displacements are written to 12 decimals of mm and rad, forces to 9 of N and N mm: in f050 that
/// rounding alone is 7e-9 of the largest turn and 3e-8 of the largest force.
fn compare(name: &str, case: &str, solution: &Solution, file: &Value) {
    let wanted = &file["results"][case];
    let of = |rows: &[f64], scaled: usize, wanted: &Value, unit: f64| {
        let got = in_mm(rows.iter().copied(), scaled);
        let wanted = numbers(wanted);
        (block_gap(&got, &wanted), rounded_gap(&got, &wanted, unit))
    };
    let u = of(&solution.displacement.concat(), 0, &wanted["u"], 1e-12);
    let forces = wanted
        .get("member_end_forces_global")
        .map(|wanted| of(&solution.end_forces.concat(), 1, wanted, 1e-9));
    let reactions = of(&solution.reactions.concat(), 1, &wanted["reactions"], 1e-9);
    let show = |(gap, rest): &(f64, f64)| format!("{gap:.1e} {rest:.1e}");
    eprintln!(
        "{name} {case}: (gap, without rounding of the file) u {}, end forces {}, \
         reactions {}, residual {:.1e}",
        show(&u),
        forces.as_ref().map_or_else(|| "none given".to_owned(), show),
        show(&reactions),
        solution.residual
    );
    assert!(u.1 < 1e-9 && reactions.1 < 1e-9);
    assert!(forces.is_none_or(|(_, gap)| gap < 1e-9));
    assert!(solution.residual < 1e-10);
}

#[test]
fn random_frames_of_three_solvers() {
    let down = [0.0, 0.0, -9.80665];
    for name in ["f050.json", "f150.json"] {
        let reference = reference(name);
        let (file, supports) = (&reference.file, &reference.supports);
        let weight = Load { gravity_m_s2: down, ..Load::default() };
        let pushed = Load { at_nodes: reference.nodal(), ..weight.clone() };

        let solution = solve(&reference.frame, supports, &weight).unwrap();
        compare(name, "LC1_selfweight", &solution, file);
        let solution = solve(&reference.frame, supports, &pushed).unwrap();
        compare(name, "LC2_sw_plus_nodal", &solution, file);

        let strains = numbers(&file["initial_strain_LC3"]);
        let shrunk = reference.with(|k, m| Member { initial_strain: strains[k], ..*m });
        let only_strain = Load { with_initial_strain: true, ..Load::default() };
        let solution = solve(&shrunk, supports, &only_strain).unwrap();
        compare(name, "LC3_shrinkage", &solution, file);

        let factors = numbers(&file["stiffness_factor_LC4"]);
        let aged = reference.with(|k, m| Member {
            elastic: Elastic {
                e_pa: m.elastic.e_pa * factors[k],
                g_pa: m.elastic.g_pa * factors[k],
            },
            ..*m
        });
        let solution = solve(&aged, supports, &weight).unwrap();
        compare(name, "LC4_aged_sw", &solution, file);
        // the same, as factors of one stage
        let stage = Stage {
            born: aged.members().len(),
            supports: supports.clone(),
            gravity_m_s2: down,
            at_nodes: Vec::new(),
            stiffness: factors,
            ..Stage::default()
        };
        let ask = Ask { keep: &[0], ..Ask::default() };
        let records = solve_stages(&reference.frame, &[stage], ask).unwrap();
        let state = records[0].one_shot.as_ref().unwrap();
        let got = state.displacement.iter().flatten().copied();
        let wanted = numbers(&file["results"]["LC4_aged_sw"]["u"]);
        assert!(rounded_gap(&in_mm(got, 0), &wanted, 1e-12) < 1e-9);

        let kappa = Section::cowper_circle(file["nu"].as_f64().unwrap());
        let sheared = reference.with(|_, m| Member { section: m.section.sheared(kappa), ..*m });
        let solution = solve(&sheared, supports, &pushed).unwrap();
        compare(name, "LC5_timoshenko_sw_plus_nodal", &solution, file);
    }
}
