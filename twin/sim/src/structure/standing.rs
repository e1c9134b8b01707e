//! How the frame stands: displacements, and what its members carry. Both answers side by side.

use super::balance::{add, add_node_loads, carried, norms, stretch};
use super::beam::{Beam, Vector12};
use super::frame::{Frame, Member};
use super::ground::Tie;
use super::ldl::Pair;
use super::seat::{Seat, add_pressed};
use super::solve::{add_ends, node_forces};
use super::stages::{Stage, StageState};
use super::strength::Cut;
use super::trial::Capacity;
use crate::pose::Vector;

pub(super) use super::balance::{ONE_SHOT, STAGED};

/// A stage of a frame.
pub(super) struct Moment<'a> {
    pub(super) frame: &'a Frame,
    pub(super) beams: &'a [Beam],
    pub(super) stage: &'a Stage,
    /// By node.
    pub(super) tie: &'a [Tie],
    /// By node: freedoms that move.
    pub(super) free: &'a [[bool; 6]],
}

impl Moment<'_> {
    pub(super) fn born(&self) -> &[Member] {
        &self.frame.members()[..self.stage.born]
    }
}

/// Both answers as they go from stage to stage.
///
/// One-shot starts from where it stood: what does not change there is not solved again. Its forces
/// are taken from its displacements anew, the staged ones grow.
pub(super) struct Standing {
    pub(super) u: Vec<Pair>,
    /// Elastic force of each member on its nodes, weight not included.
    elastic: Vec<[Pair; 12]>,
    /// Weight of each member, and the gravity it is for.
    weight: Vec<Vector12>,
    gravity_m_s2: [f64; 3],
    /// Loads of the members, one-shot, by freedom.
    loads: Vec<f64>,
    /// What the one-shot forces are for: factors on the stiffness, and what was free.
    factors: Vec<f64>,
    pub(super) free: Vec<[bool; 6]>,
    /// Nodes that have let go of a surface.
    pub(super) seats: Vec<Seat>,
    /// Forces out of balance at the end of the last stage that was solved; not a number where a
    /// freedom was held.
    rest: Vec<Pair>,
    /// Forces out of balance now, and at held freedoms what the supports take.
    pub(super) gap: Vec<Pair>,
}

impl Standing {
    pub(super) fn new(frame: &Frame) -> Self {
        let freedoms = 6 * frame.nodes().len();
        Self {
            u: vec![[0.0; 2]; freedoms],
            elastic: Vec::with_capacity(frame.members().len()),
            weight: Vec::with_capacity(frame.members().len()),
            gravity_m_s2: [0.0; 3],
            loads: vec![0.0; freedoms],
            factors: Vec::with_capacity(frame.members().len()),
            free: vec![[false; 6]; frame.nodes().len()],
            seats: Vec::new(),
            rest: vec![[f64::NAN; 2]; freedoms],
            gap: vec![[0.0; 2]; freedoms],
        }
    }

    /// Members that are new at this stage come with their initial strain, and the weights turn.
    pub(super) fn bear(&mut self, moment: &Moment) {
        let stage = moment.stage;
        for member in self.elastic.len()..stage.born {
            let strain = moment.beams[member].strain_load * stage.stiffness_of(member);
            self.elastic.push(std::array::from_fn(|row| [-strain[row]; 2]));
        }
        if self.gravity_m_s2 != stage.gravity_m_s2 {
            self.factors.clear();
            self.loads.fill(0.0);
            self.gravity_m_s2 = stage.gravity_m_s2;
            self.weight.clear();
        }
        for beam in &moment.beams[self.weight.len().min(stage.born)..stage.born] {
            self.weight.push(beam.weight_load(stage.gravity_m_s2));
        }
    }

    /// Right side of the stage's first solve. Nodes whose forces are as the last stage left them
    /// stay out of it; the size of all loads (at nodes, weight, initial strain) comes with it.
    pub(super) fn start(&mut self, moment: &Moment) -> (Vec<Pair>, f64) {
        let known = self.known(moment);
        self.factors.truncate(known);
        if known == 0 {
            for (u, free) in self.u.iter_mut().zip(moment.free.iter().flatten()) {
                if !free {
                    u[ONE_SHOT] = 0.0;
                }
            }
            self.loads.fill(0.0);
        }
        for (at, member) in moment.born().iter().enumerate().skip(known) {
            let factor = moment.stage.stiffness_of(at);
            self.factors.push(factor);
            add_ends(
                &mut self.loads,
                member,
                &(self.weight[at] + moment.beams[at].strain_load * factor),
            );
        }
        self.free.copy_from_slice(moment.free);
        self.follow(moment, &[], known);
        let mut loads = node_forces(moment.free.len(), &moment.stage.at_nodes);
        loads.iter_mut().zip(&self.loads).for_each(|(sum, load)| *sum += load);
        let loads = loads.iter().zip(moment.free.iter().flatten());
        let size = loads.filter(|(_, free)| **free).map(|(load, _)| load * load).sum::<f64>();
        self.measure(moment);
        let mut right = self.gap.clone();
        for (right, rest) in right.chunks_exact_mut(6).zip(self.rest.chunks_exact(6)) {
            if right == rest {
                right.fill([0.0; 2]);
            }
        }
        (right, size.sqrt())
    }

    /// Members of which the one-shot forces need not be taken anew at the start of a stage: all of
    /// the last one, unless what holds them, their stiffness or gravity is another now.
    fn known(&self, moment: &Moment) -> usize {
        let lost = |(now, before): (&[bool; 6], &[bool; 6])| {
            now.iter().zip(before).any(|(now, before)| *before && !*now)
        };
        let another = moment.free.iter().zip(&self.free).any(lost)
            || self.factors.iter().enumerate().any(|(at, f)| *f != moment.stage.stiffness_of(at));
        // gravity that turned has left none known
        if another { 0 } else { self.factors.len() }
    }

    /// Moves the nodes by a solution; the forces now out of balance are the next right side.
    pub(super) fn step(&mut self, moment: &Moment, step: &mut [Pair]) -> Pair {
        for (u, step) in self.u.iter_mut().zip(step.iter()) {
            u[ONE_SHOT] += step[ONE_SHOT];
            u[STAGED] += step[STAGED];
        }
        self.follow(moment, step, 0);
        let sizes = self.measure(moment);
        step.copy_from_slice(&self.gap);
        sizes
    }

    /// The stage is solved. An overflow is not handed on to the next one-shot answer.
    pub(super) fn settle(&mut self, moment: &Moment) {
        let free = moment.free.iter().flatten();
        for ((rest, gap), free) in self.rest.iter_mut().zip(&self.gap).zip(free) {
            *rest = if *free { *gap } else { [f64::NAN; 2] };
        }
        if !self.u.iter().all(|u| u[ONE_SHOT].is_finite()) {
            self.u.iter_mut().for_each(|u| u[ONE_SHOT] = 0.0);
            self.factors.clear();
            self.loads.fill(0.0);
            self.rest.fill([f64::NAN; 2]);
        }
    }

    /// Members, from one on, follow their nodes with the stiffness of now: one-shot from the displacements, staged
    /// by the step alone.
    ///
    /// With r from the first end to the second, `F₂ = k₂₂ (u₂ - u₁ - θ₁ × r, θ₂ - θ₁)` and the first
    /// end carries `-(F₂, M₂ + r × F₂)`: a member that moves as a whole takes no force.
    fn follow(&mut self, moment: &Moment, step: &[Pair], from: usize) {
        let nodes = moment.frame.nodes();
        let members = moment.born().iter().zip(&mut self.elastic).enumerate().skip(from);
        for (at, (member, elastic)) in members {
            let beam = &moment.beams[at];
            let factor = moment.stage.stiffness_of(at);
            let [a, b] = member.ends.map(|node| 6 * node);
            let r = nodes[member.ends[1]] - nodes[member.ends[0]];
            let staged = |freedom: usize| step.get(freedom).map_or(0.0, |step| step[STAGED]);
            let stretch = stretch(&r, |end, k| {
                let freedom = [a, b][end] + k;
                [self.u[freedom][ONE_SHOT], staged(freedom)]
            });
            let mut far = [[0.0; 2]; 6];
            for (column, by) in stretch.iter().enumerate() {
                for (row, far) in far.iter_mut().enumerate() {
                    let k = factor * beam.stiffness[(6 + row, 6 + column)];
                    far[ONE_SHOT] += k * by[ONE_SHOT];
                    far[STAGED] += k * by[STAGED];
                }
            }
            let near = carried(&r, &far);
            for row in 0..12 {
                let force = if row < 6 { near[row] } else { far[row - 6] };
                elastic[row][ONE_SHOT] = force[ONE_SHOT] - factor * beam.strain_load[row];
                elastic[row][STAGED] += force[STAGED];
            }
        }
    }

    /// Forces out of balance; their sizes over what is free.
    fn measure(&mut self, moment: &Moment) -> Pair {
        self.gap.fill([0.0; 2]);
        add_node_loads(moment.stage, &mut self.gap);
        add_pressed(&self.seats, &mut self.gap);
        for ((member, weight), elastic) in moment.born().iter().zip(&self.weight).zip(&self.elastic)
        {
            add(&mut self.gap, member, |row| {
                [weight[row] - elastic[row][ONE_SHOT], weight[row] - elastic[row][STAGED]]
            });
        }
        norms(&self.gap, moment.free)
    }

    /// One of the answers as it is reported.
    pub(super) fn state(
        &self,
        moment: &Moment,
        side: usize,
        capacity: &Capacity,
        residual: f64,
        kept: bool,
        peaks: &mut [f64],
    ) -> StageState {
        let (mut max_translation_m, mut max_node, mut max_rotation_rad) = (0.0, 0, 0.0f64);
        let of_node = |node: usize| -> [f64; 6] {
            std::array::from_fn(|freedom| self.u[6 * node + freedom][side])
        };
        let count = moment.free.len();
        for node in 0..count {
            let six = of_node(node);
            let translation_m = Vector::new(six[0], six[1], six[2]).norm();
            if translation_m > max_translation_m {
                (max_translation_m, max_node) = (translation_m, node);
            }
            max_rotation_rad = max_rotation_rad.max(Vector::new(six[3], six[4], six[5]).norm());
        }
        let (utilisation, weld) = capacity.used(|| self.cuts(moment, side), peaks);
        let held = |&super::Support { node, fixed }: &super::Support| {
            let of = |k: usize| if fixed[k] { -self.gap[6 * node + k][side] } else { 0.0 };
            std::array::from_fn(of)
        };
        StageState {
            max_translation_m,
            max_node,
            max_rotation_rad,
            utilisation,
            weld,
            reactions: moment.stage.supports.iter().map(held).collect(),
            residual,
            displacement: if kept { (0..count).map(of_node).collect() } else { Vec::new() },
            watched: moment.stage.watch.iter().map(|&node| of_node(node)).collect(),
        }
    }

    /// Displacement of a node, staged.
    pub(super) fn staged(&self, node: usize) -> [f64; 6] {
        std::array::from_fn(|freedom| self.u[6 * node + freedom][STAGED])
    }

    /// Forces in the born members; none in one that floats.
    pub(super) fn cuts(&self, moment: &Moment, side: usize) -> Vec<Cut> {
        let cut = |(at, member): (usize, &Member)| {
            let line = moment.beams[at].line_load(moment.stage.gravity_m_s2);
            let part = if moment.tie[member.ends[0]] == Tie::Held { 1.0 } else { 0.0 };
            let first: [f64; 6] = std::array::from_fn(|row| {
                (self.elastic[at][row][side] - self.weight[at][row]) * part
            });
            Cut::new(&first, line * part)
        };
        moment.born().iter().enumerate().map(cut).collect()
    }
}
