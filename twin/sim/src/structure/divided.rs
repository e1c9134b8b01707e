//! Members cut into equal parts, their inner nodes eliminated: the pencil of buckling.
//!
//! A uniform straight member bends the same whole or in parts, so the inner nodes change nothing of
//! the linear answer and the factor of the undivided frame serves. Inner freedoms `i` follow the
//! ends `e` by `u_i = K_ii⁻¹ (f_i - K_ie u_e)`, a chain of blocks of six per member.

use nalgebra::{Matrix6, Vector6};

use super::beam::{Beam, Matrix12, Vector12, local_stiffness, turned};
use super::frame::Member;
use super::geometric::under_tension;
use super::strength::Cut;

/// A frame at some moment: what is born of it, what that carries, and a factor of its stiffness.
pub(crate) struct Standing<'a> {
    pub(crate) members: &'a [Member],
    pub(crate) beams: &'a [Beam],
    /// Factor on the stiffness of each; empty: 1.
    pub(crate) stiffness: &'a [f64],
    /// Forces in each; none in one that floats.
    pub(crate) cuts: &'a [Cut],
    /// By freedom of all nodes: takes part (born, tied to the ground, not held).
    pub(crate) free: &'a [bool],
    /// Displacements of all nodes under forces on them; nothing on freedoms that are not free.
    pub(crate) solve: &'a dyn Fn(&[f64]) -> Vec<f64>,
}

/// One member in parts.
struct Divided {
    ends: [usize; 2],
    /// Of one part, axes of the frame.
    stiffness: Matrix12,
    /// Of one part under a unit tension.
    geometric: Matrix12,
    /// Tension of each part, N.
    axial_n: Vec<f64>,
    /// Where its inner freedoms begin.
    offset: usize,
    inner: Option<Inner>,
}

/// The chain of inner nodes of a member, eliminated from its first end on: `S₁ = D`,
/// `S_k+1 = D - B S_k⁻¹ Bᵀ` with D the stiffness at an inner node and B that from it to the next.
struct Inner {
    /// `S_k⁻¹`.
    inverse: Vec<Matrix6<f64>>,
    /// B, also from the first end and to the second.
    beside: Matrix6<f64>,
}

impl Inner {
    /// `None` where rounding leaves a block not positive definite.
    fn new(part: &Matrix12, parts: usize) -> Option<Self> {
        let beside: Matrix6<f64> = part.fixed_view::<6, 6>(6, 0).into_owned();
        let own: Matrix6<f64> = part.fixed_view::<6, 6>(6, 6) + part.fixed_view::<6, 6>(0, 0);
        let mut inverse: Vec<Matrix6<f64>> = Vec::with_capacity(parts - 1);
        while inverse.len() + 1 < parts {
            let taken =
                inverse.last().map_or_else(Matrix6::zeros, |s| beside * s * beside.transpose());
            let schur = own - taken;
            inverse.push(((schur + schur.transpose()) * 0.5).cholesky()?.inverse());
        }
        Some(Self { inverse, beside })
    }

    /// `K_ii⁻¹` on six numbers per inner node, in place.
    fn solve(&self, values: &mut [Vector6<f64>]) {
        for k in 1..values.len() {
            values[k] -= self.beside * (self.inverse[k - 1] * values[k - 1]);
        }
        for k in (0..values.len()).rev() {
            let above =
                values.get(k + 1).map_or_else(Vector6::zeros, |next| self.beside.tr_mul(next));
            values[k] = self.inverse[k] * (values[k] - above);
        }
    }
}

/// `K x` and `G x` of a frame in parts, and `K⁻¹ f` by the factor of the frame as it is.
///
/// G is minus the geometric stiffness: positive where compression does work. A vector holds six
/// freedoms per node of the frame, then six per inner node, member after member. Cost of each
/// product O(members × parts); of a solve that of the frame more.
pub(crate) struct Pencil<'a> {
    members: Vec<Divided>,
    parts: usize,
    /// By freedom of the nodes.
    free: &'a [bool],
    solve: &'a dyn Fn(&[f64]) -> Vec<f64>,
    freedoms: usize,
    /// Mean length of a part, m.
    part_m: f64,
}

impl<'a> Pencil<'a> {
    /// Of members with the tension of each of their parts.
    ///
    /// # Errors
    /// A member too slender for its inner freedoms to be eliminated in double precision.
    pub(crate) fn new(
        of: &'a Standing,
        axial_n: Vec<Vec<f64>>,
        (parts, with_twist): (usize, bool),
    ) -> Result<Self, usize> {
        let Standing { members, beams, free, solve, .. } = *of;
        let mut freedoms = free.len();
        let mut divided = Vec::with_capacity(members.len());
        for (at, ((member, beam), axial_n)) in members.iter().zip(beams).zip(axial_n).enumerate() {
            let part_m = beam.length_m / parts as f64;
            let factor = of.stiffness.get(at).copied().unwrap_or(1.0);
            let stiffness = turned(&local_stiffness(member, part_m), &beam.axes) * factor;
            let inner =
                if parts > 1 { Some(Inner::new(&stiffness, parts).ok_or(at)?) } else { None };
            divided.push(Divided {
                ends: member.ends,
                stiffness,
                geometric: turned(&under_tension(member, part_m, with_twist), &beam.axes),
                axial_n,
                offset: freedoms,
                inner,
            });
            freedoms += 6 * (parts - 1);
        }
        let whole_m: f64 = beams.iter().map(|beam| beam.length_m).sum();
        let part_m = whole_m / (beams.len() * parts).max(1) as f64;
        Ok(Self { members: divided, parts, free, solve, freedoms, part_m })
    }

    /// Length of a vector.
    pub(crate) fn freedoms(&self) -> usize {
        self.freedoms
    }

    /// Freedoms of the nodes of the frame; those of inner nodes follow.
    pub(crate) fn node_freedoms(&self) -> usize {
        self.free.len()
    }

    /// A length to set turns against shifts.
    pub(crate) fn part_m(&self) -> f64 {
        self.part_m
    }

    /// Elastic: `K x`.
    pub(crate) fn elastic(&self, x: &[f64]) -> Vec<f64> {
        self.product(x, |member, _| (&member.stiffness, 1.0))
    }

    /// Geometric: `G x = -K_g x`.
    pub(crate) fn geometric(&self, x: &[f64]) -> Vec<f64> {
        self.product(x, |member, part| (&member.geometric, -member.axial_n[part]))
    }

    fn product<'m>(
        &'m self,
        x: &[f64],
        of: impl Fn(&'m Divided, usize) -> (&'m Matrix12, f64),
    ) -> Vec<f64> {
        let mut product = vec![0.0; self.freedoms];
        for member in &self.members {
            for part in 0..self.parts {
                let (matrix, factor) = of(member, part);
                if factor != 0.0 {
                    let y = matrix * self.part_of(member, part, x) * factor;
                    for end in 0..2 {
                        let at = self.place(member, part + end);
                        for freedom in 0..6 {
                            product[at + freedom] += y[6 * end + freedom];
                        }
                    }
                }
            }
        }
        for (value, free) in product.iter_mut().zip(self.free) {
            if !free {
                *value = 0.0;
            }
        }
        product
    }

    /// First freedom of a node of a member: its ends are 0 and `parts`.
    fn place(&self, member: &Divided, node: usize) -> usize {
        match node {
            0 => 6 * member.ends[0],
            last if last == self.parts => 6 * member.ends[1],
            inner => member.offset + 6 * (inner - 1),
        }
    }

    fn part_of(&self, member: &Divided, part: usize, x: &[f64]) -> Vector12 {
        let [a, b] = [self.place(member, part), self.place(member, part + 1)];
        let mut both = Vector12::zeros();
        both.fixed_rows_mut::<6>(0).copy_from(&six(x, a));
        both.fixed_rows_mut::<6>(6).copy_from(&six(x, b));
        both
    }

    /// `K⁻¹ f`.
    pub(crate) fn solve(&self, f: &[f64]) -> Vec<f64> {
        let mut at_nodes = f[..self.free.len()].to_vec();
        for member in &self.members {
            let Some(inner) = &member.inner else { continue };
            let mut own = self.within(member, f);
            inner.solve(&mut own);
            let [first, last] = [own[0], own[own.len() - 1]];
            let on_ends = [inner.beside.tr_mul(&first), inner.beside * last];
            for (&node, force) in member.ends.iter().zip(on_ends) {
                for freedom in 0..6 {
                    at_nodes[6 * node + freedom] -= force[freedom];
                }
            }
        }
        let mut u = (self.solve)(&at_nodes);
        u.resize(self.freedoms, 0.0);
        for member in &self.members {
            let Some(inner) = &member.inner else { continue };
            let mut own = self.within(member, f);
            let [first, second] = member.ends.map(|node| six(&u, 6 * node));
            let last = own.len() - 1;
            own[0] -= inner.beside * first;
            own[last] -= inner.beside.tr_mul(&second);
            inner.solve(&mut own);
            for (k, values) in own.iter().enumerate() {
                u[member.offset + 6 * k..][..6].copy_from_slice(values.as_slice());
            }
        }
        u
    }

    /// What a vector holds for the inner nodes of a member.
    fn within(&self, member: &Divided, x: &[f64]) -> Vec<Vector6<f64>> {
        (0..self.parts - 1).map(|k| six(x, member.offset + 6 * k)).collect()
    }

    /// Strain energy (twice) of each member in a shape.
    pub(crate) fn energies(&self, x: &[f64]) -> Vec<f64> {
        let of_part = |member: &Divided, part: usize| {
            let ends = self.part_of(member, part, x);
            ends.dot(&(member.stiffness * ends))
        };
        let of_member = |member| (0..self.parts).map(|part| of_part(member, part)).sum();
        self.members.iter().map(of_member).collect()
    }
}

fn six(x: &[f64], at: usize) -> Vector6<f64> {
    Vector6::from_column_slice(&x[at..at + 6])
}
