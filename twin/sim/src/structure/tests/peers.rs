//! Frames solved by OpenSees, PyNite and numpy (data/frames), and by pyconmech (data/extrusion).

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

fn indices(value: &Value) -> Vec<usize> {
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

    fn nodal(&self) -> Vec<NodeLoad> {
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

fn shared(path: &str) -> Option<Value> {
    let root = std::env::var("TWIN_SHARED")
        .unwrap_or_else(|_| concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared").to_owned());
    let path = PathBuf::from(root).join("data/extrusion").join(path);
    match std::fs::read(&path) {
        Ok(bytes) => serde_json::from_slice(&bytes).ok(),
        Err(error) => {
            eprintln!("skipped: {}: {error}", path.display());
            None
        }
    }
}

/// A wireframe of the extrusion literature with the constants its reference states (m, kN).
fn wireframe(name: &str) -> Option<(Frame, Vec<Support>)> {
    let file = shared(&format!("frames/{name}.json"))?;
    assert_eq!(file["unit"], "millimeter");
    let list = file["node_list"].as_array()?;
    let xyz = |node: &Value, axis: &str| node["point"][axis].as_f64().unwrap() * 1e-3;
    let nodes = list.iter().map(|node| Point::new(xyz(node, "X"), xyz(node, "Y"), xyz(node, "Z")));
    let grounded = (0..list.len()).filter(|&node| list[node]["is_grounded"] == 1);
    let elastic = Elastic { e_pa: 3.5e9, g_pa: 2.4e9 };
    let members = file["element_list"].as_array()?.iter().map(|element| {
        let ends = indices(&element["end_node_ids"]);
        // weight density 12.2582 kN/m3 under a gravity of 1
        let density_kg_m3 = 12258.2;
        Member { density_kg_m3, ..member([ends[0], ends[1]], Section::circle(3e-3), elastic) }
    });
    Some((Frame::new(nodes.collect(), members.collect()).unwrap(), clamped(grounded)))
}

#[test]
fn wireframes_of_the_literature() {
    let Some(all) = shared("stiffness_reference.json") else { return };
    for (name, reference) in all["instances"].as_object().unwrap() {
        let Some((frame, supports)) = wireframe(name) else { continue };
        let load = Load { gravity_m_s2: [0.0, 0.0, -1.0], ..Load::default() };
        let wanted = &reference["full_reference"];
        if wanted["ok"] != true {
            eprintln!("{name}: the reference has no solution");
            continue;
        }
        let solution = solve(&frame, &supports, &load).unwrap();
        let norm = |six: &[f64; 6], from: usize| {
            Vector::new(six[from], six[from + 1], six[from + 2]).norm()
        };
        let most = |from: usize| {
            solution.displacement.iter().map(|six| norm(six, from)).fold(0.0, f64::max)
        };
        let (u, turn) = (most(0), most(3));
        let gap = |got: f64, key: &str| (got / wanted[key].as_f64().unwrap() - 1.0).abs();
        let gaps = (gap(u, "max_trans_m"), gap(turn, "max_rot_rad"));
        let by_node = reference.get("nodal_displacements").map_or(0.0, |nodes| {
            let wanted: Vec<f64> = (0..frame.nodes().len())
                .flat_map(|node| numbers(&nodes[node.to_string()]))
                .collect();
            let got: Vec<f64> = solution.displacement.iter().flatten().copied().collect();
            block_gap(&got, &wanted)
        });
        let lift: f64 = solution.reactions.iter().map(|six| six[2]).sum();
        let weight = reference["self_weight_kN"].as_f64().unwrap() * 1e3;
        eprintln!(
            "{name}: u {:.1e}, turn {:.1e}, all nodes {by_node:.1e}, weight {:.1e}, residual {:.1e}",
            gaps.0,
            gaps.1,
            (lift / weight - 1.0).abs(),
            solution.residual
        );
        assert!(gaps.0 < 1e-9 && gaps.1 < 1e-9 && by_node < 1e-9);
        assert!((lift / weight - 1.0).abs() < 1e-9);
    }
}
