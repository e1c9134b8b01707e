//! The twelve unit cases of each stage, two at a time, with a factor that goes from stage to stage.

use super::field::{line_ends, unit_at};
use super::{Riding, UNITS, reach};
use crate::structure::balance::{add, carried, norms, stretch};
use crate::structure::beam::{Beam, Vector12, beams};
use crate::structure::frame::Frame;
use crate::structure::ground::{Tie, ground};
use crate::structure::growing::Growing;
use crate::structure::ldl::Pair;
use crate::structure::solve::{SolveError, fixed_freedoms};
use crate::structure::stages::{Stage, check_stages, moving};
use crate::structure::strength::spans;

/// The most often a pair of unit cases is solved: once, and again for what is left over.
const SOLVES: usize = 3;
/// Residual relative to the loads with which a unit case is left.
const LIMIT: f64 = 1e-12;

/// Hands the unit cases of each stage to `each`, in order; a mechanism where a stage is one.
///
/// Cost per stage: the updates of the factor, twelve solves and O(members). Only one stage is held
/// at a time.
///
/// # Errors
/// Unusable input.
pub fn ride_stages<'a>(
    frame: &'a Frame,
    stages: &[Stage],
    mut each: impl FnMut(usize, Result<Riding<'a>, SolveError>),
) -> Result<(), SolveError> {
    check_stages(frame, stages)?;
    let beams = beams(frame);
    let born = stages.last().map_or(0, |stage| stage.born);
    let mut growing = Growing::new(frame, &beams, &moving(frame, stages, &[]), born);
    for (index, stage) in stages.iter().enumerate() {
        let moment = Still::new(frame, &beams, stage);
        let advanced = growing.advance(&moment.wanted, &moment.free);
        each(index, advanced.map(|()| moment.riding(&growing)).map_err(SolveError::from));
    }
    Ok(())
}

/// A stage between two changes.
struct Still<'a, 'b> {
    frame: &'a Frame,
    beams: &'b [Beam],
    stage: &'b Stage,
    /// By member: factor on its stiffness; 0 is not there or floats.
    wanted: Vec<f64>,
    free: Vec<[bool; 6]>,
}

impl<'a, 'b> Still<'a, 'b> {
    fn new(frame: &'a Frame, beams: &'b [Beam], stage: &'b Stage) -> Self {
        let count = frame.nodes().len();
        let born = &frame.members()[..stage.born];
        let tie = ground(count, born, &stage.supports).tie;
        let fixed = fixed_freedoms(count, &stage.supports);
        let free =
            fixed.iter().zip(&tie).map(|(fixed, tie)| fixed.map(|f| !f && *tie == Tie::Held));
        let mut wanted = vec![0.0; frame.members().len()];
        for (at, _) in born.iter().enumerate().filter(|(_, m)| tie[m.ends[0]] == Tie::Held) {
            wanted[at] = stage.stiffness_of(at);
        }
        Self { frame, beams, stage, wanted, free: free.collect() }
    }

    fn riding(&self, growing: &Growing) -> Riding<'a> {
        let nodes = self.frame.nodes().len();
        let blank = [[0.0; UNITS]; 6];
        let mut riding = Riding {
            frame: self.frame,
            spans: spans(self.frame, self.beams),
            line_kg_per_m: self.lines_kg_per_m(),
            displacement: vec![blank; nodes],
            first_ends: vec![blank; self.stage.born],
            reactions: vec![blank; self.stage.supports.len()],
            reach: [0.0; 3],
            residual: 0.0,
        };
        for first in (0..UNITS).step_by(2) {
            self.solve_pair(growing, first, &mut riding);
        }
        riding.reach = reach(&riding.displacement);
        riding
    }

    /// Mass per length, none where a member floats.
    fn lines_kg_per_m(&self) -> Vec<f64> {
        let of =
            |(beam, wanted): (&Beam, &f64)| if *wanted > 0.0 { beam.line_kg_per_m } else { 0.0 };
        self.beams.iter().zip(&self.wanted).map(of).collect()
    }

    /// Two unit cases: solved, and again for the forces left out of balance where those are more than
    /// rounding.
    fn solve_pair(&self, growing: &Growing, first: usize, riding: &mut Riding) {
        let loads = self.loads(first);
        let mut right = vec![[0.0; 2]; 6 * self.free.len()];
        self.to_nodes(&mut right, |member, row| [loads[member][0][row], loads[member][1][row]]);
        let sizes = norms(&right, &self.free);
        let mut u = vec![[0.0; 2]; right.len()];
        let mut ends = vec![[[0.0; 2]; 12]; self.stage.born];
        let mut gap = right.clone();
        let mut residuals = [0.0; 2];
        for _ in 0..SOLVES {
            growing.solve(&mut gap);
            for (u, step) in u.iter_mut().zip(&gap) {
                *u = [u[0] + step[0], u[1] + step[1]];
            }
            self.follow(&u, &mut ends);
            gap.copy_from_slice(&right);
            self.to_nodes(&mut gap, |member, row| ends[member][row].map(|force| -force));
            let left = norms(&gap, &self.free);
            residuals = [0, 1].map(|k| if sizes[k] > 0.0 { left[k] / sizes[k] } else { 0.0 });
            if residuals.iter().all(|residual| *residual <= LIMIT) {
                break;
            }
        }
        for k in 0..2 {
            let unit = first + k;
            for (six, u) in riding.displacement.iter_mut().zip(u.chunks_exact(6)) {
                (0..6).for_each(|freedom| six[freedom][unit] = u[freedom][k]);
            }
            for ((six, ends), loads) in riding.first_ends.iter_mut().zip(&ends).zip(&loads) {
                (0..6).for_each(|row| six[row][unit] = ends[row][k] - loads[k][row]);
            }
            for (six, support) in riding.reactions.iter_mut().zip(&self.stage.supports) {
                for freedom in (0..6).filter(|&freedom| support.fixed[freedom]) {
                    six[freedom][unit] = -gap[6 * support.node + freedom][k];
                }
            }
        }
        riding.residual = riding.residual.max(residuals[0]).max(residuals[1]);
    }

    /// Loads at the ends of each born member in two unit cases; nothing where it floats.
    fn loads(&self, first: usize) -> Vec<[Vector12; 2]> {
        let of = |member: usize| {
            if self.wanted[member] == 0.0 {
                return [Vector12::zeros(); 2];
            }
            let beam = &self.beams[member];
            let ends = self.frame.members()[member].ends.map(|node| self.frame.nodes()[node]);
            [first, first + 1].map(|unit| {
                let lines = ends.map(|x| unit_at(unit, &x.coords) * beam.line_kg_per_m);
                line_ends(beam, &lines)
            })
        };
        (0..self.stage.born).map(of).collect()
    }

    /// Adds what each born member gives its nodes.
    fn to_nodes(&self, to: &mut [Pair], of: impl Fn(usize, usize) -> Pair) {
        for (member, each) in self.frame.members()[..self.stage.born].iter().enumerate() {
            add(to, each, |row| of(member, row));
        }
    }

    /// Elastic forces of the members on their ends, from what their second end does as seen from the
    /// first: a member that moves as a whole takes none.
    fn follow(&self, u: &[Pair], ends: &mut [[Pair; 12]]) {
        for (member, ends) in ends.iter_mut().enumerate() {
            let [a, b] = self.frame.members()[member].ends;
            let r = self.frame.nodes()[b] - self.frame.nodes()[a];
            let (beam, factor) = (&self.beams[member], self.wanted[member]);
            let stretch = stretch(&r, |end, k| u[6 * [a, b][end] + k]);
            let mut far = [[0.0; 2]; 6];
            for (row, far) in far.iter_mut().enumerate() {
                for (column, by) in stretch.iter().enumerate() {
                    let k = factor * beam.stiffness[(6 + row, 6 + column)];
                    *far = [far[0] + k * by[0], far[1] + k * by[1]];
                }
            }
            let near = carried(&r, &far);
            *ends = std::array::from_fn(|row| if row < 6 { near[row] } else { far[row - 6] });
        }
    }
}
