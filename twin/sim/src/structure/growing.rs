//! The factor of a frame that changes by members: updated where that is cheaper, else made anew.

use super::assembly::{Mechanism, PIVOT_RATIO};
use super::beam::Beam;
use super::frame::Frame;
use super::ldl::{Factor, Pair, Part, Stuck, Symbolic};

/// Error of a pivot, by what updates did to it, past which the factor is made anew: four digits lost.
const WORN: f64 = 1e-12;

/// An update that did not come through; the factor has to be made anew.
struct Halt;

/// The stiffness of a frame, factored, as members come, harden and go.
pub(crate) struct Growing<'a> {
    frame: &'a Frame,
    beams: &'a [Beam],
    factor: Factor,
    /// By member: the factor with which it is in the matrix; 0 is not there.
    there: Vec<f64>,
    /// By node.
    free: Vec<[bool; 6]>,
    /// Members there, by node.
    count: Vec<usize>,
    /// Whether the factor is that of the matrix.
    whole: bool,
    /// Whether it was made anew last.
    made: bool,
}

impl<'a> Growing<'a> {
    /// Ready for any part of the first `born` members; nodes not kept never move.
    pub(crate) fn new(frame: &'a Frame, beams: &'a [Beam], keep: &[bool], born: usize) -> Self {
        let pairs: Vec<[usize; 2]> = frame.members()[..born].iter().map(|m| m.ends).collect();
        let nodes = frame.nodes().len();
        Self {
            frame,
            beams,
            factor: Factor::new(Symbolic::new(frame.nodes(), keep, &pairs), PIVOT_RATIO),
            there: vec![0.0; frame.members().len()],
            free: vec![[false; 6]; nodes],
            count: vec![0; nodes],
            whole: true,
            made: false,
        }
    }

    /// Brings the factor to members with the factors `wanted` (0: not there) and to the freedoms
    /// `free` by node. A node that is free has to have a member.
    ///
    /// Rank-six updates where they cost less than half of a new factorisation and only nodes free in
    /// all six freedoms come or go, else (as where supports change) a new one.
    ///
    /// # Errors
    /// A motion without stiffness. The next call starts from nothing.
    pub(crate) fn advance(&mut self, wanted: &[f64], free: &[[bool; 6]]) -> Result<(), Mechanism> {
        self.made = false;
        let changed: Vec<usize> =
            (0..wanted.len()).filter(|&member| wanted[member] != self.there[member]).collect();
        let cost = |&member: &usize| self.factor.change_cost(self.frame.members()[member].ends);
        let small = || {
            let budget = self.factor.refactor_cost(free) / 2;
            changed.iter().map(cost).sum::<usize>() <= budget.max(64)
        };
        let updated = self.whole
            && (changed.is_empty() || small())
            && self.only_whole_nodes(wanted, free, &changed)
            && self.update(wanted, free, &changed).is_ok()
            && self.factor.wear() <= WORN;
        if updated {
            return Ok(());
        }
        self.there.copy_from_slice(wanted);
        self.free.copy_from_slice(free);
        self.count.fill(0);
        for (member, _) in self.frame.members().iter().zip(wanted).filter(|(_, w)| **w != 0.0) {
            member.ends.iter().for_each(|&node| self.count[node] += 1);
        }
        self.refactor()
    }

    /// Whether each node that changes comes with its first members or goes with its last.
    fn only_whole_nodes(&self, wanted: &[f64], free: &[[bool; 6]], changed: &[usize]) -> bool {
        let mut left = self.count.clone();
        for &member in changed {
            for node in self.frame.members()[member].ends {
                left[node] += usize::from(self.there[member] == 0.0);
                left[node] -= usize::from(wanted[member] == 0.0);
            }
        }
        (0..free.len()).filter(|&node| free[node] != self.free[node]).all(|node| {
            let comes = self.free[node] == [false; 6] && self.count[node] == 0;
            let goes = free[node] == [false; 6] && left[node] == 0;
            goes || (comes && free[node] == [true; 6] && left[node] > 0)
        })
    }

    fn update(
        &mut self,
        wanted: &[f64],
        free: &[[bool; 6]],
        changed: &[usize],
    ) -> Result<(), Halt> {
        self.whole = false;
        let less = changed.iter().rev().copied().filter(|&m| wanted[m] < self.there[m]);
        for member in less.collect::<Vec<_>>() {
            self.take(member, wanted[member], free)?;
        }
        for (node, (now, before)) in free.iter().zip(&self.free).enumerate() {
            if now != before && *now == [true; 6] {
                self.factor.bear(node);
            }
        }
        let mut more: Vec<usize> =
            changed.iter().copied().filter(|&m| wanted[m] > self.there[m]).collect();
        // what hangs on nothing yet waits for what carries it
        while !more.is_empty() {
            let before = more.len();
            let mut waiting = Vec::new();
            for member in more {
                let ends = self.frame.members()[member].ends;
                if ends.iter().any(|&node| self.factor.is_settled(node)) {
                    self.set(member, wanted[member])?;
                } else {
                    waiting.push(member);
                }
            }
            if waiting.len() == before {
                return Err(Halt);
            }
            more = waiting;
        }
        self.free.copy_from_slice(free);
        self.whole = true;
        Ok(())
    }

    fn take(&mut self, member: usize, wanted: f64, free: &[[bool; 6]]) -> Result<(), Halt> {
        if wanted == 0.0 {
            let ends = self.frame.members()[member].ends;
            let goes = |node: usize| {
                self.count[node] == 1 && self.free[node].contains(&true) && free[node] == [false; 6]
            };
            match ends.map(goes) {
                [true, true] => return Err(Halt),
                [true, false] => self.factor.bury(ends[0]),
                [false, true] => self.factor.bury(ends[1]),
                [false, false] => {}
            }
        }
        self.set(member, wanted)
    }

    fn set(&mut self, member: usize, wanted: f64) -> Result<(), Halt> {
        let ends = self.frame.members()[member].ends;
        let before = std::mem::replace(&mut self.there[member], wanted);
        for node in ends {
            self.count[node] += usize::from(before == 0.0);
            self.count[node] -= usize::from(wanted == 0.0);
        }
        let stiffness = &self.beams[member].stiffness;
        self.factor.change(&Part { ends, stiffness, factor: wanted - before }).map_err(|_| Halt)
    }

    /// Makes the factor anew.
    ///
    /// # Errors
    /// As [`Growing::advance`].
    pub(crate) fn refactor(&mut self) -> Result<(), Mechanism> {
        let there = self.there.iter().enumerate().filter(|(_, factor)| **factor != 0.0);
        let parts = there.map(|(member, &factor)| Part {
            ends: self.frame.members()[member].ends,
            stiffness: &self.beams[member].stiffness,
            factor,
        });
        self.made = true;
        let done = self.factor.refactor(parts, &self.free);
        self.whole = done.is_ok();
        done.map_err(|Stuck { place, freedom }| Mechanism {
            node: self.factor.symbolic().node[place],
            freedom,
        })
    }

    /// Overwrites two right sides, six freedoms per node of the frame, by the solutions.
    pub(crate) fn solve(&self, right: &mut [Pair]) {
        self.factor.solve(right);
    }

    /// Makes the next call start anew.
    #[cfg(test)]
    pub(crate) fn start_from_nothing(&mut self) {
        self.whole = false;
    }

    /// Whether the last call made the factor anew.
    #[cfg(test)]
    pub(crate) fn was_made(&self) -> bool {
        self.made
    }

    /// Numbers in the factor below its diagonal blocks.
    #[cfg(test)]
    pub(crate) fn filled(&self) -> usize {
        36 * self.factor.symbolic().blocks()
    }
}
