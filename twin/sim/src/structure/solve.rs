//! One frame, one load: displacements, member forces and reactions.

use thiserror::Error;

use super::assembly::{Mechanism, Pattern};
use super::beam::{Beam, Matrix12, Vector12, beams};
use super::frame::{Frame, Member, NodeLoad, Support};
use super::ground::{Tie, ground};

/// What acts on a frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Load {
    /// Acceleration of gravity, m/s²; turns with the part if its bed does.
    pub gravity_m_s2: [f64; 3],
    /// Forces and moments at nodes.
    pub at_nodes: Vec<NodeLoad>,
    /// Whether members want their initial strain.
    pub with_initial_strain: bool,
}

/// How a frame stands under a load. Rotations in rad, forces in N, moments in N m.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// By node: x, y, z, turns.
    pub displacement: Vec<[f64; 6]>,
    /// By member: force and moment on its first end, then on its second, axes of the part.
    pub end_forces: Vec<[f64; 12]>,
    /// In the order of the supports: what the support does to the frame.
    pub reactions: Vec<[f64; 6]>,
    /// `‖K u - f‖/‖f‖` over the free freedoms; 0 without load.
    pub residual: f64,
}

/// Why a frame does not stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum SolveError {
    /// A piece, or a node without member, touches no support; its lowest node is named.
    #[error("node {node} and what hangs on it are tied to no support")]
    Floats {
        /// Lowest node of the piece.
        node: usize,
    },
    /// Supports leave a motion without stiffness.
    #[error("node {node} can move freely in freedom {freedom}")]
    Mechanism {
        /// Node where the elimination met it.
        node: usize,
        /// 0 to 2 along x, y, z; 3 to 5 about them.
        freedom: usize,
    },
    /// A support or load names a node that is not there, or a load is not a finite number.
    #[error("support or load at node {node} is unusable")]
    BadNode {
        /// The node named.
        node: usize,
    },
    /// A member is named that is not there, or there is no number, or not a positive one, for it.
    #[error("no usable number for member {member}")]
    BadMember {
        /// The member.
        member: usize,
    },
    /// Gravity is not a finite number.
    #[error("gravity is not finite")]
    BadGravity,
    /// The system is larger than memory or indices allow.
    #[error("the system of equations does not fit into memory")]
    TooLarge,
}

impl From<Mechanism> for SolveError {
    fn from(at: Mechanism) -> Self {
        Self::Mechanism { node: at.node, freedom: at.freedom }
    }
}

/// Solves `K u = f` for the whole frame.
///
/// Linear, small displacements, exact for straight uniform members loaded at nodes and by their own
/// uniform weight. Sparse `L D Lᵀ` with an AMD ordering; nothing is regularised.
///
/// # Errors
/// [`SolveError`]: what floats, what is a mechanism, what is named but not there.
pub fn solve(frame: &Frame, supports: &[Support], load: &Load) -> Result<Solution, SolveError> {
    check_inputs(frame, supports, &load.at_nodes, load.gravity_m_s2)?;
    Held::new(frame, supports)?.solution(load)
}

/// A frame on its supports, its stiffness factored: good for any load.
#[derive(Debug)]
pub struct Held<'a> {
    pub(crate) frame: &'a Frame,
    pub(crate) supports: &'a [Support],
    pub(crate) beams: Vec<Beam>,
    pattern: Pattern,
    active: Vec<bool>,
    values: Vec<f64>,
    factor: Vec<f64>,
}

impl<'a> Held<'a> {
    /// Factors the stiffness once.
    ///
    /// # Errors
    /// As [`solve`].
    pub fn new(frame: &'a Frame, supports: &'a [Support]) -> Result<Self, SolveError> {
        check_inputs(frame, supports, &[], [0.0; 3])?;
        let tie = ground(frame.nodes().len(), frame.members(), supports).tie;
        let fixed = fixed_freedoms(frame.nodes().len(), supports);
        // A node that no member needs but that is clamped stands where it is.
        let stands = |(tie, fixed): (&Tie, &[bool; 6])| *tie == Tie::Held || *fixed == [true; 6];
        if let Some(node) = tie.iter().zip(&fixed).position(|it| !stands(it)) {
            return Err(SolveError::Floats { node });
        }
        let keep: Vec<bool> = fixed.iter().map(|fixed| fixed.contains(&false)).collect();
        let pattern = Pattern::new(&keep, frame.members()).ok_or(SolveError::TooLarge)?;
        let beams = beams(frame);
        let active = active_freedoms(&pattern, &tie, &fixed);
        let values = pattern.assemble(parts(frame.members(), &beams, &[]), &active);
        let factor = pattern.factor(&values, &active)?;
        Ok(Self { frame, supports, beams, pattern, active, values, factor })
    }

    /// Makes every member stiffer or softer by a factor; pattern and order of elimination stay.
    pub(crate) fn rescale(&mut self, by: &[f64]) -> Result<(), SolveError> {
        for (beam, by) in self.beams.iter_mut().zip(by) {
            beam.stiffness *= *by;
            beam.strain_load *= *by;
        }
        let parts = parts(self.frame.members(), &self.beams, &[]);
        self.values = self.pattern.assemble(parts, &self.active);
        self.factor = self.pattern.factor(&self.values, &self.active)?;
        Ok(())
    }

    /// Displacements under forces in the freedoms of the frame; what acts on held freedoms goes into
    /// the supports.
    pub(crate) fn displacement(&self, forces: &[f64]) -> Vec<f64> {
        let mut u = masked(self.pattern.gather(forces), &self.active);
        self.pattern.solve(&self.factor, &mut u);
        let mut displacement = vec![0.0; forces.len()];
        self.pattern.scatter_add(&u, &mut displacement);
        displacement
    }

    /// `‖K u - f‖/‖f‖` over the free freedoms.
    fn residual(&self, displacement: &[f64], forces: &[f64]) -> f64 {
        let right = masked(self.pattern.gather(forces), &self.active);
        let u = self.pattern.gather(displacement);
        relative_gap(&self.pattern.multiply(&self.values, &u), &right)
    }

    /// The answer to a load.
    ///
    /// # Errors
    /// A load that is not finite, or at a node that is not there.
    pub fn solution(&self, load: &Load) -> Result<Solution, SolveError> {
        check_inputs(self.frame, &[], &load.at_nodes, load.gravity_m_s2)?;
        let members = self.frame.members();
        let mut f = node_forces(self.frame.nodes().len(), &load.at_nodes);
        for (member, beam) in members.iter().zip(&self.beams) {
            add_ends(&mut f, member, &fixed_load(beam, load));
        }
        let displacement = self.displacement(&f);
        let of_member = |(member, beam): (&Member, &Beam)| {
            beam.stiffness * ends_of(&displacement, member) - fixed_load(beam, load)
        };
        let end_forces: Vec<Vector12> = members.iter().zip(&self.beams).map(of_member).collect();
        Ok(Solution {
            reactions: reactions(self.frame, &end_forces, self.supports, &load.at_nodes),
            displacement: by_node(&displacement),
            end_forces: end_forces.iter().map(|forces| (*forces).into()).collect(),
            residual: self.residual(&displacement, &f),
        })
    }
}

fn fixed_load(beam: &Beam, load: &Load) -> Vector12 {
    let strain = if load.with_initial_strain { 1.0 } else { 0.0 };
    beam.weight_load(load.gravity_m_s2) + beam.strain_load * strain
}

pub(crate) fn check_inputs(
    frame: &Frame,
    supports: &[Support],
    loads: &[NodeLoad],
    gravity_m_s2: [f64; 3],
) -> Result<(), SolveError> {
    if !gravity_m_s2.iter().all(|g| g.is_finite()) {
        return Err(SolveError::BadGravity);
    }
    let count = frame.nodes().len();
    let bad_load =
        |load: &&NodeLoad| load.node >= count || !load.load.iter().all(|x| x.is_finite());
    let bad_support = supports.iter().map(|support| support.node).find(|&node| node >= count);
    match bad_support.or(loads.iter().find(bad_load).map(|load| load.node)) {
        Some(node) => Err(SolveError::BadNode { node }),
        None => Ok(()),
    }
}

/// Freedoms held by any of the supports, by node.
pub(crate) fn fixed_freedoms(node_count: usize, supports: &[Support]) -> Vec<[bool; 6]> {
    let mut fixed = vec![[false; 6]; node_count];
    for support in supports {
        for (all, one) in fixed[support.node].iter_mut().zip(support.fixed) {
            *all |= one;
        }
    }
    fixed
}

pub(crate) fn active_freedoms(pattern: &Pattern, tie: &[Tie], fixed: &[[bool; 6]]) -> Vec<bool> {
    let of_node =
        |&node: &usize| fixed[node].map(|fixed| !fixed && tie[node] == Tie::Held).into_iter();
    pattern.kept.iter().flat_map(of_node).collect()
}

/// Members with their stiffness and its factor (an empty list is 1 throughout).
pub(crate) fn parts<'a>(
    members: &'a [Member],
    beams: &'a [Beam],
    factors: &'a [f64],
) -> impl Iterator<Item = (&'a Member, &'a Matrix12, f64)> {
    members.iter().zip(beams).enumerate().map(|(at, (member, beam))| {
        (member, &beam.stiffness, factors.get(at).copied().unwrap_or(1.0))
    })
}

pub(crate) fn node_forces(node_count: usize, loads: &[NodeLoad]) -> Vec<f64> {
    let mut f = vec![0.0; 6 * node_count];
    for load in loads {
        for (freedom, value) in load.load.iter().enumerate() {
            f[6 * load.node + freedom] += value;
        }
    }
    f
}

pub(crate) fn add_ends(to: &mut [f64], member: &Member, ends: &Vector12) {
    for (end, &node) in member.ends.iter().enumerate() {
        for freedom in 0..6 {
            to[6 * node + freedom] += ends[6 * end + freedom];
        }
    }
}

pub(crate) fn ends_of(u: &[f64], member: &Member) -> Vector12 {
    Vector12::from_fn(|row, _| u[6 * member.ends[row / 6] + row % 6])
}

pub(crate) fn masked(mut values: Vec<f64>, active: &[bool]) -> Vec<f64> {
    for (value, active) in values.iter_mut().zip(active) {
        if !active {
            *value = 0.0;
        }
    }
    values
}

/// `‖a - b‖/‖b‖`; 0 where b is nothing.
pub(crate) fn relative_gap(a: &[f64], b: &[f64]) -> f64 {
    let gap: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
    let size: f64 = b.iter().map(|b| b * b).sum();
    if size > 0.0 { (gap / size).sqrt() } else { 0.0 }
}

pub(crate) fn by_node(flat: &[f64]) -> Vec<[f64; 6]> {
    flat.chunks_exact(6).map(|six| std::array::from_fn(|freedom| six[freedom])).collect()
}

/// What members ask of a held node beyond the loads on it; free freedoms are 0.
///
/// A freedom held by two supports is reported at both.
pub(crate) fn reactions(
    frame: &Frame,
    end_forces: &[Vector12],
    supports: &[Support],
    loads: &[NodeLoad],
) -> Vec<[f64; 6]> {
    let mut sum = node_forces(frame.nodes().len(), loads);
    sum.iter_mut().for_each(|value| *value = -*value);
    for (member, ends) in frame.members().iter().zip(end_forces) {
        add_ends(&mut sum, member, ends);
    }
    let of_support = |support: &Support| {
        std::array::from_fn(|freedom| {
            if support.fixed[freedom] { sum[6 * support.node + freedom] } else { 0.0 }
        })
    };
    supports.iter().map(of_support).collect()
}
