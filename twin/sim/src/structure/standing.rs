//! How the frame stands: displacements, and what its members carry.

use super::beam::{Beam, Vector12};
use super::frame::Frame;
use super::ground::Tie;
use super::ldl::Pair;
use super::solve::{add_ends, by_node, node_forces, reactions};
use super::stages::{Stage, StageState};
use super::strength::{Cut, Span, Strength, worst};
use crate::pose::Vector;

/// A stage of a frame.
pub(super) struct Moment<'a> {
    pub(super) frame: &'a Frame,
    pub(super) beams: &'a [Beam],
    pub(super) stage: &'a Stage,
}

/// One of the two answers as it goes from stage to stage.
pub(super) struct Standing {
    u: Vec<f64>,
    /// Elastic force of each member on its nodes, weight not included.
    elastic: Vec<Vector12>,
    /// Load each member's initial strain was born with.
    strain: Vec<Vector12>,
    /// Weight of each member, and the gravity it is for.
    weight: Vec<Vector12>,
    gravity_m_s2: [f64; 3],
    born: usize,
}

impl Standing {
    pub(super) fn new(frame: &Frame) -> Self {
        Self {
            u: vec![0.0; 6 * frame.nodes().len()],
            elastic: Vec::with_capacity(frame.members().len()),
            strain: Vec::with_capacity(frame.members().len()),
            weight: Vec::with_capacity(frame.members().len()),
            gravity_m_s2: [0.0; 3],
            born: 0,
        }
    }

    /// As if nothing had been printed yet.
    pub(super) fn clear(&mut self) {
        self.u.fill(0.0);
        self.elastic.clear();
        self.strain.clear();
        self.born = 0;
    }

    /// Members that are new at this stage come with their initial strain, and the weights turn.
    pub(super) fn bear(&mut self, moment: &Moment) {
        let stage = moment.stage;
        for member in self.born..stage.born {
            let strain = moment.beams[member].strain_load * stage.stiffness_of(member);
            self.strain.push(strain);
            self.elastic.push(-strain);
        }
        self.born = stage.born;
        if self.gravity_m_s2 != stage.gravity_m_s2 {
            self.gravity_m_s2 = stage.gravity_m_s2;
            self.weight.clear();
        }
        for beam in &moment.beams[self.weight.len().min(stage.born)..stage.born] {
            self.weight.push(beam.weight_load(stage.gravity_m_s2));
        }
    }

    /// Size of all loads on the free freedoms: at nodes, weight and initial strain.
    pub(super) fn loads(&self, moment: &Moment, free: &[[bool; 6]]) -> f64 {
        let mut f = node_forces(free.len(), &moment.stage.at_nodes);
        let members = moment.frame.members()[..self.born].iter();
        for ((member, weight), strain) in members.zip(&self.weight).zip(&self.strain) {
            add_ends(&mut f, member, &(weight + strain));
        }
        size(&f, free)
    }

    /// Puts the forces out of balance into one side of `out`; their size.
    pub(super) fn gap(
        &self,
        moment: &Moment,
        free: &[[bool; 6]],
        out: &mut [Pair],
        side: usize,
    ) -> f64 {
        let mut f = node_forces(free.len(), &moment.stage.at_nodes);
        let members = moment.frame.members()[..self.born].iter();
        for ((member, weight), elastic) in members.zip(&self.weight).zip(&self.elastic) {
            add_ends(&mut f, member, &(weight - elastic));
        }
        for (out, f) in out.iter_mut().zip(&f) {
            out[side] = *f;
        }
        size(&f, free)
    }

    /// Moves the nodes by one side of `step`; the members take it up with the stiffness of now.
    pub(super) fn move_by(&mut self, moment: &Moment, step: &[Pair], side: usize) {
        for (u, step) in self.u.iter_mut().zip(step) {
            *u += step[side];
        }
        let members = moment.frame.members()[..self.born].iter().zip(moment.beams);
        for (at, ((member, beam), elastic)) in members.zip(&mut self.elastic).enumerate() {
            let stretch =
                Vector12::from_fn(|row, _| step[6 * member.ends[row / 6] + row % 6][side]);
            *elastic += beam.stiffness * stretch * moment.stage.stiffness_of(at);
        }
    }

    pub(super) fn state(
        &self,
        moment: &Moment,
        tie: &[Tie],
        (spans, strengths): (&[Span], &[Strength]),
        residual: f64,
        kept: bool,
    ) -> StageState {
        let (mut max_translation_m, mut max_node, mut max_rotation_rad) = (0.0, 0, 0.0f64);
        for (node, six) in self.u.chunks_exact(6).enumerate() {
            let translation_m = Vector::new(six[0], six[1], six[2]).norm();
            if translation_m > max_translation_m {
                (max_translation_m, max_node) = (translation_m, node);
            }
            max_rotation_rad = max_rotation_rad.max(Vector::new(six[3], six[4], six[5]).norm());
        }
        let end_forces: Vec<Vector12> = self
            .elastic
            .iter()
            .zip(&self.weight)
            .map(|(elastic, weight)| elastic - weight)
            .collect();
        let cut = |(member, forces): (usize, &Vector12)| {
            let held = tie[moment.frame.members()[member].ends[0]] == Tie::Held;
            let line = moment.beams[member].line_load(moment.stage.gravity_m_s2);
            let part = if held { 1.0 } else { 0.0 };
            Cut::new((forces * part).as_slice(), line * part)
        };
        let utilisation = if spans.is_empty() {
            None
        } else {
            let cuts: Vec<Cut> = end_forces.iter().enumerate().map(cut).collect();
            worst(spans, &cuts, strengths)
        };
        let stage = moment.stage;
        StageState {
            max_translation_m,
            max_node,
            max_rotation_rad,
            utilisation,
            reactions: reactions(moment.frame, &end_forces, &stage.supports, &stage.at_nodes),
            residual,
            displacement: if kept { by_node(&self.u) } else { Vec::new() },
        }
    }
}

fn size(f: &[f64], free: &[[bool; 6]]) -> f64 {
    let free = free.iter().flatten();
    f.iter().zip(free).filter(|(_, free)| **free).map(|(f, _)| f * f).sum::<f64>().sqrt()
}
