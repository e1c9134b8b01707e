//! The whole frame at a state: what is out of balance, and the tangent.

use nalgebra::{Matrix3, UnitQuaternion};

use super::element::{Bar, Response};
use super::lean::{Lean, Leaning};
use crate::pose::Vector;
use crate::structure::assembly::{Pattern, indefinite::Signed};
use crate::structure::beam::{Matrix12, beams};
use crate::structure::frame::{Frame, Support};
use crate::structure::ground::{Tie, ground};
use crate::structure::solve::{
    Load, SolveError, active_freedoms, add_ends, check_inputs, fixed_freedoms, masked, node_forces,
};

/// Frame, supports and load made ready.
#[derive(Debug)]
pub(super) struct System {
    pub(super) frame: Frame,
    pub(super) bars: Vec<Bar>,
    pattern: Pattern,
    active: Vec<bool>,
    /// At nodes, six freedoms each.
    dead: Vec<f64>,
    lean: Lean,
    /// Length that weighs turns against translations, and forces against moments: the mean member.
    pub(super) scale_m: f64,
}

/// Where every node is: shifted from its stress-free place, and turned.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub(super) shifts: Vec<Vector>,
    pub(super) turns: Vec<UnitQuaternion<f64>>,
    /// Factor on all loads.
    pub(super) factor: f64,
}

/// The frame at a state; vectors over the kept freedoms.
#[derive(Debug)]
pub(super) struct Balance {
    /// Loads less what members ask.
    pub(super) rest: Vec<f64>,
    /// Loads per unit of factor.
    pub(super) push: Vec<f64>,
    /// `‖rest‖` over the size of what meets at nodes; 0 where nothing does.
    pub(super) residual: f64,
    /// The part of it that rounding explains.
    pub(super) rounding: f64,
    /// Members, in the frame's order.
    pub(super) responses: Vec<Response>,
}

/// A factored tangent.
#[derive(Debug)]
pub(super) struct Tangent {
    values: Vec<f64>,
    pub(super) signed: Signed,
    leaning: Option<Leaning>,
}

impl System {
    /// Checks and prepares; nodes stand off their planned place by `offsets` (empty: none), free of
    /// stress.
    pub(super) fn new(
        frame: &Frame,
        supports: &[Support],
        load: &Load,
        offsets: &[[f64; 3]],
    ) -> Result<Self, SolveError> {
        check_inputs(frame, supports, &load.at_nodes, load.gravity_m_s2)?;
        let frame = offset(frame, offsets)?;
        let count = frame.nodes().len();
        let tie = ground(count, frame.members(), supports).tie;
        if let Some(node) = tie.iter().position(|&tie| tie != Tie::Held) {
            return Err(SolveError::Floats { node });
        }
        let fixed = fixed_freedoms(count, supports);
        let keep: Vec<bool> = fixed.iter().map(|fixed| fixed.contains(&false)).collect();
        let pattern = Pattern::new(&keep, frame.members()).ok_or(SolveError::TooLarge)?;
        let active = active_freedoms(&pattern, &tie, &fixed);
        let beams = beams(&frame);
        let bar =
            |(member, beam)| Bar::new(member, beam, load.gravity_m_s2, load.with_initial_strain);
        let bars: Vec<Bar> = frame.members().iter().zip(&beams).map(bar).collect();
        let total_m: f64 = beams.iter().map(|beam| beam.length_m).sum();
        let dead = node_forces(count, &load.at_nodes);
        let scale_m = total_m / bars.len().max(1) as f64;
        let lean = Lean::new(&pattern.gather(&dead), &active);
        let system = Self { lean, frame, bars, pattern, active, dead, scale_m };
        // a motion without stiffness is named as in the linear solution
        let start = system.balance(&system.start());
        system.pattern.factor(&system.assemble(&start.responses), &system.active)?;
        Ok(system)
    }

    /// Free of load.
    pub(super) fn start(&self) -> State {
        let count = self.frame.nodes().len();
        State {
            shifts: vec![Vector::zeros(); count],
            turns: vec![UnitQuaternion::identity(); count],
            factor: 0.0,
        }
    }

    /// The state after a step of the kept freedoms: translations add, spins turn on top.
    pub(super) fn moved(&self, state: &State, step: &[f64], factor: f64) -> State {
        let mut to = State { factor, ..state.clone() };
        for (six, &node) in step.chunks_exact(6).zip(&self.pattern.kept) {
            to.shifts[node] += Vector::new(six[0], six[1], six[2]);
            let spin = Vector::new(six[3], six[4], six[5]);
            to.turns[node] = UnitQuaternion::from_scaled_axis(spin) * to.turns[node];
            to.turns[node].renormalize();
        }
        to
    }

    /// O(members).
    pub(super) fn balance(&self, state: &State) -> Balance {
        let turns: Vec<Matrix3<f64>> =
            state.turns.iter().map(|turn| *turn.to_rotation_matrix().matrix()).collect();
        let respond = |bar: &Bar| {
            let [a, b] = bar.ends;
            bar.response([state.shifts[a], state.shifts[b]], [turns[a], turns[b]], state.factor)
        };
        let responses: Vec<Response> = self.bars.iter().map(respond).collect();
        let mut asked = vec![0.0; self.dead.len()];
        let mut push = self.dead.clone();
        let mut weight = self.dead.clone();
        let mut size: Vec<f64> = self.dead.iter().map(|load| (state.factor * load).abs()).collect();
        let mut rounding = vec![0.0; self.dead.len()];
        for (member, response) in self.frame.members().iter().zip(&responses) {
            add_ends(&mut asked, member, &response.force);
            add_ends(&mut push, member, &response.load);
            add_ends(&mut weight, member, &response.weight);
            add_ends(&mut size, member, &response.force.abs());
            for &node in &member.ends {
                rounding[6 * node] += response.rounding[0];
                rounding[6 * node + 3] += response.rounding[1];
            }
        }
        let kept = |values: &[f64]| masked(self.pattern.gather(values), &self.active);
        let left: Vec<f64> =
            weight.iter().zip(&asked).map(|(load, asked)| state.factor * load - asked).collect();
        let rest = kept(&left);
        let whole = self.force_norm(&kept(&size));
        let relative = |norm: f64| if whole > 0.0 { norm / whole } else { norm };
        Balance {
            residual: relative(self.force_norm(&rest)),
            rounding: relative(self.force_norm(&self.pattern.gather(&rounding))),
            push: kept(&push),
            rest,
            responses,
        }
    }

    fn assemble(&self, responses: &[Response]) -> Vec<f64> {
        // a moment left at a node makes its rate lean by half its spin: with the rest this goes,
        // and what a load's own moment adds is in `Lean`, so Newton's order is kept
        let even: Vec<Matrix12> =
            responses.iter().map(|one| (one.tangent + one.tangent.transpose()) * 0.5).collect();
        let parts = self.frame.members().iter().zip(&even).map(|(member, k)| (member, k, 1.0));
        self.pattern.assemble(parts, &self.active)
    }

    /// The tangent at a load factor, its symmetric half factored; `None` where that is singular to
    /// rounding.
    pub(super) fn tangent(&self, balance: &Balance, factor: f64) -> Option<Tangent> {
        let values = self.assemble(&balance.responses);
        let signed = self.pattern.factor_signed(&values)?;
        let solve = |right: &mut [f64]| self.pattern.solve(&signed.factor, right);
        let leaning = self.lean.ready(factor, self.pattern.freedoms(), solve);
        Some(Tangent { values, signed, leaning })
    }

    /// Solves, with refinement where interchanging no pivots has cost digits; `None` where that is
    /// not enough.
    pub(super) fn solve(&self, tangent: &Tangent, right: &[f64]) -> Option<Vec<f64>> {
        let mut x = right.to_vec();
        self.pattern.solve(&tangent.signed.factor, &mut x);
        let size = self.force_norm(right);
        for _ in 0..3 {
            let product = self.pattern.multiply(&tangent.values, &x);
            let mut gap: Vec<f64> = right.iter().zip(&product).map(|(r, p)| r - p).collect();
            let left = self.force_norm(&gap);
            if left <= 1e-6 * size {
                if let Some(leaning) = &tangent.leaning {
                    self.lean.put_in(leaning, &mut x);
                }
                return Some(x);
            }
            if !left.is_finite() {
                return None;
            }
            self.pattern.solve(&tangent.signed.factor, &mut gap);
            x.iter_mut().zip(&gap).for_each(|(x, more)| *x += more);
        }
        None
    }

    /// Translations and turns times the mean member, as one vector.
    pub(super) fn inner(&self, a: &[f64], b: &[f64]) -> f64 {
        let weigh = |at: usize| if at % 6 < 3 { 1.0 } else { self.scale_m * self.scale_m };
        a.iter().zip(b).enumerate().map(|(at, (a, b))| weigh(at) * a * b).sum()
    }

    fn force_norm(&self, forces: &[f64]) -> f64 {
        let weigh = |at: usize| if at % 6 < 3 { 1.0 } else { 1.0 / (self.scale_m * self.scale_m) };
        let terms = forces.iter().enumerate().map(|(at, force)| weigh(at) * force * force);
        terms.sum::<f64>().sqrt()
    }

    /// Largest turn of a node, or of a member's chord, in a step, rad.
    pub(super) fn reach(&self, step: &[f64]) -> f64 {
        let mut of_frame = vec![0.0; self.dead.len()];
        self.pattern.scatter_add(step, &mut of_frame);
        let three = |at: usize| Vector::new(of_frame[at], of_frame[at + 1], of_frame[at + 2]);
        let chords = self.bars.iter().map(|bar| {
            let [a, b] = bar.ends;
            bar.reach(&(three(6 * b) - three(6 * a)))
        });
        let nodes = (0..of_frame.len() / 6).map(|node| three(6 * node + 3).norm());
        chords.chain(nodes).fold(0.0, |most, one| if one > most { one } else { most })
    }

    /// Largest spin of a node in a step, rad; infinite where a number is not finite.
    pub(super) fn largest_spin(&self, step: &[f64]) -> f64 {
        if !step.iter().all(|x| x.is_finite()) {
            return f64::INFINITY;
        }
        let spins = step.chunks_exact(6).map(|six| Vector::new(six[3], six[4], six[5]).norm());
        spins.fold(0.0, f64::max)
    }
}

/// The frame with its nodes off their planned place.
fn offset(frame: &Frame, offsets: &[[f64; 3]]) -> Result<Frame, SolveError> {
    let count = frame.nodes().len();
    if offsets.is_empty() {
        return Ok(frame.clone());
    }
    if offsets.len() != count {
        return Err(SolveError::BadNode { node: offsets.len().min(count) });
    }
    if let Some(node) = offsets.iter().position(|three| !three.iter().all(|x| x.is_finite())) {
        return Err(SolveError::BadNode { node });
    }
    let moved =
        frame.nodes().iter().zip(offsets).map(|(node, by)| node + Vector::from(*by)).collect();
    Frame::new(moved, frame.members().to_vec()).map_err(|fault| match fault {
        crate::structure::frame::FrameFault::NoLength { member } => {
            SolveError::BadMember { member }
        }
        _ => SolveError::BadNode { node: 0 },
    })
}
