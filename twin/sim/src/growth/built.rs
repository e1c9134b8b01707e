//! The frame of a print with what each node and member stands for.

use super::strand_law::StrandLaw;
use crate::structure::{Frame, Member, Strength, Support, Weld};

/// The frame of a print.
#[derive(Debug, Clone)]
pub struct Built {
    /// Nodes and members, members in order of birth.
    pub frame: Frame,
    /// Number of members once so many strands are printed; one more entry than strands.
    pub born: Vec<usize>,
    /// First and last node of each strand, in printing order.
    pub ends: Vec<[usize; 2]>,
    /// Strand (by order) of each member.
    pub member_order: Vec<usize>,
    /// Arc length of its strand as planned where each member begins and ends, m; of a link both where it holds.
    pub member_at_m: Vec<[f64; 2]>,
    /// Nodes held by the bed with the order of the strand that brings them.
    pub grounded: Vec<(usize, usize)>,
    /// Nodes held by a form: node, order, form.
    pub formed: Vec<(usize, usize, usize)>,
    /// What holds strands together, nominal.
    pub welds: Vec<Weld>,
    /// The contact of each weld.
    pub weld_contact: Vec<usize>,
    /// Members that are links between two axes.
    pub is_link: Vec<bool>,
    /// By order: contacts with earlier strands by which it is joined.
    pub(super) contacts: Vec<Vec<usize>>,
}

impl Built {
    /// Supports once `n_printed` strands are there and the forms still hold as given.
    pub fn supports(&self, n_printed: usize, held_forms: &[bool]) -> Vec<Support> {
        let on_bed =
            self.grounded.iter().filter(|(_, order)| *order < n_printed).map(|(node, _)| *node);
        let on_form = self
            .formed
            .iter()
            .filter(|(_, order, form)| *order < n_printed && held_forms[*form])
            .map(|(node, _, _)| *node);
        let mut nodes: Vec<usize> = on_bed.chain(on_form).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes.into_iter().map(Support::clamped).collect()
    }

    /// The frame without initial strains.
    pub(super) fn weightless_strain(&self) -> Frame {
        self.with_members(|member| Member { initial_strain: 0.0, ..*member })
    }

    /// The frame with members changed one by one.
    pub(super) fn with_members(&self, change: impl Fn(&Member) -> Member) -> Frame {
        let members = self.frame.members().iter().map(change).collect();
        Frame::new(self.frame.nodes().to_vec(), members)
            .expect("a sound frame with sound constants")
    }

    /// Contacts with earlier strands by which a strand is joined.
    pub(super) fn contacts_of(&self, order: usize) -> &[usize] {
        &self.contacts[order]
    }

    /// Strength of each member. A link is judged as a weld, not as a strand: nothing strains it too far.
    pub fn strengths(&self, laws: &[StrandLaw]) -> Vec<Strength> {
        let strength = |(order, is_link): (&usize, &bool)| {
            let pa = if *is_link { NEVER_PA } else { laws[*order].strength_pa };
            Strength { tension_pa: pa, compression_pa: pa }
        };
        self.member_order.iter().zip(&self.is_link).map(strength).collect()
    }

    /// The earliest strand (by order) that has a member at this node.
    pub fn strand_at(&self, node: usize) -> Option<usize> {
        let at = |member: &Member| member.ends.contains(&node);
        self.frame.members().iter().position(at).map(|member| self.member_order[member])
    }
}

/// A strength that nothing reaches, Pa.
const NEVER_PA: f64 = 1e100;
