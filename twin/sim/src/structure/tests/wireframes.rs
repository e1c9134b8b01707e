//! Wireframes of the extrusion literature solved by pyconmech, mended for upright members.

use std::path::PathBuf;

use serde_json::Value;

use super::peers::{indices, numbers};
use super::*;
use crate::structure::{Ask, Stage, solve, solve_stages};

const UNIT: [f64; 3] = [0.0, 0.0, -1.0];

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
///
/// Density is a weight density there, under a gravity of 1.
fn wireframe(name: &str, material: &Value) -> Option<(Frame, Vec<Support>)> {
    let file = shared(&format!("frames/{name}.json"))?;
    assert_eq!(file["unit"], "millimeter");
    let list = file["node_list"].as_array()?;
    let xyz = |node: &Value, axis: &str| node["point"][axis].as_f64().unwrap() * 1e-3;
    let nodes = list.iter().map(|node| Point::new(xyz(node, "X"), xyz(node, "Y"), xyz(node, "Z")));
    let grounded = (0..list.len()).filter(|&node| list[node]["is_grounded"] == 1);
    let of = |key: &str| material[key].as_f64().unwrap() * 1e3;
    let elastic = Elastic { e_pa: of("E_kN_m2"), g_pa: of("G_kN_m2") };
    let density_kg_m3 = of("density_kN_m3");
    let section = Section::circle(3e-3);
    assert!((section.area_m2 * 1e3 / of("A_m2") - 1.0).abs() < 1e-12);
    let members = file["element_list"].as_array()?.iter().map(|element| {
        let ends = indices(&element["end_node_ids"]);
        Member { density_kg_m3, ..member([ends[0], ends[1]], section, elastic) }
    });
    Some((Frame::new(nodes.collect(), members.collect()).unwrap(), clamped(grounded)))
}

/// `(frame, supports, reference, upright members)` of every instance.
fn instances() -> Vec<(String, Frame, Vec<Support>, Value)> {
    let Some(all) = shared("stiffness_reference.json") else { return Vec::new() };
    let of = |(name, reference): (&String, &Value)| {
        let (frame, supports) = wireframe(name, &all["material"])?;
        Some((name.clone(), frame, supports, reference.clone()))
    };
    all["instances"].as_object().unwrap().iter().filter_map(of).collect()
}

/// Members along z as far as a double tells, as the reference counts them.
fn upright(frame: &Frame) -> usize {
    let is_upright = |member: &&Member| {
        let [a, b] = member.ends.map(|node| frame.nodes()[node]);
        ((b.z - a.z) / (b - a).norm()).abs() == 1.0
    };
    frame.members().iter().filter(is_upright).count()
}

fn apart(got: f64, wanted: &Value) -> f64 {
    (got / wanted.as_f64().unwrap() - 1.0).abs()
}

/// Every instance, those that sag beyond the reference's own limit too (`ok` is only that). The
/// peer as released turns upright members round; where there are any it must differ from us.
#[test]
fn wireframes_of_the_literature() {
    for (name, frame, supports, reference) in instances() {
        let load = Load { gravity_m_s2: UNIT, ..Load::default() };
        let solution = solve(&frame, &supports, &load).unwrap();
        let most = |from: usize| {
            let norm = |six: &[f64; 6]| Vector::new(six[from], six[from + 1], six[from + 2]).norm();
            solution.displacement.iter().map(norm).fold(0.0, f64::max)
        };
        let (wanted, released) =
            (&reference["full_reference"], &reference["full_pyconmech_0_6_0_as_released"]);
        let gap =
            apart(most(0), &wanted["max_trans_m"]).max(apart(most(3), &wanted["max_rot_rad"]));
        let off = apart(most(0), &released["max_trans_m"]);
        let by_node = reference.get("nodal_displacements").map_or(0.0, |nodes| {
            let wanted: Vec<f64> = (0..frame.nodes().len())
                .flat_map(|node| numbers(&nodes[node.to_string()]))
                .collect();
            block_gap(&solution.displacement.concat(), &wanted)
        });
        let lift: f64 = solution.reactions.iter().map(|six| six[2]).sum();
        let weight = apart(lift * 1e-3, &reference["self_weight_kN"]);
        let count = upright(&frame);
        eprintln!(
            "{name}: {gap:.1e}, all nodes {by_node:.1e}, weight {weight:.1e}, residual {:.1e}; \
             {count} upright, released peer {off:.1e}",
            solution.residual
        );
        assert!(gap < 1e-9 && by_node < 1e-9 && weight < 1e-9 && solution.residual < 1e-9);
        assert_eq!(count as u64, reference["exactly_vertical_members"].as_u64().unwrap());
        assert_eq!(count > 0, off > 1e-6);
    }
}

/// The greatest translation after each member of the recorded order, as written (seven digits).
#[test]
fn wireframes_while_they_grow() {
    for (name, frame, supports, reference) in instances() {
        let Some(partial) = reference.get("partial_along_recorded_sequence") else {
            eprintln!("{name}: the reference has no order");
            continue;
        };
        let order = indices(&partial["element_ids"]);
        let members = order.iter().map(|&member| frame.members()[member]).collect();
        let frame = Frame::new(frame.nodes().to_vec(), members).unwrap();
        let stage = |born| Stage {
            born,
            supports: supports.clone(),
            gravity_m_s2: UNIT,
            at_nodes: Vec::new(),
            ..Stage::default()
        };
        let stages: Vec<Stage> = (1..=order.len()).map(stage).collect();
        let records = solve_stages(&frame, &stages, Ask::default()).unwrap();
        let wanted = numbers(&partial["max_trans_norm_m_per_step"]);
        assert_eq!(records.len(), wanted.len());
        let (mut worst, mut zero, mut turn) = (0.0f64, 0.0f64, 0.0f64);
        for (record, &wanted) in records.iter().zip(&wanted) {
            assert!(record.floats.is_empty() && record.mechanism.is_none());
            let state = record.one_shot.as_ref().unwrap();
            turn = turn.max(state.max_rotation_rad);
            if wanted == 0.0 {
                zero = zero.max(state.max_translation_m);
            } else {
                worst = worst.max((state.max_translation_m / wanted - 1.0).abs());
            }
        }
        let turn = apart(turn, &partial["max_rot_norm_rad"]);
        let most = records.iter().map(|r| r.one_shot.as_ref().unwrap().max_translation_m);
        let most = apart(most.fold(0.0, f64::max), &partial["max_trans_norm_m"]);
        eprintln!(
            "{name}: {} steps, worst {worst:.1e}, largest {most:.1e}, turn {turn:.1e}, \
             where 0 is written {zero:.1e} m",
            wanted.len()
        );
        assert!(worst < 1e-6 && zero <= 1e-15 && most < 1e-9 && turn < 1e-9);
    }
}
