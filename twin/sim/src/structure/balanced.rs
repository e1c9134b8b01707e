//! Member forces in balance with a load to the last digits, however soft parts of the frame are.

use super::beam::Vector12;
use super::frame::{Frame, NodeLoad, Support};
use super::solve::{Held, Load, Solution, add_ends, by_node, fixed_freedoms, node_forces};

/// Forces left over at nodes, over the loads, below which a field is in balance; otherwise it proves
/// nothing. Corrected once or twice it comes to 1e-13.
const BALANCED: f64 = 1e-10;
const CORRECTIONS: usize = 3;

/// A solution whose member forces are in balance with the load, the initial strain left out. What a
/// soft frame's displacements leave over by rounding is put on it again and the forces are added; its
/// displacements stay as they were. `None` where that does not bring balance.
pub(super) fn in_balance(
    frame: &Frame,
    supports: &[Support],
    held: &Held,
    load: &Load,
) -> Option<Solution> {
    let load = Load { with_initial_strain: false, ..load.clone() };
    let mut solution = held.solution(&load).ok()?;
    let mut wanted = node_forces(frame.nodes().len(), &load.at_nodes);
    for (member, beam) in frame.members().iter().zip(&held.beams) {
        add_ends(&mut wanted, member, &beam.weight_load(load.gravity_m_s2));
    }
    let size = norm(&wanted);
    let fixed = fixed_freedoms(frame.nodes().len(), supports);
    for _ in 0..CORRECTIONS {
        let left = left_over(frame, &fixed, &load, &solution);
        let flat: Vec<f64> = left.iter().flat_map(|load| load.load).collect();
        if norm(&flat) <= BALANCED * size {
            return Some(solution);
        }
        let more = held.solution(&Load { at_nodes: left, ..Load::default() }).ok()?;
        for (ends, more) in solution.end_forces.iter_mut().zip(&more.end_forces) {
            ends.iter_mut().zip(more).for_each(|(end, more)| *end += more);
        }
    }
    None
}

/// Loads on the free freedoms that no member takes up.
fn left_over(
    frame: &Frame,
    fixed: &[[bool; 6]],
    load: &Load,
    solution: &Solution,
) -> Vec<NodeLoad> {
    let mut left = node_forces(frame.nodes().len(), &load.at_nodes);
    for (member, ends) in frame.members().iter().zip(&solution.end_forces) {
        add_ends(&mut left, member, &-Vector12::from(*ends));
    }
    let of_node = |(node, (mut load, fixed)): (usize, ([f64; 6], &[bool; 6]))| {
        for (force, _) in load.iter_mut().zip(fixed).filter(|(_, fixed)| **fixed) {
            *force = 0.0;
        }
        NodeLoad { node, load }
    };
    by_node(&left).into_iter().zip(fixed).enumerate().map(of_node).collect()
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}
