//! Forces and motions of members and nodes, of both answers side by side.

use super::frame::Member;
use super::ldl::Pair;
use super::stages::Stage;
use crate::pose::Vector;

/// One-shot in a [`Pair`].
pub(super) const ONE_SHOT: usize = 0;
/// Staged in a [`Pair`].
pub(super) const STAGED: usize = 1;

/// Forces at nodes, on both answers.
pub(super) fn add_node_loads(stage: &Stage, to: &mut [Pair]) {
    for load in &stage.at_nodes {
        for (freedom, value) in load.load.iter().enumerate() {
            to[6 * load.node + freedom].iter_mut().for_each(|to| *to += value);
        }
    }
}

/// What a member does to its nodes.
pub(super) fn add(to: &mut [Pair], member: &Member, of: impl Fn(usize) -> Pair) {
    for (end, &node) in member.ends.iter().enumerate() {
        for (freedom, to) in to[6 * node..6 * node + 6].iter_mut().enumerate() {
            let force = of(6 * end + freedom);
            to[ONE_SHOT] += force[ONE_SHOT];
            to[STAGED] += force[STAGED];
        }
    }
}

/// Motion of the second end as the first sees it.
pub(super) fn stretch(r: &Vector, u: impl Fn(usize, usize) -> Pair) -> [Pair; 6] {
    let first: [Pair; 6] = std::array::from_fn(|k| u(0, k));
    std::array::from_fn(|k| {
        let far = u(1, k);
        std::array::from_fn(|side| {
            let turn = |axis: usize| first[3 + axis % 3][side];
            let swung = if k < 3 {
                turn(k + 1) * r[(k + 2) % 3] - turn(k + 2) * r[(k + 1) % 3]
            } else {
                0.0
            };
            far[side] - first[k][side] - swung
        })
    })
}

/// Force on the first end that holds the second in balance.
pub(super) fn carried(r: &Vector, far: &[Pair; 6]) -> [Pair; 6] {
    std::array::from_fn(|k| {
        std::array::from_fn(|side| {
            let force = |axis: usize| far[axis % 3][side];
            let lever = if k < 3 {
                0.0
            } else {
                r[(k + 1) % 3] * force(k + 2) - r[(k + 2) % 3] * force(k + 1)
            };
            -far[k][side] - lever
        })
    })
}

/// Sizes over what is free.
pub(super) fn norms(f: &[Pair], free: &[[bool; 6]]) -> Pair {
    let mut sums = [0.0; 2];
    for (f, _) in f.iter().zip(free.iter().flatten()).filter(|(_, free)| **free) {
        sums[ONE_SHOT] += f[ONE_SHOT] * f[ONE_SHOT];
        sums[STAGED] += f[STAGED] * f[STAGED];
    }
    sums.map(f64::sqrt)
}
