//! Buckling of a frame: by what factor its loads may grow before it gives way sideways.

use thiserror::Error;

use super::beam::Beam;
use super::divided::{Pencil, Standing};
use super::frame::{Frame, Member, Support};
use super::lanczos::{Pair, Stuck, largest};
use super::solve::{Held, Load, SolveError, by_node, check_inputs, fixed_freedoms};
use super::strength::{Cut, cuts};
use crate::pose::Vector;

/// Parts per member that are worth asking for; more only adds rounding.
const MOST_PARTS: usize = 64;
/// A tension or compression below this part of the largest is rounding.
const NOTHING: f64 = 1e-12;
/// How much of every other shape goes into a start with a known one, so that none is missed.
const OTHERS: f64 = 0.01;

/// What is wanted of a buckling analysis.
#[derive(Debug, Clone, Copy)]
pub struct BucklingAsk<'a> {
    /// Equal parts per member, 1 to 64. One does not see a member buckle between its ends and
    /// comes out 2 to 9 times too high; two are within 1.5 %, four within 0.7 % in the reference
    /// frames.
    pub parts: usize,
    /// How many factors, from the smallest.
    pub modes: usize,
    /// Whether an axial force works on the twist of a member too.
    pub with_twist: bool,
    /// A mode of the same frame under nearly the same load, or of an earlier stage of it.
    pub near: Option<&'a Mode>,
}

impl Default for BucklingAsk<'_> {
    fn default() -> Self {
        Self { parts: 2, modes: 1, with_twist: false, near: None }
    }
}

/// A shape the frame may buckle into.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// On all loads at once.
    pub factor: f64,
    /// By node: x, y, z, turns. The largest translation of all nodes, inner ones too, is 1 (no unit).
    pub displacement: Vec<[f64; 6]>,
    /// By member, the nodes between its parts, from its first end; empty with one part.
    pub inner: Vec<Vec<[f64; 6]>>,
    /// Where it moves most: the member (the first of those at a node).
    pub member: usize,
    /// And the part of its length from its first end, 0 to 1.
    pub station: f64,
    /// The fewest members that hold half of the strain energy, the most strained first: one or
    /// two for a strut that buckles on its own, many for a frame that sways.
    pub region: Vec<usize>,
    /// `‖K⁻¹ K_g φ + φ/λ‖ λ` in the norm of K.
    pub residual: f64,
    /// Solves it took.
    pub solves: usize,
}

/// Why there is no buckling factor.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum BucklingError {
    /// The frame does not stand even without load.
    #[error(transparent)]
    Stands(#[from] SolveError),
    /// No parts, or too many.
    #[error("members can be divided into 1 to 64 parts, not {parts}")]
    Parts {
        /// Parts asked for.
        parts: usize,
    },
    /// A member too slender to be divided in double precision.
    #[error("member {member} is too slender to be divided")]
    TooSlender {
        /// The member.
        member: usize,
    },
    /// Forces in members beyond what a double holds.
    #[error("forces in members are not finite")]
    NotFinite,
    /// The iteration did not settle.
    #[error("no buckling factor after {solves} solves; the best, {factor}, is off by {residual:e}")]
    NotConverged {
        /// Best factor so far; not to be trusted.
        factor: f64,
        /// How far its shape is from one.
        residual: f64,
        /// Solves made.
        solves: usize,
    },
}

impl From<Stuck> for BucklingError {
    fn from(at: Stuck) -> Self {
        let (residual, solves) = (at.residual, at.solves);
        Self::NotConverged { factor: 1.0 / at.theta, residual, solves }
    }
}

/// The smallest positive factors λ on a load at which the frame may leave its shape,
/// `(K + λ K_g(N)) φ = 0`, with N from the linear solution under that load, and their shapes;
/// ascending. Fewer than asked for, or none, where compression does not suffice for more.
///
/// Linear buckling: a perfect frame, elastic, that hardly moves before it gives way. A real one,
/// bent as printed, carries less; a shallow arch that snaps through carries much less. K_g
/// is of axial forces alone: no lateral-torsional buckling by bending, none by torque. N is that of
/// the middle of each part. Where it is the same all along a member a factor comes out too high,
/// in the fourth order of the length of a part; where the weight of the member itself is what
/// presses it, too low in the second order (a column under its own weight: 10 % with two parts,
/// 0.4 % with ten).
///
/// One sparse factorisation, of the undivided frame, serves the solution and 20 to 60 solves per
/// mode. A frame far more in tension than in compression takes more; pulled more than 1e9 times harder
/// than it is pressed, rounding may leave only [`BucklingError::NotConverged`].
///
/// # Errors
/// [`BucklingError`].
pub fn buckling(
    frame: &Frame,
    supports: &[Support],
    load: &Load,
    ask: BucklingAsk,
) -> Result<Vec<Mode>, BucklingError> {
    check_inputs(frame, supports, &load.at_nodes, load.gravity_m_s2)?;
    let held = Held::new(frame, supports)?;
    let solution = held.solution(load);
    let fixed = fixed_freedoms(frame.nodes().len(), supports);
    let free: Vec<bool> = fixed.iter().flatten().map(|fixed| !fixed).collect();
    let solve = |forces: &[f64]| held.displacement(forces);
    let cuts = cuts(frame, &solution, load.gravity_m_s2)?;
    let (members, beams) = (frame.members(), held.beams.as_slice());
    let of = Standing { members, beams, stiffness: &[], cuts: &cuts, free: &free, solve: &solve };
    critical(&of, ask)
}

/// [`buckling`] at any moment, staged or not, with whatever factor is at hand.
pub(crate) fn critical(of: &Standing, ask: BucklingAsk) -> Result<Vec<Mode>, BucklingError> {
    if !(1..=MOST_PARTS).contains(&ask.parts) {
        return Err(BucklingError::Parts { parts: ask.parts });
    }
    let axial_n = axial(of, ask.parts);
    if !axial_n.iter().flatten().all(|n| n.is_finite()) {
        return Err(BucklingError::NotFinite);
    }
    if axial_n.iter().flatten().all(|&n| n >= 0.0) {
        return Ok(Vec::new());
    }
    let pencil = Pencil::new(of, axial_n, (ask.parts, ask.with_twist))
        .map_err(|member| BucklingError::TooSlender { member })?;
    let mut found: Vec<Pair> = Vec::new();
    while found.len() < ask.modes {
        let near = if found.is_empty() { ask.near } else { None };
        let start = start(&pencil, found.len(), near);
        if !largest(&pencil, &mut found, &start)? {
            break;
        }
    }
    found.sort_by(|a, b| b.theta.total_cmp(&a.theta));
    Ok(found.iter().map(|pair| mode(&pencil, of.members, ask.parts, pair)).collect())
}

/// Tension in the middle of each part, by member.
fn axial(of: &Standing, parts: usize) -> Vec<Vec<f64>> {
    let of_member = |(beam, cut): (&Beam, &Cut)| {
        let x = beam.axes.column(0).into_owned();
        let middle_m = |part: usize| beam.length_m * (part as f64 + 0.5) / parts as f64;
        (0..parts).map(|part| cut.axial_n(&x, middle_m(part))).collect()
    };
    let mut axial_n: Vec<Vec<f64>> = of.beams.iter().zip(of.cuts).map(of_member).collect();
    let most = axial_n.iter().flatten().fold(0.0f64, |most, n| most.max(n.abs()));
    for n in axial_n.iter_mut().flatten().filter(|n| n.abs() < NOTHING * most && most.is_finite()) {
        *n = 0.0;
    }
    axial_n
}

/// A mixture of everything, or mostly the shape given; the same every time. Another one for each
/// `turn`: of two shapes of one factor, a mixture only leads to one.
fn start(pencil: &Pencil, turn: usize, near: Option<&Mode>) -> Vec<f64> {
    let mut state = turn as u64;
    let mut any = || {
        // SplitMix64
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / 2f64.powi(52) - 1.0
    };
    let mut mixed: Vec<f64> = (0..pencil.freedoms())
        .map(|freedom| if freedom % 6 < 3 { any() } else { any() / pencil.part_m() })
        .collect();
    if let Some(near) = near {
        let (at_nodes, within) = mixed.split_at_mut(pencil.node_freedoms());
        let known =
            [near.displacement.concat(), near.inner.iter().flatten().flatten().copied().collect()];
        for (values, known) in [at_nodes, within].into_iter().zip(&known) {
            // an earlier stage has fewer members: what is born since starts from the mixture
            for (value, known) in values.iter_mut().zip(known) {
                *value = known + OTHERS * *value;
            }
        }
    }
    mixed
}

fn mode(pencil: &Pencil, members: &[Member], parts: usize, pair: &Pair) -> Mode {
    let six = by_node(&pair.vector);
    let (at_nodes, within) = six.split_at(pencil.node_freedoms() / 6);
    let inner_of = |member: usize| &within[member * (parts - 1)..(member + 1) * (parts - 1)];
    let (mut most, mut member, mut station) = (0.0, 0, 0.0);
    for (at, each) in members.iter().enumerate() {
        let ends = each.ends.map(|node| at_nodes[node]);
        let along = [&ends[..1], inner_of(at), &ends[1..]].concat();
        for (place, six) in along.iter().enumerate() {
            let moved = Vector::new(six[0], six[1], six[2]).norm();
            if moved > most {
                (most, member, station) = (moved, at, place as f64 / parts as f64);
            }
        }
    }
    let unit = if most > 0.0 { 1.0 / most } else { 1.0 };
    let scaled = |six: &[f64; 6]| six.map(|value| value * unit);
    Mode {
        factor: 1.0 / pair.theta,
        displacement: at_nodes.iter().map(scaled).collect(),
        inner: (0..members.len()).map(|at| inner_of(at).iter().map(scaled).collect()).collect(),
        member,
        station,
        region: region(&pencil.energies(&pair.vector)),
        residual: pair.residual,
        solves: pair.solves,
    }
}

/// The fewest members with half of the whole, the greatest first.
fn region(energies: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..energies.len()).collect();
    order.sort_by(|&a, &b| energies[b].total_cmp(&energies[a]));
    let half = 0.5 * energies.iter().sum::<f64>();
    let mut sum = 0.0;
    let mut count = 0;
    while sum < half && count < order.len() {
        sum += energies[order[count]];
        count += 1;
    }
    order.truncate(count);
    order
}
